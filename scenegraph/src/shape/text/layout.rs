//! Where each glyph of a text stands: lines, justification, widths asked for. One glyph for each
//! character, from left to right as they are written: no ligatures, no kerning, no bidirectional
//! text, which Inventor has none of either.

use glam::DVec2;

/// Where a text stands along an axis, seen from its origin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Justify {
    /// Across lines only: the first line is on the origin.
    First,
    /// It begins there.
    Begin,
    /// Its middle is there.
    Middle,
    /// It ends there.
    End,
}

/// How lines are set. Inventor's texts are horizontal and run right and down; the rest is VRML 97's
/// `FontStyle`.
#[derive(Clone, Copy, Debug)]
pub struct Layout {
    /// Height of the font.
    pub size: f64,
    /// Distance of lines, in heights.
    pub spacing: f64,
    /// Along a line.
    pub major: Justify,
    /// Across the lines.
    pub minor: Justify,
    /// Lines are rows, not columns.
    pub horizontal: bool,
    /// Rows run, or columns follow each other, to the right.
    pub left_to_right: bool,
    /// Columns run, or rows follow each other, downward.
    pub top_to_bottom: bool,
    /// No line may be longer; 0 for no limit. Longer texts are compressed as a whole.
    pub max_extent: f64,
}

/// A line of characters that are drawn.
#[derive(Clone, Debug, Default)]
pub struct Line {
    /// Glyph numbers, and how far the next one stands, at size 1.
    pub glyphs: Vec<(u16, f64)>,
    /// Its length is to be this; 0 for as it comes.
    pub length: f64,
}

/// A glyph in its place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed {
    /// Its number.
    pub glyph: u16,
    /// Where its origin is.
    pub at: DVec2,
    /// Its size in both directions.
    pub scale: DVec2,
}

/// How far fonts reach above the base line, and below it, in heights.
const ASCENT: f64 = 0.8;
const DESCENT: f64 = 0.2;

/// Places the glyphs of all lines.
pub fn place(lines: &[Line], layout: &Layout) -> Vec<Placed> {
    let natural = |line: &Line| -> f64 {
        let steps = line.glyphs.iter().map(|(_, step)| layout.step(*step));
        steps.sum()
    };
    let stretch = |line: &Line| match (line.length, natural(line)) {
        (wanted, natural) if wanted > 0.0 && natural > 0.0 => wanted / natural,
        _ => 1.0,
    };
    let longest = lines
        .iter()
        .map(|line| natural(line) * stretch(line))
        .fold(0.0, f64::max);
    let compression = if layout.max_extent > 0.0 && longest > layout.max_extent {
        layout.max_extent / longest
    } else {
        1.0
    };
    let across = layout.start_across(lines.len());
    let mut placed = Vec::new();
    for (number, line) in lines.iter().enumerate() {
        let factor = stretch(line) * compression;
        let length = natural(line) * factor;
        let mut along = match layout.major {
            Justify::First | Justify::Begin => 0.0,
            Justify::Middle => -length / 2.0,
            Justify::End => -length,
        };
        let across = across + number as f64 * layout.spacing * layout.size;
        for &(glyph, step) in &line.glyphs {
            let next = along + layout.step(step) * factor;
            placed.push(layout.placed(glyph, step, [along, next], across, factor));
            along = next;
        }
    }
    placed
}

impl Layout {
    /// Inventor's: rows that follow each other downward, the first on the base line.
    pub fn rows(size: f64, spacing: f64, major: Justify) -> Self {
        Self {
            size,
            spacing,
            major,
            minor: Justify::First,
            horizontal: true,
            left_to_right: true,
            top_to_bottom: true,
            max_extent: 0.0,
        }
    }

    /// How far a glyph leads along its line: in columns all lead as far as the size.
    fn step(&self, advance: f64) -> f64 {
        if self.horizontal {
            advance * self.size
        } else {
            self.size
        }
    }

    /// Where the first line is, in the direction in which lines follow each other.
    fn start_across(&self, count: usize) -> f64 {
        let between = count.saturating_sub(1) as f64 * self.spacing * self.size;
        let (before, behind) = match (self.horizontal, self.top_to_bottom) {
            (true, true) => (ASCENT, DESCENT),
            (true, false) => (DESCENT, ASCENT),
            (false, _) => (0.5, 0.5),
        };
        match self.minor {
            Justify::First => 0.0,
            Justify::Begin => before * self.size,
            Justify::Middle => (before - behind) / 2.0 * self.size - between / 2.0,
            Justify::End => -behind * self.size - between,
        }
    }

    /// A glyph between two places along its line.
    fn placed(
        &self,
        glyph: u16,
        advance: f64,
        [begin, end]: [f64; 2],
        across: f64,
        factor: f64,
    ) -> Placed {
        let at = match (self.horizontal, self.left_to_right, self.top_to_bottom) {
            (true, true, down) => DVec2::new(begin, if down { -across } else { across }),
            (true, false, down) => DVec2::new(-end, if down { -across } else { across }),
            // In columns glyphs are centred, and stand on the lower end of their cells.
            (false, right, down) => {
                let middle = if right { across } else { -across };
                let low = if down { -end } else { begin };
                DVec2::new(
                    middle - advance * self.size / 2.0,
                    low + DESCENT * self.size * factor,
                )
            }
        };
        let scale = if self.horizontal {
            DVec2::new(self.size * factor, self.size)
        } else {
            DVec2::new(self.size, self.size * factor)
        };
        Placed { glyph, at, scale }
    }
}
