//! What is known about what is selected.

use egui::{Grid, Ui};
use scenegraph::scene::Topology;

use super::state::App;
use crate::outline::Item;

impl App {
    pub(super) fn properties(&mut self, ui: &mut Ui) {
        let Some(item) = self.selected.and_then(|row| self.item(row)) else {
            ui.weak("Nothing is selected.");
            return;
        };
        let rows = self.facts(item);
        Grid::new("properties")
            .num_columns(2)
            .striped(true)
            .show(ui, |ui| {
                for (name, value) in rows {
                    ui.label(name);
                    ui.label(value);
                    ui.end_row();
                }
            });
    }

    fn facts(&self, item: Item) -> Vec<(&'static str, String)> {
        let Some(model) = &self.model else {
            return Vec::new();
        };
        let scene = &model.scene;
        let place = |pos: iv_parser::SourcePos| match scene.files.get(pos.file as usize) {
            Some(file) if pos.line > 0 => format!("{file}:{}", pos.line),
            Some(file) => file.to_string(),
            None => "unknown".to_owned(),
        };
        match item {
            Item::Node(id) => {
                let node = &scene.nodes[id.index()];
                let mut rows = vec![
                    ("Class", node.class.to_string()),
                    ("Source", place(node.pos)),
                ];
                rows.extend(node.notes.iter().map(|note| ("Note", note.to_string())));
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
        }
    }
}
