//! From where the model is seen: decided as soon as the model is read, so that a wrong name costs
//! no drawing, and computed when its bounds are known.

use std::f64::consts::FRAC_PI_2;
use std::path::Path;

use convert::command::bytes;
use geometry::bounds::Aabb;
use glam::{DQuat, DVec3};
use scenegraph::scene::{Camera, Scene};
use viewer::view::framing::Up;
use viewer::view::{Region, View, find_camera, ivv, parse_look_at};

/// From where.
pub enum Viewpoint {
    /// A camera of the scene.
    Camera(Box<Camera>),
    /// A view of the user's.
    View(View),
    /// Where all is seen.
    Whole(Up),
}

impl Viewpoint {
    /// What `--camera` asks for, or the first camera, or all.
    ///
    /// # Errors
    ///
    /// No camera of this name or number, or seven numbers that are no view.
    pub fn choose(scene: &Scene, wanted: Option<&str>, up: Up) -> Result<Self, String> {
        match (find_camera(scene, wanted), wanted) {
            (Ok(Some(camera)), _) => Ok(Self::Camera(Box::new(camera.clone()))),
            (Err(_), Some(wanted)) if is_list(wanted) => {
                let view = parse_look_at(wanted).map_err(|error| error.to_string())?;
                Ok(Self::View(upright(view, up)))
            }
            (Err(error), _) => Err(error.to_string()),
            (Ok(None), _) => Ok(Self::Whole(up)),
        }
    }

    /// A saved view.
    ///
    /// # Errors
    ///
    /// The file cannot be read, or it is no saved view.
    pub fn saved(path: &Path) -> Result<Self, String> {
        let read = || {
            let bytes = bytes::read(path)?;
            ivv::read(&bytes).map_err(|error| error.to_string())
        };
        let saved = read().map_err(|why| format!("{}: {why}", path.display()))?;
        let view = View::look_at(saved.eye, saved.look_at, saved.opening_angle_deg);
        view.map(Self::View)
            .ok_or_else(|| format!("{}: it has no direction", path.display()))
    }

    /// The view in a picture of this size, and the part of it that it fills.
    pub fn view(&self, bounds: &Aabb, (width, height): (u32, u32)) -> (View, Region) {
        let region = Region::whole(width, height);
        match self {
            Self::Camera(camera) => View::from_scene_camera(camera, width, height),
            Self::View(view) => (*view, region),
            Self::Whole(up) => (View::of_whole(bounds, *up, region.aspect), region),
        }
    }
}

/// Whether a text is meant as numbers, not as a name or an index.
fn is_list(text: &str) -> bool {
    text.trim()
        .contains(|c: char| c.is_whitespace() || c == ',')
}

/// A view that was made with +Z up, with another way up and the same direction.
fn upright(view: View, up: Up) -> View {
    let z_up_from_world = match up {
        Up::Z => return view,
        Up::Y => DQuat::from_rotation_x(FRAC_PI_2),
    };
    let forward = z_up_from_world * view.forward();
    // The angle does not matter: only the orientation is taken.
    let turned = View::look_at(DVec3::ZERO, forward, 90.0);
    let orientation = turned.map_or(view.orientation, |turned| {
        z_up_from_world.conjugate() * turned.orientation
    });
    View {
        orientation,
        ..view
    }
}
