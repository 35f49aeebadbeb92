// A vertical gradient behind everything.

struct Gradient {
    top: vec4f,
    bottom: vec4f,
}

@group(0) @binding(0) var<uniform> gradient: Gradient;

struct Out {
    @builtin(position) clip: vec4f,
    @location(0) height: f32,
}

@vertex
fn whole(@builtin(vertex_index) index: u32) -> Out {
    let p = vec2f(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0);
    return Out(vec4f(p, 0.0, 1.0), p.y * 0.5 + 0.5);
}

@fragment
fn background(in: Out) -> @location(0) vec4f {
    return mix(gradient.bottom, gradient.top, clamp(in.height, 0.0, 1.0));
}
