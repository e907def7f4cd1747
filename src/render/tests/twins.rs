//! Small numeric functions of the shaders beside the same on the processor, in double precision,
//! over dense grids. Where a twin can be an integral or a definition, it is that and not the
//! same formula again.

use std::borrow::Cow;
use std::f64::consts::{FRAC_PI_2, PI};

use wgpu::util::DeviceExt;

use super::*;
use crate::render::frame::FrameUniform;
use crate::render::shader;
use crate::render::technique::SHARED_WGSL;

/// WGSL, and the parameters it reads.
pub(super) struct Source {
    pub wgsl: Cow<'static, str>,
    pub params: String,
}

impl Source {
    fn of(settings: &Settings) -> Self {
        Self {
            wgsl: settings.technique.shader.unwrap().into(),
            params: settings.wgsl(),
        }
    }

    pub fn of_technique(name: &str) -> Self {
        Self::of(&Settings::from_label(name).unwrap())
    }
}

/// Runs WGSL statements that turn `x: vec4f` into `y: vec4f`, with all that `source` declares, on each input.
/// `bound` are uniforms that those functions read, by binding.
pub(super) fn on_gpu(
    source: &Source,
    statements: &str,
    bound: &[(u32, &[u8])],
    inputs: &[[f32; 4]],
) -> Vec<[f32; 4]> {
    let gpu = renderer().gpu();
    let normals = ("normals", include_str!("../shaders/normals_full.wgsl"));
    let variants: Vec<_> = (SHARED_WGSL.iter().copied())
        .chain([normals, ("params", source.params.as_str())])
        .chain([request("none").bounded_part()])
        .collect();
    let entry = "
@group(0) @binding(40) var<storage, read> twin_in: array<vec4f>;
@group(0) @binding(41) var<storage, read_write> twin_out: array<vec4f>;
@compute @workgroup_size(64)
fn twin(@builtin(global_invocation_id) id: vec3u) {
    if id.x < arrayLength(&twin_in) {
        let x = twin_in[id.x];
        var y = vec4f(0.0);
        STATEMENTS
        twin_out[id.x] = y;
    }
}"
    .replace("STATEMENTS", statements);
    let wgsl = shader::compose(&source.wgsl, &variants) + &entry;
    let module = gpu
        .device
        .create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("twin"),
            source: wgpu::ShaderSource::Wgsl(wgsl.into()),
        });
    let pipeline = gpu
        .device
        .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("twin"),
            layout: None,
            module: &module,
            entry_point: Some("twin"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
    let buffer = |contents: &[u8], usage| {
        gpu.device
            .create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: Some("twin"),
                contents,
                usage,
            })
    };
    let storage = wgpu::BufferUsages::STORAGE;
    let read = buffer(bytemuck::cast_slice(inputs), storage);
    let written = buffer(
        bytemuck::cast_slice(inputs),
        storage | wgpu::BufferUsages::COPY_SRC,
    );
    let uniforms: Vec<_> = bound
        .iter()
        .map(|(binding, bytes)| {
            (
                *binding,
                buffer(bytes, wgpu::BufferUsages::UNIFORM | storage),
            )
        })
        .collect();
    let entries: Vec<_> = uniforms
        .iter()
        .map(|(binding, buffer)| (*binding, buffer))
        .chain([(40, &read), (41, &written)])
        .map(|(binding, buffer)| wgpu::BindGroupEntry {
            binding,
            resource: buffer.as_entire_binding(),
        })
        .collect();
    let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("twin"),
        layout: &pipeline.get_bind_group_layout(0),
        entries: &entries,
    });
    let result = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("twin"),
        size: written.size(),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    let mut encoder = gpu
        .device
        .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    {
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.dispatch_workgroups(inputs.len().div_ceil(64) as u32, 1, 1);
    }
    encoder.copy_buffer_to_buffer(&written, 0, &result, 0, written.size());
    gpu.queue.submit([encoder.finish()]);
    result
        .slice(..)
        .map_async(wgpu::MapMode::Read, |mapped| mapped.unwrap());
    gpu.device
        .poll(wgpu::PollType::wait_indefinitely())
        .unwrap();
    let bytes = result.slice(..).get_mapped_range().unwrap().to_vec();
    bytemuck::pod_collect_to_vec(&bytes)
}

pub(super) fn grid(low: f32, high: f32, steps: usize) -> impl Iterator<Item = f32> + Clone {
    (0..=steps).map(move |i| low + (high - low) * i as f32 / steps as f32)
}

/// Simpson's rule.
pub(super) fn integral(from: f64, to: f64, value: impl Fn(f64) -> f64) -> f64 {
    const STEPS: usize = 512;
    let h = (to - from) / STEPS as f64;
    let sum: f64 = (0..=STEPS)
        .map(|i| {
            let weight = match i {
                0 | STEPS => 1.0,
                i if i % 2 == 1 => 4.0,
                _ => 2.0,
            };
            weight * value(from + h * i as f64)
        })
        .sum();
    sum * h / 3.0
}

/// The light of a slice between the direction to the eye and an angle, by its definition.
fn slice_light(angle: f64, normal_angle: f64) -> f64 {
    integral(0.0, angle, |t| (t - normal_angle).cos() * t.sin().abs()).abs()
}

#[test]
fn the_light_of_a_slice_is_its_integral() {
    let angles: Vec<[f64; 2]> = grid(-0.5, 0.5, 40)
        .flat_map(|n| grid(n - 0.5, n + 0.5, 40).map(move |angle| [angle, n]))
        .map(|turns| turns.map(|turn| f64::from(turn) * PI))
        .collect();
    let inputs: Vec<[f32; 4]> = (angles.iter())
        .map(|[angle, n]| [angle.sin(), angle.cos(), n.sin(), n.cos()].map(|x| x as f32))
        .collect();
    let statements = "var slice: Slice;
        slice.sin_normal = x.z;
        slice.cos_normal = max(x.w, 0.0);
        slice.light = whole_arc(slice);
        slice.low = low_arc(slice);
        let side = select(1.0, -1.0, x.x < 0.0);
        y = vec4f(arc(slice, side, x.y), share_of(shares_of(slice), slice, side, x.xy), slice.light, 0.0);";
    let source = Source::of_technique("vbao");
    for (&[angle, n], found) in angles.iter().zip(on_gpu(&source, statements, &[], &inputs)) {
        let found = found.map(f64::from);
        let exact = slice_light(angle, n);
        assert!(
            (found[0] - exact).abs() < 2e-6,
            "{angle}, {n}: {found:?}, {exact}"
        );
        let below = slice_light(n - FRAC_PI_2, n);
        let whole = below + slice_light(n + FRAC_PI_2, n);
        assert!((found[2] - whole).abs() < 2e-6, "{n}: {found:?}, {whole}");
        let share = (below + exact.copysign(angle)) / whole;
        assert!(
            // As good as its arc cosine, which is a three-hundredth of a sector.
            (found[1] - share).abs() < 1e-4,
            "{angle}, {n}: {found:?}, {share}"
        );
    }
}

#[test]
fn the_arc_cosine_is_the_angle() {
    let inputs: Vec<[f32; 4]> = grid(-1.0, 1.0, 20_000)
        .map(|cosine| [cosine, 0.0, 0.0, 0.0])
        .collect();
    let source = Source::of_technique("gtao");
    let found = on_gpu(&source, "y.x = arc_cosine(x.x);", &[], &inputs);
    for (input, found) in inputs.iter().zip(found) {
        let exact = f64::from(input[0]).acos();
        assert!(
            (f64::from(found[0]) - exact).abs() < 5e-7,
            "{input:?}: {found:?}, {exact}"
        );
    }
}

/// A sector is closed where its middle lies between the two shares.
#[test]
fn sectors_close_by_their_middles() {
    let inputs: Vec<[f32; 4]> = grid(0.0, 1.0, 97)
        .flat_map(|a| grid(0.0, 1.0, 53).map(move |b| [a, b, 0.0, 0.0]))
        .collect();
    let source = Source::of_technique("vbao");
    let statements = "let mask = sectors(x.x, x.y);
        y = vec4f(f32(mask & 0xffffu), f32(mask >> 16u), 0.0, 0.0);";
    for (input, found) in inputs.iter().zip(on_gpu(&source, statements, &[], &inputs)) {
        let mask = found[0] as u32 | (found[1] as u32) << 16;
        let (low, high) = (input[0].min(input[1]), input[0].max(input[1]));
        for sector in 0..32 {
            let middle = (sector as f32 + 0.5) / 32.0;
            // A middle that is met exactly may fall to either side.
            if (middle - low).abs() > 1e-6 && (middle - high).abs() > 1e-6 {
                let closed = middle > low && middle < high;
                assert_eq!(
                    mask >> sector & 1 == 1,
                    closed,
                    "{input:?}, sector {sector}"
                );
            }
        }
    }
}

/// Every cell once, each beside the last.
#[test]
fn the_hilbert_curve_visits_every_pixel_and_never_jumps() {
    let inputs: Vec<[f32; 4]> = (0..64 * 64)
        .map(|i| [(i % 64) as f32, (i / 64) as f32, 0.0, 0.0])
        .collect();
    let statements = "y.x = f32(hilbert_index(vec2i(x.xy)));";
    let source = Source::of_technique("gtao");
    let found = on_gpu(&source, statements, &[], &inputs);
    let mut order = vec![None; 64 * 64];
    for (input, found) in inputs.iter().zip(found) {
        let place = order[found[0] as usize].replace([input[0], input[1]]);
        assert_eq!(place, None, "two pixels have index {}", found[0]);
    }
    for pair in order.windows(2) {
        let [[ax, ay], [bx, by]] = [pair[0].unwrap(), pair[1].unwrap()];
        assert_eq!((ax - bx).abs() + (ay - by).abs(), 1.0, "{pair:?}");
    }
}

/// Directions survive their two numbers.
#[test]
fn octahedral_directions_come_back() {
    let inputs: Vec<[f32; 4]> = grid(-1.0, 1.0, 60)
        .flat_map(|z| {
            grid(0.0, 2.0 * PI as f32, 60).map(move |turn| {
                let across = (1.0 - z * z).max(0.0).sqrt();
                [across * turn.cos(), across * turn.sin(), z, 0.0]
            })
        })
        .collect();
    let statements = "let packed = pack2x16snorm(octahedral_encode(x.xyz));
        y = vec4f(octahedral_decode(unpack2x16snorm(packed)), 0.0);";
    let source = Source {
        wgsl: "//!use octahedral\n".into(),
        params: String::new(),
    };
    for (input, found) in inputs.iter().zip(on_gpu(&source, statements, &[], &inputs)) {
        let [a, b] =
            [*input, found].map(|v| glam::DVec3::new(v[0].into(), v[1].into(), v[2].into()));
        let apart = a.normalize().angle_between(b.normalize()).to_degrees();
        assert!(
            apart < 0.004,
            "{input:?} came back as {found:?}, {apart} degrees off"
        );
    }
}

/// A point of the picture at a depth is where the camera says, and is seen at that point again: from
/// a hundredth of a metre to a hundred kilometres.
#[test]
fn positions_and_pixels_are_each_others_inverse() {
    let request = request("gtao");
    let frame = FrameUniform::new(&request, (160, 120));
    let inputs: Vec<[f32; 4]> = grid(-2.0, 5.0, 28)
        .flat_map(|power| {
            grid(0.0, 160.0, 16).flat_map(move |x| {
                grid(0.0, 120.0, 12).map(move |y| [x, y, 10.0_f32.powf(power), 0.0])
            })
        })
        .collect();
    let source = Source::of_technique("gtao");
    let bound: [(u32, &[u8]); 1] = [(0, bytemuck::bytes_of(&frame))];
    let positions = on_gpu(
        &source,
        "y = vec4f(view_position(x.xy, x.z), 0.0);",
        &bound,
        &inputs,
    );
    let pixels = on_gpu(
        &source,
        "y = vec4f(project_px(view_position(x.xy, x.z)), 0.0, 0.0);",
        &bound,
        &inputs,
    );
    let half_height = (f64::from(request.camera.vertical_fov_rad) / 2.0).tan();
    for ((input, position), pixel) in inputs.iter().zip(positions).zip(pixels) {
        let [x, y, depth, _] = input.map(f64::from);
        let exact = [
            (x / 80.0 - 1.0) * half_height * 160.0 / 120.0 * depth,
            (1.0 - y / 60.0) * half_height * depth,
            -depth,
        ];
        for (found, exact) in position.iter().zip(exact) {
            assert!(
                (f64::from(*found) - exact).abs() < 1e-6 * depth,
                "{input:?}: {position:?}"
            );
        }
        let back = (pixel[0] - input[0]).hypot(pixel[1] - input[1]);
        assert!(back < 1e-4, "{input:?} is seen at {pixel:?}");
    }
}

/// Both falloffs of blizzard, as they are written in their sources.
#[test]
fn falloffs_are_those_of_their_sources() {
    let (near, far) = (0.1_f64, 2.0_f64);
    let (scale, power) = (3.0_f64, 1.5_f64);
    for filion in [false, true] {
        let mut settings = Settings::from_label("blizzard").unwrap();
        for (name, value) in [
            ("distance_scale_per_m", scale),
            ("near_threshold_m", near),
            ("far_threshold_m", far),
            ("power", power),
        ] {
            settings.set(name, value).unwrap();
        }
        settings
            .set("mode", if filion { "filion" } else { "thesis" })
            .unwrap();
        let inputs: Vec<[f32; 4]> = grid(0.0, 3.0, 601).map(|d| [d, 0.0, 0.0, 0.0]).collect();
        let source = Source::of(&settings);
        for (input, found) in
            (inputs.iter()).zip(on_gpu(&source, "y.x = openness(x.x);", &[], &inputs))
        {
            let d = f64::from(input[0]);
            if (d - near).abs() < 1e-6 || (d - far).abs() < 1e-6 {
                continue;
            }
            let exact = match (filion, d) {
                (false, d) if d < near || d > far => 1.0,
                (false, d) => (1.0 / (1.0 + (scale * d).powi(2))).powf(power),
                (true, d) if d <= 0.0 => 1.0,
                (true, d) => ((d - near) / (far - near)).clamp(0.0, 1.0).powf(power),
            };
            assert!(
                (f64::from(found[0]) - exact).abs() < 1e-5,
                "{filion} {d}: {found:?}, {exact}"
            );
        }
    }
}
