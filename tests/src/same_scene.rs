//! Whether two scenes show the same: shapes corner by corner in the world, with their looks, names
//! and what lights them. The grouping, the order of shapes, and where a mesh has its origin may
//! differ.

use std::collections::BTreeMap;

use glam::DVec3;
use scenegraph::scene::{
    Camera, Environment, Faces, Instance, Light, LightKind, LightModel, Material, Placement,
    Projection, Scene, TextureSource, Topology,
};

/// Positions and directions: one rounding to f32 of a coordinate relative to its mesh, and the
/// products of f64 transforms.
const F32: f64 = 1.2e-7;
/// Values of looks: those that went through the shortest text of an f32.
const VALUE: f64 = 1e-6;

/// The differences, the first few of them.
pub fn differences(want: &Scene, got: &Scene) -> Vec<String> {
    let mut faults = Vec::new();
    let counts = |s: &Scene| (s.instances.len(), s.lights.len(), s.cameras.len());
    if counts(want) != counts(got) {
        return vec![format!("counts {:?}, {:?}", counts(want), counts(got))];
    }
    let mut open: BTreeMap<String, Vec<&Instance>> = BTreeMap::new();
    for instance in &got.instances {
        open.entry(kind(got, instance)).or_default().push(instance);
    }
    for (i, instance) in want.instances.iter().enumerate() {
        let there = open.entry(kind(want, instance)).or_default();
        let mut reason = format!("there is no {}", kind(want, instance));
        let found =
            there.iter().position(
                |other| match shape_difference((want, instance), (got, other)) {
                    None => true,
                    Some(why) => {
                        // The closest candidate is the one that only the light tells apart.
                        if !reason.contains("lit by") {
                            reason = why;
                        }
                        false
                    }
                },
            );
        match found {
            Some(at) => {
                there.remove(at);
            }
            None => faults.push(format!("shape {i}: {reason}")),
        }
        if faults.len() > 3 {
            return faults;
        }
    }
    let lights = want.lights.iter().zip(&got.lights);
    for (i, (a, b)) in lights.enumerate() {
        if !same_light((want, a), (got, b)) {
            faults.push(format!("light {i}: {a:?}, {b:?}"));
        }
    }
    for (i, (a, b)) in want.cameras.iter().zip(&got.cameras).enumerate() {
        if !same_camera(a, b) {
            faults.push(format!("camera {i}: {a:?}, {b:?}"));
        }
    }
    faults
}

fn kind(scene: &Scene, instance: &Instance) -> String {
    let mesh = &scene.meshes[instance.mesh.index()];
    let material = &scene.materials[instance.material.index()];
    format!(
        "{:?} of {} indices called {:?} with {:?}",
        mesh.topology,
        mesh.indices.len(),
        name(scene, instance),
        material.name
    )
}

/// The name nearest to a shape: its own, or that of a group that holds nothing else.
fn name<'s>(scene: &'s Scene, instance: &'s Instance) -> Option<&'s str> {
    let own = instance.placement.name.as_deref();
    let mut at = instance.placement.node;
    let mut name = own;
    while let (None, Some(node)) = (name, at) {
        let node = &scene.nodes[node.index()];
        name = node.name.as_deref();
        at = node.parent;
    }
    name
}

fn close(a: f64, b: f64, tolerance: f64) -> bool {
    (a - b).abs() <= tolerance
}

fn all_close(a: &[f64], b: &[f64]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| close(*a, *b, VALUE))
}

fn shape_difference((s, a): (&Scene, &Instance), (t, b): (&Scene, &Instance)) -> Option<String> {
    let (m, n) = (&s.meshes[a.mesh.index()], &t.meshes[b.mesh.index()]);
    let has = |mesh: &scenegraph::scene::Mesh| {
        (
            mesh.normals.len().min(1),
            mesh.texcoords.len().min(1),
            mesh.colors_srgb.len().min(1),
        )
    };
    let (look, other) = (
        &s.materials[a.material.index()],
        &t.materials[b.material.index()],
    );
    let unlit = |m: &Material| m.light_model == LightModel::BaseColor;
    let ((nm, tm, cm), (nn, tn, cn)) = (has(m), has(n));
    // Normals of what is not lit, and coordinates without a texture, play no part; a replacing
    // texture is not lit in glTF, so that no normals come from there.
    if (unlit(look) != unlit(other))
        || (!unlit(look) && nm > nn)
        || (look.texture.is_some() && tm != tn)
        || cm != cn
    {
        return Some(format!("attributes {:?}, {:?}", has(m), has(n)));
    }
    let (frame, frame_back) = (a.placement.world_from_local, b.placement.world_from_local);
    let scale = frame
        .matrix3
        .to_cols_array()
        .iter()
        .fold(0.0, |most: f64, v| v.abs().max(most));
    let extent = m
        .positions
        .as_flattened()
        .iter()
        .fold(0.0, |most: f32, v| v.abs().max(most));
    let far = |v: DVec3| v.abs().max_element();
    let reach = far(m.origin) + f64::from(extent);
    let room =
        4.0 * F32 * scale * f64::from(extent) + 1e-12 * (scale * reach + far(frame.translation));
    let apart = |i: u32, k: u32| {
        let p = frame.transform_point3(m.p_in_local(i));
        let q = frame_back.transform_point3(n.p_in_local(k));
        let near = (p - q).abs().max_element() <= room;
        (!near).then_some((p, q))
    };
    // Where the order of corners says nothing, a face is turned by its normals.
    let may_turn = look.faces == Faces::BothOneSidedLighting && m.topology == Topology::Triangles;
    let mut theirs = n.indices.clone();
    for (corner, &i) in m.indices.iter().enumerate() {
        if may_turn && corner % 3 == 1 && apart(i, theirs[corner]).is_some() {
            theirs.swap(corner, corner + 1);
        }
        let k = theirs[corner];
        if let Some((p, q)) = apart(i, k) {
            return Some(format!("corner {corner} at {p}, {q}"));
        }
        let (i, k) = (i as usize, k as usize);
        if nm == 1 && nn == 1 && !unlit(look) {
            let differ = (0..3).any(|x| (m.normals[i][x] - n.normals[k][x]).abs() > 4e-7);
            if differ {
                return Some(format!("normal {:?}, {:?}", m.normals[i], n.normals[k]));
            }
        }
        if tm == 1 && tn == 1 && m.texcoords[i] != n.texcoords[k] {
            return Some(format!(
                "texcoord {:?}, {:?}",
                m.texcoords[i], n.texcoords[k]
            ));
        }
        if cm == 1 && m.colors_srgb[i] != n.colors_srgb[k] {
            return Some(format!(
                "colour {:?}, {:?}",
                m.colors_srgb[i], n.colors_srgb[k]
            ));
        }
    }
    look_difference((s, look), (t, other), cm == 1, m.topology)
        .or_else(|| lit_difference((s, a), (t, b)))
}

fn look_difference(
    (s, a): (&Scene, &Material),
    (t, b): (&Scene, &Material),
    colored: bool,
    topology: Topology,
) -> Option<String> {
    let colors = |m: &Material| [m.ambient_srgb, m.specular_srgb, m.emissive_srgb].concat();
    let base = |m: &Material| [m.diffuse_srgb.to_vec(), vec![m.transparency]].concat();
    let line = |m: &Material| (m.line_width_px, m.point_size_px, m.line_pattern);
    let texture = |s: &Scene, m: &Material| {
        m.texture.map(|id| {
            let t = &s.textures[id.index()];
            let has_image =
                !matches!(&t.source, TextureSource::File { name, .. } if name.is_empty());
            (t.name.clone(), t.wrap_s, t.wrap_t, t.model, has_image)
        })
    };
    let same = all_close(&colors(a), &colors(b))
        && (colored && topology == Topology::Points || all_close(&base(a), &base(b)))
        && close(a.shininess, b.shininess, VALUE)
        && line(a) == line(b)
        && a.faces == b.faces
        && texture(s, a) == texture(t, b);
    (!same).then(|| format!("look {a:?} {:?}, {b:?} {:?}", texture(s, a), texture(t, b)))
}

fn lit_difference((s, a): (&Scene, &Instance), (t, b): (&Scene, &Instance)) -> Option<String> {
    // By what each light is, as their order may differ.
    let lights = |s: &Scene, i: &Instance| {
        let set = s.light_sets[i.light_set.index()].iter();
        let mut all: Vec<_> = set.map(|l| light_key(&s.lights[l.index()])).collect();
        all.sort();
        all
    };
    if lights(s, a) != lights(t, b) {
        return Some(format!("lit by {:?}, {:?}", lights(s, a), lights(t, b)));
    }
    let around = |s: &Scene, i: &Instance| environment(s, i.environment.index());
    (around(s, a) != around(t, b)).then(|| "environment".to_owned())
}

fn light_key(light: &Light) -> String {
    format!(
        "{:?} {:.4?} {:.4}",
        light.placement.name, light.color_srgb, light.intensity
    )
}

fn environment(scene: &Scene, index: usize) -> Environment {
    Environment {
        pos: Default::default(),
        ..scene.environments[index].clone()
    }
}

fn same_light((s, a): (&Scene, &Light), (t, b): (&Scene, &Light)) -> bool {
    let beam = |light: &Light| {
        let frame = light.placement.world_from_local;
        let along = |v: DVec3| frame.transform_vector3(v).normalize();
        match light.kind {
            LightKind::Directional { direction } => (DVec3::ZERO, along(direction), [0.0; 2]),
            LightKind::Point { location } => {
                (frame.transform_point3(location), DVec3::ZERO, [0.0; 2])
            }
            LightKind::Spot {
                location,
                direction,
                drop_off_rate,
                cut_off_angle_rad,
            } => (
                frame.transform_point3(location),
                along(direction),
                [drop_off_rate, cut_off_angle_rad],
            ),
        }
    };
    let ((p, v, c), (q, w, d)) = (beam(a), beam(b));
    let room = 1e-11 * (1.0 + p.length());
    let attenuation = |s: &Scene, l: &Light| match l.kind {
        LightKind::Directional { .. } => [0.0; 3],
        _ => environment(s, l.environment.index()).attenuation,
    };
    p.distance(q) <= room
        && v.distance(w) <= 1e-11
        && all_close(&c, &d)
        && all_close(&a.color_srgb, &b.color_srgb)
        && close(a.intensity, b.intensity, VALUE * (1.0 + a.intensity.abs()))
        && all_close(&attenuation(s, a), &attenuation(t, b))
        && same_name(&a.placement, &b.placement)
}

fn same_name(a: &Placement, b: &Placement) -> bool {
    a.name.as_deref().map(as_def) == b.name.as_deref().map(as_def)
}

/// A name as far as DEF can hold it.
fn as_def(name: &str) -> String {
    let letter = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
    name.chars().map(letter).collect()
}

fn same_camera(a: &Camera, b: &Camera) -> bool {
    let pose = |c: &Camera| {
        let frame = c.placement.world_from_local;
        let turned = |v| frame.transform_vector3(c.orientation * v);
        (
            frame.transform_point3(c.position),
            turned(DVec3::NEG_Z),
            turned(DVec3::Y),
        )
    };
    let ((p, v, u), (q, w, x)) = (pose(a), pose(b));
    let room = 1e-11 * (1.0 + p.length());
    let view = |c: &Camera| match c.projection {
        Projection::Perspective { height_angle_rad } => [0.0, height_angle_rad],
        Projection::Orthographic { height } => [1.0, height],
    };
    // Relative, as distances can be any.
    let numbers = |c: &Camera| {
        [
            c.near_distance,
            c.far_distance,
            c.focal_distance,
            c.aspect_ratio,
        ]
    };
    let mut near = numbers(a).into_iter().zip(numbers(b));
    p.distance(q) <= room
        && v.distance(w) <= 1e-11 * (1.0 + v.length())
        && u.distance(x) <= 1e-11 * (1.0 + u.length())
        && all_close(&view(a), &view(b))
        && near.all(|(a, b)| close(a, b, VALUE * (1.0 + a.abs())))
        && a.viewport_mapping == b.viewport_mapping
        && same_name(&a.placement, &b.placement)
}
