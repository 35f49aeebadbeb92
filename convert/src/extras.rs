//! `extras.iv`: Inventor's own values, which glTF has no place for. Names are those of Inventor's
//! fields; a value equal to Inventor's default is left out.

use std::f64::consts::FRAC_PI_4;

use scenegraph::scene::{
    Camera, Environment, Faces, Fog, FogType, Light, LightId, LightKind, LightModel, Link,
    Material, Scene, Text, Texture, TextureModel, TextureSource, ViewportMapping,
};

use crate::alternatives::Limits;
use crate::json::Json;
use crate::{Options, Up};

/// Half a unit in the last of the six digits that Inventor's documents give for defaults.
const DEFAULT_TOLERANCE: f64 = 5e-7;

/// Version of the names and meanings in `extras.iv`.
const VERSION: u64 = 1;

fn iv(json: &mut Json, body: impl FnOnce(&mut Json)) {
    json.object_unless_empty("extras", |json| json.object_unless_empty("iv", body));
}

fn number(json: &mut Json, key: &str, value: f64, default: f64) {
    if (value - default).abs() > DEFAULT_TOLERANCE {
        json.key(key).field(value);
    }
}

/// An index into a list in the scene's extras.
fn index(json: &mut Json, key: &str, index: u32) {
    if index != 0 {
        json.key(key).u64(index.into());
    }
}

fn numbers(json: &mut Json, key: &str, values: [f64; 3], default: [f64; 3]) {
    if values
        .iter()
        .zip(default)
        .any(|(v, d)| (v - d).abs() > DEFAULT_TOLERANCE)
    {
        json.key(key).fields(&values);
    }
}

pub(crate) fn material(json: &mut Json, material: &Material) {
    iv(json, |json| {
        numbers(json, "ambientColor", material.ambient_srgb, [0.2; 3]);
        numbers(json, "diffuseColor", material.diffuse_srgb, [0.8; 3]);
        numbers(json, "specularColor", material.specular_srgb, [0.0; 3]);
        numbers(json, "emissiveColor", material.emissive_srgb, [0.0; 3]);
        number(json, "shininess", material.shininess, 0.2);
        number(json, "transparency", material.transparency, 0.0);
        if material.light_model == LightModel::BaseColor {
            json.key("lightModel").str("BASE_COLOR");
        }
        if material.faces != Faces::BothOneSidedLighting {
            json.key("vertexOrdering").str("COUNTERCLOCKWISE");
        }
        if material.faces == Faces::FrontOnly {
            json.key("shapeType").str("SOLID");
        }
        number(json, "lineWidth", material.line_width_px, 0.0);
        number(json, "pointSize", material.point_size_px, 0.0);
        if material.line_pattern != 0xffff {
            json.key("linePattern").u64(material.line_pattern.into());
        }
    });
}

pub(crate) fn texture(json: &mut Json, texture: &Texture) {
    iv(json, |json| {
        match &texture.source {
            TextureSource::File { name, .. }
            | TextureSource::Encoded {
                name: Some(name), ..
            } => json.key("filename").str(name),
            TextureSource::Encoded { name: None, .. } | TextureSource::Inline(_) => {}
        }
        let model = match texture.model {
            TextureModel::Modulate => None,
            TextureModel::Decal => Some("DECAL"),
            TextureModel::Blend => Some("BLEND"),
            TextureModel::Replace => Some("REPLACE"),
        };
        if let Some(model) = model {
            json.key("model").str(model);
        }
        numbers(json, "blendColor", texture.blend_color_srgb, [0.0; 3]);
    });
}

/// Says that values which are left out equal Inventor's defaults, whether the model was turned, and
/// what was made of materials and lights, so that edits of them can be seen.
/// A source stands here if there is no scene to hold it.
pub(crate) fn asset(json: &mut Json, options: &Options, source: Option<&str>) {
    let usual = Options::default();
    iv(json, |json| {
        json.key("version").u64(VERSION);
        if options.up == Up::Z {
            json.key("up").str("Y");
        }
        if options.materials != usual.materials {
            json.key("materials").str(options.materials.word());
        }
        if options.lights != usual.lights {
            json.key("lights").str(options.lights.word());
        }
        write_source(json, source);
    });
}

fn write_source(json: &mut Json, source: Option<&str>) {
    if let Some(source) = source {
        json.key("source").raw(source);
    }
}

/// `number_in_sets` is that by which the scene's light sets call it, `reference_distance` where a light
/// that has a place is as bright as Inventor's.
pub(crate) fn light(
    json: &mut Json,
    light: &Light,
    environment: &Environment,
    number_in_sets: Option<usize>,
    reference_distance: Option<f64>,
) {
    iv(json, |json| {
        if let Some(number) = number_in_sets {
            json.key("number").usize(number);
        }
        if let Some(distance) = reference_distance {
            json.key("referenceDistance").f64(distance);
        }
        number(json, "intensity", light.intensity, 1.0);
        numbers(json, "color", light.color_srgb, [1.0; 3]);
        if !matches!(light.kind, LightKind::Directional { .. }) {
            numbers(
                json,
                "attenuation",
                environment.attenuation,
                [0.0, 0.0, 1.0],
            );
        }
        if let LightKind::Spot {
            drop_off_rate,
            cut_off_angle_rad,
            ..
        } = light.kind
        {
            number(json, "dropOffRate", drop_off_rate, 0.0);
            number(json, "cutOffAngle", cut_off_angle_rad, FRAC_PI_4);
            if let Some(beam) = light.beam {
                json.key("beamWidthAngle").field(beam.inner_angle_rad);
                json.key("concentrationExponent").field(beam.exponent);
            }
        }
        index(json, "environment", light.environment.0);
    });
}

/// `unit_length` is that of the camera's unit in the frame of its glTF node: distances are in it.
/// `made_far` is a far plane that is none of Inventor's, but made of the scene's bounds.
pub(crate) fn camera(json: &mut Json, camera: &Camera, unit_length: f64, made_far: Option<f64>) {
    iv(json, |json| {
        if let Some(far) = made_far {
            json.key("zfar").f64(far);
        }
        number(json, "unitLength", unit_length, 1.0);
        number(json, "aspectRatio", camera.aspect_ratio, 1.0);
        number(json, "nearDistance", camera.near_distance, 1.0);
        number(json, "farDistance", camera.far_distance, 10.0);
        number(json, "focalDistance", camera.focal_distance, 5.0);
        match camera.viewport_mapping {
            ViewportMapping::AdjustCamera => {}
            ViewportMapping::CropViewport => {
                json.key("viewportMapping").str("CROP_VIEWPORT_FILL_FRAME")
            }
            ViewportMapping::LeaveAlone => json.key("viewportMapping").str("LEAVE_ALONE"),
        }
    });
}

/// Classes that say no more than that there is a node, and where.
fn is_plain_group(class: &str) -> bool {
    matches!(class, "Separator" | "Group" | "VRMLGroup" | "VRMLTransform")
}

/// The class of a node when it says something.
pub(crate) fn notable_class(class: &str) -> Option<&str> {
    (!is_plain_group(class)).then_some(class)
}

/// What surrounds a shape, by index in the lists of the scene's extras.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub(crate) struct Scope {
    pub(crate) light_set: u32,
    pub(crate) environment: u32,
}

/// What Inventor says of a node beside its notes.
pub(crate) struct Said<'a> {
    pub(crate) class: Option<&'a str>,
    pub(crate) link: Option<&'a Link>,
    pub(crate) text: Option<&'a Text>,
    pub(crate) scope: Scope,
}

pub(crate) fn node<'a>(
    json: &mut Json,
    notes: impl IntoIterator<Item = &'a str>,
    said: &Said<'_>,
    limits: &Limits,
) {
    let Said {
        class,
        link,
        text,
        scope,
    } = *said;
    let body = |json: &mut Json| {
        if let Some(class) = class {
            json.key("type").str(class);
        }
        json.array_unless_empty("notes", notes, |json, note| json.str(note));
        if let Some(link) = link {
            write_link(json, link);
        }
        if let Some(text) = text {
            json.array_unless_empty("string", &text.strings, |json, line| json.str(line));
            if text.faces_viewer {
                json.key("facesViewer").bool(true);
            }
        }
        limits.write_fields(json);
        index(json, "lightSet", scope.light_set);
        index(json, "environment", scope.environment);
    };
    json.object_unless_empty("extras", |json| {
        limits.write_coverage(json);
        json.object_unless_empty("iv", body);
    });
}

/// Whether there are other light sets than one of all lights.
pub(crate) fn has_light_sets(scene: &Scene) -> bool {
    let all = (0..scene.lights.len() as u32).map(LightId);
    match scene.light_sets.as_slice() {
        [only] => !only.iter().copied().eq(all),
        _ => true,
    }
}

pub(crate) fn scene(json: &mut Json, scene: &Scene, source: Option<&str>) {
    let default = Environment::default();
    iv(json, |json| {
        write_source(json, source);
        let plain = |e: &Environment| Environment {
            pos: default.pos,
            ..e.clone()
        };
        // All or none, so that each keeps its place in the list.
        let notable = scene.environments.iter().any(|e| plain(e) != default);
        let environments = scene.environments.iter().filter(|_| notable);
        json.array_unless_empty("environments", environments, |json, environment| {
            json.object(|json| {
                number(json, "ambientIntensity", environment.ambient_intensity, 0.2);
                numbers(
                    json,
                    "ambientColor",
                    environment.ambient_color_srgb,
                    [1.0; 3],
                );
                numbers(
                    json,
                    "attenuation",
                    environment.attenuation,
                    [0.0, 0.0, 1.0],
                );
                if let Some(fog) = &environment.fog {
                    write_fog(json, fog);
                }
            });
        });
        let scoped = has_light_sets(scene);
        let light_sets = scene.light_sets.iter().filter(|_| scoped);
        json.array_unless_empty("lightSets", light_sets, |json, set| {
            json.array(|json| set.iter().for_each(|light| json.u64(light.0.into())));
        });
    });
}

fn write_link(json: &mut Json, link: &Link) {
    json.key("link").object(|json| {
        json.array_unless_empty("url", &link.urls, |json, url| json.str(url));
        if !link.description.is_empty() {
            json.key("description").str(&link.description);
        }
        json.array_unless_empty("parameter", &link.parameters, |json, p| json.str(p));
        if link.tells_point {
            json.key("map").str("POINT");
        }
    });
}

fn write_fog(json: &mut Json, fog: &Fog) {
    json.key("fogType").str(match fog.fog_type {
        FogType::Haze => "HAZE",
        FogType::Fog => "FOG",
        FogType::Smoke => "SMOKE",
    });
    numbers(json, "fogColor", fog.color_srgb, [1.0; 3]);
    number(json, "fogVisibility", fog.visibility, 0.0);
}
