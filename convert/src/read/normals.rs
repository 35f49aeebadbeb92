//! Normals as a scene wants them: of unit length, and flat where a file has none.

use glam::{DVec3, Vec3};
use scenegraph::scene::Mesh;

/// Within this of 1, the square of a length is that of a unit vector in f32 (three squares and two
/// sums, each within 2^-24, and the components' own rounding); the vector then stays as it is.
const UNIT_TOLERANCE: f32 = 2e-6;

/// The normal of what has none.
const SPARE: [f32; 3] = [0.0, 0.0, 1.0];

/// A normal at unit length; one without a direction becomes +Z.
pub(crate) fn unit_normal(normal: [f32; 3]) -> [f32; 3] {
    let length_squared = Vec3::from(normal).length_squared();
    if (length_squared - 1.0).abs() <= UNIT_TOLERANCE {
        return normal;
    }
    unit(DVec3::from(normal.map(f64::from)))
}

fn unit(v: DVec3) -> [f32; 3] {
    match v.try_normalize() {
        Some(v) => v.to_array().map(|x| x as f32),
        None => SPARE,
    }
}

/// Triangles with vertices of their own and the normals of their planes, as the glTF specification
/// (3.7.2.1) asks for where there are none.
pub(crate) fn flat(mesh: &Mesh) -> Mesh {
    let corner = |&i: &u32| i as usize;
    let (triangles, _) = mesh.indices.as_chunks::<3>();
    let normals = triangles.iter().flat_map(|triangle| {
        let [a, b, c] = triangle.map(|i| mesh.p_in_local(i));
        [unit((b - a).cross(c - a)); 3]
    });
    Mesh {
        positions: mesh
            .indices
            .iter()
            .map(|i| mesh.positions[corner(i)])
            .collect(),
        normals: normals.collect(),
        texcoords: spread(&mesh.texcoords, &mesh.indices),
        colors_srgb: spread(&mesh.colors_srgb, &mesh.indices),
        indices: (0..mesh.indices.len() as u32).collect(),
        ..*mesh
    }
}

/// An attribute for each corner; none if there is none.
fn spread<T: Copy>(values: &[T], indices: &[u32]) -> Vec<T> {
    if values.is_empty() {
        return Vec::new();
    }
    indices.iter().map(|&i| values[i as usize]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_get_unit_length() {
        for (normal, want) in [
            ([0.0, 1.0, 0.0], [0.0, 1.0, 0.0]),
            ([0.0, 0.0, -4.0], [0.0, 0.0, -1.0]),
            ([1e-30, 0.0, 0.0], [1.0, 0.0, 0.0]),
            ([3e38, 0.0, 0.0], [1.0, 0.0, 0.0]),
            ([0.0; 3], SPARE),
            ([f32::NAN, 1.0, 0.0], SPARE),
            ([f32::INFINITY, 1.0, 0.0], SPARE),
        ] {
            assert_eq!(unit_normal(normal), want, "{normal:?}");
        }
        // Not quite of unit length in f32, and kept to the bit.
        let kept = [0.577_350_3, 0.577_350_3, 0.577_350_3];
        assert_eq!(unit_normal(kept), kept);
    }
}
