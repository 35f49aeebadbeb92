//! The list of the sample models: one for tests, documentation and the viewer's menu.

use std::path::{Path, PathBuf};

/// One sample model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sample {
    /// Short unique name, as a menu shows it.
    pub name: &'static str,
    /// File below `samples/data`, with `/` between folders.
    pub path: &'static str,
    /// Folder it lies in; `building` for the large model beside the folders.
    pub topic: &'static str,
    /// What it shows, in one line.
    pub shows: &'static str,
    /// Codes of the diagnostics that reading it gives, each once, in order of appearance.
    pub codes: &'static [&'static str],
}

/// A row with no expected diagnostics.
const fn sample(
    name: &'static str,
    path: &'static str,
    topic: &'static str,
    shows: &'static str,
) -> Sample {
    Sample {
        name,
        path,
        topic,
        shows,
        codes: &[],
    }
}

/// A row with the codes of its diagnostics.
const fn remarked(
    name: &'static str,
    path: &'static str,
    topic: &'static str,
    shows: &'static str,
    codes: &'static [&'static str],
) -> Sample {
    Sample {
        codes,
        ..sample(name, path, topic, shows)
    }
}

/// Every sample, ordered by topic.
#[rustfmt::skip]
pub const ALL: &[Sample] = &[
    remarked("Garden pavilion", "pavilion.iv", "building", "a whole building in LV95 coordinates: shared parts, glass, textures, seven lights", &["hidden"]),
    sample("Primitives", "shapes/primitives.iv", "shapes", "cube, cylinder, cone and sphere at three complexities, and some of their parts"),
    sample("Bracket", "shapes/bracket.iv", "shapes", "concave faces and a hole on a bridge edge"),
    sample("Gear", "shapes/gear.iv", "shapes", "a closed solid with large concave faces and a bore"),
    sample("Crease angle", "shapes/crease_angle.iv", "shapes", "generated normals: sharp, partly smooth, smooth"),
    sample("Stair runner", "shapes/stair_runner.iv", "shapes", "triangle strips with a colour each"),
    sample("Awning", "shapes/awning.iv", "shapes", "a quad mesh with a colour for each quad"),
    sample("NURBS", "shapes/nurbs.iv", "shapes", "a saddle trimmed by a line and a curve, an exact sphere and a closed curve"),
    sample("Extrusions", "shapes/extrusions.wrl", "shapes", "cross-sections scaled, turned and closed to a ring (VRML 2.0)"),
    sample("Site plan", "shapes/site_plan.iv", "shapes", "unlit lines and points with widths, a pattern and several colours"),
    sample("Crate", "materials/crate_per_face.iv", "materials", "one material for each face"),
    sample("Hipped roof", "materials/roof_per_vertex.iv", "materials", "packed colours chosen by index at every corner"),
    sample("Pennant", "materials/pennant_rgba.iv", "materials", "points, normals and RGBA colours in one VertexProperty"),
    sample("Shininess", "materials/shininess_row.iv", "materials", "shininess from 0 to 1"),
    sample("Window panes", "materials/window_panes.iv", "materials", "transparency, one-sided, two-sided and culled"),
    sample("Three kinds of light", "lights/three_kinds.iv", "lights", "sun, lantern and spot with ambient light and attenuation"),
    sample("Lamp scope", "lights/lamp_scope.iv", "lights", "a light ends with its Separator; a light switched off"),
    remarked("Cameras", "lights/cameras.iv", "lights", "a perspective camera under a transform and an orthographic one", &["hidden"]),
    sample("Gate shadow", "lights/gate_shadow.iv", "lights", "thin closed solids before a low sun"),
    sample("Inline image", "textures/inline_image.iv", "textures", "pixels in the file, and a texture transform"),
    sample("Wrap modes", "textures/wrap_modes.iv", "textures", "a PNG repeated and clamped in S and T"),
    sample("Default coordinates", "textures/default_coordinates.iv", "textures", "texture coordinates that shapes make themselves; texturing ended"),
    sample("Missing image", "textures/missing_image.iv", "textures", "a texture file that is not there"),
    remarked("Flange bolts", "structure/flange_bolts.iv", "structure", "one bolt used 40 times", &["hidden"]),
    sample("Array copies", "structure/array_copies.iv", "structure", "Array and MultipleCopy"),
    remarked("Layers", "structure/layers.iv", "structure", "shown, hidden and alternative layers; levels of detail", &["hidden"]),
    sample("State scope", "structure/state_scope.iv", "structure", "what Separator, Group and TransformSeparator keep to themselves"),
    sample("Bolt part", "structure/bolt_part.iv", "structure", "a part that another file includes"),
    sample("Include", "structure/include_part.iv", "structure", "File nodes; names of the included file stay apart"),
    remarked("Extension nodes", "structure/extension_nodes.iv", "structure", "unknown classes with fields, isA and alternateRep", &["unknown-class"]),
    sample("Version 1.0", "structure/version_1_0.iv", "structure", "an Inventor V1.0 file with old shape hints"),
    sample("VRML 1.0", "structure/vrml_1_0.iv", "structure", "a VRML 1.0 world: anchor, emissive only, text"),
    remarked("Desk lamps", "structure/desk_lamp.wrl", "structure", "two lamps from one prototype on a table; a grid for ground (VRML 2.0)", &["route", "no-effect"]),
    remarked("Lettering", "text/lettering.iv", "text", "solid letters with a bevel, flat text by justification and width, a label in pixels", &["font-substituted"]),
    sample("Units", "transforms/units.iv", "transforms", "one length in metres, centimetres, millimetres and feet"),
    sample("Mirrored and sheared", "transforms/mirrored_sheared.iv", "transforms", "negative scale, scaleOrientation, a shearing matrix"),
    sample("LV95 coordinates", "numerics/lv95_full_coordinates.iv", "numerics", "millimetres given in coordinates of thousands of kilometres"),
    sample("LV95 offset", "numerics/lv95_offset.iv", "numerics", "small coordinates under large translations"),
    remarked("Degenerate faces", "numerics/degenerate_faces.iv", "numerics", "doubled corners, no area, a sliver, a face twice", &["small-face"]),
    remarked("Unknown field", "broken/unknown_field.iv", "broken", "a field the node does not have", &["unknown-field"]),
    remarked("Missing brace", "broken/missing_brace.iv", "broken", "the file ends before its braces are closed", &["missing-brace"]),
    remarked("Windows NaN", "broken/windows_nan.iv", "broken", "1.#QNAN, -1.#IND and 1.#INF as numbers", &["not-a-number"]),
    remarked("Comma errors", "broken/comma_errors.iv", "broken", "commas inside tuples, doubled and leading; a tuple cut short", &["extra-numbers", "stray-comma"]),
    remarked("Bad index", "broken/bad_index.iv", "broken", "coordinate and material indices out of range", &["bad-index", "small-face"]),
    remarked("Unknown node", "broken/unknown_node.iv", "broken", "an unknown class without its list of fields", &["unknown-class"]),
    remarked("Glued label", "broken/glued_label.iv", "broken", "an unquoted word that swallows its closing brace", &["glued-brace"]),
    remarked("Wrong words", "broken/wrong_words.iv", "broken", "nearly right enumeration, truth value, bit mask and name", &["word-guessed", "bool-case", "unknown-name"]),
];

/// The folder of the sample files.
#[must_use]
pub fn data_dir() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("data")
}

/// Where a sample's file lies on this machine.
#[must_use]
pub fn path_of(sample: &Sample) -> PathBuf {
    data_dir().join(sample.path)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;
    use std::fs;

    /// All model files below the data folder, as the manifest writes their paths.
    fn files_on_disk() -> BTreeSet<String> {
        let root = data_dir();
        let mut folders = vec![root.clone()];
        let mut found = BTreeSet::new();
        while let Some(folder) = folders.pop() {
            for entry in fs::read_dir(folder).unwrap() {
                let path = entry.unwrap().path();
                if path.is_dir() {
                    folders.push(path);
                } else if path.extension().is_some_and(|e| e == "iv" || e == "wrl") {
                    let below = path.strip_prefix(&root).unwrap();
                    found.insert(below.to_str().unwrap().replace('\\', "/"));
                }
            }
        }
        found
    }

    #[test]
    fn manifest_lists_exactly_the_files() {
        let listed: BTreeSet<String> = ALL.iter().map(|s| s.path.to_owned()).collect();
        assert_eq!(listed, files_on_disk());
        assert_eq!(listed.len(), ALL.len(), "a path twice");
    }

    #[test]
    fn names_are_unique_and_topics_are_folders() {
        let names: BTreeSet<&str> = ALL.iter().map(|s| s.name).collect();
        assert_eq!(names.len(), ALL.len());
        for sample in ALL {
            let folder = sample.path.split_once('/').map_or("building", |(f, _)| f);
            assert_eq!(sample.topic, folder, "{}", sample.path);
        }
    }

    #[test]
    fn every_file_begins_with_header_and_comment() {
        for sample in ALL {
            let text = fs::read_to_string(path_of(sample)).unwrap();
            let mut lines = text.lines();
            let header = lines.next().unwrap_or_default();
            let headers = ["#VRML V1.0 ascii", "#VRML V2.0 utf8"];
            let is_header = header.starts_with("#Inventor V") || headers.contains(&header);
            assert!(is_header, "{}: {header}", sample.path);
            assert!(
                lines.next().is_some_and(|line| line.starts_with("# ")),
                "{}: no comment",
                sample.path
            );
        }
    }

    #[test]
    fn readme_has_a_row_for_every_sample() {
        let readme = Path::new(env!("CARGO_MANIFEST_DIR")).join("README.md");
        let text = fs::read_to_string(readme).unwrap();
        let rows: Vec<&str> = text
            .lines()
            .filter(|line| line.starts_with("| ["))
            .collect();
        let expected: Vec<String> = ALL
            .iter()
            .map(|s| format!("| [{}](data/{}) | {} |", s.name, s.path, s.shows))
            .collect();
        assert_eq!(rows, expected);
    }
}
