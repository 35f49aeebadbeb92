//! A ray tracer in f64 for comparison with the renderer: what a picture of a scene must be.
//!
//! It shares no code with the renderer and uses other methods throughout: rays through the centres
//! of the pixels, hard shadows by rays, a hierarchy of boxes. It is not fast, has no multisampling
//! and no mipmaps, and leaves out lines and points, which have no size in the world.
//!
//! Colours are display-referred and stay so. A surface point lies on the side of its triangle that
//! the ray comes from: light from the other side does not reach it. Coplanar triangles do not shadow
//! each other, and a light in the plane of a triangle is not shadowed by it; both to within the
//! rounding of coordinates, see `Reference::rounding`.

mod bvh;
mod camera;
mod image;
mod light;
mod object;
mod ray;
mod shade;
mod solid;
mod texture;

pub use camera::{RefCamera, RefLens};
pub use image::{Facet, RefImage};
pub use ray::{Crossing, Ray};
pub use texture::{RefTexture, inline_textures};

use std::collections::BTreeMap;

use glam::DVec3;
use scenegraph::scene::{Scene, TextureId};

use bvh::Bounds;
use light::{Source, WorldLight};
use object::Object;
use shade::{Point, fogged};
use solid::{Hit, Solid, Triangle};

const THREADS: usize = 2;

/// What is drawn besides the scene.
#[derive(Clone, Debug)]
pub struct RefOptions {
    /// Whether anything casts shadows.
    pub shadows: bool,
    /// Pixels of the textures; those that are not here are not drawn. See [`inline_textures`].
    pub textures: BTreeMap<TextureId, RefTexture>,
}

impl RefOptions {
    /// Shadows, and the textures that are in the scene itself.
    pub fn of(scene: &Scene) -> Self {
        Self {
            shadows: true,
            textures: inline_textures(scene),
        }
    }
}

/// Renders one picture. For more of one scene see [`Reference`].
pub fn render(
    scene: &Scene,
    camera: &RefCamera,
    [width, height]: [u32; 2],
    background: [f64; 3],
    options: &RefOptions,
) -> RefImage {
    Reference::new(scene, options).render(camera, [width, height], background)
}

/// A scene made ready for rays.
pub struct Reference<'a> {
    objects: Vec<Object<'a>>,
    lights: Vec<WorldLight>,
    opaque: Solid,
    transparent: Solid,
    bounds: Bounds,
    shadows: bool,
}

/// One pixel.
#[derive(Clone, Copy, Default)]
struct Pixel {
    color: DVec3,
    object: Option<u32>,
    lit: u128,
    depth: f64,
    facet: Facet,
    layers: u64,
}

/// What stays the same for a picture.
struct View<'a> {
    camera: &'a RefCamera,
    size: [u32; 2],
    background: DVec3,
    /// See [`Reference::rounding`].
    unit: f64,
    /// View depth that stands for a visibility of 0.
    far: f64,
    headlight: WorldLight,
}

impl<'a> Reference<'a> {
    /// Takes over the triangles of the scene.
    pub fn new(scene: &'a Scene, options: &'a RefOptions) -> Self {
        let objects: Vec<_> = (scene.instances.iter())
            .map(|instance| Object::new(scene, instance, &options.textures))
            .collect();
        let mut bounds = Bounds::EMPTY;
        let mut triangles = [Vec::new(), Vec::new()];
        for (index, (object, instance)) in (0..).zip(objects.iter().zip(&scene.instances)) {
            bounds.join(&object.bounds);
            triangles[usize::from(object.is_transparent)].extend(object.triangles(instance, index));
        }
        let [opaque, transparent] = triangles.map(Solid::new);
        let lights = scene.lights.iter();
        Self {
            lights: lights.map(|light| WorldLight::new(scene, light)).collect(),
            objects,
            opaque,
            transparent,
            bounds,
            shadows: options.shadows,
        }
    }

    /// Renders one picture of `[width, height]` pixels over an opaque `background`.
    pub fn render(&self, camera: &RefCamera, size: [u32; 2], background: [f64; 3]) -> RefImage {
        let [width, height] = size.map(|n| n as usize);
        let view = View {
            camera,
            size,
            background: DVec3::from(background),
            unit: self.rounding(camera),
            far: self.far(camera),
            headlight: WorldLight::headlight(camera.forward),
        };
        let mut pixels = vec![Pixel::default(); width * height];
        let mut shares: [Vec<_>; THREADS] = [const { Vec::new() }; THREADS];
        for (y, row) in pixels.chunks_mut(width.max(1)).enumerate() {
            shares[y % THREADS].push((y as u32, row));
        }
        std::thread::scope(|scope| {
            for share in shares {
                scope.spawn(|| {
                    for (y, row) in share {
                        for (x, pixel) in (0..).zip(row) {
                            *pixel = self.pixel(&view, [x, y]);
                        }
                    }
                });
            }
        });
        assembled(size, &pixels)
    }

    /// The opaque triangle that a ray from `origin` along `direction` meets first on either side,
    /// drawn or not: its instance, and where.
    pub fn first_hit(&self, origin: DVec3, direction: DVec3) -> Option<(u32, Crossing)> {
        let hit = self
            .opaque
            .nearest(&Ray::new(origin, direction), |_| true)?;
        Some((self.triangle_of(&hit).instance, hit.at))
    }

    /// How far a surface point may be from where exact arithmetic would have it, in world units.
    ///
    /// A world coordinate is a sum of four rounded products of f64 values, a point within a
    /// triangle one of three, a ray's corner relative to its origin one more difference: each errs
    /// by a few units of 2^-53 of the largest coordinate there is, together below 16 in each axis.
    /// Shadow rays start 4 times as far before the surface, so that what is coplanar is behind.
    fn rounding(&self, camera: &RefCamera) -> f64 {
        let mut scale = camera.eye.abs().max_element();
        for light in &self.lights {
            if let Source::Point(p) = light.source {
                scale = scale.max(p.abs().max_element());
            }
        }
        let bounds = &self.bounds;
        if bounds.low.is_finite() && bounds.high.is_finite() {
            let corner = bounds.low.abs().max(bounds.high.abs());
            scale = scale.max(corner.max_element());
        }
        8.0 * f64::EPSILON * scale
    }

    /// Largest view depth of the corners of the box around the scene.
    fn far(&self, camera: &RefCamera) -> f64 {
        let Bounds { low, high } = self.bounds;
        let corner = DVec3::select(camera.forward.cmpge(DVec3::ZERO), high, low);
        camera.view_depth(corner)
    }

    fn triangle_of(&self, hit: &Hit) -> &Triangle {
        &self.opaque.triangles[hit.triangle as usize]
    }

    fn pixel(&self, view: &View<'_>, [x, y]: [u32; 2]) -> Pixel {
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
        let triangle = self.triangle_of(&hit);
        let mut normal = triangle.normal().normalize_or_zero();
        if normal.dot(ray.direction) > 0.0 {
            normal = -normal;
        }
        let point = self.point(view, triangle, hit);
        let lit: Vec<bool> = (self.lights.iter())
            .map(|light| self.reaches(light.source, &point, normal, view.unit))
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
    fn reaches(&self, source: Source, point: &Point<'_>, normal: DVec3, unit: f64) -> bool {
        if !self.shadows {
            return true;
        }
        let seen = if point.triangle.normal().dot(normal) < 0.0 {
            -1
        } else {
            1
        };
        if point.triangle.side_of(source, unit) == -seen {
            return false;
        }
        let start = point.p_in_world + normal * (4.0 * unit);
        !self.opaque.is_between(start, source, unit)
    }
}

/// Pixels to lists, clamped.
fn assembled([width, height]: [u32; 2], pixels: &[Pixel]) -> RefImage {
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
