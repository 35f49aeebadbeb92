//! Parts that Switches hide, levels of detail and variants: what is kept, that what is shown stays
//! the same, and that readers find it.

mod rows;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use convert::{
    Container, InventorOptions, Options, Quantize, ReadLimits, Recorder, Source, Up,
    gltf_to_inventor, read_gltf, write_file, write_glb, write_glb_with_source,
};
use iv_parser::Severity;
use scenegraph::scene::{Coarser, Scene, Shown, is_below};
use scenegraph::{FileLoader, ResolveOptions, Resolved, load, resolve};
use serde_json::{Value, json};
use tests::same_scene::differences;

use super::models::{Images, Model, corpus, samples};
use super::validator::{is_clean, validate};
use rows::{HOUSE, ROWS, Row};

const WITH: ResolveOptions = ResolveOptions {
    alternatives: true,
    ..DEFAULT
};
const DEFAULT: ResolveOptions = ResolveOptions {
    geometry: scenegraph::Geometry::Build,
    like_coin: false,
    chord: None,
    alternatives: false,
    limits: LIMITS,
};
const LIMITS: scenegraph::ResolveLimits = scenegraph::ResolveLimits {
    steps: 2_000_000,
    depth: 1000,
    items: 200_000,
    geometry_bytes: 1 << 30,
};

fn whole(text: &str) -> String {
    if text.starts_with('#') {
        text.to_owned()
    } else {
        format!("#Inventor V2.1 ascii\n{text}")
    }
}

fn resolved(text: &str, options: &ResolveOptions) -> Resolved {
    let loader = FileLoader::default();
    let graph = load(whole(text).as_bytes(), "row.iv", Path::new("."), &loader);
    assert!(graph.diagnostics.is_empty(), "{:?}", graph.diagnostics);
    let resolved = resolve(&graph, options);
    assert_eq!(resolved.scene.check(), []);
    resolved
}

/// What a scene shows as it stands, without the rest.
fn shown_part(scene: &Scene) -> Scene {
    let not_shown = scene.nodes_not_shown();
    let mut shown = scene.clone();
    let is_shown: Vec<bool> = (scene.instances.iter())
        .map(|i| !is_below(i.placement.node, &not_shown))
        .collect();
    let mut kept = is_shown.iter();
    shown
        .instances
        .retain(|_| kept.next().copied().unwrap_or(false));
    shown
}

fn marks(scene: &Scene, index: usize) -> String {
    let mut marks = Vec::new();
    let mut at = scene.instances[index].placement.node;
    while let Some(node) = at {
        let node = &scene.nodes[node.index()];
        marks.push(match node.shown {
            Shown::Always => String::new(),
            Shown::Hidden => "h".to_owned(),
            Shown::Level(Coarser::Beyond(distance)) => format!(">{distance}"),
            Shown::Level(Coarser::Below(area)) => format!("<{area}"),
            Shown::Level(Coarser::Never) => "l".to_owned(),
        });
        at = node.parent;
    }
    marks.into_iter().rev().collect()
}

fn name(scene: &Scene, index: usize) -> String {
    let name = scene.instances[index].placement.name.as_deref();
    name.unwrap_or_default().to_owned()
}

fn row_of(resolved: &Resolved) -> (Vec<String>, Vec<String>, Vec<&'static str>) {
    let scene = &resolved.scene;
    let instance = |i: usize| {
        let x = scene.instances[i].placement.world_from_local.translation.x;
        let line = format!("{} {x} {}", name(scene, i), marks(scene, i));
        line.trim_end().to_owned()
    };
    let variants = scene.variants.iter().map(|variant| {
        let instances = variant.materials.iter();
        let names = instances.map(|(i, _)| format!(" {}", name(scene, *i as usize)));
        format!("{}:{}", variant.name, names.collect::<String>())
    });
    let mut codes: Vec<&'static str> = resolved.diagnostics.iter().map(|d| d.code).collect();
    codes.sort_unstable();
    (
        (0..scene.instances.len()).map(instance).collect(),
        variants.collect(),
        codes,
    )
}

#[test]
fn rows_are_kept_as_they_say() {
    for row in ROWS {
        let Row {
            name,
            text,
            instances,
            variants,
            remarks,
        } = row;
        let (got_instances, got_variants, got_remarks) = row_of(&resolved(text, &WITH));
        assert_eq!(got_instances, *instances, "{name}");
        assert_eq!(got_variants, *variants, "{name}");
        assert_eq!(got_remarks, *remarks, "{name}");
    }
}

#[test]
fn what_is_shown_is_the_same_as_without() {
    for text in ROWS.iter().map(|row| row.text).chain([HOUSE]) {
        let plain = resolved(text, &DEFAULT).scene;
        let with = resolved(text, &WITH).scene;
        assert!(plain.shows_all() && plain.variants.is_empty(), "{text}");
        let faults = differences(&plain, &shown_part(&with));
        assert!(faults.is_empty(), "{text}: {faults:?}");
    }
}

/// The samples, and what of the corpus has groups that choose.
fn models() -> Vec<Model> {
    let chooses = |model: &Model| {
        let bytes = fs::read(&model.path).expect("a model");
        let holds = |word: &&[u8]| bytes.windows(word.len()).any(|at| at == *word);
        [b"Switch".as_slice(), b"LOD", b"LevelOfDetail"]
            .iter()
            .any(holds)
    };
    let mut models = samples();
    models.extend(corpus().into_iter().filter(chooses));
    models
}

fn all_options() -> Options {
    Options {
        quantize: Some(Quantize::within(1e-5)),
        compress: true,
        instancing: true,
        up: Up::Z,
        metres_per_unit: 0.01,
        ..Options::default()
    }
}

#[test]
fn outputs_are_valid_and_show_the_same() {
    let folder = tempfile::tempdir().expect("a folder for outputs");
    let mut files = Vec::new();
    let mut write = |name: &str, scene: &Scene, images: &Images| {
        for options in [
            Options::default(),
            all_options(),
            Options {
                extras: false,
                container: Container::GltfEmbedded,
                ..Options::default()
            },
        ] {
            let path = folder.path().join(files.len().to_string());
            let written = write_file(scene, &options, images, &path);
            assert!(written.is_ok(), "{name}: {written:?}");
            files.push((name.to_owned(), path));
        }
        files[files.len() - 3].1.clone()
    };
    for text in ROWS.iter().map(|row| row.text).chain([HOUSE]) {
        let scene = resolved(text, &WITH).scene;
        let path = write(text, &scene, &Images(FileLoader::default()));
        let plain = resolved(text, &DEFAULT).scene;
        let faults = differences(&plain, &read_back(&path));
        // Positions of a Text2 are those of a view, which reading does not know.
        assert!(faults.is_empty(), "{text}: {faults:?}");
    }
    for model in models() {
        let bytes = fs::read(&model.path).expect("a model");
        let beside = model.path.parent().unwrap_or(&model.source);
        let graph = load(&bytes, &model.name, beside, &model.loader());
        let with = resolve(&graph, &WITH).scene;
        let plain = resolve(&graph, &DEFAULT).scene;
        let faults = differences(&plain, &shown_part(&with));
        assert!(faults.is_empty(), "{}: {faults:?}", model.name);
        write(&model.name, &with, &model.images());
    }
    let paths: Vec<PathBuf> = files.iter().map(|(_, path)| path.clone()).collect();
    for ((name, _), line) in files.iter().zip(validate(&paths, folder.path())) {
        assert!(is_clean(&line), "{name}: {line}");
    }
}

fn read_back(path: &Path) -> Scene {
    let bytes = fs::read(path).expect("an output");
    let limits = ReadLimits::default();
    let nothing = FileLoader::default();
    let read = read_gltf(&bytes, "m.glb", Path::new(""), &nothing, &limits);
    let scene = read.expect("readable").scene;
    assert!(scene.shows_all());
    scene
}

#[test]
fn readers_find_what_is_kept() {
    let folder = tempfile::tempdir().expect("a folder for outputs");
    let scene = resolved(HOUSE, &WITH).scene;
    let options = [Options::default(), all_options()];
    let paths: Vec<PathBuf> = (0..options.len())
        .map(|i| folder.path().join(format!("{i}.glb")))
        .collect();
    for (options, path) in options.iter().zip(&paths) {
        let images = Images(FileLoader::default());
        write_file(&scene, options, &images, path).expect("written");
    }
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tools/alternatives.mjs");
    let run = Command::new("node").arg(script).args(&paths).output();
    let run = run.expect("node is needed");
    let words = String::from_utf8_lossy(&run.stderr).into_owned();
    assert!(run.status.success(), "{words}");
    let (red, green, blue) = ([1, 0, 0], [0, 1, 0], [0, 0, 1]);
    let painted = json!({ "Red": red, "Blue": blue, "Paint 2": green });
    for line in String::from_utf8_lossy(&run.stdout).lines() {
        let got: Value = serde_json::from_str(line).expect("JSON");
        assert_eq!(got["hidden"], json!(["Half", "Open"]));
        assert_eq!(got["variants"], json!(["Red", "Blue", "Paint 2"]));
        let colors = &got["colors"];
        for name in ["Body", "Stem", "Crown", "Coarse", "Inner", "Last"] {
            assert_eq!(colors[name], painted, "{name}: {line}");
        }
        assert_eq!(colors["White"], Value::Null);
        assert_eq!(colors["Open"], Value::Null);
    }
    assert_eq!(String::from_utf8_lossy(&run.stdout).lines().count(), 2);
}

/// Who shows a hidden part must be able to hide it again: the part alone is hidden, the Switch is
/// not, and copies of one part are no batch if they are hidden one by one.
#[test]
fn hidden_parts_have_nodes_of_their_own() {
    let texts = [
        "Switch { DEF Part Cube { } }".to_owned(),
        format!("DEF Part Cube {{ }} Switch {{ {} }}", "USE Part ".repeat(6)),
    ];
    for (text, parts) in texts.iter().zip([1, 7]) {
        let scene = resolved(text, &WITH).scene;
        for options in [Options::default(), all_options()] {
            let mut glb = Vec::new();
            let images = Images(FileLoader::default());
            write_glb(&scene, &options, &images, &mut glb).expect("written");
            let json: Value = serde_json::from_str(&text_of(&glb)).expect("JSON");
            let nodes = json["nodes"].as_array().expect("nodes");
            let hides = |node: &&Value| node["extensions"]["KHR_node_visibility"].is_object();
            let switch = nodes.iter().find(|n| n["extras"]["iv"]["type"] == "Switch");
            assert!(switch.is_some_and(|node| !hides(&node)), "{text}");
            let named = nodes.iter().filter(|n| n["name"] == "Part");
            let (hidden, shown): (Vec<&Value>, Vec<&Value>) = named.partition(hides);
            assert_eq!(
                (hidden.len(), shown.len()),
                (parts.min(6), parts / 7),
                "{text}"
            );
        }
    }
}

/// Levels stand in no scene, below nothing, and their limits are in the unit of the output.
#[test]
fn levels_are_listed_at_the_finest() {
    let scene = resolved(HOUSE, &WITH).scene;
    for (options, ranges) in [
        (Options::default(), [10.0, 50.0]),
        (all_options(), [0.1, 0.5]),
    ] {
        let mut glb = Vec::new();
        let images = Images(FileLoader::default());
        write_glb(&scene, &options, &images, &mut glb).expect("written");
        let json: Value = serde_json::from_str(&text_of(&glb)).expect("JSON");
        let nodes = json["nodes"].as_array().expect("nodes");
        let numbers = |value: &Value| -> Vec<usize> {
            let list = value.as_array().cloned().unwrap_or_default();
            list.iter()
                .filter_map(Value::as_u64)
                .map(|n| n as usize)
                .collect()
        };
        let mut placed = numbers(&json["scenes"][0]["nodes"]);
        placed.extend(nodes.iter().flat_map(|node| numbers(&node["children"])));
        let named = |name: &str| nodes.iter().find(|n| n["name"] == name).expect("a node");
        let fine = named("Fine");
        let levels = numbers(&fine["extensions"]["MSFT_lod"]["ids"]);
        assert_eq!(levels.len(), 2);
        assert_eq!(nodes[levels[0]]["name"], "Coarse");
        assert_eq!(nodes[levels[1]], json!({}));
        assert!(levels.iter().all(|level| !placed.contains(level)));
        let got = fine["extras"]["iv"]["range"].as_array().expect("ranges");
        for (got, want) in got.iter().zip(ranges) {
            assert!((got.as_f64().unwrap_or(0.0) - want).abs() < 1e-9, "{fine}");
        }
        // Two spheres of radius 1, their middles 2 apart: a box of 4, 2 and 2.
        let view = (std::f64::consts::PI / 8.0).tan();
        let share = |d: f64| std::f64::consts::PI * 6.0 / (2.0 * d * view).powi(2);
        let coverage = fine["extras"]["MSFT_screencoverage"]
            .as_array()
            .expect("shares");
        for (got, want) in coverage.iter().zip([share(10.0), share(50.0), 0.0]) {
            let off = (got.as_f64().unwrap_or(9.0) - want).abs();
            // A sphere's corners are inside it, and a grid moves them.
            assert!(off <= 0.01 * want, "{got}, {want}");
        }
        assert_eq!(coverage.len(), 3);
    }
}

/// The text of a glTF file made anew, resolved.
fn through_text(glb: &[u8]) -> Resolved {
    let nothing = FileLoader::default();
    let options = InventorOptions::default();
    let files = gltf_to_inventor(glb, "m.glb", Path::new(""), &nothing, &|_| None, &options);
    let text = String::from_utf8(files.expect("a text").text).expect("UTF-8");
    resolved(&text, &WITH)
}

/// Variants alone are lost: a note says so.
#[test]
fn hidden_parts_and_levels_come_back_as_text() {
    for text in ROWS.iter().map(|row| row.text).chain([HOUSE]) {
        let scene = resolved(text, &WITH).scene;
        let images = Images(FileLoader::default());
        let mut glb = Vec::new();
        write_glb(&scene, &Options::default(), &images, &mut glb).expect("written");
        let back = through_text(&glb);
        let counted = |scene: &Scene| {
            let mut all: Vec<String> = (0..scene.instances.len())
                .map(|i| marks(scene, i))
                .collect();
            all.sort_unstable();
            all
        };
        assert_eq!(counted(&back.scene), counted(&scene), "{text}");
        let faults = differences(&shown_part(&scene), &shown_part(&back.scene));
        assert!(faults.is_empty(), "{text}: {faults:?}");
    }
}

#[test]
fn the_source_comes_back_and_edits_of_what_is_kept_are_seen() {
    let text = whole(HOUSE);
    let nothing = FileLoader::default();
    let recorder = Recorder::new(&nothing, Path::new("."));
    let scene = resolved(HOUSE, &WITH).scene;
    let source = Source {
        text: text.as_bytes(),
        recorder: &recorder,
        resolve: &WITH,
    };
    let mut glb = Vec::new();
    write_glb_with_source(&scene, &Options::default(), &source, &mut glb).expect("written");
    let back = |glb: &[u8]| {
        let options = InventorOptions::default();
        gltf_to_inventor(glb, "m.glb", Path::new(""), &nothing, &|_| None, &options)
            .expect("a text")
    };
    assert!(back(&glb).text == text.as_bytes());
    // What an editor writes anew is still the same.
    let respaced = edited(&glb, "\"asset\":", "\"asset\" :");
    assert!(back(&respaced).text == text.as_bytes());
    // Of blue, which only a variant shows.
    let blue = "\"baseColorFactor\":[0,0,1,1]";
    for (old, new) in [
        ("\"visible\":false", "\"visible\":true"),
        (blue, "\"baseColorFactor\":[0,1,1,1]"),
    ] {
        let files = back(&edited(&glb, old, new));
        assert!(files.text != text.as_bytes(), "{new}");
        let notes: Vec<&str> = files.notes.iter().map(|note| note.code).collect();
        assert!(notes.contains(&"edited"), "{new}: {notes:?}");
    }
}

/// The JSON of a `.glb`.
fn text_of(glb: &[u8]) -> String {
    let length = u32::from_le_bytes([glb[12], glb[13], glb[14], glb[15]]) as usize;
    String::from_utf8(glb[20..20 + length].to_vec()).expect("UTF-8")
}

/// A `.glb` with a piece of its text replaced.
fn edited(glb: &[u8], old: &str, new: &str) -> Vec<u8> {
    let json = text_of(glb);
    let json_end = 20 + json.len();
    assert!(json.contains(old), "{old}");
    let mut json = json.replace(old, new).trim_end().to_owned();
    json += &" ".repeat(json.len().next_multiple_of(4) - json.len());
    let total = (20 + json.len() + glb.len() - json_end) as u32;
    [
        &glb[..8],
        &total.to_le_bytes(),
        &(json.len() as u32).to_le_bytes(),
        &glb[16..20],
        json.as_bytes(),
        &glb[json_end..],
    ]
    .concat()
}

#[test]
fn more_looks_than_the_limit_are_reported() {
    let looks: String = (0..40)
        .map(|i| format!("Material {{ shininess {} }} ", f64::from(i) / 40.0))
        .collect();
    let few = "Switch { whichChild 0 Material { } DEF B Material { diffuseColor 1 0 0 } } ";
    let text = format!("{few} Switch {{ whichChild 0 {looks} }} DEF A Cube {{ }}");
    let resolved = resolved(&text, &WITH);
    let (_, variants, remarks) = row_of(&resolved);
    // The second Switch gives back the first one's look.
    assert_eq!(variants, [] as [String; 0]);
    assert_eq!(remarks, ["too-many-variants"]);
    let warns = |d: &iv_parser::Diagnostic| d.severity == Severity::Warning;
    assert!(resolved.diagnostics.iter().all(warns));
}
