//! How long a frame takes and how many pixels are wrong, for every shadow technique, on the sphere
//! grid of Milet, Kobrtek, Zemčík and Pečiva (2014, tables 1 to 4).
//!
//! `cargo bench -p tests --bench shadows` prints a table over triangle counts and one over object
//! counts; times are ratios to drawing without shadows in the same run. `-- quick` takes the
//! smallest sizes only, `-- objects` the second table only, `-- any` takes a GPU if there is one. docs/BENCHMARKS.md says what the
//! columns mean.

mod measure;

use std::process::ExitCode;

use tests::shadow_scenes::{GridLight, GridSize};
use viewer::frame::{Extraction, Settings, Shadows, VolumeMethod};
use viewer::gpu::{AdapterChoice, Gpu, GpuError};

use measure::{Figures, Subject};

/// What is compared.
const TECHNIQUES: [(&str, Shadows); 8] = [
    ("none", Shadows::None),
    (
        "silhouette, CPU",
        volumes(VolumeMethod::Silhouette, Extraction::Cpu),
    ),
    (
        "silhouette, compute",
        volumes(VolumeMethod::Silhouette, Extraction::Compute),
    ),
    (
        "reference edge",
        volumes(VolumeMethod::ReferenceEdge, Extraction::Cpu),
    ),
    (
        "per triangle",
        volumes(VolumeMethod::PerTriangle, Extraction::Cpu),
    ),
    ("map 2k", Shadows::Map { size: 2048 }),
    ("map 8k", Shadows::Map { size: 8192 }),
    ("rays", Shadows::Rays),
];

const fn volumes(method: VolumeMethod, extraction: Extraction) -> Shadows {
    Shadows::Volumes { method, extraction }
}

const SIZES: [GridSize; 4] = [
    GridSize::SMALL,
    GridSize::MEDIUM,
    GridSize::LARGE,
    GridSize::HUGE,
];

/// Objects of the second table, all together as many triangles as the third size has.
const OBJECTS: [usize; 3] = [1, 100, 1600];

fn main() -> ExitCode {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let has = |word: &str| args.iter().any(|arg| arg == word);
    if !has("--bench") {
        println!("run by: cargo bench -p tests --bench shadows");
        return ExitCode::SUCCESS;
    }
    let choice = if has("any") {
        AdapterChoice::Any
    } else {
        AdapterChoice::Software
    };
    match bench(choice, has("quick"), has("objects")) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn bench(choice: AdapterChoice, is_quick: bool, has_objects_only: bool) -> Result<(), GpuError> {
    let gpu = Gpu::new(choice)?;
    println!("{} ({:?})\n", gpu.info.name, gpu.info.backend);
    let images: &[[u32; 2]] = if is_quick {
        &[[512, 512]]
    } else {
        &[[512, 512], [1024, 768]]
    };
    let sizes = if is_quick { &SIZES[..1] } else { &SIZES[..] };
    let lights = [GridLight::Point, GridLight::Directional];
    for light in lights.into_iter().filter(|_| !has_objects_only) {
        for &image in images {
            println!("{light:?} light, {} x {}", image[0], image[1]);
            head();
            for &size in sizes {
                let label = format!("{} triangles", size.sphere_triangles());
                row(&gpu, &label, size, light, image)?;
            }
            println!();
        }
    }
    if is_quick {
        return Ok(());
    }
    println!("Point light, 512 x 512, over numbers of objects");
    head();
    for spheres in OBJECTS {
        let size = GridSize {
            spheres,
            ..GridSize::LARGE
        };
        row(
            &gpu,
            &format!("{spheres} objects"),
            size,
            GridLight::Point,
            [512, 512],
        )?;
    }
    Ok(())
}

fn head() {
    print!("| {:18} |", "");
    for (name, _) in TECHNIQUES {
        print!(" {name:>19} |");
    }
    println!();
    print!("| {} |", "-".repeat(18));
    for _ in TECHNIQUES {
        print!(" {}: |", "-".repeat(18));
    }
    println!();
}

/// Prints times of one size: milliseconds without shadows, ratios to it with them, and the pixels
/// that differ from the reference, those away from edges in brackets.
fn row(
    gpu: &Gpu,
    label: &str,
    size: GridSize,
    light: GridLight,
    image: [u32; 2],
) -> Result<(), GpuError> {
    let mut subject = Subject::new(gpu, size, light, image)?;
    print!("| {label:18} |");
    let mut none_ms = 0.0;
    for (_, shadows) in TECHNIQUES {
        let settings = Settings {
            shadows,
            ..Settings::default()
        };
        let Figures { ms, wrong, away } = subject.measure(&settings)?;
        let cell = if shadows == Shadows::None {
            none_ms = ms;
            format!("{ms:.0} ms")
        } else {
            format!("{:.2} x, {wrong} ({away})", ms / none_ms)
        };
        print!(" {cell:>19} |");
        std::io::Write::flush(&mut std::io::stdout()).ok();
    }
    println!();
    Ok(())
}
