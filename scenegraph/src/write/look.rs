//! Materials, drawing styles and textures as nodes.

use crate::scene::{Faces, Image, LightModel, Material, Texture, TextureModel, Wrap};

use super::ImageForm;
use super::shape::Palette;
use super::text::{Number, Text};

/// What a shape's Separator must say unless what is around it has said so.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Look {
    pub(super) faces: Faces,
    pub(super) light_model: LightModel,
}

impl Look {
    /// Inventor's defaults.
    pub(super) const DEFAULT: Self = Self {
        faces: Faces::BothOneSidedLighting,
        light_model: LightModel::Phong,
    };

    pub(super) fn of(material: &Material) -> Self {
        Self {
            faces: material.faces,
            light_model: material.light_model,
        }
    }

    /// Writes what differs from what is in force.
    pub(super) fn write(self, text: &mut Text, in_force: Self) {
        if self.faces != in_force.faces {
            text.open(None, "ShapeHints");
            let (ordering, shape_type) = match self.faces {
                Faces::BothOneSidedLighting => ("UNKNOWN_ORDERING", "UNKNOWN_SHAPE_TYPE"),
                Faces::BothTwoSidedLighting => ("COUNTERCLOCKWISE", "UNKNOWN_SHAPE_TYPE"),
                Faces::FrontOnly => ("COUNTERCLOCKWISE", "SOLID"),
            };
            text.word("vertexOrdering", ordering);
            text.word("shapeType", shape_type);
            text.close();
        }
        if self.light_model != in_force.light_model {
            text.open(None, "LightModel");
            text.word(
                "model",
                match self.light_model {
                    LightModel::BaseColor => "BASE_COLOR",
                    LightModel::Phong => "PHONG",
                },
            );
            text.close();
        }
    }
}

/// Whether all of it equals Inventor's defaults.
pub(super) fn is_default(material: &Material) -> bool {
    material.name.is_none()
        && material.ambient_srgb == [0.2; 3]
        && material.diffuse_srgb == [0.8; 3]
        && material.specular_srgb == [0.0; 3]
        && material.emissive_srgb == [0.0; 3]
        && material.shininess == 0.2
        && material.transparency == 0.0
}

/// A `Material`; with a palette its diffuse colours and transparencies are those.
pub(super) fn material(text: &mut Text, def: Option<&str>, material: &Material, palette: &Palette) {
    text.open(def, "Material");
    if material.ambient_srgb != [0.2; 3] {
        text.numbers("ambientColor", material.ambient_srgb);
    }
    if palette.is_empty() {
        if material.diffuse_srgb != [0.8; 3] {
            text.numbers("diffuseColor", material.diffuse_srgb);
        }
    } else {
        text.list("diffuseColor", palette.colors());
    }
    if material.specular_srgb != [0.0; 3] {
        text.numbers("specularColor", material.specular_srgb);
    }
    if material.emissive_srgb != [0.0; 3] {
        text.numbers("emissiveColor", material.emissive_srgb);
    }
    if material.shininess != 0.2 {
        text.numbers("shininess", [material.shininess]);
    }
    if palette.is_empty() {
        if material.transparency != 0.0 {
            text.numbers("transparency", [material.transparency]);
        }
    } else if palette.is_translucent() {
        let alphas = palette.transparencies();
        text.list("transparency", alphas.map(|t| [Number::field(t)]));
    }
    text.close();
}

/// A `DrawStyle`, if the material asks for more than the default.
pub(super) fn draw_style(text: &mut Text, material: &Material) {
    let (width, size) = (material.line_width_px, material.point_size_px);
    if width == 0.0 && size == 0.0 && material.line_pattern == 0xffff {
        return;
    }
    text.open(None, "DrawStyle");
    if width != 0.0 {
        text.numbers("lineWidth", [width]);
    }
    if size != 0.0 {
        text.numbers("pointSize", [size]);
    }
    if material.line_pattern != 0xffff {
        text.word("linePattern", &format!("{:#06x}", material.line_pattern));
    }
    text.close();
}

/// A `Texture2`; nothing for a missing image.
pub(super) fn texture(text: &mut Text, def: Option<&str>, texture: &Texture, image: &ImageForm) {
    text.open(def, "Texture2");
    match image {
        ImageForm::File(name) => text.string("filename", name),
        ImageForm::Inline(image) => pixels(text, image),
        ImageForm::Missing => {}
    }
    for (field, wrap) in [("wrapS", texture.wrap_s), ("wrapT", texture.wrap_t)] {
        if wrap == Wrap::Clamp {
            text.word(field, "CLAMP");
        }
    }
    let model = match texture.model {
        TextureModel::Modulate => None,
        TextureModel::Decal => Some("DECAL"),
        TextureModel::Blend => Some("BLEND"),
        TextureModel::Replace => Some("REPLACE"),
    };
    if let Some(model) = model {
        text.word("model", model);
    }
    if texture.blend_color_srgb != [0.0; 3] {
        text.numbers("blendColor", texture.blend_color_srgb);
    }
    text.close();
}

/// `SFImage`: width, height, components, and a number for each pixel.
fn pixels(text: &mut Text, image: &Image) {
    let head = [image.width, image.height, image.components.into()];
    let pixels = image.bytes.chunks(usize::from(image.components.max(1)));
    let pixel = |bytes: &[u8]| {
        let digits: String = bytes.iter().map(|byte| format!("{byte:02x}")).collect();
        format!("0x{digits}")
    };
    let words = head.iter().map(u32::to_string).chain(pixels.map(pixel));
    text.words("image", words);
}
