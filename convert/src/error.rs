//! Why a conversion gave no output. What is only lost or missing is in the
//! [`Report`](crate::Report).

use std::fmt;
use std::io;
use std::path::PathBuf;

/// A conversion that gave no output.
#[derive(Debug)]
pub enum Error {
    /// A file or stream could not be written.
    Io {
        /// The file, where there is one.
        path: Option<PathBuf>,
        /// What the system said.
        source: io::Error,
    },
    /// The model does not fit into a `.glb`.
    GlbTooLarge {
        /// Length it would have.
        bytes: u64,
        /// Largest length.
        limit: u64,
    },
    /// One array or image does not fit into a `.bin`.
    BinTooLarge {
        /// Length it has.
        bytes: u64,
        /// Largest length.
        limit: u64,
    },
    /// The output needs several `.bin` files, and only one stream was given.
    SeveralBins {
        /// How many are needed.
        count: usize,
    },
    /// The scene breaks one of its guarantees.
    Scene(String),
    /// The target's name cannot stand in a URI, or the target is something other than a file.
    Target {
        /// The target.
        path: PathBuf,
        /// What is wrong with it.
        reason: &'static str,
    },
}

impl Error {
    pub(crate) fn at(path: &std::path::Path) -> impl FnOnce(io::Error) -> Self {
        let path = Some(path.to_owned());
        move |source| Self::Io { path, source }
    }
}

impl From<io::Error> for Error {
    fn from(source: io::Error) -> Self {
        Self::Io { path: None, source }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Io {
                path: Some(path),
                source,
            } => write!(f, "{}: {source}", path.display()),
            Self::Io { path: None, source } => write!(f, "cannot write: {source}"),
            Self::GlbTooLarge { bytes, limit } => write!(
                f,
                "the .glb would have {bytes} bytes and the format allows {limit}; write .gltf \
                 instead, which spreads over several .bin files"
            ),
            Self::BinTooLarge { bytes, limit } => write!(
                f,
                "one mesh or image has {bytes} bytes and a .bin file holds {limit}; split the mesh"
            ),
            Self::SeveralBins { count } => write!(
                f,
                "the model needs {count} .bin files; write it to a path instead of a stream"
            ),
            Self::Scene(text) => write!(f, "the scene is not sound: {text}"),
            Self::Target { path, reason } => write!(f, "{}: {reason}", path.display()),
        }
    }
}

impl std::error::Error for Error {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Io { source, .. } => Some(source),
            _ => None,
        }
    }
}
