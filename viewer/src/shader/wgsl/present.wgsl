// The accumulated light as 8-bit colours: every sample clamped, then their mean.

@group(0) @binding(0) var accumulated: TEXTURE_TYPE;

@vertex
fn whole(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return vec4f(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

@fragment
fn present(@builtin(position) p: vec4f) -> @location(0) vec4f {
    let pixel = vec2i(p.xy);
    var sum = vec3f(0.0);
    for (var sample = 0; sample < SAMPLES; sample++) {
        let color = textureLoad(accumulated, pixel, sample).rgb;
        sum += clamp(color, vec3f(0.0), vec3f(1.0));
    }
    return vec4f(sum / f32(SAMPLES), 1.0);
}
