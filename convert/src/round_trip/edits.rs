//! What differs between a file as it was written and as it is now, object by object.
//!
//! Nodes are paired from the roots down, by name where names are unique among siblings, else by what
//! they show and where; meshes, materials, lights and cameras are paired by the nodes that show them.
//! So another order, other buffers and other spellings of the same numbers are no edits.

use std::collections::{BTreeMap, BTreeSet, VecDeque};

use super::same::{same_camera, same_frame, same_geometry, same_light, same_material};
use crate::read::{NodeObject, Objects};

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
    let order: BTreeMap<usize, usize> = (b.iter().enumerate().rev())
        .map(|(place, &to)| (to, place))
        .collect();
    let mut left: Vec<usize> = alike.into_values().flatten().collect();
    left.sort_by_key(|to| order.get(to));
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
