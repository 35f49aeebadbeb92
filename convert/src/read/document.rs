//! The text of a glTF file and its binary chunk, parsed and not yet trusted: every index is looked
//! up with a check where it is used.
//!
//! The `gltf` crate holds numbers in f32. Frames and projections are read a second time, in f64:
//! f32 has steps of 12 cm at national coordinates.

use std::collections::BTreeMap;

use gltf::json::Root;
use serde::Deserialize;
use serde_json::Value;

use super::error::ReadError;

const MAGIC: &[u8] = b"glTF";
const JSON: u32 = 0x4e4f_534a;
const BIN: u32 = 0x004e_4942;

/// Extensions that a file may require: those that are read, and those that only refine a look.
const SUPPORTED: &[&str] = &[
    "KHR_lights_punctual",
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_dispersion",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_iridescence",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_variants",
    "KHR_materials_volume",
    "KHR_mesh_quantization",
    "KHR_meshopt_compression",
    "KHR_node_visibility",
    "KHR_texture_transform",
    "EXT_mesh_gpu_instancing",
    "EXT_meshopt_compression",
    "EXT_texture_webp",
    "MSFT_lod",
];

/// A parsed file.
pub(crate) struct Document<'b> {
    pub(crate) root: Root,
    pub(crate) exact: Exact,
    /// The binary chunk of a `.glb`.
    pub(crate) bin: Option<&'b [u8]>,
}

/// What is wanted in f64.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Exact {
    pub(crate) nodes: Vec<ExactNode>,
    pub(crate) cameras: Vec<ExactCamera>,
    /// For their extensions.
    pub(crate) meshes: Vec<MeshExtensions>,
}

/// What the `gltf` crate does not know of a mesh.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct MeshExtensions {
    pub(crate) primitives: Vec<PrimitiveExtensions>,
}

/// What the `gltf` crate does not know of a primitive, whatever it holds.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct PrimitiveExtensions {
    extensions: Option<Variants>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
struct Variants {
    #[serde(rename = "KHR_materials_variants")]
    variants: Value,
}

impl PrimitiveExtensions {
    /// The material of each variant that has one of its own, by its number.
    pub(crate) fn material_by_variant(&self) -> BTreeMap<u64, usize> {
        let extensions = self.extensions.as_ref();
        let mappings = extensions.and_then(|e| e.variants["mappings"].as_array());
        let pairs = mappings.into_iter().flatten().flat_map(|mapping| {
            let material = mapping["material"].as_u64().and_then(|m| m.try_into().ok());
            let variants = mapping["variants"].as_array().into_iter().flatten();
            let numbers = variants.filter_map(Value::as_u64);
            numbers.filter_map(move |variant| Some((variant, material?)))
        });
        pairs.collect()
    }
}

/// A node's transform, as written.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct ExactNode {
    pub(crate) matrix: Option<[f64; 16]>,
    pub(crate) translation: Option<[f64; 3]>,
    pub(crate) rotation: Option<[f64; 4]>,
    pub(crate) scale: Option<[f64; 3]>,
    pub(crate) extensions: Option<NodeExtensions>,
}

/// Extensions of a node that the `gltf` crate does not know, whatever they hold.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct NodeExtensions {
    #[serde(rename = "KHR_node_visibility")]
    visibility: Value,
    #[serde(rename = "MSFT_lod")]
    lod: Value,
}

impl ExactNode {
    pub(crate) fn is_hidden(&self) -> bool {
        let extensions = self.extensions.as_ref();
        extensions.is_some_and(|e| e.visibility["visible"] == false)
    }

    /// The nodes that take its place from afar, from fine to coarse. Those that are no numbers are
    /// left out.
    pub(crate) fn coarser_levels(&self) -> impl Iterator<Item = usize> {
        let extensions = self.extensions.as_ref();
        let ids = extensions.and_then(|e| e.lod["ids"].as_array());
        let numbers = ids.into_iter().flatten().filter_map(Value::as_u64);
        numbers.filter_map(|id| id.try_into().ok())
    }
}

/// A camera's projection, as written.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct ExactCamera {
    pub(crate) perspective: Option<ExactPerspective>,
    pub(crate) orthographic: Option<ExactOrthographic>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct ExactPerspective {
    #[serde(rename = "aspectRatio")]
    pub(crate) aspect_ratio: Option<f64>,
    pub(crate) yfov: f64,
    pub(crate) znear: f64,
    pub(crate) zfar: Option<f64>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct ExactOrthographic {
    pub(crate) xmag: f64,
    pub(crate) ymag: f64,
    pub(crate) znear: f64,
    pub(crate) zfar: f64,
}

impl<'b> Document<'b> {
    pub(crate) fn parse(bytes: &'b [u8]) -> Result<Self, ReadError> {
        let (text, bin) = if bytes.starts_with(MAGIC) {
            split(bytes)?
        } else {
            (bytes, None)
        };
        let json_error = |e: serde_json::Error| ReadError::Json(e.to_string());
        let version: Version = serde_json::from_slice(text).map_err(json_error)?;
        let version = version.asset.version;
        if version != "2" && !version.starts_with("2.") {
            return Err(ReadError::Version(version));
        }
        let root: Root = serde_json::from_slice(text).map_err(json_error)?;
        let exact = serde_json::from_slice(text).map_err(json_error)?;
        let unknown = |name: &&String| !SUPPORTED.contains(&name.as_str());
        if let Some(name) = root.extensions_required.iter().find(unknown) {
            return Err(ReadError::Extension(name.clone()));
        }
        Ok(Self { root, exact, bin })
    }

    /// Forgets all that is not glTF's.
    pub(crate) fn strip_extras(&mut self) {
        let root = &mut self.root;
        root.asset.extras = None;
        root.scenes.iter_mut().for_each(|scene| scene.extras = None);
        root.nodes.iter_mut().for_each(|node| node.extras = None);
        root.materials.iter_mut().for_each(|m| m.extras = None);
        root.textures.iter_mut().for_each(|t| t.extras = None);
        root.cameras.iter_mut().for_each(|c| c.extras = None);
        let lights = root.extensions.as_mut();
        if let Some(lights) = lights.and_then(|e| e.khr_lights_punctual.as_mut()) {
            lights
                .lights
                .iter_mut()
                .for_each(|light| light.extras = None);
        }
    }
}

#[derive(Deserialize)]
struct Version {
    asset: VersionOfAsset,
}

#[derive(Deserialize)]
struct VersionOfAsset {
    version: String,
}

/// The text and the binary chunk of a `.glb`.
fn split(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), ReadError> {
    let [_, version, length] = words(bytes).ok_or(ReadError::Container("it has no header"))?;
    if version != 2 {
        return Err(ReadError::Version(version.to_string()));
    }
    let whole = bytes
        .get(..length as usize)
        .ok_or(ReadError::Container("it is cut off"))?;
    let rest = whole.get(12..).unwrap_or_default();
    let ((JSON, text), rest) = chunk(rest)? else {
        return Err(ReadError::Container("the text is not its first chunk"));
    };
    if rest.is_empty() {
        return Ok((text, None));
    }
    // Chunks of other kinds are to be passed over.
    let ((kind, bin), _) = chunk(rest)?;
    Ok((text, (kind == BIN).then_some(bin)))
}

type Chunk<'b> = (u32, &'b [u8]);

fn chunk(bytes: &[u8]) -> Result<(Chunk<'_>, &[u8]), ReadError> {
    let cut = ReadError::Container("a chunk is cut off");
    let Some([length, kind]) = words(bytes) else {
        return Err(cut);
    };
    match bytes[8..].split_at_checked(length as usize) {
        Some((content, rest)) => Ok(((kind, content), rest)),
        None => Err(cut),
    }
}

/// The first little-endian words.
fn words<const N: usize>(bytes: &[u8]) -> Option<[u32; N]> {
    let (chunks, _) = bytes.as_chunks::<4>();
    let words = chunks.first_chunk::<N>()?;
    Some(words.map(u32::from_le_bytes))
}
