//! The terminal: messages to standard error, results to standard output, and a progress bar that
//! neither runs into. Nothing else in the command prints.

use std::io::{self, ErrorKind, IsTerminal, Write};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

/// Time that a single input may take before progress is shown.
const PATIENCE: Duration = Duration::from_secs(1);

/// Where messages go.
pub struct Screen {
    bar: Option<ProgressBar>,
    /// Number of inputs.
    count: usize,
    shows_progress: bool,
    start: Instant,
    output_failed: bool,
}

impl Screen {
    /// For work on `count` inputs. A bar is shown on terminals only, and not if `quiet`.
    pub fn new(count: usize, quiet: bool) -> Self {
        Self {
            bar: None,
            count,
            shows_progress: !quiet && io::stderr().is_terminal(),
            start: Instant::now(),
            output_failed: false,
        }
    }

    /// Shows how far the work is.
    pub fn tick(&mut self, finished: usize) {
        let is_long = self.count > 1 || self.start.elapsed() > PATIENCE;
        if self.bar.is_none() && self.shows_progress && is_long && finished < self.count {
            self.bar = Some(bar(self.count).with_elapsed(self.start.elapsed()));
        }
        if let Some(bar) = &self.bar {
            bar.set_position(finished as u64);
            bar.tick();
        }
    }

    /// Prints to standard error. Adds the end of the line.
    pub fn message(&self, text: &str) {
        if !text.is_empty() {
            // If standard error is gone, there is nobody to tell.
            self.aside(|| {
                let _ = writeln!(io::stderr().lock(), "{text}");
            });
        }
    }

    /// Prints to standard output. A reader that has gone away (`| head`) is no failure.
    pub fn output(&mut self, text: &str) {
        let mut result = Ok(());
        self.aside(|| {
            let mut out = io::stdout().lock();
            result = out.write_all(text.as_bytes()).and_then(|()| out.flush());
        });
        match result {
            Err(error) if error.kind() != ErrorKind::BrokenPipe && !self.output_failed => {
                self.output_failed = true;
                self.message(&format!("ivconvert: error: cannot print: {error}"));
            }
            _ => {}
        }
    }

    /// Whether results could not be printed.
    pub fn output_failed(&self) -> bool {
        self.output_failed
    }

    /// Takes the bar away.
    pub fn finish(&mut self) {
        self.shows_progress = false;
        if let Some(bar) = self.bar.take() {
            bar.finish_and_clear();
        }
    }

    /// Does `print` with the bar out of the way.
    fn aside(&self, print: impl FnOnce()) {
        match &self.bar {
            Some(bar) => bar.suspend(print),
            None => print(),
        }
    }
}

fn bar(count: usize) -> ProgressBar {
    let (bar, template) = if count > 1 {
        let bar = ProgressBar::new(count as u64);
        (bar, "{bar:40} {pos}/{len}  {elapsed}")
    } else {
        (ProgressBar::new_spinner(), "{spinner} {elapsed}")
    };
    match ProgressStyle::with_template(template) {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}
