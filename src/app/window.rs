//! The window and its event loop.
//!
//! eframe runs the event loop inside [`Watch`], which sees every event before
//! and after eframe does. That gives the two times an experiment needs and egui
//! does not hand out: when a key or button press arrived, and when the call that
//! drew and presented a frame returned. The second is an estimate of the onset,
//! not the onset: no portable interface says when the display showed a frame.

use std::cell::{Cell, RefCell};
use std::rc::Rc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::time::Instant;

use eframe::{EframeWinitApplication, NativeOptions, UserEvent, egui};
use egui_wgpu::{SurfaceErrorAction, WgpuConfiguration, WgpuSetup, WgpuSetupCreateNew, wgpu};
use winit::application::ApplicationHandler;
use winit::event::{ElementState, WindowEvent};
use winit::event_loop::{ActiveEventLoop, EventLoop};
use winit::window::{Window, WindowId};

use super::error::AppError;

/// What the window tells its content besides egui's own input.
pub trait Content {
    /// One pass of the interface.
    fn ui(&mut self, ui: &mut egui::Ui);
    /// The window is there; called once, before the first pass.
    fn opened(&mut self, ctx: &egui::Context, window: Option<Arc<Window>>);
    /// A key or a pointer button went down (auto-repeat excepted).
    fn pressed(&mut self, at: Instant);
    /// The last pass was drawn and handed to the display; the call returned at `at`.
    fn presented(&mut self, ctx: &egui::Context, at: Instant);
    /// Grey level (8-bit sRGB) behind everything.
    fn clear_level(&self) -> u8;
}

/// Opens a window of the given size, in points, and runs until it closes.
///
/// # Errors
/// [`AppError`] if there is no display, no adapter, or the window system fails.
pub fn run(
    title: &str,
    size_points: [u32; 2],
    content: &Rc<RefCell<dyn Content>>,
) -> Result<(), AppError> {
    let event_loop = event_loop().map_err(|error| AppError::NoDisplay {
        detail: error.to_string(),
    })?;
    tracing::debug!("event loop ready");
    let dropped = Arc::new(AtomicBool::new(false));
    let adapter_failure = Arc::new(Mutex::new(None));
    let options = native_options(title, size_points, &dropped, &adapter_failure);
    let context: Rc<RefCell<Option<egui::Context>>> = Rc::default();
    let closed = Rc::new(Cell::new(false));

    let creator = {
        let (content, context) = (Rc::clone(content), Rc::clone(&context));
        let closed = Rc::clone(&closed);
        Box::new(move |creation: &eframe::CreationContext<'_>| {
            *context.borrow_mut() = Some(creation.egui_ctx.clone());
            content
                .borrow_mut()
                .opened(&creation.egui_ctx, creation.winit_window().cloned());
            Ok(Box::new(Face { content, closed }) as Box<dyn eframe::App>)
        })
    };
    let mut watch = Watch {
        eframe: eframe::create_native("greyfield", options, creator, &event_loop),
        content: Rc::clone(content),
        context: Rc::clone(&context),
        dropped,
        closed,
    };
    event_loop.run_app(&mut watch)?;

    if context.borrow().is_some() {
        return Ok(());
    }
    // eframe keeps the reason to itself; without an adapter it never gets as far
    // as making its content.
    let detail = adapter_failure.lock().ok().and_then(|mut text| text.take());
    Err(AppError::NoAdapter {
        detail: detail.unwrap_or_else(|| String::from("no Vulkan driver answered")),
    })
}

/// The event loop of the process; there can be one. Where the window system allows
/// it, on any thread: tests run on threads of their own.
fn event_loop() -> Result<EventLoop<UserEvent>, winit::error::EventLoopError> {
    #[cfg_attr(any(windows, target_os = "macos"), allow(unused_mut))]
    let mut builder = EventLoop::<UserEvent>::with_user_event();
    #[cfg(all(unix, not(target_os = "macos")))]
    {
        use winit::platform::x11::EventLoopBuilderExtX11 as _;
        builder.with_any_thread(true);
    }
    builder.build()
}

/// eframe's handle on the content.
struct Face {
    content: Rc<RefCell<dyn Content>>,
    /// Set when eframe has let go of the window.
    closed: Rc<Cell<bool>>,
}

impl eframe::App for Face {
    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut eframe::Frame) {
        self.content.borrow_mut().ui(ui);
    }

    fn clear_color(&self, _visuals: &egui::Visuals) -> [f32; 4] {
        let level = f32::from(self.content.borrow().clear_level()) / 255.0;
        [level, level, level, 1.0]
    }

    fn on_exit(&mut self) {
        self.closed.set(true);
    }
}

/// eframe's event handler with a stopwatch round it.
struct Watch<'a> {
    eframe: EframeWinitApplication<'a>,
    content: Rc<RefCell<dyn Content>>,
    context: Rc<RefCell<Option<egui::Context>>>,
    /// Set by the surface when a frame could not be presented.
    dropped: Arc<AtomicBool>,
    closed: Rc<Cell<bool>>,
}

impl ApplicationHandler<UserEvent> for Watch<'_> {
    fn window_event(&mut self, event_loop: &ActiveEventLoop, id: WindowId, event: WindowEvent) {
        if is_press(&event) {
            self.content.borrow_mut().pressed(Instant::now());
        }
        let redraw = matches!(event, WindowEvent::RedrawRequested);
        self.eframe.window_event(event_loop, id, event);
        if !redraw || self.closed.get() {
            return;
        }
        let at = Instant::now();
        let context = self.context.borrow().clone();
        let Some(context) = context else { return };
        if self.dropped.swap(false, Ordering::Relaxed) {
            context.request_repaint();
        } else {
            self.content.borrow_mut().presented(&context, at);
        }
    }

    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        self.eframe.resumed(event_loop);
    }

    fn new_events(&mut self, event_loop: &ActiveEventLoop, cause: winit::event::StartCause) {
        self.eframe.new_events(event_loop, cause);
    }

    fn user_event(&mut self, event_loop: &ActiveEventLoop, event: UserEvent) {
        self.eframe.user_event(event_loop, event);
    }

    fn device_event(
        &mut self,
        event_loop: &ActiveEventLoop,
        id: winit::event::DeviceId,
        event: winit::event::DeviceEvent,
    ) {
        self.eframe.device_event(event_loop, id, event);
    }

    fn about_to_wait(&mut self, event_loop: &ActiveEventLoop) {
        self.eframe.about_to_wait(event_loop);
        // eframe waits for the window to be destroyed, but the content may hold on to it.
        if self.closed.get() {
            event_loop.exit();
        }
    }

    fn suspended(&mut self, event_loop: &ActiveEventLoop) {
        self.eframe.suspended(event_loop);
    }

    fn exiting(&mut self, event_loop: &ActiveEventLoop) {
        self.eframe.exiting(event_loop);
    }

    fn memory_warning(&mut self, event_loop: &ActiveEventLoop) {
        self.eframe.memory_warning(event_loop);
    }
}

fn is_press(event: &WindowEvent) -> bool {
    match event {
        WindowEvent::KeyboardInput {
            event,
            is_synthetic: false,
            ..
        } => event.state == ElementState::Pressed && !event.repeat,
        WindowEvent::MouseInput { state, .. } => *state == ElementState::Pressed,
        _ => false,
    }
}

fn native_options(
    title: &str,
    size_points: [u32; 2],
    dropped: &Arc<AtomicBool>,
    adapter_failure: &Arc<Mutex<Option<String>>>,
) -> NativeOptions {
    NativeOptions {
        viewport: egui::ViewportBuilder::default()
            .with_title(title)
            .with_app_id("greyfield")
            .with_icon(icon())
            .with_inner_size(egui::vec2(size_points[0] as f32, size_points[1] as f32)),
        renderer: eframe::Renderer::Wgpu,
        multisampling: 0,
        // Dithering adds noise to levels between two bytes; a stimulus has none,
        // but one rounding error would be enough.
        dithering: false,
        centered: true,
        wgpu_options: WgpuConfiguration {
            surface: eframe::SurfaceConfig {
                // Every adapter has it, and it never tears: what the automatic choice prefers
                // where it can shows a late frame in the middle of a refresh.
                present_mode: wgpu::PresentMode::Fifo,
                desired_maximum_frame_latency: Some(1),
            },
            wgpu_setup: setup(Arc::clone(adapter_failure)),
            on_surface_status: surface_status(Arc::clone(dropped)),
        },
        ..NativeOptions::default()
    }
}

/// What to do with a frame that could not be acquired, as eframe does by default;
/// and a note that it was not shown.
fn surface_status(
    dropped: Arc<AtomicBool>,
) -> Arc<dyn Fn(&wgpu::CurrentSurfaceTexture) -> SurfaceErrorAction + Send + Sync> {
    let default = WgpuConfiguration::default().on_surface_status;
    Arc::new(move |status| {
        dropped.store(true, Ordering::Relaxed);
        default(status)
    })
}

/// Takes the first adapter that can draw to the window, real ones before software.
fn setup(failure: Arc<Mutex<Option<String>>>) -> WgpuSetup {
    let mut setup = WgpuSetupCreateNew::without_display_handle();
    // The ones the pixels were tested on, whatever else the build brings along.
    setup.instance_descriptor.backends =
        wgpu::Backends::VULKAN | wgpu::Backends::METAL | wgpu::Backends::DX12;
    setup.native_adapter_selector = Some(Arc::new(move |adapters, surface| {
        let able = |adapter: &&wgpu::Adapter| {
            surface.is_none_or(|surface| adapter.is_surface_supported(surface))
        };
        let chosen = adapters.iter().filter(able).min_by_key(|adapter| {
            match adapter.get_info().device_type {
                wgpu::DeviceType::DiscreteGpu => 0,
                wgpu::DeviceType::IntegratedGpu => 1,
                wgpu::DeviceType::VirtualGpu => 2,
                wgpu::DeviceType::Other => 3,
                wgpu::DeviceType::Cpu => 4,
            }
        });
        if let Some(adapter) = chosen {
            tracing::debug!(adapter = ?adapter.get_info(), "adapter chosen");
        }
        chosen.cloned().ok_or_else(|| {
            let names: Vec<String> = adapters.iter().map(|a| a.get_info().name).collect();
            let detail = if names.is_empty() {
                String::from("no Vulkan driver was found")
            } else {
                format!("found only {}, which cannot", names.join(", "))
            };
            if let Ok(mut slot) = failure.lock() {
                *slot = Some(detail.clone());
            }
            detail
        })
    }));
    WgpuSetup::CreateNew(setup)
}

/// Two grey fields side by side.
fn icon() -> egui::IconData {
    const SIDE: u32 = 64;
    let pixel = |x: u32, y: u32| -> [u8; 4] {
        let inside = (12..52).contains(&y);
        match x {
            6..30 if inside => [96, 96, 96, 255],
            34..58 if inside => [176, 176, 176, 255],
            _ => [0, 0, 0, 0],
        }
    };
    egui::IconData {
        rgba: (0..SIDE * SIDE)
            .flat_map(|at| pixel(at % SIDE, at / SIDE))
            .collect(),
        width: SIDE,
        height: SIDE,
    }
}
