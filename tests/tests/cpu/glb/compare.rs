//! One scene against its GLB: every corner of every instance, and all that names and shares.
//!
//! The order of nodes and vertices is the writer's own affair; only the order of the primitives
//! within a mesh is taken to be kept.

use std::collections::{BTreeMap, BTreeSet};

use glam::{DAffine3, DMat3, DVec3};
use scenegraph::scene::{Instance, Mesh, NodeId, Scene, Topology};

use super::read::{Arrays, Glb, Placed};
use super::{material, views};

/// One rounding in f64, relative.
const ULP: f64 = f64::EPSILON / 2.0;
/// Roundings of a level of the hierarchy, on both sides: a product of transforms (7), its
/// decomposition (about 20) and making a matrix of the parts again (10).
const ROUNDINGS_PER_LEVEL: f64 = 40.0;

/// What is different, in words; empty when nothing is.
pub fn differences(scene: &Scene, glb: &Glb) -> Vec<String> {
    let mut differences: Vec<String> = names(scene, glb).into_iter().collect();
    differences.extend(sharing(scene, glb));
    differences.extend(views::differences(scene, glb));
    differences.extend(instances(scene, glb));
    differences
}

/// No name is lost and none is invented.
fn names(scene: &Scene, glb: &Glb) -> Option<String> {
    let groups = scene.nodes.iter().map(|node| &node.name);
    let placements = (scene.instances.iter().map(|i| &i.placement))
        .chain(scene.lights.iter().map(|l| &l.placement))
        .chain(scene.cameras.iter().map(|c| &c.placement));
    let mut want: Vec<&str> = groups
        .chain(placements.map(|p| &p.name))
        .filter_map(|name| name.as_deref())
        .collect();
    let mut got: Vec<&str> = (glb.nodes.iter())
        .filter_map(|node| node.name.as_deref())
        .collect();
    want.sort_unstable();
    got.sort_unstable();
    (got != want).then(|| format!("names {got:?}, in the scene {want:?}"))
}

/// One glTF mesh for each pair of mesh and material, one set of arrays for each mesh.
fn sharing(scene: &Scene, glb: &Glb) -> Option<String> {
    let pairs = scene.instances.iter().map(|i| (i.mesh, i.material));
    let pairs: BTreeSet<_> = pairs.collect();
    let arrays: BTreeSet<_> = glb.meshes.iter().map(|mesh| mesh.accessor).collect();
    let got = [glb.meshes.len(), arrays.len()];
    let want = [pairs.len(), scene.meshes.len()];
    (got != want).then(|| format!("meshes and their arrays: {got:?}, in the scene {want:?}"))
}

/// What two things that are the same agree in exactly.
type Key = (Vec<String>, u8, usize);

fn key(path: Vec<String>, topology: Topology, indices: usize) -> Key {
    (path, topology as u8, indices)
}

/// Pairs each shown node with an instance that it does not differ from; gives those left over.
fn instances(scene: &Scene, glb: &Glb) -> Vec<String> {
    let mut open: BTreeMap<Key, Vec<Wanted>> = BTreeMap::new();
    for instance in &scene.instances {
        let wanted = Wanted::new(scene, instance);
        let mesh = wanted.mesh;
        let key = key(wanted.path(), mesh.topology, mesh.indices.len());
        open.entry(key).or_default().push(wanted);
    }
    let mut differences = Vec::new();
    for (node, mesh) in glb.shown() {
        let key = key(node.path.clone(), mesh.topology, mesh.indices.len());
        let near = open.get_mut(&key);
        let found = near.map_or(Err("no such instance".to_owned()), |list| {
            take_same(list, node, mesh, glb)
        });
        if let Err(why) = found {
            differences.push(format!("{:?}: {why}", node.path));
        }
    }
    for (key, list) in &open {
        if !list.is_empty() {
            differences.push(format!("{key:?}: {} are not in the GLB", list.len()));
        }
    }
    differences
}

/// Takes an instance that does not differ out of the list, or says how one that begins at the same
/// place does.
fn take_same(
    list: &mut Vec<Wanted>,
    node: &Placed,
    mesh: &Arrays,
    glb: &Glb,
) -> Result<(), String> {
    let first = node.p_in_world(mesh.positions[mesh.indices[0] as usize]);
    let mut why = format!("none begins at {first}");
    for i in 0..list.len() {
        if first.distance(list[i].first) > list[i].bound {
            continue;
        }
        match list[i].differs(node, mesh, glb) {
            None => {
                list.swap_remove(i);
                return Ok(());
            }
            Some(difference) => why = difference,
        }
    }
    Err(why)
}

/// What an instance of the scene must look like.
struct Wanted<'s> {
    scene: &'s Scene,
    instance: &'s Instance,
    mesh: &'s Mesh,
    /// Its first corner, in the world.
    first: DVec3,
    /// Most by which a corner may be elsewhere.
    bound: f64,
    /// The same for an entry of the matrix of normals.
    normal_bound: f64,
    normals_to_world: DMat3,
}

impl<'s> Wanted<'s> {
    fn new(scene: &'s Scene, instance: &'s Instance) -> Self {
        let mesh = &scene.meshes[instance.mesh.index()];
        let placement = &instance.placement;
        let mut steps = vec![
            DAffine3::from_translation(mesh.origin),
            placement.parent_from_local,
        ];
        let up = ancestors(scene, placement.node).map(|n| scene.nodes[n.index()].parent_from_local);
        steps.extend(up);
        let roundings = ROUNDINGS_PER_LEVEL * steps.len() as f64 * ULP;
        let positions = mesh.positions.iter();
        let radius = positions.fold(0.0, |r, p| wide(*p).length().max(r));
        let scale: f64 = steps
            .iter()
            .skip(1)
            .map(|step| norm(&step.matrix3))
            .product();
        Self {
            scene,
            instance,
            mesh,
            first: p_in_world(instance, mesh, mesh.indices[0]),
            bound: roundings * reach(&steps, radius),
            // Entries are products of two entries of the matrix.
            normal_bound: 4.0 * roundings * scale * scale,
            normals_to_world: normals_to_world(&placement.world_from_local),
        }
    }

    fn path(&self) -> Vec<String> {
        let placement = &self.instance.placement;
        let up = ancestors(self.scene, placement.node);
        let names = up.map(|n| &self.scene.nodes[n.index()].name);
        let mut names: Vec<_> = std::iter::once(&placement.name)
            .chain(names)
            .filter_map(|name| name.as_deref().map(str::to_owned))
            .collect();
        names.reverse();
        names
    }

    fn differs(&self, node: &Placed, mesh: &Arrays, glb: &Glb) -> Option<String> {
        let json = &glb.json["materials"][mesh.material];
        let material = &self.scene.materials[self.instance.material.index()];
        let texture = material.texture.map(|t| &self.scene.textures[t.index()]);
        let difference = material::difference(json, material, texture, self.mesh, mesh);
        difference.or_else(|| {
            let normals = normals_to_world(&node.world_from_local);
            let corners = self.mesh.indices.iter().zip(&mesh.indices);
            corners.enumerate().find_map(|(corner, (&want, &got))| {
                let difference = self
                    .position_differs(node, mesh, want, got)
                    .or_else(|| self.normal_differs(&normals, mesh, want, got))
                    .or_else(|| material::texcoord_differs(self.mesh, mesh, want, got))
                    .or_else(|| material::color_differs(self.mesh, mesh, want, got));
                difference.map(|text| format!("corner {corner}: {text}"))
            })
        })
    }

    fn position_differs(
        &self,
        node: &Placed,
        mesh: &Arrays,
        want: u32,
        got: u32,
    ) -> Option<String> {
        let got = node.p_in_world(mesh.positions[got as usize]);
        let want = p_in_world(self.instance, self.mesh, want);
        let off = got.distance(want);
        // Not so for NaN.
        let agrees = off <= self.bound;
        (!agrees).then(|| format!("{got} for {want}, off by {off:e} > {:e}", self.bound))
    }

    fn normal_differs(
        &self,
        normals_to_world: &DMat3,
        mesh: &Arrays,
        want: u32,
        got: u32,
    ) -> Option<String> {
        let got = wide(*mesh.normals.get(got as usize)?);
        let want = wide(self.mesh.normals[want as usize]);
        // Three squares, their sum and a root in f32.
        if (got.length() - 1.0).abs() > 4.0 * f64::from(f32::EPSILON) {
            return Some(format!("normal {got} has length {}", got.length()));
        }
        let (got, want) = (*normals_to_world * got, self.normals_to_world * want);
        let off = got.distance(want);
        let bound = self.normal_bound + 1e-300;
        let agrees = off <= bound;
        (!agrees).then(|| format!("normal {got} for {want}, off by {off:e} > {bound:e}"))
    }
}

fn p_in_world(instance: &Instance, mesh: &Mesh, vertex: u32) -> DVec3 {
    let p_in_local = mesh.origin + wide(mesh.positions[vertex as usize]);
    let world_from_local = &instance.placement.world_from_local;
    world_from_local.transform_point3(p_in_local)
}

fn ancestors(scene: &Scene, node: Option<NodeId>) -> impl Iterator<Item = NodeId> + '_ {
    std::iter::successors(node, |n| scene.nodes[n.index()].parent)
}

/// How large numbers can get when a point at most `radius` from the origin goes through `steps`:
/// by the forward error analysis of a product, its error is a small multiple of this.
fn reach(steps: &[DAffine3], radius: f64) -> f64 {
    let grow = |r: f64, step: &DAffine3| norm(&step.matrix3) * r + step.translation.length();
    steps.iter().fold(radius, grow)
}

/// Frobenius norm.
fn norm(m: &DMat3) -> f64 {
    let columns = [m.x_axis, m.y_axis, m.z_axis];
    DVec3::from(columns.map(DVec3::length)).length()
}

/// Cofactors with the sign of the determinant: the inverse transpose but for a positive factor.
fn normals_to_world(world_from_local: &DAffine3) -> DMat3 {
    let m = world_from_local.matrix3;
    let [x, y, z] = [m.x_axis, m.y_axis, m.z_axis];
    let cofactors = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y));
    if x.dot(y.cross(z)) < 0.0 {
        -cofactors
    } else {
        cofactors
    }
}

fn wide(v: [f32; 3]) -> DVec3 {
    DVec3::from(v.map(f64::from))
}
