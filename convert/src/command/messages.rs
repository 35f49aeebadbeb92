//! What users read on standard error, as far as it does not depend on the command: remarks on an
//! input, and how counts, times and errors are worded.

use std::fmt::Write;
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use iv_parser::{Diagnostic, Severity, SourcePos};
use scenegraph::scene::Scene;

use crate::Warning;

/// Diagnostics of one input that are printed in full.
const MAX_SHOWN: usize = 20;

/// How much is shown.
#[derive(Clone, Debug)]
pub struct Style {
    /// Errors only.
    pub is_quiet: bool,
    /// Where the rest can be read; empty if nowhere.
    pub see: String,
}

/// Remarks on one input, a line or a block of lines each, for [`printable`].
pub fn remarks(input: &Path, diagnostics: &[Diagnostic], style: &Style) -> Vec<String> {
    let least = if style.is_quiet {
        Severity::Error
    } else {
        Severity::Note
    };
    let worth: Vec<&Diagnostic> = diagnostics.iter().filter(|d| d.severity >= least).collect();
    let (shown, rest) = choose(&worth);
    let mut lines: Vec<String> = shown.iter().map(ToString::to_string).collect();
    if !rest.is_empty() {
        let errors = rest.iter().filter(|d| d.severity == Severity::Error);
        let mut more = format!("{}: … and {} more", input.display(), rest.len());
        // Writing to a String does not fail.
        let _ = match errors.count() {
            0 => Ok(()),
            errors => write!(more, ", {}", number(errors, "error")),
        };
        if !style.see.is_empty() {
            let _ = write!(more, " ({})", style.see);
        }
        lines.push(more);
    }
    lines
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
        // What turns the direction of writing hides the order of what is shown.
        let turns = matches!(c, '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
        if turns || c.is_control() && c != '\n' {
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

/// A time, with two digits.
pub fn seconds(time: Duration) -> String {
    let seconds = time.as_secs_f64();
    let decimals = if seconds < 1.0 { 2 } else { 1 };
    format!("{seconds:.decimals$} s")
}

/// The name for display of the file of `scene` that a place is in.
pub fn file_of(scene: &Scene, pos: SourcePos) -> Arc<str> {
    let name = scene.files.get(pos.file as usize);
    name.cloned().unwrap_or_else(|| "".into())
}

/// An image that could not be used.
pub fn image_left_out(warning: Warning, scene: &Scene) -> Diagnostic {
    Diagnostic {
        severity: Severity::Warning,
        code: "image",
        message: format!("`{}` is left out: {}", warning.name, warning.reason),
        hint: "images are looked for beside the model and in the --search folders".to_owned(),
        file: file_of(scene, warning.pos),
        pos: warning.pos,
        snippet: None,
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
        printable(&super::remarks(Path::new("a.iv"), remarks, &style).join("\n"))
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
