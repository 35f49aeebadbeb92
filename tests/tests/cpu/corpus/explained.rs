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

const EMPTY_FACE: &str =
    "a face without corners is left out alone; Coin leaves out all that follows it";
const SIX_DIGITS: &str =
    "a packed colour and its spelling with six digits are two colours; for Coin they are one";

const EIGHT_BITS: &str = "colours keep the digits of the text; Coin's VRMLColor has 8 bits";

/// Path, quantities, reason.
const EXPLAINED: &[(&str, &[&str], &str)] = &[
    ("aumuell/data/models/bird.iv", &["volume"], FILE_NORMALS),
    ("aumuell/data/models/bird.iv", &["normals"], UNIT_NORMALS),
    ("ivexamples/data/bird.iv", &["volume"], FILE_NORMALS),
    ("ivexamples/data/bird.iv", &["normals"], UNIT_NORMALS),
    (
        "aumuell/apps/examples/data/bird.iv",
        &["volume"],
        FILE_NORMALS,
    ),
    (
        "aumuell/apps/examples/data/bird.iv",
        &["normals"],
        UNIT_NORMALS,
    ),
    ("pivy/examples/Mentor/bird.iv", &["volume"], FILE_NORMALS),
    ("pivy/examples/Mentor/bird.iv", &["normals"], UNIT_NORMALS),
    (
        "aumuell/data/models/CyberHeads/josie.iv",
        &["normals"],
        QUAD_NORMALS,
    ),
    (
        "aumuell/data/models/CyberHeads/paul.iv",
        &["normals"],
        QUAD_NORMALS,
    ),
    (
        "aumuell/data/models/CyberHeads/rikk.iv",
        &["normals"],
        QUAD_NORMALS,
    ),
    (
        "aumuell/data/models/buildings/Barcelona.iv",
        &["colours", "area", "volume", "bounds"],
        EMPTY_FACE,
    ),
    (
        "aumuell/data/models/buildings/Barcelona.iv",
        &["normals"],
        UNLIT,
    ),
    (
        "aumuell/data/models/machines/compressor.iv",
        &["volume", "normals"],
        FILE_NORMALS,
    ),
    (
        "aumuell/data/models/robots/robotcop.iv",
        &["colours"],
        SIX_DIGITS,
    ),
    (
        "aumuell/data/models/vehicles/767.iv",
        &["volume", "normals"],
        FILE_NORMALS,
    ),
    (
        "aumuell/data/models/vehicles/spacestation.iv",
        &["volume", "normals"],
        FILE_NORMALS,
    ),
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
    (
        "graspit/models/robots/BarrettBH8_280_Tactile/iv/original_iv/link1.iv",
        &["colours"],
        PAST_THE_END,
    ),
    (
        "graspit/models/robots/BarrettBH8_280_Tactile/iv/original_iv/link2.iv",
        &["colours"],
        PAST_THE_END,
    ),
    (
        "graspit/models/robots/BarrettBH8_280_Tactile/iv/original_iv/link3.iv",
        &["colours"],
        PAST_THE_END,
    ),
    (
        "graspit/models/robots/BarrettBH8_280_Tactile/iv/original_iv/palm.iv",
        &["colours"],
        PAST_THE_END,
    ),
    (
        "graspit/models/robots/cobra_gripper/iv/fixed_jaw.wrl",
        &["colours"],
        PAST_THE_END,
    ),
    (
        "graspit/models/robots/cobra_gripper/iv/rotating_jaw.wrl",
        &["colours"],
        PAST_THE_END,
    ),
    (
        "graspit/models/robots/M7body/iv/base.wrl",
        &["colours"],
        EIGHT_BITS,
    ),
    (
        "graspit/models/robots/M7body/iv/p1.wrl",
        &["colours"],
        EIGHT_BITS,
    ),
    (
        "graspit/models/robots/M7body/iv/p5.wrl",
        &["colours"],
        EIGHT_BITS,
    ),
    (
        "graspit/models/robots/MekaHand/iv/seg1.wrl",
        &["colours"],
        EIGHT_BITS,
    ),
    (
        "graspit/models/robots/MekaHand/iv/seg2.wrl",
        &["colours"],
        EIGHT_BITS,
    ),
    (
        "graspit/models/robots/MekaHand/iv/tip.wrl",
        &["colours"],
        EIGHT_BITS,
    ),
];

const VIEWPOINTS: &str = "a VRML Viewpoint is a camera here, and none for Coin";

const DRAGGERS: &str = "draggers are handles of an editor, not parts of the model";

/// Why `what` of a file differs, if that is known.
pub fn reason(outcome: &Outcome, what: &str) -> Option<&'static str> {
    let listed = EXPLAINED
        .iter()
        .find(|(path, list, _)| *path == outcome.entry.path && list.contains(&what))
        .map(|(_, _, reason)| *reason);
    let is_vrml2 = outcome.entry.header.starts_with("#VRML V2.0");
    let viewpoint = (is_vrml2 && what == "cameras").then_some(VIEWPOINTS);
    let dragger = || outcome.has_draggers().then_some(DRAGGERS);
    listed.or(viewpoint).or_else(dragger)
}

/// All single exceptions: path and quantity.
pub fn listed() -> impl Iterator<Item = (&'static str, &'static str)> {
    let row = |(path, list, _): &'static (&'static str, &'static [&'static str], &str)| {
        list.iter().map(|what| (*path, *what))
    };
    EXPLAINED.iter().flat_map(row)
}
