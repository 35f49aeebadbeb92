//! Selecting, hiding, isolating, measuring; the tree and the properties.

use egui::Key;
use egui_kittest::kittest::Queryable;

use crate::driver::{Driver, different};

/// A red cube to the left of a green one that stands twice.
const CUBES: &str = "#Inventor V2.1 ascii
Separator {
  OrthographicCamera { position 0 0 10 height 6 }
  DirectionalLight { direction 0 0 -1 }
  DEF Left Separator { Translation { translation -2 0 0 } Material { diffuseColor 1 0 0 } DEF Red Cube { } }
  DEF Green Separator { Material { diffuseColor 0 1 0 } Cube { } }
  Separator { Translation { translation 3 0 0 } USE Green }
}
";

#[test]
fn what_is_clicked_is_selected_hidden_and_shown_again() {
    let mut driver = Driver::with_text(CUBES);
    let first = driver.picture();
    let middle = driver.place(0.5, 0.5);
    let corner = driver.place(0.02, 0.02);

    driver.click(middle);
    assert_eq!(driver.selected().as_deref(), Some("Faces"));
    assert_eq!(driver.app().selected_instances(), [1]);
    let tinted = driver.picture();
    assert!(different(&first, &tinted) > 1000, "the selection is seen");
    driver.click(corner);
    assert_eq!(driver.selected(), None);
    assert_eq!(different(&first, &driver.picture()), 0);

    driver.click(middle);
    driver.key(Key::Delete);
    assert_eq!(driver.selected(), None);
    let without = driver.picture();
    let place = (first.width() / 2, first.height() / 2);
    assert_eq!(without.get_pixel(place.0, place.1).0[..3], [0, 0, 0]);
    driver.click(middle);
    assert_eq!(driver.selected(), None, "what is hidden is not picked");
    driver.key(Key::U);
    assert_eq!(different(&first, &driver.picture()), 0);

    driver.click(middle);
    driver.key(Key::I);
    driver.key(Key::Escape);
    let alone = driver.picture();
    let green = |image: &image::RgbaImage| image.pixels().filter(|p| p.0[1] > 128).count();
    let red = |image: &image::RgbaImage| image.pixels().filter(|p| p.0[0] > 128).count();
    assert_eq!(red(&alone), 0);
    assert!(
        green(&alone) > 0 && green(&alone) < green(&first),
        "one of two instances"
    );
}

#[test]
fn the_tree_is_searched_and_selects() {
    let mut driver = Driver::with_text(CUBES);
    driver.app().search("re");
    driver.settle();
    let labels: Vec<String> = ["Red", "Green"].map(str::to_owned).to_vec();
    for label in &labels {
        assert!(
            driver.harness.query_all_by_label(label).count() >= 1,
            "{label}"
        );
    }
    assert_eq!(driver.harness.query_all_by_label("Left").count(), 0);
    driver.harness.get_by_label("Red").click();
    driver.settle();
    assert_eq!(driver.selected().as_deref(), Some("Red"));
    assert_eq!(driver.app().selected_instances(), [0]);
    // The properties show the node as it stands in the file, with its line.
    driver.until("the source is read", |app| app.knows_source());
    driver.settle();
    assert_eq!(driver.harness.query_all_by_label("DEF Red Cube").count(), 1);
    assert_eq!(driver.harness.query_all_by_label("line 5").count(), 1);
    assert!(driver.harness.query_all_by_label("width").count() >= 1);
}

#[test]
fn distances_are_measured_between_corners() {
    let mut driver = Driver::with_text(CUBES);
    driver.key(Key::M);
    // Near corners of the green cube.
    for (x, y) in [(-0.97, -0.97), (0.97, -0.97), (0.97, 0.97)] {
        let place = driver.place_of(glam::DVec3::new(x, y, 1.0));
        driver.click(place);
    }
    let measured = driver.app().measure.results();
    assert_eq!(driver.app().measure.points.len(), 3);
    assert_eq!(measured.distance, Some(2.0), "it snaps to corners");
    assert_eq!(measured.length, Some(4.0));
    assert!((measured.angle_deg.unwrap() - 90.0).abs() < 1e-9);
    assert!((measured.area.unwrap() - 2.0).abs() < 1e-9);
    assert_eq!(
        driver.selected(),
        None,
        "clicks measure, and select nothing"
    );
}
