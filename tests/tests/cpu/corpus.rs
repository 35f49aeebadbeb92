//! The corpus of real files against Coin 4.0: what is drawn must be the same, and every difference
//! must have a reason that stands in [`explained`].
//!
//! Files are resolved on Coin's terms: see [`ResolveOptions::like_coin`].

mod explained;
mod report;

use std::fs;
use std::path::Path;

use iv_parser::{Diagnostic, Severity};
use scenegraph::{FileLoader, RegistryLayout, ResolveOptions, load, resolve};
use tests::corpus::{Counts, Entry, entries, folder};
use tests::measure::{Totals, totals};

/// One file, read.
struct Outcome {
    entry: Entry,
    totals: Totals,
    lights: usize,
    cameras: usize,
    diagnostics: Vec<Diagnostic>,
}

/// Something measured that is not as Coin has it.
struct Difference {
    what: &'static str,
    ours: String,
    coin: String,
}

fn is_binary(entry: &Entry) -> bool {
    entry.header.contains("binary")
}

fn read(folder: &Path, entry: &Entry) -> Outcome {
    let files = folder.join("files");
    let source = files.join(entry.path.split('/').next().unwrap_or_default());
    let path = files.join(&entry.path);
    let loader = FileLoader::new([source.as_path()]);
    let bytes = fs::read(&path).expect("a file of the corpus");
    let beside = path.parent().unwrap_or(&source);
    let graph = load(&bytes, &entry.path, beside, &loader);
    let options = ResolveOptions {
        like_coin: true,
        ..ResolveOptions::default()
    };
    let resolved = resolve(&graph, &options);
    assert_eq!(resolved.scene.check(), [], "{}", entry.path);
    let mut diagnostics = graph.diagnostics;
    diagnostics.extend(resolved.diagnostics);
    Outcome {
        entry: entry.clone(),
        totals: totals(&resolved.scene),
        lights: resolved.scene.lights.len(),
        cameras: resolved.scene.cameras.len(),
        diagnostics,
    }
}

/// All files, in the corpus's order.
fn outcomes(folder: &Path) -> Vec<Outcome> {
    let entries = entries(folder).expect("the corpus's list");
    entries.iter().map(|e| read(folder, e)).collect()
}

impl Outcome {
    /// Coin drew face, line and point sets only, so that all numbers can be compared.
    fn is_exact(&self) -> bool {
        let e = &self.entry;
        e.analytic.is_empty() && e.text.is_empty() && e.nurbs.is_empty()
    }

    /// Whether draggers are left out.
    fn has_draggers(&self) -> bool {
        self.diagnostics.iter().any(|d| d.code == "dragger")
    }

    fn differences(&self) -> Vec<Difference> {
        if self.is_exact() {
            self.exact_differences()
        } else {
            self.bounds_difference().into_iter().collect()
        }
    }

    fn exact_differences(&self) -> Vec<Difference> {
        let (ours, coin) = (&self.totals, &self.entry.explicit);
        let mut differences = Vec::new();
        let mut number = |what, ours, coin, tolerance| {
            differences.extend(unequal(what, ours, coin, tolerance));
        };
        let counts = [
            ("lines", ours.lines, coin.lines),
            ("points", ours.points, coin.points),
            ("colours", ours.colors, self.entry.colors),
            (
                "transparencies",
                ours.transparencies,
                self.entry.transparencies,
            ),
            ("lights", self.lights, self.entry.lights),
            ("cameras", self.cameras, self.entry.cameras),
        ];
        for (what, ours, coin) in counts {
            number(what, ours as f64, coin as f64, 0.0);
        }
        // Of textured triangles too, degenerate ones may be missing.
        let degenerate = coin.triangles.saturating_sub(ours.triangles);
        if !(ours.textured..=ours.textured + degenerate).contains(&coin.textured) {
            let (ours, coin) = (ours.textured as f64, coin.textured as f64);
            number("textured triangles", ours, coin, 0.0);
        }
        // Degenerate triangles, which are left out here, count for Coin's sum.
        if ours.triangles == coin.triangles {
            for (i, what) in ["texture s", "texture t"].into_iter().enumerate() {
                let (ours, coin) = (ours.texcoord_sum[i], coin.texcoord_sum[i]);
                number(what, ours, coin, 1e-5 * coin.abs());
            }
        }
        let far = coin.bounds.map_or(0.0, |b| largest(&b));
        number("area", ours.area, coin.area, 1e-5 * coin.area);
        number("length", ours.length, coin.length, 1e-5 * coin.length);
        // The volume of a triangle and the origin is at most a third of area times distance.
        let volume_tolerance = 1e-5 * coin.area * far / 3.0;
        number("volume", ours.volume, coin.volume, volume_tolerance);
        let normal_tolerance = 1e-3 * coin.normal_dot.abs();
        number(
            "normals",
            ours.normal_dot,
            coin.normal_dot,
            normal_tolerance,
        );
        differences.extend(self.box_against(coin_bounds(&[coin]), [0.0; 2]));
        differences
    }

    /// Analytic shapes depend on the tessellation: bounds may differ by the heights of the chords,
    /// 1 - cos(180°/15) = 2.2 % of a radius for Coin's coarsest circle at the default complexity,
    /// 1 - cos(180°/32) = 0.49 % for ours. Of text and NURBS nothing is asked.
    fn bounds_difference(&self) -> Option<Difference> {
        let e = &self.entry;
        let coin = coin_bounds(&[&e.explicit, &e.analytic]);
        let more = !e.text.is_empty() || !e.nurbs.is_empty();
        let outwards = if more { f64::INFINITY } else { 0.022 };
        self.box_against(coin, [0.0049, outwards])
    }

    /// Our bounds stay inside Coin's and reach beyond them by at most these parts of a radius.
    fn box_against(
        &self,
        coin: Option<[f64; 6]>,
        [inside, outside]: [f64; 2],
    ) -> Option<Difference> {
        let ours = self.totals.bounds.map(|[low, high]| {
            let mut bounds = [0.0; 6];
            bounds[..3].copy_from_slice(&low.to_array());
            bounds[3..].copy_from_slice(&high.to_array());
            bounds
        });
        let agree = match (ours, coin) {
            (None, None) => true,
            (Some(_), None) => outside.is_infinite(),
            (None, Some(_)) => false,
            (Some(ours), Some(coin)) => {
                let size = (0..3).fold(0.0, |m: f64, i| m.max(coin[i + 3] - coin[i]));
                let radius = 0.5 * size;
                // Coin's own numbers are f32: 2^-24 of the distance a step, for some steps.
                let rounding = 1e-5 * size + 1e-6 * largest(&coin);
                let allowed = -inside * radius - rounding..=outside * radius + rounding;
                (0..6).all(|i| {
                    let sign = if i < 3 { -1.0 } else { 1.0 };
                    allowed.contains(&(sign * (ours[i] - coin[i])))
                })
            }
        };
        let text = |b: Option<[f64; 6]>| b.map_or("none".to_owned(), |b| format!("{b:.4?}"));
        (!agree).then(|| Difference {
            what: "bounds",
            ours: text(ours),
            coin: text(coin),
        })
    }
}

fn unequal(what: &'static str, ours: f64, coin: f64, tolerance: f64) -> Option<Difference> {
    let number = |x: f64| {
        if x.fract() == 0.0 {
            format!("{x}")
        } else {
            format!("{x:.6e}")
        }
    };
    ((ours - coin).abs() > tolerance).then(|| Difference {
        what,
        ours: number(ours),
        coin: number(coin),
    })
}

fn largest(numbers: &[f64]) -> f64 {
    numbers.iter().fold(0.0, |m, x| m.max(x.abs()))
}

fn coin_bounds(counts: &[&Counts]) -> Option<[f64; 6]> {
    let drawn = counts.iter().filter(|c| !c.is_empty());
    drawn.filter_map(|c| c.bounds).reduce(|a, b| {
        let mut both = a;
        for i in 0..3 {
            both[i] = a[i].min(b[i]);
            both[i + 3] = a[i + 3].max(b[i + 3]);
        }
        both
    })
}

#[test]
fn every_difference_to_coin_has_a_reason() {
    let Some(folder) = folder() else { return };
    let mut unexplained = Vec::new();
    let mut needed = Vec::new();
    for outcome in outcomes(&folder).iter().filter(|o| o.entry.coin_ok) {
        for difference in outcome.differences() {
            let path = outcome.entry.path.as_str();
            let Difference { what, ours, coin } = &difference;
            println!("{path}: {what}: {ours}, Coin {coin}");
            match explained::reason(outcome, what) {
                Some(_) => needed.push((path.to_owned(), *what)),
                None => unexplained.push(format!("{path}: {what}: {ours}, Coin {coin}")),
            }
        }
    }
    assert!(unexplained.is_empty(), "{}", unexplained.join("\n"));
    let stale: Vec<_> = explained::listed()
        .filter(|(path, what)| !needed.iter().any(|(p, w)| p == path && w == what))
        .collect();
    assert!(stale.is_empty(), "no longer different: {stale:?}");
}

#[test]
fn files_that_coin_refuses_are_read_and_reported() {
    let Some(folder) = folder() else { return };
    let outcomes = outcomes(&folder);
    let refused: Vec<_> = outcomes.iter().filter(|o| !o.entry.coin_ok).collect();
    for outcome in &refused {
        let told = |d: &Diagnostic| d.severity >= Severity::Warning && d.pos.is_known();
        // What noodle wrote is read whole; all else that Coin refuses lacks something.
        let is_silent = outcome
            .diagnostics
            .iter()
            .all(|d| d.severity == Severity::Note);
        let is_whole = is_silent && outcome.entry.path.contains("/noodle/");
        assert!(
            is_whole || outcome.diagnostics.iter().any(told),
            "{}",
            outcome.entry.path
        );
    }
    let with_geometry = refused.iter().filter(|o| o.totals.bounds.is_some()).count();
    assert!(with_geometry >= 25, "{with_geometry} of {}", refused.len());
}

#[test]
fn binary_files_are_read_to_the_last_byte() {
    let Some(folder) = folder() else { return };
    let entries = entries(&folder).expect("the corpus's list");
    for entry in entries.iter().filter(|entry| is_binary(entry)) {
        let bytes = fs::read(folder.join("files").join(&entry.path)).expect("a file of the corpus");
        let limits = iv_parser::Limits::default();
        let parsed = iv_parser::parse_any(&bytes, &RegistryLayout, &limits);
        assert_eq!(parsed.problems, [], "{}", entry.path);
        assert!(parsed.tree.node_count() > 0, "{}", entry.path);
    }
}

#[test]
fn the_report_is_up_to_date() {
    let Some(folder) = folder() else { return };
    let text = report::render(&outcomes(&folder));
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/CORPUS.md");
    if std::env::var_os("UPDATE_DOCS").is_some() {
        fs::write(&path, &text).expect("docs/CORPUS.md can be written");
    }
    let stored = fs::read_to_string(&path).unwrap_or_default();
    assert!(
        stored == text,
        "docs/CORPUS.md is out of date: run with UPDATE_DOCS=1"
    );
}
