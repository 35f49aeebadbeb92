//! Bytes out of what they are packed in: gzip and bzip2 streams, zip archives.
//!
//! What something is packed in is told by its first bytes, never by its name. Nothing is opened
//! and nothing is written: bytes in, bytes out, within [`Limits`]. An archive in an archive is not
//! followed; a stream in a stream is, a few times.

mod archive;
mod limits;
mod name;
mod stream;

use std::fmt;

pub use archive::{Archive, Entry, Refused};
pub use limits::Limits;
pub use name::{NameFault, clean_name};
pub use stream::{Unpacked, unpack};

/// What bytes can be packed in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// RFC 1952.
    Gzip,
    /// Julian Seward's.
    Bzip2,
    /// PKWARE's APPNOTE.
    Zip,
}

impl Format {
    /// By the first bytes; `None` for what is not packed.
    pub fn of(bytes: &[u8]) -> Option<Self> {
        match bytes {
            [0x1f, 0x8b, ..] => Some(Self::Gzip),
            [b'B', b'Z', b'h', b'1'..=b'9', ..] => Some(Self::Bzip2),
            [b'P', b'K', 3, 4, ..] | [b'P', b'K', 5, 6, ..] => Some(Self::Zip),
            _ => None,
        }
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Gzip => "gzip",
            Self::Bzip2 => "bzip2",
            Self::Zip => "zip",
        })
    }
}

/// Why there are no bytes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Error {
    /// It is not what it says it is.
    Damaged(String),
    /// It is longer than the limit allows.
    TooLong {
        /// The limit in bytes.
        limit: u64,
    },
    /// It is so much longer than what it is packed in that somebody must have meant harm.
    Bomb {
        /// How often the packed bytes fit into the unpacked ones, at the limit.
        ratio: u64,
    },
    /// There is not enough memory for it.
    NoMemory,
    /// It takes a password, and there is none.
    PasswordNeeded,
    /// The password is not the one.
    PasswordWrong,
    /// It is packed in a way that is not known here.
    Unsupported(String),
    /// Streams within streams.
    TooManyLayers {
        /// Most that are unpacked.
        limit: u32,
    },
    /// More entries than any model has.
    TooManyEntries,
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Damaged(why) => write!(f, "it is damaged: {why}"),
            Self::TooLong { limit } => {
                write!(f, "unpacked it is longer than {} MiB", limit >> 20)
            }
            Self::Bomb { ratio } => write!(
                f,
                "unpacked it is more than {ratio} times as long; files like that are made to \
                 fill up memory"
            ),
            Self::NoMemory => f.write_str("there is not enough memory to unpack it"),
            Self::PasswordNeeded => f.write_str("it takes a password"),
            Self::PasswordWrong => f.write_str("the password is wrong"),
            Self::Unsupported(why) => write!(f, "it is packed in an unknown way: {why}"),
            Self::TooManyLayers { limit } => write!(f, "it is packed more than {limit} times"),
            Self::TooManyEntries => f.write_str("it has more than 65535 entries"),
        }
    }
}

impl std::error::Error for Error {}
