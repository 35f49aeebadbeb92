//! What one pixel shows: the nearest opaque surface, the lights that reach it, and the glass in
//! front of it.

use glam::DVec3;

use super::Reference;
use super::camera::RefCamera;
use super::image::{Facet, RefImage};
use super::light::{Source, WorldLight};
use super::ray::Ray;
use super::shade::{Point, fogged};
use super::solid::{Hit, Triangle};

/// One pixel.
#[derive(Clone, Copy, Default)]
pub(super) struct Pixel {
    pub(super) color: DVec3,
    pub(super) object: Option<u32>,
    pub(super) lit: u128,
    pub(super) depth: f64,
    pub(super) facet: Facet,
    pub(super) layers: u64,
}

/// What stays the same for a picture.
pub(super) struct View<'a> {
    pub(super) camera: &'a RefCamera,
    pub(super) size: [u32; 2],
    pub(super) background: DVec3,
    /// View depth that stands for a visibility of 0.
    pub(super) far: f64,
    pub(super) headlight: WorldLight,
}

impl Reference<'_> {
    pub(super) fn pixel(&self, view: &View<'_>, [x, y]: [u32; 2]) -> Pixel {
        let at = [f64::from(x) + 0.5, f64::from(y) + 0.5];
        let ray = view.camera.ray(at, view.size);
        let mut pixel = Pixel {
            color: view.background,
            depth: f64::INFINITY,
            ..Pixel::default()
        };
        if let Some(hit) = self.opaque.nearest(&ray, |hit| self.opaque.is_seen(hit)) {
            self.opaque_pixel(view, at, &ray, hit, &mut pixel);
        }
        self.blend_transparent(view, &ray, &mut pixel);
        pixel
    }

    fn opaque_pixel(&self, view: &View<'_>, at: [f64; 2], ray: &Ray, hit: Hit, to: &mut Pixel) {
        let triangle = &self.opaque.triangles[hit.triangle as usize];
        let mut normal = triangle.normal().normalize_or_zero();
        if normal.dot(ray.direction) > 0.0 {
            normal = -normal;
        }
        let point = self.point(view, triangle, hit);
        let lit: Vec<bool> = (self.lights.iter())
            .map(|light| self.reaches(light.source, &point, normal))
            .collect();
        let bits = lit.iter().zip(0..u128::BITS);
        to.lit = bits.map(|(&lit, bit)| u128::from(lit) << bit).sum();
        to.object = Some(triangle.instance);
        to.depth = hit.at.t;
        to.facet = Facet {
            id: (triangle.instance, triangle.number),
            normal: normal.to_array(),
            next_depth: [[at[0] + 1.0, at[1]], [at[0], at[1] + 1.0]].map(|next| {
                let ray = view.camera.ray(next, view.size);
                (point.p_in_world - ray.origin).dot(normal) / ray.direction.dot(normal)
            }),
        };
        to.color = self.color(view, &point, |light| lit[light]).0;
    }

    /// Over-blends the transparent surfaces before the opaque one: objects from back to front by
    /// the centres of their boxes, within one the back faces first, then the triangles' order.
    fn blend_transparent(&self, view: &View<'_>, ray: &Ray, to: &mut Pixel) {
        let mut hits = self.transparent.all_before(ray, to.depth);
        let instance = |hit: &Hit| self.transparent.triangles[hit.triangle as usize].instance;
        let depth = |hit: &Hit| {
            let bounds = &self.objects[instance(hit) as usize].bounds;
            view.camera.view_depth(bounds.centre())
        };
        hits.sort_by(|a, b| {
            let nearer = depth(b).total_cmp(&depth(a));
            let key = |hit: &Hit| (instance(hit), hit.is_front, hit.triangle);
            nearer.then_with(|| key(a).cmp(&key(b)))
        });
        for hit in hits {
            let triangle = &self.transparent.triangles[hit.triangle as usize];
            let point = self.point(view, triangle, hit);
            let (color, alpha) = self.color(view, &point, |_| true);
            to.color = to.color.lerp(color, alpha);
            // FNV-1a over instances and sides.
            let layer = 2 * u64::from(triangle.instance) + u64::from(hit.is_front) + 1;
            to.layers = (to.layers ^ layer).wrapping_mul(0x0100_0000_01b3);
        }
    }

    fn point<'b>(&'b self, view: &View<'_>, triangle: &'b Triangle, hit: Hit) -> Point<'b> {
        let p_in_world = triangle.point(hit.at.weights);
        Point {
            object: &self.objects[triangle.instance as usize],
            triangle,
            hit,
            p_in_world,
            to_viewer: view.camera.towards_viewer(p_in_world),
            view_depth: hit.at.t,
        }
    }

    /// Colour in fog, and alpha. `lit` is asked for the scene's lights by number.
    fn color(
        &self,
        view: &View<'_>,
        point: &Point<'_>,
        lit: impl Fn(usize) -> bool,
    ) -> (DVec3, f64) {
        let object = point.object;
        let shaded = if self.lights.is_empty() {
            point.shaded([&view.headlight].into_iter())
        } else {
            let own = object.lights.iter().map(|id| id.index());
            point.shaded(own.filter(|&i| lit(i)).map(|i| &self.lights[i]))
        };
        let color = match &object.environment.fog {
            Some(fog) => fogged(shaded.truncate(), fog, point.view_depth, view.far),
            None => shaded.truncate(),
        };
        (color, shaded.w)
    }

    /// Whether light gets to the side of the surface where `normal` is.
    fn reaches(&self, source: Source, point: &Point<'_>, normal: DVec3) -> bool {
        if !self.shadows {
            return true;
        }
        let seen = if point.triangle.normal().dot(normal) < 0.0 {
            -1
        } else {
            1
        };
        if point.triangle.side_of(source, self.unit) == -seen {
            return false;
        }
        // Beyond doubt before what is coplanar.
        let start = point.p_in_world + normal * (4.0 * self.unit);
        !self.opaque.is_between(start, source, self.unit)
    }
}

/// Pixels to lists, clamped.
pub(super) fn assembled([width, height]: [u32; 2], pixels: &[Pixel]) -> RefImage {
    let clamped = |pixel: &Pixel| pixel.color.clamp(DVec3::ZERO, DVec3::ONE).to_array();
    RefImage {
        width,
        height,
        color: pixels.iter().map(clamped).collect(),
        object: pixels.iter().map(|pixel| pixel.object).collect(),
        lit: pixels.iter().map(|pixel| pixel.lit).collect(),
        depth: pixels.iter().map(|pixel| pixel.depth).collect(),
        facet: pixels.iter().map(|pixel| pixel.facet).collect(),
        layers: pixels.iter().map(|pixel| pixel.layers).collect(),
    }
}
