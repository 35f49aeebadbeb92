//! A carried source with its images, and its conversion made again.

use std::borrow::Cow;
use std::path::Path;
use std::sync::Arc;

use rustc_hash::FxHashMap;
use scenegraph::scene::Scene;

use super::archive::{Archive, Content, Unpacked, crc};
use super::{made, without_source};
use crate::Plan;
use crate::plan::Origins;
use crate::prepare::Prepared;
use crate::read::{Objects, ReadLimits};

/// A source that a file carries, with the images of the file.
pub(crate) struct Carried {
    pub(crate) archive: Archive,
    pub(crate) files: Unpacked,
    /// Paths of images that are no longer those of the source.
    pub(crate) images_edited: Vec<String>,
}

impl Carried {
    /// Puts images where the source has them.
    pub(crate) fn new(archive: Archive, images: &[Option<Arc<[u8]>>]) -> Self {
        let mut by_sum: FxHashMap<u32, usize> = FxHashMap::default();
        for (i, image) in images.iter().enumerate() {
            if let Some(bytes) = image {
                by_sum.entry(crc(bytes)).or_insert(i);
            }
        }
        let mut files = Vec::new();
        let mut images_edited = Vec::new();
        for (path, content) in &archive.files {
            match content {
                Content::Here(bytes) => files.push((path.clone(), Arc::clone(bytes))),
                Content::Image { index, crc } => {
                    let same = by_sum.get(crc).copied();
                    if same.is_none() {
                        images_edited.push(path.clone());
                    }
                    let image = images.get(same.unwrap_or(*index)).cloned().flatten();
                    files.extend(image.map(|bytes| (path.clone(), bytes)));
                }
            }
        }
        Self {
            archive,
            files: Unpacked::new(files),
            images_edited,
        }
    }
}

/// A source converted again.
pub(crate) struct Again {
    /// As it was written: with the group that turns or scales it, if any.
    pub(crate) scene: Scene,
    pub(crate) origins: Origins,
    pub(crate) objects: Objects,
    pub(crate) glb: (u32, u64),
}

/// Converts a source; says why that cannot be.
pub(crate) fn again(
    carried: &Carried,
    files: &Unpacked,
    text: &[u8],
    limits: &ReadLimits,
) -> Result<Again, String> {
    let (options, resolve) = made::from_value(&carried.archive.made);
    let graph = scenegraph::load(text, "source.iv", Path::new(""), files);
    let scene = scenegraph::resolve(&graph, &resolve).scene;
    let options = without_source(&options);
    let prepared = Prepared::new(&scene, &options).map_err(|e| e.to_string())?;
    let plan = Plan::new(&prepared, &options, files).map_err(|e| e.to_string())?;
    let mut glb = Vec::new();
    plan.write_glb(&mut glb).map_err(|e| e.to_string())?;
    let objects = Objects::read(&glb, Path::new(""), files, limits).map_err(|e| e.to_string())?;
    let origins = plan.origins();
    drop(plan);
    let arranged = match prepared.scene {
        Cow::Owned(scene) => Some(scene),
        Cow::Borrowed(_) => None,
    };
    Ok(Again {
        scene: arranged.unwrap_or(scene),
        origins,
        objects,
        glb: (crc(&glb), glb.len() as u64),
    })
}
