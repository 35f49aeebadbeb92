//! The scene as the options want it stored, before anything is planned: turned upright and measured
//! in metres, vertices shared, cut apart or put in order, positions on a grid.
//!
//! Without such options the scene is taken as it is, and nothing is copied.

mod grid;
mod lanes;
mod vertices;
mod world;

use std::borrow::Cow;

use scenegraph::scene::{Mesh, Scene};

use crate::formats::{Colors, Formats, Normals, Positions, Texcoords};
use crate::instancing::TOLERANCE_SHARE;
use crate::parallel;
use crate::{Error, Options, Quantize, Up, Weld, sound};

/// A scene ready to be planned.
pub(crate) struct Prepared<'s> {
    pub(crate) scene: Cow<'s, Scene>,
    /// By mesh of the scene.
    pub(crate) formats: Vec<Formats>,
}

impl<'s> Prepared<'s> {
    /// # Errors
    ///
    /// [`Error::Scene`] if the scene breaks one of its guarantees.
    pub(crate) fn new(scene: &'s Scene, options: &Options) -> Result<Self, Error> {
        sound::check(scene)?;
        if options.up == Up::Y && options.metres_per_unit == 1.0 && !touches_meshes(options) {
            return Ok(Self {
                formats: vec![Formats::default(); scene.meshes.len()],
                scene: Cow::Borrowed(scene),
            });
        }
        check_indices(scene)?;
        let mut turned = with_meshes(scene, Vec::new());
        world::turn(&mut turned, options);
        let frames = match options.quantize {
            Some(_) => grid::frames(&turned, scene.meshes.len()),
            None => vec![None; scene.meshes.len()],
        };
        let made = parallel::map(scene.meshes.len(), options.threads, |i| {
            let mut mesh = scene.meshes[i].clone();
            let formats = arrange(&mut mesh, frames[i].as_ref(), options);
            (mesh, formats)
        });
        let formats;
        (turned.meshes, formats) = made.into_iter().unzip();
        Ok(Self {
            scene: Cow::Owned(turned),
            formats,
        })
    }
}

fn touches_meshes(options: &Options) -> bool {
    let orders = options.optimize || options.compress;
    options.weld == Weld::Apart || orders || options.quantize.is_some()
}

/// Only those who follow indices lean on this.
fn check_indices(scene: &Scene) -> Result<(), Error> {
    let within = |mesh: &Mesh| {
        mesh.indices
            .iter()
            .all(|&i| (i as usize) < mesh.positions.len())
    };
    if scene.meshes.iter().all(within) {
        return Ok(());
    }
    Err(Error::Scene(
        "an index is not below the number of vertices".to_owned(),
    ))
}

/// All of a scene but its meshes, with these.
fn with_meshes(scene: &Scene, meshes: Vec<Mesh>) -> Scene {
    Scene {
        meshes,
        nodes: scene.nodes.clone(),
        instances: scene.instances.clone(),
        materials: scene.materials.clone(),
        textures: scene.textures.clone(),
        lights: scene.lights.clone(),
        cameras: scene.cameras.clone(),
        light_sets: scene.light_sets.clone(),
        environments: scene.environments.clone(),
        texts: scene.texts.clone(),
        variants: scene.variants.clone(),
        files: scene.files.clone(),
    }
}

fn arrange(mesh: &mut Mesh, frame: Option<&grid::Frame>, options: &Options) -> Formats {
    let formats = match (&options.quantize, frame) {
        (Some(quantize), Some(frame)) => quantized(mesh, frame, quantize, options),
        _ => Formats::default(),
    };
    match options.weld {
        // The scene's vertices are all different until they are rounded.
        Weld::Shared if options.quantize.is_some() => vertices::weld(mesh, &formats),
        Weld::Shared => {}
        Weld::Apart => vertices::cut_apart(mesh),
    }
    // The codec is made for triangles in such an order.
    if options.optimize || options.compress {
        vertices::order(mesh, options.compress);
    }
    if let (true, Positions::U16 { step }, Some(frame)) =
        (options.compress, formats.positions, frame)
    {
        lanes::settle(mesh, step, frame.instances());
    }
    formats
}

fn quantized(
    mesh: &mut Mesh,
    frame: &grid::Frame,
    quantize: &Quantize,
    options: &Options,
) -> Formats {
    let angle_rad = quantize.normal_tolerance_rad;
    // The rounding of copies' frames takes the rest.
    let share = if options.instancing {
        TOLERANCE_SHARE
    } else {
        0.0
    };
    let tolerance = quantize.tolerance * (1.0 - share);
    Formats {
        positions: grid::snap(mesh, frame, tolerance),
        normals: if options.compress {
            Normals::compressed_within(angle_rad)
        } else {
            Normals::within(angle_rad)
        },
        texcoords: Texcoords::holding(&mesh.texcoords),
        colors: Colors::holding(&mesh.colors_srgb),
    }
}
