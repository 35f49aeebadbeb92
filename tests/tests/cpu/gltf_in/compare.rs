//! What differs between a scene and the one that was read back.
//!
//! Instances come back in another order and their meshes' origins in their transforms; so each is
//! looked for among those with the same positions and indices at the same place.

use std::collections::HashMap;

use glam::{DAffine3, DVec3};
use iv_parser::SourcePos;
use scenegraph::scene::{
    Camera, Environment, Faces, Instance, Light, LightKind, LightModel, Material, Mesh, Scene,
    TextureModel, TextureSource, Topology,
};

/// Which values a file holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Values {
    /// Inventor's own.
    Inventors,
    /// Those of glTF's look that can be turned back.
    Looks,
    /// All, of a scene that comes from such a file.
    Again,
}

/// Relative tolerance of transforms: a dozen products and one decomposition for each level.
const TRANSFORM: f64 = 1e-12;
/// Half a step of a 16-bit linear colour, where the transfer function is steepest.
const COLOR: f32 = 12.92 / 65535.0 / 2.0 + 1e-6;
/// What counts as an Inventor default and is left out.
const DEFAULT: f64 = 5e-7;
/// A value that went through linear light, a quotient and f32.
const LOOK: f64 = 2e-5;

pub fn differences(want: &Scene, got: &Scene, values: Values) -> Vec<String> {
    let mut faults = Vec::new();
    let counts = |s: &Scene| (s.instances.len(), s.lights.len(), s.cameras.len());
    if counts(want) != counts(got) {
        faults.push(format!("counts {:?}, {:?}", counts(want), counts(got)));
        return faults;
    }
    let size = extent(want);
    let near = |a: &DAffine3, b: &DAffine3| {
        let pairs = a.to_cols_array().into_iter().zip(b.to_cols_array());
        let pairs = pairs.enumerate();
        pairs.into_iter().all(|(i, (a, b))| {
            let scale = if i < 9 {
                largest(&want_linear(b, a))
            } else {
                size
            };
            (a - b).abs() <= TRANSFORM * scale.max(1.0)
        })
    };
    let mut open: HashMap<Vec<u32>, Vec<usize>> = HashMap::new();
    for (i, instance) in got.instances.iter().enumerate() {
        let key = key(&got.meshes[instance.mesh.index()]);
        open.entry(key).or_default().push(i);
    }
    for (i, instance) in want.instances.iter().enumerate() {
        let mesh = &want.meshes[instance.mesh.index()];
        let there = open.entry(key(mesh)).or_default();
        let place = world(want, instance);
        let mut reason = "nothing of its shape is at its place".to_owned();
        let found = there.iter().position(|&candidate| {
            let other = &got.instances[candidate];
            if !near(&place, &world(got, other)) {
                return false;
            }
            let difference = shape_difference((want, instance), (got, other), values);
            match difference {
                None => true,
                Some(why) => {
                    reason = why;
                    false
                }
            }
        });
        match found {
            Some(at) => {
                there.swap_remove(at);
            }
            None => faults.push(format!("instance {i}: {reason}")),
        }
    }
    for (i, (a, b)) in want.lights.iter().zip(&got.lights).enumerate() {
        if let Some(why) = light_difference((want, a), (got, b), size, values) {
            faults.push(format!("light {i}: {why}: {a:?}, {b:?}"));
        }
    }
    for (i, (a, b)) in want.cameras.iter().zip(&got.cameras).enumerate() {
        if let Some(why) = camera_difference(a, b, size, values) {
            faults.push(format!("camera {i}: {why}: {a:?}, {b:?}"));
        }
    }
    faults
}

fn want_linear(a: f64, b: f64) -> [f64; 2] {
    [a, b]
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, v| v.abs().max(most))
}

/// Largest number in any transform.
fn extent(scene: &Scene) -> f64 {
    let groups = scene.nodes.iter().map(|n| n.parent_from_local);
    let items = scene.instances.iter().map(|i| world(scene, i));
    let lights = scene.lights.iter().map(|l| l.placement.world_from_local);
    let all = groups.chain(items).chain(lights);
    all.fold(1.0, |most, m| largest(&m.to_cols_array()).max(most))
}

fn key(mesh: &Mesh) -> Vec<u32> {
    let corners = mesh.indices.iter();
    let positions = corners.flat_map(|&i| mesh.positions[i as usize].map(f32::to_bits));
    let positions = positions.collect::<Vec<_>>();
    [vec![mesh.topology as u32], positions].concat()
}

fn world(scene: &Scene, instance: &Instance) -> DAffine3 {
    let origin = scene.meshes[instance.mesh.index()].origin;
    instance.placement.world_from_local * DAffine3::from_translation(origin)
}

fn first(rows: &[(&str, bool)]) -> Option<String> {
    let row = rows.iter().find(|(_, same)| !same)?;
    Some(row.0.to_owned())
}

fn close(a: &[f64], b: &[f64], tolerance: f64) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() <= tolerance)
}

fn shape_difference(
    (want, a): (&Scene, &Instance),
    (got, b): (&Scene, &Instance),
    values: Values,
) -> Option<String> {
    let (mesh, back) = (&want.meshes[a.mesh.index()], &got.meshes[b.mesh.index()]);
    let (material, look) = (
        &want.materials[a.material.index()],
        &got.materials[b.material.index()],
    );
    let texture = material.texture.map(|id| &want.textures[id.index()]);
    let textured = texture.filter(|_| !mesh.texcoords.is_empty());
    let shown = look.texture.map(|id| &got.textures[id.index()]);
    let unlit = material.light_model == LightModel::BaseColor
        || (mesh.topology != Topology::Triangles && mesh.normals.is_empty())
        || textured.is_some_and(|t| matches!(t.model, TextureModel::Replace | TextureModel::Decal));
    let replaced = textured.is_some_and(|t| t.model == TextureModel::Replace);
    let normals = if unlit && back.normals.is_empty() {
        true
    } else {
        mesh.normals == back.normals && mesh.indices == back.indices
    };
    let texcoords = mesh.texcoords.iter().zip(&back.texcoords).all(|(a, b)| {
        // Two subtractions from 1 in f32.
        let tolerance = f32::EPSILON * a[1].abs().max(1.0);
        a[0] == b[0] && (a[1] - b[1]).abs() <= tolerance
    });
    let colors = mesh
        .colors_srgb
        .iter()
        .zip(&back.colors_srgb)
        .all(|(a, b)| {
            let near = |(a, b): (&f32, &f32)| (a - b).abs() <= COLOR;
            a.iter().zip(b).all(near)
        });
    let in_another_order = mesh.indices != back.indices;
    let texture_back = match (textured, shown) {
        (None, _) => true,
        (Some(_), None) => false,
        (Some(a), Some(b)) => {
            let embedded = matches!(b.source, TextureSource::Encoded { .. });
            let mixed = values != Values::Inventors || b.model != a.model;
            a.name == b.name
                && (a.wrap_s, a.wrap_t) == (b.wrap_s, b.wrap_t)
                && embedded
                && (!mixed || b.model == TextureModel::Modulate)
        }
    };
    let reads_colors = !mesh.colors_srgb.is_empty() && !replaced;
    let lit_set = |scene: &Scene, i: &Instance| scene.light_sets[i.light_set.index()].clone();
    // Places in the source do not come back.
    let environment = |s: &Scene, i: &Instance| Environment {
        pos: SourcePos::default(),
        ..s.environments[i.environment.index()].clone()
    };
    first(&[
        ("indices", !in_another_order),
        ("normals", normals),
        ("texcoords", texcoords),
        (
            "texcoords are there",
            textured.is_none() || !back.texcoords.is_empty(),
        ),
        ("colours", colors),
        (
            "colours are there",
            !reads_colors || !back.colors_srgb.is_empty(),
        ),
        ("texture", texture_back),
        (
            "light set",
            values == Values::Looks || lit_set(want, a) == lit_set(got, b),
        ),
        (
            "environment",
            values == Values::Looks || environment(want, a) == environment(got, b),
        ),
    ])
    .or_else(|| {
        let colored = reads_colors || texture.is_some();
        let why = material_difference(material, look, values, colored, unlit);
        why.map(|why| format!("{why}: {material:?}, {look:?}"))
    })
}

fn material_difference(
    a: &Material,
    b: &Material,
    values: Values,
    colored: bool,
    unlit: bool,
) -> Option<String> {
    if values == Values::Looks {
        return look_difference(a, b, colored, unlit);
    }
    let tolerance = if values == Values::Again {
        LOOK
    } else {
        DEFAULT
    };
    let colors = |m: &Material| [m.ambient_srgb, m.specular_srgb, m.emissive_srgb].concat();
    let diffuse = |m: &Material| [m.diffuse_srgb, [m.shininess, m.transparency, 0.0]].concat();
    let line = |m: &Material| [m.line_width_px, m.point_size_px];
    // A texture that was mixed with the colour is white underneath.
    let mixed = b.texture.is_some() && b.diffuse_srgb == [1.0; 3];
    first(&[
        ("name", a.name == b.name),
        (
            "colours",
            unlit && values == Values::Again || close(&colors(a), &colors(b), tolerance),
        ),
        (
            "diffuse colour",
            mixed || unlit && values == Values::Again || close(&diffuse(a), &diffuse(b), tolerance),
        ),
        ("line", close(&line(a), &line(b), tolerance)),
        ("pattern", a.line_pattern == b.line_pattern),
        ("light model", a.light_model == b.light_model),
        ("faces", a.faces == b.faces),
    ])
}

/// Within what glTF's factors can say: not where one is at its end.
fn look_difference(a: &Material, b: &Material, colored: bool, unlit: bool) -> Option<String> {
    let exponent = 128.0 * a.shininess;
    let c2 = (-2.0 / exponent).exp2();
    let alpha_squared = (1.0 - c2) / (2.0_f64.sqrt() - c2);
    let f0 = a.specular_srgb.map(|ks| 4.0 * alpha_squared * ks);
    let most = largest(&f0);
    let linear = |v: f64| ((v + 0.055) / 1.055).powf(2.4);
    let clamped = a
        .diffuse_srgb
        .iter()
        .any(|&v| linear(v) > 1.0 - most.min(1.0));
    let lit = !unlit;
    first(&[
        ("name", a.name == b.name),
        (
            "faces",
            (a.faces == Faces::FrontOnly) == (b.faces == Faces::FrontOnly),
        ),
        (
            "light model",
            unlit == (b.light_model == LightModel::BaseColor),
        ),
        (
            "diffuse colour",
            colored || clamped || close(&a.diffuse_srgb, &b.diffuse_srgb, LOOK),
        ),
        (
            "transparency",
            colored || close(&[a.transparency], &[b.transparency], LOOK),
        ),
        (
            "emissive colour",
            !lit || close(&a.emissive_srgb, &b.emissive_srgb, LOOK),
        ),
        (
            "shininess",
            !lit || close(&[a.shininess], &[b.shininess], LOOK),
        ),
        (
            "specular colour",
            !lit || most > 1.0 || close(&a.specular_srgb, &b.specular_srgb, LOOK),
        ),
    ])
}

/// Where a light is and which way it shines, in the world.
fn beam(light: &Light) -> (Option<DVec3>, Option<DVec3>) {
    let frame = &light.placement.world_from_local;
    let at = |p| Some(frame.transform_point3(p));
    let along = |v: DVec3| Some(frame.transform_vector3(v).normalize());
    match light.kind {
        LightKind::Directional { direction } => (None, along(direction)),
        LightKind::Point { location } => (at(location), None),
        LightKind::Spot {
            location,
            direction,
            ..
        } => (at(location), along(direction)),
    }
}

fn same_place(a: Option<DVec3>, b: Option<DVec3>, size: f64) -> bool {
    match (a, b) {
        (Some(a), Some(b)) => a.distance(b) <= 4.0 * TRANSFORM * size,
        (a, b) => a == b,
    }
}

fn light_difference(
    (want, a): (&Scene, &Light),
    (got, b): (&Scene, &Light),
    size: f64,
    values: Values,
) -> Option<String> {
    let ((place, way), (place_back, way_back)) = (beam(a), beam(b));
    let cone = |light: &Light| match light.kind {
        LightKind::Spot {
            drop_off_rate,
            cut_off_angle_rad,
            ..
        } => {
            // A beam has a drop-off of its own, which stands in the extras alone.
            let has_drop_off = values == Values::Inventors || a.beam.is_none();
            [
                if has_drop_off { drop_off_rate } else { 0.0 },
                cut_off_angle_rad,
            ]
        }
        _ => [0.0; 2],
    };
    let attenuation = |scene: &Scene, light: &Light| match light.kind {
        LightKind::Directional { .. } => [0.0; 3],
        _ => scene.environments[light.environment.index()].attenuation,
    };
    let tolerance = if values == Values::Inventors {
        DEFAULT
    } else {
        LOOK
    };
    let strength = tolerance * a.intensity.abs().max(1.0);
    let directional = matches!(a.kind, LightKind::Directional { .. });
    let comparable = values != Values::Looks || directional;
    first(&[
        ("place", same_place(place, place_back, size)),
        ("direction", same_place(way, way_back, 1.0)),
        ("name", a.placement.name == b.placement.name),
        ("colour", close(&a.color_srgb, &b.color_srgb, tolerance)),
        (
            "intensity",
            !comparable || close(&[a.intensity], &[b.intensity], strength),
        ),
        (
            "attenuation",
            !comparable || attenuation(want, a) == attenuation(got, b),
        ),
        ("cone", close(&cone(a), &cone(b), tolerance)),
        ("beam", values != Values::Inventors || a.beam == b.beam),
    ])
}

fn camera_difference(a: &Camera, b: &Camera, size: f64, values: Values) -> Option<String> {
    let pose = |c: &Camera| {
        let frame = &c.placement.world_from_local;
        let turned = |v| frame.transform_vector3(c.orientation * v).normalize();
        (
            frame.transform_point3(c.position),
            turned(DVec3::NEG_Z),
            turned(DVec3::Y),
        )
    };
    let ((eye, view, up), (eye_back, view_back, up_back)) = (pose(a), pose(b));
    let numbers = |c: &Camera| {
        let unit = c
            .placement
            .world_from_local
            .transform_vector3(c.orientation * DVec3::NEG_Z);
        [c.near_distance, c.far_distance, c.focal_distance].map(|d| d * unit.length())
    };
    let exact = values == Values::Inventors;
    first(&[
        ("eye", same_place(Some(eye), Some(eye_back), size)),
        ("view", same_place(Some(view), Some(view_back), 1.0)),
        ("up", same_place(Some(up), Some(up_back), 1.0)),
        ("projection", a.projection == b.projection),
        (
            "distances",
            !exact || close(&numbers(a), &numbers(b), DEFAULT * size),
        ),
        (
            "aspect",
            !exact || close(&[a.aspect_ratio], &[b.aspect_ratio], DEFAULT),
        ),
        (
            "mapping",
            !exact || a.viewport_mapping == b.viewport_mapping,
        ),
    ])
}
