//! The part of the image that a view fills. Not the view itself: the same view fills regions of
//! any size.

/// A rectangle of the image, in pixels from its top left corner, and the aspect ratio of what is
/// drawn into it. Outside of it the image shows the background.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Region {
    /// Left edge.
    pub x: u32,
    /// Top edge.
    pub y: u32,
    /// At least 1.
    pub width: u32,
    /// At least 1.
    pub height: u32,
    /// Width over height of the view; not that of the rectangle where the view is stretched
    /// (`viewportMapping LEAVE_ALONE`). Positive and finite.
    pub aspect: f64,
}

impl Region {
    /// The whole image. A side of length 0 is taken as 1.
    #[must_use]
    pub fn whole(width: u32, height: u32) -> Self {
        let (width, height) = (width.max(1), height.max(1));
        Self {
            x: 0,
            y: 0,
            width,
            height,
            aspect: f64::from(width) / f64::from(height),
        }
    }

    /// Left, top, width, height.
    #[must_use]
    pub fn rectangle(&self) -> [u32; 4] {
        [self.x, self.y, self.width, self.height]
    }

    /// The largest rectangle of this aspect ratio in the middle of the image, as
    /// `SoCamera::getViewportBounds` makes it: one side is that of the image, the other is rounded
    /// to whole pixels, at least 1.
    #[must_use]
    pub fn cropped(width: u32, height: u32, aspect: f64) -> Self {
        let whole = Self::whole(width, height);
        if !(aspect > 0.0 && aspect.is_finite()) {
            return whole;
        }
        // The products are at most one side of the image; rounding keeps them in u32.
        let part =
            |side: u32, share: f64| ((f64::from(side) * share).round() as u32).clamp(1, side);
        let (width, height) = if aspect < whole.aspect {
            (part(whole.width, aspect / whole.aspect), whole.height)
        } else {
            (whole.width, part(whole.height, whole.aspect / aspect))
        };
        Self {
            x: (whole.width - width) / 2,
            y: (whole.height - height) / 2,
            width,
            height,
            aspect,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn crops_to_the_camera() {
        // Image size, camera's aspect, expected x, y, width, height.
        let rows = [
            ((400, 300), 4.0 / 3.0, [0, 0, 400, 300]),
            ((400, 300), 1.0, [50, 0, 300, 300]),
            ((300, 400), 1.0, [0, 50, 300, 300]),
            ((400, 300), 2.0, [0, 50, 400, 200]),
            ((400, 300), 0.5, [125, 0, 150, 300]),
            ((101, 7), 1.0, [47, 0, 7, 7]),
            ((400, 300), 1e9, [0, 149, 400, 1]),
            ((400, 300), 1e-300, [199, 0, 1, 300]),
            ((0, 0), 3.0, [0, 0, 1, 1]),
            ((u32::MAX, u32::MAX), 1.0, [0, 0, u32::MAX, u32::MAX]),
        ];
        for ((width, height), aspect, expected) in rows {
            let r = Region::cropped(width, height, aspect);
            assert_eq!([r.x, r.y, r.width, r.height], expected, "{aspect}");
            assert_eq!(r.aspect, aspect);
        }
    }

    #[test]
    fn an_aspect_that_is_none_crops_nothing() {
        for aspect in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(Region::cropped(40, 30, aspect), Region::whole(40, 30));
        }
    }
}
