// Depth as a light sees it; stands behind types.wgsl.

struct MapView {
    map_from_rel: mat4x4f,
}

@group(2) @binding(0) var<uniform> map_view: MapView;

@vertex
fn place_in_map(
    @builtin(instance_index) instance: u32,
    @location(0) position: vec3f,
) -> @builtin(position) vec4f {
    return map_view.map_from_rel * vec4f(rel_of(instance, position), 1.0);
}
