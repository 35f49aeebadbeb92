//! Lexolights' photorealism hints: how the edge of a spot light's cone fades. They stand in the
//! string of an `Info` right before the light in its group, as pairs of a key and a value among
//! other words.

use crate::scene::Beam;

/// The hints for a spot light; `None` if there are none. Without its own the inner cone is half the
/// outer one, and the exponent is 1.
pub fn beam(text: &str, cut_off_angle_rad: f64) -> Option<Beam> {
    let value = |key: &str| {
        let mut words = text.split_whitespace();
        words.find(|word| *word == key)?;
        let word = words.next()?.trim_matches('"');
        let starts = word.starts_with(|c: char| c.is_ascii_digit() || c == '.');
        let number: f64 = word.parse().ok()?;
        (starts && number.is_finite()).then_some(number)
    };
    let angle_rad = value("LightSource.beamWidthAngle");
    let exponent = value("LightSource.concentrationExponent");
    (angle_rad.is_some() || exponent.is_some()).then(|| Beam {
        inner_angle_rad: angle_rad
            .unwrap_or(cut_off_angle_rad / 2.0)
            .min(cut_off_angle_rad),
        exponent: exponent.unwrap_or(1.0),
    })
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    #[test]
    fn hints_are_pairs_among_words() {
        let both = |inner_angle_rad, exponent| {
            Some(Beam {
                inner_angle_rad,
                exponent,
            })
        };
        let rows = [
            ("", None),
            ("a lamp over the door", None),
            ("LightSource.beamWidthAngle 0.3", both(0.3, 1.0)),
            ("LightSource.concentrationExponent 2.5", both(0.4, 2.5)),
            (
                "model \"x\" LightSource.beamWidthAngle .2 LightSource.concentrationExponent \"3\"",
                both(0.2, 3.0),
            ),
            ("LightSource.beamWidthAngle 1.5", both(0.8, 1.0)),
            ("LightSource.beamWidthAngle", None),
            ("LightSource.beamWidthAngle wide", None),
            ("LightSource.beamWidthAngle -1", None),
            ("LightSource.beamWidthAngle 1e999", None),
        ];
        for (text, wanted) in rows {
            assert_eq!(beam(text, 0.8), wanted, "{text}");
        }
    }
    #[test]
    fn hints_stand_right_before_their_light() {
        let info = "Info { string \"LightSource.beamWidthAngle 0.25\" }";
        let spot = "SpotLight { cutOffAngle 0.5 }";
        let rows = [
            (format!("{info} {spot}"), true),
            (format!("Group {{ {info} {spot} }}"), true),
            (format!("{info} Separator {{ {info} }} {spot}"), false),
            (format!("{info} Translation {{ }} {spot}"), false),
            (format!("{spot} {info}"), false),
            (format!("{info} Group {{ {spot} }}"), false),
            (format!("{info} PointLight {{ }}"), false),
        ];
        for (body, wanted) in rows {
            let text = format!("#Inventor V2.1 ascii\nSeparator {{ {body} Cube {{ }} }}");
            let loader = crate::FileLoader::new([]);
            let graph = crate::load(text.as_bytes(), "t.iv", Path::new(""), &loader);
            let scene = crate::resolve(&graph, &crate::ResolveOptions::default()).scene;
            let beam = scene.lights[0].beam;
            let angle = beam.map(|b| b.inner_angle_rad);
            assert_eq!(angle, wanted.then_some(0.25), "{body}");
        }
    }
}
