//! Everything that a pipeline depends on.

use crate::frame::Pixels;
use crate::shader::ShaderKey;

/// The bits of the stencil that count while one keeps the result of earlier layers.
pub const LAYER_BITS: u32 = 0x7f;
/// The one that keeps it.
pub const LAYER_FLAG: u32 = 0x80;

/// How a surface shader is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Stage {
    /// Nearest wins, depth is written and nothing else.
    Depth,
    /// Nearest wins, depth is written.
    First,
    /// Replaces what is there where the depth is equal.
    FirstAtDepth,
    /// Added where the depth is equal, once for each pixel.
    Add,
    /// Blended over what is there.
    Blend,
}

/// Which faces are left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Cull {
    /// None.
    None,
    /// Back faces.
    Back,
    /// Front faces.
    Front,
}

/// A part of shadow volumes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum VolumePart {
    /// Sides counted in front of the scene.
    ZPassSides,
    /// Sides counted behind it.
    ZFailSides,
    /// Triangles that face the light, or away from it, counted in front of the scene.
    ZPassLightCap {
        /// They face it.
        is_pos: bool,
    },
    /// The same, counted behind it.
    LightCap {
        /// They face it.
        is_pos: bool,
    },
    /// At infinity.
    DarkCap {
        /// They face it.
        is_pos: bool,
    },
}

/// What is drawn over the picture in a colour of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FlatKind {
    /// Triangles that are seen.
    Tint,
    /// Triangles behind others.
    TintBehind,
    /// The edges of triangles.
    Wire,
    /// The corners of triangles.
    Point,
    /// Segments of a list.
    Segment,
    /// Triangles of a list, which hide what is behind them.
    Cap,
}

/// Everything a pipeline depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PipelineKey {
    /// Draws objects.
    Surface {
        /// By this shader.
        shader: ShaderKey,
        /// In this stage.
        stage: Stage,
        /// On these pixels.
        pixels: Pixels,
        /// Without these faces.
        cull: Cull,
        /// Front is clockwise.
        is_mirrored: bool,
        /// Samples a pixel.
        samples: u32,
    },
    /// Counts shadow volumes.
    Volume {
        /// This part.
        part: VolumePart,
        /// The near plane cuts nothing.
        is_unclipped: bool,
        /// Counts in seven bits; the eighth keeps what the layers before found.
        is_layered: bool,
        /// Samples a pixel.
        samples: u32,
    },
    /// Ends a layer of volumes: where the seven bits are not zero the eighth is set, and they
    /// become zero.
    EndLayer {
        /// Samples a pixel.
        samples: u32,
    },
    /// Begins a layer: the seven bits become the reference.
    BeginLayer {
        /// Samples a pixel.
        samples: u32,
    },
    /// Draws depth as a light sees it.
    Map,
    /// Draws over the picture.
    Flat {
        /// What.
        kind: FlatKind,
        /// Samples a pixel.
        samples: u32,
    },
    /// Draws the sides of shadow volumes for the eye.
    ShownVolume {
        /// This part.
        part: VolumePart,
        /// Samples a pixel.
        samples: u32,
    },
    /// Draws the gradient.
    Background {
        /// Samples a pixel.
        samples: u32,
    },
    /// Turns summed light into the image.
    Present {
        /// Samples a pixel of the light.
        samples: u32,
    },
}
