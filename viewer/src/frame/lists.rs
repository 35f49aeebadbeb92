//! Lists that grow while a frame is planned: draws that are joined, reasons that are counted.

use std::collections::BTreeMap;

use scenegraph::scene::{MeshId, TextureId};

use super::plan::{Draw, Pixels, Skip, SkipReason};
use crate::content::Object;
use crate::shader::ShaderKey;

/// Joins consecutive objects that one draw call can draw.
#[derive(Default)]
pub struct Draws {
    /// In the order of the objects.
    pub list: Vec<Draw>,
    last: Option<LastDraw>,
}

#[derive(PartialEq)]
struct LastDraw {
    mesh: MeshId,
    texture: Option<TextureId>,
    is_culled: bool,
    is_mirrored: bool,
}

impl Draws {
    /// Adds an object to the last draw if it can be drawn with it.
    pub fn add(&mut self, index: u32, object: &Object, shader: ShaderKey, pixels: Pixels) {
        let this = LastDraw {
            mesh: object.mesh,
            texture: object.texture,
            is_culled: object.is_culled,
            is_mirrored: object.is_mirrored,
        };
        match self.list.last_mut() {
            Some(draw)
                if draw.objects.end == index
                    && draw.shader == shader
                    && draw.pixels == pixels
                    && self.last.as_ref() == Some(&this) =>
            {
                draw.objects.end += 1;
            }
            _ => self.list.push(Draw {
                objects: index..index + 1,
                shader,
                pixels,
            }),
        }
        self.last = Some(this);
    }
}

/// How often each reason came up.
#[derive(Default)]
pub struct Counts(BTreeMap<SkipReason, usize>);

impl Counts {
    /// One more.
    pub fn add(&mut self, reason: SkipReason) {
        *self.0.entry(reason).or_default() += 1;
    }

    /// Ordered by reason.
    pub fn list(self) -> Vec<Skip> {
        self.0
            .into_iter()
            .map(|(reason, count)| Skip { reason, count })
            .collect()
    }
}
