//! What is selected, hidden, and below the mouse.

use std::sync::Arc;

use egui::{Pos2, Response};
use geometry::bounds::Aabb;
use glam::DVec3;

use super::state::App;
use crate::outline::{Item, Outline};

/// What a row is called in its model, to be found again in the next version of it: the labels of
/// the rows around it, from the outside in, and which of several it is.
pub(super) type RowName = (Vec<String>, usize);

impl App {
    /// Selects what was clicked, or goes there.
    pub(super) fn click(&mut self, response: &Response) {
        let at = response.interact_pointer_pos();
        if response.double_clicked() {
            if let (Some(p), Some(navigator)) =
                (at.and_then(|at| self.p_below(at)), &mut self.navigator)
            {
                navigator.seek(p);
            }
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

    fn row_below(&mut self, _at: Pos2) -> Option<usize> {
        None
    }

    pub(super) fn p_below(&self, _at: Pos2) -> Option<DVec3> {
        None
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
