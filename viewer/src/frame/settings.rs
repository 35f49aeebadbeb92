//! What a user may choose about a frame.

use glam::DVec4;

use crate::overlay::Overlay;

/// How the edges of shadow volumes are found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum VolumeMethod {
    /// Silhouettes, by facings that are decided once for each triangle.
    Silhouette,
    /// Silhouettes, by the multiplicity of each edge against a reference edge of each triangle
    /// (the report of 2012, section 3.4).
    ReferenceEdge,
    /// A volume for every triangle.
    PerTriangle,
}

/// Where shadow volumes are computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Extraction {
    /// On the CPU for software adapters, else by compute shaders.
    Auto,
    /// On the CPU.
    Cpu,
    /// By compute shaders.
    Compute,
}

/// How shadows are made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Shadows {
    /// Not at all.
    None,
    /// Stencil shadow volumes.
    Volumes {
        /// How their edges are found.
        method: VolumeMethod,
        /// Where.
        extraction: Extraction,
    },
    /// A depth map of the light's view; a cube of them for lights that shine all ways.
    Map {
        /// Width and height of a map, texels.
        size: u32,
    },
    /// Rays through a hierarchy of boxes, in a compute shader.
    Rays,
}

impl Default for Shadows {
    fn default() -> Self {
        Self::Volumes {
            method: VolumeMethod::Silhouette,
            extraction: Extraction::Auto,
        }
    }
}

/// When a light shines that is bound to the eye.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Headlight {
    /// Never.
    Off,
    /// When the scene has no light of its own.
    #[default]
    WhenAlone,
    /// Always.
    On,
}

/// Whether objects are left out that lie behind others. The picture is the same.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Occlusion {
    /// Where it pays.
    #[default]
    Auto,
    /// Never.
    Off,
    /// In every picture.
    On,
}

/// What a user may choose about a frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// How shadows are made.
    pub shadows: Shadows,
    /// Samples a pixel: 1 or 4.
    pub samples: u32,
    /// Colours behind everything, top and bottom; display-referred.
    pub background_srgb: [[f64; 3]; 2],
    /// When a light shines that is bound to the eye.
    pub headlight: Headlight,
    /// Draw volumes by z-pass where that is proven safe; else by z-fail always.
    pub allows_z_pass: bool,
    /// `n . p + d > 0` is cut away, with n of unit length; what is cut away still throws its
    /// shadow.
    pub section: Option<DVec4>,
    /// Whether objects are left out that lie behind others.
    pub occlusion: Occlusion,
    /// What is drawn over the picture.
    pub overlay: Overlay,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            shadows: Shadows::default(),
            samples: 1,
            background_srgb: [[0.0; 3]; 2],
            headlight: Headlight::WhenAlone,
            allows_z_pass: true,
            section: None,
            occlusion: Occlusion::Auto,
            overlay: Overlay::default(),
        }
    }
}
