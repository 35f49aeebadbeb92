// Shadow volumes by compute: facings once for each triangle, then sides by integers alone.

// An object and the parts of the shared arrays that are its own.
struct Job {
    // The light in the frame of the mesh, homogeneous.
    light: vec4f,
    // First triangle and number; first facing; object.
    triangles: vec4u,
    // First edge and number; first component's casting signs; 1 if mirrored.
    edges: vec4u,
}

struct Draws {
    // Vertex count, instance count, first vertex, first instance; for sides, caps that face the
    // light, caps that face away.
    sides: vec4u,
    cap_pos: vec4u,
    cap_neg: vec4u,
}

struct AtomicDraws {
    counts: array<atomic<u32>, 12>,
}

@group(0) @binding(0) var<storage, read> positions: array<vec4f>;
@group(0) @binding(1) var<storage, read> edges: array<vec4u>;
@group(0) @binding(2) var<storage, read> triangles: array<vec4u>;
@group(0) @binding(3) var<storage, read> refs: array<u32>;
@group(0) @binding(4) var<storage, read> jobs: array<Job>;
// For each workgroup: the job, and the first item in it.
@group(0) @binding(5) var<storage, read> groups: array<vec2u>;
// Which signs cast, for each component of each job: bit 0 for +1, bit 1 for -1.
@group(0) @binding(6) var<storage, read> casting: array<u32>;
@group(0) @binding(7) var<storage, read_write> facings: array<i32>;
@group(0) @binding(8) var<storage, read_write> entries: array<vec2u>;
@group(0) @binding(9) var<storage, read_write> draws: AtomicDraws;

// Where caps begin in entries; unused.
struct Places {
    first: vec4u,
}
@group(1) @binding(0) var<uniform> places: Places;

var<workgroup> wanted: array<atomic<u32>, 2>;
var<workgroup> begun: array<u32, 2>;

@compute @workgroup_size(64)
fn face(
    @builtin(workgroup_id) id: vec3u,
    @builtin(num_workgroups) count: vec3u,
    @builtin(local_invocation_index) local: u32,
) {
    let group = groups[id.y * count.x + id.x];
    let job = jobs[group.x];
    let item = group.y + local;
    var s = 0;
    if item < job.triangles.y {
        let triangle = triangles[job.triangles.x + item];
        let a = positions[triangle.x].xyz;
        let ab = positions[triangle.y].xyz - a;
        let ac = positions[triangle.z].xyz - a;
        let towards = job.light.xyz - a * job.light.w;
        s = i32(sign(dot(cross(ab, ac), towards)));
        s = select(s, -s, job.edges.w == 1u);
        let bit = select(select(0u, 1u, s > 0), 2u, s < 0);
        if (casting[job.edges.z + triangle.w] & bit) == 0u {
            s = 0;
        }
        facings[job.triangles.z + item] = s;
    }
    let is_pos = s > 0;
    let is_neg = s < 0;
    var slot = 0u;
    if is_pos {
        slot = atomicAdd(&wanted[0], 1u);
    } else if is_neg {
        slot = atomicAdd(&wanted[1], 1u);
    }
    workgroupBarrier();
    if local == 0u {
        begun[0] = atomicAdd(&draws.counts[4], 3u * atomicLoad(&wanted[0])) / 3u;
        begun[1] = atomicAdd(&draws.counts[8], 3u * atomicLoad(&wanted[1])) / 3u;
    }
    workgroupBarrier();
    let entry = vec2u(job.triangles.x + item, job.triangles.w);
    if is_pos {
        entries[places.first.x + begun[0] + slot] = entry;
    } else if is_neg {
        entries[places.first.y + begun[1] + slot] = entry;
    }
}

@compute @workgroup_size(64)
fn side(
    @builtin(workgroup_id) id: vec3u,
    @builtin(num_workgroups) count: vec3u,
    @builtin(local_invocation_index) local: u32,
) {
    let group = groups[places.first.z + id.y * count.x + id.x];
    let job = jobs[group.x];
    let item = group.y + local;
    var multiplicity = 0;
    if item < job.edges.y {
        let edge = edges[job.edges.x + item];
        for (var i = edge.z; i < edge.z + edge.w; i++) {
            let reference = refs[i];
            let s = facings[job.triangles.z + (reference >> 1u)];
            multiplicity += select(s, -s, (reference & 1u) == 1u);
        }
    }
    let copies = u32(abs(multiplicity));
    var slot = 0u;
    if copies > 0u {
        slot = atomicAdd(&wanted[0], copies);
    }
    workgroupBarrier();
    if local == 0u {
        begun[0] = atomicAdd(&draws.counts[0], 6u * atomicLoad(&wanted[0])) / 6u;
    }
    workgroupBarrier();
    let is_reversed = select(0u, 1u, multiplicity < 0);
    let entry = vec2u((job.edges.x + item) << 1u | is_reversed, job.triangles.w);
    for (var i = 0u; i < copies; i++) {
        entries[begun[0] + slot + i] = entry;
    }
}
