//! Line and point shapes as corners: two a segment, one a point.

use crate::registry::Class;
use crate::remarks::Remarks;

use super::Job;
use super::attributes::Attributes;
use super::corners::{Collector, Corners, Parts, Spot, Take};
use super::faces::runs;

fn bad_index(attributes: &Attributes<'_>, remarks: &mut Remarks) {
    remarks.warn(
        "bad-index",
        &format!(
            "{} uses a coordinate that does not exist",
            attributes.node.class_name()
        ),
        "what needs it was left out",
        attributes.pos,
    );
}

/// Segments of `LineSet` and `IndexedLineSet`. PER_PART counts segments, PER_FACE polylines.
pub fn segments(job: &Job<'_>, attributes: &Attributes<'_>, remarks: &mut Remarks) -> Corners {
    let indexed = job.class == Class::IndexedLineSet;
    let mut collector = Collector::new(attributes, indexed, Parts::Own);
    let mut spots: Vec<Spot> = Vec::new();
    let mut part = 0;
    let mut first_value = 0;
    if indexed {
        let list = attributes.ints("coordIndex");
        let (mut start, mut corner, mut face) = (0, 0, 0);
        while start < list.len() {
            let rest = &list[start..];
            let len = rest.iter().position(|&v| v < 0).unwrap_or(rest.len());
            spots.clear();
            spots.extend(rest[..len].iter().enumerate().map(|(i, &index)| Spot {
                part: 0,
                face,
                corner: corner + i,
                slot: start + i,
                coordinate: index as u32,
            }));
            polyline(&mut collector, &spots, &mut part, attributes, remarks);
            face += usize::from(len > 0);
            corner += len;
            start += len + 1;
        }
    } else {
        let (start, runs) = runs(attributes, "numVertices", remarks);
        first_value = start as u32;
        let mut corner = 0;
        for (face, &len) in runs.iter().enumerate() {
            spots.clear();
            spots.extend((corner..corner + len).map(|i| Spot {
                part: 0,
                face,
                corner: i,
                slot: i,
                coordinate: (start + i) as u32,
            }));
            polyline(&mut collector, &spots, &mut part, attributes, remarks);
            corner += len;
        }
    }
    finish(collector, 2, first_value)
}

fn polyline(
    collector: &mut Collector<'_>,
    spots: &[Spot],
    part: &mut usize,
    attributes: &Attributes<'_>,
    remarks: &mut Remarks,
) {
    for pair in spots.windows(2) {
        if pair
            .iter()
            .all(|s| collector.is_valid(i64::from(s.coordinate)))
        {
            for spot in pair {
                collector.push(&Spot {
                    part: *part,
                    ..*spot
                });
            }
        } else {
            bad_index(attributes, remarks);
        }
        *part += 1;
    }
}

/// Points of `PointSet` and its kin.
pub fn points(job: &Job<'_>, attributes: &Attributes<'_>, remarks: &mut Remarks) -> Corners {
    let indexed = matches!(job.class, Class::IndexedPointSet | Class::IndexedMarkerSet);
    let mut collector = Collector::new(attributes, indexed, Parts::Own);
    let mut first_value = 0;
    if indexed {
        for (i, &index) in attributes.ints("coordIndex").iter().enumerate() {
            if collector.is_valid(i64::from(index)) {
                collector.push(&Spot {
                    part: i,
                    face: i,
                    corner: i,
                    slot: i,
                    coordinate: index as u32,
                });
            } else if index >= 0 {
                bad_index(attributes, remarks);
            }
        }
    } else {
        let (start, runs) = runs(attributes, "numPoints", remarks);
        first_value = start as u32;
        for i in 0..runs.first().copied().unwrap_or(0) {
            collector.push(&Spot {
                part: i,
                face: i,
                corner: i,
                slot: i,
                coordinate: (start + i) as u32,
            });
        }
    }
    finish(collector, 1, first_value)
}

/// A texture on lines and points is not shown.
fn finish(collector: Collector<'_>, step: usize, first_value: u32) -> Corners {
    Corners {
        texcoords: Take::Nothing,
        ..collector.finish(step, first_value)
    }
}
