//! The page of `--html`, as headless Chromium shows it: read from the pixels of a screenshot.

use std::path::Path;
use std::process::{Command, Stdio};

use convert::{Container, Options, Quantize, Up, write_file};
use image::Rgb;
use scenegraph::{FileLoader, ResolveOptions, load, resolve};

use super::models::Images;

const SIZE: (u32, u32) = (400, 300);
/// Names that the browser has on different systems.
const BROWSERS: [&str; 3] = ["chromium", "chromium-browser", "google-chrome"];

/// A column with +Z upwards, in a different colour at each end, colours without light; and around it
/// a box that a Switch hides.
const COLUMN: &str = "#Inventor V2.1 ascii
Separator {
  LightModel { model BASE_COLOR }
  Separator { Translation { translation 2600000 1200000 0 } Material { diffuseColor 1 0 0 } Cube { width 2 height 2 depth 2 } }
  Separator { Translation { translation 2600000 1200000 2 } Material { diffuseColor 0 0 1 } Cube { width 2 height 2 depth 2 } }
  Separator { Translation { translation 2600000 1200000 -2 } Material { diffuseColor 0 1 0 } Cube { width 2 height 2 depth 2 } }
  Switch { Separator { Translation { translation 2600000 1200000 0 } Material { diffuseColor 1 1 0 } Cube { width 20 height 20 depth 20 } } }
}";

fn screenshot(page: &Path, folder: &Path) -> image::RgbImage {
    let picture = folder.join("page.png");
    let arguments = |command: &mut Command| {
        command
            .args([
                "--headless",
                "--no-sandbox",
                "--disable-quic",
                "--no-first-run",
            ])
            .args([
                "--disable-background-networking",
                "--disable-component-update",
            ])
            .args([
                "--disable-sync",
                "--hide-scrollbars",
                "--force-device-scale-factor=1",
            ])
            .args([
                "--use-gl=angle",
                "--use-angle=swiftshader",
                "--enable-unsafe-swiftshader",
            ])
            .arg("--virtual-time-budget=30000")
            .arg(format!(
                "--user-data-dir={}",
                folder.join("profile").display()
            ))
            .arg(format!("--window-size={},{}", SIZE.0, SIZE.1))
            .arg(format!("--screenshot={}", picture.display()))
            .arg(format!("file://{}", page.display()))
            .stdout(Stdio::null())
            .stderr(Stdio::null());
    };
    let found = BROWSERS.iter().find_map(|browser| {
        let mut command = Command::new(browser);
        arguments(&mut command);
        command.status().ok()
    });
    let status = found.expect("Chromium is needed: install Debian's package chromium");
    assert!(status.success(), "{status}");
    image::open(picture).expect("a screenshot").into_rgb8()
}

#[test]
fn the_page_shows_the_model_upright_in_its_colours() {
    let folder = tempfile::tempdir().expect("a folder");
    let graph = load(
        COLUMN.as_bytes(),
        "column.iv",
        folder.path(),
        &FileLoader::new([folder.path()]),
    );
    let keeps = ResolveOptions {
        alternatives: true,
        ..ResolveOptions::default()
    };
    let scene = resolve(&graph, &keeps).scene;
    let plain = Options {
        container: Container::Html,
        up: Up::Z,
        ..Options::default()
    };
    let small = Options {
        quantize: Some(Quantize::within(1e-3)),
        compress: true,
        instancing: true,
        ..plain.clone()
    };
    for (name, options) in [("plain", plain), ("small", small)] {
        let path = folder.path().join(format!("{name}.html"));
        let images = Images(FileLoader::new([folder.path()]));
        write_file(&scene, &options, &images, &path).expect("a page");
        let picture = screenshot(&path, folder.path());
        assert_eq!(picture.dimensions(), SIZE, "{name}");
        let middle = SIZE.0 / 2;
        let (red, blue, green) = (Rgb([255, 0, 0]), Rgb([0, 0, 255]), Rgb([0, 255, 0]));
        assert_eq!(*picture.get_pixel(middle, SIZE.1 / 2), red, "{name}");
        let rows = |color: Rgb<u8>| -> Vec<u32> {
            (0..SIZE.1)
                .filter(|&y| *picture.get_pixel(middle, y) == color)
                .collect()
        };
        let (red, blue, green) = (rows(red), rows(blue), rows(green));
        // From top to bottom, each end seen whole, with background around.
        assert!(
            blue.len() > 30 && green.len() > 30,
            "{name}: {blue:?} {green:?}"
        );
        assert!(
            blue.last() < red.first() && red.last() < green.first(),
            "{name}"
        );
        assert!(blue[0] > 5 && green[green.len() - 1] < SIZE.1 - 5, "{name}");
        let [top, bottom] = [0, SIZE.1 - 1].map(|y| picture.get_pixel(0, y).0);
        assert!(
            top.iter().all(|v| (200..255).contains(v)) && top != bottom,
            "{name}: {top:?}"
        );
    }
}
