//! Casters cut into smaller ones whose counts are bounded. The union of the shadows of parts
//! is the shadow of the whole, so each part may have a stencil buffer of its own.

use std::ops::Range;

use glam::{DAffine3, DVec4};

use crate::volume::extract::{Method, Volume, extract};
use crate::volume::facing::{CastRule, facing};
use crate::volume::layers::{LayerCaster, layer_bound};
use crate::volume::topology::CasterMesh;

/// Ranges of [`CasterMesh::triangles`] in order, none of them empty, that make up the whole:
/// [`CasterMesh::part`] of each has a [`layer_bound`] of at most `limit`, under the rule
/// given. A limit of 0 is taken as 1.
#[must_use]
pub fn split(mesh: &CasterMesh, light: DVec4, rule: CastRule, limit: u32) -> Vec<Range<usize>> {
    let whole = 0..mesh.triangles.len();
    bisect(whole, |range| {
        range.len() <= limit as usize || part_bound(&mesh.part(range), light, rule, limit) <= limit
    })
}

/// Halves a range until each piece fits or has length 1. For casters of one light it gives
/// the ones that may share a stencil buffer.
pub fn bisect(
    whole: Range<usize>,
    mut fits: impl FnMut(Range<usize>) -> bool,
) -> Vec<Range<usize>> {
    let mut pieces = Vec::new();
    let mut open = vec![whole];
    while let Some(range) = open.pop() {
        if range.is_empty() {
            continue;
        }
        if range.len() == 1 || fits(range.clone()) {
            pieces.push(range);
        } else {
            let middle = range.start.midpoint(range.end);
            open.push(middle..range.end);
            open.push(range.start..middle);
        }
    }
    pieces
}

fn part_bound(part: &CasterMesh, light: DVec4, rule: CastRule, limit: u32) -> u32 {
    let mut signs = Vec::new();
    facing(part, light, false, rule, &mut signs);
    let mut volume = Volume::default();
    extract(part, Method::Silhouette, &signs, light, false, &mut volume);
    let caster = LayerCaster {
        mesh: part,
        signs: &signs,
        sides: &volume.sides,
        frame_from_local: DAffine3::IDENTITY,
    };
    layer_bound(&[caster], light, limit)
}
