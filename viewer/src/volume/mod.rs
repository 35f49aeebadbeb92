//! Shadow volumes on the CPU: which triangles of a mesh cast, and the sides and caps of the
//! volumes they cast. Pure functions on plain data; no graphics interface is known here.
//!
//! # Frames and signs
//!
//! Positions are those of the mesh, exactly as stored. A light is a homogeneous vector in the
//! same frame: `(x, y, z, w)` with `w != 0` is the point `(x, y, z) / w`, and `(x, y, z, 0)`
//! the direction *towards* a light at infinity. `mirrored` says that `world_from_local` has a
//! negative determinant: signs are then negated, so that all results are as seen in the world.
//!
//! The sign `s` of a triangle `(a, b, c)` is +1 if its corners run counter-clockwise seen from
//! the light, -1 if clockwise, 0 if it does not cast: the light is in its plane, the triangle
//! is degenerate, or the [`CastRule`] says that its component casts without it.
//!
//! # What a volume is
//!
//! Each casting triangle has a volume: the points that it separates from the light. The
//! volume's surface is the triangle itself (light cap), the triangle pushed away from the
//! light to infinity (dark cap), and three side quads. With `x' = (x * L_w - L_xyz, 0)`, the
//! point `x` pushed to infinity, an edge that runs `a -> b` along a triangle with `s = +1` has
//! the side triangles `(b, a, a')` and `(b, a', b')`. Along a triangle with `s = -1` it has
//! the same ones as if it ran `b -> a`. Counter-clockwise is front:
//!
//! | part | triangle drawn | front |
//! | --- | --- | --- |
//! | side, `reversed = 0` | `(b, a, a')`, `(b, a', b')` of the edge record `a < b` | CCW |
//! | side, `reversed = 1` | the same with `a` and `b` exchanged | CCW |
//! | light cap of `cap_pos` | the triangle as stored | CCW |
//! | light cap of `cap_neg` | the triangle as stored | CW |
//! | dark cap of `cap_pos` | `(a', b', c')` | CW |
//! | dark cap of `cap_neg` | `(a', b', c')` | CCW |
//!
//! Entering a volume is entering through a front face, and counts +1. The sides of all
//! triangles that meet in an edge are added up before they are drawn: opposite ones cancel.
//! What is left is still closed, because the boundary of a boundary is empty, whatever the
//! signs are. A light at infinity needs no dark caps: there all `x'` are one point.
//!
//! The count at a point is the number of casting triangles between it and the light. It is
//! never negative, and it is zero exactly at lit points.
//!
//! | module | what it answers |
//! | --- | --- |
//! | [`topology`] | the welded mesh with edges of any valence |
//! | [`component`] | connected components: are they closed, which winding numbers occur |
//! | [`mod@facing`] | the sign of each triangle |
//! | [`mod@extract`] | sides and caps, by one of three methods |
//! | [`layers`] | a bound of the count |
//! | [`mod@split`] | a mesh in parts whose counts are bounded |
//! | [`zpass`] | when, and from which value, to count from the near plane |
//! | [`cull`] | which volumes cannot be seen |

pub mod component;
pub mod cull;
mod exact;
pub mod extract;
pub mod facing;
pub mod layers;
mod light;
mod per_triangle;
mod reference_edge;
mod silhouette;
pub mod split;
pub mod topology;
mod winding;
pub mod zpass;

pub use component::Component;
pub use cull::volume_may_touch;
pub use extract::{Method, Volume, extract};
pub use facing::{CastRule, component_signs, facing};
pub use layers::{LayerCaster, layer_bound};
pub use split::{bisect, split};
pub use topology::CasterMesh;
pub use zpass::{count_at_infinity, zpass_is_safe};
