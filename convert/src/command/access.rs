//! How inputs are opened: where else files may be, and what packed ones take. The arguments for it
//! are the same in all commands.

use std::fs;
use std::path::PathBuf;

use clap::Args;
use scenegraph::FileLoader;
use unpack::Limits;

/// Where a password may stand that is not to be seen in a list of processes.
const PASSWORD_VARIABLE: &str = "IVORY_PASSWORD";

/// The arguments for packed inputs.
#[derive(Clone, Debug, Default, Args)]
pub struct PackedArgs {
    /// Password of zip archives; others of this machine may see it in the list of processes
    /// [env: IVORY_PASSWORD]
    #[arg(long, value_name = "PASSWORD", conflicts_with = "password_file")]
    pub password: Option<String>,

    /// A file whose first line is the password of zip archives
    #[arg(long, value_name = "FILE")]
    pub password_file: Option<PathBuf>,

    /// Most MiB that may come out of a packed input [default: 1024, and 200 times its length]
    #[arg(long, value_name = "MIB", value_parser = mebibytes)]
    pub max_unpacked: Option<u64>,
}

/// How inputs are opened.
#[derive(Clone, Default)]
pub struct Access {
    /// Further folders that may be read.
    pub search: Vec<PathBuf>,
    /// Password of zip archives.
    pub password: Option<Vec<u8>>,
    /// On what comes out of packed inputs.
    pub limits: Limits,
}

impl Access {
    /// As the arguments want it.
    ///
    /// # Errors
    ///
    /// In words, when the password's file cannot be read.
    pub fn new(search: &[PathBuf], packed: &PackedArgs) -> Result<Self, String> {
        let limits = packed.max_unpacked.map(|mib| Limits::of_bytes(mib << 20));
        Ok(Self {
            search: search.to_owned(),
            password: password(packed)?,
            limits: limits.unwrap_or_default(),
        })
    }

    /// Opens files in a model's own folder and in the further ones.
    pub fn file_loader(&self, own: &std::path::Path) -> FileLoader {
        let folders = [own]
            .into_iter()
            .chain(self.search.iter().map(PathBuf::as_path));
        FileLoader::new(folders).with_unpack_limits(self.limits)
    }
}

/// Most that `--max-unpacked` takes: a tebibyte.
const MOST_MEBIBYTES: u64 = 1 << 20;

fn mebibytes(text: &str) -> Result<u64, String> {
    let number = text.trim().parse().ok();
    number
        .filter(|mib| (1..=MOST_MEBIBYTES).contains(mib))
        .ok_or_else(|| format!("it is a whole number of MiB, from 1 to {MOST_MEBIBYTES}"))
}

fn password(packed: &PackedArgs) -> Result<Option<Vec<u8>>, String> {
    if let Some(password) = &packed.password {
        return Ok(Some(password.clone().into_bytes()));
    }
    if let Some(path) = &packed.password_file {
        let bytes = fs::read(path)
            .map_err(|error| format!("the file {} cannot be read: {error}", path.display()))?;
        let line = bytes.split(|b| matches!(b, b'\n' | b'\r')).next();
        return Ok(line.map(<[u8]>::to_vec));
    }
    Ok(std::env::var(PASSWORD_VARIABLE)
        .ok()
        .map(String::into_bytes))
}
