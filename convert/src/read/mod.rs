//! glTF 2.0 into the scene that all consumers use: what [`write_glb`](crate::write_glb) wrote, and
//! ordinary files of others.
//!
//! A total function: any bytes give a scene that keeps its guarantees, or an error, in bounded time
//! and memory. Where `extras.iv` has Inventor's own values they are taken, unless glTF's were edited
//! since (`made_by`); else glTF's are approximated, as `material` and `light` say. Left out are animation, skins, morph targets,
//! further maps of a material than the base colour, and images' alpha where a material says it is
//! opaque.

mod accessor;
mod budget;
mod buffers;
mod camera;
mod compressed;
mod document;
mod error;
mod frame;
mod hierarchy;
mod iv;
mod light;
mod made_by;
mod material;
mod mesh;
mod normals;
mod objects;
mod settled;
mod texture;
mod topology;

use std::path::Path;

use gltf::json::Index;
use gltf::json::Node as JsonNode;
use rustc_hash::FxHashMap;
use scenegraph::Loader;
use scenegraph::scene::{Environment, LightId, Scene};

use budget::Budget;
use buffers::Buffers;
use document::Document;
use hierarchy::Walk;
use iv::Iv;
use made_by::MadeBy;
use material::Materials;
use texture::Textures;

pub use budget::ReadLimits;
pub(crate) use buffers::base64;
pub use error::ReadError;
pub(crate) use objects::{NodeObject, Objects, PrimitiveObject, carried_source, images_of};

/// A glTF file as a scene.
#[derive(Clone, Debug, Default)]
pub struct Model {
    /// The scene; it passes [`Scene::check`]. Places in the source are not known.
    pub scene: Scene,
    /// What was left out.
    pub warnings: Vec<String>,
    /// Written by [`write_glb`](crate::write_glb) or its kin, with extras and not turned: up is as it
    /// was in the Inventor model. All other glTF has +Y up.
    pub is_from_inventor: bool,
}

/// Reads a `.glb`, or the text of a `.gltf`. `name` is what the file is called; buffers in files of
/// their own are asked of `loader`, looked for first in the folder `beside`. Images in files are
/// named in the scene and not opened.
///
/// # Errors
///
/// Says what is wrong with the bytes, or what they need and is not to be had.
///
/// Nodes that are hidden (`KHR_node_visibility`) and coarser levels of detail (`MSFT_lod`) are passed
/// over; of material variants the file's own materials are taken.
pub fn read_gltf(
    bytes: &[u8],
    name: &str,
    beside: &Path,
    loader: &dyn Loader,
    limits: &ReadLimits,
) -> Result<Model, ReadError> {
    read(bytes, name, beside, loader, limits, false)
}

/// As [`read_gltf`], with hidden nodes and coarser levels, marked as such, for a writer.
pub(crate) fn read_with_alternatives(
    bytes: &[u8],
    name: &str,
    beside: &Path,
    loader: &dyn Loader,
    limits: &ReadLimits,
) -> Result<Model, ReadError> {
    read(bytes, name, beside, loader, limits, true)
}

fn read(
    bytes: &[u8],
    name: &str,
    beside: &Path,
    loader: &dyn Loader,
    limits: &ReadLimits,
    with_alternatives: bool,
) -> Result<Model, ReadError> {
    let document = Document::parse(bytes)?;
    let mut budget = Budget::new(*limits);
    budget.grow(bytes.len() as u64)?;
    let buffers = Buffers::new(&document, beside, loader, &mut budget)?;
    let made_by = MadeBy::of(&document.root.asset.extras);
    let textures = Textures::new(&document, beside);
    let materials = Materials::new(&document, made_by, textures);
    let mut walk = Walk::new(&document, &buffers, made_by, materials, budget);
    walk.with_alternatives = with_alternatives;

    let shown = Shown::of(&document)?;
    walk.environments = shown
        .iv
        .objects("environments")
        .map(|e| e.environment())
        .collect();
    if walk.environments.is_empty() {
        walk.environments.push(Environment::default());
    }
    let light_sets = shown.iv.list("lightSets");
    walk.light_sets = light_sets.len();
    walk.run(&shown.roots)?;

    // The file's order is that of the scene it was written from.
    walk.lights.sort_by_key(|(number, _)| *number);
    walk.cameras.sort_by_key(|(number, _)| *number);
    let numbers = walk.lights.iter().map(|(number, _)| *number);
    let numbers: Vec<Option<usize>> = numbers
        .map(|number| walk.numbers_in_sets.get(&number).copied().flatten())
        .collect();
    let light_sets = read_light_sets(light_sets, &numbers, &mut walk.budget)?;
    let mut warnings = left_out(&document);
    if walk.hidden_lights > 0 {
        warnings.push("lights of hidden nodes are left out".to_owned());
    }
    if walk.passed_over > 0 {
        warnings.push("hidden nodes and coarser levels of detail are passed over".to_owned());
    }
    warnings.append(&mut walk.materials.textures.warnings);
    let scene = Scene {
        nodes: walk.nodes,
        instances: walk.instances,
        meshes: walk.meshes.meshes,
        materials: walk.materials.materials,
        textures: walk.materials.textures.textures,
        lights: walk.lights.into_iter().map(|(_, light)| light).collect(),
        cameras: walk.cameras.into_iter().map(|(_, camera)| camera).collect(),
        light_sets,
        environments: walk.environments,
        texts: walk.texts,
        variants: Vec::new(),
        files: vec![name.into()],
    };
    debug_assert_eq!(scene.check(), Vec::new());
    Ok(Model {
        scene,
        warnings,
        is_from_inventor: made_by.ivory && !made_by.turned,
    })
}

/// What of the file is shown: its scene, or if it has none, all nodes.
struct Shown {
    roots: Vec<Index<JsonNode>>,
    iv: Iv,
}

impl Shown {
    fn of(document: &Document) -> Result<Self, ReadError> {
        let root = &document.root;
        let number = root.scene.map_or(0, |scene| scene.value());
        if let Some(scene) = root.scenes.get(number) {
            let iv = Iv::of(&scene.extras).unwrap_or_default();
            return Ok(Self {
                roots: scene.nodes.clone(),
                iv,
            });
        }
        if root.scene.is_some() {
            return Err(ReadError::broken("scene", number, "it does not exist"));
        }
        let mut is_child = vec![false; root.nodes.len()];
        for child in root
            .nodes
            .iter()
            .filter_map(|n| n.children.as_ref())
            .flatten()
        {
            if let Some(is_child) = is_child.get_mut(child.value()) {
                *is_child = true;
            }
        }
        let tops = (0..root.nodes.len()).filter(|&i| !is_child[i]);
        Ok(Self {
            roots: tops.map(|i| Index::new(i as u32)).collect(),
            iv: Iv::default(),
        })
    }
}

/// Which lights reach what: the sets of the file, or one of all lights. `numbers` are those by which
/// the sets call the scene's lights; a light that is placed twice counts for both, and one that has
/// no number came after the sets and reaches all.
fn read_light_sets(
    sets: &[serde_json::Value],
    numbers: &[Option<usize>],
    budget: &mut Budget,
) -> Result<Vec<Vec<LightId>>, ReadError> {
    let all = || (0..numbers.len() as u32).map(LightId).collect();
    if sets.is_empty() {
        return Ok(vec![all()]);
    }
    let mut by_number: FxHashMap<u64, Vec<LightId>> = FxHashMap::default();
    let mut added = Vec::new();
    for (light, number) in (0..).map(LightId).zip(numbers) {
        match number {
            Some(number) => by_number.entry(*number as u64).or_default().push(light),
            None => added.push(light),
        }
    }
    let mut read = Vec::with_capacity(sets.len());
    for set in sets {
        let mut lights = Vec::new();
        let members = set.as_array().map_or(&[][..], Vec::as_slice);
        let members = members.iter().filter_map(serde_json::Value::as_u64);
        for found in members
            .filter_map(|number| by_number.get(&number))
            .chain([&added])
        {
            budget.take(size_of::<LightId>() as u64 * found.len() as u64)?;
            lights.extend(found);
        }
        read.push(lights);
    }
    Ok(read)
}

/// What the file has and the scene has not.
fn left_out(document: &Document) -> Vec<String> {
    let root = &document.root;
    let has_targets = |mesh: &gltf::json::Mesh| mesh.primitives.iter().any(|p| p.targets.is_some());
    let rows = [
        ("animations are not played", !root.animations.is_empty()),
        ("skins are shown at rest", !root.skins.is_empty()),
        (
            "morph targets are not shown",
            root.meshes.iter().any(has_targets),
        ),
        (
            "of material variants the one that the file shows is taken",
            (root.extensions_used.iter()).any(|name| name == "KHR_materials_variants"),
        ),
    ];
    let present = rows.iter().filter(|(_, present)| *present);
    present.map(|(text, _)| (*text).to_owned()).collect()
}
