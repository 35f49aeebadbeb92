//! The picture, with what is known about each pixel besides its colour.

/// A rendered picture; row 0 is the top row, and all lists have `width * height` entries.
#[derive(Clone, Debug, PartialEq)]
pub struct RefImage {
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
    /// Display-referred, 0 to 1.
    pub color: Vec<[f64; 3]>,
    /// Index of the nearest opaque instance.
    pub object: Vec<Option<u32>>,
    /// Bit `i`: the light `i` of the scene is not shadowed at the opaque surface point, whether or
    /// not it shines there. 0 where there is no surface; lights from the 129th on have no bit.
    pub lit: Vec<u128>,
    /// View depth of the opaque surface; infinite where there is none.
    pub depth: Vec<f64>,
    /// Triangle of the opaque surface; all zero where there is none.
    pub facet: Vec<Facet>,
    /// Stands for the list of transparent surfaces before the opaque one; 0 if there are none.
    pub layers: Vec<u64>,
}

/// The triangle seen in a pixel, and its plane.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Facet {
    /// Index of the instance, and number of the triangle in its mesh.
    pub id: (u32, u32),
    /// Unit normal towards the viewer, in the world.
    pub normal: [f64; 3],
    /// View depths of the plane one pixel to the right, and one pixel down.
    pub next_depth: [f64; 2],
}

/// Two neighbouring pixels whose normals differ by more than this are on different surfaces: the
/// cosine of 30 degrees. A sphere of 100 pixels' radius turns by that only in its outermost pixel.
const SAME_SURFACE_COSINE: f64 = 0.866;
/// How many times the larger slope of the two planes a step in depth may be before it is a jump.
const SLOPES: f64 = 4.0;

impl RefImage {
    /// The colours as bytes, three a pixel.
    pub fn bytes(&self) -> Vec<u8> {
        let byte = |value: f64| (255.0 * value).round() as u8;
        self.color
            .iter()
            .flatten()
            .map(|&value| byte(value))
            .collect()
    }

    /// Pixels with something in the (2 `radius` + 1)² pixels around them where a correct picture
    /// may differ: an edge of an object, of a shadow, or of a part in front of another.
    pub fn near_edge(&self, radius: u32) -> Vec<bool> {
        self.near_edge_of(radius, u128::MAX)
    }

    /// As [`RefImage::near_edge`], with the shadows of these lights only.
    pub fn near_edge_of(&self, radius: u32, lights: u128) -> Vec<bool> {
        if radius == 0 {
            return vec![false; self.color.len()];
        }
        // The pixels around one differ if and only if two adjacent ones of them do, and of two
        // adjacent ones one is at most radius - 1 away.
        let edge = self.edges(lights);
        let [width, height] = [self.width as usize, self.height as usize];
        let reach = radius as usize - 1;
        let along_rows = spread(&edge, reach, width, |x, y| y * width + x, height);
        spread(&along_rows, reach, height, |y, x| y * width + x, width)
    }

    /// Pixels that differ from one of the eight around them.
    fn edges(&self, lights: u128) -> Vec<bool> {
        let [width, height] = [self.width as usize, self.height as usize];
        let mut edge = vec![false; self.color.len()];
        for y in 0..height {
            for x in 0..width {
                for (dx, dy) in [(1, 0), (0, 1), (1, 1), (-1, 1)] {
                    let (Some(u), v) = (x.checked_add_signed(dx), y + dy) else {
                        continue;
                    };
                    if u >= width || v >= height {
                        continue;
                    }
                    let (p, q) = (y * width + x, v * width + u);
                    if self.differ(p, q, [dx as f64, dy as f64], lights) {
                        edge[p] = true;
                        edge[q] = true;
                    }
                }
            }
        }
        edge
    }

    /// Whether the pixels `p` and `q`, `step` right and down of it, show different things.
    fn differ(&self, p: usize, q: usize, step: [f64; 2], lights: u128) -> bool {
        if self.object[p] != self.object[q] || self.layers[p] != self.layers[q] {
            return true;
        }
        if (self.lit[p] ^ self.lit[q]) & lights != 0 {
            return true;
        }
        self.object[p].is_some() && self.jumps(p, q, step)
    }

    /// One object: whether its surface breaks between the pixels.
    fn jumps(&self, p: usize, q: usize, step: [f64; 2]) -> bool {
        let (a, b) = (&self.facet[p], &self.facet[q]);
        if a.id == b.id {
            return false;
        }
        let cosine: f64 = (a.normal.iter().zip(b.normal)).map(|(m, n)| m * n).sum();
        let slope = |i: usize| {
            let [right, down] = self.facet[i]
                .next_depth
                .map(|next| (next - self.depth[i]).abs());
            right * step[0].abs() + down * step[1].abs()
        };
        let rise = (self.depth[p] - self.depth[q]).abs();
        // The last term is the rounding of the depths.
        let bound = SLOPES * slope(p).max(slope(q)) + 1e-12 * self.depth[p].abs();
        cosine < SAME_SURFACE_COSINE || rise > bound
    }
}

/// Each true spread by `reach` along lines of `length`, of which there are `lines`.
fn spread(
    from: &[bool],
    reach: usize,
    length: usize,
    at: impl Fn(usize, usize) -> usize,
    lines: usize,
) -> Vec<bool> {
    let mut to = vec![false; from.len()];
    for line in 0..lines {
        for i in (0..length).filter(|&i| from[at(i, line)]) {
            for j in i.saturating_sub(reach)..=(i + reach).min(length - 1) {
                to[at(j, line)] = true;
            }
        }
    }
    to
}
