//! Why a file gave no scene. What is only left out is in [`Model::warnings`](crate::Model).

use std::fmt;

/// A glTF file that gave no scene.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ReadError {
    /// The bytes are no whole `.glb`.
    Container(&'static str),
    /// The text is no glTF: what is wrong, with line and column.
    Json(String),
    /// A version other than 2.
    Version(String),
    /// The file cannot be shown without this extension, which is not supported.
    Extension(String),
    /// Data that something needs are not to be had.
    Buffer {
        /// Number of the buffer.
        index: usize,
        /// What is wrong with it.
        reason: String,
    },
    /// Something refers to what is not there, or says what cannot be.
    Broken {
        /// What kind of thing: `accessor`, `node` and so on.
        item: &'static str,
        /// Its number.
        index: usize,
        /// What is wrong with it.
        reason: &'static str,
    },
    /// More than a reader may take.
    Limit {
        /// What there is too much of.
        what: &'static str,
        /// The most there may be.
        limit: u64,
    },
}

impl ReadError {
    pub(crate) fn broken(item: &'static str, index: usize, reason: &'static str) -> Self {
        Self::Broken {
            item,
            index,
            reason,
        }
    }
}

impl fmt::Display for ReadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Container(reason) => write!(f, "not a whole .glb: {reason}"),
            Self::Json(reason) => write!(f, "not a glTF text: {reason}"),
            Self::Version(version) => {
                write!(f, "glTF {version} is not supported, only version 2 is")
            }
            Self::Extension(name) => {
                write!(f, "the extension {name} is required and not supported")
            }
            Self::Buffer { index, reason } => write!(f, "buffer {index}: {reason}"),
            Self::Broken {
                item,
                index,
                reason,
            } => write!(f, "{item} {index}: {reason}"),
            Self::Limit { what, limit } => write!(f, "more than {limit} {what}"),
        }
    }
}

impl std::error::Error for ReadError {}
