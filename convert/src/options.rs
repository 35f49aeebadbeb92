//! What the caller can choose: plain data. docs/OPTIONS.md says what each choice costs.

use std::sync::Arc;

/// The form of the output.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Container {
    /// One binary file, `.glb`.
    Glb,
    /// JSON text, `.gltf`, with its numbers in `.bin` files.
    GltfBin,
    /// JSON text, `.gltf`, with its numbers in it as base64.
    GltfEmbedded,
    /// A page, `.html`, with a viewer and a `.glb` in it.
    Html,
}

/// Options of a conversion.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// The form of the output.
    pub container: Container,
    /// Whether Inventor's own values, which glTF has no place for, go into `extras.iv`.
    pub extras: bool,
    /// Largest length of a `.glb`; its header has 32 bits for it.
    pub max_glb_bytes: u64,
    /// Largest length of one `.bin`; what is more goes into further ones. Web loaders and 32-bit
    /// readers fail beyond 32 bits.
    pub max_bin_bytes: u64,
    /// JSON that goes into `extras.iv.source` of the scene as it is; see
    /// [`write_file_with_source`](crate::write_file_with_source).
    pub source: Option<Arc<str>>,
    /// Which of the model's axes points upwards; it becomes glTF's, +Y.
    pub up: Up,
    /// How many metres the model's unit has; glTF's is the metre.
    pub metres_per_unit: f64,
    /// What becomes of materials.
    pub materials: Materials,
    /// The unit of lights.
    pub lights: Lights,
    /// The format of images.
    pub textures: TextureFormat,
    /// Which vertices triangles share.
    pub weld: Weld,
    /// Whether triangles and vertices are put in an order that suits graphics devices.
    pub optimize: bool,
    /// How far positions and normals may move to take less room; `None`: not at all.
    pub quantize: Option<Quantize>,
    /// Whether the numbers of meshes are compressed (`EXT_meshopt_compression`). Includes
    /// `optimize`, in an order that suits the compression.
    pub compress: bool,
    /// Whether copies of a mesh below one node become one node (`EXT_mesh_gpu_instancing`).
    pub instancing: bool,
    /// Most threads that work on meshes. The output does not depend on it.
    pub threads: usize,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            container: Container::Glb,
            extras: true,
            max_glb_bytes: u64::from(u32::MAX),
            max_bin_bytes: u64::from(u32::MAX),
            source: None,
            up: Up::Y,
            metres_per_unit: 1.0,
            materials: Materials::Fidelity,
            lights: Lights::Unitless,
            textures: TextureFormat::Keep,
            weld: Weld::Shared,
            optimize: false,
            quantize: None,
            compress: false,
            instancing: false,
            threads: 1,
        }
    }
}

/// The axis that points upwards.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Up {
    /// As Inventor's own cameras have it, and glTF; nothing is turned.
    Y,
    /// As most CAD systems have it.
    Z,
}

/// What becomes of Inventor's materials.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Materials {
    /// Highlights as in Inventor, with `KHR_materials_specular` and `KHR_materials_ior`.
    Fidelity,
    /// Colour and roughness alone, which all viewers know; highlights are those of plastic.
    Simple,
    /// Colours as they are, without light (`KHR_materials_unlit`); normals are left out.
    Unlit,
}

impl Materials {
    pub(crate) const ALL: [Self; 3] = [Self::Fidelity, Self::Simple, Self::Unlit];

    /// As the command has it.
    pub(crate) fn word(self) -> &'static str {
        match self {
            Self::Fidelity => "fidelity",
            Self::Simple => "simple",
            Self::Unlit => "unlit",
        }
    }
}

/// The unit of lights.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Lights {
    /// Inventor's intensity 1 makes a white surface white, as viewers without exposure show it.
    Unitless,
    /// Lux and candela of Inventor's intensity taken for watts: 683 lumen each.
    Physical,
}

impl Lights {
    pub(crate) const ALL: [Self; 2] = [Self::Unitless, Self::Physical];

    /// As the command has it.
    pub(crate) fn word(self) -> &'static str {
        match self {
            Self::Unitless => "unitless",
            Self::Physical => "physical",
        }
    }
}

/// The format of images.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TextureFormat {
    /// PNG and JPEG files stay byte for byte; all else becomes PNG.
    Keep,
    /// All become PNG.
    Png,
    /// Lossless WebP (`EXT_texture_webp`) where that is smaller.
    Webp,
}

/// Which vertices triangles, lines and points share.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Weld {
    /// Those that are equal as they are stored.
    Shared,
    /// None: each corner has a vertex of its own.
    Apart,
}

/// Numbers in fewer bits (`KHR_mesh_quantization`), and how far they may be off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quantize {
    /// Farthest that a position may move, in the units of the scene handed over.
    pub tolerance: f64,
    /// Widest angle that a normal may turn by, in radians.
    pub normal_tolerance_rad: f64,
}

impl Quantize {
    /// Widest angle that a normal may turn by if nothing else is asked for: half a degree, which
    /// eight bits keep.
    pub const NORMAL_TOLERANCE_RAD: f64 = 0.5 * std::f64::consts::PI / 180.0;

    /// With this tolerance of positions, in the units of the scene.
    #[must_use]
    pub fn within(tolerance: f64) -> Self {
        Self {
            tolerance,
            normal_tolerance_rad: Self::NORMAL_TOLERANCE_RAD,
        }
    }
}
