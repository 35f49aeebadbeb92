//! The objects of a glTF file one by one, with what glTF says of each and nothing of Inventor's
//! extras: what an editor shows and changes.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use glam::DAffine3;
use gltf::json::Index;
use iv_parser::SourcePos;
use rustc_hash::FxHashMap;
use scenegraph::Loader;
use scenegraph::scene::{Camera, Light, Material, Mesh, Placement, Wrap};
use serde_json::Value;

use super::budget::{Budget, ReadLimits};
use super::buffers::{Buffers, data_uri};
use super::camera::camera;
use super::document::{Document, ExactCamera, ExactNode};
use super::error::ReadError;
use super::frame::{copies, parent_from_local};
use super::iv::Iv;
use super::light::Lamp;
use super::made_by::MadeBy;
use super::material::Materials;
use super::mesh::Meshes;
use super::texture::{Textures, image_number, sampling};

/// The objects of a file; indices are the file's.
#[derive(Debug, Default)]
pub(crate) struct Objects {
    pub(crate) roots: Vec<usize>,
    pub(crate) nodes: Vec<NodeObject>,
    pub(crate) meshes: Vec<Vec<PrimitiveObject>>,
    /// A checksum of each mesh's positions and indices.
    pub(crate) mesh_sums: Vec<u32>,
    pub(crate) materials: Vec<MaterialObject>,
    /// `None` for those of a kind that is not known.
    pub(crate) lights: Vec<Option<(Light, [f64; 3])>>,
    pub(crate) cameras: Vec<Option<Camera>>,
    /// `None` for those that are not in the file.
    pub(crate) images: Vec<Option<Arc<[u8]>>>,
}

/// A node.
#[derive(Debug)]
pub(crate) struct NodeObject {
    pub(crate) name: Option<String>,
    pub(crate) parent_from_local: DAffine3,
    pub(crate) children: Vec<usize>,
    pub(crate) mesh: Option<usize>,
    pub(crate) light: Option<usize>,
    pub(crate) camera: Option<usize>,
    /// Frames of copies; just the identity as a rule.
    pub(crate) copies: Vec<DAffine3>,
    pub(crate) is_hidden: bool,
}

/// A part of a mesh; without a mesh if it shows nothing.
#[derive(Debug)]
pub(crate) struct PrimitiveObject {
    pub(crate) mesh: Option<Mesh>,
    pub(crate) material: Option<usize>,
    /// In variants, by their numbers.
    pub(crate) in_variants: BTreeMap<u64, usize>,
}

/// A material as Inventor's, and its image with how it is repeated.
#[derive(Debug)]
pub(crate) struct MaterialObject {
    pub(crate) material: Material,
    pub(crate) image: Option<(usize, [Wrap; 2])>,
}

/// `extras.iv.source` of a file's scene, or of its asset.
pub(crate) fn carried_source(bytes: &[u8]) -> Result<Option<Value>, ReadError> {
    // A search is cheaper than a second reading of a long text.
    if memchr::memmem::find(bytes, b"\"source\"").is_none() {
        return Ok(None);
    }
    let document = Document::parse(bytes)?;
    let root = &document.root;
    let scene = root.scene.map_or(0, |scene| scene.value());
    let scene = root
        .scenes
        .get(scene)
        .and_then(|scene| Iv::of(&scene.extras));
    let asset = Iv::of(&root.asset.extras);
    let sources = [scene, asset].into_iter().flatten();
    let mut found = sources.filter_map(|iv| {
        let source = iv.value("source")?;
        source["files"].is_array().then(|| source.clone())
    });
    Ok(found.next())
}

/// The images that are in a `.glb`.
pub(crate) fn images_of(glb: &[u8]) -> Result<Vec<Option<Arc<[u8]>>>, ReadError> {
    let document = Document::parse(glb)?;
    let mut budget = Budget::new(ReadLimits::default());
    let nothing = scenegraph::FileLoader::default();
    let buffers = Buffers::new(&document, Path::new(""), &nothing, &mut budget)?;
    Ok(images(&document, &buffers))
}

fn images(document: &Document, buffers: &Buffers) -> Vec<Option<Arc<[u8]>>> {
    // Images of one view share its bytes.
    let mut views: FxHashMap<usize, Arc<[u8]>> = FxHashMap::default();
    let mut image = |image: &gltf::json::Image| match (&image.buffer_view, &image.uri) {
        (Some(view), _) => {
            if let Some(known) = views.get(&view.value()) {
                return Some(Arc::clone(known));
            }
            let bytes: Arc<[u8]> = buffers.view(document, *view).ok()?.0.into();
            views.insert(view.value(), Arc::clone(&bytes));
            Some(bytes)
        }
        (None, Some(uri)) => Some(data_uri(uri)??.into()),
        (None, None) => None,
    };
    document.root.images.iter().map(&mut image).collect()
}

impl Objects {
    /// The objects of a file; see [`read_gltf`](super::read_gltf).
    pub(crate) fn read(
        bytes: &[u8],
        beside: &Path,
        loader: &dyn Loader,
        limits: &ReadLimits,
    ) -> Result<Self, ReadError> {
        let mut document = Document::parse(bytes)?;
        document.strip_extras();
        let mut budget = Budget::new(*limits);
        budget.grow(bytes.len() as u64)?;
        let buffers = Buffers::new(&document, beside, loader, &mut budget)?;
        let textures = Textures::new(&document, beside);
        let mut materials = Materials::new(&document, MadeBy::OTHERS, textures);
        let mut meshes = Meshes::new(&document, &buffers);
        let root = &document.root;
        let mut objects = Self {
            images: images(&document, &buffers),
            ..Self::default()
        };
        for (number, mesh) in root.meshes.iter().enumerate() {
            let extensions = document.exact.meshes.get(number);
            let mut primitives = Vec::new();
            for (part, primitive) in mesh.primitives.iter().enumerate() {
                let extensions = extensions.and_then(|mesh| mesh.primitives.get(part));
                let wants = materials.wants(primitive.material)?;
                let made = meshes.primitive(primitive, &wants, &mut budget)?;
                primitives.push(PrimitiveObject {
                    mesh: made.map(|id| meshes.meshes[id.index()].clone()),
                    material: primitive.material.map(|index| index.value()),
                    in_variants: extensions.map_or_else(BTreeMap::new, |e| e.material_by_variant()),
                });
            }
            objects.mesh_sums.push(sum_of(&primitives));
            objects.meshes.push(primitives);
        }
        for number in 0..root.materials.len() {
            let (material, texture) = materials.seen(Index::new(number as u32))?;
            let texture = texture.and_then(|number| root.textures.get(number));
            let image = texture.map(|t| (image_number(t), sampling(&document, t)));
            objects.materials.push(MaterialObject { material, image });
        }
        let lights = root
            .extensions
            .as_ref()
            .and_then(|e| e.khr_lights_punctual.as_ref());
        for light in lights.map_or(&[][..], |lights| &lights.lights) {
            let mut environments = Vec::new();
            let made = Lamp::new(light, MadeBy::OTHERS).map(|lamp| {
                let light = lamp.placed(nowhere(), &mut environments);
                let attenuation = environments.last().map_or([0.0; 3], |e| e.attenuation);
                (light, attenuation)
            });
            objects.lights.push(made);
        }
        for (i, source) in root.cameras.iter().enumerate() {
            let none = ExactCamera::default();
            let exact = document.exact.cameras.get(i).unwrap_or(&none);
            objects
                .cameras
                .push(camera(source, exact, MadeBy::OTHERS, nowhere()));
        }
        for (i, source) in root.nodes.iter().enumerate() {
            let none = ExactNode::default();
            let exact = document.exact.nodes.get(i).unwrap_or(&none);
            let extensions = source.extensions.as_ref();
            let light = extensions.and_then(|e| e.khr_lights_punctual.as_ref());
            let children = source.children.iter().flatten();
            objects.nodes.push(NodeObject {
                name: source.name.clone(),
                parent_from_local: parent_from_local(exact),
                // Coarser levels are no children, but hang on the node all the same.
                children: (children.map(|child| child.value()))
                    .chain(exact.coarser_levels())
                    .collect(),
                is_hidden: exact.is_hidden(),
                mesh: source.mesh.map(|mesh| mesh.value()),
                light: light.map(|light| light.light.value()),
                camera: source.camera.map(|camera| camera.value()),
                copies: copies(source, &document, &buffers, &mut budget)?,
            });
        }
        let shown = super::Shown::of(&document)?;
        objects.roots = shown.roots.iter().map(|root| root.value()).collect();
        Ok(objects)
    }
}

fn sum_of(primitives: &[PrimitiveObject]) -> u32 {
    let mut crc = flate2::Crc::new();
    for mesh in primitives.iter().filter_map(|p| p.mesh.as_ref()) {
        crc.update(bytemuck::cast_slice(&mesh.positions));
        crc.update(bytemuck::cast_slice(&mesh.indices));
    }
    crc.sum()
}

fn nowhere() -> Placement {
    Placement {
        node: None,
        parent_from_local: DAffine3::IDENTITY,
        world_from_local: DAffine3::IDENTITY,
        name: None,
        pos: SourcePos::default(),
    }
}
