//! The picture in the middle: what the mouse does there, and when the scene is drawn.

use std::time::{Duration, Instant};

use egui::{Context, Key, PointerButton, Rect, Response, Sense, TextureId, Ui, pos2};
use glam::{DVec2, DVec3};
use viewer::frame::{Plan, Settings};
use viewer::gpu::{FrameReport, Gpu};
use viewer::navigate::Navigator;
use viewer::view::{Lens, Region, View};

use super::state::App;

/// Half a turn for a drag over the height of the picture.
const RADIANS_PER_HEIGHT: f64 = std::f64::consts::PI;
/// What a picture may take while the view moves.
const MOVING: Duration = Duration::from_millis(50);
/// After so long without a move the picture is drawn as sharp as it can be.
const REST: Duration = Duration::from_millis(200);
/// Smallest part of the resolution while moving.
const COARSEST: f64 = 0.25;
/// Times kept for the graph.
const HISTORY: usize = 120;
/// Of the half height seen at the pivot, flown in a second.
const FLIGHT: f64 = 1.5;
/// How much nearer a step of the wheel (50 points) brings: a tenth.
const ZOOM_PER_POINT: f64 = 0.002;

/// All that a picture depends on.
#[derive(Clone, Debug, PartialEq)]
struct Wanted {
    view: View,
    size: (u32, u32),
    settings: Settings,
    revision: u64,
}

/// The picture, and how it came about.
#[derive(Default)]
pub struct Canvas {
    /// The host's name for the picture.
    pub texture: Option<TextureId>,
    drawn: Option<Wanted>,
    /// What the last picture consists of, and what it took.
    pub last: Option<(Plan, FrameReport)>,
    /// How long pictures took, the last one at the end.
    pub history: Vec<Duration>,
    /// Where it is on the screen, points.
    pub rect: Option<Rect>,
    /// Pixels.
    pub size: (u32, u32),
    scale: f64,
    moved: Option<Instant>,
    drag_pivot: Option<DVec3>,
    /// What lies below the mouse.
    pub(super) below: Option<DVec3>,
}

impl Canvas {
    /// Forgets the picture, whose device is gone.
    pub(super) fn forget(&mut self) {
        self.drawn = None;
        self.last = None;
    }

    /// The size to draw at: coarser while the view moves, if sharp pictures take too long.
    fn drawn_size(&mut self, is_moving: bool) -> (u32, u32) {
        let scale = if is_moving {
            self.scale.clamp(COARSEST, 1.0)
        } else {
            1.0
        };
        let side = |pixels: u32| ((f64::from(pixels) * scale).round() as u32).max(1);
        (side(self.size.0), side(self.size.1))
    }

    /// Learns from the time that a picture took at which size the next one is to be drawn.
    fn learn(&mut self, took: Duration, size: (u32, u32)) {
        let share = f64::from(size.0) * f64::from(size.1)
            / (f64::from(self.size.0) * f64::from(self.size.1)).max(1.0);
        let whole = took.as_secs_f64() / share.max(1e-6);
        self.scale = (MOVING.as_secs_f64() / whole.max(1e-9)).sqrt().min(1.0);
        self.history.push(took);
        if self.history.len() > HISTORY {
            self.history.remove(0);
        }
    }
}

impl App {
    /// The picture's texture, its device, and whether both are there.
    pub fn picture(&self) -> Option<(&Gpu, &wgpu::TextureView)> {
        let model = self.model.as_ref()?;
        Some((&model.renderer.gpu, model.renderer.picture()?))
    }

    pub(super) fn canvas(&mut self, ui: &mut Ui) {
        let rect = ui.available_rect_before_wrap();
        let response = ui.allocate_rect(rect, Sense::click_and_drag());
        let pixels = ui.ctx().pixels_per_point();
        let side = |points: f32| ((points * pixels).round() as u32).max(1);
        self.canvas.rect = Some(rect);
        self.canvas.size = (side(rect.width()), side(rect.height()));
        if self.model.is_none() {
            self.empty_canvas(ui, rect);
            return;
        }
        self.settle_view();
        self.steer(ui, &response);
        self.settle_overlay();
        self.draw_if_needed(ui.ctx());
        self.paint(ui, rect);
    }

    fn empty_canvas(&self, ui: &Ui, rect: Rect) {
        let text = match &self.loading {
            Some(loading) => format!("{}…", loading.stage.text()),
            None => "Drop a model here, or press Ctrl+O".to_owned(),
        };
        let color = ui.visuals().weak_text_color();
        let font = egui::TextStyle::Heading.resolve(ui.style());
        ui.painter().text(
            rect.center(),
            egui::Align2::CENTER_CENTER,
            text,
            font,
            color,
        );
    }

    fn paint(&self, ui: &Ui, rect: Rect) {
        let Some(texture) = self.canvas.texture.filter(|_| self.canvas.drawn.is_some()) else {
            return;
        };
        let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
        ui.painter()
            .image(texture, rect, whole, egui::Color32::WHITE);
    }

    /// Width over height of the picture.
    pub(super) fn aspect(&self) -> f64 {
        f64::from(self.canvas.size.0) / f64::from(self.canvas.size.1.max(1))
    }

    /// Where one looks from at first, now that the picture has a size.
    fn settle_view(&mut self) {
        let Some(model) = &self.model else {
            return;
        };
        let bounds = model.renderer.content().bounds;
        if let Some(viewpoint) = self.first_view.take() {
            let (view, _) = viewpoint.view(&bounds, self.canvas.size);
            self.set_view(view);
        }
    }

    /// Looks from somewhere else.
    pub(super) fn set_view(&mut self, view: View) {
        let Some(model) = &self.model else {
            return;
        };
        let mut navigator = Navigator::new(view, &model.renderer.content().bounds, model.up);
        if self.config.rolls {
            navigator.turning = viewer::navigate::Turning::Ball;
        }
        self.navigator = Some(navigator);
    }

    /// What the mouse and held keys do to the view.
    fn steer(&mut self, ui: &Ui, response: &Response) {
        let Some(mut navigator) = self.navigator else {
            return;
        };
        let before = navigator.view;
        let height = f64::from(response.rect.height().max(1.0));
        let moved = response.drag_delta();
        let by = DVec2::new(f64::from(moved.x), -f64::from(moved.y)) / height;
        let (shift, held) = ui.input(|i| (i.modifiers.shift, i.keys_down.clone()));
        if response.drag_started() {
            // Where the button was pressed: a drag is known as one only some points further.
            let at = ui.input(|i| i.pointer.press_origin());
            let p = at.and_then(|at| self.p_below(at));
            if let Some(p) = p {
                navigator.set_pivot_depth(p);
            }
            self.canvas.drag_pivot = Some(p.unwrap_or_else(|| navigator.pivot()));
        }
        let angles = DVec2::new(by.x, -by.y) * RADIANS_PER_HEIGHT;
        if response.dragged_by(PointerButton::Middle)
            || response.dragged_by(PointerButton::Primary) && shift
        {
            navigator.pan(by);
        } else if response.dragged_by(PointerButton::Primary) {
            let pivot = self.canvas.drag_pivot.unwrap_or_else(|| navigator.pivot());
            navigator.orbit(angles, pivot);
        } else if response.dragged_by(PointerButton::Secondary) {
            navigator.look_around(angles * half_view(&navigator.view));
            self.fly(&mut navigator, ui, &held);
        }
        if response.hovered() {
            self.wheel(&mut navigator, ui, response, shift, height);
        }
        self.arrows(&mut navigator, ui, shift);
        if navigator.view != before {
            self.canvas.moved = Some(Instant::now());
        }
        self.navigator = Some(navigator);
        if let Some(at) = response.hover_pos()
            && ui.input(|i| i.pointer.delta() != egui::Vec2::ZERO)
        {
            self.canvas.below = self.p_below(at);
        }
        self.click(response);
    }

    fn fly(
        &self,
        navigator: &mut Navigator,
        ui: &Ui,
        held: &std::collections::HashSet<Key, impl std::hash::BuildHasher>,
    ) {
        let axis = |plus: Key, minus: Key| {
            f64::from(i8::from(held.contains(&plus)) - i8::from(held.contains(&minus)))
        };
        let way = DVec3::new(
            axis(Key::D, Key::A),
            axis(Key::E, Key::Q),
            axis(Key::W, Key::S),
        );
        if way != DVec3::ZERO {
            let seconds = ui.input(|i| f64::from(i.stable_dt.min(0.1)));
            navigator.fly(way * navigator.half_height() * FLIGHT * seconds);
            ui.ctx().request_repaint();
        }
    }

    fn wheel(
        &mut self,
        navigator: &mut Navigator,
        ui: &Ui,
        response: &Response,
        shift: bool,
        height: f64,
    ) {
        let (scrolled, pinched) = ui.input(|i| (i.smooth_scroll_delta(), i.zoom_delta()));
        if shift && scrolled != egui::Vec2::ZERO {
            let by = DVec2::new(f64::from(scrolled.x), -f64::from(scrolled.y)) / height;
            navigator.pan(by);
            return;
        }
        let steps = f64::from(scrolled.y) * ZOOM_PER_POINT;
        let factor = (-steps).exp() / f64::from(pinched);
        if factor == 1.0 {
            return;
        }
        let towards = response.hover_pos().map(|at| {
            self.p_below(at)
                .unwrap_or_else(|| self.p_at_pivot(navigator, at))
        });
        navigator.zoom(factor, towards.unwrap_or_else(|| navigator.pivot()));
    }

    fn arrows(&self, navigator: &mut Navigator, ui: &Ui, shift: bool) {
        if ui.ctx().egui_wants_keyboard_input() {
            return;
        }
        let presses = |key| ui.input(|i| i.num_presses(key)) as f64;
        let x = presses(Key::ArrowRight) - presses(Key::ArrowLeft);
        let y = presses(Key::ArrowUp) - presses(Key::ArrowDown);
        if (x, y) != (0.0, 0.0) {
            if shift {
                navigator.pan(DVec2::new(-x, -y) * 0.1);
            } else {
                navigator.orbit(DVec2::new(x, -y) * 15_f64.to_radians(), navigator.pivot());
            }
        }
        let nearer = presses(Key::Plus) + presses(Key::Equals) - presses(Key::Minus);
        if nearer != 0.0 {
            navigator.zoom(0.8_f64.powf(nearer), navigator.pivot());
        }
    }

    /// The point below a place of the screen, at the pivot's depth.
    fn p_at_pivot(&self, navigator: &Navigator, at: egui::Pos2) -> DVec3 {
        let place = self.place_of(at);
        let half = navigator.half_height();
        let view = &navigator.view;
        navigator.pivot()
            + view.right() * (place.x * half * self.aspect())
            + view.up() * (place.y * half)
    }

    /// Where a place of the screen is in the picture: -1 to 1 to the right and upwards.
    fn place_of(&self, at: egui::Pos2) -> DVec2 {
        let Some(rect) = self.canvas.rect else {
            return DVec2::ZERO;
        };
        let part = (at - rect.min) / rect.size();
        DVec2::new(f64::from(part.x) * 2.0 - 1.0, 1.0 - f64::from(part.y) * 2.0)
    }

    fn draw_if_needed(&mut self, ctx: &Context) {
        // Panels that are shown for the first time ask for another pass, with other sizes.
        if ctx.will_discard() {
            return;
        }
        let Some(navigator) = &self.navigator else {
            return;
        };
        let since = self.canvas.moved.map(|at| at.elapsed());
        let is_moving = since.is_some_and(|since| since < REST);
        let size = self.canvas.drawn_size(is_moving);
        let Some(model) = &mut self.model else {
            return;
        };
        let wanted = Wanted {
            view: navigator.view,
            size,
            settings: self.settings.clone(),
            revision: model.revision,
        };
        if is_moving && size != self.canvas.size {
            ctx.request_repaint_after(REST);
        }
        if self.canvas.drawn.as_ref() == Some(&wanted) {
            return;
        }
        let start = Instant::now();
        let region = Region::whole(size.0, size.1);
        match model
            .renderer
            .draw(&wanted.view, &region, size, &wanted.settings)
        {
            Ok((plan, report)) => {
                let took = start.elapsed();
                let is_first = self.canvas.drawn.is_none() && model.times.total.is_zero();
                if is_first {
                    model.times.compile = report.compile;
                    model.times.draw = took.saturating_sub(report.compile);
                }
                self.counters.pictures += 1;
                self.lost_in_a_row = 0;
                // Compiling is done once and says nothing about the next picture.
                self.canvas.learn(took.saturating_sub(report.compile), size);
                self.canvas.last = Some((plan, report));
                self.canvas.drawn = Some(wanted);
            }
            Err(error) => self.recover(&error.to_string()),
        }
    }
}

/// Half the vertical angle of a view as a share of a right angle; looking around turns by what is
/// seen.
fn half_view(view: &View) -> f64 {
    match view.lens {
        Lens::Perspective { tan_half_height } => {
            2.0 * tan_half_height.atan() / std::f64::consts::PI
        }
        Lens::Orthographic { .. } => 0.25,
    }
}
