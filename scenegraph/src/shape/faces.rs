//! Polygon shapes as faces: which corners stand in which order. The values that they take are the
//! business of `corners`.

use crate::registry::Class;
use crate::remarks::Remarks;

use super::Job;
use super::attributes::Attributes;
use super::corners::{Collector, Corners, Parts, Spare, Spot};

/// The faces of a polygon shape; `None` if it has none.
pub fn faces(
    job: &Job<'_>,
    attributes: &Attributes<'_>,
    spare: Spare,
    remarks: &mut Remarks,
) -> Option<Corners> {
    let corners = match job.class {
        Class::IndexedFaceSet => indexed_faces(attributes, spare, remarks),
        Class::FaceSet => face_set(attributes, remarks),
        Class::IndexedTriangleStripSet => indexed_strips(attributes, remarks),
        Class::TriangleStripSet => strips(attributes, remarks),
        Class::QuadMesh => quads(attributes, remarks),
        _ => return None,
    };
    (!corners.coordinates.is_empty()).then_some(corners)
}

fn bad_index(attributes: &Attributes<'_>, what: &str, remarks: &mut Remarks) {
    remarks.warn(
        "bad-index",
        &format!(
            "{what} of {} uses a coordinate that does not exist",
            attributes.node.class_name()
        ),
        "it was left out",
        attributes.pos,
    );
}

fn too_small(attributes: &Attributes<'_>, remarks: &mut Remarks) {
    remarks.warn(
        "small-face",
        &format!(
            "a face of {} has fewer than three corners",
            attributes.node.class_name()
        ),
        "it was left out",
        attributes.pos,
    );
}

fn indexed_faces(attributes: &Attributes<'_>, spare: Spare, remarks: &mut Remarks) -> Corners {
    let list = attributes.ints("coordIndex");
    let mut collector = Collector::new(attributes, true, Parts::AreFaces).with(spare);
    let plain = collector.is_plain();
    let count = collector.coordinate_count as u64;
    collector.reserve(list.len() - list.len() / 4);
    let (mut face, mut corner, mut start) = (0, 0, 0);
    let mut only_triangles = true;
    while start < list.len() {
        let rest = &list[start..];
        let len = rest.iter().position(|&v| v < 0).unwrap_or(rest.len());
        let indices = &rest[..len];
        if len < 3 {
            if len > 0 && (len, start) != (1, 0) {
                too_small(attributes, remarks);
            }
        } else if indices.iter().any(|&v| v as u64 >= count) {
            bad_index(attributes, "a face", remarks);
        } else {
            if only_triangles && len != 3 {
                // From here on the ends are needed; those so far are multiples of three.
                only_triangles = false;
                let done = collector.coordinates.len() as u32;
                collector.ends.extend((3..=done).step_by(3));
            }
            if plain {
                collector
                    .coordinates
                    .extend(indices.iter().map(|&v| v as u32));
            } else {
                for (i, &index) in indices.iter().enumerate() {
                    collector.push(&Spot {
                        part: face,
                        face,
                        corner: corner + i,
                        slot: start + i,
                        coordinate: index as u32,
                    });
                }
            }
            if !only_triangles {
                collector.end_face();
            }
        }
        face += usize::from(len > 0);
        corner += len;
        start += len + 1;
    }
    collector.finish(3, 0)
}

/// The ranges that `numVertices` cuts the coordinates from `startIndex` on into: -1 takes all
/// that is left.
pub fn runs(
    attributes: &Attributes<'_>,
    field: &str,
    remarks: &mut Remarks,
) -> (usize, Vec<usize>) {
    let total = attributes.coordinate_count();
    let start = attributes.start_index().min(total);
    let mut left = total - start;
    let mut runs = Vec::new();
    for &count in attributes.ints(field) {
        let wanted = if count < 0 { left } else { count as usize };
        if wanted > left {
            remarks.warn(
                "short-coordinates",
                &format!(
                    "{} has fewer coordinates than it counts",
                    attributes.node.class_name()
                ),
                "what is there was used",
                attributes.pos,
            );
        }
        runs.push(wanted.min(left));
        left -= wanted.min(left);
        if left == 0 {
            break;
        }
    }
    (start, runs)
}

fn face_set(attributes: &Attributes<'_>, remarks: &mut Remarks) -> Corners {
    let (start, runs) = runs(attributes, "numVertices", remarks);
    let mut collector = Collector::new(attributes, false, Parts::AreFaces);
    let mut corner = 0;
    for (face, &len) in runs.iter().enumerate() {
        if len < 3 {
            too_small(attributes, remarks);
        } else {
            for i in corner..corner + len {
                collector.push(&Spot {
                    part: face,
                    face,
                    corner: i,
                    slot: i,
                    coordinate: (start + i) as u32,
                });
            }
            collector.end_face();
        }
        corner += len;
    }
    Corners {
        by_position: true,
        ..collector.finish(3, start as u32)
    }
}

/// Adds the triangles of a strip whose corners are the `spots`; every other one is turned.
fn strip(collector: &mut Collector<'_>, spots: &[Spot], face: &mut usize) {
    for (i, window) in spots.windows(3).enumerate() {
        let order = if i.is_multiple_of(2) {
            [0, 1, 2]
        } else {
            [1, 0, 2]
        };
        for k in order {
            collector.push(&Spot {
                face: *face,
                ..window[k]
            });
        }
        *face += 1;
    }
}

fn strips(attributes: &Attributes<'_>, remarks: &mut Remarks) -> Corners {
    let (start, runs) = runs(attributes, "numVertices", remarks);
    let mut collector = Collector::new(attributes, false, Parts::Own);
    let (mut corner, mut face) = (0, 0);
    for (part, &len) in runs.iter().enumerate() {
        if len < 3 {
            too_small(attributes, remarks);
        }
        let spots: Vec<Spot> = (corner..corner + len)
            .map(|i| Spot {
                part,
                corner: i,
                slot: i,
                coordinate: (start + i) as u32,
                face: 0,
            })
            .collect();
        strip(&mut collector, &spots, &mut face);
        corner += len;
    }
    Corners {
        by_position: true,
        ..collector.finish(3, start as u32)
    }
}

fn indexed_strips(attributes: &Attributes<'_>, remarks: &mut Remarks) -> Corners {
    let list = attributes.ints("coordIndex");
    let mut collector = Collector::new(attributes, true, Parts::Own);
    let (mut part, mut corner, mut face, mut start) = (0, 0, 0, 0);
    let mut spots = Vec::new();
    while start < list.len() {
        let rest = &list[start..];
        let len = rest.iter().position(|&v| v < 0).unwrap_or(rest.len());
        spots.clear();
        spots.extend(rest[..len].iter().enumerate().map(|(i, &index)| Spot {
            part,
            corner: corner + i,
            slot: start + i,
            coordinate: index as u32,
            face: 0,
        }));
        if len > 0 && len < 3 && (len, start) != (1, 0) {
            too_small(attributes, remarks);
        }
        if spots
            .iter()
            .all(|s| collector.is_valid(i64::from(s.coordinate)))
        {
            strip(&mut collector, &spots, &mut face);
        } else {
            bad_index(attributes, "a strip", remarks);
            face += len.saturating_sub(2);
        }
        part += usize::from(len > 0);
        corner += len;
        start += len + 1;
    }
    Corners {
        by_position: true,
        ..collector.finish(3, 0)
    }
}

fn quads(attributes: &Attributes<'_>, remarks: &mut Remarks) -> Corners {
    let node = attributes.node;
    let start = node.int("startIndex").max(0) as usize;
    let columns = node.int("verticesPerRow").max(0) as usize;
    let mut rows = node.int("verticesPerColumn").max(0) as usize;
    let available = attributes.coordinate_count().saturating_sub(start);
    if columns == 0 {
        rows = 0;
    } else if rows > available / columns {
        remarks.warn(
            "short-coordinates",
            "QuadMesh has fewer coordinates than its rows and columns need",
            "the whole rows that are there were used",
            attributes.pos,
        );
        rows = available / columns;
    }
    let mut collector = Collector::new(attributes, false, Parts::Own);
    for row in 1..rows {
        for column in 1..columns {
            let face = (row - 1) * (columns - 1) + column - 1;
            for (r, c) in [
                (row - 1, column - 1),
                (row, column - 1),
                (row, column),
                (row - 1, column),
            ] {
                let corner = r * columns + c;
                collector.push(&Spot {
                    part: row - 1,
                    face,
                    corner,
                    slot: corner,
                    coordinate: (start + corner) as u32,
                });
            }
            collector.end_face();
        }
    }
    Corners {
        by_position: true,
        always_smooth: true,
        ..collector.finish(4, start as u32)
    }
}
