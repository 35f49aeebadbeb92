//! What differs between a file as it was written and as it is now, object by object.
//!
//! Nodes are paired from the roots down, by name where names are unique among siblings, else by what
//! they show and where; meshes, materials, lights and cameras are paired by the nodes that show them. So another
//! order, other buffers and other spellings of the same numbers are no edits.

use std::collections::{BTreeMap, BTreeSet, VecDeque};

use glam::{DAffine3, DVec3};
use scenegraph::scene::{Camera, Light, LightKind, Material, Mesh, Projection, Topology};

use crate::read::{NodeObject, Objects, PrimitiveObject};

/// Colours, shares and angles: values that went through linear light, a quotient and f32.
const VALUE_TOLERANCE: f64 = 2e-5;
/// Rotations and scales, relative: quaternions that tools hold in f32 and make unit again.
const LINEAR_TOLERANCE: f64 = 1e-6;
/// f64 transforms that went through another text or another order of products.
const EXACT_TOLERANCE: f64 = 1e-12;
/// Positions relative to the extent of their mesh, and normals: a few roundings of f32.
const VERTEX_TOLERANCE: f32 = 1e-6;
const NORMAL_TOLERANCE: f32 = 2e-3;
/// Vertex colours: half a step of 8-bit ones.
const COLOR_TOLERANCE: f32 = 2.5e-3;

/// Siblings of one kind among which one in the same place is looked for.
const MAX_SIBLINGS_TRIED: usize = 64;

/// All that differs; pairs are of the object as it was and as it is.
#[derive(Debug, Default)]
pub(crate) struct Edits {
    /// Why the two do not correspond at all.
    pub(crate) structure: Option<String>,
    pub(crate) names: Vec<(usize, usize)>,
    pub(crate) frames: Vec<(usize, usize)>,
    pub(crate) meshes: BTreeMap<usize, usize>,
    pub(crate) materials: BTreeMap<usize, usize>,
    pub(crate) lights: BTreeMap<usize, usize>,
    pub(crate) cameras: BTreeMap<usize, usize>,
    pub(crate) images: BTreeMap<usize, usize>,
}

impl Edits {
    pub(crate) fn between(was: &Objects, is: &Objects) -> Self {
        Self::found(was, is, false)
    }

    /// As [`Self::between`], but for what the writer makes of the size of the scene, which differs
    /// where parts were moved: the strength of lights that fade, and depths of cameras.
    pub(crate) fn but_for_size(was: &Objects, is: &Objects) -> Self {
        Self::found(was, is, true)
    }

    fn found(was: &Objects, is: &Objects, other_size: bool) -> Self {
        let mut pairing = Pairing {
            other_size,
            was,
            is,
            edits: Self::default(),
            compared: Compared::default(),
        };
        if let Err(why) = pairing.nodes() {
            pairing.edits.structure = Some(why);
        }
        pairing.edits
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.structure.is_none() && self.count() == 0
    }

    fn count(&self) -> usize {
        self.names.len()
            + self.frames.len()
            + self.meshes.len()
            + self.materials.len()
            + self.lights.len()
            + self.cameras.len()
            + self.images.len()
    }

    /// In words, for a message.
    pub(crate) fn summary(&self) -> String {
        if let Some(why) = &self.structure {
            return why.clone();
        }
        let rows = [
            ("name", self.names.len()),
            ("transform", self.frames.len()),
            ("mesh", self.meshes.len()),
            ("material", self.materials.len()),
            ("light", self.lights.len()),
            ("camera", self.cameras.len()),
            ("image", self.images.len()),
        ];
        let present = rows.iter().filter(|(_, count)| *count > 0);
        let words = present.map(|(what, count)| crate::command::messages::number(*count, what));
        words.collect::<Vec<_>>().join(", ")
    }
}

/// Pairs that were compared already.
#[derive(Default)]
struct Compared {
    meshes: BTreeMap<usize, usize>,
    materials: BTreeMap<usize, usize>,
    lights: BTreeMap<usize, usize>,
    cameras: BTreeMap<usize, usize>,
}

struct Pairing<'o> {
    other_size: bool,
    was: &'o Objects,
    is: &'o Objects,
    edits: Edits,
    compared: Compared,
}

/// Why a file cannot be compared further.
type Structure = String;

impl<'o> Pairing<'o> {
    fn nodes(&mut self) -> Result<(), Structure> {
        let (was, is) = (self.was, self.is);
        let mut seen = vec![false; is.nodes.len()];
        let mut open = siblings(was, &was.roots, is, &is.roots)?;
        while let Some((a, b)) = open.pop() {
            let slot = seen.get_mut(b).ok_or("a node is missing")?;
            if std::mem::replace(slot, true) {
                return Err("a node has several parents".to_owned());
            }
            self.node(a, b)?;
            let (a, b) = (&was.nodes[a], &is.nodes[b]);
            open.extend(siblings(was, &a.children, is, &b.children)?);
        }
        Ok(())
    }

    fn node(&mut self, at: usize, to: usize) -> Result<(), Structure> {
        let (a, b): (&NodeObject, &NodeObject) = (&self.was.nodes[at], &self.is.nodes[to]);
        if a.name != b.name {
            self.edits.names.push((at, to));
        }
        if !same_frame(&a.parent_from_local, &b.parent_from_local) {
            self.edits.frames.push((at, to));
        }
        if a.is_hidden != b.is_hidden {
            return Err("a part was hidden or shown".to_owned());
        }
        let copies = a.copies.len() == b.copies.len()
            && a.copies
                .iter()
                .zip(&b.copies)
                .all(|(a, b)| same_frame(a, b));
        if !copies {
            return Err("copies of a mesh were added, removed or moved".to_owned());
        }
        if let Some((a, b)) = both(a.mesh, b.mesh, "mesh")? {
            self.mesh(a, b)?;
        }
        if let Some((a, b)) = both(a.light, b.light, "light")? {
            let same = pair(&mut self.compared.lights, a, b, "lights")?;
            let found = (self.was.lights.get(a), self.is.lights.get(b));
            if let (false, (Some(Some(x)), Some(Some(y)))) = (same, found)
                && !same_light(x, y, self.other_size)
            {
                self.edits.lights.insert(a, b);
            }
        }
        if let Some((a, b)) = both(a.camera, b.camera, "camera")? {
            let same = pair(&mut self.compared.cameras, a, b, "cameras")?;
            let found = (self.was.cameras.get(a), self.is.cameras.get(b));
            if let (false, (Some(Some(x)), Some(Some(y)))) = (same, found)
                && !same_camera(x, y, self.other_size)
            {
                self.edits.cameras.insert(a, b);
            }
        }
        Ok(())
    }

    fn mesh(&mut self, a: usize, b: usize) -> Result<(), Structure> {
        if pair(&mut self.compared.meshes, a, b, "meshes")? {
            return Ok(());
        }
        let none = Vec::new();
        let x = self.was.meshes.get(a).unwrap_or(&none);
        let y = self.is.meshes.get(b).unwrap_or(&none);
        if x.len() != y.len() {
            return Err("a mesh has other parts".to_owned());
        }
        for (x, y) in x.iter().zip(y) {
            if !same_geometry(x, y) {
                self.edits.meshes.insert(a, b);
            }
            match (x.material, y.material) {
                (Some(a), Some(b)) => self.material(a, b)?,
                (None, None) => {}
                _ => return Err("a mesh has got or lost its material".to_owned()),
            }
            if !x.in_variants.keys().eq(y.in_variants.keys()) {
                return Err("a mesh has other variants".to_owned());
            }
            for (&a, &b) in x.in_variants.values().zip(y.in_variants.values()) {
                self.material(a, b)?;
            }
        }
        Ok(())
    }

    fn material(&mut self, a: usize, b: usize) -> Result<(), Structure> {
        if pair(&mut self.compared.materials, a, b, "materials")? {
            return Ok(());
        }
        let (Some(x), Some(y)) = (self.was.materials.get(a), self.is.materials.get(b)) else {
            return Err("a material is missing".to_owned());
        };
        if !same_material(&x.material, &y.material) {
            self.edits.materials.insert(a, b);
        }
        match (x.image, y.image) {
            (None, None) => {}
            (Some((i, wraps)), Some((k, wraps_back))) if wraps == wraps_back => {
                let bytes = |o: &'o Objects, i: usize| o.images.get(i).and_then(Option::as_deref);
                if bytes(self.was, i) != bytes(self.is, k) {
                    self.edits.images.insert(i, k);
                }
            }
            _ => return Err("a material has another texture".to_owned()),
        }
        Ok(())
    }
}

/// Remembers a pair; whether it was known. One object that has become several is no pair.
fn pair(
    known: &mut BTreeMap<usize, usize>,
    a: usize,
    b: usize,
    what: &str,
) -> Result<bool, Structure> {
    match known.insert(a, b) {
        None => Ok(false),
        Some(same) if same == b => Ok(true),
        Some(_) => Err(format!("shared {what} were made several")),
    }
}

fn both(
    a: Option<usize>,
    b: Option<usize>,
    what: &str,
) -> Result<Option<(usize, usize)>, Structure> {
    match (a, b) {
        (Some(a), Some(b)) => Ok(Some((a, b))),
        (None, None) => Ok(None),
        _ => Err(format!("a node has got or lost its {what}")),
    }
}

/// Siblings by name where both sides have it once, then by what they are and where, then by order.
fn siblings(
    was: &Objects,
    a: &[usize],
    is: &Objects,
    b: &[usize],
) -> Result<Vec<(usize, usize)>, Structure> {
    if a.len() != b.len() {
        return Err(format!(
            "a group has {} nodes instead of {}",
            b.len(),
            a.len()
        ));
    }
    let by_name = |objects: &'_ Objects, list: &[usize]| {
        let mut names: BTreeMap<String, Option<usize>> = BTreeMap::new();
        for &node in list {
            let name = objects.nodes.get(node).and_then(|n| n.name.clone());
            let entry = names.entry(name.unwrap_or_default());
            entry.and_modify(|seen| *seen = None).or_insert(Some(node));
        }
        names.remove("");
        names
    };
    let (x, y) = (by_name(was, a), by_name(is, b));
    let mut pairs: Vec<(usize, usize)> = Vec::with_capacity(a.len());
    for (name, at) in &x {
        if let (Some(at), Some(Some(to))) = (at, y.get(name)) {
            pairs.push((*at, *to));
        }
    }
    let taken: BTreeSet<usize> = pairs.iter().map(|p| p.0).collect();
    let taken_now: BTreeSet<usize> = pairs.iter().map(|p| p.1).collect();
    let mut alike: BTreeMap<Kind, VecDeque<usize>> = BTreeMap::new();
    for &to in b.iter().filter(|i| !taken_now.contains(i)) {
        alike.entry(kind(is, to)).or_default().push_back(to);
    }
    let mut rest = Vec::new();
    for &at in a.iter().filter(|i| !taken.contains(i)) {
        let frame = |o: &Objects, i: usize| o.nodes.get(i).map(|n| n.parent_from_local);
        let same = |&to: &usize| match (frame(was, at), frame(is, to)) {
            (Some(a), Some(b)) => same_frame(&a, &b),
            _ => false,
        };
        let found = alike.get_mut(&kind(was, at)).and_then(|queue| {
            let near = queue.iter().take(MAX_SIBLINGS_TRIED).position(same);
            queue.remove(near.unwrap_or(0))
        });
        match found {
            Some(to) => pairs.push((at, to)),
            None => rest.push(at),
        }
    }
    let mut left: Vec<usize> = alike.into_values().flatten().collect();
    left.sort_by_key(|to| b.iter().position(|i| i == to));
    pairs.extend(rest.into_iter().zip(left));
    Ok(pairs)
}

/// What tells siblings without names apart: what they show and how much they hold.
type Kind = (Option<u32>, bool, bool, usize, bool);

fn kind(objects: &Objects, at: usize) -> Kind {
    let Some(node) = objects.nodes.get(at) else {
        return (None, false, false, 0, false);
    };
    let sum = |mesh: usize| objects.mesh_sums.get(mesh).copied().unwrap_or_default();
    (
        node.mesh.map(sum),
        node.light.is_some(),
        node.camera.is_some(),
        node.children.len(),
        node.name.is_some(),
    )
}

fn near(a: f64, b: f64, tolerance: f64) -> bool {
    (a - b).abs() <= tolerance * a.abs().max(b.abs()).max(1.0)
}

fn all_near(a: &[f64], b: &[f64]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| near(*a, *b, VALUE_TOLERANCE))
}

/// Equal, or what is left of the one in f32.
fn same_place(a: DVec3, b: DVec3) -> bool {
    let scale = a.abs().max_element();
    let same =
        |a: f64, b: f64| (a - b).abs() <= EXACT_TOLERANCE * scale || b == f64::from(a as f32);
    same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z)
}

pub(crate) fn same_frame(a: &DAffine3, b: &DAffine3) -> bool {
    let (x, y) = (a.matrix3.to_cols_array(), b.matrix3.to_cols_array());
    let scale = x.iter().fold(0.0, |most: f64, v| v.abs().max(most));
    let linear = x
        .iter()
        .zip(y)
        .all(|(a, b)| (a - b).abs() <= LINEAR_TOLERANCE * scale);
    linear && same_place(a.translation, b.translation)
}

fn same_material(a: &Material, b: &Material) -> bool {
    let numbers = |m: &Material| {
        let colors = [m.diffuse_srgb, m.specular_srgb, m.emissive_srgb].concat();
        [colors, vec![m.shininess, m.transparency]].concat()
    };
    a.name == b.name
        && all_near(&numbers(a), &numbers(b))
        && (a.light_model, a.faces) == (b.light_model, b.faces)
}

fn same_light(
    (a, fall): &(Light, [f64; 3]),
    (b, fall_back): &(Light, [f64; 3]),
    other_size: bool,
) -> bool {
    let cone = |light: &Light| match light.kind {
        LightKind::Directional { .. } => (0, [0.0; 2]),
        LightKind::Point { .. } => (1, [0.0; 2]),
        LightKind::Spot {
            drop_off_rate,
            cut_off_angle_rad,
            ..
        } => (2, [drop_off_rate, cut_off_angle_rad]),
    };
    let ((kind, angles), (kind_back, angles_back)) = (cone(a), cone(b));
    kind == kind_back
        && all_near(&angles, &angles_back)
        && all_near(&a.color_srgb, &b.color_srgb)
        && (other_size && kind > 0 || near(a.intensity, b.intensity, VALUE_TOLERANCE))
        && fall == fall_back
}

fn same_camera(a: &Camera, b: &Camera, other_size: bool) -> bool {
    let view = |camera: &Camera| match camera.projection {
        Projection::Perspective { height_angle_rad } => [0.0, height_angle_rad],
        Projection::Orthographic { height } => [1.0, height],
    };
    let numbers = |c: &Camera| [c.near_distance, c.far_distance];
    all_near(&view(a), &view(b))
        && near(a.aspect_ratio, b.aspect_ratio, VALUE_TOLERANCE)
        && (other_size || all_near(&numbers(a), &numbers(b)))
}

fn same_geometry(a: &PrimitiveObject, b: &PrimitiveObject) -> bool {
    match (&a.mesh, &b.mesh) {
        (Some(a), Some(b)) => same_mesh(a, b),
        (None, None) => true,
        _ => false,
    }
}

/// Corner by corner, so that other vertices in the same places are no edit.
fn same_mesh(a: &Mesh, b: &Mesh) -> bool {
    if a == b {
        return true;
    }
    let step = match a.topology {
        Topology::Triangles => 3,
        Topology::Lines => 2,
        Topology::Points => 1,
    };
    let has = |m: &Mesh| {
        [
            m.normals.is_empty(),
            m.texcoords.is_empty(),
            m.colors_srgb.is_empty(),
        ]
    };
    if a.topology != b.topology || a.indices.len() != b.indices.len() || has(a) != has(b) {
        return false;
    }
    let extent = a
        .positions
        .as_flattened()
        .iter()
        .fold(0.0, |most: f32, v| v.abs().max(most));
    let close = |a: &[f32], b: &[f32], tolerance: f32| {
        a.iter().zip(b).all(|(a, b)| (a - b).abs() <= tolerance)
    };
    let corners = a.indices.chunks(step).zip(b.indices.chunks(step));
    corners.flat_map(|(a, b)| a.iter().zip(b)).all(|(&i, &k)| {
        let (i, k) = (i as usize, k as usize);
        let attribute = |empty: bool, of: &dyn Fn() -> bool| empty || of();
        close(&a.positions[i], &b.positions[k], VERTEX_TOLERANCE * extent)
            && attribute(a.normals.is_empty(), &|| {
                close(&a.normals[i], &b.normals[k], NORMAL_TOLERANCE)
            })
            && attribute(a.texcoords.is_empty(), &|| {
                let size = a.texcoords[i]
                    .iter()
                    .fold(1.0, |most: f32, v| v.abs().max(most));
                close(
                    &a.texcoords[i],
                    &b.texcoords[k],
                    2.0 * VERTEX_TOLERANCE * size,
                )
            })
            && attribute(a.colors_srgb.is_empty(), &|| {
                close(&a.colors_srgb[i], &b.colors_srgb[k], COLOR_TOLERANCE)
            })
    })
}
