//! Lights, cameras and the environment, with Inventor's own values.

use glam::{DQuat, DVec3};
use iv_parser::SourcePos;

use super::{EnvironmentId, Placement};

/// A light's shape; points and directions are in the light's local frame.
#[derive(Clone, Debug, PartialEq)]
pub enum LightKind {
    /// Parallel rays along `direction`.
    Directional {
        /// The way the light travels; unit length.
        direction: DVec3,
    },
    /// All ways from `location`.
    Point {
        /// Where it is.
        location: DVec3,
    },
    /// A cone.
    Spot {
        /// The apex.
        location: DVec3,
        /// The axis; unit length.
        direction: DVec3,
        /// 0 to 1; OpenGL's spot exponent is 128 times this.
        drop_off_rate: f64,
        /// Half angle of the cone, radians.
        cut_off_angle_rad: f64,
    },
}

/// One occurrence of a light that is on.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// Where it hangs.
    pub placement: Placement,
    /// Its shape.
    pub kind: LightKind,
    /// Display-referred.
    pub color_srgb: [f64; 3],
    /// 0 to 1 as a rule.
    pub intensity: f64,
    /// How a spot light's cone fades, in place of its drop-off.
    pub beam: Option<Beam>,
    /// How far a point or spot light reaches, in the world; `None` for any distance. The light sets
    /// of instances tell what is in reach.
    pub radius_in_world: Option<f64>,
    /// The environment at the light: its attenuation is this light's.
    pub environment: EnvironmentId,
}

/// A spot light that is of full strength in an inner cone: at the angle θ from its axis the light
/// has the share `clamp((cos θ − cos outer) / (cos inner − cos outer), 0, 1)^exponent`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Beam {
    /// Half angle of the inner cone, radians; at most the cut-off angle.
    pub inner_angle_rad: f64,
    /// At least 0.
    pub exponent: f64,
}

/// `Environment.fogType`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FogType {
    /// Linear.
    Haze,
    /// Exponential.
    Fog,
    /// Exponential squared.
    Smoke,
}

/// Fog.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fog {
    /// How it thickens.
    pub fog_type: FogType,
    /// Its colour.
    pub color_srgb: [f64; 3],
    /// Distance at which it hides all; 0 means the far plane.
    pub visibility: f64,
}

/// `Environment`, resolved.
#[derive(Clone, Debug, PartialEq)]
pub struct Environment {
    /// Intensity of the ambient light.
    pub ambient_intensity: f64,
    /// Colour of the ambient light.
    pub ambient_color_srgb: [f64; 3],
    /// Quadratic, linear, constant.
    pub attenuation: [f64; 3],
    /// Fog, if any.
    pub fog: Option<Fog>,
    /// Where the first node with these values stands; line 0 for Inventor's defaults.
    pub pos: SourcePos,
}

impl Default for Environment {
    fn default() -> Self {
        Self {
            ambient_intensity: 0.2,
            ambient_color_srgb: [1.0; 3],
            attenuation: [0.0, 0.0, 1.0],
            fog: None,
            pos: SourcePos::default(),
        }
    }
}

/// A camera's projection.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// `heightAngle`, radians.
    Perspective {
        /// Vertical field of view, radians.
        height_angle_rad: f64,
    },
    /// `height`, in units of the camera's frame.
    Orthographic {
        /// Full height of the view volume.
        height: f64,
    },
}

/// `Camera.viewportMapping`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ViewportMapping {
    /// The camera takes the window's aspect ratio.
    AdjustCamera,
    /// The window is cropped to the camera's aspect ratio.
    CropViewport,
    /// Neither.
    LeaveAlone,
}

/// One occurrence of a camera.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// Where its frame hangs.
    pub placement: Placement,
    /// Eye, in its local frame.
    pub position: DVec3,
    /// Turns the view direction -Z and up +Y into the local frame; unit length.
    pub orientation: DQuat,
    /// Width over height.
    pub aspect_ratio: f64,
    /// As written; often not useful.
    pub near_distance: f64,
    /// As written; often not useful.
    pub far_distance: f64,
    /// To the point of interest.
    pub focal_distance: f64,
    /// Field of view.
    pub projection: Projection,
    /// What happens when the window has another aspect ratio.
    pub viewport_mapping: ViewportMapping,
}
