//! All ways to make shadows show the same shadows.

use tests::reference::{RefCamera, RefLens};
use tests::shadow_scenes::scene_of;
use viewer::frame::{Extraction, Settings, Shadows, VolumeMethod};

use super::device::Stage;

const SIZE: [u32; 2] = [256, 192];
/// Steps of 8 bits by which equal light may differ.
const STEPS: u8 = 2;
/// Share of pixels that may differ: those on edges of shadows, as places come from f32 depths.
const EXACT: f64 = 0.001;
/// A map's texels are larger than pixels.
const MAP: f64 = 0.02;

const SCENE: &str = "#Inventor V2.1 ascii
    Separator {
        Environment { ambientIntensity 0.3 }
        PointLight { location 2.5 2.2 2 intensity 0.6 }
        DirectionalLight { direction 1 -0.7 0.3 intensity 0.4 }
        Separator {
            Translation { translation 0 -0.1 0 }
            Material { diffuseColor 0.8 0.8 0.7 }
            Cube { width 8 height 0.2 depth 8 }
        }
        Separator {
            Translation { translation 0 1 0 }
            Texture2 { image 2 2 3 0xff8040 0x4080ff 0x40ff80 0xffffff }
            Cube { width 1 height 1 depth 1 }
        }
        Separator {
            Translation { translation -1.5 0.7 1 }
            Material { diffuseColor 0.3 0.4 0.9 specularColor 0.5 0.5 0.5 shininess 0.3 }
            Sphere { radius 0.6 }
        }
    }";

fn draw(shadows: Shadows, samples: u32) -> Vec<u8> {
    let settings = Settings {
        shadows,
        samples,
        ..Settings::default()
    };
    let lens = RefLens::Perspective {
        tan_half_height: 0.45,
    };
    let eye = [4.0, 4.0, 7.0].into();
    let camera = RefCamera::look_at(eye, [0.0, 0.3, 0.0].into(), [0.0, 1.0, 0.0].into(), lens);
    Stage::new(scene_of(SCENE))
        .shoot(&camera, SIZE, &settings)
        .rgba
}

fn share_of_different(a: &[u8], b: &[u8]) -> f64 {
    let pixels = a.as_chunks::<4>().0.iter().zip(b.as_chunks::<4>().0);
    let differ = |(a, b): &(&[u8; 4], &[u8; 4])| {
        let steps = a.iter().zip(*b).map(|(a, b)| a.abs_diff(*b));
        steps.fold(0, u8::max) > STEPS
    };
    pixels.filter(differ).count() as f64 / (a.len() / 4) as f64
}

#[test]
fn techniques_agree() {
    let volumes = |method, extraction| Shadows::Volumes { method, extraction };
    let rows = [
        (
            "compute",
            volumes(VolumeMethod::Silhouette, Extraction::Compute),
            EXACT,
        ),
        (
            "reference edge",
            volumes(VolumeMethod::ReferenceEdge, Extraction::Cpu),
            EXACT,
        ),
        (
            "per triangle",
            volumes(VolumeMethod::PerTriangle, Extraction::Cpu),
            EXACT,
        ),
        ("rays", Shadows::Rays, EXACT),
        ("map", Shadows::Map { size: 2048 }, MAP),
    ];
    for samples in [1, 4] {
        let expected = draw(volumes(VolumeMethod::Silhouette, Extraction::Cpu), samples);
        let none = share_of_different(&expected, &draw(Shadows::None, samples));
        assert!(none > 0.05, "no shadows to compare: {none}");
        for (name, shadows, most) in rows {
            let share = share_of_different(&expected, &draw(shadows, samples));
            println!("{name}, {samples} samples: {:.3} %", share * 100.0);
            assert!(share <= most, "{name}, {samples} samples: {share}");
        }
    }
}
