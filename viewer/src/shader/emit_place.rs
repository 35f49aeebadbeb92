//! The vertex stage of a generated shader: from stored corners, line ends or points to the screen.

use std::fmt::Write;

use super::key::{Shade, ShaderKey};
use crate::content::Primitive;

/// What goes from the vertex stage to the fragment stage, and the vertex stage, `place`.
pub fn place(text: &mut String, key: &ShaderKey) {
    if key.shade == Shade::Nothing && key.is_cut {
        text.push_str(PLACE_CUT);
    } else if key.shade == Shade::Nothing {
        text.push_str(PLACE_ALONE);
    } else {
        varyings(text, key);
    }
    match key.primitive {
        Primitive::Triangles => place_triangles(text, key),
        Primitive::Lines => place_strokes(text, key, LINE),
        Primitive::Points => place_strokes(text, key, POINT),
    }
}

const PLACE_ALONE: &str = "
struct Varying {
    @builtin(position) @invariant clip: vec4f,
}
";

const PLACE_CUT: &str = "
struct Varying {
    @builtin(position) @invariant clip: vec4f,
    @location(0) rel: vec3f,
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

const NORMAL: &str = "vec3f(
        dot(instances[instance].normal_x.xyz, normal),
        dot(instances[instance].normal_y.xyz, normal),
        dot(instances[instance].normal_z.xyz, normal),
    )";

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

/// The end of a vertex stage without colours.
fn alone(key: &ShaderKey) -> &'static str {
    if key.is_cut {
        "    out.rel = rel;\n    return out;\n}\n"
    } else {
        "    return out;\n}\n"
    }
}

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
        text.push_str(alone(key));
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
        text.push_str(alone(key));
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
