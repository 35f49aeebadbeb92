//! What is selected, hidden, and below the mouse.

use std::sync::Arc;

use egui::{Pos2, Response};
use geometry::bounds::Aabb;
use glam::DVec3;
use viewer::pick::{Hit, snap};
use viewer::view::Region;

use super::state::App;
use crate::outline::{Item, Outline};

/// What a row is called in its model, to be found again in the next version of it: the labels of
/// the rows around it, from the outside in, and which of several it is.
pub(super) type RowName = (Vec<String>, usize);

/// Within so many pixels a corner or an edge is meant.
const SNAP_PX: f64 = 8.0;

impl App {
    /// Selects what was clicked, or goes there.
    pub(super) fn click(&mut self, response: &Response) {
        let at = response.interact_pointer_pos();
        if response.double_clicked() {
            let p = at.and_then(|at| self.p_below(at));
            if let (Some(p), Some(navigator)) = (p, &mut self.navigator) {
                navigator.seek(p);
            }
        } else if response.clicked() && self.measure.is_active {
            let p = at.and_then(|at| self.snapped(at));
            self.measure.points.extend(p);
        } else if response.clicked() {
            let row = at.and_then(|at| self.row_below(at));
            self.select(row);
        }
    }

    /// Selects a row of the tree, or nothing.
    pub fn select(&mut self, row: Option<usize>) {
        self.selected = row;
        self.reveals_selection = row.is_some();
        let Some(model) = &self.model else {
            return;
        };
        for above in row.into_iter().flat_map(|row| model.outline.ancestors(row)) {
            self.open_rows[above] = true;
        }
    }

    /// What is seen at a place of the screen.
    pub fn hit_below(&mut self, at: Pos2) -> Option<Hit> {
        let rect = self.canvas.rect?;
        let part = (at - rect.min) / rect.size();
        let (width, height) = self.canvas.size;
        let place = [
            f64::from(part.x) * f64::from(width),
            f64::from(part.y) * f64::from(height),
        ];
        let view = self.navigator?.view;
        let section = self.section_plane();
        self.model
            .as_mut()?
            .pick(&view, (width, height), place, section)
    }

    fn row_below(&mut self, at: Pos2) -> Option<usize> {
        let hit = self.hit_below(at)?;
        let outline = &self.model.as_ref()?.outline;
        outline.row_of_instance.get(hit.instance as usize).copied()
    }

    pub(super) fn p_below(&mut self, at: Pos2) -> Option<DVec3> {
        Some(self.hit_below(at)?.p_in_world)
    }

    /// The corner or edge that a click means, or else the place itself.
    fn snapped(&mut self, at: Pos2) -> Option<DVec3> {
        let hit = self.hit_below(at)?;
        let view = self.navigator?.view;
        let region = Region::whole(self.canvas.size.0, self.canvas.size.1);
        let snapped = snap(&hit, SNAP_PX, &view, &region);
        Some(snapped.map_or(hit.p_in_world, |snap| snap.p_in_world))
    }

    /// Around all that is shown.
    pub(super) fn shown_bounds(&self) -> Aabb {
        let Some(model) = &self.model else {
            return Aabb::EMPTY;
        };
        let objects = model.renderer.content().objects.iter();
        objects
            .filter(|o| !o.is_hidden)
            .fold(Aabb::EMPTY, |all, o| all.union(&o.bounds))
    }

    /// Around what is selected; `None` if that is nothing that is drawn.
    pub(super) fn selection_bounds(&self) -> Option<Aabb> {
        let instances = self.selected_instances();
        let model = self.model.as_ref()?;
        let objects = model.renderer.content().objects.iter();
        let bounds = objects
            .filter(|o| instances.binary_search(&(o.instance as usize)).is_ok())
            .fold(Aabb::EMPTY, |all, o| all.union(&o.bounds));
        (!bounds.is_empty()).then_some(bounds)
    }

    /// The instances that are selected, ascending.
    pub fn selected_instances(&self) -> Vec<usize> {
        let (Some(model), Some(row)) = (&self.model, self.selected) else {
            return Vec::new();
        };
        let mut instances: Vec<usize> = model.outline.instances(row).collect();
        instances.sort_unstable();
        instances
    }

    /// Shows or hides all that is in a row.
    pub(super) fn set_shown(&mut self, row: usize, is_shown: bool) {
        let Some(model) = &mut self.model else {
            return;
        };
        let instances: Vec<usize> = model.outline.instances(row).collect();
        let count = model.scene.instances.len();
        model.edit(|edits| {
            edits.hidden.resize(count, false);
            for instance in instances {
                edits.hidden[instance] = !is_shown;
            }
        });
    }

    /// Whether something in a row is shown.
    pub fn is_shown(&self, row: usize) -> bool {
        let Some(model) = &self.model else {
            return false;
        };
        let hidden = &model.edits.hidden;
        let is_hidden = |instance: usize| hidden.get(instance).copied().unwrap_or(false);
        model.outline.instances(row).any(|i| !is_hidden(i))
    }

    pub(super) fn hide_selection(&mut self) {
        match self.selected.take() {
            Some(row) => self.set_shown(row, false),
            None => self.tell("nothing is selected".to_owned()),
        }
    }

    pub(super) fn isolate_selection(&mut self) {
        let kept = self.selected_instances();
        if kept.is_empty() {
            self.tell("nothing is selected".to_owned());
            return;
        }
        if let Some(model) = &mut self.model {
            let count = model.scene.instances.len();
            model.edit(|edits| {
                edits.hidden = vec![true; count];
                for instance in kept {
                    edits.hidden[instance] = false;
                }
            });
        }
    }

    pub(super) fn show_everything(&mut self) {
        if let Some(model) = &mut self.model {
            model.edit(|edits| edits.hidden.clear());
        }
    }

    /// What a row is called.
    pub(super) fn name_of(&self, row: usize) -> Option<RowName> {
        let outline = &self.model.as_ref()?.outline;
        let name = labels(outline, row);
        let before = (0..row).filter(|&other| {
            outline.rows[other].label == outline.rows[row].label && labels(outline, other) == name
        });
        let nth = before.count();
        Some((name, nth))
    }

    /// The instances that are hidden, by name.
    pub(super) fn hidden_names(&self) -> Vec<Arc<str>> {
        let Some(model) = &self.model else {
            return Vec::new();
        };
        let instances = model.scene.instances.iter().zip(&model.edits.hidden);
        instances
            .filter(|(_, is_hidden)| **is_hidden)
            .filter_map(|(instance, _)| instance.placement.name.clone())
            .collect()
    }

    /// Selects and hides in a model that was read again what was so before, as far as it can be
    /// told.
    pub(super) fn take_over(&mut self, selected: Option<RowName>, hidden: &[Arc<str>]) {
        let Some(model) = &mut self.model else {
            return;
        };
        let outline = &model.outline;
        self.selected = selected.and_then(|(name, nth)| {
            let label = name.last()?;
            let rows = (0..outline.rows.len()).filter(|&row| outline.rows[row].label == *label);
            rows.filter(|&row| labels(outline, row) == name).nth(nth)
        });
        if !hidden.is_empty() {
            let instances = &model.scene.instances;
            let is_hidden = |i: &scenegraph::scene::Instance| {
                i.placement
                    .name
                    .as_ref()
                    .is_some_and(|name| hidden.contains(name))
            };
            let flags: Vec<bool> = instances.iter().map(is_hidden).collect();
            model.edit(|edits| edits.hidden = flags);
        }
    }

    /// What a row stands for.
    pub(super) fn item(&self, row: usize) -> Option<Item> {
        Some(self.model.as_ref()?.outline.rows.get(row)?.item)
    }
}

fn labels(outline: &Outline, row: usize) -> Vec<String> {
    let mut rows: Vec<usize> = std::iter::once(row).chain(outline.ancestors(row)).collect();
    rows.reverse();
    rows.into_iter()
        .map(|r| outline.rows[r].label.clone())
        .collect()
}
