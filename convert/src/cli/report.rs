//! The document of `--report`: the same for the same inputs, unless times are asked for.

use std::time::Duration;

use convert::command::json::{diagnostics, place};
use serde_json::{Value, json};

use super::args::Args;
use super::job::{NamedLoss, Outcome};
use super::messages::Totals;

/// A report being gathered.
pub struct Report {
    inputs: Vec<Value>,
    has_times: bool,
}

impl Report {
    /// An empty one.
    pub fn new(args: &Args) -> Self {
        Self {
            inputs: Vec::new(),
            has_times: args.timings,
        }
    }

    /// Adds what happened to the next input.
    pub fn add(&mut self, outcome: &Outcome) {
        let output = outcome.output.as_ref().map(|p| p.display().to_string());
        let is_failed = outcome.failure.is_some();
        let mut entry = json!({
            "path": outcome.input.display().to_string(),
            "output": output,
            "status": if is_failed { "failed" } else { "converted" },
            "error": outcome.failure,
            "bytes_in": outcome.bytes_in,
            "bytes_out": outcome.bytes_out,
            "counts": outcome.counts,
            "diagnostics": diagnostics(&outcome.diagnostics),
            "warnings": diagnostics(&outcome.warnings),
            "losses": outcome.losses.iter().map(loss).collect::<Value>(),
        });
        self.put_time(&mut entry, outcome.time);
        self.inputs.push(entry);
    }

    /// The document.
    pub fn finish(mut self, totals: &Totals, time: Duration) -> Value {
        let inputs = std::mem::take(&mut self.inputs);
        let mut document = json!({
            "generator": concat!("ivconvert ", env!("CARGO_PKG_VERSION")),
            "inputs": inputs,
            "totals": {
                "converted": totals.converted,
                "failed": totals.failed,
                "losses": totals.losses,
                "errors": totals.errors,
                "warnings": totals.warnings,
            },
        });
        self.put_time(&mut document, time);
        document
    }

    fn put_time(&self, entry: &mut Value, time: Duration) {
        if let Some(object) = entry.as_object_mut().filter(|_| self.has_times) {
            object.insert("seconds".to_owned(), json!(time.as_secs_f64()));
        }
    }
}

fn loss(named: &NamedLoss) -> Value {
    let loss = &named.loss;
    let (line, column, byte) = place(loss.pos);
    json!({
        "code": loss.kind.code(),
        "text": loss.kind.text(),
        "detail": loss.detail,
        "count": loss.count,
        "file": *named.file,
        "line": line,
        "column": column,
        "byte": byte,
    })
}
