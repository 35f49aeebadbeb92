//! What is known about what is selected: its fields in the source, and what they come to.

use std::sync::Arc;

use egui::{Grid, RichText, Ui};
use iv_parser::SourcePos;
use scenegraph::scene::Topology;

use super::measure::significant;
use super::state::App;
use crate::fields::{Fields, SourceNode};
use crate::outline::Item;

impl App {
    pub(super) fn properties(&mut self, ui: &mut Ui) {
        let Some(item) = self.selected.and_then(|row| self.item(row)) else {
            ui.weak("Nothing is selected.");
            return;
        };
        let rows = self.facts(item);
        Grid::new("facts")
            .num_columns(2)
            .striped(true)
            .show(ui, |ui| {
                for (name, value) in rows {
                    ui.label(name);
                    ui.label(value);
                    ui.end_row();
                }
            });
        if let Some(pos) = self.pos_of(item) {
            self.source(ui, pos);
        }
    }

    /// Whether the source of what is selected is known.
    pub fn knows_source(&self) -> bool {
        let fields = self.model.as_ref().and_then(|m| m.fields.as_ref());
        fields.is_some_and(Fields::is_settled)
    }

    fn pos_of(&self, item: Item) -> Option<SourcePos> {
        let model = self.model.as_ref().filter(|m| m.format == "inventor")?;
        Some(match item {
            Item::Node(id) => model.scene.nodes[id.index()].pos,
            Item::Instance(i) => model.scene.instances[i].placement.pos,
        })
    }

    /// The fields that the source has at a place.
    fn source(&mut self, ui: &mut Ui, pos: SourcePos) {
        let Some(path) = self.model.as_ref().map(|model| model.path.clone()) else {
            return;
        };
        let args = self.args_for(&path);
        let Some(model) = &mut self.model else {
            return;
        };
        let fields = model
            .fields
            .get_or_insert_with(|| Fields::new(&path, &args, Arc::clone(&self.wake)));
        let Some(nodes) = fields.at(pos) else {
            ui.weak("reading the source…");
            return;
        };
        for (i, node) in nodes.iter().enumerate() {
            source_node(ui, i, node);
        }
    }

    fn facts(&self, item: Item) -> Vec<(&'static str, String)> {
        let Some(model) = &self.model else {
            return Vec::new();
        };
        let scene = &model.scene;
        let place = |pos: SourcePos| match scene.files.get(pos.file as usize) {
            Some(file) if pos.line > 0 => format!("{file}:{}", pos.line),
            Some(file) => file.to_string(),
            None => "unknown".to_owned(),
        };
        let mut rows = match item {
            Item::Node(id) => {
                let node = &scene.nodes[id.index()];
                let mut rows = vec![
                    ("Class", node.class.to_string()),
                    ("Source", place(node.pos)),
                ];
                rows.extend(node.notes.iter().map(|note| ("Note", note.to_string())));
                if let Some(link) = &node.link {
                    rows.extend(link.urls.iter().map(|url| ("Link", url.to_string())));
                }
                rows
            }
            Item::Instance(i) => {
                let instance = &scene.instances[i];
                let mesh = &scene.meshes[instance.mesh.index()];
                let material = &scene.materials[instance.material.index()];
                let (kind, corners) = match mesh.topology {
                    Topology::Triangles => ("Triangles", 3),
                    Topology::Lines => ("Segments", 2),
                    Topology::Points => ("Points", 1),
                };
                let rgb = |c: [f64; 3]| format!("{:.3} {:.3} {:.3}", c[0], c[1], c[2]);
                vec![
                    ("Source", place(instance.placement.pos)),
                    (kind, (mesh.indices.len() / corners).to_string()),
                    ("Vertices", mesh.positions.len().to_string()),
                    ("Diffuse", rgb(material.diffuse_srgb)),
                    ("Specular", rgb(material.specular_srgb)),
                    ("Emissive", rgb(material.emissive_srgb)),
                    ("Shininess", format!("{:.3}", material.shininess)),
                    ("Transparency", format!("{:.3}", material.transparency)),
                ]
            }
        };
        if let Some(bounds) = self.selection_bounds() {
            let size = bounds.size().to_array().map(significant);
            rows.push(("Size", size.join(" × ")));
        }
        rows
    }
}

fn source_node(ui: &mut Ui, number: usize, node: &SourceNode) {
    ui.separator();
    let name = node
        .name
        .as_ref()
        .map_or(String::new(), |name| format!("DEF {name} "));
    ui.horizontal(|ui| {
        ui.strong(format!("{name}{}", node.class));
        if node.line > 0 {
            ui.weak(format!("line {}", node.line));
        }
    });
    Grid::new(("source", number)).num_columns(2).show(ui, |ui| {
        for (field, value) in &node.fields {
            ui.label(field);
            ui.monospace(value);
            ui.end_row();
        }
        for (field, value) in &node.defaults {
            ui.weak(field);
            ui.label(RichText::new(value).monospace().weak());
            ui.end_row();
        }
    });
}
