//! The choices that a file was made with, as far as they shape it, kept beside the source so that it
//! can be made again.

use scenegraph::ResolveOptions;
use serde_json::{Value, json};

use crate::{Options, Quantize, Weld};

/// As JSON; null if all is as usual.
pub(crate) fn to_value(options: &Options, resolve: &ResolveOptions) -> Value {
    let mut value = Value::Null;
    if let Some(chord) = resolve.chord {
        value["chord"] = chord.into();
    }
    if options.weld == Weld::Apart {
        value["weld"] = false.into();
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

/// From JSON; what is not there is as usual.
pub(crate) fn from_value(value: &Value) -> (Options, ResolveOptions) {
    let is = |key: &str, default: bool| value[key].as_bool().unwrap_or(default);
    let number = |value: &Value| value.as_f64().filter(|v| v.is_finite() && *v > 0.0);
    let quantize = number(&value["quantize"][0]).zip(number(&value["quantize"][1]));
    let options = Options {
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
        ..Options::default()
    };
    let resolve = ResolveOptions {
        chord: number(&value["chord"]),
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
        unusual.0.optimize = true;
        unusual.0.compress = true;
        unusual.0.quantize = Some(Quantize::within(1e-3));
        unusual.1.chord = Some(0.1);
        for (options, resolve) in [usual, unusual] {
            let text = to_value(&options, &resolve).to_string();
            let value: Value = serde_json::from_str(&text).unwrap();
            let (options_back, resolve_back) = from_value(&value);
            assert_eq!(options_back, options);
            assert_eq!(resolve_back.chord, resolve.chord);
        }
    }
}
