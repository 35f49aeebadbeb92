//! A frame as a list of passes, for those who draw it and for those who read it. How it comes
//! about is in `planner`.

use std::fmt::Write;
use std::ops::Range;

use crate::content::WorldLight;
use crate::shader::{ShaderKey, ShadowLookup};

/// Consecutive objects of one mesh, drawn by one shader as instances.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Draw {
    /// Indices into [`crate::content::Content::objects`].
    pub objects: Range<u32>,
    /// By which shader.
    pub shader: ShaderKey,
    /// Which of their pixels.
    pub pixels: Pixels,
}

/// Which pixels a draw may change, by what shadow volumes left in the stencil.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Pixels {
    /// All.
    All,
    /// Those in the light.
    Lit,
    /// Those in shadow.
    Shadowed,
}

/// The shadow volume of one object.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct VolumeDraw {
    /// Index into [`crate::content::Content::objects`].
    pub object: u32,
    /// Counted in front of the scene; else sides and all caps, counted behind it.
    pub is_z_pass: bool,
    /// Z-pass: caps at the light's end are counted too. Where a way into the volume leads through
    /// the caster, the caster hides what is behind; but not with faces that are not drawn.
    pub has_light_caps: bool,
    /// False for sides seen edge-on, where a device cannot tell which way they face.
    pub has_sides: bool,
}

/// What a pass does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PassKind {
    /// Draws depth alone, for what must be known before the first light: shadows, or what lies
    /// behind.
    Depth {
        /// Nothing was drawn before it.
        begins: bool,
    },
    /// Emission and ambient light together with the first light.
    First {
        /// Index into [`Plan::lights`].
        light: Option<u32>,
        /// How its shadows are asked for.
        shadow: ShadowLookup,
        /// There was a pass for the depth.
        has_depth: bool,
    },
    /// Counts shadow volumes into the stencil.
    Volumes {
        /// Index into [`Plan::lights`].
        light: u32,
    },
    /// Draws depth as the light sees it.
    Map {
        /// Index into [`Plan::lights`].
        light: u32,
    },
    /// Casts rays from what is seen to the light.
    Rays {
        /// Index into [`Plan::lights`].
        light: u32,
    },
    /// Adds one light.
    Light {
        /// Index into [`Plan::lights`].
        light: u32,
        /// How its shadows are asked for.
        shadow: ShadowLookup,
        /// Shadow volumes are in the stencil.
        has_volumes: bool,
    },
    /// Blends transparent objects, back to front.
    Transparent,
}

/// A pass.
#[derive(Clone, Debug, PartialEq)]
pub struct Pass {
    /// What it does.
    pub kind: PassKind,
    /// What it draws of the scene.
    pub draws: Vec<Draw>,
    /// What it draws of shadow volumes.
    pub volumes: Vec<VolumeDraw>,
    /// Pixels outside of x, y, width, height are left alone; `None`: all of the region.
    pub scissor: Option<[u32; 4]>,
    /// What it leaves out.
    pub skipped: Vec<Skip>,
}

impl Pass {
    /// Objects drawn; one whose lit and shadowed pixels are drawn apart counts once.
    pub fn object_count(&self) -> usize {
        let whole = self.draws.iter();
        whole
            .filter(|draw| draw.pixels != Pixels::Shadowed)
            .map(|draw| draw.objects.len())
            .sum()
    }
}

/// Why something was left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum SkipReason {
    /// Objects outside of the view.
    OutOfView,
    /// Objects that lie behind others.
    Occluded,
    /// Objects that no light reaches, in a pass of a light.
    Unlit,
    /// Objects that are not in the light's scope.
    OutOfScope,
    /// Objects outside of the light's range or cone.
    OutOfReach,
    /// Casters whose shadow falls outside of the view.
    ShadowOutOfView,
    /// Casters that the light does not reach.
    CasterOutOfReach,
    /// Volumes drawn without caps.
    CapsNotNeeded,
    /// Lights without colour.
    BlackLight,
    /// Lights that reach nothing in view.
    LightReachesNothing,
    /// Shadow passes of lights whose shadows fall nowhere in view.
    NoShadowInView,
}

impl SkipReason {
    /// For statistics.
    pub fn name(self) -> &'static str {
        match self {
            Self::OutOfView => "object out of view",
            Self::Occluded => "object behind others",
            Self::Unlit => "object not lit",
            Self::OutOfScope => "object out of the light's scope",
            Self::OutOfReach => "object out of the light's reach",
            Self::ShadowOutOfView => "shadow out of view",
            Self::CasterOutOfReach => "caster out of the light's reach",
            Self::CapsNotNeeded => "caps not needed (z-pass)",
            Self::BlackLight => "black light",
            Self::LightReachesNothing => "light reaches nothing in view",
            Self::NoShadowInView => "no shadow in view",
        }
    }
}

/// How many were left out for a reason.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Skip {
    /// Why.
    pub reason: SkipReason,
    /// How many.
    pub count: usize,
}

/// A frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// In order.
    pub passes: Vec<Pass>,
    /// The lights of the scene, with the headlight behind them if it shines.
    pub lights: Vec<WorldLight>,
    /// Lights that no pass has, and why.
    pub skipped_lights: Vec<(u32, SkipReason)>,
}

impl Plan {
    /// A line for tests and logs.
    pub fn brief(&self) -> String {
        let mut line = String::new();
        for pass in &self.passes {
            if !line.is_empty() {
                line.push_str("; ");
            }
            let _ = match pass.kind {
                PassKind::Depth { .. } => write!(line, "depth"),
                PassKind::First { light: None, .. } => write!(line, "first"),
                PassKind::First {
                    light: Some(light), ..
                } => write!(line, "first + light {light}"),
                PassKind::Volumes { light } => {
                    let z_pass = pass.volumes.iter().filter(|v| v.is_z_pass).count();
                    let z_fail = pass.volumes.len() - z_pass;
                    write!(line, "volumes {light} z-fail x{z_fail} z-pass x{z_pass}")
                }
                PassKind::Map { light } => write!(line, "map {light}"),
                PassKind::Rays { light } => write!(line, "rays {light}"),
                PassKind::Light { light, .. } => write!(line, "light {light}"),
                PassKind::Transparent => write!(line, "transparent"),
            };
            if pass.volumes.is_empty() {
                let _ = write!(line, " x{}", pass.object_count());
            }
        }
        line
    }
}
