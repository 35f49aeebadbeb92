//! Materials: in their own nodes, or around the shapes that have them.

use std::fmt::Write;

use iv_parser::NodeId as TreeId;
use scenegraph::legal_name;
use scenegraph::scene::{LightModel, Material, MaterialId};

use super::places::Ahead;
use super::text::{hints, material_text};
use super::{No, Patcher};

/// Difference of two values of a look that counts as an edit of its own.
const VALUE_TOLERANCE: f64 = 1e-5;

/// A material of the source: its number, itself, and as it was and is in the file.
type Looks<'p> = (MaterialId, &'p Material, &'p Material, &'p Material);

impl<'p> Patcher<'p, '_, '_> {
    fn looks(&self, at: usize, to: usize) -> Result<Looks<'p>, No> {
        let (was, is) = (self.was, self.is);
        let id = was.origins.materials.get(at).copied();
        let id = id.ok_or("a material has no origin")?;
        let source = &self.scene.materials[id.index()];
        let (old, new) = (&was.objects.materials[at], &is.materials[to]);
        Ok((id, source, &old.material, &new.material))
    }

    pub(super) fn material(&mut self, at: usize, to: usize) -> Result<(), No> {
        let (_, source, old, new) = self.looks(at, to)?;
        let look = (old.light_model, old.faces);
        let node = self.node_at(source.pos);
        match node {
            Ok(node) if self.class(node) == "Material" && look == (new.light_model, new.faces) => {
                self.material_fields(node, old, new)
            }
            _ => Err("a material that no Material node alone makes was edited".to_owned()),
        }
    }

    fn material_fields(&mut self, node: TreeId, old: &Material, new: &Material) -> Result<(), No> {
        if old.name != new.name {
            let name = new.name.as_deref().and_then(legal_name);
            self.edits.rename(node, &name.ok_or("a name was removed")?);
        }
        let differ = |a: &[f64], b: &[f64]| {
            a.iter()
                .zip(b)
                .any(|(a, b)| (a - b).abs() > VALUE_TOLERANCE)
        };
        let fields = [
            (
                "diffuseColor",
                old.diffuse_srgb.to_vec(),
                new.diffuse_srgb.to_vec(),
            ),
            (
                "specularColor",
                old.specular_srgb.to_vec(),
                new.specular_srgb.to_vec(),
            ),
            (
                "emissiveColor",
                old.emissive_srgb.to_vec(),
                new.emissive_srgb.to_vec(),
            ),
            ("shininess", vec![old.shininess], vec![new.shininess]),
            (
                "transparency",
                vec![old.transparency],
                vec![new.transparency],
            ),
        ];
        for (field, old, new) in fields {
            if !differ(&old, &new) {
                continue;
            }
            let written = self.edits.field(node, field);
            let count = written
                .and_then(|f| self.numbers(&f.value))
                .map_or(0, |n| n.len());
            if count > new.len() {
                return Err(format!(
                    "a Material with several values of {field} was edited"
                ));
            }
            // As many digits as a display, and f32, can tell apart.
            let words: Vec<String> = new.iter().map(|v| format!("{}", *v as f32)).collect();
            self.set(node, field, &words.join(" "))?;
        }
        Ok(())
    }

    /// Puts a material ahead of each shape that has the edited one.
    pub(super) fn material_around_shapes(&mut self, at: usize, to: usize) -> Result<(), No> {
        if self.is_vrml2() {
            return Err("a material that no Material node alone makes was edited".to_owned());
        }
        let (id, source, old, new) = self.looks(at, to)?;
        let kept = |was: [f64; 3], old: [f64; 3], new: [f64; 3]| match old == new {
            true => was,
            false => new.map(|v| f64::from(v as f32)),
        };
        let single = |was: f64, old: f64, new: f64| kept([was; 3], [old; 3], [new; 3])[0];
        let look = Material {
            name: new.name.clone(),
            ambient_srgb: source.ambient_srgb,
            diffuse_srgb: kept(source.diffuse_srgb, old.diffuse_srgb, new.diffuse_srgb),
            specular_srgb: kept(source.specular_srgb, old.specular_srgb, new.specular_srgb),
            emissive_srgb: kept(source.emissive_srgb, old.emissive_srgb, new.emissive_srgb),
            shininess: single(source.shininess, old.shininess, new.shininess),
            transparency: single(source.transparency, old.transparency, new.transparency),
            ..new.clone()
        };
        let mut ahead = String::new();
        if old.faces != new.faces {
            let _ = write!(ahead, "ShapeHints {{ {} }} ", hints(new.faces));
        }
        if old.light_model != new.light_model {
            let model = match new.light_model {
                LightModel::BaseColor => "BASE_COLOR",
                LightModel::Phong => "PHONG",
            };
            let _ = write!(ahead, "LightModel {{ model {model} }} ");
        }
        ahead += &material_text(&look);
        for i in self.occurrences.of_material(id) {
            let (pos, occurrence) = self.instance_place(i);
            let node = self.node_at(pos)?;
            let place = self.place(node, occurrence);
            self.wrap(&place, "", &Ahead::Nodes(ahead.clone()))?;
        }
        Ok(())
    }
}
