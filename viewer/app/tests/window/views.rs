//! Looking from elsewhere: by mouse, keys, cameras and saved views.

use app::ui::Question;
use egui::{Key, PointerButton};
use glam::DVec3;
use viewer::view::{Lens, View, ivv};

use crate::driver::{Driver, different};

fn view(driver: &mut Driver) -> View {
    driver.app().navigator.as_ref().unwrap().view
}

#[test]
fn dragging_turns_around_what_is_below() {
    let mut driver = Driver::with_sample("pavilion.iv");
    let (first, before) = (driver.picture(), view(&mut driver));
    let place = driver.place(0.5, 0.5);
    let p = driver.app().hit_below(place).unwrap().p_in_world;
    let to = driver.place(0.3, 0.55);
    driver.drag(place, to, PointerButton::Primary);
    let after = view(&mut driver);
    assert!(different(&first, &driver.picture()) > 1000);
    assert!(
        (after.right().z - before.right().z).abs() < 1e-9,
        "the horizon stays level"
    );
    let (from, to) = (before.eye.distance(p), after.eye.distance(p));
    assert!((from - to).abs() < 1e-6, "{from} {to}");

    let right = driver.place(0.7, 0.5);
    let (from, to) = (driver.place(0.5, 0.5), right);
    driver.drag(from, to, PointerButton::Middle);
    let panned = view(&mut driver);
    assert_eq!(panned.orientation, after.orientation);
    assert!(panned.eye.distance(after.eye) > 0.1);
    driver.drag(from, to, PointerButton::Secondary);
    let looked = view(&mut driver);
    assert_eq!(looked.eye, panned.eye);
    assert!(looked.forward().dot(panned.forward()) < 0.999);
}

#[test]
fn the_wheel_keeps_what_is_below_the_mouse() {
    let mut driver = Driver::with_sample("pavilion.iv");
    let place = driver.place(0.4, 0.6);
    let before = driver.app().hit_below(place).unwrap();
    driver.scroll(place, 200.0);
    let after = driver.app().hit_below(place).unwrap();
    assert!(after.depth < 0.9 * before.depth);
    let size = driver.app().canvas.size;
    let pixel = before.depth / f64::from(size.1);
    assert!(after.p_in_world.distance(before.p_in_world) < 4.0 * pixel);
}

#[test]
fn a_double_click_goes_to_the_point() {
    let mut driver = Driver::with_sample("pavilion.iv");
    let place = driver.place(0.3, 0.6);
    let before = view(&mut driver);
    let p = driver.app().hit_below(place).unwrap().p_in_world;
    driver.double_click(place);
    let after = view(&mut driver);
    let half = before.eye.distance(p) / 2.0;
    assert!((after.eye.distance(p) - half).abs() < 1e-6);
    assert!(((p - after.eye).normalize() - after.forward()).length() < 1e-6);
}

#[test]
fn standard_views_lenses_and_cameras() {
    let mut driver = Driver::with_text(
        "#Inventor V2.1 ascii\nSeparator { DEF Near PerspectiveCamera { position 0 0 6 } \
         DEF Far PerspectiveCamera { position 2 1 20 } Cube { } }",
    );
    let first = driver.picture();
    let rows = [
        (Key::Num1, DVec3::Y),
        (Key::Num2, DVec3::NEG_Y),
        (Key::Num3, DVec3::X),
        (Key::Num4, DVec3::NEG_X),
        (Key::Num5, DVec3::NEG_Z),
        (Key::Num6, DVec3::Z),
    ];
    for (key, forward) in rows {
        driver.key(key);
        let view = view(&mut driver);
        assert!(view.forward().dot(forward) > 0.999, "{key:?}");
        assert!(
            view.eye.dot(forward) < -1.0,
            "{key:?}: all of it is before the eye"
        );
    }
    driver.key(Key::P);
    assert!(matches!(view(&mut driver).lens, Lens::Orthographic { .. }));
    driver.key(Key::P);
    assert!(matches!(view(&mut driver).lens, Lens::Perspective { .. }));
    driver.key(Key::Home);
    assert_eq!(different(&first, &driver.picture()), 0);
    driver.key(Key::C);
    driver.key(Key::C);
    assert!(
        different(&first, &driver.picture()) > 100,
        "the second camera"
    );
}

#[test]
fn views_are_saved_and_loaded() {
    let mut driver = Driver::with_sample("pavilion.iv");
    let (from, to) = (driver.place(0.5, 0.5), driver.place(0.6, 0.4));
    driver.drag(from, to, PointerButton::Primary);
    let saved = view(&mut driver);
    let path = driver.folder.path().join("garden.ivv");
    driver.answer(Question::SaveView, &path);
    let file = ivv::read(&std::fs::read(&path).unwrap()).unwrap();
    assert_eq!(file.name, "garden");
    driver.key(Key::A);
    driver.answer(Question::LoadView, &path);
    let loaded = view(&mut driver);
    // Three decimals.
    assert!(loaded.eye.distance(saved.eye) < 1e-3);
    assert!((loaded.forward() - saved.forward()).length() < 3e-4);

    // Dropped, in the oldest version.
    let old = "CADWORK_IVV_FORMAT_v2\r\n\r\nType: PerspectiveCamera\r\nPosition: 2600100.000 1200000.000 600.000\r\n\
               LookAt: 2600080.000 1200060.000 556.000\r\nOpeningAngle: 40.000\r\nRotation: 0.000\r\n";
    let path = driver.folder.path().join("old.IVV");
    std::fs::write(&path, old).unwrap();
    driver.drop_file(&path);
    assert_eq!(
        view(&mut driver).eye.to_array(),
        [2_600_100.0, 1_200_000.0, 600.0]
    );
    let damaged = driver.folder.path().join("damaged.ivv");
    std::fs::write(&damaged, "CADWORK_IVV_FORMAT_v9\r\n").unwrap();
    driver.drop_file(&damaged);
    let notice = driver.app().notice.clone().unwrap();
    assert!(
        notice.is_error && notice.text.contains("unknown version"),
        "{notice:?}"
    );
    assert_eq!(view(&mut driver).eye.x, 2_600_100.0, "the view stays");
}
