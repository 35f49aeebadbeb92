//! The pavilion's materials, each defined once by name and used by name.

use crate::iv_writer::{IvWriter, num, vec3};

struct Paint {
    name: &'static str,
    diffuse: [f64; 3],
    specular: f64,
    shininess: f64,
    transparency: f64,
    emissive: [f64; 3],
}

const fn matt(name: &'static str, diffuse: [f64; 3]) -> Paint {
    glossy(name, diffuse, 0.0, 0.2)
}

const fn glossy(name: &'static str, diffuse: [f64; 3], specular: f64, shininess: f64) -> Paint {
    Paint {
        name,
        diffuse,
        specular,
        shininess,
        transparency: 0.0,
        emissive: [0.0; 3],
    }
}

const PAINTS: &[Paint] = &[
    matt("Plaster", [0.86, 0.83, 0.76]),
    matt("Limestone", [0.80, 0.77, 0.70]),
    matt("Concrete", [0.58, 0.57, 0.55]),
    glossy("Oak", [0.55, 0.38, 0.22], 0.12, 0.15),
    glossy("Larch", [0.62, 0.44, 0.27], 0.08, 0.1),
    matt("Spruce", [0.74, 0.60, 0.42]),
    glossy("PaintedGreen", [0.16, 0.27, 0.22], 0.25, 0.3),
    // White, so that a MODULATE texture keeps its own colours.
    matt("Textured", [1.0, 1.0, 1.0]),
    glossy("Brass", [0.62, 0.47, 0.20], 0.7, 0.5),
    glossy("Steel", [0.45, 0.46, 0.48], 0.8, 0.6),
    glossy("BlackIron", [0.07, 0.07, 0.08], 0.3, 0.25),
    glossy("Terracotta", [0.66, 0.34, 0.22], 0.05, 0.1),
    glossy("Ceramic", [0.85, 0.87, 0.88], 0.5, 0.7),
    glossy("Orange", [0.92, 0.45, 0.06], 0.2, 0.3),
    matt("Leaves", [0.34, 0.46, 0.18]),
    matt("Boxwood", [0.24, 0.38, 0.15]),
    matt("Bark", [0.30, 0.22, 0.16]),
    Paint {
        name: "Glass",
        diffuse: [0.55, 0.70, 0.72],
        specular: 0.9,
        shininess: 0.9,
        transparency: 0.7,
        emissive: [0.0; 3],
    },
    Paint {
        name: "LampGlow",
        diffuse: [0.3, 0.28, 0.22],
        specular: 0.0,
        shininess: 0.2,
        transparency: 0.0,
        emissive: [1.0, 0.88, 0.62],
    },
];

/// Defines every material in a switch that draws nothing and leaves no state.
pub(super) fn materials(w: &mut IvWriter) {
    w.line("# Materials, set by name where they are used.");
    w.node("DEF Palette Switch", |w| {
        w.line("whichChild -1");
        for paint in PAINTS {
            material(w, paint);
        }
    });
}

fn material(w: &mut IvWriter, paint: &Paint) {
    w.node(&format!("DEF {} Material", paint.name), |w| {
        w.line(&format!("diffuseColor {}", vec3(paint.diffuse)));
        if paint.specular > 0.0 {
            w.line(&format!("specularColor {}", vec3([paint.specular; 3])));
            w.line(&format!("shininess {}", num(paint.shininess)));
        }
        if paint.emissive != [0.0; 3] {
            w.line(&format!("emissiveColor {}", vec3(paint.emissive)));
        }
        if paint.transparency > 0.0 {
            w.line(&format!("transparency {}", num(paint.transparency)));
        }
    });
}
