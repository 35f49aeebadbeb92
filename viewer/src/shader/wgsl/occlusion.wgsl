// Which boxes lie behind what is drawn: the farthest depth of each tile of the image, then each
// box against the tiles that it may touch. DEPTH_TYPE and SAMPLES are replaced.

struct Box {
    // Relative to the eye, along the world's axes.
    center: vec4f,
    half_size: vec4f,
}

struct Test {
    clip_from_rel: mat4x4f,
    // Image width and height, pixels; tiles a row, and rows of tiles.
    sizes: vec4u,
    // Pixels that things reach beyond their boxes; share of a depth, and depth, that roundings are
    // allowed.
    margins: vec4f,
    // Number of boxes.
    count: vec4u,
}

@group(0) @binding(0) var<uniform> test: Test;
@group(0) @binding(1) var depth: DEPTH_TYPE;
@group(0) @binding(2) var<storage, read_write> tiles: array<f32>;
@group(0) @binding(3) var<storage, read> boxes: array<Box>;
@group(0) @binding(4) var<storage, read_write> seen: array<u32>;

const TILE = 8u;

@compute @workgroup_size(8, 8)
fn farthest(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= test.sizes.zw) {
        return;
    }
    let low = id.xy * TILE;
    let high = min(low + TILE, test.sizes.xy);
    // Depth is reversed: what is far is small.
    var least = 1.0;
    for (var y = low.y; y < high.y; y++) {
        for (var x = low.x; x < high.x; x++) {
            for (var s = 0; s < SAMPLES; s++) {
                least = min(least, textureLoad(depth, vec2u(x, y), s));
            }
        }
    }
    tiles[id.y * test.sizes.z + id.x] = least;
}

var<workgroup> touches: atomic<u32>;

@compute @workgroup_size(64)
fn ask(
    @builtin(workgroup_id) id: vec3u,
    @builtin(num_workgroups) count: vec3u,
    @builtin(local_invocation_index) local: u32,
) {
    let index = id.y * count.x + id.x;
    if index >= test.count.x {
        return;
    }
    let center = boxes[index].center.xyz;
    let half_size = boxes[index].half_size.xyz;
    var low = vec2f(1e30);
    var high = vec2f(-1e30);
    var nearest = 0.0;
    var is_cut = false;
    for (var k = 0u; k < 8u; k++) {
        let side = vec3f(vec3u(k & 1u, (k >> 1u) & 1u, k >> 2u)) * 2.0 - 1.0;
        let p = test.clip_from_rel * vec4f(center + side * half_size, 1.0);
        // The near plane, or the eye, is in the box.
        is_cut = is_cut || !(p.w > 0.0) || !(p.z < p.w);
        let q = p.xyz / p.w;
        low = min(low, q.xy);
        high = max(high, q.xy);
        nearest = max(nearest, q.z);
    }
    let size = vec2f(test.sizes.xy);
    let top_left = (vec2f(low.x, -high.y) * 0.5 + 0.5) * size - test.margins.x;
    let bottom_right = (vec2f(high.x, -low.y) * 0.5 + 0.5) * size + test.margins.x;
    let last_pixel = size - 1.0;
    let first = vec2u(clamp(top_left, vec2f(0.0), last_pixel)) / TILE;
    let last = vec2u(clamp(bottom_right, vec2f(0.0), last_pixel)) / TILE;
    let limit = nearest + nearest * test.margins.y + test.margins.z;
    let columns = last.x - first.x + 1u;
    let tile_count = columns * (last.y - first.y + 1u);
    if is_cut {
        atomicStore(&touches, 1u);
    } else {
        for (var i = local; i < tile_count; i += 64u) {
            let tile = first + vec2u(i % columns, i / columns);
            if tiles[tile.y * test.sizes.z + tile.x] <= limit {
                atomicStore(&touches, 1u);
                break;
            }
        }
    }
    workgroupBarrier();
    if local == 0u {
        seen[index] = atomicLoad(&touches);
    }
}
