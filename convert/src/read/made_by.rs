//! What a file was made by. By that it is seen whether a value was edited since: Inventor's own value
//! in the extras is worth what the writer makes of it, and where the file says something else, the
//! file is right.

use gltf::json::Extras;

use super::iv::Iv;
use crate::{Lights, Materials};

/// The writer of a file, and the choices that its values depend on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MadeBy {
    /// Values of Inventor's that are not there are defaults.
    pub(crate) ivory: bool,
    /// Up was made +Y.
    pub(crate) turned: bool,
    pub(crate) materials: Materials,
    pub(crate) lights: Lights,
}

impl MadeBy {
    pub(crate) const OTHERS: Self = Self {
        ivory: false,
        turned: false,
        materials: Materials::Fidelity,
        lights: Lights::Unitless,
    };

    /// By what a file's asset says.
    pub(crate) fn of(asset: &Extras) -> Self {
        let Some(iv) = Iv::of(asset) else {
            return Self::OTHERS;
        };
        Self {
            ivory: true,
            turned: iv.word("up") == Some("Y"),
            materials: (Materials::ALL.into_iter())
                .find(|m| iv.word("materials") == Some(m.word()))
                .unwrap_or(Self::OTHERS.materials),
            lights: (Lights::ALL.into_iter())
                .find(|l| iv.word("lights") == Some(l.word()))
                .unwrap_or(Self::OTHERS.lights),
        }
    }

    /// Inventor's own values of an object; `None` if only glTF's are known.
    pub(crate) fn values(self, extras: &Extras) -> Option<Iv> {
        Iv::of(extras).or_else(|| self.ivory.then(Iv::default))
    }
}
