//! Diffuse colours and transparencies by index.

use crate::graph::{Graph, NodeId};
use crate::resolve::{Binding, ColorSource};

/// A list of diffuse colours.
#[derive(Clone, Copy)]
enum Diffuse<'g> {
    Default,
    White,
    Triples(&'g [f64]),
    Packed(&'g [i32]),
}

/// The colours of a shape, by material index.
pub struct Colors<'g> {
    diffuse: Diffuse<'g>,
    /// Empty means opaque.
    transparencies: &'g [f64],
    /// Packed colours carry their own transparency.
    packed_alpha: Option<&'g [i32]>,
    uniform: bool,
}

impl<'g> Colors<'g> {
    /// The colours that the sources hold, dealt out by `binding`.
    pub fn of(
        graph: &'g Graph,
        diffuse: ColorSource,
        transparency: ColorSource,
        binding: Binding,
    ) -> Self {
        let packed = |id: NodeId| graph.node(id).ints("orderedRGBA");
        // The alpha of packed colours counts while they are the diffuse colours; behind a
        // BaseColor the transparency of the last Material is in force again.
        let (transparencies, packed_alpha) = match (diffuse, transparency) {
            (ColorSource::Packed(id), _) => (&[][..], Some(packed(id))),
            (_, ColorSource::Material(id)) => (graph.node(id).numbers("transparency"), None),
            _ => (&[][..], None),
        };
        let diffuse = match diffuse {
            ColorSource::Default => Diffuse::Default,
            ColorSource::White => Diffuse::White,
            ColorSource::Color(id) => Diffuse::Triples(graph.node(id).numbers("color")),
            ColorSource::Material(id) => Diffuse::Triples(graph.node(id).numbers("diffuseColor")),
            ColorSource::Emissive(id) => Diffuse::Triples(graph.node(id).numbers("emissiveColor")),
            ColorSource::Base(id) => Diffuse::Triples(graph.node(id).numbers("rgb")),
            ColorSource::Packed(id) => Diffuse::Packed(packed(id)),
        };
        let count = match diffuse {
            Diffuse::Default | Diffuse::White => 1,
            Diffuse::Triples(list) => list.len() / 3,
            Diffuse::Packed(list) => list.len(),
        };
        let alphas = packed_alpha.map_or(transparencies.len(), <[i32]>::len);
        Self {
            diffuse,
            transparencies,
            packed_alpha,
            uniform: binding == Binding::Overall || (count <= 1 && alphas <= 1),
        }
    }

    /// Whether one colour serves the whole shape.
    pub fn is_uniform(&self) -> bool {
        self.uniform
    }

    /// The diffuse colour of an index; beyond the end the last one (Coin clamps transparency so,
    /// and reads past the end for colours).
    pub fn diffuse_srgb(&self, index: usize) -> [f64; 3] {
        match self.diffuse {
            Diffuse::Default => [0.8; 3],
            Diffuse::White => [1.0; 3],
            Diffuse::Triples(list) => {
                let index = index.min((list.len() / 3).saturating_sub(1));
                match list.get(index * 3..index * 3 + 3) {
                    Some(&[r, g, b]) => [r, g, b].map(|v| v.clamp(0.0, 1.0)),
                    _ => [0.8; 3],
                }
            }
            Diffuse::Packed(list) => match list.get(index).or(list.last()) {
                Some(packed) => {
                    let [r, g, b, _] = packed.to_be_bytes();
                    [r, g, b].map(|v| f64::from(v) / 255.0)
                }
                None => [0.8; 3],
            },
        }
    }

    /// The transparency of an index; beyond the end the last one.
    pub fn transparency(&self, index: usize) -> f64 {
        if let Some(list) = self.packed_alpha {
            let packed = list.get(index).or(list.last());
            return packed.map_or(0.0, |p| 1.0 - f64::from(p.to_be_bytes()[3]) / 255.0);
        }
        let value = self
            .transparencies
            .get(index)
            .or(self.transparencies.last());
        value.map_or(0.0, |t| t.clamp(0.0, 1.0))
    }

    /// Colour and alpha of an index.
    pub fn rgba_srgb(&self, index: usize) -> [f32; 4] {
        let [r, g, b] = self.diffuse_srgb(index);
        [
            r as f32,
            g as f32,
            b as f32,
            (1.0 - self.transparency(index)) as f32,
        ]
    }
}
