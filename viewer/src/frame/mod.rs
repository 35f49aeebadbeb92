//! A frame as data: which passes, what each draws, what was left out and why.
//!
//! Pure: what is here can be read by tests without a device. `gpu` encodes it.

mod cull;
mod far_plane;
mod lists;
mod needs;
mod occlusion;
mod plan;
mod planner;
mod scissor;
mod settings;

pub use cull::Frustum;
pub use far_plane::{far_plane, is_cut, rel_plane};
pub use plan::{Draw, Pass, PassKind, Pixels, Plan, Skip, SkipReason, VolumeDraw};
pub use planner::plan;
pub use settings::{Extraction, Headlight, Occlusion, Settings, Shadows, VolumeMethod};
