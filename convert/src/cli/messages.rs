//! What the user reads on standard error: a block for each input, and one line about all.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::time::Duration;

use iv_parser::{Diagnostic, Severity};

use super::args::Args;
use super::job::{NamedLoss, Outcome};
use super::{DONE, FAILED, INCOMPLETE};

/// Diagnostics of one input that are printed in full.
const MAX_SHOWN: usize = 20;

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

/// How much is shown.
#[derive(Clone, Debug)]
pub struct Style {
    /// Errors only.
    is_quiet: bool,
    /// Where the rest can be read.
    see: String,
}

impl Style {
    /// As the user wants it.
    pub fn of(args: &Args) -> Self {
        let see = match &args.report {
            Some(path) => format!("see {}", path.display()),
            None if args.info => "see --json".to_owned(),
            None => "see --report".to_owned(),
        };
        Self {
            is_quiet: args.quiet,
            see,
        }
    }
}

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
    let mut lines = Vec::new();
    let least = if style.is_quiet {
        Severity::Error
    } else {
        Severity::Note
    };
    let worth: Vec<&Diagnostic> = diagnostics.iter().filter(|d| d.severity >= least).collect();
    let (shown, rest) = choose(&worth);
    lines.extend(shown.iter().map(ToString::to_string));
    if !rest.is_empty() {
        let errors = rest.iter().filter(|d| d.severity == Severity::Error);
        let mut more = format!("{}: … and {} more", input.display(), rest.len());
        // Writing to a String does not fail.
        let _ = match errors.count() {
            0 => write!(more, " ({})", style.see),
            errors => write!(more, ", {} ({})", number(errors, "error"), style.see),
        };
        lines.push(more);
    }
    if !style.is_quiet {
        let major = losses.iter().filter(|l| !l.loss.kind.is_minor());
        lines.extend(major.map(loss_line));
    }
    if let Some(why) = failure {
        lines.push(error_line(&input.display().to_string(), why));
    }
    printable(&lines.join("\n"))
}

/// Those that are shown and those that are not, both in order. Errors go before the rest when
/// there is no room for all.
fn choose<'d>(all: &[&'d Diagnostic]) -> (Vec<&'d Diagnostic>, Vec<&'d Diagnostic>) {
    let is_error = |d: &&Diagnostic| d.severity == Severity::Error;
    let mut errors_left = MAX_SHOWN;
    let errors = all.iter().filter(|d| is_error(d)).count();
    let mut others_left = MAX_SHOWN.saturating_sub(errors);
    all.iter().partition(|d| {
        let left = if is_error(d) {
            &mut errors_left
        } else {
            &mut others_left
        };
        let is_shown = *left > 0;
        *left = left.saturating_sub(1);
        is_shown
    })
}

fn loss_line(named: &NamedLoss) -> String {
    let loss = &named.loss;
    let mut line = named.file.to_string();
    // Writing to a String does not fail.
    if loss.pos.line > 0 {
        let _ = write!(line, ":{}:{}", loss.pos.line, loss.pos.column);
    }
    let _ = write!(line, ": loss[{}]: {}", loss.kind.code(), loss.kind.text());
    if !loss.detail.is_empty() {
        let _ = write!(line, ": {}", loss.detail);
    }
    if loss.count > 1 {
        let _ = write!(line, " ({} times)", loss.count);
    }
    line
}

/// Something that was not done.
pub fn error_line(what: &str, why: &str) -> String {
    printable(&format!("{what}: error: {why}"))
}

/// Something that kept the command from beginning.
pub fn error(why: &str) -> String {
    printable(&format!("error: {why}"))
}

/// Names and texts come from the input: they must not steer the terminal.
pub fn printable(text: &str) -> String {
    let show = |c: char| {
        if c.is_control() && c != '\n' {
            char::REPLACEMENT_CHARACTER
        } else {
            c
        }
    };
    text.chars().map(show).collect()
}

/// A count with what is counted, in the singular or the plural.
pub fn number(count: usize, what: &str) -> String {
    let end = match (count, what.ends_with('s')) {
        (1, _) => "",
        (_, true) => "es",
        (_, false) => "s",
    };
    format!("{count} {what}{end}")
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
        let seconds = time.as_secs_f64();
        let decimals = if seconds < 1.0 { 2 } else { 1 };
        parts.push(format!("{seconds:.decimals$} s"));
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

#[cfg(test)]
mod tests {
    use super::*;
    use iv_parser::SourcePos;

    fn remark(severity: Severity, line: u32) -> Diagnostic {
        Diagnostic {
            severity,
            code: "code",
            message: "message\u{1b}[2J".to_owned(),
            hint: String::new(),
            file: "a.iv".into(),
            pos: SourcePos {
                file: 0,
                line,
                column: 1,
            },
            snippet: None,
        }
    }

    fn text(remarks: &[Diagnostic], is_quiet: bool) -> String {
        let style = Style {
            is_quiet,
            see: "see --report".to_owned(),
        };
        lines(Path::new("a.iv"), remarks, &[], None, &style)
    }

    #[test]
    fn long_lists_are_cut_and_errors_go_first() {
        use Severity::{Error, Note, Warning};
        // Severities in runs, quiet or not; number of lines printed, the last one.
        type Row = (
            &'static [(Severity, u32)],
            bool,
            usize,
            Option<&'static str>,
        );
        let rows: [Row; 6] = [
            (&[(Warning, 20)], false, 20, None),
            (
                &[(Note, 21)],
                false,
                21,
                Some("a.iv: … and 1 more (see --report)"),
            ),
            (
                &[(Warning, 30), (Error, 2)],
                false,
                21,
                Some("a.iv: … and 12 more (see --report)"),
            ),
            (
                &[(Warning, 5), (Error, 25)],
                false,
                21,
                Some("a.iv: … and 10 more, 5 errors (see --report)"),
            ),
            (&[(Warning, 30), (Error, 2)], true, 2, None),
            (
                &[(Error, 21)],
                true,
                21,
                Some("a.iv: … and 1 more, 1 error (see --report)"),
            ),
        ];
        for (runs, is_quiet, count, last) in rows {
            let severities = runs.iter().flat_map(|&(s, n)| (0..n).map(move |_| s));
            let remarks: Vec<_> = severities.zip(1..).map(|(s, i)| remark(s, i)).collect();
            let text = text(&remarks, is_quiet);
            assert_eq!(text.lines().count(), count, "{text}");
            if let Some(last) = last {
                assert_eq!(text.lines().last(), Some(last));
            }
            let errors = remarks.iter().filter(|r| r.severity == Error).count();
            assert_eq!(
                text.matches("error[code]").count(),
                errors.min(20),
                "{text}"
            );
        }
    }

    #[test]
    fn texts_of_the_input_cannot_steer_the_terminal() {
        let text = text(&[remark(Severity::Error, 3)], false);
        assert_eq!(text, "a.iv:3:1: error[code]: message\u{fffd}[2J");
    }
}
