//! Light in the fragment stage of a generated shader: one light or all, and their shadows.

use std::fmt::Write;

use super::key::{Contribution, LightForm, LightKey, ShaderKey, ShadowLookup, SpotForm};

/// The functions that [`lights_added`] calls.
pub fn light_functions(text: &mut String, key: &ShaderKey) {
    text.push_str(POWER);
    lit(text, key);
    match key.contribution {
        Contribution::All => text.push_str(ALL_LIGHTS),
        _ => {
            if let Some(light) = key.light() {
                one_light(text, light);
            }
        }
    }
}

/// Adds light to `color`.
pub fn lights_added(text: &mut String, key: &ShaderKey, shadow: ShadowLookup) {
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
                let left = select(cosine, min((cosine - light.axis.w) * light.attenuation.w, 1.0), light.attenuation.w > 0.0);
                strength = strength * select(power(max(left, 0.0), light.color.w), 0.0, cosine < light.axis.w);
            }
        }
        sum += strength * light.color.rgb * reflected(n, v, l, base, s);
    }
    return sum;
}
";

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
    if let LightForm::Spot(form) = light.form {
        text.push_str(
            "    let cosine = -dot(l, light.axis.xyz);
    if cosine < light.axis.w {
        return vec3f(0.0);
    }
",
        );
        text.push_str(match form {
            SpotForm::Even => "",
            SpotForm::Cosine => {
                "    strength = strength * power(max(cosine, 0.0), light.color.w);\n"
            }
            SpotForm::Beam => {
                "    let left = clamp((cosine - light.axis.w) * light.attenuation.w, 0.0, 1.0);
    strength = strength * power(left, light.color.w);
"
            }
        });
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
