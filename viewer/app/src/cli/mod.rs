//! The command line: arguments in, a picture, messages and an exit code out. Draws nothing itself.
//!
//! Exit codes: 0 done, 1 the picture differs from the reference, 2 something failed.

pub mod args;
pub mod background;
pub mod camera;
pub mod picture;
pub mod screen;
mod stats;

use std::path::Path;
use std::process::ExitCode;
use std::sync::Arc;
use std::time::{Duration, Instant};

use clap::Parser;
use convert::command::access::Access;
use convert::command::messages::{self, Style, error_line, image_left_out, number, seconds};
use convert::command::{atomic, json};
use image::RgbaImage;
use iv_parser::{Diagnostic, Severity};
use viewer::frame::Plan;
use viewer::gpu::{FrameReport, Gpu, Renderer};
use viewer::texture::Images;
use viewer::view::{Region, View};

use crate::input::{self, Input};
use crate::window;
use args::Args;
use camera::Viewpoint;
use picture::Verdict;
use screen::Screen;

/// Done.
const DONE: u8 = 0;
/// The picture is not that of the reference.
const DIFFERS: u8 = 1;
/// Something was not done.
const FAILED: u8 = 2;

/// Pixels of a picture at most: with four samples each takes 68 bytes on the device, which for a
/// software adapter is the memory of the machine.
const MAX_PIXELS: u64 = 1 << 26;

const ONE_MODEL: &str = "--output draws one model; give one";

/// The whole command, with the arguments of the process.
pub fn run() -> ExitCode {
    let args = Args::parse();
    let screen = Screen {
        is_quiet: args.quiet,
    };
    let code = match &args.output {
        None => window::run(&args, &screen).map(|()| DONE),
        Some(output) => match args.models.as_slice() {
            [model] => show(&args, model, output, &screen),
            _ => Err(messages::error(ONE_MODEL)),
        },
    };
    ExitCode::from(code.unwrap_or_else(|why| {
        screen.error(&why);
        FAILED
    }))
}

/// A frame and all that is told about it.
pub struct Shown {
    /// What was done.
    pub plan: Plan,
    /// What it took.
    pub report: FrameReport,
    /// The picture.
    pub picture: RgbaImage,
    /// From where.
    pub view: View,
    /// The part of the picture that the view fills.
    pub region: Region,
    /// Reading the picture back.
    pub readback_time: Duration,
}

/// Draws the model into a file; returns the exit code. Errors are whole lines.
fn show(args: &Args, model: &Path, output: &Path, screen: &Screen) -> Result<u8, String> {
    let start = Instant::now();
    let plain = |why: String| messages::error(&why);
    let reference = args.reference.as_deref().map(picture::read).transpose();
    let reference = reference.map_err(plain)?;
    let saved = args.view.as_deref().map(Viewpoint::saved).transpose();
    let saved = saved.map_err(plain)?;

    let mut times = stats::Times::default();
    let (input, images, diagnostics) = read(args, model, screen, &mut times)?;
    let viewpoint = match saved {
        Some(viewpoint) => viewpoint,
        None => {
            let up = args.up().unwrap_or(input.up);
            Viewpoint::choose(&input.scene, args.camera.as_deref(), up).map_err(plain)?
        }
    };

    let device_start = Instant::now();
    let gpu = Gpu::new(args.adapter()).map_err(|error| plain(error.to_string()))?;
    times.device = device_start.elapsed();
    check_size(&gpu, args.size).map_err(plain)?;
    screen.remark(&adapter(&gpu));
    let format = input.format;
    let scene = Arc::new(input.scene);
    let mut renderer = Renderer::new(gpu, Arc::clone(&scene), &images)
        .map_err(|error| plain(error.to_string()))?;
    drop(images);
    let shown = draw(&mut renderer, &viewpoint, args).map_err(plain)?;

    let png_start = Instant::now();
    picture::write(output, &shown.picture).map_err(plain)?;
    times.png = png_start.elapsed();
    let code = match reference {
        Some(reference) => compare(args, output, &reference, &shown.picture, screen)?,
        None => DONE,
    };
    times.total = start.elapsed();
    if let Some(path) = &args.stats {
        let told = stats::Told {
            args,
            model,
            format,
            scene: &scene,
            renderer: &renderer,
            shown: &shown,
            times: &times,
        };
        write_stats(path, &told.document(), screen).map_err(plain)?;
    }
    screen.remark(&summary(output, &diagnostics, times.total));
    Ok(code)
}

/// Reads the model and its images, and says what is wrong with them.
fn read(
    args: &Args,
    path: &Path,
    screen: &Screen,
    times: &mut stats::Times,
) -> Result<(Input, Images, Vec<Diagnostic>), String> {
    let mut diagnostics = Vec::new();
    let access = Access::new(&args.search, &args.packed);
    let input = access.and_then(|access| Ok(input::read(path, args, &access, &mut diagnostics)?));
    let input = input.map(|input| {
        times.read = input.read_time;
        times.resolve = input.resolve_time;
        let start = Instant::now();
        let images = Images::load(&input.scene, &convert::command::model::Images(&input.files));
        times.textures = start.elapsed();
        let missing = images.problems.iter().cloned();
        diagnostics.extend(missing.map(|missing| image_left_out(missing, &input.scene)));
        if input.scene.instances.is_empty() {
            let message = "nothing in this model is drawn".to_owned();
            let hint = "the picture shows the background only";
            diagnostics.push(input::warning(path, "no-geometry", message, hint));
        }
        (input, images)
    });
    let style = Style {
        is_quiet: args.quiet,
        see: String::new(),
    };
    let remarks = messages::remarks(path, &diagnostics, &style);
    screen.error(&messages::printable(&remarks.join("\n")));
    match input {
        Ok((input, images)) => Ok((input, images, diagnostics)),
        Err(why) => Err(error_line(&path.display().to_string(), &why)),
    }
}

/// Whether the device can hold pictures of this size.
fn check_size(gpu: &Gpu, (width, height): (u32, u32)) -> Result<(), String> {
    let side = gpu.device.limits().max_texture_dimension_2d;
    let what = format!("a picture of {width}x{height} is too large");
    if width > side || height > side {
        let name = messages::printable(&gpu.info.name);
        return Err(format!(
            "{what} for {name}: a side has at most {side} pixels"
        ));
    }
    if u64::from(width) * u64::from(height) > MAX_PIXELS {
        return Err(format!("{what}: it has at most {MAX_PIXELS} pixels"));
    }
    Ok(())
}

/// Which adapter draws.
fn adapter(gpu: &Gpu) -> String {
    let name = messages::printable(&gpu.info.name);
    if gpu.is_software() {
        format!("drawn by {name}, a software adapter: a graphics card would be faster")
    } else {
        format!("drawn by {name}")
    }
}

fn draw(renderer: &mut Renderer, viewpoint: &Viewpoint, args: &Args) -> Result<Shown, String> {
    let (view, region) = viewpoint.view(&renderer.content().bounds, args.size);
    let (plan, report) = renderer
        .draw(&view, &region, args.size, &args.settings())
        .map_err(|error| error.to_string())?;
    let start = Instant::now();
    let pixels = renderer.read().map_err(|error| error.to_string())?;
    let readback_time = start.elapsed();
    let (width, height) = args.size;
    let picture = RgbaImage::from_raw(width, height, pixels)
        .ok_or("the graphics device gave a picture of another size")?;
    Ok(Shown {
        plan,
        report,
        picture,
        view,
        region,
        readback_time,
    })
}

/// Compares with the reference; returns the exit code.
fn compare(
    args: &Args,
    output: &Path,
    reference: &RgbaImage,
    picture: &RgbaImage,
    screen: &Screen,
) -> Result<u8, String> {
    let shown = output.display().to_string();
    let name = args.reference.as_deref().unwrap_or(Path::new(""));
    let tolerance = &args.threshold;
    match picture::judge(reference, picture, tolerance) {
        Verdict::Same(difference) => {
            screen.remark(&format!("as in the reference: {difference}"));
            Ok(DONE)
        }
        Verdict::SizeDiffers(why) => {
            screen.error(&error_line(&shown, &format!("{why} (the second is this)")));
            Ok(DIFFERS)
        }
        Verdict::Differs(difference, strip) => {
            let mut why = format!(
                "differs from {}: {difference}; allowed are steps of {}, {} % of the pixels, {} \
                 in a blob",
                name.display(),
                tolerance.step,
                tolerance.max_share * 100.0,
                tolerance.max_blob
            );
            if let Some(strip) = strip {
                let path = args::strip_path(output);
                picture::write(&path, &strip).map_err(|why| messages::error(&why))?;
                why.push_str(&format!(
                    "; reference, picture and difference are in {}",
                    path.display()
                ));
            }
            screen.error(&error_line(&shown, &why));
            Ok(DIFFERS)
        }
    }
}

fn write_stats(path: &Path, document: &serde_json::Value, screen: &Screen) -> Result<(), String> {
    if path == Path::new("-") {
        screen.output(&json::text(document))
    } else {
        atomic::make_folder_of(path)?;
        atomic::write_json(path, document).map(|_| ())
    }
}

/// One line about all.
fn summary(output: &Path, diagnostics: &[Diagnostic], time: Duration) -> String {
    let mut parts = vec![format!("written to {}", output.display())];
    for (severity, what) in [(Severity::Error, "error"), (Severity::Warning, "warning")] {
        let count = diagnostics.iter().filter(|d| d.severity == severity);
        match count.count() {
            0 => {}
            count => parts.push(number(count, what)),
        }
    }
    parts.push(seconds(time));
    messages::printable(&parts.join(", "))
}
