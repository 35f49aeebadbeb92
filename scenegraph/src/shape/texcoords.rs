//! Texture coordinates: from a list, a function, or the bounding box; the texture transform is
//! applied to all.

use geometry::bounds::Aabb;
use glam::{DMat3, DVec2, DVec3};

use crate::graph::Node;
use crate::registry::Class;

use super::assemble::coordinate;
use super::attributes::{Attributes, TexCoordSource};

/// Gives texture coordinates for one shape.
pub struct TexCoordMaker<'a> {
    attributes: &'a Attributes<'a>,
    source: TexCoordSource<'a>,
    map: BoxMap,
}

/// How the bounding box is laid onto the texture.
#[derive(Clone, Copy)]
pub struct BoxMap {
    s_axis: usize,
    t_axis: usize,
    min: DVec3,
    /// The longest side, at which both coordinates reach 1.
    length: f64,
}

impl BoxMap {
    /// SGI's rule: S runs along the longest side, T along the second, both divided by the
    /// longest; of equal sides the later axis counts as the longer one.
    ///
    /// VRML 2 (ISO 14772-1, 6.23) differs in that the earlier axis counts as the longer one.
    pub fn new(bounds: &Aabb, vrml2: bool) -> Self {
        let size = bounds.size();
        let mut axes = if vrml2 { [0, 1, 2] } else { [2, 1, 0] };
        axes.sort_by(|&a, &b| size[b].total_cmp(&size[a]));
        Self {
            s_axis: axes[0],
            t_axis: axes[1],
            min: bounds.min,
            length: size[axes[0]],
        }
    }

    /// The texture coordinates of a point.
    pub fn texcoord(&self, p: DVec3) -> DVec2 {
        if self.length <= 0.0 {
            return DVec2::ZERO;
        }
        let q = (p - self.min) / self.length;
        DVec2::new(q[self.s_axis], q[self.t_axis])
    }
}

impl<'a> TexCoordMaker<'a> {
    /// For a shape with these bounds.
    pub fn new(attributes: &'a Attributes<'a>, source: TexCoordSource<'a>, bounds: &Aabb) -> Self {
        Self {
            attributes,
            source,
            map: BoxMap::new(bounds, attributes.vrml2),
        }
    }

    /// The texture coordinates of a corner that takes value `index` and stands at `coordinate`.
    pub fn texcoord(&self, index: usize, coordinate_index: usize) -> [f32; 2] {
        let p = || coordinate(self.attributes, coordinate_index as u32);
        let st = match self.source {
            TexCoordSource::Default => self.map.texcoord(p()),
            TexCoordSource::Function(node) => function(node, p()),
            TexCoordSource::List(list) => list.get(index),
        };
        transformed(&self.attributes.texture_transform, st)
    }
}

/// With the texture transform applied, as stored.
pub fn transformed(transform: &DMat3, st: DVec2) -> [f32; 2] {
    let q = *transform * st.extend(1.0);
    let w = if q.z == 0.0 { 1.0 } else { q.z };
    let limit = f64::from(f32::MAX);
    // NaN, from infinite factors, becomes 0.
    let store = |v: f64| {
        if v.is_nan() {
            0.0
        } else {
            v.clamp(-limit, limit) as f32 + 0.0
        }
    };
    [store(q.x / w), store(q.y / w)]
}

/// `TextureCoordinatePlane` (distance along a direction, in its lengths) and
/// `TextureCoordinateObject` (a linear function).
pub fn function(node: &Node, p: DVec3) -> DVec2 {
    if node.class() == Some(Class::TextureCoordinateObject) {
        let linear = |field: &str| match *node.numbers(field) {
            [x, y, z, w] => p.dot(DVec3::new(x, y, z)) + w,
            _ => 0.0,
        };
        return DVec2::new(linear("factorS"), linear("factorT"));
    }
    let along = |field: &str| {
        let direction = DVec3::from(node.triple(field));
        let square = direction.length_squared();
        if square > 0.0 {
            p.dot(direction) / square
        } else {
            0.0
        }
    };
    DVec2::new(along("directionS"), along("directionT"))
}
