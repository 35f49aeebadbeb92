//! What the user reads on standard error: a block for each input, and one line about all.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::time::Duration;

use convert::command::messages::{Style, error_line, number, printable, remarks, seconds};
use iv_parser::{Diagnostic, Severity};

use super::args::Args;
use super::job::{NamedLoss, Outcome};
use super::{DONE, FAILED, INCOMPLETE};

/// How much is shown, as the user wants it.
pub fn style(args: &Args) -> Style {
    let see = match &args.report {
        Some(path) => format!("see {}", path.display()),
        None if args.info => "see --json".to_owned(),
        None => "see --report".to_owned(),
    };
    Style {
        is_quiet: args.quiet,
        see,
    }
}

/// Warnings about something that was understood all the same, or was not there: they lose nothing.
const LOSSLESS_REPAIRS: [&str; 14] = [
    "bool-case",
    "byte-order-mark",
    "empty",
    "glued-brace",
    "late-header",
    "mask-number",
    "missing-bracket",
    "missing-paren",
    "no-brackets",
    "no-geometry",
    "no-header",
    "stray-comma",
    "unknown-version",
    "word-guessed",
];

/// All about one conversion, without a line end behind it; empty if there is nothing to say.
pub fn block(outcome: &Outcome, style: &Style) -> String {
    let diagnostics: Vec<Diagnostic> = outcome
        .diagnostics
        .iter()
        .chain(&outcome.warnings)
        .cloned()
        .collect();
    lines(
        &outcome.input,
        &diagnostics,
        &outcome.losses,
        outcome.failure.as_deref(),
        style,
    )
}

/// As [`block`], from parts.
pub fn lines(
    input: &Path,
    diagnostics: &[Diagnostic],
    losses: &[NamedLoss],
    failure: Option<&str>,
    style: &Style,
) -> String {
    let mut lines = remarks(input, diagnostics, style);
    if !style.is_quiet {
        let major = losses.iter().filter(|l| !l.loss.kind.is_minor());
        lines.extend(major.map(loss_line));
    }
    if let Some(why) = failure {
        lines.push(error_line(&input.display().to_string(), why));
    }
    printable(&lines.join("\n"))
}

fn loss_line(named: &NamedLoss) -> String {
    let loss = &named.loss;
    let mut line = format!("{}{}", named.file, loss.pos);
    // Writing to a String does not fail.
    let _ = write!(line, ": loss[{}]: {}", loss.kind.code(), loss.kind.text());
    if !loss.detail.is_empty() {
        let _ = write!(line, ": {}", loss.detail);
    }
    if loss.count > 1 {
        let _ = write!(line, " ({} times)", loss.count);
    }
    line
}

/// Counts over all inputs.
#[derive(Clone, Debug, Default)]
pub struct Totals {
    /// Inputs with an output.
    pub converted: usize,
    /// The last output.
    pub output: Option<PathBuf>,
    /// Inputs without.
    pub failed: usize,
    /// Kinds of losses, summed over the inputs.
    pub losses: usize,
    /// Diagnostics of severity error.
    pub errors: usize,
    /// All other remarks.
    pub warnings: usize,
    /// Remarks on what could have been in an output and is not.
    pub left_out: usize,
    /// Whether the report could not be written.
    pub report_failed: bool,
}

impl Totals {
    /// Counts one more input.
    pub fn add(&mut self, outcome: &Outcome) {
        if outcome.failure.is_some() {
            self.failed += 1;
        } else {
            self.converted += 1;
            self.output.clone_from(&outcome.output);
        }
        let is_error = |d: &&Diagnostic| d.severity == Severity::Error;
        let errors = outcome.diagnostics.iter().filter(is_error).count();
        self.errors += errors;
        let is_warning = |d: &&Diagnostic| d.severity == Severity::Warning;
        let warnings = outcome.diagnostics.iter().filter(is_warning).count();
        self.warnings += warnings + outcome.warnings.len();
        let losses = outcome.losses.iter();
        self.losses += losses.filter(|l| !l.loss.kind.is_minor()).count();
        let remarks = outcome.diagnostics.iter().chain(&outcome.warnings);
        let loses = |d: &&Diagnostic| {
            d.severity >= Severity::Warning && !LOSSLESS_REPAIRS.contains(&d.code)
        };
        self.left_out += remarks.filter(loses).count();
    }

    /// One line about all.
    pub fn summary(&self, time: Duration) -> String {
        let mut parts = vec![match (&self.output, self.converted) {
            (Some(output), 1) => format!("1 converted to {}", output.display()),
            _ => format!("{} converted", self.converted),
        }];
        if self.failed > 0 {
            parts.push(format!("{} failed", self.failed));
        }
        let counts = [
            (self.losses, "loss"),
            (self.errors, "error"),
            (self.warnings, "warning"),
        ];
        for (count, what) in counts {
            if count > 0 {
                parts.push(number(count, what));
            }
        }
        parts.push(seconds(time));
        printable(&parts.join(", "))
    }

    /// The exit code of the command.
    pub fn exit_code(&self, is_strict: bool) -> u8 {
        let is_complete = self.losses == 0 && self.errors == 0 && self.left_out == 0;
        if self.failed > 0 || self.report_failed {
            FAILED
        } else if is_strict && !is_complete {
            INCOMPLETE
        } else {
            DONE
        }
    }
}
