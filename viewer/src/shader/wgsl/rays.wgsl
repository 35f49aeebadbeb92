// Rays from what is seen to a light; stands behind types.wgsl. One bit a sample: 1 = in shadow.

// A box, and where it leads: for an inner node the index of its second child and 0 (the first is
// the next node); for a leaf its first triangle and the number of triangles.
struct Node {
    low: vec3f,
    first: u32,
    high: vec3f,
    count: u32,
}

@group(2) @binding(0) var<storage, read> nodes: array<Node>;
// A corner and two edges for each triangle.
@group(2) @binding(1) var<storage, read> corners: array<vec4f>;
@group(2) @binding(2) var depth: DEPTH_TYPE;
@group(2) @binding(3) var mask: texture_storage_2d<r32uint, write>;

fn is_blocked(origin: vec3f, way: vec3f, near: f32, far: f32) -> bool {
    let inverse = 1.0 / way;
    var stack: array<u32, 64>;
    var top = 1u;
    stack[0] = 0u;
    while top > 0u {
        top--;
        let index = stack[top];
        let node = nodes[index];
        let a = (node.low - origin) * inverse;
        let b = (node.high - origin) * inverse;
        let low = min(a, b);
        let high = max(a, b);
        let enter = max(max(low.x, low.y), max(low.z, near));
        let leave = min(min(high.x, high.y), min(high.z, far));
        if enter > leave * 1.000001 {
            continue;
        }
        if node.count == 0u {
            stack[top] = node.first;
            stack[top + 1u] = index + 1u;
            top += 2u;
            continue;
        }
        for (var i = node.first; i < node.first + node.count; i++) {
            let ab = corners[3u * i + 1u].xyz;
            let ac = corners[3u * i + 2u].xyz;
            let p = cross(way, ac);
            let determinant = dot(ab, p);
            if determinant == 0.0 {
                continue;
            }
            let s = origin - corners[3u * i].xyz;
            let u = dot(s, p) / determinant;
            let q = cross(s, ab);
            let v = dot(way, q) / determinant;
            let t = dot(ac, q) / determinant;
            if u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > near && t < far {
                return true;
            }
        }
    }
    return false;
}

fn depth_at(pixel: vec2i, sample: i32) -> f32 {
    return textureLoad(depth, pixel, sample);
}

@compute @workgroup_size(8, 8)
fn cast_rays(@builtin(global_invocation_id) id: vec3u) {
    // x, y, width, height of the part of the image that is drawn.
    let region = frame.region;
    if id.x >= region.z || id.y >= region.w {
        return;
    }
    let pixel = vec2i(id.xy + region.xy);
    let light = lights[pass_values.light.x].position;
    var bits = 0u;
    for (var sample = 0; sample < SAMPLES; sample++) {
        let z = depth_at(pixel, sample);
        if z == 0.0 {
            continue;
        }
        let at = (vec2f(id.xy) + SAMPLE_PLACES) * frame.viewport.zw;
        let clip = vec4f(at.x * 2.0 - 1.0, 1.0 - at.y * 2.0, z, 1.0);
        let h = frame.rel_from_clip * clip;
        let seen = h.xyz / h.w;
        // The point is known to some roundings of its distance. It is asked so far before its
        // surface, where its own triangle is in the way of a light behind it.
        let back = select(-seen, -frame.view_axis.xyz * length(seen), frame.view_axis.w > 0.0);
        let rel = seen + 1e-5 * back;
        var way = light.xyz;
        var far = 1e30;
        if light.w > 0.0 {
            way = light.xyz - rel;
            far = 1.0;
        }
        if is_blocked(rel + frame.eye_in_rays.xyz, way, 0.0, far) {
            bits |= 1u << u32(sample);
        }
    }
    textureStore(mask, pixel, vec4u(bits, 0u, 0u, 0u));
}
