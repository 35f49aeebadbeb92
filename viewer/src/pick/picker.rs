//! Picking in a scene: what it keeps from ray to ray, and what it prefers.

use std::sync::Arc;

use geometry::bounds::Aabb;
use geometry::num::gamma;
use glam::DVec3;
use scenegraph::scene::Scene;

use super::aim::Aim;
use super::mesh_boxes::{MeshBoxes, world_boxes};
use super::search::{Found, Goal, Search, Spot, Target};
use super::{Hit, Part, PickOptions};
use crate::content::{Content, Object, Primitive};
use crate::hierarchy::Hierarchy;
use crate::view::{DepthRange, Region, View, direction};

/// Finds what lies under pixels. See the module's head.
#[derive(Debug)]
pub struct Picker {
    scene: Arc<Scene>,
    targets: Vec<Target>,
    boxes: Vec<Aabb>,
    objects: Hierarchy,
    /// What the boxes of `objects` are relative to.
    origin: DVec3,
    /// By mesh; made when a ray first comes near.
    meshes: Vec<Option<Box<MeshBoxes>>>,
    /// Half of the widest line or largest point, pixels.
    widest_px: f64,
}

/// Roundings of a depth relative to the largest coordinates it is made of: matrix, product, offset,
/// weights and sum take fewer than 32. Surfaces that are as near to each other as this are in one
/// place; more so where they are seen so flatly that a rounding across is more along the ray.
const SAME_PLACE: f64 = gamma(32);

impl Picker {
    /// Takes time for objects, not for triangles. `content` is that of `scene`.
    #[must_use]
    pub fn new(scene: Arc<Scene>, content: &Content) -> Self {
        let mut picker = Self {
            objects: world_boxes(&[], DVec3::ZERO),
            origin: DVec3::ZERO,
            meshes: scene.meshes.iter().map(|_| None).collect(),
            widest_px: 0.0,
            targets: Vec::new(),
            boxes: Vec::new(),
            scene,
        };
        picker.update(content);
        picker
    }

    /// Takes other content of the same scene, and keeps what it knows of meshes.
    pub fn update(&mut self, content: &Content) {
        let objects = content.objects.iter();
        self.targets = objects.map(|object| target(content, object)).collect();
        self.boxes = self.targets.iter().map(|target| target.bounds).collect();
        self.origin = content.bounds.center();
        self.objects = world_boxes(&self.boxes, self.origin);
        self.widest_px = self.targets.iter().fold(0.0, |most, t| t.half_px.max(most));
    }

    /// At a place of the image, in pixels from its top left corner: the centre of the first pixel
    /// is (0.5, 0.5). `None` where the view is not drawn.
    #[must_use]
    pub fn aim(&self, view: &View, region: &Region, pixel: [f64; 2]) -> Option<Aim> {
        let range = DepthRange::of(view, region.aspect, &self.boxes);
        Aim::through_pixel(view, region, range, pixel)
    }

    /// What is seen where `aim` points to, of the objects (indices into
    /// [`Content::objects`]) that `is_shown` lets pass.
    ///
    /// Triangles count where they are drawn: culled ones from the front only. Of surfaces in one
    /// place that one is hit that covers the others in the picture. Lines and points are hit within
    /// the width that they are drawn with, dashes and gaps alike, and as much nearer; with a
    /// tolerance also beside it. A mesh that a ray has not come near before takes n log n time,
    /// otherwise time grows with the logarithm of the numbers of objects and triangles.
    pub fn pick(
        &mut self,
        aim: &Aim,
        is_shown: impl Fn(u32) -> bool,
        options: &PickOptions,
    ) -> Option<Hit> {
        let is_shown: &dyn Fn(u32) -> bool = &is_shown;
        let nearest = self.search(aim, is_shown, options, Goal::Nearest).pop();
        let top = nearest.and_then(|nearest| {
            let limit = nearest.drawn_depth + self.same_place(aim, &nearest);
            let goal = Goal::TopDownTo(limit);
            let top = self.search(aim, is_shown, options, goal).pop();
            // A limit that is no number leaves nothing.
            top.or(Some(nearest))
        });
        let is_stroke = top.is_some_and(|top| !matches!(top.spot, Spot::Triangle(_)));
        let beside = (options.tolerance_px > 0.0 && !is_stroke)
            .then(|| self.beside(aim, is_shown, options))
            .flatten();
        self.hit(aim, &beside.or(top)?)
    }

    /// Bytes of memory that grow with the number of rays: at most 20 for each triangle, segment and
    /// point of the scene's meshes.
    #[must_use]
    pub fn mesh_bytes(&self) -> usize {
        let made = self.meshes.iter().flatten();
        made.map(|mesh| mesh.boxes.bytes()).sum()
    }

    /// The line or point nearest to the pixel in the image that is not hidden.
    fn beside(
        &mut self,
        aim: &Aim,
        is_shown: &dyn Fn(u32) -> bool,
        options: &PickOptions,
    ) -> Option<Found> {
        let goal = Goal::Around(options.tolerance_px);
        let around = self.search(aim, is_shown, options, goal);
        around.into_iter().find(|found| {
            let Some(there) = aim.moved(found.offset_px) else {
                return false;
            };
            let nearest = self.search(&there, is_shown, options, Goal::Nearest).pop();
            nearest.is_none_or(|nearest| {
                let doubt = self.same_place(&there, found);
                nearest.drawn_depth >= found.drawn_depth - doubt
                    || (nearest.object, nearest.primitive) == (found.object, found.primitive)
            })
        })
    }

    fn search(
        &mut self,
        aim: &Aim,
        is_shown: &dyn Fn(u32) -> bool,
        options: &PickOptions,
        goal: Goal,
    ) -> Vec<Found> {
        let scene: &Scene = &self.scene;
        let meshes = &mut self.meshes;
        let mut search = Search::new((scene, &self.targets), meshes, is_shown, options, aim, goal);
        search.run(&self.objects, self.origin, self.widest_px);
        search.found
    }

    /// See [`SAME_PLACE`], in world units.
    fn same_place(&self, aim: &Aim, found: &Found) -> f64 {
        let ray = aim.ray();
        let far = found.depth.abs() * aim.lines.distance_of_depth;
        SAME_PLACE * (ray.origin.abs().max_element() + far)
    }

    fn hit(&self, aim: &Aim, found: &Found) -> Option<Hit> {
        let target = self.targets.get(found.object as usize)?;
        let mesh = self.scene.meshes.get(target.mesh.index())?;
        let boxes = self.meshes.get(target.mesh.index())?.as_ref()?;
        let world = &target.world_from_mesh;
        let (p_in_mesh, part) = match found.spot {
            Spot::Triangle(weights) => {
                let corners = boxes.corners::<3>(mesh, found.primitive)?;
                let [a, b, c] = corners;
                // Differences are taken in the mesh, where they lose nothing.
                let [ab, ac] = [b - a, c - a].map(|e| world.transform_vector3(e));
                let normal = scaled(ab).cross(scaled(ac));
                let front = if target.is_mirrored { -normal } else { normal };
                let part = Part::Triangle {
                    corners: corners.map(|p| world.transform_point3(p)),
                    weights,
                    // Only what is all but a line has none.
                    normal: direction(front).unwrap_or(-aim.ray().direction),
                };
                (a * weights[0] + b * weights[1] + c * weights[2], part)
            }
            Spot::Segment(along) => {
                let ends = boxes.corners::<2>(mesh, found.primitive)?;
                let part = Part::Segment {
                    ends: ends.map(|p| world.transform_point3(p)),
                    along,
                };
                (ends[0].lerp(ends[1], along), part)
            }
            Spot::Point => {
                let [p] = boxes.corners::<1>(mesh, found.primitive)?;
                (p, Part::Point)
            }
        };
        Some(Hit {
            object: found.object,
            instance: target.instance,
            primitive: found.primitive,
            p_in_world: world.transform_point3(p_in_mesh),
            distance: found.depth * aim.lines.distance_of_depth,
            depth: found.depth,
            part,
        })
    }
}

/// Of about unit length, so that products stay in range.
fn scaled(v: DVec3) -> DVec3 {
    direction(v).unwrap_or(DVec3::ZERO)
}

fn target(content: &Content, object: &Object) -> Target {
    let half_px = content
        .surfaces
        .get(object.surface as usize)
        .map_or(0.0, |s| match object.look.primitive {
            Primitive::Triangles => 0.0,
            Primitive::Lines => 0.5 * s.line_width_px,
            Primitive::Points => 0.5 * s.point_size_px,
        });
    Target {
        instance: object.instance,
        mesh: object.mesh,
        primitive: object.look.primitive,
        is_culled: object.is_culled,
        is_mirrored: object.is_mirrored,
        is_transparent: object.look.is_transparent,
        world_from_mesh: object.world_from_mesh,
        bounds: object.bounds,
        half_px,
    }
}
