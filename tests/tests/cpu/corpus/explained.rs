//! Why single files of the corpus differ from what Coin makes of them.

use super::Outcome;

const FILE_NORMALS: &str = "triangles are turned to agree with the normals of the file";
const UNIT_NORMALS: &str =
    "normals of the file are made unit vectors; Coin takes their lengths too";
const STRIP_NORMALS: &str =
    "the default creaseAngle 0 gives facets; Coin has one normal a strip vertex";
const QUAD_NORMALS: &str = "normals of non-planar quads are Newell's; Coin takes those of corners";
const UNLIT: &str = "unlit triangles carry no normals";

const PAST_THE_END: &str =
    "vertices beyond the list of colours have the last one; Coin reads on in memory";
const TEXTURE_TRANSFORM: &str = "the texture transform is applied; Coin hands it out apart";

/// Path, quantities, reason.
const EXPLAINED: &[(&str, &[&str], &str)] = &[
    ("aumuell/data/models/bird.iv", &["volume"], FILE_NORMALS),
    ("aumuell/data/models/bird.iv", &["normals"], UNIT_NORMALS),
    ("ivexamples/data/bird.iv", &["volume"], FILE_NORMALS),
    ("ivexamples/data/bird.iv", &["normals"], UNIT_NORMALS),
    (
        "aumuell/data/models/simple/indexedTriangleMesh.iv",
        &["colours"],
        PAST_THE_END,
    ),
    (
        "aumuell/data/models/simple/indexedTriangleMesh.iv",
        &["normals"],
        STRIP_NORMALS,
    ),
    (
        "aumuell/data/models/simple/triangleStripSet.iv",
        &["normals"],
        STRIP_NORMALS,
    ),
    (
        "aumuell/data/models/simple/quadMesh.iv",
        &["normals"],
        QUAD_NORMALS,
    ),
    ("aumuell/data/models/simple/three.iv", &["normals"], UNLIT),
    (
        "graspit/models/obstacles/simpleFloor.iv",
        &["texture s", "texture t"],
        TEXTURE_TRANSFORM,
    ),
];

const DRAGGERS: &str = "draggers are handles of an editor, not parts of the model";

/// Why `what` of a file differs, if that is known.
pub fn reason(outcome: &Outcome, what: &str) -> Option<&'static str> {
    let listed = EXPLAINED
        .iter()
        .find(|(path, list, _)| *path == outcome.entry.path && list.contains(&what))
        .map(|(_, _, reason)| *reason);
    listed.or_else(|| outcome.leaves_out("Dragger").then_some(DRAGGERS))
}

/// All single exceptions: path and quantity.
pub fn listed() -> impl Iterator<Item = (&'static str, &'static str)> {
    let row = |(path, list, _): &'static (&'static str, &'static [&'static str], &str)| {
        list.iter().map(|what| (*path, *what))
    };
    EXPLAINED.iter().flat_map(row)
}
