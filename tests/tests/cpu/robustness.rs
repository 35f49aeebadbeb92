//! Any input ends: without a panic, in bounded time and memory, with the guarantees kept.

use std::fs;
use std::io::{Cursor, Write};
use std::panic::catch_unwind;
use std::path::Path;
use std::sync::mpsc;
use std::time::{Duration, Instant};

use flate2::write::GzEncoder;
use samples::{ALL, path_of};
use scenegraph::{FileLoader, RegistryLayout, ResolveLimits, ResolveOptions, load, resolve};
use tests::mutate::{Rng, mutate};
use tests::{fuzz_body, fuzz_targets, hostile};
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

/// Longest time for one input of [`mutated_inputs`]; measured ones take milliseconds.
const SLOW: Duration = Duration::from_secs(2);

/// Seconds for [`mutated_inputs`]; `FUZZ_SECONDS` and `FUZZ_SEED` look further.
const BUDGET: u64 = 3;

/// Inputs at the least, however slow the machine.
const FEWEST: usize = 200;

/// The default limits, with a tenth of the work: it is done in the test profile here, several times.
const LIMITS: ResolveLimits = ResolveLimits {
    steps: 2_000_000,
    depth: 1000,
    items: 200_000,
    geometry_bytes: 1 << 30,
};

/// Remarks on one file: the parser keeps 200, the rest is counted.
const MOST_REMARKS: usize = 500;

/// Bytes of one remark.
const LONGEST_REMARK: usize = 2_000;

fn sample_texts() -> Vec<Vec<u8>> {
    let read = |s| fs::read(path_of(s)).expect("a sample");
    let texts = ALL.iter().map(read).filter(|text| text.len() < 10_000);
    texts.collect()
}

/// The binary forms of texts that have one.
fn binary_forms(texts: &[Vec<u8>]) -> Vec<Vec<u8>> {
    let stored = |text: &Vec<u8>| {
        let parsed = iv_parser::parse(text);
        let mut out = Vec::new();
        let written = iv_parser::print_binary(&parsed.tree, &RegistryLayout, &mut out);
        written.ok().map(|_| out)
    };
    texts.iter().filter_map(stored).collect()
}

/// Models in all forms: text of Inventor and VRML, binary, packed.
pub fn any_forms() -> Vec<Vec<u8>> {
    let mut forms = sample_texts();
    let rule = |r: &super::rules::check::Rule| format!("#Inventor V2.1 ascii\n{}", r.text);
    forms.extend(
        super::rules::table::RULES
            .iter()
            .map(|r| rule(r).into_bytes()),
    );
    forms.push(VRML_2.as_bytes().to_vec());
    forms.extend(binary_forms(&forms));
    forms.extend(packed_forms(&forms));
    forms
}

/// Much of VRML 2.0 in one file.
const VRML_2: &str = "#VRML V2.0 utf8
PROTO Part [ field SFColor paint 1 0 0 exposedField SFVec3f at 0 0 0 ] {
  Transform { translation IS at children Shape {
    appearance Appearance { material Material { diffuseColor IS paint } texture PixelTexture { image 1 1 3 0xff8800 } }
    geometry Box { size 1 2 3 } } }
}
DEF Sun DirectionalLight { direction 0 -1 -1 ambientIntensity 0.3 }
PointLight { location 1 2 3 radius 20 attenuation 1 0.1 0 }
Viewpoint { position 0 0 20 fieldOfView 0.8 description \"front\" }
Part { paint 0 1 0 at 3 0 0 } Part { at -3 0 0 }
Switch { whichChoice 0 choice [ Shape { geometry Sphere { radius 2 } } ] }
LOD { range [ 10 ] level [ Shape { geometry Cone { } } Shape { geometry Cylinder { } } ] }
Shape { geometry Extrusion { crossSection [ 1 1, 1 -1, -1 -1, -1 1, 1 1 ] spine [ 0 0 0, 0 1 0, 1 2 0 ] scale [ 1 1, 0.5 0.5 ] } }
Shape { geometry ElevationGrid { xDimension 3 zDimension 3 height [ 0 1 0 1 2 1 0 1 0 ] xSpacing 2 } }
Shape { geometry IndexedFaceSet { coord DEF C Coordinate { point [ 0 0 0, 1 0 0, 1 1 0, 0 1 0 ] } coordIndex [ 0 1 2 3 -1 ]
  color Color { color [ 1 0 0, 0 1 0, 0 0 1, 1 1 1 ] } creaseAngle 0.5 solid FALSE } }
Shape { geometry IndexedLineSet { coord USE C coordIndex [ 0 1 2 -1 ] } }
Shape { geometry Text { string [ \"ab\", \"c\" ] fontStyle FontStyle { size 2 justify \"MIDDLE\" } } }
DEF T TimeSensor { } DEF P PositionInterpolator { key [ 0 1 ] keyValue [ 0 0 0, 1 1 1 ] }
ROUTE T.fraction_changed TO P.set_fraction
";

#[test]
fn samples_and_rules() {
    let samples = ALL.iter().map(|s| fs::read(path_of(s)).expect("a sample"));
    let rule = |r: &super::rules::check::Rule| format!("#Inventor V2.1 ascii\n{}", r.text);
    let rules = super::rules::table::RULES.iter().map(rule);
    for input in samples.chain(rules.map(String::into_bytes)) {
        for (_, target) in fuzz_targets::ALL {
            target(&input);
        }
    }
}

/// Texts in what models are packed in: each in one of the ways.
fn packed_forms(texts: &[Vec<u8>]) -> Vec<Vec<u8>> {
    let pack = |(i, text): (usize, &Vec<u8>)| match i % 3 {
        0 => {
            let mut packer = GzEncoder::new(Vec::new(), flate2::Compression::default());
            packer.write_all(text).expect("memory");
            packer.finish().expect("memory")
        }
        odd => {
            let mut packer = ZipWriter::new(Cursor::new(Vec::new()));
            let plain = SimpleFileOptions::default();
            let options = match odd {
                1 => plain,
                _ => plain.with_aes_encryption(zip::AesMode::Aes128, "ivory"),
            };
            packer.start_file("model.iv", options).expect("memory");
            packer.write_all(text).expect("memory");
            packer.finish().expect("memory").into_inner()
        }
    };
    texts.iter().enumerate().map(pack).collect()
}

/// Inputs that were a fault once, in `tests/fuzz/regressions`: the beginning of each name is its
/// target.
#[test]
fn what_was_a_fault_is_none() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/regressions");
    let mut count = 0;
    for file in fs::read_dir(folder).expect("a folder") {
        let path = file.expect("a file").path();
        let name = path.file_name().and_then(|n| n.to_str()).expect("a name");
        let input = fs::read(&path).expect("a file");
        let mut targets = fuzz_targets::ALL.iter();
        let of_name = targets.find(|(target, _)| name.starts_with(&format!("{target}-")));
        let (_, target) = of_name.expect("a name that begins with its target's");
        let began = Instant::now();
        target(&input);
        assert!(began.elapsed() < SLOW, "{name} took {:?}", began.elapsed());
        count += 1;
    }
    assert!(count > 0, "there are none");
}

#[test]
fn mutated_inputs() {
    let texts = any_forms();
    let number = |name, usual| {
        let given = std::env::var(name).ok();
        given.and_then(|n| n.parse().ok()).unwrap_or(usual)
    };
    let budget = Duration::from_secs(number("FUZZ_SECONDS", BUDGET));
    let mut rng = Rng::new(number("FUZZ_SEED", 1));
    let start = Instant::now();
    let mut count = 0;
    while count < FEWEST || start.elapsed() < budget {
        let base = &texts[rng.below(texts.len())];
        let input = mutate(&mut rng, base, &texts);
        let began = Instant::now();
        let watch = Watch::over(&input);
        let (name, target) = fuzz_targets::ALL[rng.below(fuzz_targets::ALL.len())];
        let result = catch_unwind(|| target(&input));
        drop(watch);
        let took = began.elapsed();
        if result.is_err() || took > SLOW {
            panic!(
                "{name}: input {count} took {took:?}; kept as {}",
                keep(&input)
            );
        }
        count += 1;
    }
    println!("{count} inputs");
}

/// Keeps an input for a closer look; says where.
pub fn keep(input: &[u8]) -> String {
    let path = std::env::temp_dir().join("ivory-input.iv");
    fs::write(&path, input).expect("a file for the input");
    path.display().to_string()
}

/// Ends the process with a message when an input never ends.
pub struct Watch {
    /// Dropped when the input has ended.
    _ended: mpsc::Sender<()>,
}

impl Watch {
    pub fn over(input: &[u8]) -> Self {
        let input = input.to_vec();
        let (sender, receiver) = mpsc::channel();
        std::thread::spawn(move || {
            let result = receiver.recv_timeout(10 * SLOW);
            if result == Err(mpsc::RecvTimeoutError::Timeout) {
                eprintln!("an input does not end; kept as {}", keep(&input));
                std::process::abort();
            }
        });
        Self { _ended: sender }
    }
}

#[test]
fn hostile_inputs() {
    let mut failures = Vec::new();
    for case in hostile::ALL {
        let bytes = (case.make)();
        let start = Instant::now();
        let parsed = iv_parser::parse(&bytes);
        fuzz_body::print(&parsed.tree);
        let resolved = fuzz_body::resolve_within(&bytes, LIMITS);
        let took = start.elapsed();
        let codes: Vec<_> = resolved.diagnostics.iter().map(|d| d.code).collect();
        let shown = &codes[..codes.len().min(4)];
        println!(
            "{:8.3} s {}: {} {shown:?}",
            took.as_secs_f64(),
            case.name,
            codes.len()
        );
        if codes.len() > MOST_REMARKS {
            failures.push(format!("{}: {} remarks", case.name, codes.len()));
        }
        if took > Duration::from_secs(10) {
            failures.push(format!("{} took {took:?}", case.name));
        }
        let longest = resolved
            .diagnostics
            .iter()
            .map(|d| d.to_string().len())
            .max();
        if longest > Some(LONGEST_REMARK) {
            failures.push(format!("{}: a remark of {longest:?} bytes", case.name));
        }
        let expected = if case.code.is_empty() {
            codes.is_empty()
        } else {
            codes.contains(&case.code)
        };
        if !expected {
            failures.push(format!("{}: {shown:?}, wanted {}", case.name, case.code));
        }
    }
    if let Some(peak) = peak_memory_kib() {
        println!("peak memory {} MiB", peak >> 10);
        assert!(peak < 4 << 20, "peak memory {} MiB", peak >> 10);
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// Of the whole process, where the system tells.
fn peak_memory_kib() -> Option<u64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|l| l.starts_with("VmHWM:"))?;
    line.split_whitespace().nth(1)?.parse().ok()
}

#[test]
fn files_in_a_ring() {
    let folder = tempfile::tempdir().expect("a folder");
    let write = |name: &str, text: &str| {
        let text = format!("#Inventor V2.1 ascii\nSeparator {{ Cube {{ }} {text} }}");
        fs::write(folder.path().join(name), text).expect("a file");
    };
    write("self.iv", "File { name \"self.iv\" }");
    write("a.iv", "File { name \"b.iv\" }");
    write("b.iv", "File { name \"c.iv\" }");
    write("c.iv", "File { name \"a.iv\" } File { name \"a.iv\" }");
    // What is said of both is said once. 2^12 ways through twelve files that each include the next twice.
    for i in 0..12 {
        let next = format!("File {{ name \"n{}.iv\" }}", i + 1);
        write(&format!("n{i}.iv"), &next.repeat(2));
    }
    write("n12.iv", "");
    for (name, cubes, codes) in [
        ("self.iv", 1, &["include"][..]),
        ("a.iv", 3, &["include"]),
        ("n0.iv", 8191, &[]),
    ] {
        let bytes = fs::read(folder.path().join(name)).expect("a file");
        let loader = FileLoader::new([folder.path()]);
        let graph = load(&bytes, name, Path::new(folder.path()), &loader);
        let resolved = resolve(&graph, &ResolveOptions::default());
        assert_eq!(resolved.scene.instances.len(), cubes, "{name}");
        let ours: Vec<_> = graph.diagnostics.iter().map(|d| d.code).collect();
        assert_eq!(ours, codes, "{name}");
    }
}
