//! From a key to WGSL. A pure function: no device, no cache.
//!
//! The text holds what the key asks for and nothing else. Names are those of the fixed part,
//! `wgsl/types.wgsl`.

use std::fmt::Write;

use super::key::{Contribution, LightForm, LightKey, Shade, ShaderKey, ShadowLookup};
use crate::content::{FogUse, Primitive, TextureUseModel};

/// Structs, bindings and functions that every shader of the scene shares.
pub const TYPES: &str = include_str!("wgsl/types.wgsl");
/// Shadow volumes; stands behind [`TYPES`].
pub const VOLUME: &str = include_str!("wgsl/volume.wgsl");

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
    if key.shade == Shade::Nothing {
        text.push_str(PLACE_ALONE);
    } else {
        varyings(&mut text, key);
    }
    match key.primitive {
        Primitive::Triangles => place_triangles(&mut text, key),
        Primitive::Lines => place_strokes(&mut text, key, LINE),
        Primitive::Points => place_strokes(&mut text, key, POINT),
    }
    if key.shade == Shade::Lit {
        text.push_str(POWER);
        lit(&mut text, key);
        match key.contribution {
            Contribution::All => text.push_str(ALL_LIGHTS),
            _ => {
                if let Some(light) = key.light() {
                    one_light(&mut text, light);
                }
            }
        }
    }
    if key.shade != Shade::Nothing {
        shade(&mut text, key);
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

const PLACE_ALONE: &str = "
struct Varying {
    @builtin(position) @invariant clip: vec4f,
}
";

const POWER: &str = "
// x^e for x >= 0, with 0^0 = 1.
fn power(x: f32, e: f32) -> f32 {
    if e == 0.0 { return 1.0; }
    if x <= 0.0 { return 0.0; }
    return pow(x, e);
}
";

const ALL_LIGHTS: &str = "
fn light_of(rel: vec3f, n: vec3f, v: vec3f, base: vec3f, s: Surface, ids: vec2u) -> vec3f {
    var sum = vec3f(0.0);
    for (var i = 0u; i < ids.y; i++) {
        let light = lights[light_lists[ids.x + i]];
        var l = light.position.xyz;
        var strength = 1.0;
        if light.position.w > 0.0 {
            l = l - rel;
            let d = length(l);
            l = l / max(d, 1e-30);
            let weakening = light.attenuation.z + d * (light.attenuation.y + d * light.attenuation.x);
            strength = select(1.0, 1.0 / weakening, weakening > 0.0);
            let cosine = -dot(l, light.axis.xyz);
            if light.axis.w > -1.5 {
                strength = strength * select(power(max(cosine, 0.0), light.color.w), 0.0, cosine < light.axis.w);
            }
        }
        sum += strength * light.color.rgb * reflected(n, v, l, base, s);
    }
    return sum;
}
";

const LINE: &str = "
    let first = strokes[4u * (index / 6u)];
    let second = strokes[4u * (index / 6u) + 2u];
    let is_second = (0x2cu >> (index % 6u) & 1u) == 1u;
    let is_left = (0x1au >> (index % 6u) & 1u) == 1u;
    let end = 4u * (index / 6u) + select(0u, 2u, is_second);
    let stroke = strokes[end];
    let rel = rel_of(instance, stroke.xyz);
    var clip = clip_of(rel);
    var a = clip_of(rel_of(instance, first.xyz));
    var b = clip_of(rel_of(instance, second.xyz));
    // What is behind the eye is cut where depth is 1, or the direction would turn around.
    let behind_a = a.z - a.w;
    let behind_b = b.z - b.w;
    if behind_a > 0.0 && behind_b <= 0.0 {
        a = mix(a, b, behind_a / (behind_a - behind_b));
    } else if behind_b > 0.0 && behind_a <= 0.0 {
        b = mix(b, a, behind_b / (behind_b - behind_a));
    }
    clip = select(a, b, is_second);
    let pixel_a = a.xy / a.w * frame.viewport.xy * 0.5;
    let pixel_b = b.xy / b.w * frame.viewport.xy * 0.5;
    let along = pixel_b - pixel_a;
    let length_px = length(along);
    let unit = select(vec2f(1.0, 0.0), along / max(length_px, 1e-20), length_px > 1e-6);
    let half_px = 0.5 * surfaces[instances[instance].ids.x].specular.w;
    let across = vec2f(-unit.y, unit.x) * select(-half_px, half_px, is_left);
    clip = vec4f(clip.xy + across * 2.0 * frame.viewport.zw * clip.w, clip.zw);
";

const POINT: &str = "
    let end = 2u * (index / 6u);
    let stroke = strokes[end];
    let rel = rel_of(instance, stroke.xyz);
    var clip = clip_of(rel);
    let corner = vec2f(
        select(-1.0, 1.0, (0x32u >> (index % 6u) & 1u) == 1u),
        select(-1.0, 1.0, (0x2cu >> (index % 6u) & 1u) == 1u),
    );
    let size_px = surfaces[instances[instance].ids.x].blend.w;
    clip = vec4f(clip.xy + corner * size_px * frame.viewport.zw * clip.w, clip.zw);
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

fn varyings(text: &mut String, key: &ShaderKey) {
    text.push_str("\nstruct Varying {\n    @builtin(position) @invariant clip: vec4f,\n");
    text.push_str(
        "    @location(0) rel: vec3f,\n    @location(1) @interpolate(flat) ids: vec3u,\n",
    );
    if key.has_normals() {
        text.push_str("    @location(2) normal: vec3f,\n");
    }
    if key.texture.is_some() {
        text.push_str("    @location(3) texcoord: vec2f,\n");
    }
    if key.has_colors {
        text.push_str("    @location(4) color: vec4f,\n");
    }
    text.push_str("}\n");
}

const NORMAL: &str = "vec3f(
        dot(instances[instance].normal_x.xyz, normal),
        dot(instances[instance].normal_y.xyz, normal),
        dot(instances[instance].normal_z.xyz, normal),
    )";

fn place_triangles(text: &mut String, key: &ShaderKey) {
    text.push_str("\n@vertex\nfn place(\n    @builtin(instance_index) instance: u32,\n    @location(0) position: vec3f,\n");
    if key.has_normals() {
        text.push_str("    @location(1) normal: vec3f,\n");
    }
    if key.texture.is_some() {
        text.push_str("    @location(2) texcoord: vec2f,\n");
    }
    if key.has_colors {
        text.push_str("    @location(3) color: vec4f,\n");
    }
    text.push_str(
        ") -> Varying {
    var out: Varying;
    let rel = rel_of(instance, position);
    out.clip = clip_of(rel);
",
    );
    if key.shade == Shade::Nothing {
        text.push_str("    return out;\n}\n");
        return;
    }
    text.push_str("    out.rel = rel;\n    out.ids = instances[instance].ids.xyz;\n");
    if key.has_normals() {
        let _ = writeln!(text, "    out.normal = {NORMAL};");
    }
    if key.texture.is_some() {
        text.push_str("    out.texcoord = vec2f(texcoord.x, 1.0 - texcoord.y);\n");
    }
    if key.has_colors {
        text.push_str("    out.color = color;\n");
    }
    text.push_str("    return out;\n}\n");
}

fn place_strokes(text: &mut String, key: &ShaderKey, body: &str) {
    text.push_str(
        "\n@vertex\nfn place(@builtin(vertex_index) index: u32, @builtin(instance_index) instance: u32) -> Varying {",
    );
    text.push_str(body);
    text.push_str(
        "    var out: Varying;
    // A little nearer, or a line on a face would be drawn in pieces: 2^-13 of the distance.
    out.clip = vec4f(clip.xy, clip.z + 0.0001220703125 * clip.z, clip.w);
",
    );
    if key.shade == Shade::Nothing {
        text.push_str("    return out;\n}\n");
        return;
    }
    text.push_str("    out.rel = rel;\n    out.ids = instances[instance].ids.xyz;\n");
    if key.has_normals() {
        let _ = writeln!(
            text,
            "    let normal = strokes[end + 1u].xyz;\n    out.normal = {NORMAL};"
        );
    }
    if key.has_colors {
        text.push_str("    out.color = unpack4x8unorm(bitcast<u32>(stroke.w));\n");
    }
    text.push_str("    return out;\n}\n");
}

fn lit(text: &mut String, key: &ShaderKey) {
    text.push_str(
        "
fn reflected(n: vec3f, v: vec3f, l: vec3f, base: vec3f, s: Surface) -> vec3f {
    let n_l = dot(n, l);
    if n_l <= 0.0 {
        return vec3f(0.0);
    }
",
    );
    text.push_str(if key.is_specular {
        "    let r_v = dot(2.0 * n_l * n - l, v);
    return base * n_l + s.specular.rgb * power(max(r_v, 0.0), s.diffuse.w);
}
"
    } else {
        "    return base * n_l;\n}\n"
    });
}

fn one_light(text: &mut String, light: LightKey) {
    text.push_str(
        "
fn light_of(rel: vec3f, n: vec3f, v: vec3f, base: vec3f, s: Surface) -> vec3f {
    let light = lights[pass_values.light.x];
",
    );
    if light.form == LightForm::Directional {
        text.push_str("    let l = light.position.xyz;\n    let strength = 1.0;\n");
    } else {
        text.push_str(
            "    let to_light = light.position.xyz - rel;
    let d = length(to_light);
    let l = to_light / max(d, 1e-30);
    var strength = 1.0;
",
        );
    }
    if light.is_attenuated {
        text.push_str(
            "    let weakening = light.attenuation.z + d * (light.attenuation.y + d * light.attenuation.x);
    strength = select(1.0, 1.0 / weakening, weakening > 0.0);
",
        );
    }
    if let LightForm::Spot { has_exponent } = light.form {
        text.push_str(
            "    let cosine = -dot(l, light.axis.xyz);
    if cosine < light.axis.w {
        return vec3f(0.0);
    }
",
        );
        if has_exponent {
            text.push_str("    strength = strength * power(max(cosine, 0.0), light.color.w);\n");
        }
    }
    text.push_str("    return strength * light.color.rgb * reflected(n, v, l, base, s);\n}\n");
    match light.shadow {
        ShadowLookup::None => {}
        ShadowLookup::Mask => text.push_str(
            "
fn is_lit_at(in: Varying, sample: u32) -> f32 {
    let mask = textureLoad(shadow_mask, vec2i(in.clip.xy), 0).x;
    return select(1.0, 0.0, (mask >> sample & 1u) == 1u);
}
",
        ),
        ShadowLookup::Stencil => text.push_str(
            "
fn is_lit_at(in: Varying, sample: u32) -> f32 {
    return select(1.0, 0.0, textureLoad(shadow_stencil, vec2i(in.clip.xy), 0).x != 0u);
}
",
        ),
        ShadowLookup::Map => text.push_str(
            "
fn is_lit_at(in: Varying, sample: u32) -> f32 {
    return in_map(in.rel, 0u);
}
",
        ),
        ShadowLookup::CubeMap => text.push_str(
            "
fn is_lit_at(in: Varying, sample: u32) -> f32 {
    let d = in.rel - lights[pass_values.light.x].position.xyz;
    let a = abs(d);
    var face = select(0u, 1u, d.x < 0.0);
    if a.y > a.x && a.y >= a.z {
        face = select(2u, 3u, d.y < 0.0);
    } else if a.z > a.x {
        face = select(4u, 5u, d.z < 0.0);
    }
    return in_map(in.rel, face);
}
",
        ),
    }
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
    text.push_str(") -> @location(0) vec4f {\n    let s = surfaces[in.ids.x];\n");
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

fn lights_added(text: &mut String, key: &ShaderKey, shadow: ShadowLookup) {
    text.push_str("    var n = in.normal * inverseSqrt(max(dot(in.normal, in.normal), 1e-30));\n");
    if key.is_two_sided {
        text.push_str("    n = select(-n, n, is_front);\n");
    }
    text.push_str(match (key.is_specular, key.is_parallel) {
        (false, _) => "    let v = vec3f(0.0);\n",
        (true, true) => "    let v = -frame.view_axis.xyz;\n",
        (true, false) => "    let v = -in.rel * inverseSqrt(max(dot(in.rel, in.rel), 1e-30));\n",
    });
    let visible = match shadow {
        ShadowLookup::None => "",
        ShadowLookup::Mask => "is_lit_at(in, sample) * ",
        ShadowLookup::Map | ShadowLookup::CubeMap | ShadowLookup::Stencil => "is_lit_at(in, 0u) * ",
    };
    let ids = match key.contribution {
        Contribution::All => ", in.ids.yz",
        _ => "",
    };
    let _ = writeln!(
        text,
        "    color += {visible}light_of(in.rel, n, v, base.rgb, s{ids});"
    );
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
