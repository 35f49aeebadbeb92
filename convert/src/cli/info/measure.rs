//! Counts and bounds of a model, from its graph and from what resolving measured.

use std::collections::BTreeMap;

use geometry::bounds::Aabb;
use iv_parser::Header;
use scenegraph::graph::{FieldValue, Graph};
use scenegraph::scene::{LightKind, Projection, Scene, TextureSource, Topology};
use scenegraph::{Measure, Resolved};

/// Things stored, and things drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Amount {
    /// Each mesh counted once.
    pub unique: u64,
    /// Each use counted.
    pub instanced: u64,
}

/// Where the pixels of a texture are.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TextureKind {
    /// In a file of this name, as written.
    File(String),
    /// In the model: width, height, components, bytes.
    Inline(u32, u32, u8, usize),
}

/// What is in a model.
#[derive(Clone, Debug)]
pub struct Content {
    /// All files read, the model itself first.
    pub files: Vec<(String, Header)>,
    /// Nodes of each class, each node counted once however often it is used. Included files and
    /// nodes in fields count.
    pub classes: BTreeMap<String, usize>,
    /// Meshes; each use of one is an instance.
    pub meshes: Amount,
    /// Triangles, without degenerate ones.
    pub triangles: Amount,
    /// Line segments.
    pub lines: Amount,
    /// Points.
    pub points: Amount,
    /// Materials that differ.
    pub materials: usize,
    /// Textures that are shown, in order of appearance.
    pub textures: Vec<TextureKind>,
    /// Lights that are on: directional, point, spot.
    pub lights: [usize; 3],
    /// Cameras: perspective, orthographic.
    pub cameras: [usize; 2],
    /// Around all that is drawn, in the world.
    pub bounds: Aabb,
}

impl Content {
    /// What is in a model that was resolved with measures only.
    pub fn of(graph: &Graph, resolved: &Resolved) -> Self {
        let scene = &resolved.scene;
        let files = graph.files.iter();
        let mut content = Self {
            files: files.map(|f| (f.name.to_string(), f.header)).collect(),
            classes: classes(graph),
            meshes: Amount::default(),
            triangles: Amount::default(),
            lines: Amount::default(),
            points: Amount::default(),
            materials: scene.materials.len(),
            textures: textures(scene),
            lights: [0; 3],
            cameras: [0; 2],
            bounds: Aabb::EMPTY,
        };
        for light in &scene.lights {
            let kind = match light.kind {
                LightKind::Directional { .. } => 0,
                LightKind::Point { .. } => 1,
                LightKind::Spot { .. } => 2,
            };
            content.lights[kind] += 1;
        }
        for camera in &scene.cameras {
            let kind = match camera.projection {
                Projection::Perspective { .. } => 0,
                Projection::Orthographic { .. } => 1,
            };
            content.cameras[kind] += 1;
        }
        content.shapes(scene, &resolved.measures);
        content
    }

    /// The number of nodes of all classes.
    pub fn node_count(&self) -> usize {
        self.classes.values().sum()
    }

    fn shapes(&mut self, scene: &Scene, measures: &[Measure]) {
        let mut is_counted = vec![false; measures.len()];
        for instance in &scene.instances {
            let index = instance.mesh.index();
            let Some(measure) = measures.get(index) else {
                continue;
            };
            let is_new = !std::mem::replace(&mut is_counted[index], true);
            let primitives = match measure.topology {
                Topology::Triangles => &mut self.triangles,
                Topology::Lines => &mut self.lines,
                Topology::Points => &mut self.points,
            };
            primitives.add(measure.primitives as u64, is_new);
            self.meshes.add(1, is_new);
            let in_world = measure
                .bounds
                .transformed(&instance.placement.world_from_local);
            self.bounds = self.bounds.union(&in_world);
        }
    }
}

impl Amount {
    fn add(&mut self, count: u64, is_new: bool) {
        self.instanced = self.instanced.saturating_add(count);
        if is_new {
            self.unique = self.unique.saturating_add(count);
        }
    }
}

/// Nodes by class: all that can be reached from the root by way of children and fields.
fn classes(graph: &Graph) -> BTreeMap<String, usize> {
    let mut by_name: BTreeMap<&str, usize> = BTreeMap::new();
    let mut is_seen = vec![false; graph.nodes().len()];
    let mut open = vec![graph.root];
    while let Some(id) = open.pop() {
        let Some(seen) = is_seen.get_mut(id.0 as usize) else {
            continue;
        };
        if std::mem::replace(seen, true) {
            continue;
        }
        let node = graph.node(id);
        *by_name.entry(node.class_name()).or_default() += 1;
        open.extend(&node.children);
        for field in &node.fields {
            if let FieldValue::Nodes(nodes) = &field.value {
                open.extend(nodes);
            }
        }
    }
    let owned = by_name.into_iter().map(|(name, n)| (name.to_owned(), n));
    owned.collect()
}

fn textures(scene: &Scene) -> Vec<TextureKind> {
    let kind = |source: &TextureSource| match source {
        TextureSource::Inline(image) => TextureKind::Inline(
            image.width,
            image.height,
            image.components,
            image.bytes.len(),
        ),
        TextureSource::File { name, .. } => TextureKind::File(name.to_string()),
        TextureSource::Encoded { name, .. } => {
            TextureKind::File(name.as_deref().unwrap_or("embedded image").to_owned())
        }
    };
    scene.textures.iter().map(|t| kind(&t.source)).collect()
}
