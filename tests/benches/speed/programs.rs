//! The programs that are compared, and their best and middle times.

use std::env;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde_json::Value;

use crate::child::{Usage, measure};
use crate::coin;

/// Makes this process parse the numbers of the file that follows.
pub const FLOATS_FLAG: &str = "--floats";
/// How often each program reads each model.
const ROUNDS: usize = 5;

/// The programs.
pub struct Programs {
    ivconvert: PathBuf,
    coin: Option<PathBuf>,
    this: PathBuf,
}

/// What one program used in each round.
#[derive(Clone, Debug, Default)]
pub struct Rounds(Vec<Usage>);

/// What each program used for one model.
#[derive(Clone, Debug, Default)]
pub struct Measured {
    pub ivconvert: Rounds,
    /// Empty where it is not installed or refuses the model.
    pub coin: Rounds,
    pub floats: Rounds,
}

impl Programs {
    /// Builds all that there are.
    ///
    /// # Errors
    ///
    /// When `ivconvert` cannot be built.
    pub fn build(folder: &Path) -> Result<Self, String> {
        Ok(Self {
            ivconvert: build_ivconvert()?,
            coin: coin::reader(folder),
            this: env::current_exe().map_err(|why| why.to_string())?,
        })
    }

    /// All programs in turn, some times over, so that what else the machine does hits all alike.
    ///
    /// # Errors
    ///
    /// When one of ours fails.
    pub fn measure(&self, model: &Path, output: &Path) -> Result<Measured, String> {
        let words = |program: &Path, rest: &[&Path]| -> Vec<OsString> {
            let words = std::iter::once(&program).chain(rest);
            words.map(|word| word.as_os_str().to_owned()).collect()
        };
        let quiet = Path::new("--quiet");
        let convert = words(&self.ivconvert, &[model, Path::new("-o"), output, quiet]);
        let floats = words(&self.this, &[Path::new(FLOATS_FLAG), model]);
        let coin = self.coin.as_ref().map(|coin| words(coin, &[model]));
        let mut measured = Measured::default();
        for _ in 0..ROUNDS {
            measured.ivconvert.0.push(measure(&convert)?);
            measured.floats.0.push(measure(&floats)?);
            let coin = coin.as_ref().and_then(|coin| measure(coin).ok());
            measured.coin.0.extend(coin);
        }
        Ok(measured)
    }
}

impl Rounds {
    /// The smallest of a number; `None` without a round.
    pub fn best(&self, of: impl Fn(&Usage) -> f64) -> Option<f64> {
        self.sorted(of).first().copied()
    }

    /// The middle one.
    pub fn median(&self, of: impl Fn(&Usage) -> f64) -> Option<f64> {
        let sorted = self.sorted(of);
        sorted.get(sorted.len() / 2).copied()
    }

    /// The largest.
    pub fn most(&self, of: impl Fn(&Usage) -> f64) -> Option<f64> {
        self.sorted(of).last().copied()
    }

    fn sorted(&self, of: impl Fn(&Usage) -> f64) -> Vec<f64> {
        let mut numbers: Vec<f64> = self.0.iter().map(of).collect();
        numbers.sort_by(f64::total_cmp);
        numbers
    }
}

/// Gives the path of the program, which depends on cargo's settings.
fn build_ivconvert() -> Result<PathBuf, String> {
    let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let build = Command::new(cargo)
        .args(["build", "--release", "-p", "convert", "--bin", "ivconvert"])
        .arg("--message-format=json-render-diagnostics")
        .stderr(Stdio::inherit())
        .output()
        .map_err(|why| why.to_string())?;
    let text = String::from_utf8_lossy(&build.stdout);
    let messages = text.lines().flat_map(serde_json::from_str);
    let mut programs = messages.filter_map(|message: Value| {
        let path = message["executable"].as_str()?;
        Some(PathBuf::from(path))
    });
    programs
        .next()
        .ok_or("ivconvert cannot be built".to_owned())
}
