//! Random events: no harm, and no more memory. A process of its own, whose memory is its own.

// Helpers of tests stop a test as an assertion does, and not all of them are used here.
#![allow(clippy::unwrap_used, clippy::expect_used, dead_code)]

#[path = "../window/driver.rs"]
mod driver;

use std::time::{Duration, Instant};

use egui::{Event, Key, Modifiers, PointerButton, pos2, vec2};

use app::ui::{Measure, Over};
use driver::Driver;
use viewer::frame::Settings;

/// Seconds that random events go on: a few in ordinary runs, `SOAK_SECONDS` for more.
fn soak_time() -> Duration {
    let seconds = std::env::var("SOAK_SECONDS").ok();
    let seconds = seconds.and_then(|text| text.parse().ok());
    Duration::from_secs(seconds.unwrap_or(8))
}

/// A small generator of numbers (Marsaglia's xorshift).
struct Random(u64);

impl Random {
    fn below(&mut self, end: u64) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0 % end
    }
}

/// Bytes of memory that the process has in use; 0 where the system does not say.
fn resident_bytes() -> u64 {
    let text = std::fs::read_to_string("/proc/self/statm").unwrap_or_default();
    let pages = text
        .split_whitespace()
        .nth(1)
        .and_then(|word| word.parse().ok());
    pages.unwrap_or(0_u64) * 4096
}

/// Memory in use while one model is shown in one way: a shadow map alone, which an event may have
/// chosen, takes more than all else.
fn bytes_at_rest(driver: &mut Driver) -> u64 {
    driver.drop_file(&samples::data_dir().join("shapes/primitives.iv"));
    let app = driver.app();
    app.settings = Settings::default();
    app.over = Over::default();
    app.measure = Measure::default();
    driver.settle();
    resident_bytes()
}

#[test]
fn random_events_do_no_harm() {
    let mut driver = Driver::with_sample("shapes/primitives.iv");
    let others = [
        "lights/cameras.iv",
        "textures/wrap_modes.iv",
        "shapes/gear.iv",
        "shapes/primitives.iv",
    ];
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    let start = Instant::now();
    let mut settled: Option<u64> = None;
    let mut events = 0_u64;
    while start.elapsed() < soak_time() {
        let at = pos2(random.below(1300) as f32, random.below(640) as f32);
        match random.below(12) {
            0..=3 => driver.harness.hover_at(at),
            4..=6 => {
                let buttons = [
                    PointerButton::Primary,
                    PointerButton::Middle,
                    PointerButton::Secondary,
                ];
                driver.harness.event(Event::PointerButton {
                    pos: at,
                    button: buttons[random.below(3) as usize],
                    pressed: random.below(2) == 0,
                    modifiers: Modifiers::NONE,
                });
            }
            7 => driver.harness.event(Event::MouseWheel {
                unit: egui::MouseWheelUnit::Point,
                delta: vec2(0.0, random.below(400) as f32 - 200.0),
                phase: egui::TouchPhase::Move,
                source: egui::MouseWheelSource::Unknown,
                modifiers: Modifiers::NONE,
            }),
            8..=10 => {
                // All keys but those that open dialogs of the system.
                let key = Key::ALL[random.below(Key::ALL.len() as u64) as usize];
                driver.harness.key_press(key);
            }
            _ if random.below(20) == 0 => {
                let other = others[random.below(4) as usize];
                driver.drop_file(&samples::data_dir().join(other));
            }
            _ => driver.harness.remove_cursor(),
        }
        driver.harness.step();
        events += 1;
        // After a third of the time everything that is kept has been made once.
        if settled.is_none() && start.elapsed() > soak_time() / 3 {
            settled = Some(bytes_at_rest(&mut driver));
        }
    }
    let (before, after) = (settled.unwrap_or(0), bytes_at_rest(&mut driver));
    println!("{events} events, {} to {} MiB", before >> 20, after >> 20);
    assert!(driver.app().counters.lost == 0);
    assert!(
        after < before + before / 4 + (64 << 20),
        "{before} to {after} bytes"
    );
}
