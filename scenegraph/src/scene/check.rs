//! The guarantees of the resolved scene, as code.

use glam::{DAffine3, Vec3};

use super::{Coarser, MaterialId, Placement, Scene, Topology, is_below};

/// A guarantee that does not hold.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault(pub String);

impl Scene {
    /// Checks every guarantee of the module head; all faults found, in order.
    pub fn check(&self) -> Vec<Fault> {
        let mut faults = Vec::new();
        let mut fault = |holds: bool, text: &dyn Fn() -> String| {
            if !holds {
                faults.push(Fault(text()));
            }
        };
        for (i, node) in self.nodes.iter().enumerate() {
            fault(node.parent.is_none_or(|p| p.index() < i), &|| {
                format!("node {i}: its parent does not stand before it")
            });
            fault(node.parent_from_local.is_finite(), &|| {
                format!("node {i}: its transform is not finite")
            });
        }
        for (i, node) in self.nodes.iter().enumerate() {
            let limit_holds = match node.level() {
                Some(Coarser::Beyond(limit) | Coarser::Below(limit)) => {
                    limit.is_finite() && limit >= 0.0
                }
                Some(Coarser::Never) | None => true,
            };
            fault(limit_holds, &|| {
                format!("node {i}: the limit of its level is no size")
            });
            fault(node.level().is_none() || node.parent.is_some(), &|| {
                format!("node {i}: a level without a parent")
            });
        }
        let not_shown = self.nodes_not_shown();
        for (i, light) in self.lights.iter().enumerate() {
            fault(!is_below(light.placement.node, &not_shown), &|| {
                format!("light {i} is in a part that is not shown")
            });
        }
        let texts_in_order = self.texts.is_sorted_by(|a, b| a.instance < b.instance);
        let last = self.texts.last().map_or(0, |t| t.instance as usize + 1);
        fault(texts_in_order && last <= self.instances.len(), &|| {
            "texts do not belong to instances in order".to_owned()
        });
        let mut mesh_used = vec![false; self.meshes.len()];
        let mut material_used = vec![false; self.materials.len()];
        let mut texture_used = vec![false; self.textures.len()];
        for (i, instance) in self.instances.iter().enumerate() {
            let in_range = instance.mesh.index() < self.meshes.len()
                && instance.material.index() < self.materials.len()
                && instance.light_set.index() < self.light_sets.len()
                && instance.environment.index() < self.environments.len()
                && self.placement_in_range(&instance.placement);
            fault(in_range, &|| {
                format!("instance {i}: an index is out of range")
            });
            if in_range {
                mesh_used[instance.mesh.index()] = true;
                material_used[instance.material.index()] = true;
            }
            fault(self.placement_adds_up(&instance.placement), &|| {
                format!("instance {i}: world_from_local is not the product of its path")
            });
        }
        for (i, variant) in self.variants.iter().enumerate() {
            let ascends = variant.materials.is_sorted_by(|a, b| a.0 < b.0);
            let in_range = |&(instance, material): &(u32, MaterialId)| {
                (instance as usize) < self.instances.len()
                    && material.index() < self.materials.len()
            };
            fault(ascends && variant.materials.iter().all(in_range), &|| {
                format!("variant {i}: its instances or materials are out of order or range")
            });
            for (_, material) in &variant.materials {
                if let Some(used) = material_used.get_mut(material.index()) {
                    *used = true;
                }
            }
            let known = self.variants[..i].iter().any(|v| v.name == variant.name);
            fault(!known, &|| format!("variant {i}: its name is taken"));
        }
        for (i, material) in self.materials.iter().enumerate() {
            if let Some(texture) = material.texture {
                fault(texture.index() < self.textures.len(), &|| {
                    format!("material {i}: its texture is out of range")
                });
                if let Some(used) = texture_used.get_mut(texture.index()) {
                    *used = true;
                }
            }
            fault(material_used[i], &|| format!("material {i} is not used"));
        }
        for (i, used) in mesh_used.iter().enumerate() {
            fault(*used, &|| format!("mesh {i} is not used"));
        }
        for (i, used) in texture_used.iter().enumerate() {
            fault(*used, &|| format!("texture {i} is not used"));
        }
        for (i, set) in self.light_sets.iter().enumerate() {
            fault(set.iter().all(|l| l.index() < self.lights.len()), &|| {
                format!("light set {i}: an index is out of range")
            });
        }
        for (i, light) in self.lights.iter().enumerate() {
            fault(light.environment.index() < self.environments.len(), &|| {
                format!("light {i}: its environment is out of range")
            });
        }
        let lights = self.lights.iter().map(|l| &l.placement);
        let cameras = self.cameras.iter().map(|c| &c.placement);
        for placement in lights.chain(cameras) {
            fault(self.placement_in_range(placement), &|| {
                "a light or camera hangs on no node".to_owned()
            });
            fault(self.placement_adds_up(placement), &|| {
                "a light or camera is not where its path puts it".to_owned()
            });
        }
        for (i, mesh) in self.meshes.iter().enumerate() {
            let n = mesh.positions.len();
            for (name, len) in [
                ("normals", mesh.normals.len()),
                ("texcoords", mesh.texcoords.len()),
                ("colors", mesh.colors_srgb.len()),
            ] {
                fault(len == 0 || len == n, &|| {
                    format!("mesh {i}: {len} {name} for {n} positions")
                });
            }
            fault(n > 0 && !mesh.indices.is_empty(), &|| {
                format!("mesh {i} is empty")
            });
            let step = match mesh.topology {
                Topology::Triangles => 3,
                Topology::Lines => 2,
                Topology::Points => 1,
            };
            fault(mesh.indices.len().is_multiple_of(step), &|| {
                format!("mesh {i}: an incomplete primitive")
            });
            fault(mesh.indices.iter().all(|&v| (v as usize) < n), &|| {
                format!("mesh {i}: an index is out of range")
            });
            let finite = mesh.origin.is_finite()
                && mesh.positions.as_flattened().iter().all(|x| x.is_finite())
                && mesh.texcoords.as_flattened().iter().all(|x| x.is_finite())
                && mesh
                    .colors_srgb
                    .as_flattened()
                    .iter()
                    .all(|x| x.is_finite());
            fault(finite, &|| format!("mesh {i}: a number is not finite"));
            // f32 rounding of a unit vector: three squares and two sums, each within 2^-24.
            let unit = |v: &[f32; 3]| (Vec3::from(*v).length_squared() - 1.0).abs() < 1e-5;
            fault(mesh.normals.iter().all(unit), &|| {
                format!("mesh {i}: a normal is not of unit length")
            });
        }
        faults
    }

    fn placement_in_range(&self, placement: &Placement) -> bool {
        placement.node.is_none_or(|n| n.index() < self.nodes.len())
    }

    fn placement_adds_up(&self, placement: &Placement) -> bool {
        let mut product = placement.parent_from_local;
        let mut node = placement.node;
        let mut magnitude = abs(&product);
        let mut factors = 1.0;
        while let Some(id) = node {
            let Some(entry) = self.nodes.get(id.index()) else {
                return false;
            };
            product = entry.parent_from_local * product;
            magnitude = abs(&entry.parent_from_local) * magnitude;
            factors += 1.0;
            node = entry.parent;
        }
        if !placement.world_from_local.is_finite() {
            return false;
        }
        // The two products associate differently. However a product of n matrices associates, its
        // entries err by at most 4n roundings of those of the product of absolute values
        // (Higham, Accuracy and Stability of Numerical Algorithms, 3.5).
        let unit = 8.0 * f64::EPSILON * factors;
        let a = product.to_cols_array();
        let b = placement.world_from_local.to_cols_array();
        let bounds = magnitude.to_cols_array().map(|m| unit * m);
        (a.iter().zip(b).zip(bounds)).all(|((x, y), bound)| (x - y).abs() <= bound)
    }
}

fn abs(m: &DAffine3) -> DAffine3 {
    DAffine3::from_mat3_translation(m.matrix3.abs(), m.translation.abs())
}
