//! Files that come, change, break and go out.

use std::io::Write;
use std::path::Path;
use std::time::{Duration, Instant};

use app::ui::Question;
use egui::{Event, Key, PointerButton};
use egui_kittest::kittest::Queryable;
use viewer::texture::Images;

use crate::driver::{Driver, different};

fn cube(color: &str) -> String {
    format!(
        "#Inventor V2.1 ascii\nSeparator {{ DEF Box Separator {{ Material {{ diffuseColor {color} }} Cube {{ }} }} }}\n"
    )
}

fn redness(driver: &mut Driver) -> (u8, u8) {
    let picture = driver.picture();
    let p = picture
        .get_pixel(picture.width() / 2, picture.height() / 2)
        .0;
    (p[0], p[1])
}

#[test]
fn a_change_is_shown_from_the_same_place_and_a_broken_one_is_not() {
    let mut driver = Driver::with_text(&cube("1 0 0"));
    let path = driver.folder.path().join("model.iv");
    assert_eq!(driver.app().counters.pictures, 1);
    let (from, to) = (driver.place(0.5, 0.5), driver.place(0.55, 0.5));
    driver.drag(from, to, PointerButton::Primary);
    let view = driver.app().navigator.unwrap().view;
    assert!(redness(&mut driver).0 > 100);

    // As editors save: another file, renamed.
    let next = driver.folder.path().join("model.iv~");
    std::fs::write(&next, cube("0 1 0")).unwrap();
    std::fs::rename(&next, &path).unwrap();
    driver.until("the change is read", |app| app.loading.is_some());
    driver.settle();
    let (red, green) = redness(&mut driver);
    assert!(red < 40 && green > 100, "{red} {green}");
    assert_eq!(driver.app().navigator.unwrap().view, view);

    std::fs::write(&path, "#X3D V3.0 utf8\nShape { }\n").unwrap();
    driver.until("the broken change is read", |app| app.loading.is_some());
    driver.settle();
    assert!(redness(&mut driver).1 > 100, "the old scene stays");
    let notice = driver.app().notice.clone().unwrap();
    assert!(
        notice.is_error && notice.text.contains("stays"),
        "{notice:?}"
    );
    assert!(
        driver
            .harness
            .query_all_by_label("[unsupported-format]")
            .count()
            >= 1
    );

    std::fs::write(&path, cube("1 1 0")).unwrap();
    driver.until("the mended file is read", |app| app.loading.is_some());
    driver.settle();
    let (red, green) = redness(&mut driver);
    assert!(red > 100 && green > 100);
    assert_eq!(driver.app().navigator.unwrap().view, view);
}

#[test]
fn a_first_file_that_is_broken_is_watched() {
    let mut driver = Driver::with_text("#X3D V3.0 utf8\nShape { }\n");
    assert!(driver.app().model.is_none());
    let (path, wakes) = (driver.folder.path().join("model.iv"), driver.wakes());
    std::fs::write(&path, cube("1 1 0")).unwrap();
    let start = Instant::now();
    while driver.wakes() == wakes {
        assert!(start.elapsed() < Duration::from_secs(10), "nobody noticed");
        std::thread::sleep(Duration::from_millis(10));
    }
    driver.until("it is shown", |app| app.model.is_some());
}

#[test]
fn passwords_of_archives_are_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("models.ivz");
    let mut archive = zip::ZipWriter::new(std::fs::File::create(&path).unwrap());
    let options =
        zip::write::SimpleFileOptions::default().with_aes_encryption(zip::AesMode::Aes256, "ivory");
    archive.start_file("cube.iv", options).unwrap();
    archive.write_all(cube("1 0 0").as_bytes()).unwrap();
    archive.finish().unwrap();

    let mut driver = Driver::begin(folder, &[&path.display().to_string()]);
    for (password, next) in [("guess", "That was not"), ("ivory", "")] {
        assert!(driver.app().model.is_none());
        assert_eq!(driver.harness.query_all_by_label("Password").count(), 1);
        driver.harness.event(Event::Text(password.to_owned()));
        driver.harness.step();
        driver.key(Key::Enter);
        let said = driver.harness.query_all_by_label_contains(next).count();
        assert!(next.is_empty() || said > 0, "{password}");
    }
    assert_eq!(driver.harness.query_all_by_label("Password").count(), 0);
    assert!(redness(&mut driver).0 > 100);
    // A notice of a password that was not right is no longer there.
    assert_eq!(driver.app().notice, None);

    // Escape is no answer, and changes nothing else.
    driver.app().select(Some(0));
    std::fs::copy(&path, driver.folder.path().join("other.ivz")).unwrap();
    let other = driver.folder.path().join("other.ivz");
    driver.drop_file(&other);
    assert_eq!(driver.harness.query_all_by_label("Password").count(), 1);
    driver.key(Key::Escape);
    assert_eq!(driver.harness.query_all_by_label("Password").count(), 0);
    assert_eq!(driver.app().selected, Some(0));

    // Nobody is asked when there is nothing to know.
    std::fs::write(&path, "PK\u{3}\u{4}, and no more").unwrap();
    driver.until("the broken archive is read", |app| app.loading.is_some());
    driver.settle();
    assert_eq!(driver.harness.query_all_by_label("Password").count(), 0);
}

#[test]
fn a_second_file_is_dropped() {
    let mut driver = Driver::with_text(&cube("1 0 0"));
    let first = driver.picture();
    let other = samples::data_dir().join("shapes/gear.iv");
    driver.drop_file(&other);
    assert_eq!(driver.app().title(), "gear.iv – ivview");
    assert!(different(&first, &driver.picture()) > 100);
    // Both are remembered, the last one first.
    let recent = driver.app().config.recent.clone();
    let names: Vec<_> = recent
        .iter()
        .map(|p| p.file_name().unwrap().to_string_lossy())
        .collect();
    assert_eq!(names, ["gear.iv", "model.iv"]);
    driver.key(Key::PageUp);
    assert_eq!(driver.app().title(), "model.iv – ivview");
    assert_eq!(different(&first, &driver.picture()), 0);
    let kept = driver.folder.path().join("config/ivview.json");
    assert_eq!(app::config::Config::read(&kept).recent.len(), 2);
}

#[test]
fn glb_is_shown_with_its_textures() {
    let mut driver = Driver::with_sample("textures/wrap_modes.iv");
    let model = driver.app().model.as_ref().unwrap();
    assert!(
        model.renderer.texture_count() > 0,
        "textures follow the first picture"
    );
    let with = driver.picture();
    let glb = driver.folder.path().join("wrap.glb");
    driver.answer(Question::Export, &glb);
    driver.drop_file(&glb);
    assert_eq!(driver.app().title(), "wrap.glb – ivview");
    let model = driver.app().model.as_ref().unwrap();
    assert_eq!(model.format, "gltf");
    assert!(model.renderer.texture_count() > 0);
    assert_eq!(with.dimensions(), driver.picture().dimensions());
}

#[test]
fn pictures_and_parts_go_out() {
    let mut driver = Driver::with_sample("pavilion.iv");
    let folder = driver.folder.path().to_owned();
    let shown = driver.picture();
    driver.answer(Question::SavePicture, &folder.join("same.png"));
    let saved = image::open(folder.join("same.png")).unwrap().to_rgba8();
    assert_eq!(different(&shown, &saved), 0);
    driver.app().picture_size = Some((333, 222));
    driver.answer(Question::SavePicture, &folder.join("own.png"));
    let saved = image::open(folder.join("own.png")).unwrap();
    assert_eq!((saved.width(), saved.height()), (333, 222));
    assert_eq!(
        different(&shown, &driver.picture()),
        0,
        "the window shows its own size again"
    );

    driver.answer(Question::ExportSelection, &folder.join("none.glb"));
    assert!(driver.app().notice.clone().unwrap().is_error);
    let place = driver.place(0.5, 0.5);
    driver.click(place);
    let selected = driver.app().selected_instances().len();
    for name in ["part.glb", "part.gltf", "part.iv"] {
        driver.answer(Question::ExportSelection, &folder.join(name));
        let notice = driver.app().notice.clone().unwrap();
        assert!(!notice.is_error, "{notice:?}");
        assert_eq!(instances(&folder.join(name)), selected, "{name}");
    }
    driver.answer(Question::Export, &folder.join("all.xyz"));
    assert!(driver.app().notice.clone().unwrap().text.contains(".glb"));
}

/// How many parts a file shows.
fn instances(path: &Path) -> usize {
    let bytes = std::fs::read(path).unwrap();
    let folder = path.parent().unwrap();
    let loader = scenegraph::FileLoader::new([folder]);
    if path.extension().unwrap() == "iv" {
        let graph = scenegraph::load(&bytes, "a.iv", folder, &loader);
        let options = scenegraph::ResolveOptions::default();
        return scenegraph::resolve(&graph, &options).scene.instances.len();
    }
    let limits = convert::ReadLimits::default();
    let model = convert::read_gltf(&bytes, "a.glb", folder, &loader, &limits).unwrap();
    model.scene.instances.len()
}

#[test]
fn the_window_shows_what_output_draws() {
    let mut driver = Driver::with_sample("pavilion.iv");
    let (width, height) = driver.app().canvas.size;
    let shown = driver.picture();
    // The same through the library, as `--output` does it.
    let model = driver.app().model.as_ref().unwrap();
    let scene = std::sync::Arc::clone(&model.scene);
    let camera = scene.cameras.first().unwrap();
    let (view, region) = viewer::view::View::from_scene_camera(camera, width, height);
    let files = scenegraph::FileLoader::new([samples::data_dir().as_path()]);
    let images = Images::load(&scene, &convert::command::model::Images(&files));
    let gpu = viewer::gpu::Gpu::new(viewer::gpu::AdapterChoice::Software).unwrap();
    let mut renderer = viewer::gpu::Renderer::new(gpu, scene, &images).unwrap();
    let settings = viewer::frame::Settings::default();
    renderer
        .draw(&view, &region, (width, height), &settings)
        .unwrap();
    let drawn = image::RgbaImage::from_raw(width, height, renderer.read().unwrap()).unwrap();
    assert_eq!(different(&shown, &drawn), 0);
}
