//! The window of the system: events in, frames out. Decides nothing about models or views.
//!
//! A frame is drawn when the system asks for one, when there was input, or when the contents ask
//! for one at some time; else the loop sleeps.

mod stage;

use std::sync::{Arc, OnceLock};
use std::time::{Duration, Instant};

use convert::command::messages;
use egui::Context;
use egui_winit::State;
use winit::application::ApplicationHandler;
use winit::dpi::{LogicalSize, PhysicalPosition};
use winit::event::{StartCause, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoop, EventLoopProxy};
use winit::monitor::MonitorHandle;
use winit::window::{Window, WindowId};

use crate::cli::args::Args;
use crate::cli::screen::Screen;
use crate::config::Config;
use crate::load::Device;
use crate::ui::{App, Start};
use stage::Stage;

/// Something asks for a frame after so long.
struct Wake(Duration);

/// Shows a window until it is closed. Errors are whole lines.
///
/// # Errors
///
/// When there is no display, or no graphics adapter.
pub fn run(args: &Args, screen: &Screen) -> Result<(), String> {
    let since = Instant::now();
    let device = Device::begin(args.adapter());
    let plain = |why: &dyn std::fmt::Display| {
        messages::error(&format!(
            "there is no window to be had: {why}; with --output PNG none is needed"
        ))
    };
    // Reading begins before there is a loop: what comes until then is taken with the first frame.
    let proxy = Arc::new(OnceLock::new());
    let ctx = Context::default();
    wake_by(&ctx, Arc::clone(&proxy));
    let waker = Arc::clone(&proxy);
    let start = Start {
        args: args.clone(),
        device,
        since,
        config_path: Config::path(),
        // The context says nothing while the pass it has asked for is still to come.
        wake: Arc::new(move || wake(&waker, Duration::ZERO)),
    };
    let mut shell = Shell {
        app: App::new(start, &ctx),
        ctx,
        window: None,
        next: None,
        failure: None,
        screen,
        is_told: false,
    };
    let event_loop = EventLoop::<Wake>::with_user_event()
        .build()
        .map_err(|error| plain(&error))?;
    proxy.get_or_init(|| event_loop.create_proxy());
    event_loop
        .run_app(&mut shell)
        .map_err(|error| plain(&error))?;
    match shell.failure {
        Some(why) => Err(messages::error(&why)),
        None => Ok(()),
    }
}

/// Lets any thread ask for a frame.
fn wake_by(ctx: &Context, proxy: Arc<OnceLock<EventLoopProxy<Wake>>>) {
    ctx.set_request_repaint_callback(move |info| wake(&proxy, info.delay));
}

fn wake(proxy: &OnceLock<EventLoopProxy<Wake>>, delay: Duration) {
    if let Some(proxy) = proxy.get() {
        // A loop that has ended needs no frame.
        let _ = proxy.send_event(Wake(delay));
    }
}

struct Shell<'a> {
    app: App,
    ctx: Context,
    window: Option<Open>,
    /// When a frame is due.
    next: Option<Instant>,
    failure: Option<String>,
    screen: &'a Screen,
    is_told: bool,
}

/// A window that is open.
struct Open {
    window: Arc<Window>,
    input: State,
    stage: Stage,
    /// The device that the stage is made with.
    revision: u64,
    title: String,
}

impl ApplicationHandler<Wake> for Shell<'_> {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        if self.window.is_some() {
            return;
        }
        match self.open(event_loop) {
            Ok(open) => {
                open.window.request_redraw();
                self.window = Some(open);
            }
            Err(why) => {
                self.failure = Some(why);
                event_loop.exit();
            }
        }
    }

    fn new_events(&mut self, _: &ActiveEventLoop, cause: StartCause) {
        if let StartCause::ResumeTimeReached { .. } = cause {
            self.next = None;
            self.redraw();
        }
    }

    fn user_event(&mut self, event_loop: &ActiveEventLoop, Wake(delay): Wake) {
        if delay.is_zero() {
            self.redraw();
            return;
        }
        if let Some(due) = Instant::now().checked_add(delay) {
            let next = self.next.map_or(due, |next| next.min(due));
            self.next = Some(next);
            event_loop.set_control_flow(ControlFlow::WaitUntil(next));
        }
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let Some(open) = &mut self.window else {
            return;
        };
        match event {
            WindowEvent::CloseRequested => event_loop.exit(),
            WindowEvent::RedrawRequested => self.draw(event_loop),
            event => {
                if let WindowEvent::Resized(size) = event {
                    open.stage.resize(size.width, size.height);
                    if !open.window.is_maximized() {
                        let size = size.to_logical::<f32>(open.window.scale_factor());
                        self.app.config.window = [size.width, size.height];
                    }
                    self.app.config.is_maximized = open.window.is_maximized();
                }
                if open.input.on_window_event(&open.window, &event).repaint {
                    open.window.request_redraw();
                }
            }
        }
    }

    fn exiting(&mut self, event_loop: &ActiveEventLoop) {
        // Not every system tells of moves.
        if let Some(open) = &self.window
            && !open.window.is_maximized()
            && let Ok(place) = open.window.outer_position().map(|p| [p.x, p.y])
            // A window that is only an icon has a place beyond all screens.
            && event_loop.available_monitors().any(|m| shows(&m, place))
        {
            self.app.config.place = Some(place);
        }
        self.app.remember();
    }

    fn about_to_wait(&mut self, event_loop: &ActiveEventLoop) {
        if self.app.quits || self.failure.is_some() {
            event_loop.exit();
        }
        event_loop.set_control_flow(match self.next {
            Some(next) => ControlFlow::WaitUntil(next),
            None => ControlFlow::Wait,
        });
    }
}

/// Whether a window at a place could be seen and moved: a screen may be gone.
fn shows(monitor: &MonitorHandle, [x, y]: [i32; 2]) -> bool {
    /// Pixels of a title bar that are to be on the screen.
    const BAR: [i64; 2] = [100, 10];
    /// Pixels of a border that may be beyond it.
    const BORDER: i64 = 16;
    let (from, size) = (monitor.position(), monitor.size());
    let is_within = |at: i32, from: i32, length: u32, least: i64| {
        let from = i64::from(from);
        (from - BORDER..=from + i64::from(length) - least).contains(&i64::from(at))
    };
    is_within(x, from.x, size.width, BAR[0]) && is_within(y, from.y, size.height, BAR[1])
}

impl Shell<'_> {
    fn open(&mut self, event_loop: &ActiveEventLoop) -> Result<Open, String> {
        let [width, height] = self.app.config.window;
        let mut attributes = Window::default_attributes()
            .with_title(self.app.title())
            .with_inner_size(LogicalSize::new(width, height))
            .with_maximized(self.app.config.is_maximized);
        if let Some([x, y]) = self.app.config.place
            && event_loop.available_monitors().any(|m| shows(&m, [x, y]))
        {
            attributes = attributes.with_position(PhysicalPosition::new(x, y));
        }
        let window = event_loop
            .create_window(attributes)
            .map_err(|error| format!("the window could not be opened: {error}"))?;
        let window = Arc::new(window);
        let gpu = self.app.device.wait()?;
        let stage = Stage::new(gpu, Arc::clone(&window))?;
        let input = State::new(
            self.ctx.clone(),
            egui::ViewportId::ROOT,
            &window,
            Some(window.scale_factor() as f32),
            window.theme(),
            Some(stage.largest_texture()),
        );
        Ok(Open {
            window,
            input,
            stage,
            revision: self.app.device_revision,
            title: String::new(),
        })
    }

    fn redraw(&self) {
        if let Some(open) = &self.window {
            open.window.request_redraw();
        }
    }

    fn draw(&mut self, event_loop: &ActiveEventLoop) {
        if let Some(wait) = self.app.first_wait(&self.ctx) {
            let due = Instant::now() + wait;
            self.next = Some(self.next.map_or(due, |next| next.min(due)));
            return;
        }
        let Some(open) = &mut self.window else {
            return;
        };
        if open.revision != self.app.device_revision {
            match self.open_again() {
                Ok(()) => {}
                Err(why) => {
                    self.failure = Some(why);
                    event_loop.exit();
                    return;
                }
            }
        }
        let Some(open) = &mut self.window else {
            return;
        };
        let input = open.input.take_egui_input(&open.window);
        self.app.canvas.texture = Some(open.stage.picture_id());
        let output = self.ctx.run_ui(input, |ui| self.app.show(ui));
        open.input
            .handle_platform_output(&open.window, output.platform_output.clone());
        let pixels_per_point = output.pixels_per_point;
        let primitives = self.ctx.tessellate(output.shapes, pixels_per_point);
        let mut textures = output.textures_delta;
        let painted = open.stage.paint(
            &primitives,
            &mut textures,
            pixels_per_point,
            self.app.picture().map(|(_, picture)| picture),
        );
        if painted {
            self.tell_first_picture();
        } else {
            self.redraw();
        }
        if let Some(open) = &mut self.window {
            let title = self.app.title();
            if title != open.title {
                open.window.set_title(&title);
                open.title = title;
            }
        }
    }

    /// The device was lost: the surface and the interface's own things are made anew.
    fn open_again(&mut self) -> Result<(), String> {
        let gpu = self.app.device.wait()?;
        if let Some(open) = &mut self.window {
            let textures = open.stage.take_textures();
            open.stage = Stage::new(gpu, Arc::clone(&open.window))?;
            open.stage.put_textures(textures);
            open.revision = self.app.device_revision;
        }
        Ok(())
    }

    fn tell_first_picture(&mut self) {
        if self.is_told {
            return;
        }
        if let Some(text) = self.app.first_picture() {
            self.is_told = true;
            self.screen.remark(&text);
        }
    }
}
