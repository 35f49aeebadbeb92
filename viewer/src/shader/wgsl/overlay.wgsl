// What is drawn over the picture, in colours of its own; stands behind the shared types.

struct Flat {
    @builtin(position) @invariant clip: vec4f,
    @location(0) rel: vec3f,
    @location(1) @interpolate(flat) color: vec4f,
}

// A little nearer, as lines of the scene are.
fn nearer(clip: vec4f) -> vec4f {
    return vec4f(clip.xy, clip.z + 0.0001220703125 * clip.z, clip.w);
}

fn painted(instance: u32, position: vec3f, color: vec4f) -> Flat {
    let rel = rel_of(instance, position);
    return Flat(nearer(clip_of(rel)), rel, color);
}

@vertex
fn tint(@builtin(instance_index) instance: u32, @location(0) position: vec3f) -> Flat {
    return painted(instance, position, vec4f(1.0, 0.55, 0.0, 0.4));
}

@vertex
fn tint_behind(@builtin(instance_index) instance: u32, @location(0) position: vec3f) -> Flat {
    return painted(instance, position, vec4f(1.0, 0.55, 0.0, 0.12));
}

@vertex
fn wire(@builtin(instance_index) instance: u32, @location(0) position: vec3f) -> Flat {
    return painted(instance, position, vec4f(0.1, 0.1, 0.1, 1.0));
}

@vertex
fn dot_at(@builtin(instance_index) instance: u32, @location(0) position: vec3f) -> Flat {
    return painted(instance, position, vec4f(1.0, 0.1, 0.1, 1.0));
}

@vertex
fn cap(@location(0) p: vec3f, @location(1) object: u32, @location(2) color: vec4f) -> Flat {
    let rel = rel_of(object, p);
    return Flat(clip_of(rel), rel, color);
}

// Two pixels wide.
@vertex
fn segment(
    @builtin(vertex_index) corner: u32,
    @location(0) first: vec3f,
    @location(1) object: u32,
    @location(2) second: vec3f,
    @location(3) color: vec4f,
) -> Flat {
    let is_second = (0x2cu >> corner & 1u) == 1u;
    let is_left = (0x1au >> corner & 1u) == 1u;
    let rel_a = rel_of(object, first);
    let rel_b = rel_of(object, second);
    var a = clip_of(rel_a);
    var b = clip_of(rel_b);
    // What is behind the eye is cut where depth is 1, or the direction would turn around.
    let behind_a = a.z - a.w;
    let behind_b = b.z - b.w;
    if behind_a > 0.0 && behind_b <= 0.0 {
        a = mix(a, b, behind_a / (behind_a - behind_b));
    } else if behind_b > 0.0 && behind_a <= 0.0 {
        b = mix(b, a, behind_b / (behind_b - behind_a));
    }
    let pixel_a = a.xy / a.w * frame.viewport.xy * 0.5;
    let pixel_b = b.xy / b.w * frame.viewport.xy * 0.5;
    let along = pixel_b - pixel_a;
    let length_px = length(along);
    let unit = select(vec2f(1.0, 0.0), along / max(length_px, 1e-20), length_px > 1e-6);
    let across = vec2f(-unit.y, unit.x) * select(-1.0, 1.0, is_left);
    let clip = select(a, b, is_second);
    let moved = vec4f(clip.xy + across * 2.0 * frame.viewport.zw * clip.w, clip.zw);
    return Flat(nearer(moved), select(rel_a, rel_b, is_second), color);
}

@fragment
fn flat_color(in: Flat) -> @location(0) vec4f {
    if dot(frame.section.xyz, in.rel) + frame.section.w > 0.0 {
        discard;
    }
    return in.color;
}

// Caps lie in the section plane itself.
@fragment
fn cap_color(in: Flat) -> @location(0) vec4f {
    return in.color;
}
