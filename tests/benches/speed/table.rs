//! One line of the table for each model, and what was aimed at.

use std::fmt;
use std::fs;
use std::path::Path;
use std::thread;

use crate::child::Usage;
use crate::programs::{Measured, Programs};

/// The names of the columns; docs/BENCHMARKS.md explains them.
pub const HEAD: &str = "\
| model | MiB | CPU s | median | Coin s | to Coin | numbers s | to numbers | wall ms | output MiB | peak MiB | allowed MiB |
| --- | --: | --: | --: | --: | --: | --: | --: | --: | --: | --: | --: |";

/// What is aimed at for one of the generated models.
pub struct Goals {
    /// Most processor time, as a part of that of Coin's reader.
    to_coin: Option<f64>,
    /// Longest time from start to end.
    wall_ms: Option<f64>,
    /// Largest output, as a multiple of the input.
    to_input: Option<f64>,
}

/// In the order of the models.
pub const GOALS: [Goals; 3] = [
    Goals {
        to_coin: Some(0.4),
        wall_ms: None,
        to_input: None,
    },
    Goals {
        to_coin: Some(0.5),
        wall_ms: None,
        to_input: None,
    },
    Goals {
        to_coin: None,
        wall_ms: Some(30.0),
        to_input: Some(2.0),
    },
];

/// What was measured with one model.
pub struct Row {
    name: String,
    input_bytes: f64,
    output_bytes: f64,
    measured: Measured,
}

impl Row {
    /// Runs all programs.
    ///
    /// # Errors
    ///
    /// When the model cannot be read or converted.
    pub fn measure(model: &Path, programs: &Programs, folder: &Path) -> Result<Self, String> {
        let size = |path: &Path| -> Result<f64, String> {
            let data = fs::metadata(path).map_err(|why| format!("{}: {why}", path.display()))?;
            Ok(data.len() as f64)
        };
        let input_bytes = size(model)?;
        let name = model.file_name().unwrap_or_default();
        let output = folder.join(name).with_extension("glb");
        Ok(Self {
            measured: programs.measure(model, &output)?,
            name: name.display().to_string(),
            input_bytes,
            output_bytes: size(&output)?,
        })
    }

    fn cpu_s(&self) -> Option<f64> {
        self.measured.ivconvert.best(cpu_s)
    }

    fn to_coin(&self) -> Option<f64> {
        Some(self.cpu_s()? / self.measured.coin.best(cpu_s)?)
    }

    fn to_numbers(&self) -> Option<f64> {
        Some(self.cpu_s()? / self.measured.floats.best(cpu_s)?)
    }

    fn wall_ms(&self) -> Option<f64> {
        let wall_s = self.measured.ivconvert.best(|usage| usage.wall_s);
        wall_s.map(|s| 1000.0 * s)
    }

    fn peak_bytes(&self) -> Option<f64> {
        self.measured.ivconvert.most(|usage| usage.peak_bytes)
    }

    fn allowed_bytes(&self) -> f64 {
        self.input_bytes + 2.0 * self.output_bytes
    }
}

impl fmt::Display for Row {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let number = |value: Option<f64>, decimals: usize| match value {
            Some(value) => format!("{value:.decimals$}"),
            None => "–".to_owned(),
        };
        let mib = |bytes: f64| number(Some(bytes / f64::from(1 << 20)), 1);
        let measured = &self.measured;
        let cells = [
            self.name.clone(),
            mib(self.input_bytes),
            number(self.cpu_s(), 3),
            number(measured.ivconvert.median(cpu_s), 3),
            number(measured.coin.best(cpu_s), 3),
            number(self.to_coin(), 2),
            number(measured.floats.best(cpu_s), 3),
            number(self.to_numbers(), 2),
            number(self.wall_ms(), 1),
            mib(self.output_bytes),
            self.peak_bytes().map_or("–".to_owned(), mib),
            mib(self.allowed_bytes()),
        ];
        write!(f, "| {} |", cells.join(" | "))
    }
}

impl Goals {
    /// Each goal with what came of it.
    pub fn verdicts(&self, row: &Row) -> Vec<String> {
        let goals = [
            ("processor time to Coin's", row.to_coin(), self.to_coin),
            ("milliseconds", row.wall_ms(), self.wall_ms),
            (
                "output to input",
                Some(row.output_bytes / row.input_bytes),
                self.to_input,
            ),
            (
                "peak memory to input + 2 x output",
                row.peak_bytes().map(|peak| peak / row.allowed_bytes()),
                Some(1.0),
            ),
        ];
        let verdict = |(what, got, most): (&str, Option<f64>, Option<f64>)| {
            let (got, most) = (got?, most?);
            let word = if got <= most { "met" } else { "MISSED" };
            Some(format!(
                "{}: {what} {got:.2}, at most {most}: {word}",
                row.name
            ))
        };
        goals.into_iter().filter_map(verdict).collect()
    }
}

/// What the numbers depend on besides the programs.
pub fn machine() -> String {
    let processors = thread::available_parallelism().map_or(0, usize::from);
    let load = fs::read_to_string("/proc/loadavg").unwrap_or_default();
    let load = load.split(' ').next().unwrap_or_default().to_owned();
    format!("{processors} processors, load {load}\n")
}

fn cpu_s(usage: &Usage) -> f64 {
    usage.cpu_s
}
