//! Measuring between points that are clicked.

use egui::{Grid, Ui};
use glam::DVec3;

use super::state::App;

/// Points that were clicked.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Measure {
    /// Whether clicks set points.
    pub is_active: bool,
    /// In the world.
    pub points: Vec<DVec3>,
}

/// What the points say.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Measured {
    /// Between the last two points.
    pub distance: Option<f64>,
    /// From the first to the last, along all.
    pub length: Option<f64>,
    /// At the last but one point, degrees.
    pub angle_deg: Option<f64>,
    /// Of the polygon through all points; its projection onto its mean plane if it is not flat.
    pub area: Option<f64>,
}

impl Measure {
    /// What the points say.
    pub fn results(&self) -> Measured {
        let points = &self.points;
        let mut steps = points.windows(2).map(|pair| pair[0].distance(pair[1]));
        let angle = points.last_chunk::<3>().and_then(|[a, b, c]| {
            let (to_a, to_c) = ((a - b).try_normalize()?, (c - b).try_normalize()?);
            // The arc tangent is exact for small angles, the arc cosine is not.
            Some(to_a.cross(to_c).length().atan2(to_a.dot(to_c)).to_degrees())
        });
        let area = (points.len() > 2).then(|| {
            let from = points[0];
            let twice: DVec3 = points
                .windows(2)
                .map(|pair| (pair[0] - from).cross(pair[1] - from))
                .sum();
            twice.length() * 0.5
        });
        Measured {
            length: (points.len() > 2).then(|| steps.clone().sum()),
            distance: steps.next_back(),
            angle_deg: angle,
            area,
        }
    }
}

impl App {
    pub(super) fn measure_panel(&mut self, ui: &mut Ui) {
        let measured = self.measure.results();
        Grid::new("measured").num_columns(2).show(ui, |ui| {
            let mut row = |name: &str, value: Option<f64>, unit: &str| {
                if let Some(value) = value {
                    ui.label(name);
                    ui.monospace(format!("{}{unit}", significant(value)));
                    ui.end_row();
                }
            };
            row("Distance", measured.distance, "");
            row("Length of all", measured.length, "");
            row("Angle", measured.angle_deg, "°");
            row("Area", measured.area, "");
        });
        if let Some([a, b]) = self.measure.points.last_chunk::<2>() {
            let d = *b - *a;
            ui.monospace(format!("Δ {:.6} {:.6} {:.6}", d.x, d.y, d.z));
        }
        ui.horizontal(|ui| {
            ui.weak(format!(
                "{} points; click to add",
                self.measure.points.len()
            ));
            if ui.button("Clear").clicked() {
                self.measure.points.clear();
            }
        });
    }
}

/// Seven digits: what f32 positions hold.
pub(super) fn significant(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    let digits = 6 - value.abs().log10().floor() as i32;
    format!("{value:.*}", digits.clamp(0, 12) as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_angles_and_areas() {
        let far = DVec3::new(2.6e6, 1.2e6, 0.0);
        for from in [DVec3::ZERO, far] {
            let mut measure = Measure::default();
            assert_eq!(measure.results(), Measured::default());
            let corners = [
                (0.0, 0.0, 0.0),
                (3.0, 0.0, 0.0),
                (3.0, 4.0, 0.0),
                (0.0, 4.0, 0.0),
            ];
            for (x, y, z) in corners {
                measure.points.push(from + DVec3::new(x, y, z));
            }
            let measured = measure.results();
            assert_eq!(measured.distance, Some(3.0));
            assert_eq!(measured.length, Some(10.0));
            assert_eq!(measured.angle_deg, Some(90.0));
            assert_eq!(measured.area, Some(12.0));
        }
        let same = Measure {
            is_active: true,
            points: vec![DVec3::ONE; 3],
        };
        let measured = same.results();
        assert_eq!(
            (measured.distance, measured.angle_deg, measured.area),
            (Some(0.0), None, Some(0.0))
        );
        assert_eq!(significant(1_234.567_891), "1234.568");
        assert_eq!(significant(0.000_123_456_78), "0.0001234568");
    }
}
