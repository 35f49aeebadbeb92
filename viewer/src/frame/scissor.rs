//! The rectangle of the image that a sphere can fall into.

use glam::{DVec2, DVec3};

use crate::view::{Lens, Region, View};

/// Pixels around the rectangle, for the roundings of the device.
const MARGIN_PX: f64 = 2.0;

/// Left, top, width and height, in pixels of the image, of a rectangle that holds all of a sphere
/// that the view shows; `None` if it shows nothing of it. The whole region if the sphere reaches
/// behind the eye.
pub fn scissor(view: &View, region: &Region, center: DVec3, radius: f64) -> Option<[u32; 4]> {
    let center = view.p_in_view(center);
    // The box around the sphere, along the axes of the view.
    let (nearest, farthest) = (-center.z - radius, -center.z + radius);
    let scale = match view.lens {
        Lens::Orthographic { half_height } => [1.0 / half_height; 2],
        Lens::Perspective { tan_half_height } => {
            if farthest <= 0.0 {
                return None;
            }
            if nearest <= 0.0 {
                return Some(region.rectangle());
            }
            [nearest, farthest].map(|depth| 1.0 / (tan_half_height * depth))
        }
    };
    let half = DVec2::new(f64::from(region.width), f64::from(region.height)) * 0.5;
    let across = DVec2::new(1.0 / region.aspect, 1.0);
    let mut low = DVec2::INFINITY;
    let mut high = DVec2::NEG_INFINITY;
    for scale in scale {
        for sign in [-1.0, 1.0] {
            let corner = (center.truncate() + DVec2::splat(sign * radius)) * across * scale;
            low = low.min(corner);
            high = high.max(corner);
        }
    }
    // From y upwards around the middle to pixels downwards from the top.
    let from = DVec2::new(low.x, -high.y) * half + half - MARGIN_PX;
    let to = DVec2::new(high.x, -low.y) * half + half + MARGIN_PX;
    let from = from.floor().clamp(DVec2::ZERO, half * 2.0);
    let to = to.ceil().clamp(DVec2::ZERO, half * 2.0);
    // In the range of u32: clamped to the sides of the region.
    let [x, y] = [from.x as u32, from.y as u32];
    let [width, height] = [to.x as u32 - x, to.y as u32 - y];
    (width > 0 && height > 0).then_some([region.x + x, region.y + y, width, height])
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DQuat;

    #[test]
    fn rectangles_of_spheres() {
        let perspective = Lens::Perspective {
            tan_half_height: 0.5,
        };
        let parallel = Lens::Orthographic { half_height: 10.0 };
        let region = Region {
            x: 10,
            y: 20,
            width: 200,
            height: 100,
            aspect: 2.0,
        };
        let whole = Some([10, 20, 200, 100]);
        // Eye at the origin, looking along -Z: at depth 10 the image is 20 wide and 10 high.
        let rows = [
            // Box from -1 to 1 at depths 9 and 11: at depth 9 it is 1/9 of 9 wide.
            (
                perspective,
                DVec3::new(0.0, 0.0, -10.0),
                1.0,
                Some([10 + 86, 20 + 36, 28, 28]),
            ),
            (perspective, DVec3::new(0.0, 0.0, -1.0), 2.0, whole),
            (perspective, DVec3::new(0.0, 0.0, 10.0), 2.0, None),
            (perspective, DVec3::new(100.0, 0.0, -10.0), 1.0, None),
            (perspective, DVec3::new(0.0, 0.0, -10.0), 9.9, whole),
            (
                parallel,
                DVec3::new(0.0, 0.0, 50.0),
                2.0,
                Some([10 + 88, 20 + 38, 24, 24]),
            ),
            (
                parallel,
                DVec3::new(-20.0, 10.0, 0.0),
                2.0,
                Some([10, 20, 12, 12]),
            ),
            (parallel, DVec3::new(0.0, 20.0, 0.0), 2.0, None),
        ];
        for (lens, center, radius, expected) in rows {
            let view = View {
                eye: DVec3::ZERO,
                orientation: DQuat::IDENTITY,
                lens,
            };
            let got = scissor(&view, &region, center, radius);
            assert_eq!(got, expected, "{lens:?} {center} {radius}");
        }
    }
}
