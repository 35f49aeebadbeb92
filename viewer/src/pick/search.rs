//! A walk through the objects and then through their meshes, with one of three goals.

use geometry::bounds::Aabb;
use geometry::num::gamma;
use glam::{DAffine3, DMat3, DVec3};
use scenegraph::scene::{Mesh, MeshId, Scene};

use super::PickOptions;
use super::aim::Aim;
use super::crossing::{Beside, beside_point, beside_segment, cross};
use super::mesh_boxes::MeshBoxes;
use crate::content::Primitive;
use crate::hierarchy::{Hierarchy, Node, Walk};

/// What picking asks of an object.
#[derive(Clone, Debug)]
pub struct Target {
    pub instance: u32,
    pub mesh: MeshId,
    pub primitive: Primitive,
    pub is_culled: bool,
    pub is_mirrored: bool,
    pub is_transparent: bool,
    pub world_from_mesh: DAffine3,
    pub bounds: Aabb,
    /// Half of the width of lines or the size of points.
    pub half_px: f64,
}

/// Something the ray meets or passes.
#[derive(Clone, Copy, Debug)]
pub struct Found {
    pub object: u32,
    pub primitive: u32,
    /// View depth.
    pub depth: f64,
    /// What the depth buffer holds for it.
    pub drawn_depth: f64,
    pub spot: Spot,
    /// See [`Beside`]; zero for triangles.
    pub offset_px: [f64; 2],
    pub outside_px: f64,
}

/// Where on a primitive.
#[derive(Clone, Copy, Debug)]
pub enum Spot {
    Triangle([f64; 3]),
    Segment(f64),
    Point,
}

/// What is looked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Goal {
    /// The nearest of all that is drawn at the pixel.
    Nearest,
    /// Of what is drawn there down to a depth, what covers the rest.
    TopDownTo(f64),
    /// Lines and points that are drawn within so many pixels, hidden or not.
    Around(f64),
}

/// Lines and points that are kept of those around a pixel: the nearest in the image.
const MOST_AROUND: usize = 64;

/// A walk.
pub struct Search<'a> {
    pub scene: &'a Scene,
    pub targets: &'a [Target],
    pub meshes: &'a mut [Option<Box<MeshBoxes>>],
    pub is_shown: &'a dyn Fn(u32) -> bool,
    pub options: &'a PickOptions,
    pub aim: &'a Aim,
    pub goal: Goal,
    /// Nothing farther away matters.
    limit: f64,
    /// At most one but for [`Goal::Around`].
    pub found: Vec<Found>,
}

impl<'a> Search<'a> {
    /// For a goal among the targets.
    pub fn new(
        (scene, targets): (&'a Scene, &'a [Target]),
        meshes: &'a mut [Option<Box<MeshBoxes>>],
        is_shown: &'a dyn Fn(u32) -> bool,
        options: &'a PickOptions,
        aim: &'a Aim,
        goal: Goal,
    ) -> Self {
        Self {
            scene,
            targets,
            meshes,
            is_shown,
            options,
            aim,
            goal,
            limit: match goal {
                Goal::TopDownTo(depth) => depth,
                _ => f64::INFINITY,
            },
            found: Vec::new(),
        }
    }

    /// Goes through `objects`, boxes relative to `origin`. `widest_px` is the largest half width of a
    /// line or point among them.
    pub fn run(&mut self, objects: &Hierarchy, origin: DVec3, widest_px: f64) {
        let gate = Gate::new(
            self.aim,
            &DAffine3::from_translation(origin),
            objects,
            widest_px + self.reach_px(),
        );
        objects.walk(&mut Objects { gate, search: self });
    }

    fn reach_px(&self) -> f64 {
        match self.goal {
            Goal::Around(tolerance_px) => tolerance_px,
            _ => 0.0,
        }
    }

    fn enter_object(&mut self, object: u32) {
        let Some(target) = self.targets.get(object as usize) else {
            return;
        };
        let is_stroke = target.primitive != Primitive::Triangles;
        let matters = match self.goal {
            Goal::Around(_) => is_stroke,
            // Without an image lines and points have no width.
            _ => !is_stroke || self.aim.source.is_some(),
        };
        if !matters || !(self.is_shown)(object) {
            return;
        }
        let Some(mesh) = self.scene.meshes.get(target.mesh.index()) else {
            return;
        };
        let Some(slot) = self.meshes.get_mut(target.mesh.index()) else {
            return;
        };
        // Taken out while it is walked through, and put back.
        let boxes = slot
            .take()
            .unwrap_or_else(|| Box::new(MeshBoxes::new(mesh)));
        let pad_px = if is_stroke {
            target.half_px + self.reach_px()
        } else {
            0.0
        };
        let gate = Gate::new(self.aim, &target.world_from_mesh, &boxes.boxes, pad_px);
        boxes.boxes.walk(&mut Primitives {
            gate,
            search: self,
            object,
            target,
            mesh,
            boxes: &boxes,
        });
        if let Some(slot) = self.meshes.get_mut(target.mesh.index()) {
            *slot = Some(boxes);
        }
    }

    fn offer(&mut self, found: Found, p_in_mesh: DVec3) {
        // The negation also drops what is no number.
        if !(found.drawn_depth >= self.aim.near && found.drawn_depth <= self.limit) {
            return;
        }
        let Some(target) = self.targets.get(found.object as usize) else {
            return;
        };
        if self.options.cut.is_some()
            && !self
                .options
                .shows(target.world_from_mesh.transform_point3(p_in_mesh))
        {
            return;
        }
        match self.goal {
            Goal::Around(tolerance_px) => {
                if found.outside_px <= tolerance_px {
                    let key = |f: &Found| (f.outside_px, f.drawn_depth);
                    let at = self.found.partition_point(|other| {
                        key(other) < key(&found)
                            || key(other) == key(&found) && self.covers(other, &found)
                    });
                    self.found.insert(at, found);
                    self.found.truncate(MOST_AROUND);
                }
            }
            _ if found.outside_px > 0.0 => {}
            Goal::Nearest => {
                let is_better = self.found.first().is_none_or(|best| {
                    found.drawn_depth < best.drawn_depth || self.covers(&found, best)
                });
                if is_better {
                    self.limit = found.drawn_depth;
                    self.found = vec![found];
                }
            }
            Goal::TopDownTo(_) => {
                if (self.found.first()).is_none_or(|best| self.covers(&found, best)) {
                    self.found = vec![found];
                }
            }
        }
    }

    /// Whether of two things in one place the first is seen: opaque things before transparent ones,
    /// the first drawn of opaque ones, as they hide what comes later at the same depth, and the last
    /// drawn of transparent ones, as it is blended over the others.
    fn covers(&self, a: &Found, b: &Found) -> bool {
        let target = |found: &Found| &self.targets[found.object as usize];
        let (of_a, of_b) = (target(a), target(b));
        if of_a.is_transparent != of_b.is_transparent {
            return of_b.is_transparent;
        }
        let draw_order = if a.object == b.object {
            std::cmp::Ordering::Equal
        } else if of_a.is_transparent {
            // The planner's: farthest centre first, then the order of the scene.
            let depth = |target: &Target| {
                let center = target.bounds.center();
                self.aim.forward().dot(center - self.aim.lines.ray.origin)
            };
            depth(of_b)
                .total_cmp(&depth(of_a))
                .then(of_a.instance.cmp(&of_b.instance))
        } else {
            a.object.cmp(&b.object)
        };
        let order = draw_order.then(a.primitive.cmp(&b.primitive));
        if of_a.is_transparent {
            order.is_gt()
        } else {
            order.is_lt()
        }
    }
}

/// A hierarchy's boxes in the frame of an aim.
struct Gate {
    aim_from_local: DMat3,
    /// Its absolute values, which give the extent of boxes (Arvo, Graphics Gems, 1990).
    extent: DMat3,
    offset: DVec3,
    /// Rounding of boxes and of what is in them.
    slack: DVec3,
    /// How far beside a box the ray may pass, pixels.
    pad_px: f64,
    is_perspective: bool,
    near: f64,
}

impl Gate {
    fn new(aim: &Aim, world_from_local: &DAffine3, boxes: &Hierarchy, pad_px: f64) -> Self {
        let (aim_from_local, offset) = aim_from(aim, world_from_local);
        let extent = aim_from_local.abs();
        let [low, high] = boxes.nodes.first().map_or([DVec3::ZERO; 2], |root| {
            [root.low, root.high].map(|p| DVec3::from_array(p.map(f64::from)))
        });
        // A corner is off by four roundings of the sum of absolute values, a box by five for its
        // middle, five for its extent and two for the comparison.
        let largest = extent * low.abs().max(high.abs()) + offset.abs();
        Self {
            aim_from_local,
            extent,
            offset,
            slack: largest * gamma(16),
            pad_px,
            is_perspective: aim.lines.is_perspective,
            near: aim.near,
        }
    }

    /// The least depth of a box that the ray meets. A box that is not finite is met by all.
    fn enter(&self, node: &Node) -> Option<f64> {
        let [low, high] = [node.low, node.high].map(|p| DVec3::from_array(p.map(f64::from)));
        if low.cmpgt(high).any() {
            return None;
        }
        let middle = self.aim_from_local * ((low + high) * 0.5) + self.offset;
        let half = self.extent * ((high - low) * 0.5) + self.slack;
        let farthest = middle.z + half.z;
        // Pixels grow with depth, so they are largest at the far end.
        let pad = match (self.pad_px > 0.0, self.is_perspective) {
            (false, _) => 0.0,
            (true, true) => self.pad_px * farthest,
            (true, false) => self.pad_px,
        };
        let is_beside =
            farthest < self.near || middle.x.abs() > half.x + pad || middle.y.abs() > half.y + pad;
        let nearest = middle.z - half.z;
        let nearest = if nearest.is_nan() {
            f64::NEG_INFINITY
        } else {
            nearest
        };
        (!is_beside).then_some(nearest)
    }
}

/// The map into the frame of an aim. The eye is subtracted first, so that nothing is lost far away
/// from the world's origin.
fn aim_from(aim: &Aim, world_from_local: &DAffine3) -> (DMat3, DVec3) {
    let lines = &aim.lines;
    (
        lines.aim_from_world * world_from_local.matrix3,
        lines.aim_from_world * (world_from_local.translation - lines.ray.origin),
    )
}

struct Objects<'s, 'a> {
    gate: Gate,
    search: &'s mut Search<'a>,
}

impl Walk for Objects<'_, '_> {
    fn enter(&mut self, node: &Node) -> Option<f64> {
        self.gate.enter(node)
    }

    fn is_wanted(&self, nearness: f64) -> bool {
        // There may be lines in it.
        self.search.aim.stroke_depth(nearness) <= self.search.limit
    }

    fn visit(&mut self, thing: u32) {
        self.search.enter_object(thing);
    }
}

struct Primitives<'s, 'a> {
    gate: Gate,
    search: &'s mut Search<'a>,
    object: u32,
    target: &'a Target,
    mesh: &'a Mesh,
    boxes: &'s MeshBoxes,
}

impl Primitives<'_, '_> {
    fn in_aim<const N: usize>(&self, corners: [DVec3; N]) -> [DVec3; N] {
        corners.map(|p| self.gate.aim_from_local * p + self.gate.offset)
    }

    fn triangle(&mut self, primitive: u32) {
        let Some(corners) = self.boxes.corners::<3>(self.mesh, primitive) else {
            return;
        };
        let Some(at) = cross(&self.in_aim(corners)) else {
            return;
        };
        let is_front = at.is_ccw != self.target.is_mirrored;
        if self.target.is_culled && !is_front {
            return;
        }
        let [a, b, c] = at.weights;
        let found = Found {
            object: self.object,
            primitive,
            depth: at.depth,
            drawn_depth: at.depth,
            spot: Spot::Triangle(at.weights),
            offset_px: [0.0; 2],
            outside_px: 0.0,
        };
        let p_in_mesh = corners[0] * a + corners[1] * b + corners[2] * c;
        self.search.offer(found, p_in_mesh);
    }

    fn stroke(&mut self, primitive: u32, beside: Beside, spot: Spot, p_in_mesh: DVec3) {
        let found = Found {
            object: self.object,
            primitive,
            depth: beside.depth,
            drawn_depth: self.search.aim.stroke_depth(beside.depth),
            spot,
            offset_px: beside.offset_px,
            outside_px: beside.outside_px,
        };
        self.search.offer(found, p_in_mesh);
    }

    fn segment(&mut self, primitive: u32) {
        let Some(ends) = self.boxes.corners::<2>(self.mesh, primitive) else {
            return;
        };
        let gate = &self.gate;
        let beside = beside_segment(
            self.in_aim(ends),
            self.target.half_px,
            gate.near,
            gate.is_perspective,
        );
        if let Some(beside) = beside {
            let p_in_mesh = ends[0].lerp(ends[1], beside.along);
            self.stroke(primitive, beside, Spot::Segment(beside.along), p_in_mesh);
        }
    }

    fn point(&mut self, primitive: u32) {
        let Some([p]) = self.boxes.corners::<1>(self.mesh, primitive) else {
            return;
        };
        let gate = &self.gate;
        let [place] = self.in_aim([p]);
        let beside = beside_point(place, self.target.half_px, gate.near, gate.is_perspective);
        if let Some(beside) = beside {
            self.stroke(primitive, beside, Spot::Point, p);
        }
    }
}

impl Walk for Primitives<'_, '_> {
    fn enter(&mut self, node: &Node) -> Option<f64> {
        self.gate.enter(node)
    }

    fn is_wanted(&self, nearness: f64) -> bool {
        let drawn = match self.target.primitive {
            Primitive::Triangles => nearness,
            Primitive::Lines | Primitive::Points => self.search.aim.stroke_depth(nearness),
        };
        drawn <= self.search.limit
    }

    fn visit(&mut self, thing: u32) {
        match self.target.primitive {
            Primitive::Triangles => self.triangle(thing),
            Primitive::Lines => self.segment(thing),
            Primitive::Points => self.point(thing),
        }
    }
}
