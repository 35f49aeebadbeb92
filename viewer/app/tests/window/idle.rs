//! Rest and loss: nothing is drawn when nothing changes, and a lost device comes back.

use std::time::{Duration, Instant};

use egui::{PointerButton, ViewportId};

use crate::driver::{Driver, different};

#[test]
fn nothing_is_drawn_without_a_reason() {
    let mut driver = Driver::with_sample("pavilion.iv");
    // Without textures, and with them: showing the panels has edited nothing.
    let pictures = driver.app().counters.pictures;
    assert!(pictures <= 2, "{pictures} pictures");
    let revision = driver.app().model.as_ref().unwrap().revision;
    assert_eq!(revision, 1);
    let start = Instant::now();
    while start.elapsed() < Duration::from_secs(5) {
        driver.harness.step();
        let output = driver.harness.output();
        let delay = output.viewport_output[&ViewportId::ROOT].repaint_delay;
        assert!(
            delay > Duration::from_secs(60),
            "a frame is asked for in {delay:?}"
        );
        std::thread::sleep(Duration::from_millis(50));
    }
    assert_eq!(driver.app().counters.pictures, pictures);
    // The mouse alone moves the interface, not the scene.
    for i in 0..20 {
        let place = driver.place(0.3 + 0.01 * i as f32, 0.5);
        driver.harness.hover_at(place);
        driver.harness.step();
    }
    assert_eq!(driver.app().counters.pictures, pictures);
}

#[test]
fn a_lost_device_comes_back() {
    let mut driver = Driver::with_sample("pavilion.iv");
    let (from, to) = (driver.place(0.5, 0.5), driver.place(0.6, 0.45));
    driver.drag(from, to, PointerButton::Primary);
    let before = driver.picture();
    let model = driver.app().model.as_ref().unwrap();
    model.renderer.gpu.device.destroy();
    driver.app().settings.samples = 4;
    driver.until("the loss is seen", |app| app.counters.lost > 0);
    driver.app().settings.samples = 1;
    driver.until("it is back", |app| app.model.is_some());
    driver.settle();
    assert_eq!(driver.app().device_revision, 1);
    assert_eq!(
        different(&before, &driver.picture()),
        0,
        "from the same place"
    );
}
