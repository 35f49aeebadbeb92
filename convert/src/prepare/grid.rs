//! The grid that positions are rounded to.
//!
//! A point is at most half a step away from the grid along each axis, so at most √3/2 steps in
//! all. The step is the largest number of six significant bits with which that is within the
//! tolerance: its multiples are exact in f32 and f64, and it is at most 1/32 finer than need
//! be. A mesh that its instances stretch gets a grid finer by as much.
//!
//! All meshes that are not stretched share one step. Where a mesh's first instance is only moved,
//! the grid is that of the world, so meshes that touch there still do: points that were one stay
//! one. Elsewhere (parts turned in different ways, further instances) two points that were one are
//! at most twice the tolerance apart.

use glam::{DAffine3, DMat3, DVec3};
use scenegraph::scene::{Mesh, Scene};

use crate::formats::Positions;
use crate::frame::{STRETCH_TOLERANCE, stretch};

/// Finest and coarsest step: so that multiples of it stay normal, finite f32.
const STEP_RANGE: std::ops::RangeInclusive<f64> = 1e-30..=1e30;
/// Farthest grid line from the origin: adding [`ROUND`] rounds below it.
const MAX_LINE: f64 = (1_u64 << 50) as f64;
/// Adding and subtracting it rounds to the nearest whole number.
const ROUND: f64 = 6_755_399_441_055_744.0;
/// Most steps that are exact in f32 with the six bits of a step.
const MAX_F32_STEPS: f64 = (1_u32 << 18) as f64;

/// What the step costs as the scale of a node, in bytes of text.
pub(super) const SCALE_BYTES: u64 = 64;

/// How the instances of a mesh lie in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Frame {
    /// Bound of what lengths grow by in any instance.
    stretch: f64,
    /// The place of the first instance, if it is only moved.
    moved_by: DVec3,
    instances: u64,
}

impl Frame {
    /// How many there are.
    pub(super) fn instances(&self) -> u64 {
        self.instances
    }
}

/// The frame of each of the scene's `meshes` meshes; `None` where there is no instance.
pub(crate) fn frames(scene: &Scene, meshes: usize) -> Vec<Option<Frame>> {
    let mut frames: Vec<Option<Frame>> = vec![None; meshes];
    for instance in &scene.instances {
        let world_from_local = &instance.placement.world_from_local;
        let stretch = stretch(&world_from_local.matrix3);
        match &mut frames[instance.mesh.index()] {
            Some(known) => {
                known.stretch = known.stretch.max(stretch);
                known.instances += 1;
            }
            slot => {
                *slot = Some(Frame {
                    stretch,
                    moved_by: moved_by(world_from_local),
                    instances: 1,
                });
            }
        }
    }
    frames
}

fn moved_by(world_from_local: &DAffine3) -> DVec3 {
    if world_from_local.matrix3 == DMat3::IDENTITY {
        world_from_local.translation
    } else {
        DVec3::ZERO
    }
}

/// The largest step of six bits within a tolerance; `None` if there is none that f32 can tell.
fn step_within(tolerance: f64) -> Option<f64> {
    // As much less as stretches are taken for 1, and roundings.
    let largest = tolerance * (1.0 - 2.0 * STRETCH_TOLERANCE) * 2.0 / 3.0_f64.sqrt();
    if !STEP_RANGE.contains(&largest) {
        return None;
    }
    let binade = largest.log2().floor().exp2();
    let parts = (largest / binade * 32.0).floor();
    Some(parts / 32.0 * binade)
}

/// Puts positions on the grid, and gives the form that takes least room: floats where integers do
/// not save what the nodes of the instances need to say the step. Positions keep their own places
/// where the grid is too fine for f32.
pub(crate) fn snap(mesh: &mut Mesh, frame: &Frame, tolerance: f64) -> Positions {
    let Some(step) = step_within(tolerance / frame.stretch) else {
        return Positions::F32;
    };
    // Where the grid of the world stands between the lines of the mesh's own.
    let line = |v: DVec3| (v / step + ROUND) - ROUND;
    if !(frame.moved_by / step)
        .abs()
        .cmplt(DVec3::splat(MAX_LINE))
        .all()
    {
        return Positions::F32;
    }
    let shift = frame.moved_by - line(frame.moved_by) * step;
    let (min, max) = extent(mesh);
    let base = mesh.origin + shift;
    let (first, last) = ((base + min) / step, (base + max) / step);
    let reach = first.abs().max(last.abs());
    if !reach.cmplt(DVec3::splat(MAX_LINE)).all() {
        return Positions::F32;
    }
    let first = line(base + min);
    let steps = (line(base + max) - first).max_element();
    if steps > MAX_F32_STEPS {
        return Positions::F32;
    }
    let (form, saved_bytes) = if steps <= f64::from(u8::MAX) {
        (Positions::U8 { step: step as f32 }, 8)
    } else if steps <= f64::from(u16::MAX) {
        (Positions::U16 { step: step as f32 }, 4)
    } else {
        (Positions::F32, 0)
    };
    let pays = saved_bytes * mesh.positions.len() as u64 > SCALE_BYTES * frame.instances;
    let form = if pays { form } else { Positions::F32 };
    // Floats may as well stay where they are, which leaves the nodes as they are.
    let stays = form == Positions::F32
        && mesh.origin == DVec3::ZERO
        && shift == DVec3::ZERO
        && (reach.max_element() + 1.0) <= MAX_F32_STEPS;
    let first = if stays { DVec3::ZERO } else { first };
    let base = base.to_array();
    for position in &mut mesh.positions {
        for axis in 0..3 {
            let at = (base[axis] + f64::from(position[axis])) / step;
            let steps = ((at + ROUND) - ROUND) - first[axis];
            position[axis] = (steps * step) as f32;
        }
    }
    mesh.origin = first * step - shift;
    form
}

fn extent(mesh: &Mesh) -> (DVec3, DVec3) {
    let mut min = [f32::INFINITY; 3];
    let mut max = [f32::NEG_INFINITY; 3];
    for position in &mesh.positions {
        for axis in 0..3 {
            min[axis] = if position[axis] < min[axis] {
                position[axis]
            } else {
                min[axis]
            };
            max[axis] = if position[axis] > max[axis] {
                position[axis]
            } else {
                max[axis]
            };
        }
    }
    (
        DVec3::from(min.map(f64::from)),
        DVec3::from(max.map(f64::from)),
    )
}
