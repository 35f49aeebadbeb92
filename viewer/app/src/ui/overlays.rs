//! What is drawn over the picture: which lists there are, and when they are made anew.

use egui::{Slider, Ui};
use glam::{DVec3, DVec4};
use viewer::overlay::{self, Meshes, Overlay, Segment};

use super::command::Command;
use super::state::App;

/// Where a section plane stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Section {
    /// Its normal; what lies on this side is cut away.
    pub normal: DVec3,
    /// From the lowest to the highest point of the model along the normal: 0 to 1.
    pub share: f64,
}

/// What the user wants to see over the picture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Over {
    /// Edges of all triangles.
    pub wireframe: bool,
    /// Borders and creases.
    pub edges: bool,
    /// Corners of all triangles.
    pub points: bool,
    /// Normals.
    pub normals: bool,
    /// Silhouettes as lights see them.
    pub silhouettes: bool,
    /// Shadow volumes.
    pub volumes: bool,
    /// A grid below.
    pub grid: bool,
    /// Axes.
    pub axes: bool,
    /// A plane that cuts.
    pub section: Option<Section>,
}

/// What the lists were made for.
#[derive(Clone, Debug, PartialEq)]
struct MadeFor {
    over: Over,
    revision: u64,
    points: Vec<DVec3>,
    arm: f64,
}

/// The lists, as long as they fit.
#[derive(Default)]
pub struct Overlays {
    meshes: Meshes,
    made_for: Option<MadeFor>,
    made: Overlay,
    /// The step of the grid that is shown.
    pub grid_step: f64,
}

impl App {
    /// Switches one of them.
    pub(super) fn toggle_over(&mut self, command: Command) {
        let over = &mut self.over;
        match command {
            Command::Wireframe => over.wireframe ^= true,
            Command::Edges => over.edges ^= true,
            Command::Points => over.points ^= true,
            Command::Normals => over.normals ^= true,
            Command::Silhouettes => over.silhouettes ^= true,
            Command::Volumes => over.volumes ^= true,
            Command::Grid => over.grid ^= true,
            Command::Axes => over.axes ^= true,
            Command::Section => {
                over.section = match over.section {
                    Some(_) => None,
                    None => Some(Section {
                        normal: DVec3::X,
                        share: 0.5,
                    }),
                };
            }
            _ => {}
        }
        let gpu = self.model.as_ref().map(|m| &m.renderer.gpu);
        let lacks = gpu.is_some_and(|gpu| {
            over.wireframe && !gpu.has_wireframe || over.points && !gpu.has_points
        });
        if lacks {
            self.fail("the graphics adapter cannot draw triangles as lines or points".to_owned());
        }
    }

    /// Whether one of them is switched on.
    pub(super) fn is_over(&self, command: Command) -> Option<bool> {
        let over = &self.over;
        Some(match command {
            Command::Wireframe => over.wireframe,
            Command::Edges => over.edges,
            Command::Points => over.points,
            Command::Normals => over.normals,
            Command::Silhouettes => over.silhouettes,
            Command::Volumes => over.volumes,
            Command::Grid => over.grid,
            Command::Axes => over.axes,
            Command::Section => over.section.is_some(),
            _ => return None,
        })
    }

    /// Puts what is wanted into the settings of the next picture.
    pub(super) fn settle_overlay(&mut self) {
        self.settings.section = self.section_plane();
        let selected = self.selected_instances();
        let arm = self
            .navigator
            .as_ref()
            .map_or(1.0, |n| n.half_height() * 0.02);
        let Some(model) = &self.model else {
            return;
        };
        let made_for = MadeFor {
            over: self.over,
            revision: model.revision,
            points: self.measure.points.clone(),
            arm: if self.measure.points.is_empty() {
                0.0
            } else {
                arm
            },
        };
        if self.overlays.made_for.as_ref() != Some(&made_for) {
            let lists = &mut self.overlays;
            let (scene, content) = (&model.scene, model.renderer.content());
            let mut segments: Vec<Segment> = Vec::new();
            if made_for.over.grid {
                let (lines, step) = overlay::grid(content, model.up);
                segments.extend(lines);
                lists.grid_step = step;
            }
            if made_for.over.axes {
                segments.extend(overlay::axes(content));
            }
            if made_for.over.edges {
                segments.extend(overlay::edges(scene, content, &mut lists.meshes));
            }
            if made_for.over.normals {
                segments.extend(overlay::normals(scene, content));
            }
            if made_for.over.silhouettes {
                segments.extend(overlay::silhouettes(scene, content, &mut lists.meshes));
            }
            segments.extend(overlay::marks(content, &made_for.points, arm));
            segments.truncate(overlay::MOST);
            let caps = match self.settings.section {
                Some(plane) => overlay::caps(scene, content, &mut lists.meshes, plane),
                None => Vec::new(),
            };
            lists.made = Overlay {
                has_wireframe: made_for.over.wireframe,
                has_corners: made_for.over.points,
                has_volumes: made_for.over.volumes,
                segments: segments.into(),
                caps: caps.into(),
                ..Overlay::default()
            };
            lists.made_for = Some(made_for);
        }
        let selected = selected.into_iter().map(|i| i as u32).collect();
        self.settings.overlay = Overlay {
            selected,
            ..self.overlays.made.clone()
        };
    }

    /// The plane that cuts, in the world.
    pub(super) fn section_plane(&self) -> Option<DVec4> {
        let section = self.over.section?;
        let bounds = self.model.as_ref()?.renderer.content().bounds;
        if bounds.is_empty() {
            return None;
        }
        let reach = section.normal.abs().dot(bounds.size()) * 0.5;
        let middle = section.normal.dot(bounds.center());
        let at = middle + reach * (2.0 * section.share - 1.0);
        Some(section.normal.extend(-at))
    }

    pub(super) fn section(&mut self, ui: &mut Ui) {
        let plane = self.section_plane();
        let forward = self.navigator.as_ref().map(|n| n.view.forward());
        let Some(section) = &mut self.over.section else {
            return;
        };
        ui.horizontal(|ui| {
            ui.label("Cut along");
            for (name, axis) in [("X", DVec3::X), ("Y", DVec3::Y), ("Z", DVec3::Z)] {
                let is_this = section.normal.abs() == axis;
                if ui.selectable_label(is_this, name).clicked() {
                    section.normal = axis;
                }
            }
            if let Some(forward) = forward
                && ui.button("View").clicked()
            {
                section.normal = -forward;
            }
            if ui.button("Flip").clicked() {
                section.normal = -section.normal;
                section.share = 1.0 - section.share;
            }
        });
        ui.add(Slider::new(&mut section.share, 0.0..=1.0).show_value(false));
        if let Some(plane) = plane {
            ui.weak(format!(
                "at {:.3}; shadows are those of the whole model",
                -plane.w
            ));
        }
    }

    pub(super) fn overlay_switches(&mut self, ui: &mut Ui) {
        use super::command::{ALL, Menu};
        let entries = ALL.iter().filter(|e| e.menu == Menu::Show);
        let mut toggled = None;
        ui.horizontal_wrapped(|ui| {
            for entry in entries {
                if let Some(is_on) = self.is_over(entry.command)
                    && ui.selectable_label(is_on, entry.text).clicked()
                {
                    toggled = Some(entry.command);
                }
            }
        });
        if let Some(command) = toggled {
            self.toggle_over(command);
        }
        if self.over.grid {
            ui.weak(format!(
                "A square of the grid is {} wide.",
                self.overlays.grid_step
            ));
        }
    }
}
