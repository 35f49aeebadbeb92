//! Edits of glTF objects as changes of the source's text, each at the node that the object was made
//! of. Whether a change has the wanted effect is not decided here: the result is converted again
//! and compared.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::ops::Range;

use glam::{DAffine3, DMat3, DQuat, DVec3};
use iv_parser::{LineCounter, NodeId as TreeId, SourcePos, TextEdits, Tree};
use scenegraph::scene::{
    Faces, Instance, Light, LightKind, LightModel, Material, Mesh, NodeId, Projection, Scene,
    TextureSource,
};
use scenegraph::{legal_name, write_shape};

use super::Again;
use super::edits::Edits;
use super::paths::target;
use crate::hierarchy::{Item, Origin};
use crate::read::Objects;

/// Why an edit has no place in the text.
type No = String;

/// Difference of two values of a look that counts as an edit of its own.
const VALUE_TOLERANCE: f64 = 1e-5;
/// How far a matrix may be from the identity and still be written as a translation.
const TRANSLATION_TOLERANCE: f64 = 1e-12;

/// Where edited materials go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Materials {
    /// Into the Material nodes that they come from.
    Nodes,
    /// Around the shapes that have them.
    Shapes,
}

/// The changed text.
pub(crate) struct Patched {
    pub(crate) text: Vec<u8>,
    /// New names of images that were edited and whose old names are taken.
    pub(crate) renamed_images: BTreeMap<String, String>,
}

/// Puts all edits into the text.
///
/// # Errors
///
/// Says which edit has no place.
pub(crate) fn patch(
    tree: &Tree<'_>,
    was: &Again,
    is: &Objects,
    edits: &Edits,
    image_names: &BTreeMap<String, String>,
    materials: Materials,
) -> Result<Patched, No> {
    let mut patcher = Patcher {
        tree,
        edits: TextEdits::new(tree),
        scene: &was.scene,
        was,
        is,
        nodes: nodes_by_place(tree),
        frames_of: world_frames(&was.objects),
        wrapped: BTreeSet::new(),
    };
    for &(at, to) in &edits.names {
        patcher.name(at, to)?;
    }
    for &(at, to) in &edits.frames {
        patcher.frame(at, to)?;
    }
    for (&at, &to) in &edits.materials {
        match materials {
            Materials::Nodes => patcher.material(at, to)?,
            Materials::Shapes => patcher.material_around_shapes(at, to)?,
        }
    }
    for (&at, &to) in &edits.lights {
        patcher.light(at, to)?;
    }
    for (&at, &to) in &edits.cameras {
        patcher.camera(at, to)?;
    }
    for (&at, &to) in &edits.meshes {
        patcher.mesh(at, to)?;
    }
    for (old, new) in image_names {
        patcher.image(old, new)?;
    }
    let text = patcher
        .edits
        .apply()
        .ok_or("two edits touch the same place of the text")?;
    Ok(Patched {
        text,
        renamed_images: image_names.clone(),
    })
}

/// The tree's nodes by line and column.
fn nodes_by_place(tree: &Tree<'_>) -> BTreeMap<(u32, u32), TreeId> {
    let mut lines = LineCounter::new(0);
    let ids = (0..tree.node_count() as u32).map(TreeId);
    let mut starts: Vec<(usize, TreeId)> = ids
        .map(|id| (tree.node(id).span.start as usize, id))
        .collect();
    starts.sort_by_key(|(start, _)| *start);
    let place = |(start, id)| {
        let pos = lines.position(tree.source, start);
        ((pos.line, pos.column), id)
    };
    starts.into_iter().map(place).collect()
}

/// The frame of each glTF node's parent in the world.
fn world_frames(objects: &Objects) -> Vec<DAffine3> {
    let mut frames = vec![DAffine3::IDENTITY; objects.nodes.len()];
    let mut seen = BTreeSet::new();
    let mut open = objects.roots.clone();
    while let Some(at) = open.pop() {
        let Some(node) = objects.nodes.get(at).filter(|_| seen.insert(at)) else {
            continue;
        };
        let world_from_local = frames[at] * node.parent_from_local;
        for &child in &node.children {
            if let Some(frame) = frames.get_mut(child) {
                *frame = world_from_local;
            }
        }
        open.extend(&node.children);
    }
    frames
}

struct Patcher<'p, 't, 'a> {
    tree: &'t Tree<'a>,
    edits: TextEdits<'t, 'a>,
    scene: &'p Scene,
    was: &'p Again,
    is: &'p Objects,
    nodes: BTreeMap<(u32, u32), TreeId>,
    /// Of each node's parent.
    frames_of: Vec<DAffine3>,
    /// What stands around nodes; once, however often they are used.
    wrapped: BTreeSet<(usize, String)>,
}

impl Patcher<'_, '_, '_> {
    fn node_at(&self, pos: SourcePos) -> Result<TreeId, No> {
        if pos.file != 0 {
            return Err("what was edited stands in an included file".to_owned());
        }
        let found = self.nodes.get(&(pos.line, pos.column));
        found
            .copied()
            .ok_or_else(|| "what was edited has no node of its own".to_owned())
    }

    fn class(&self, node: TreeId) -> &str {
        let class = std::str::from_utf8(self.tree.node(node).class).unwrap_or_default();
        class.strip_prefix("So").unwrap_or(class)
    }

    fn origin(&self, at: usize) -> Result<Origin, No> {
        let found = self.was.origins.nodes.get(at).copied();
        found.ok_or_else(|| "a node has no origin".to_owned())
    }

    fn set(&mut self, node: TreeId, field: &str, value: &str) -> Result<(), No> {
        match self.edits.set_field(node, field, value) {
            true => Ok(()),
            false => Err(format!("`{field}` is connected to another field")),
        }
    }

    /// A Separator around a place of the text, with something ahead of what stands there; once,
    /// however often it is asked for.
    fn wrap(&mut self, place: &Range<usize>, def: &str, ahead: &str) {
        if self.wrapped.insert((place.start, ahead.to_owned())) {
            let before = format!("{def}Separator {{ {ahead} ");
            self.edits.wrap_reference(place, &before, " }");
        }
    }

    /// Where the text has the `nth` of `count` occurrences of a node in the scene: each is written
    /// once, or all come from one place, which is then meant for all.
    fn place(&self, node: TreeId, (nth, count): (usize, usize)) -> Range<usize> {
        let mut places = self.edits.references(node);
        let at = if places.len() == count { nth } else { 0 };
        places.swap_remove(at)
    }

    /// Which occurrence of its node a group is, and of how many.
    fn group_occurrence(&self, group: NodeId) -> (usize, usize) {
        let nodes = &self.scene.nodes;
        let pos = nodes[group.index()].pos;
        let same =
            |nodes: &[scenegraph::scene::Node]| nodes.iter().filter(|n| n.pos == pos).count();
        (same(&nodes[..group.index()]), same(nodes))
    }

    /// As [`Self::group_occurrence`], of a shape.
    fn instance_occurrence(&self, i: usize) -> (usize, usize) {
        let all = &self.scene.instances;
        let pos = all[i].placement.pos;
        let same = |list: &[Instance]| list.iter().filter(|i| i.placement.pos == pos).count();
        (same(&all[..i]), same(all))
    }

    fn item_pos(&self, item: Item) -> SourcePos {
        match item {
            Item::Instance(i) => self.scene.instances[i].placement.pos,
            Item::Light(i) => self.scene.lights[i].placement.pos,
            Item::Camera(i) => self.scene.cameras[i].placement.pos,
        }
    }

    /// The groups of an origin, from the innermost outwards.
    fn groups(&self, origin: &Origin) -> Vec<NodeId> {
        let Some((outer, inner)) = origin.groups else {
            return Vec::new();
        };
        let mut groups = vec![inner];
        let mut at = inner;
        while at != outer
            && let Some(parent) = self.scene.nodes[at.index()].parent
        {
            groups.push(parent);
            at = parent;
        }
        groups
    }

    fn name(&mut self, at: usize, to: usize) -> Result<(), No> {
        let origin = self.origin(at)?;
        let new = self.is.nodes[to].name.as_deref().and_then(legal_name);
        let new = new.ok_or("a name was removed")?.into_owned();
        let old = self.was.objects.nodes[at].name.as_deref();
        let named = |group: &&NodeId| self.scene.nodes[group.index()].name.as_deref() == old;
        let groups = self.groups(&origin);
        let group = match old {
            Some(_) => groups.iter().find(named),
            None => groups.last(),
        };
        let (pos, occurrence) = match (group, origin.item) {
            (Some(&group), _) => (
                self.scene.nodes[group.index()].pos,
                self.group_occurrence(group),
            ),
            (None, Some(Item::Instance(i))) => (
                self.item_pos(Item::Instance(i)),
                self.instance_occurrence(i),
            ),
            (None, Some(item)) => (self.item_pos(item), (0, 1)),
            (None, None) => return Err("a name stands nowhere in the source".to_owned()),
        };
        let node = self.node_at(pos)?;
        match occurrence {
            (_, 1) => self.edits.rename(node, &new),
            _ => {
                let place = self.place(node, occurrence);
                self.wrap(&place, &format!("DEF {new} "), "");
            }
        }
        Ok(())
    }

    fn frame(&mut self, at: usize, to: usize) -> Result<(), No> {
        let origin = self.origin(at)?;
        if origin.is_split {
            return Err("a sheared transform was edited".to_owned());
        }
        let old = self.was.objects.nodes[at].parent_from_local;
        let new = self.is.nodes[to].parent_from_local;
        match origin.item {
            Some(Item::Light(i)) => return self.move_light(i, self.frames_of[at] * new),
            Some(Item::Camera(i)) => return self.move_camera(i, self.frames_of[at] * new),
            _ => {}
        }
        let groups = self.groups(&origin);
        if let (Some(&outer), Some(&inner)) = (groups.last(), groups.first()) {
            let occurrence = self.group_occurrence(outer);
            // A change inside would be one of the members' frames, not of the group's.
            if occurrence.1 > 1 || origin.item.is_none() {
                // outer * change * rest = new, where outer * rest = old.
                let outside = self.scene.nodes[outer.index()].parent_from_local;
                let change = outside.inverse() * new * old.inverse() * outside;
                let node = self.node_at(self.scene.nodes[outer.index()].pos)?;
                let place = self.place(node, occurrence);
                self.wrap(&place, "", &transform_text(&tidy(change)?));
                return Ok(());
            }
            // outer * inner * change * rest = new, where outer * inner * rest = old.
            let product = |frame: DAffine3, group: &NodeId| {
                self.scene.nodes[group.index()].parent_from_local * frame
            };
            let outside = groups.iter().fold(DAffine3::IDENTITY, product);
            let rest = outside.inverse() * old;
            let change = tidy(outside.inverse() * new * rest.inverse())?;
            let node = self.node_at(self.scene.nodes[inner.index()].pos)?;
            return self.move_contents(node, &change);
        }
        let Some(Item::Instance(i)) = origin.item else {
            return Err("a transform stands nowhere in the source".to_owned());
        };
        let instance = &self.scene.instances[i];
        let origin_of_mesh = self.scene.meshes[instance.mesh.index()].origin;
        let local = instance.placement.parent_from_local;
        let back = DAffine3::from_translation(-origin_of_mesh);
        let change = tidy(local.inverse() * new * back)?;
        let node = self.node_at(instance.placement.pos)?;
        let place = self.place(node, self.instance_occurrence(i));
        self.wrap(&place, "", &transform_text(&change));
        Ok(())
    }

    /// Moves all in a group: by its first transform where that can take the change in, else by one
    /// more ahead of it.
    fn move_contents(&mut self, group: TreeId, change: &DAffine3) -> Result<(), No> {
        let first = self.tree.items(group).iter().find_map(|item| match item {
            iv_parser::Item::Child(iv_parser::Child::Node(id)) => {
                let says_nothing = matches!(self.class(*id), "Label" | "Info");
                (!says_nothing).then_some(*id)
            }
            _ => None,
        });
        let is_translation = change.matrix3 == DMat3::IDENTITY;
        if let Some(first) = first
            && self.tree.node(first).def.is_none()
            && is_translation
            && matches!(self.class(first), "Translation" | "Transform")
            && let Some(old) = self.triple(first, "translation")
        {
            let moved = tidy_triple(old + change.translation);
            return self.set(first, "translation", &triple_text(moved));
        }
        match self.edits.insert_first(group, &transform_text(change)) {
            true => Ok(()),
            false => Err("a group has no body".to_owned()),
        }
    }

    /// Three numbers of a field; `None` unless it has just them and nothing else plays a part.
    fn triple(&self, node: TreeId, field: &str) -> Option<DVec3> {
        let field = self.edits.field(node, field)?;
        if field.ignored || field.connection.is_some() {
            return None;
        }
        match self.numbers(&field.value)?[..] {
            [x, y, z] => Some(DVec3::new(x, y, z)),
            _ => None,
        }
    }

    fn numbers(&self, value: &iv_parser::Value) -> Option<Vec<f64>> {
        let iv_parser::Value::Numbers { numbers, .. } = value else {
            return None;
        };
        let ints = self.tree.ints(numbers);
        let floats = self.tree.floats(numbers).map(<[f64]>::to_vec);
        floats.or_else(|| Some(ints?.iter().map(|&i| f64::from(i)).collect()))
    }

    fn material(&mut self, at: usize, to: usize) -> Result<(), No> {
        let id = *self
            .was
            .origins
            .materials
            .get(at)
            .ok_or("a material has no origin")?;
        let source = &self.scene.materials[id.index()];
        let (old, new) = (
            &self.was.objects.materials[at].material,
            &self.is.materials[to].material,
        );
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
    fn material_around_shapes(&mut self, at: usize, to: usize) -> Result<(), No> {
        let id = *self
            .was
            .origins
            .materials
            .get(at)
            .ok_or("a material has no origin")?;
        let source = &self.scene.materials[id.index()];
        let (old, new) = (
            &self.was.objects.materials[at].material,
            &self.is.materials[to].material,
        );
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
        for (i, instance) in self.scene.instances.iter().enumerate() {
            if instance.material == id {
                let node = self.node_at(instance.placement.pos)?;
                let place = self.place(node, self.instance_occurrence(i));
                self.wrap(&place, "", &ahead);
            }
        }
        Ok(())
    }

    fn light(&mut self, at: usize, to: usize) -> Result<(), No> {
        let (Some(Some((old, _))), Some(Some((new, _)))) =
            (self.was.objects.lights.get(at), self.is.lights.get(to))
        else {
            return Err("a light has another type".to_owned());
        };
        let source = self.scene.lights.get(at).ok_or("a light has no origin")?;
        let node = self.node_at(source.placement.pos)?;
        let strength = source.intensity;
        if old.color_srgb != new.color_srgb {
            let [r, g, b] = new.color_srgb.map(|v| v as f32);
            self.set(node, "color", &format!("{r} {g} {b}"))?;
        }
        if old.intensity != new.intensity {
            if old.intensity <= 0.0 {
                return Err("a light without strength was given some".to_owned());
            }
            // What glTF's strength is made of besides stays as it is.
            let value = strength * new.intensity / old.intensity;
            self.set(node, "intensity", &format!("{}", value as f32))?;
        }
        self.cone(node, old, new)
    }

    fn cone(&mut self, node: TreeId, old: &Light, new: &Light) -> Result<(), No> {
        let angles = |light: &Light| match light.kind {
            LightKind::Spot {
                drop_off_rate,
                cut_off_angle_rad,
                ..
            } => Some([drop_off_rate, cut_off_angle_rad]),
            _ => None,
        };
        if std::mem::discriminant(&old.kind) != std::mem::discriminant(&new.kind) {
            return Err("a light has another type".to_owned());
        }
        let (Some(old), Some(new)) = (angles(old), angles(new)) else {
            return Ok(());
        };
        for (i, field) in ["dropOffRate", "cutOffAngle"].into_iter().enumerate() {
            if old[i] != new[i] {
                self.set(node, field, &format!("{}", new[i] as f32))?;
            }
        }
        Ok(())
    }

    /// `world_from_light` is the frame of the light's glTF node.
    fn move_light(&mut self, i: usize, world_from_light: DAffine3) -> Result<(), No> {
        let light = &self.scene.lights[i];
        let node = self.node_at(light.placement.pos)?;
        let local_from_light = light.placement.world_from_local.inverse() * world_from_light;
        let location = tidy_triple(local_from_light.translation);
        let direction = local_from_light
            .transform_vector3(DVec3::NEG_Z)
            .normalize_or(DVec3::NEG_Z);
        if !location.is_finite() {
            return Err("a light stands in a frame without an inverse".to_owned());
        }
        if !matches!(light.kind, LightKind::Directional { .. }) {
            self.set(node, "location", &triple_text(location))?;
        }
        if !matches!(light.kind, LightKind::Point { .. }) {
            self.set(node, "direction", &triple_text(tidy_triple(direction)))?;
        }
        Ok(())
    }

    fn move_camera(&mut self, i: usize, world_from_camera: DAffine3) -> Result<(), No> {
        let camera = &self.scene.cameras[i];
        let node = self.node_at(camera.placement.pos)?;
        let local = camera.placement.world_from_local.inverse() * world_from_camera;
        let columns = [
            local.matrix3.x_axis,
            local.matrix3.y_axis,
            local.matrix3.z_axis,
        ];
        if !local.is_finite() || columns.iter().any(|c| c.length() == 0.0) {
            return Err("a camera stands in a frame without an inverse".to_owned());
        }
        let [x, y, z] = columns.map(DVec3::normalize);
        let rotation = DQuat::from_mat3(&DMat3::from_cols(x, y, z));
        let (axis, angle_rad) = rotation.normalize().to_axis_angle();
        self.set(
            node,
            "position",
            &triple_text(tidy_triple(local.translation)),
        )?;
        let axis = triple_text(tidy_triple(axis));
        self.set(node, "orientation", &format!("{axis} {angle_rad}"))
    }

    fn camera(&mut self, at: usize, to: usize) -> Result<(), No> {
        let (Some(Some(old)), Some(Some(new))) =
            (self.was.objects.cameras.get(at), self.is.cameras.get(to))
        else {
            return Err("a camera has another type".to_owned());
        };
        let source = self.scene.cameras.get(at).ok_or("a camera has no origin")?;
        let node = self.node_at(source.placement.pos)?;
        let frame = source.placement.world_from_local;
        let unit_length = frame
            .transform_vector3(source.orientation * DVec3::NEG_Z)
            .length();
        let unit_height = frame
            .transform_vector3(source.orientation * DVec3::Y)
            .length();
        match (old.projection, new.projection) {
            (
                Projection::Perspective {
                    height_angle_rad: a,
                },
                Projection::Perspective {
                    height_angle_rad: b,
                },
            ) if a != b => self.set(node, "heightAngle", &format!("{b}"))?,
            (Projection::Orthographic { height: a }, Projection::Orthographic { height: b })
                if a != b =>
            {
                self.set(node, "height", &format!("{}", b / unit_height))?;
            }
            (Projection::Perspective { .. }, Projection::Perspective { .. })
            | (Projection::Orthographic { .. }, Projection::Orthographic { .. }) => {}
            _ => return Err("a camera has another type".to_owned()),
        }
        let rows = [
            (
                "nearDistance",
                old.near_distance,
                new.near_distance,
                unit_length,
            ),
            (
                "farDistance",
                old.far_distance,
                new.far_distance,
                unit_length,
            ),
            ("aspectRatio", old.aspect_ratio, new.aspect_ratio, 1.0),
        ];
        for (field, old, new, unit) in rows {
            if old != new {
                self.set(node, field, &format!("{}", new / unit))?;
            }
        }
        Ok(())
    }

    fn mesh(&mut self, at: usize, to: usize) -> Result<(), No> {
        let id = *self
            .was
            .origins
            .meshes
            .get(at)
            .ok_or("a mesh has no origin")?;
        let source = &self.scene.meshes[id.index()];
        let [primitive] = self.is.meshes[to].as_slice() else {
            return Err("a mesh of several parts was edited".to_owned());
        };
        let Some(mesh) = primitive.mesh.as_ref().filter(|m| m.colors_srgb.is_empty()) else {
            return Err("a mesh with colours of its own was edited".to_owned());
        };
        let node = self.node_at(source.pos)?;
        let material = self
            .scene
            .instances
            .iter()
            .find(|i| i.mesh == id)
            .map(|i| i.material);
        let faces = material.map(|id| self.scene.materials[id.index()].faces);
        let hints = hints(faces.unwrap_or(Faces::BothOneSidedLighting));
        let shape = Mesh {
            origin: source.origin + mesh.origin,
            ..mesh.clone()
        };
        let text = write_shape(&shape, 0);
        self.edits.replace(node, text.trim_ascii());
        for place in self.edits.references(node) {
            self.wrap(&place, "", &format!("ShapeHints {{ {hints} }}"));
        }
        Ok(())
    }

    /// Gives an image's file another name where textures call it.
    fn image(&mut self, old: &str, new: &str) -> Result<(), No> {
        let mut found = false;
        for texture in &self.scene.textures {
            let TextureSource::File { name, beside } = &texture.source else {
                continue;
            };
            if target(&beside.to_string_lossy(), name).as_deref() != Some(old) {
                continue;
            }
            let node = self.node_at(texture.pos)?;
            self.set(node, "filename", &format!("\"{new}\""))?;
            found = true;
        }
        match found {
            true => Ok(()),
            false => Err("an image was edited that no texture names".to_owned()),
        }
    }
}

/// Fields of a `ShapeHints`.
fn hints(faces: Faces) -> &'static str {
    match faces {
        Faces::FrontOnly => "vertexOrdering COUNTERCLOCKWISE shapeType SOLID",
        Faces::BothTwoSidedLighting => {
            "vertexOrdering COUNTERCLOCKWISE shapeType UNKNOWN_SHAPE_TYPE"
        }
        Faces::BothOneSidedLighting => {
            "vertexOrdering UNKNOWN_ORDERING shapeType UNKNOWN_SHAPE_TYPE"
        }
    }
}

/// A `Material` on one line.
fn material_text(material: &Material) -> String {
    let name = material.name.as_deref().and_then(legal_name);
    let mut text = name.map_or(String::new(), |name| format!("DEF {name} "));
    text += "Material {";
    for (field, [r, g, b]) in [
        ("ambientColor", material.ambient_srgb),
        ("diffuseColor", material.diffuse_srgb),
        ("specularColor", material.specular_srgb),
        ("emissiveColor", material.emissive_srgb),
    ] {
        // Writing to a String does not fail.
        let _ = write!(text, " {field} {r} {g} {b}");
    }
    let (shininess, transparency) = (material.shininess, material.transparency);
    let _ = write!(text, " shininess {shininess} transparency {transparency}");
    text + " }"
}

/// A change of frame to 15 digits, its linear part left out where it is none.
fn tidy(mut change: DAffine3) -> Result<DAffine3, No> {
    if !change.is_finite() {
        return Err("a frame without an inverse was edited".to_owned());
    }
    let off = (change.matrix3 - DMat3::IDENTITY).to_cols_array();
    if off.iter().all(|v| v.abs() <= TRANSLATION_TOLERANCE) {
        change.matrix3 = DMat3::IDENTITY;
    }
    change.translation = tidy_triple(change.translation);
    Ok(change)
}

fn tidy_triple(v: DVec3) -> DVec3 {
    let most = v.abs().max_element();
    let tidy = |x: f64| {
        // Rounding of the largest shows in the others.
        let x = if x.abs() <= most * 1e-15 { 0.0 } else { x };
        format!("{x:.14e}").parse().unwrap_or(x)
    };
    DVec3::new(tidy(v.x), tidy(v.y), tidy(v.z))
}

fn triple_text(v: DVec3) -> String {
    format!("{} {} {}", v.x, v.y, v.z)
}

fn transform_text(change: &DAffine3) -> String {
    if change.matrix3 == DMat3::IDENTITY {
        let translation = triple_text(change.translation);
        return format!("Translation {{ translation {translation} }}");
    }
    let mut text = String::from("MatrixTransform { matrix");
    for value in glam::DMat4::from(*change).to_cols_array() {
        // Writing to a String does not fail.
        let _ = write!(text, " {value}");
    }
    text + " }"
}
