//! Strips, fans and loops as lists.

use gltf::json::mesh::Mode;
use scenegraph::scene::Topology;

/// The list that a mode becomes.
pub(crate) fn topology(mode: Mode) -> Topology {
    match mode {
        Mode::Points => Topology::Points,
        Mode::Lines | Mode::LineLoop | Mode::LineStrip => Topology::Lines,
        Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan => Topology::Triangles,
    }
}

/// Most indices that a list has for each of the source's.
pub(crate) fn growth(mode: Mode) -> u64 {
    match mode {
        Mode::Points | Mode::Lines | Mode::Triangles => 1,
        Mode::LineLoop | Mode::LineStrip => 2,
        Mode::TriangleStrip | Mode::TriangleFan => 3,
    }
}

/// The indices as a list (glTF specification, 3.7.2.1). An incomplete primitive at the end is left
/// out, and so are the triangles without area that join strips.
pub(crate) fn list(mode: Mode, mut indices: Vec<u32>) -> Vec<u32> {
    let whole = |indices: &mut Vec<u32>, step: usize| {
        indices.truncate(indices.len() - indices.len() % step);
    };
    match mode {
        Mode::Points => indices,
        Mode::Lines => {
            whole(&mut indices, 2);
            indices
        }
        Mode::Triangles => {
            whole(&mut indices, 3);
            indices
        }
        Mode::LineStrip => segments(&indices),
        Mode::LineLoop => {
            if let [first, _, .., _] = *indices {
                indices.push(first);
            }
            segments(&indices)
        }
        Mode::TriangleStrip => {
            let turned = |(i, &[a, b, c]): (usize, &[u32; 3])| match i % 2 {
                0 => [a, b, c],
                _ => [b, a, c],
            };
            triangles(indices.array_windows().enumerate().map(turned))
        }
        Mode::TriangleFan => match indices.split_first() {
            None => Vec::new(),
            Some((&center, rim)) => triangles(rim.array_windows().map(|&[a, b]| [a, b, center])),
        },
    }
}

fn segments(indices: &[u32]) -> Vec<u32> {
    let pairs = indices.array_windows::<2>();
    pairs.copied().collect::<Vec<_>>().into_flattened()
}

fn triangles(all: impl Iterator<Item = [u32; 3]>) -> Vec<u32> {
    let has_area = |&[a, b, c]: &[u32; 3]| a != b && b != c && c != a;
    all.filter(has_area).collect::<Vec<_>>().into_flattened()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_of_every_mode() {
        for (mode, indices, want) in [
            (Mode::Points, &[4, 5][..], &[4, 5][..]),
            (Mode::Lines, &[0, 1, 2, 3, 4], &[0, 1, 2, 3]),
            (Mode::LineStrip, &[7, 8, 9], &[7, 8, 8, 9]),
            (Mode::LineStrip, &[7], &[]),
            (Mode::LineLoop, &[7, 8, 9], &[7, 8, 8, 9, 9, 7]),
            (Mode::LineLoop, &[7, 8], &[7, 8]),
            (Mode::LineLoop, &[], &[]),
            (Mode::Triangles, &[0, 1, 2, 3], &[0, 1, 2]),
            (
                Mode::TriangleStrip,
                &[0, 1, 2, 3, 4],
                &[0, 1, 2, 2, 1, 3, 2, 3, 4],
            ),
            (Mode::TriangleStrip, &[0, 1, 1, 2, 3], &[1, 2, 3]),
            (Mode::TriangleFan, &[9, 1, 2, 3], &[1, 2, 9, 2, 3, 9]),
            (Mode::TriangleFan, &[9, 1], &[]),
            (Mode::TriangleFan, &[], &[]),
        ] {
            assert_eq!(list(mode, indices.to_vec()), want, "{mode:?} {indices:?}");
        }
    }
}
