//! Glyphs as areas, each made once: from the font's outlines, in units of the font's size.

use std::sync::Arc;

use geometry::outline::{Area, Contour, Segment, fill, flatten, miters};
use glam::DVec2;
use rustc_hash::FxHashMap;
use ttf_parser::{Face, OutlineBuilder};

use crate::font::{self, AddedFont, FontId};

/// A glyph at size 1.
#[derive(Debug, Default)]
pub struct Glyph {
    /// What it covers, about its origin on the base line.
    pub area: Area,
    /// For each corner of the area where it goes when the border moves outward by one.
    pub miters: Vec<DVec2>,
}

/// Steps of the grid that outlines lie on, for each unit of the font: a power of two, so that the
/// font's own points, which are whole, stay where they are.
const GRID_STEPS: f64 = 4096.0;

/// Horizontal shift for each unit of height that makes an upright font italic: tan 12°.
const SLANT: f64 = 0.212_556_561_670_022_1;

/// Glyphs remembered; a model with more of them, or with very many complexities, has some made
/// again.
const MAX_REMEMBERED: usize = 16_384;

/// How far chords may miss a glyph's curves, in sizes of the font: 1/50 at complexity 0, 1/450 at
/// Inventor's default 0.5, 1/1250 at 1. The number of chords grows with the root of that, so round
/// letters have about as many sides as a Cylinder has slices.
pub fn tolerance(complexity: f64) -> f64 {
    0.02 / (1.0 + 4.0 * complexity.clamp(0.0, 1.0)).powi(2)
}

/// Glyphs made so far.
#[derive(Default)]
pub struct GlyphCache {
    glyphs: FxHashMap<(FontId, u16, u64), Arc<Glyph>>,
}

/// One font, opened to set a text in.
pub struct Typeface<'f> {
    id: FontId,
    face: Face<'f>,
    slants: bool,
}

impl<'f> Typeface<'f> {
    /// Opens a font; the built-in one if the bytes of an added one are none.
    pub fn open(id: FontId, added: &'f [AddedFont]) -> Option<Self> {
        let opened = |id: FontId| {
            let (bytes, index, slants) = font::data(id, added);
            let face = Face::parse(bytes, index).ok()?;
            Some(Self { id, face, slants })
        };
        opened(id).or_else(|| opened(FontId::BuiltIn(font::Style::default())))
    }

    /// The glyph number of a character; `None` if the font has none.
    pub fn glyph(&self, c: char) -> Option<u16> {
        self.face.glyph_index(c).map(|id| id.0)
    }

    /// How far the next glyph stands from this one, at size 1.
    pub fn advance(&self, glyph: u16) -> f64 {
        let units = self.face.glyph_hor_advance(ttf_parser::GlyphId(glyph));
        f64::from(units.unwrap_or(0)) / self.units_per_size()
    }

    fn units_per_size(&self) -> f64 {
        f64::from(self.face.units_per_em().max(1))
    }

    fn make(&self, glyph: u16, tolerance: f64) -> Glyph {
        let units = self.units_per_size();
        let mut outline = Outline {
            contours: Vec::new(),
            slant: if self.slants { SLANT } else { 0.0 },
        };
        let id = ttf_parser::GlyphId(glyph);
        if self.face.outline_glyph(id, &mut outline).is_none() {
            return Glyph::default();
        }
        let polylines: Vec<_> = outline
            .contours
            .iter()
            .map(|contour| flatten(contour, tolerance * units))
            .collect();
        let mut area = fill(&polylines, 1.0 / GRID_STEPS);
        for corner in &mut area.corners {
            corner.p /= units;
        }
        let miters = miters(&area);
        Glyph { area, miters }
    }
}

impl GlyphCache {
    /// A glyph, its curves missed by at most `tolerance` sizes.
    pub fn get(&mut self, face: &Typeface<'_>, glyph: u16, tolerance: f64) -> Arc<Glyph> {
        let key = (face.id, glyph, tolerance.to_bits());
        if let Some(known) = self.glyphs.get(&key) {
            return Arc::clone(known);
        }
        if self.glyphs.len() >= MAX_REMEMBERED {
            self.glyphs.clear();
        }
        let made = Arc::new(face.make(glyph, tolerance));
        self.glyphs.insert(key, Arc::clone(&made));
        made
    }
}

/// Collects what the font's reader draws.
struct Outline {
    contours: Vec<Contour>,
    slant: f64,
}

impl Outline {
    fn point(&self, x: f32, y: f32) -> DVec2 {
        let (x, y) = (f64::from(x), f64::from(y));
        DVec2::new(x + self.slant * y, y)
    }

    fn push(&mut self, segment: Segment) {
        if let Some(contour) = self.contours.last_mut() {
            contour.segments.push(segment);
        }
    }
}

impl OutlineBuilder for Outline {
    fn move_to(&mut self, x: f32, y: f32) {
        self.contours.push(Contour {
            start: self.point(x, y),
            segments: Vec::new(),
        });
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.push(Segment::Line(self.point(x, y)));
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        self.push(Segment::Quadratic(self.point(x1, y1), self.point(x, y)));
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        self.push(Segment::Cubic(
            self.point(x1, y1),
            self.point(x2, y2),
            self.point(x, y),
        ));
    }

    fn close(&mut self) {}
}
