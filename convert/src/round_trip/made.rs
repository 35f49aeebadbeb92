//! The choices that a file was made with, as far as they shape it, kept beside the source so that it
//! can be made again.

use scenegraph::ResolveOptions;
use serde_json::{Value, json};

use crate::options::{Lights, Materials, TextureFormat, Up};
use crate::{Options, Quantize, Weld};

/// As JSON; null if all is as usual.
pub(crate) fn to_value(options: &Options, resolve: &ResolveOptions) -> Value {
    let mut value = Value::Null;
    if let Some(chord) = resolve.chord {
        value["chord"] = chord.into();
    }
    if resolve.alternatives {
        value["alternatives"] = true.into();
    }
    let usual = Options::default();
    for (key, word, usual) in [
        ("up", up_word(options.up), up_word(usual.up)),
        (
            "materials",
            options.materials.word(),
            usual.materials.word(),
        ),
        ("lights", options.lights.word(), usual.lights.word()),
        (
            "textures",
            textures_word(options.textures),
            textures_word(usual.textures),
        ),
    ] {
        if word != usual {
            value[key] = word.into();
        }
    }
    if options.metres_per_unit != usual.metres_per_unit {
        value["metresPerUnit"] = options.metres_per_unit.into();
    }
    if options.weld == Weld::Apart {
        value["weld"] = false.into();
    }
    if options.instancing {
        value["instancing"] = true.into();
    }
    if options.optimize {
        value["optimize"] = true.into();
    }
    if options.compress {
        value["compress"] = true.into();
    }
    if let Some(quantize) = options.quantize {
        value["quantize"] = json!([quantize.tolerance, quantize.normal_tolerance_rad]);
    }
    value
}

fn up_word(up: Up) -> &'static str {
    match up {
        Up::Y => "y",
        Up::Z => "z",
    }
}

fn textures_word(textures: TextureFormat) -> &'static str {
    match textures {
        TextureFormat::Keep => "keep",
        TextureFormat::Png => "png",
        TextureFormat::Webp => "webp",
    }
}

/// The one of `all` that a word stands for, or the usual one.
fn one<T: Copy>(value: &Value, all: &[T], word: fn(T) -> &'static str, usual: T) -> T {
    let said = value.as_str();
    let found = all.iter().find(|one| said == Some(word(**one)));
    found.copied().unwrap_or(usual)
}

/// From JSON; what is not there is as usual.
pub(crate) fn from_value(value: &Value) -> (Options, ResolveOptions) {
    let is = |key: &str, default: bool| value[key].as_bool().unwrap_or(default);
    let number = |value: &Value| value.as_f64().filter(|v| v.is_finite() && *v > 0.0);
    let quantize = number(&value["quantize"][0]).zip(number(&value["quantize"][1]));
    let usual = Options::default();
    let options = Options {
        up: one(&value["up"], &[Up::Y, Up::Z], up_word, usual.up),
        materials: one(
            &value["materials"],
            &Materials::ALL,
            Materials::word,
            usual.materials,
        ),
        lights: one(&value["lights"], &Lights::ALL, Lights::word, usual.lights),
        textures: one(
            &value["textures"],
            &[TextureFormat::Keep, TextureFormat::Png, TextureFormat::Webp],
            textures_word,
            usual.textures,
        ),
        metres_per_unit: number(&value["metresPerUnit"]).unwrap_or(usual.metres_per_unit),
        instancing: is("instancing", false),
        weld: if is("weld", true) {
            Weld::Shared
        } else {
            Weld::Apart
        },
        optimize: is("optimize", false),
        compress: is("compress", false),
        quantize: quantize.map(|(tolerance, normal_tolerance_rad)| Quantize {
            tolerance,
            normal_tolerance_rad,
        }),
        ..usual
    };
    let resolve = ResolveOptions {
        chord: number(&value["chord"]),
        alternatives: is("alternatives", false),
        ..ResolveOptions::default()
    };
    (options, resolve)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn choices_come_back() {
        let usual = (Options::default(), ResolveOptions::default());
        let mut unusual = usual.clone();
        unusual.0.weld = Weld::Apart;
        unusual.0.up = Up::Z;
        unusual.0.materials = Materials::Unlit;
        unusual.0.lights = Lights::Physical;
        unusual.0.textures = TextureFormat::Webp;
        unusual.0.metres_per_unit = 0.001;
        unusual.0.instancing = true;
        unusual.0.optimize = true;
        unusual.0.compress = true;
        unusual.0.quantize = Some(Quantize::within(1e-3));
        unusual.1.chord = Some(0.1);
        unusual.1.alternatives = true;
        for (options, resolve) in [usual, unusual] {
            let text = to_value(&options, &resolve).to_string();
            let value: Value = serde_json::from_str(&text).unwrap();
            let (options_back, resolve_back) = from_value(&value);
            assert_eq!(options_back, options);
            assert_eq!(resolve_back.chord, resolve.chord);
            assert_eq!(resolve_back.alternatives, resolve.alternatives);
        }
    }
}
