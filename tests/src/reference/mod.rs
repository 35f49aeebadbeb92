//! A ray tracer in f64 for comparison with the renderer: what a picture of a scene must be.
//!
//! It shares no code with the renderer and uses other methods throughout: rays through the centres
//! of the pixels, hard shadows by rays, a hierarchy of boxes. It is not fast, has no multisampling
//! and no mipmaps, and leaves out lines and points, which have no size in the world.
//!
//! Colours are display-referred and stay so. A surface point lies on the side of its triangle that
//! the ray comes from: light from the other side does not reach it. Coplanar triangles do not shadow
//! each other, and a light in the plane of a triangle is not shadowed by it; both to within the
//! rounding of coordinates, see `solid::ROUNDING`.

mod bvh;
mod camera;
mod image;
mod light;
mod object;
mod pixel;
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
use light::WorldLight;
use object::Object;
use pixel::{Pixel, View, assembled};
use solid::{ROUNDING, Solid};

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
    /// How far a surface point may be from its triangle's plane, in world units.
    unit: f64,
    shadows: bool,
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
            unit: ROUNDING * largest_coordinate(&bounds),
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
        let ray = Ray::new(origin, direction);
        let hit = self.opaque.nearest(&ray, |_| true)?;
        let triangle = &self.opaque.triangles[hit.triangle as usize];
        Some((triangle.instance, hit.at))
    }

    /// Largest view depth of the corners of the box around the scene.
    fn far(&self, camera: &RefCamera) -> f64 {
        let Bounds { low, high } = self.bounds;
        let corner = DVec3::select(camera.forward.cmpge(DVec3::ZERO), high, low);
        camera.view_depth(corner)
    }
}

/// 0 for an empty box.
fn largest_coordinate(bounds: &Bounds) -> f64 {
    let Bounds { low, high } = *bounds;
    if low.is_finite() && high.is_finite() {
        low.abs().max(high.abs()).max_element()
    } else {
        0.0
    }
}
