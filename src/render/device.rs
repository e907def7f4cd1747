//! Finding and opening an adapter.

use super::RenderError;
use crate::render::AdapterRecord;

/// An open adapter: everything that draws borrows it.
#[derive(Debug, Clone)]
pub struct Gpu {
    /// The logical device.
    pub device: wgpu::Device,
    /// Its queue.
    pub queue: wgpu::Queue,
    /// Who it is, for manifests.
    pub adapter: AdapterRecord,
    /// True for a software adapter: its times are good for ratios only.
    pub is_software: bool,
    /// Nanoseconds a timestamp tick; `None` where the adapter cannot time passes.
    pub timestamp_period_ns: Option<f32>,
}

/// Timestamps are written on the encoder round a pass, because software adapters put
/// those round compute passes at the wrong place.
const TIMESTAMPS: wgpu::Features =
    wgpu::Features::TIMESTAMP_QUERY.union(wgpu::Features::TIMESTAMP_QUERY_INSIDE_ENCODERS);

impl Gpu {
    /// Opens the adapter whose name contains `wanted` (case does not matter), or without
    /// a name the best there is: discrete before integrated before software.
    ///
    /// # Errors
    /// [`RenderError::NoAdapter`] naming the package to install,
    /// [`RenderError::NoSuchAdapter`] naming what there is,
    /// [`RenderError::Unsuitable`] if it lacks what every frame needs.
    pub fn open(wanted: Option<&str>) -> Result<Self, RenderError> {
        pollster::block_on(Self::open_async(wanted))
    }

    async fn open_async(wanted: Option<&str>) -> Result<Self, RenderError> {
        let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
        descriptor.backends = wgpu::Backends::VULKAN | wgpu::Backends::METAL | wgpu::Backends::DX12;
        descriptor.flags = wgpu::InstanceFlags::from_build_config().with_env();
        let instance = wgpu::Instance::new(descriptor);
        let adapter = choose(
            instance.enumerate_adapters(wgpu::Backends::all()).await,
            wanted,
        )?;
        let info = adapter.get_info();
        let features = adapter.features() & TIMESTAMPS;
        let limits = wgpu::Limits {
            max_texture_dimension_2d: adapter.limits().max_texture_dimension_2d,
            max_buffer_size: adapter.limits().max_buffer_size,
            ..wgpu::Limits::default()
        };
        let (device, queue) = adapter
            .request_device(&wgpu::DeviceDescriptor {
                label: Some("greyfield"),
                required_features: features,
                required_limits: limits,
                ..wgpu::DeviceDescriptor::default()
            })
            .await
            .map_err(|error| RenderError::Unsuitable {
                adapter: info.name.clone(),
                message: error.to_string(),
            })?;
        let timestamp_period_ns = (features == TIMESTAMPS).then(|| queue.get_timestamp_period());
        Ok(Self {
            is_software: info.device_type == wgpu::DeviceType::Cpu,
            adapter: record(&info),
            device,
            queue,
            timestamp_period_ns,
        })
    }
}

fn choose(
    adapters: Vec<wgpu::Adapter>,
    wanted: Option<&str>,
) -> Result<wgpu::Adapter, RenderError> {
    if adapters.is_empty() {
        return Err(RenderError::NoAdapter {
            detail: String::from("looked for Vulkan, Metal and Direct3D 12"),
        });
    }
    let names: Vec<String> = adapters.iter().map(|a| a.get_info().name).collect();
    let matches = |adapter: &wgpu::Adapter| {
        wanted.is_none_or(|wanted| {
            adapter
                .get_info()
                .name
                .to_lowercase()
                .contains(&wanted.to_lowercase())
        })
    };
    adapters
        .into_iter()
        .filter(matches)
        .min_by_key(|adapter| rank(adapter.get_info().device_type))
        .ok_or_else(|| RenderError::NoSuchAdapter {
            wanted: wanted.unwrap_or_default().to_owned(),
            found: names.join(", "),
        })
}

fn rank(kind: wgpu::DeviceType) -> u8 {
    match kind {
        wgpu::DeviceType::DiscreteGpu => 0,
        wgpu::DeviceType::IntegratedGpu => 1,
        wgpu::DeviceType::VirtualGpu => 2,
        wgpu::DeviceType::Other => 3,
        wgpu::DeviceType::Cpu => 4,
    }
}

fn record(info: &wgpu::AdapterInfo) -> AdapterRecord {
    let kind = match info.device_type {
        wgpu::DeviceType::DiscreteGpu => "discrete GPU",
        wgpu::DeviceType::IntegratedGpu => "integrated GPU",
        wgpu::DeviceType::VirtualGpu => "virtual GPU",
        wgpu::DeviceType::Cpu => "software",
        wgpu::DeviceType::Other => "unknown",
    };
    AdapterRecord {
        name: info.name.clone(),
        backend: info.backend.to_string(),
        kind: kind.to_owned(),
        driver: [info.driver.as_str(), info.driver_info.as_str()]
            .join(" ")
            .trim()
            .to_owned(),
    }
}
