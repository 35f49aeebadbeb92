//! The Rust side of the structs in `wgsl/types.wgsl`, byte for byte.

use bytemuck::{Pod, Zeroable};

macro_rules! layouts {
    ($($(#[$doc:meta])* $name:ident { $($(#[$field_doc:meta])* $field:ident: $type:ty),* $(,)? })*) => {
        $(
            $(#[$doc])*
            #[repr(C)]
            #[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
            pub struct $name { $($(#[$field_doc])* pub $field: $type),* }
        )*

        /// Name and size of each struct, with name and offset of each of its fields.
        pub fn layouts() -> Vec<(&'static str, usize, Vec<(&'static str, usize)>)> {
            vec![$((
                stringify!($name),
                size_of::<$name>(),
                vec![$((stringify!($field), std::mem::offset_of!($name, $field))),*],
            )),*]
        }
    };
}

layouts! {
    /// What is the same for a whole frame.
    Frame {
        /// Columns.
        clip_from_rel: [[f32; 4]; 4],
        /// The way the eye looks; w = 1 for a parallel projection.
        view_axis: [f32; 4],
        /// Width, height, and their inverses.
        viewport: [f32; 4],
        /// The eye in the frame of the ray structures.
        eye_in_rays: [f32; 4],
        /// Columns of the inverse of `clip_from_rel`.
        rel_from_clip: [[f32; 4]; 4],
        /// x, y, width, height of the part of the image that is drawn.
        region: [u32; 4],
        /// What lies before this plane is cut away; zero: nothing.
        section: [f32; 4],
    }
    /// An object's frame.
    Instance {
        /// Row.
        rel_from_mesh_x: [f32; 4],
        /// Row.
        rel_from_mesh_y: [f32; 4],
        /// Row.
        rel_from_mesh_z: [f32; 4],
        /// Row of the cofactor matrix.
        normal_x: [f32; 4],
        /// Row of the cofactor matrix.
        normal_y: [f32; 4],
        /// Row of the cofactor matrix.
        normal_z: [f32; 4],
        /// Surface, first light, number of lights, unused.
        ids: [u32; 4],
    }
    /// A material in an environment.
    Surface {
        /// Emitted and ambient light; alpha.
        constant: [f32; 4],
        /// Diffuse colour; specular exponent.
        diffuse: [f32; 4],
        /// Specular colour; line width.
        specular: [f32; 4],
        /// Blend colour; point size.
        blend: [f32; 4],
        /// Fog colour; 1 / visibility.
        fog: [f32; 4],
    }
    /// A light.
    Light {
        /// Place or direction.
        position: [f32; 4],
        /// Spot axis; cosine of the half angle.
        axis: [f32; 4],
        /// Colour; spot exponent.
        color: [f32; 4],
        /// Quadratic, linear, constant; 1 / (cosine of a spot's inner cone - that of its edge).
        attenuation: [f32; 4],
    }
    /// What is the same for a pass.
    PassValues {
        /// Index of the light; unused.
        light: [u32; 4],
        /// Where shadow volumes end, in rel; zero: nowhere.
        far_plane: [f32; 4],
    }
}
