//! Lists of profiles. They share their beginnings, and equal lists are one, so that a list's number
//! says all about it.

use rustc_hash::FxHashMap;

use crate::graph::NodeId;

use super::state::ProfileList;

/// The most profiles that one shape may see.
const MAX_PROFILES: usize = 4096;

/// Holds all lists.
#[derive(Default)]
pub(super) struct Profiles {
    /// Each list: the one it continues, the profile it adds, and its length.
    lists: Vec<(ProfileList, NodeId, usize)>,
    known: FxHashMap<(ProfileList, NodeId), ProfileList>,
}

impl Profiles {
    /// The list with one more profile.
    pub fn add(&mut self, list: ProfileList, profile: NodeId) -> ProfileList {
        let length = self.get(list).map_or(0, |entry| entry.2) + 1;
        *self.known.entry((list, profile)).or_insert_with(|| {
            self.lists.push((list, profile, length));
            ProfileList(self.lists.len() as u32)
        })
    }

    /// The profiles of a list in order; `None` if there are more than a shape may see.
    pub fn nodes(&self, list: ProfileList) -> Option<Vec<NodeId>> {
        let mut nodes = Vec::new();
        let mut rest = list;
        while let Some(&(before, profile, length)) = self.get(rest) {
            if length > MAX_PROFILES {
                return None;
            }
            nodes.push(profile);
            rest = before;
        }
        nodes.reverse();
        Some(nodes)
    }

    fn get(&self, list: ProfileList) -> Option<&(ProfileList, NodeId, usize)> {
        self.lists.get((list.0 as usize).checked_sub(1)?)
    }
}
