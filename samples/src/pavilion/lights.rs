//! Cameras, the sun, the lamps and the fixtures that hold them.
//!
//! A lamp's light stands just outside its bulb or housing, so that its own fixture does not take
//! all its light when shadows are drawn.

use super::origin_transform;
use crate::iv_writer::{IvWriter, angle, num, vec3};

/// Where the pendants hang: the bulb's centre.
const PENDANTS: [(&str, [f64; 3]); 3] = [
    ("Lamp_TableWest", [10.8, 3.4, 1.75]),
    ("Lamp_TableEast", [10.8, 4.7, 1.75]),
    ("Lamp_Salon", [2.3, 4.3, 1.85]),
];
/// Light below the bulb's centre; the bulb's radius is 45 mm.
const BELOW_BULB: f64 = 0.07;
/// Underside of what the pendants hang from.
const CEILING: f64 = 2.83;

struct Spot {
    name: &'static str,
    location: [f64; 3],
    direction: [f64; 3],
    cut_off_rad: f64,
    intensity: f64,
    info: Option<&'static str>,
}

const SPOTS: [Spot; 3] = [
    Spot {
        name: "Spot_Stairs",
        location: [6.75, -0.02, 2.66],
        direction: [0.0, -0.25, -1.0],
        cut_off_rad: 0.7,
        intensity: 1.0,
        info: None,
    },
    Spot {
        name: "Spot_Kitchen",
        location: [6.7, 4.9, 2.66],
        direction: [0.0, 0.3, -1.0],
        cut_off_rad: 0.9,
        intensity: 0.9,
        info: None,
    },
    Spot {
        name: "Spot_Garden",
        location: [15.9, 1.2, -0.42],
        direction: [-1.0, 0.35, 0.95],
        cut_off_rad: 0.55,
        intensity: 1.0,
        info: Some("LightSource.beamWidthAngle 0.3 LightSource.concentrationExponent 1.5"),
    },
];

/// The view of the picture in the README, and a plan view; the switch picks the first.
pub(super) fn cameras(w: &mut IvWriter) {
    w.line("# The matrix ends with the TransformSeparator, the camera goes on.");
    w.node("TransformSeparator", |w| {
        origin_transform(w);
        w.node("DEF Cameras Switch", |w| {
            w.line("whichChild 0");
            let (eye, target) = ([22.4, -14.2, 4.1], [7.3, 3.0, 1.5]);
            w.node("DEF View_Garden PerspectiveCamera", |w| {
                w.line(&format!("position {}", vec3(eye)));
                w.line(&format!("orientation {}", look_at(eye, target)));
                w.line("aspectRatio 1.5");
                w.line("nearDistance 0.5");
                w.line("farDistance 120");
                w.line("focalDistance 23");
                w.line("heightAngle 0.5");
            });
            w.node("DEF View_Plan OrthographicCamera", |w| {
                w.line("position 6.75 4.05 40");
                w.line("aspectRatio 1.5");
                w.line("nearDistance 1");
                w.line("farDistance 60");
                w.line("focalDistance 40");
                w.line("height 22");
            });
        });
    });
}

/// Axis and angle that turn -Z toward the target with +Z of the world up.
fn look_at(eye: [f64; 3], target: [f64; 3]) -> String {
    let forward = [0, 1, 2].map(|i| target[i] - eye[i]);
    // Turn about the world's +Z by the heading, after tilting up from looking straight down.
    let level = forward[0].hypot(forward[1]);
    let half_heading = -forward[0].atan2(forward[1]) / 2.0;
    let half_tilt = (forward[2].atan2(level) + std::f64::consts::FRAC_PI_2) / 2.0;
    let (sin_h, cos_h) = half_heading.sin_cos();
    let (sin_t, cos_t) = half_tilt.sin_cos();
    let axis = [cos_h * sin_t, sin_h * sin_t, sin_h * cos_t];
    let length = axis.iter().map(|c| c * c).sum::<f64>().sqrt();
    let angle_rad = 2.0 * length.atan2(cos_h * cos_t);
    let unit = axis.map(|c| angle(c / length)).join(" ");
    format!("{unit} {}", angle(angle_rad))
}

/// All lights, before anything they shine on. The sun is low in the south-west.
pub(super) fn lights(w: &mut IvWriter) {
    w.node("DEF Lights Group", |w| {
        w.line("# Attenuation (quadratic, linear, constant) counts for the lamps only.");
        w.node("Environment", |w| {
            w.line("ambientIntensity 0.9");
            w.line("ambientColor 0.82 0.9 1");
            w.line("attenuation 0.35 0.1 1");
        });
        w.node("DEF Sun DirectionalLight", |w| {
            w.line("intensity 0.9");
            w.line("color 1 0.93 0.8");
            w.line("direction 0.58 0.64 -0.42");
        });
        for (name, bulb) in PENDANTS {
            w.node(&format!("DEF {name} PointLight"), |w| {
                w.line("intensity 0.8");
                w.line("color 1 0.82 0.55");
                w.line(&format!(
                    "location {}",
                    vec3([bulb[0], bulb[1], bulb[2] - BELOW_BULB])
                ));
            });
        }
        for spot in &SPOTS {
            if let Some(info) = spot.info {
                w.line(&format!("Info {{ string \"{info}\" }}"));
            }
            w.node(&format!("DEF {} SpotLight", spot.name), |w| {
                w.line(&format!("intensity {}", num(spot.intensity)));
                w.line("color 1 0.9 0.7");
                w.line(&format!("location {}", vec3(spot.location)));
                w.line(&format!("direction {}", vec3(spot.direction)));
                w.line("dropOffRate 0.02");
                w.line(&format!("cutOffAngle {}", num(spot.cut_off_rad)));
            });
        }
    });
}

/// Pendant and downlight, each with the light's place at the origin of its bulb or rim.
pub(super) fn parts(w: &mut IvWriter) {
    w.node("DEF Pendant Separator", |w| {
        w.line("USE LampGlow");
        w.line("Sphere { radius 0.045 }");
        w.line("USE BlackIron");
        w.upright_cylinder([0.0, 0.0, 0.045], 0.018, 0.07);
        // The shade is a sheet: seen from inside and outside.
        w.node("Separator", |w| {
            w.line("ShapeHints { vertexOrdering COUNTERCLOCKWISE  shapeType UNKNOWN_SHAPE_TYPE }");
            w.upright_frame([0.0, 0.0, 0.05]);
            w.line("Cone { parts SIDES  bottomRadius 0.19  height 0.16 }");
        });
    });
    w.node("DEF Downlight Separator", |w| {
        w.line("USE Steel");
        w.upright_cylinder([0.0, 0.0, 0.015], 0.045, 0.05);
    });
    w.node("DEF GardenSpot Separator", |w| {
        w.line("USE BlackIron");
        w.upright_cylinder([0.0, 0.0, -0.3], 0.06, 0.26);
    });
}

/// The fixtures at the lights' places.
pub(super) fn fixtures(w: &mut IvWriter) {
    w.node("DEF Fixtures Separator", |w| {
        for (_, bulb) in PENDANTS {
            w.placed(bulb, 0.0, |w| w.line("USE Pendant"));
            w.node("Separator", |w| {
                w.line("USE BlackIron");
                let foot = [bulb[0], bulb[1], bulb[2] + 0.115];
                w.upright_cylinder(foot, 0.003, CEILING - foot[2]);
            });
        }
        for spot in &SPOTS {
            let part = if spot.direction[2] < 0.0 {
                "Downlight"
            } else {
                "GardenSpot"
            };
            w.placed(spot.location, 0.0, |w| w.line(&format!("USE {part}")));
        }
    });
}
