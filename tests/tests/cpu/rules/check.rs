//! One rule against what is made of its text.

use std::path::Path;

use glam::DVec3;
use scenegraph::scene::{Environment, Instance, LightModel, Material};
use scenegraph::{FileLoader, ResolveOptions, load, resolve};
use tests::measure::{Corner, Primitive, primitives, totals};

/// A rule. What is empty or `None` is not asked, but for `codes`, which are all there must be.
#[derive(Clone)]
pub struct Rule {
    /// In the guide's list.
    pub number: u8,
    /// What it is about.
    pub name: &'static str,
    /// The file; `#Inventor V2.1 ascii` is put before it unless it has a `#` of its own.
    pub text: &'static str,
    /// Primitives by world positions, in any order; triangles from any corner on.
    pub draws: &'static [&'static [[f64; 3]]],
    /// Colour of each corner of each primitive of `draws`.
    pub colors: &'static [&'static [[f64; 3]]],
    /// Normals, likewise.
    pub normals: &'static [&'static [[f64; 3]]],
    /// Texture coordinates, likewise.
    pub texcoords: &'static [&'static [[f64; 2]]],
    /// Normal of every corner.
    pub normal: Option<[f64; 3]>,
    /// Transparency of every corner.
    pub transparency: Option<f64>,
    /// Whether every shape is unlit.
    pub unlit: Option<bool>,
    /// The environment of every shape, but for its place.
    pub environment: Option<Environment>,
    /// Triangles, lines, points.
    pub counts: Option<[usize; 3]>,
    /// Area of all triangles.
    pub area: Option<f64>,
    /// Lower and upper corner.
    pub bounds: Option<[[f64; 3]; 2]>,
    /// Notes of the first node.
    pub notes: &'static [&'static str],
    /// Codes of all diagnostics.
    pub codes: &'static [&'static str],
}

/// Nothing asked.
pub const RULE: Rule = Rule {
    number: 0,
    name: "",
    text: "",
    draws: &[],
    colors: &[],
    normals: &[],
    texcoords: &[],
    normal: None,
    transparency: None,
    unlit: None,
    environment: None,
    counts: None,
    area: None,
    bounds: None,
    notes: &[],
    codes: &[],
};

/// Numbers of the rows are below 100 and pass through f32 and at most three matrices.
const TOLERANCE: f64 = 1e-5;

pub fn check(rule: &Rule) -> Result<(), String> {
    let text = if rule.text.trim_start().starts_with('#') {
        rule.text.to_owned()
    } else {
        format!("#Inventor V2.1 ascii\n{}", rule.text)
    };
    let loader = FileLoader::default();
    let graph = load(text.as_bytes(), "rule.iv", Path::new("."), &loader);
    let resolved = resolve(&graph, &ResolveOptions::default());
    let scene = &resolved.scene;
    let diagnostics = graph.diagnostics.iter().chain(&resolved.diagnostics);
    let codes: Vec<_> = diagnostics.map(|d| d.code).collect();
    same("codes", &codes, &rule.codes.to_vec())?;
    let t = totals(scene);
    if let Some(counts) = rule.counts {
        same("counts", &[t.triangles, t.lines, t.points], &counts)?;
    }
    if let Some(area) = rule.area {
        near("area", &[t.area], &[area])?;
    }
    if let Some([low, high]) = rule.bounds {
        let [l, h] = t.bounds.ok_or("nothing is drawn")?;
        near("lower bound", &l.to_array(), &low)?;
        near("upper bound", &h.to_array(), &high)?;
    }
    if !rule.notes.is_empty() {
        let notes: Vec<&str> = scene
            .nodes
            .first()
            .map_or(Vec::new(), |n| n.notes.iter().map(|note| &**note).collect());
        same("notes", &notes, &rule.notes.to_vec())?;
    }
    if let Some(unlit) = rule.unlit {
        let is_unlit = |m: &Material| m.light_model == LightModel::BaseColor;
        let ours: Vec<bool> = scene.materials.iter().map(is_unlit).collect();
        same("unlit", &ours, &vec![unlit; ours.len().max(1)])?;
    }
    if let Some(environment) = &rule.environment {
        let of = |i: &Instance| Environment {
            pos: environment.pos,
            ..scene.environments[i.environment.index()].clone()
        };
        let ours: Vec<Environment> = scene.instances.iter().map(of).collect();
        let wanted = vec![environment.clone(); ours.len().max(1)];
        same("environment", &ours, &wanted)?;
    }
    let drawn: Vec<Primitive> = primitives(scene).collect();
    for corner in drawn.iter().flat_map(|p| &p.corners) {
        if let Some(normal) = rule.normal {
            let n = corner.n_in_world.ok_or("no normals")?;
            near("normal", &n.to_array(), &normal)?;
        }
        if let Some(transparency) = rule.transparency {
            near("transparency", &[corner.transparency], &[transparency])?;
        }
    }
    if rule.draws.is_empty() {
        return Ok(());
    }
    compare(sorted(drawn), sorted(wanted(rule)), rule)
}

fn compare(drawn: Vec<Primitive>, wanted: Vec<Primitive>, rule: &Rule) -> Result<(), String> {
    same("number of primitives", &drawn.len(), &wanted.len())?;
    for (ours, want) in drawn.iter().zip(&wanted) {
        same("corners", &ours.corners.len(), &want.corners.len())?;
        for (a, b) in ours.corners.iter().zip(&want.corners) {
            near(
                "position",
                &a.p_in_world.to_array(),
                &b.p_in_world.to_array(),
            )?;
            if !rule.colors.is_empty() {
                near("colour", &a.color_srgb, &b.color_srgb)?;
            }
            if let Some(n) = b.n_in_world {
                let ours = a.n_in_world.ok_or("no normals")?;
                near("normal", &ours.to_array(), &n.to_array())?;
            }
            if let Some(uv) = b.texcoord {
                near("texcoord", &a.texcoord.ok_or("no texcoords")?, &uv)?;
            }
        }
    }
    Ok(())
}

fn wanted(rule: &Rule) -> Vec<Primitive> {
    let primitive = |(i, corners): (usize, &&[[f64; 3]])| Primitive {
        corners: corners
            .iter()
            .enumerate()
            .map(|(j, p)| Corner {
                p_in_world: DVec3::from(*p),
                n_in_world: rule.normals.get(i).map(|n| DVec3::from(n[j])),
                texcoord: rule.texcoords.get(i).map(|t| t[j]),
                color_srgb: rule.colors.get(i).map_or([0.0; 3], |c| c[j]),
                transparency: 0.0,
            })
            .collect(),
    };
    rule.draws.iter().enumerate().map(primitive).collect()
}

/// In an order of its own: triangles from their least corner on, then by positions.
fn sorted(mut primitives: Vec<Primitive>) -> Vec<Primitive> {
    let key = |p: DVec3| {
        p.to_array()
            .map(|x| (x / (10.0 * TOLERANCE)).round() as i64)
    };
    for p in &mut primitives {
        if p.corners.len() == 3 {
            let least = (0..3).min_by_key(|&i| key(p.corners[i].p_in_world));
            p.corners.rotate_left(least.unwrap_or(0));
        }
    }
    primitives.sort_by_key(|p| {
        let keys = p.corners.iter().map(|c| key(c.p_in_world));
        keys.collect::<Vec<_>>()
    });
    primitives
}

fn same<T: PartialEq + std::fmt::Debug>(what: &str, ours: &T, wanted: &T) -> Result<(), String> {
    if ours == wanted {
        return Ok(());
    }
    Err(format!("{what}: {ours:?}, wanted {wanted:?}"))
}

fn near(what: &str, ours: &[f64], wanted: &[f64]) -> Result<(), String> {
    let close = |(a, b): (&f64, &f64)| (a - b).abs() <= TOLERANCE;
    if ours.iter().zip(wanted).all(close) {
        return Ok(());
    }
    Err(format!("{what}: {ours:?}, wanted {wanted:?}"))
}
