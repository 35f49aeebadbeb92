//! What lies behind others is left out: which objects are drawn first, which are asked about, and
//! what stays of a plan when the answer is there. The asking itself is the device's.
//!
//! The picture stays the same to the bit: an object is left out only where all of its box lies
//! behind what has been drawn. What is left out still throws its shadows.

use super::plan::{Draw, Pass, PassKind, Plan, Skip, SkipReason};

impl Plan {
    /// All objects that a plan with a pass for the depth draws, ascending.
    pub fn objects_drawn(&self) -> Vec<u32> {
        let passes = self
            .passes
            .iter()
            .filter(|pass| matches!(pass.kind, PassKind::Depth { .. } | PassKind::Transparent));
        let draws = passes.flat_map(|pass| &pass.draws);
        let mut objects: Vec<u32> = draws.flat_map(|draw| draw.objects.clone()).collect();
        objects.sort_unstable();
        objects.dedup();
        objects
    }

    /// Takes the objects of `hidden` out of the pass for the depth, which the plan begins with, and
    /// gives them a pass behind it, unless pass 1 begins anew. False if there is no such pass.
    pub fn part_depth(&mut self, hidden: &[bool]) -> bool {
        let Some(first) = self.passes.first() else {
            return false;
        };
        if first.kind != (PassKind::Depth { begins: true }) {
            return false;
        }
        let mut rest = first.clone();
        let is_hidden = |i: u32| hidden.get(i as usize) == Some(&true);
        retain(&mut self.passes[0].draws, |i| !is_hidden(i));
        let is_used = |pass: &Pass| {
            matches!(
                pass.kind,
                PassKind::First {
                    has_depth: true,
                    ..
                }
            )
        };
        if self.passes.iter().any(is_used) {
            rest.kind = PassKind::Depth { begins: false };
            retain(&mut rest.draws, is_hidden);
            self.passes.insert(1, rest);
        }
        true
    }

    /// Leaves out objects of `hidden` behind the first pass, and passes that draw nothing then.
    pub fn leave_out(&mut self, hidden: &[bool]) {
        let is_shown = |i: u32| hidden.get(i as usize) != Some(&true);
        for pass in self.passes.iter_mut().skip(1) {
            if matches!(pass.kind, PassKind::Map { .. }) {
                continue;
            }
            let before = pass.object_count();
            retain(&mut pass.draws, is_shown);
            let count = before - pass.object_count();
            if count > 0 {
                let reason = SkipReason::Occluded;
                pass.skipped.push(Skip { reason, count });
                pass.skipped.sort_by_key(|skip| skip.reason);
            }
        }
        let draws_nothing: Vec<u32> = self
            .passes
            .iter()
            .filter_map(|pass| match pass.kind {
                PassKind::Light { light, .. } if pass.draws.is_empty() => Some(light),
                _ => None,
            })
            .collect();
        let is_needed = |pass: &Pass| match pass.kind {
            PassKind::Depth { begins: false } | PassKind::Transparent => !pass.draws.is_empty(),
            PassKind::Volumes { light }
            | PassKind::Map { light }
            | PassKind::Rays { light }
            | PassKind::Light { light, .. } => !draws_nothing.contains(&light),
            PassKind::Depth { begins: true } | PassKind::First { .. } => true,
        };
        self.passes.retain(is_needed);
        for light in draws_nothing {
            self.skipped_lights
                .push((light, SkipReason::LightReachesNothing));
        }
        self.skipped_lights.sort_unstable();
    }
}

/// Keeps some objects of draws, in their order; what is no longer consecutive is drawn apart.
fn retain(draws: &mut Vec<Draw>, keeps: impl Fn(u32) -> bool) {
    let mut kept: Vec<Draw> = Vec::with_capacity(draws.len());
    for draw in draws.drain(..) {
        let mut start = draw.objects.start;
        for end in draw.objects.start..=draw.objects.end {
            if end < draw.objects.end && keeps(end) {
                continue;
            }
            if start < end {
                kept.push(Draw {
                    objects: start..end,
                    ..draw.clone()
                });
            }
            start = end + 1;
        }
    }
    *draws = kept;
}
