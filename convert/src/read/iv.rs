//! `extras.iv` read back: Inventor's own values under the names of Inventor's fields. What the
//! writer left out equals Inventor's default.

use std::f64::consts::PI;
use std::sync::Arc;

use gltf::json::Extras;
use scenegraph::scene::{Beam, Environment, Fog, FogType, Link};
use serde_json::{Map, Value};

/// The values of one object.
#[derive(Clone, Debug, Default)]
pub(crate) struct Iv(Map<String, Value>);

impl Iv {
    /// What an object's extras say; `None` when nothing in them is Inventor's.
    pub(crate) fn of(extras: &Extras) -> Option<Self> {
        let all: Value = serde_json::from_str(extras.as_ref()?.get()).ok()?;
        match all {
            Value::Object(mut all) => match all.remove("iv")? {
                Value::Object(iv) => Some(Self(iv)),
                _ => None,
            },
            _ => None,
        }
    }

    /// A value of any kind.
    pub(crate) fn value(&self, key: &str) -> Option<&Value> {
        self.0.get(key)
    }

    pub(crate) fn number(&self, key: &str, default: f64) -> f64 {
        self.0.get(key).and_then(Value::as_f64).unwrap_or(default)
    }

    pub(crate) fn triple(&self, key: &str, default: [f64; 3]) -> [f64; 3] {
        let list = self.0.get(key).and_then(Value::as_array);
        let triple = list.and_then(|list| match list.as_slice() {
            [x, y, z] => Some([x.as_f64()?, y.as_f64()?, z.as_f64()?]),
            _ => None,
        });
        triple.unwrap_or(default)
    }

    pub(crate) fn word(&self, key: &str) -> Option<&str> {
        self.0.get(key)?.as_str()
    }

    pub(crate) fn flag(&self, key: &str) -> bool {
        self.0.get(key).and_then(Value::as_bool).unwrap_or(false)
    }

    pub(crate) fn index(&self, key: &str) -> Option<usize> {
        self.0.get(key)?.as_u64()?.try_into().ok()
    }

    /// The members of a list; none if there is no such list.
    pub(crate) fn list(&self, key: &str) -> &[Value] {
        let list = self.0.get(key).and_then(Value::as_array);
        list.map_or(&[], Vec::as_slice)
    }

    /// The objects of a list, others left out.
    pub(crate) fn objects(&self, key: &str) -> impl Iterator<Item = Self> {
        let objects = self.list(key).iter().filter_map(Value::as_object);
        objects.map(|object| Self(object.clone()))
    }

    /// Texts of a list, others left out.
    fn texts(&self, key: &str) -> Vec<Arc<str>> {
        let texts = self.list(key).iter().filter_map(Value::as_str);
        texts.map(Into::into).collect()
    }

    /// Where a node leads, if anywhere.
    pub(crate) fn link(&self) -> Option<Link> {
        let link = Self(self.0.get("link")?.as_object()?.clone());
        let urls = link.texts("url");
        (!urls.is_empty()).then(|| Link {
            urls,
            description: link.word("description").unwrap_or_default().into(),
            parameters: link.texts("parameter"),
            tells_point: link.word("map") == Some("POINT"),
        })
    }

    /// The values as those of a spot light's beam, if they are.
    pub(crate) fn beam(&self) -> Option<Beam> {
        self.0.get("beamWidthAngle")?;
        Some(Beam {
            inner_angle_rad: self.number("beamWidthAngle", 0.0).clamp(0.0, PI),
            exponent: self.number("concentrationExponent", 1.0).max(0.0),
        })
    }

    /// The values as those of an `Environment`.
    pub(crate) fn environment(&self) -> Environment {
        let default = Environment::default();
        let fog_type = self.word("fogType").and_then(|word| match word {
            "HAZE" => Some(FogType::Haze),
            "FOG" => Some(FogType::Fog),
            "SMOKE" => Some(FogType::Smoke),
            _ => None,
        });
        Environment {
            ambient_intensity: self.number("ambientIntensity", default.ambient_intensity),
            ambient_color_srgb: self.triple("ambientColor", default.ambient_color_srgb),
            attenuation: self.triple("attenuation", default.attenuation),
            fog: fog_type.map(|fog_type| Fog {
                fog_type,
                color_srgb: self.triple("fogColor", [1.0; 3]),
                visibility: self.number("fogVisibility", 0.0),
            }),
            pos: default.pos,
        }
    }
}
