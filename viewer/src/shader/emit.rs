//! From a key to WGSL. A pure function: no device, no cache.
//!
//! The text holds what the key asks for and nothing else. Names are those of the fixed part,
//! `wgsl/types.wgsl`.

use super::emit_light::{light_functions, lights_added};
use super::emit_place::place;
use super::key::{Shade, ShaderKey, ShadowLookup};
use crate::content::{FogUse, Primitive, TextureUseModel};

/// Structs, bindings and functions that every shader of the scene shares.
pub const TYPES: &str = include_str!("wgsl/types.wgsl");
/// Shadow volumes; stands behind [`TYPES`].
pub const VOLUME: &str = include_str!("wgsl/volume.wgsl");

/// What is drawn over the picture; stands behind [`TYPES`].
pub const OVERLAY: &str = include_str!("wgsl/overlay.wgsl");

/// Depth as a light sees it; stands behind [`TYPES`].
pub const MAP: &str = include_str!("wgsl/map.wgsl");
/// Shadow volumes by compute; stands alone.
pub const EXTRACT: &str = include_str!("wgsl/extract.wgsl");
/// A gradient behind everything.
pub const BACKGROUND: &str = include_str!("wgsl/background.wgsl");

/// The text of a surface shader; its entry points are `place` and, if it has colours, `shade`.
pub fn emit(key: &ShaderKey) -> String {
    let mut text = String::from(TYPES);
    bindings(&mut text, key);
    place(&mut text, key);
    if key.shade == Shade::Lit {
        light_functions(&mut text, key);
    }
    if key.shade != Shade::Nothing {
        shade(&mut text, key);
    } else if key.is_cut {
        text.push_str(CUT_ALONE);
    }
    text
}

/// The text of the final pass for a number of samples.
pub fn emit_present(samples: u32) -> String {
    let texture = if samples > 1 {
        "texture_multisampled_2d<f32>"
    } else {
        "texture_2d<f32>"
    };
    include_str!("wgsl/present.wgsl")
        .replace("TEXTURE_TYPE", texture)
        .replace("SAMPLES", &samples.to_string())
    // A texture of one sample has a mip level in its place, and only level 0.
}

/// The text of the test for what lies behind, for images of so many samples a pixel.
pub fn emit_occlusion(samples: u32) -> String {
    let texture = if samples > 1 {
        "texture_depth_multisampled_2d"
    } else {
        "texture_depth_2d"
    };
    include_str!("wgsl/occlusion.wgsl")
        .replace("DEPTH_TYPE", texture)
        .replace("SAMPLES", &samples.to_string())
}

/// The text of the rays to a light, for images of so many samples a pixel.
pub fn emit_rays(samples: u32) -> String {
    let (texture, places) = if samples > 1 {
        ("texture_depth_multisampled_2d", STANDARD_PLACES)
    } else {
        ("texture_depth_2d", "vec2f(0.5)")
    };
    let rays = include_str!("wgsl/rays.wgsl")
        .replace("DEPTH_TYPE", texture)
        .replace("SAMPLE_PLACES", places)
        .replace("SAMPLES", &samples.to_string());
    format!("{TYPES}{rays}")
}

/// Where the four samples of a pixel are: the standard pattern, which all interfaces share.
const STANDARD_PLACES: &str = "(array(vec2f(0.375, 0.125), vec2f(0.875, 0.375), \
                               vec2f(0.125, 0.625), vec2f(0.625, 0.875))[sample])";

/// Of what has no colours, where a section plane cuts it.
const CUT_ALONE: &str = "
@fragment
fn shade(in: Varying) {
    if dot(frame.section.xyz, in.rel) + frame.section.w > 0.0 {
        discard;
    }
}
";

fn bindings(text: &mut String, key: &ShaderKey) {
    if key.texture.is_some() {
        text.push_str(
            "
@group(2) @binding(0) var image: texture_2d<f32>;
@group(2) @binding(1) var image_sampler: sampler;
",
        );
    }
    if key.primitive != Primitive::Triangles {
        text.push_str(
            "
// For each end: position and packed colour; normal.
@group(2) @binding(0) var<storage, read> strokes: array<vec4f>;
",
        );
    }
    text.push_str(match key.light().map(|light| light.shadow) {
        Some(ShadowLookup::Map | ShadowLookup::CubeMap) => {
            "
struct ShadowViews {
    map_from_rel: array<mat4x4f, 6>,
}
@group(3) @binding(0) var shadow_map: texture_depth_2d_array;
@group(3) @binding(1) var shadow_sampler: sampler_comparison;
@group(3) @binding(2) var<uniform> shadow_views: ShadowViews;

fn in_map(rel: vec3f, face: u32) -> f32 {
    let p = shadow_views.map_from_rel[face] * vec4f(rel, 1.0);
    let h = p.xyz / p.w;
    let at = h.xy * vec2f(0.5, -0.5) + vec2f(0.5);
    return textureSampleCompareLevel(shadow_map, shadow_sampler, at, face, h.z);
}
"
        }
        Some(ShadowLookup::Mask) => {
            "
@group(3) @binding(0) var shadow_mask: texture_2d<u32>;
"
        }
        Some(ShadowLookup::Stencil) => {
            "
@group(3) @binding(0) var shadow_stencil: texture_2d<u32>;
"
        }
        _ => "",
    });
}

fn shade(text: &mut String, key: &ShaderKey) {
    text.push_str("\n@fragment\nfn shade(in: Varying");
    if key.is_two_sided {
        text.push_str(", @builtin(front_facing) is_front: bool");
    }
    let shadow = key.light().map_or(ShadowLookup::None, |light| light.shadow);
    if shadow == ShadowLookup::Mask {
        text.push_str(", @builtin(sample_index) sample: u32");
    }
    text.push_str(") -> @location(0) vec4f {\n");
    if key.is_cut {
        text.push_str(
            "    if dot(frame.section.xyz, in.rel) + frame.section.w > 0.0 {\n        discard;\n    }\n",
        );
    }
    text.push_str("    let s = surfaces[in.ids.x];\n");
    text.push_str(if key.has_colors {
        "    let base = in.color;\n"
    } else {
        "    let base = vec4f(s.diffuse.rgb, s.constant.a);\n"
    });
    match (key.shade, key.is_first()) {
        (Shade::Unlit, _) => text.push_str("    var color = base.rgb;\n"),
        (_, true) => text.push_str("    var color = s.constant.rgb;\n"),
        (_, false) => text.push_str("    var color = vec3f(0.0);\n"),
    }
    if key.shade == Shade::Lit {
        lights_added(text, key, shadow);
    }
    text.push_str("    var alpha = base.a;\n");
    textured(text, key);
    fogged(text, key);
    text.push_str("    return vec4f(color, alpha);\n}\n");
}

fn textured(text: &mut String, key: &ShaderKey) {
    let Some(texture) = key.texture else {
        return;
    };
    text.push_str("    let t = textureSample(image, image_sampler, in.texcoord);\n");
    let first = key.is_first();
    text.push_str(match (texture.model, first) {
        (TextureUseModel::Modulate, _) => "    color = color * t.rgb;\n    alpha = alpha * t.a;\n",
        (TextureUseModel::Decal, true) => "    color = mix(color, t.rgb, t.a);\n",
        (TextureUseModel::Decal, false) => "    color = color * (1.0 - t.a);\n",
        (TextureUseModel::Blend, true) => {
            "    color = mix(color, s.blend.rgb, t.rgb);\n    alpha = alpha * t.a;\n"
        }
        (TextureUseModel::Blend, false) => "    color = color * (1.0 - t.rgb);\n",
        (TextureUseModel::Replace, _) if texture.has_alpha => {
            "    color = t.rgb;\n    alpha = t.a;\n"
        }
        (TextureUseModel::Replace, _) => "    color = t.rgb;\n",
    });
}

fn fogged(text: &mut String, key: &ShaderKey) {
    let Some(fog) = key.fog else {
        return;
    };
    text.push_str("    let z = max(dot(in.rel, frame.view_axis.xyz), 0.0) * s.fog.w;\n");
    text.push_str(match fog {
        FogUse::Haze => "    let clear = clamp(1.0 - z, 0.0, 1.0);\n",
        // 256 = 2^8: at the visibility the fog leaves less than one step of 8 bits.
        FogUse::Fog => "    let clear = exp2(-8.0 * z);\n",
        FogUse::Smoke => "    let clear = exp2(-8.0 * z * z);\n",
    });
    text.push_str(if key.is_first() {
        "    color = mix(s.fog.rgb, color, clear);\n"
    } else {
        "    color = color * clear;\n"
    });
}
