//! Levels of detail: a group whose first child is what is always shown, the others its coarser
//! levels.

use crate::scene::{Coarser, NodeId, Scene};

use super::groups::{Member, Step};
use super::lights::Part;
use super::text::{Number, Text};

/// The parts of a group as steps, its levels in a group that chooses among them. Also how many
/// lights come to light more than they did: they stand ahead of all levels.
pub(super) fn steps(scene: &Scene, parts: Vec<Part>) -> (Vec<Step>, usize) {
    let level = |part: &Part| match part {
        Part::Member(Member::Group(node)) => scene.nodes[node.index()].level().map(|_| *node),
        Part::Member(Member::Item(_)) | Part::Light(_) => None,
    };
    let mut levels: Vec<NodeId> = parts.iter().filter_map(level).collect();
    if levels.is_empty() {
        return (parts.into_iter().map(Step::Part).collect(), 0);
    }
    levels.sort_unstable();
    let is_light = |part: &Part| matches!(part, Part::Light(_));
    let ahead = parts.iter().take_while(|part| is_light(part)).count();
    let (lights, members): (Vec<Part>, Vec<Part>) = parts.into_iter().partition(is_light);
    let finest = members.into_iter().filter(|part| level(part).is_none());
    let moved = lights.len() - ahead;
    let mut steps: Vec<Step> = lights.into_iter().map(Step::Part).collect();
    let group = |node: &NodeId| Step::Part(Part::Member(Member::Group(*node)));
    let limits = levels.iter();
    let limits = limits.filter_map(|node| scene.nodes[node.index()].level());
    steps.push(Step::Levels(limits.collect()));
    steps.push(Step::Separator);
    steps.extend(finest.map(Step::Part));
    steps.push(Step::Close);
    steps.extend(levels.iter().map(group));
    steps.push(Step::CloseChoice);
    (steps, moved)
}

/// Begins a group of levels with these limits.
pub(super) fn open(text: &mut Text, limits: &[Coarser]) {
    let distances = limits.iter().map_while(|limit| match limit {
        Coarser::Beyond(distance) => Some(*distance),
        Coarser::Below(_) | Coarser::Never => None,
    });
    let areas = limits.iter().map_while(|limit| match limit {
        Coarser::Below(area) => Some(*area),
        Coarser::Beyond(_) | Coarser::Never => None,
    });
    let (distances, areas): (Vec<f64>, Vec<f64>) = (distances.collect(), areas.collect());
    let (class, field, numbers) = if areas.is_empty() {
        ("LOD", "range", distances)
    } else {
        ("LevelOfDetail", "screenArea", areas)
    };
    text.open(None, class);
    if !numbers.is_empty() {
        text.list(
            field,
            numbers.into_iter().map(|number| [Number::field(number)]),
        );
    }
}
