//! Where lights stand in the text, so that each reaches what it reaches in the scene.
//!
//! In Inventor a light reaches what comes after it in its Separator. So a light goes into the
//! innermost group around it that holds all it reaches, ahead of the members it reaches and behind
//! those it does not. Where members would have to be ahead of and behind each other, or a group is
//! reached in part, more is lit than in the scene, which is counted.

use rustc_hash::{FxHashMap, FxHashSet};

use crate::scene::{LightId, NodeId, Scene};

use super::groups::Member;

/// Most steps spent on finding out what reaches what; beyond, every light reaches all.
const MAX_STEPS: usize = 200_000_000;

/// Lights by the group that they stand in.
#[derive(Default)]
pub(super) struct Lights {
    at: FxHashMap<Option<NodeId>, Vec<Placed>>,
    /// Groups of lights that do not stand in the world.
    homes: FxHashMap<LightId, NodeId>,
    /// Members that lights reach which do not in the scene.
    pub(super) lit_by_more: usize,
}

/// A light and the members of its group that it does not reach.
struct Placed {
    light: LightId,
    not_reached: FxHashSet<Member>,
}

/// What is to be written of a group, in order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    Light(LightId),
    Member(Member),
}

impl Lights {
    /// `members` are those of each group, the world's last.
    pub(super) fn new(scene: &Scene, members: &[Vec<Member>]) -> Self {
        let mut lights = Self::default();
        let all = 0..scene.lights.len() as u32;
        let reaches_all = |set: &Vec<LightId>| set.iter().map(|l| l.0).eq(all.clone());
        let used = |i: usize| {
            scene
                .instances
                .iter()
                .any(|inst| inst.light_set.index() == i)
        };
        let simple =
            (scene.light_sets.iter().enumerate()).all(|(i, set)| reaches_all(set) || !used(i));
        let steps = scene.lights.len() * (scene.instances.len() + scene.nodes.len());
        if simple || steps > MAX_STEPS {
            let everywhere = all.map(|i| Placed {
                light: LightId(i),
                not_reached: FxHashSet::default(),
            });
            lights.lit_by_more = if simple { 0 } else { scene.instances.len() };
            lights.at.insert(None, everywhere.collect());
            return lights;
        }
        let totals = counts(scene, |_| true);
        for light in all.map(LightId) {
            lights.place(scene, members, light, &totals);
        }
        lights
    }

    fn place(&mut self, scene: &Scene, members: &[Vec<Member>], light: LightId, totals: &[usize]) {
        let in_set: Vec<bool> = (scene.light_sets.iter())
            .map(|set| set.contains(&light))
            .collect();
        let reaches = |i: usize| in_set[scene.instances[i].light_set.index()];
        let reached = counts(scene, reaches);
        let (world, all_reached) = (scene.nodes.len(), reached[scene.nodes.len()]);
        let mut home = scene.lights[light.index()].placement.node;
        while let Some(node) = home
            && reached[node.index()] != all_reached
        {
            home = scene.nodes[node.index()].parent;
        }
        let mut not_reached = FxHashSet::default();
        for &member in &members[home.map_or(world, NodeId::index)] {
            let (some, every) = match member {
                Member::Group(node) => {
                    let (reached, total) = (reached[node.index()], totals[node.index()]);
                    (reached > 0, reached == total)
                }
                Member::Item(i) => (reaches(i), reaches(i)),
            };
            if !some {
                not_reached.insert(member);
            } else if !every {
                self.lit_by_more += 1;
            }
        }
        self.homes.extend(home.map(|home| (light, home)));
        let placed = Placed { light, not_reached };
        self.at.entry(home).or_default().push(placed);
    }

    /// The group that a light stands in; `None` for the world.
    pub(super) fn home_of(&self, light: LightId) -> Option<NodeId> {
        self.homes.get(&light).copied()
    }

    /// The members of a group with its lights among them: those that few lights reach first.
    pub(super) fn order(&mut self, group: Option<NodeId>, members: &[Member]) -> Vec<Part> {
        let Some(lights) = self.at.remove(&group) else {
            return members.iter().copied().map(Part::Member).collect();
        };
        let missing = |member: &Member| {
            let without = |placed: &&Placed| placed.not_reached.contains(member);
            lights.iter().filter(without).count()
        };
        let mut sorted: Vec<(usize, Member)> = members.iter().map(|m| (missing(m), *m)).collect();
        sorted.sort_by_key(|(missing, _)| std::cmp::Reverse(*missing));
        let mut parts = Vec::with_capacity(members.len() + lights.len());
        let mut open: Vec<&Placed> = lights.iter().collect();
        for (missing, member) in sorted {
            open.retain(|placed| {
                let waits = placed.not_reached.contains(&member);
                if !waits {
                    parts.push(Part::Light(placed.light));
                }
                waits
            });
            self.lit_by_more += usize::from(open.len() < missing);
            parts.push(Part::Member(member));
        }
        parts.extend(open.iter().map(|placed| Part::Light(placed.light)));
        parts
    }
}

/// How many instances that `counts` each group holds, at any depth; the world last.
fn counts(scene: &Scene, counts: impl Fn(usize) -> bool) -> Vec<usize> {
    let world = scene.nodes.len();
    let mut sums = vec![0; world + 1];
    for (i, instance) in scene.instances.iter().enumerate() {
        let group = instance.placement.node.map_or(world, NodeId::index);
        sums[group] += usize::from(counts(i));
    }
    for (i, node) in scene.nodes.iter().enumerate().rev() {
        sums[node.parent.map_or(world, NodeId::index)] += sums[i];
    }
    sums
}
