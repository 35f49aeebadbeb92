// Shadow volumes: positions are pulled by entries that name an edge or a triangle of an instance.

@group(2) @binding(0) var<storage, read> positions: array<vec4f>;
// Two welded vertices; the first and the number of its references.
@group(2) @binding(1) var<storage, read> edges: array<vec4u>;
// Three welded vertices; component.
@group(2) @binding(2) var<storage, read> triangles: array<vec4u>;
// Sides: edge << 1 | reversed, instance with CUT if its volume may end at the far plane. Caps:
// triangle, instance.
@group(2) @binding(3) var<storage, read> entries: array<vec2u>;

// Away from the light, at infinity.
fn far_of(rel: vec3f) -> vec4f {
    let light = lights[pass_values.light.x].position;
    return frame.clip_from_rel * vec4f(rel * light.w - light.xyz, 0.0);
}

struct Out {
    @builtin(position) @invariant clip: vec4f,
}

const CUT: u32 = 0x80000000u;

// Away from the light, on the far plane.
fn end_of(rel: vec3f) -> vec4f {
    let light = lights[pass_values.light.x].position;
    let plane = pass_values.far_plane;
    let way = rel * light.w - light.xyz;
    let t = -(dot(plane.xyz, rel) + plane.w) / dot(plane.xyz, way);
    return clip_of(rel + way * t);
}

// For z-pass: what is behind the far plane is never seen before.
@vertex
fn side_cut(@builtin(vertex_index) index: u32) -> Out {
    return side_of(index, any(pass_values.far_plane != vec4f(0.0)));
}

@vertex
fn side(@builtin(vertex_index) index: u32) -> Out {
    return side_of(index, false);
}

fn side_of(index: u32, has_end: bool) -> Out {
    let entry = entries[index / 6u];
    let edge = edges[entry.x >> 1u];
    let is_reversed = (entry.x & 1u) == 1u;
    let a = select(edge.x, edge.y, is_reversed);
    let b = select(edge.y, edge.x, is_reversed);
    // (b, a, a') and (b, a', b')
    let corner = index % 6u;
    let is_b = corner == 0u || corner == 3u || corner == 5u;
    let is_far = corner == 2u || corner == 4u || corner == 5u;
    let rel = rel_of(entry.y & ~CUT, positions[select(a, b, is_b)].xyz);
    if is_far {
        if has_end && (entry.y & CUT) != 0u {
            return Out(end_of(rel));
        }
        return Out(far_of(rel));
    }
    return Out(clip_of(rel));
}

fn cap_rel(index: u32) -> vec3f {
    let entry = entries[index / 3u];
    let triangle = triangles[entry.x];
    let corner = index % 3u;
    let vertex = select(select(triangle.z, triangle.y, corner == 1u), triangle.x, corner == 0u);
    return rel_of(entry.y, positions[vertex].xyz);
}

// For the eye: sides as they are counted.
@fragment
fn shown() -> @location(0) vec4f {
    return vec4f(0.15, 0.35, 1.0, 0.05);
}

@vertex
fn light_cap(@builtin(vertex_index) index: u32) -> Out {
    return Out(clip_of(cap_rel(index)));
}

@vertex
fn dark_cap(@builtin(vertex_index) index: u32) -> Out {
    return Out(far_of(cap_rel(index)));
}
