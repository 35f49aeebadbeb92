//! The walk: from the scene graph to the resolved scene.
//!
//! One generic traversal on an explicit stack. Groups that push restore the whole state, groups
//! that leak restore nothing, `TransformSeparator` the matrix only. Shapes are handed to `shape`,
//! results to the builder, which shares what is equal.

mod alternatives;
mod builder;
mod for_all;
mod hints;
mod labels;
mod lights;
mod limits;
mod profiles;
mod properties;
mod shapes;
mod state;
mod transforms;
mod variants;
mod vrml;
mod walk;

use std::sync::Arc;

use iv_parser::{Diagnostic, SourcePos};

use crate::graph::Graph;
use crate::remarks::Remarks;
use crate::scene::Scene;
use crate::shape::Measure;

pub use limits::ResolveLimits;
pub(crate) use state::{Binding, ColorSource, Ordering, ProfileList, State, Style, TexCoords};

/// How much of the geometry is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Geometry {
    /// Meshes.
    Build,
    /// Counts and bounds only: [`Resolved::measures`]. Each mesh is made and measured, none kept.
    Measure,
}

/// What to resolve and how.
#[derive(Clone, Copy, Debug)]
pub struct ResolveOptions {
    /// Make meshes, or only measure.
    pub geometry: Geometry,
    /// What Coin's SoCallbackAction makes of a file, where it differs from what is meant, to
    /// compare with it: `DrawStyle` plays no part, polygons are fanned even if they are concave,
    /// text in pixels and what stands in nodes of unknown classes is not drawn.
    pub like_coin: bool,
    /// The largest distance, in units of the scene, that segments and triangles may have to the
    /// NURBS curve or surface they stand for, wherever it is placed. Without it each shape's own
    /// size and its `Complexity` decide.
    pub chord: Option<f64>,
    /// Keep what the model has besides what it shows: children that a Switch hides, coarser levels
    /// of detail, looks that a Switch sets. They are marked in the scene ([`crate::scene::Shown`],
    /// [`crate::scene::Variant`]), which is for writers that know these marks; what is shown is the
    /// same as without.
    pub alternatives: bool,
    /// Limits.
    pub limits: ResolveLimits,
}

impl Default for ResolveOptions {
    fn default() -> Self {
        Self {
            geometry: Geometry::Build,
            like_coin: false,
            chord: None,
            alternatives: false,
            limits: ResolveLimits::default(),
        }
    }
}

/// A resolved scene, and what was wrong on the way.
#[derive(Clone, Debug)]
pub struct Resolved {
    /// The scene.
    pub scene: Scene,
    /// With [`Geometry::Measure`]: the size of each mesh; the scene then has none, and its
    /// instances count in this list.
    pub measures: Vec<Measure>,
    /// One for each kind of remark.
    pub diagnostics: Vec<Diagnostic>,
}

/// Resolves a graph.
pub fn resolve(graph: &Graph, options: &ResolveOptions) -> Resolved {
    let files: Vec<Arc<str>> = graph.files.iter().map(|f| Arc::clone(&f.name)).collect();
    let mut walk = walk::Walk::new(graph, options);
    walk.run();
    let (mut scene, measures, remarks) = walk.finish();
    scene.files = files;
    let diagnostics = remarks.into_diagnostics(&scene.files);
    if options.geometry == Geometry::Build {
        debug_assert_eq!(scene.check(), Vec::new());
    }
    Resolved {
        scene,
        measures,
        diagnostics,
    }
}

/// Says once that a class is read but not carried over.
fn not_supported(remarks: &mut Remarks, class: &str, pos: SourcePos) {
    remarks.warn(
        "not-supported",
        &format!("{class} is read, but not carried over by this version"),
        "see docs/NODES.md for what is",
        pos,
    );
}
