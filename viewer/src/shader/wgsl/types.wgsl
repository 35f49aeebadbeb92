// Shared by all shaders. The Rust side of each struct is in layout.rs, compared by a test.
// `rel` is the world's axes with the eye as origin: near the eye, f32 is exact enough there.

struct Frame {
    clip_from_rel: mat4x4f,
    // The way the eye looks; w = 1 for a parallel projection.
    view_axis: vec4f,
    // Width and height in pixels; their inverses.
    viewport: vec4f,
    // The eye in the frame of the ray structures (xyz).
    eye_in_rays: vec4f,
    // The inverse of clip_from_rel.
    rel_from_clip: mat4x4f,
    // x, y, width, height of the part of the image that is drawn.
    region: vec4u,
    // What lies before this plane, in rel, is cut away; zero: nothing.
    section: vec4f,
}

struct Instance {
    // Rows of the affine map from the mesh's stored positions.
    rel_from_mesh_x: vec4f,
    rel_from_mesh_y: vec4f,
    rel_from_mesh_z: vec4f,
    // Rows of the cofactor matrix; w unused.
    normal_x: vec4f,
    normal_y: vec4f,
    normal_z: vec4f,
    // Index of the surface; first entry and number of entries in light_lists; unused.
    ids: vec4u,
}

struct Surface {
    // Emitted and ambient light; alpha.
    constant: vec4f,
    // Diffuse colour; specular exponent.
    diffuse: vec4f,
    // Specular colour; line width in pixels.
    specular: vec4f,
    // Blend colour of the texture; point size in pixels.
    blend: vec4f,
    // Fog colour; 1 / visibility.
    fog: vec4f,
}

struct Light {
    // w = 1: where it is, in rel. w = 0: the unit vector towards it.
    position: vec4f,
    // The way a spot light looks; cosine of its half angle (-2: all ways).
    axis: vec4f,
    // Colour times intensity; spot exponent.
    color: vec4f,
    // Quadratic, linear, constant; 1 / (cosine of a spot's inner cone - that of its edge), or 0.
    attenuation: vec4f,
}

struct PassValues {
    // Index of the light; unused.
    light: vec4u,
    // Where shadow volumes end, in rel, its normal away from the scene; zero: nowhere.
    far_plane: vec4f,
}

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> instances: array<Instance>;
@group(0) @binding(2) var<storage, read> surfaces: array<Surface>;
@group(0) @binding(3) var<storage, read> lights: array<Light>;
@group(0) @binding(4) var<storage, read> light_lists: array<u32>;
@group(1) @binding(0) var<uniform> pass_values: PassValues;

// The one way from a stored position to the screen: equal input gives equal depth in every pass.
fn rel_of(i: u32, p: vec3f) -> vec3f {
    let h = vec4f(p, 1.0);
    return vec3f(
        dot(instances[i].rel_from_mesh_x, h),
        dot(instances[i].rel_from_mesh_y, h),
        dot(instances[i].rel_from_mesh_z, h),
    );
}

fn clip_of(rel: vec3f) -> vec4f {
    return frame.clip_from_rel * vec4f(rel, 1.0);
}
