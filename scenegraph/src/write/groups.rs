//! The hierarchy: Separators around groups and shapes, on an explicit stack.

use glam::{DAffine3, DMat3};
use rustc_hash::FxHashMap;

use crate::scene::{
    Camera, Coarser, Environment, EnvironmentId, LightId, Link, MaterialId, MeshId, NodeId,
    Placement, Scene, Shown, TextureId,
};

use super::lights::{Lights, Part};
use super::look::{self, Look};
use super::names::{Shared, legal};
use super::shape::{self, Palette};
use super::text::Text;
use super::{ImageForm, SceneText, cameras, levels};

/// What a group holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Member {
    Group(NodeId),
    Item(usize),
}

/// What is left to write, last first.
pub(super) enum Step {
    Part(Part),
    /// Opens a group of levels with these limits.
    Levels(Vec<Coarser>),
    /// Opens a Separator without a name.
    Separator,
    Close,
    /// Closes a group that is no Separator.
    CloseChoice,
}

/// How often something is used, and what it is called once it is written.
#[derive(Default)]
struct Uses {
    count: usize,
    name: Option<String>,
}

/// A material's node: with a palette it belongs to one mesh.
type LookKey = (MaterialId, Option<MeshId>);

pub(super) struct Writer<'s> {
    scene: &'s Scene,
    images: &'s [ImageForm],
    text: Text,
    members: Vec<Vec<Member>>,
    lights: Lights,
    materials: FxHashMap<LookKey, Uses>,
    meshes: Vec<Uses>,
    textures: Vec<Uses>,
    shared: Shared,
    in_force: Look,
    /// The environment in force in each open Separator.
    environments: Vec<Environment>,
    renamed: usize,
}

impl<'s> Writer<'s> {
    pub(super) fn new(scene: &'s Scene, images: &'s [ImageForm]) -> Self {
        let members = members(scene);
        let mut materials: FxHashMap<LookKey, Uses> = FxHashMap::default();
        let mut meshes = Vec::new();
        meshes.resize_with(scene.meshes.len(), Uses::default);
        let mut textures = Vec::new();
        textures.resize_with(scene.textures.len(), Uses::default);
        for instance in &scene.instances {
            let key = look_key(scene, instance.mesh, instance.material);
            materials.entry(key).or_default().count += 1;
            meshes[instance.mesh.index()].count += 1;
            if let Some(texture) = scene.materials[instance.material.index()].texture {
                textures[texture.index()].count += 1;
            }
        }
        Self {
            scene,
            images,
            text: Text::default(),
            lights: Lights::new(scene, &members),
            members,
            materials,
            meshes,
            textures,
            shared: Shared::default(),
            in_force: Look::DEFAULT,
            environments: vec![Environment::default()],
            renamed: 0,
        }
    }

    pub(super) fn write(mut self) -> SceneText {
        self.text.raw("#Inventor V2.1 ascii\n\n");
        let world = self.members.pop().unwrap_or_default();
        let root = match *world {
            [Member::Group(only)] => self.root_frame_is_free(only).then_some(only),
            _ => None,
        };
        let name = root.and_then(|root| self.scene.nodes[root.index()].name.as_deref());
        let link = root.and_then(|root| self.scene.nodes[root.index()].link.as_deref());
        self.open(name, link);
        self.views();
        let parts = self.lights.order(None, &world);
        let mut parts: Vec<Step> = parts.into_iter().map(Step::Part).collect();
        if let Some(root) = root
            && let Some(at) = parts
                .iter()
                .position(|step| matches!(step, Step::Part(Part::Member(_))))
        {
            // What lights all stands in the root's frame, which is the world's.
            parts.splice(at..=at, self.body(root));
        }
        let mut steps = vec![Step::Close];
        steps.extend(parts.into_iter().rev());
        while let Some(step) = steps.pop() {
            match step {
                Step::Close => self.close(),
                Step::CloseChoice => self.text.close(),
                Step::Separator => self.open(None, None),
                Step::Levels(limits) => levels::open(&mut self.text, &limits),
                Step::Part(Part::Light(light)) => self.light(light),
                Step::Part(Part::Member(Member::Item(i))) => self.item(i),
                Step::Part(Part::Member(Member::Group(node))) => {
                    let source = &self.scene.nodes[node.index()];
                    if source.shown == Shown::Hidden {
                        // A Switch shows nothing by default.
                        self.text.open(None, "Switch");
                        steps.push(Step::CloseChoice);
                    }
                    self.open(source.name.as_deref(), source.link.as_deref());
                    let parts = self.body(node);
                    steps.push(Step::Close);
                    steps.extend(parts.into_iter().rev());
                }
            }
        }
        SceneText {
            text: self.text.into_bytes(),
            renamed: self.renamed,
            lit_by_more: self.lights.lit_by_more,
        }
    }

    /// Whether a group can be the root of the text: nothing else is in the world, or its frame is
    /// the world's.
    fn root_frame_is_free(&self, root: NodeId) -> bool {
        let root = &self.scene.nodes[root.index()];
        let frame = root.parent_from_local;
        if root.shown != Shown::Always {
            return false;
        }
        let alone = self.scene.cameras.is_empty() && self.scene.lights.is_empty();
        frame == DAffine3::IDENTITY || alone
    }

    /// `DEF name Separator {`, with a label if the name had to be changed; a `WWWAnchor`, which is
    /// one, if it leads somewhere. That has room for one address.
    fn open(&mut self, name: Option<&str>, link: Option<&Link>) {
        let def = name.and_then(legal);
        let url = link.and_then(|link| link.urls.first());
        let class = url.map_or("Separator", |_| "WWWAnchor");
        self.text.open(def.as_deref(), class);
        if let (Some(url), Some(link)) = (url, link) {
            self.text.string("name", url);
            self.text.string("description", &link.description);
            if link.tells_point {
                self.text.word("map", "POINT");
            }
        }
        self.label(name);
        let environment = self.environments.last().cloned().unwrap_or_default();
        self.environments.push(environment);
    }

    fn close(&mut self) {
        self.environments.pop();
        self.text.close();
    }

    /// The name itself where Inventor cannot write it.
    fn label(&mut self, name: Option<&str>) {
        let Some(name) = name.filter(|name| !name.is_empty()) else {
            return;
        };
        if legal(name).as_deref() != Some(name) {
            self.renamed += 1;
            self.text.open(None, "Label");
            self.text.string("label", name);
            self.text.close();
        }
    }

    /// The notes and the frame of a group that was opened; gives what it holds.
    fn body(&mut self, node: NodeId) -> Vec<Step> {
        let source = &self.scene.nodes[node.index()];
        for note in &source.notes {
            self.text.open(None, "Info");
            self.text.string("string", note);
            self.text.close();
        }
        self.frame(&source.parent_from_local);
        let members = std::mem::take(&mut self.members[node.index()]);
        let parts = self.lights.order(Some(node), &members);
        let (steps, lit_by_more) = levels::steps(self.scene, parts);
        self.lights.lit_by_more += lit_by_more;
        steps
    }

    fn frame(&mut self, frame: &DAffine3) {
        if frame.matrix3 != DMat3::IDENTITY {
            let columns = glam::DMat4::from(*frame).to_cols_array();
            self.text.open(None, "MatrixTransform");
            self.text.exact_numbers("matrix", &columns);
            self.text.close();
        } else if frame.translation != glam::DVec3::ZERO {
            self.text.open(None, "Translation");
            self.text
                .exact_numbers("translation", &frame.translation.to_array());
            self.text.close();
        }
    }

    /// What stands ahead of all shapes: what most shapes have in common, and the cameras. The first
    /// camera is the one that is looked through: it reaches the shapes, the others do not.
    fn views(&mut self) {
        if let Some(first) = self.scene.instances.first() {
            let look = Look::of(&self.scene.materials[first.material.index()]);
            look.write(&mut self.text, self.in_force);
            self.in_force = look;
            self.environment(first.environment);
        }
        for (i, camera) in self.scene.cameras.iter().enumerate() {
            self.camera(camera, i == 0);
        }
    }

    fn camera(&mut self, camera: &Camera, is_first: bool) {
        let frame = camera.placement.world_from_local;
        let pose = cameras::rigid(&frame);
        let name = camera.placement.name.as_deref();
        let def = name.and_then(legal);
        let around = match (is_first, pose) {
            (true, Some(_)) => None,
            (true, None) => Some("TransformSeparator"),
            (false, _) => Some("Separator"),
        };
        if let Some(class) = around {
            self.text.open(None, class);
        }
        self.label(name);
        if pose.is_none() {
            self.frame(&frame);
        }
        cameras::camera(
            &mut self.text,
            def.as_deref(),
            camera,
            pose.unwrap_or_default(),
        );
        if around.is_some() {
            self.text.close();
        }
    }

    fn light(&mut self, id: LightId) {
        let light = &self.scene.lights[id.index()];
        let home = self.lights.home_of(id);
        self.environment(light.environment);
        let name = light.placement.name.as_deref();
        self.label(name);
        let def = name.and_then(legal);
        let frame = self.frame_in(&light.placement, home);
        cameras::light(&mut self.text, def.as_deref(), light, &frame);
    }

    /// The frame of something in that of a group around it.
    fn frame_in(&self, placement: &Placement, group: Option<NodeId>) -> DAffine3 {
        if group.is_none() {
            return placement.world_from_local;
        }
        let mut frame = placement.parent_from_local;
        let mut at = placement.node;
        while let Some(node) = at
            && at != group
        {
            let node = &self.scene.nodes[node.index()];
            frame = node.parent_from_local * frame;
            at = node.parent;
        }
        frame
    }

    /// Writes an environment unless its values are in force.
    fn environment(&mut self, id: EnvironmentId) {
        let wanted = &self.scene.environments[id.index()];
        let Some(in_force) = self.environments.last_mut() else {
            return;
        };
        let same = Environment {
            pos: wanted.pos,
            ..in_force.clone()
        };
        if same != *wanted {
            in_force.clone_from(wanted);
            cameras::environment(&mut self.text, wanted);
        }
    }

    /// A shape in a Separator of its own. One that is used several times cannot have several names:
    /// there the Separator has it.
    fn item(&mut self, index: usize) {
        let scene = self.scene;
        let instance = &scene.instances[index];
        let mesh = &scene.meshes[instance.mesh.index()];
        let material = &scene.materials[instance.material.index()];
        let name = instance.placement.name.as_deref();
        let is_shared = self.meshes[instance.mesh.index()].count > 1;
        self.open(name.filter(|_| is_shared), None);
        if !is_shared {
            self.label(name);
        }
        self.environment(instance.environment);
        self.frame(&instance.placement.parent_from_local);
        Look::of(material).write(&mut self.text, self.in_force);
        look::draw_style(&mut self.text, material);
        let palette = Palette::new(mesh, material);
        self.material(instance.mesh, instance.material, &palette);
        if let Some(texture) = material.texture.filter(|_| !mesh.texcoords.is_empty()) {
            self.texture(texture);
        }
        if !palette.is_empty() {
            let binding = if palette.is_indexed() {
                "PER_VERTEX_INDEXED"
            } else {
                "PER_VERTEX"
            };
            self.text.open(None, "MaterialBinding");
            self.text.word("value", binding);
            self.text.close();
        }
        let own = name.filter(|_| !is_shared).and_then(legal);
        let uses = &mut self.meshes[instance.mesh.index()];
        match &uses.name {
            Some(known) => self.text.use_node(known),
            None => {
                let shared = is_shared.then(|| self.shared.name(None));
                let def = shared.as_deref().or(own.as_deref());
                shape::write(&mut self.text, mesh, def, &palette);
                uses.name = shared;
            }
        }
        self.close();
    }

    fn material(&mut self, mesh: MeshId, id: MaterialId, palette: &Palette) {
        let material = &self.scene.materials[id.index()];
        if palette.is_empty() && look::is_default(material) {
            return;
        }
        let uses = self
            .materials
            .entry(look_key(self.scene, mesh, id))
            .or_default();
        if let Some(known) = &uses.name {
            return self.text.use_node(known);
        }
        let name = material.name.as_deref();
        uses.name = (uses.count > 1).then(|| self.shared.name(name));
        let own = name.and_then(legal);
        let def = uses.name.as_deref().or(own.as_deref());
        look::material(&mut self.text, def, material, palette);
        self.label(name);
    }

    fn texture(&mut self, id: TextureId) {
        let image = self.images.get(id.index()).unwrap_or(&ImageForm::Missing);
        if *image == ImageForm::Missing {
            return;
        }
        let texture = &self.scene.textures[id.index()];
        let uses = &mut self.textures[id.index()];
        if let Some(known) = &uses.name {
            return self.text.use_node(known);
        }
        let name = texture.name.as_deref();
        uses.name = (uses.count > 1).then(|| self.shared.name(name));
        let own = name.and_then(legal);
        let def = uses.name.as_deref().or(own.as_deref());
        look::texture(&mut self.text, def, texture, image);
    }
}

/// Colours of the vertices stand in the material.
fn look_key(scene: &Scene, mesh: MeshId, material: MaterialId) -> LookKey {
    let colored = !scene.meshes[mesh.index()].colors_srgb.is_empty();
    (material, colored.then_some(mesh))
}

/// What each group holds, the world last; in the order of what is drawn, groups that hold nothing
/// behind the others.
fn members(scene: &Scene) -> Vec<Vec<Member>> {
    let world = scene.nodes.len();
    let slot = |node: Option<NodeId>| node.map_or(world, NodeId::index);
    let mut first = vec![usize::MAX; world + 1];
    for (i, instance) in scene.instances.iter().enumerate() {
        let at = slot(instance.placement.node);
        first[at] = first[at].min(i);
    }
    let mut members: Vec<Vec<(usize, Member)>> = vec![Vec::new(); world + 1];
    for (i, node) in scene.nodes.iter().enumerate().rev() {
        let at = slot(node.parent);
        first[at] = first[at].min(first[i]);
        members[at].push((first[i], Member::Group(NodeId(i as u32))));
    }
    for list in &mut members {
        list.reverse();
    }
    for (i, instance) in scene.instances.iter().enumerate() {
        members[slot(instance.placement.node)].push((i, Member::Item(i)));
    }
    let sorted = |mut list: Vec<(usize, Member)>| {
        list.sort_by_key(|(first, _)| *first);
        list.into_iter().map(|(_, member)| member).collect()
    };
    members.into_iter().map(sorted).collect()
}
