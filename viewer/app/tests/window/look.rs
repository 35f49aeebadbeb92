//! What the panels and keys change about the picture.

use egui::Key;
use egui_kittest::kittest::Queryable;
use viewer::frame::PassKind;

use crate::driver::{Driver, different};

/// A slab over a floor, lit from above.
const SLAB: &str = "#Inventor V2.1 ascii
Separator {
  PerspectiveCamera { position 3 -9 7 orientation 1 0 0 0.92 }
  DEF Sun DirectionalLight { direction 0.3 0.2 -1 }
  ShapeHints { vertexOrdering COUNTERCLOCKWISE shapeType SOLID }
  Material { diffuseColor 0.8 0.7 0.6 }
  DEF Floor Cube { width 8 height 8 depth 0.2 }
  Translation { translation 0 0 1.5 }
  DEF Slab Cube { width 2 height 2 depth 0.3 }
}
";

fn has_volumes(driver: &mut Driver) -> bool {
    let (plan, _) = driver.app().canvas.last.as_ref().unwrap();
    let is_volumes = |kind: PassKind| matches!(kind, PassKind::Volumes { .. });
    plan.passes.iter().any(|pass| is_volumes(pass.kind))
}

#[test]
fn shadows_are_switched_by_key_and_by_click() {
    let mut driver = Driver::with_text(SLAB);
    let with = driver.picture();
    assert!(has_volumes(&mut driver));
    driver.key(Key::S);
    let without = driver.picture();
    assert!(!has_volumes(&mut driver));
    assert!(different(&with, &without) > 500);
    driver.harness.get_by_label("Shadows").click();
    driver.settle();
    assert!(has_volumes(&mut driver));
    assert_eq!(different(&with, &driver.picture()), 0);
}

#[test]
fn lights_are_switched_and_dimmed() {
    let mut driver = Driver::with_text(SLAB);
    let lit = driver.picture();
    driver.harness.get_by_label("Sun").click();
    driver.settle();
    let brightest = |image: &image::RgbaImage| image.pixels().map(|p| p.0[0]).max().unwrap();
    let dark = driver.picture();
    assert!(brightest(&dark) < brightest(&lit) / 2);
    driver.harness.get_by_label("Headlight").click();
    driver.settle();
    assert!(brightest(&driver.picture()) > brightest(&dark));
}

#[test]
fn overlays_are_seen_and_leave_no_trace() {
    let mut driver = Driver::with_text(SLAB);
    let plain = driver.picture();
    for key in [
        Key::W,
        Key::E,
        Key::D,
        Key::N,
        Key::O,
        Key::V,
        Key::G,
        Key::X,
    ] {
        driver.key(key);
        let over = different(&plain, &driver.picture());
        assert!(over > 5, "{key:?}: {over} pixels");
        driver.key(key);
        assert_eq!(different(&plain, &driver.picture()), 0, "{key:?}");
    }
}

#[test]
fn a_section_opens_the_model_and_caps_it() {
    let mut driver = Driver::with_text(SLAB);
    let whole = driver.picture();
    driver.key(Key::K);
    let cut = driver.picture();
    assert!(different(&whole, &cut) > 1000);
    // The side with larger x is away: nothing is drawn and picked there.
    for (x, is_there) in [(-0.5, true), (1.0, false)] {
        let place = driver.place_of(glam::DVec3::new(x, -3.5, 0.1));
        assert_eq!(driver.app().hit_below(place).is_some(), is_there, "{x}");
    }
    // Caps are 0.7 times the surface's colour, whatever the light.
    let near = |a: u8, b: u8| a.abs_diff(b) <= 1;
    let is_cap = |p: &&image::Rgba<u8>| near(p.0[0], 143) && near(p.0[1], 125) && near(p.0[2], 107);
    assert!(cut.pixels().filter(is_cap).count() > 100);
    assert_eq!(whole.pixels().filter(is_cap).count(), 0);
    driver.key(Key::K);
    assert_eq!(different(&whole, &driver.picture()), 0);
}

#[test]
fn the_cheat_sheet_lists_all_keys() {
    let mut driver = Driver::with_text(SLAB);
    driver.harness.event(egui::Event::Text("?".to_owned()));
    driver.settle();
    for entry in app::ui::command::ALL
        .iter()
        .filter(|entry| entry.key.is_some())
    {
        let found = driver.harness.query_all_by_label(entry.text).count();
        assert!(found >= 1, "{}", entry.text);
    }
}
