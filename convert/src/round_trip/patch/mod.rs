//! Edits of glTF objects as changes of the source's text, each at the node that the object was made
//! of. Whether a change has the wanted effect is not decided here: the result is converted again
//! and compared.

mod frames;
mod materials;
mod places;
mod shapes;
mod text;
mod views;

use std::collections::{BTreeMap, BTreeSet};

use glam::DAffine3;
use iv_parser::{NodeId as TreeId, TextEdits, Tree};
use scenegraph::scene::Scene;

use super::again::Again;
use super::edits::Edits;
use crate::read::Objects;
use places::{Occurrences, nodes_by_place, world_frames};

/// Why an edit has no place in the text.
type No = String;

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
        occurrences: Occurrences::of(&was.scene),
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

/// Edits on their way into the text.
struct Patcher<'p, 't, 'a> {
    tree: &'t Tree<'a>,
    edits: TextEdits<'t, 'a>,
    scene: &'p Scene,
    was: &'p Again,
    is: &'p Objects,
    nodes: BTreeMap<(u32, u32), TreeId>,
    /// Of each node's parent, in the world.
    frames_of: Vec<DAffine3>,
    occurrences: Occurrences,
    /// What stands around nodes; once, however often they are used.
    wrapped: BTreeSet<(usize, String)>,
}
