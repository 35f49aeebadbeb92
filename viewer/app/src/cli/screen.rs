//! The terminal: messages to standard error, results to standard output. Nothing else in the
//! command prints.

use std::io::{self, ErrorKind, Write};

/// Where messages go.
pub struct Screen {
    /// Errors only.
    pub is_quiet: bool,
}

impl Screen {
    /// Prints to standard error, quiet or not. Adds the end of the line.
    pub fn error(&self, text: &str) {
        if !text.is_empty() {
            // If standard error is gone, there is nobody to tell.
            let _ = writeln!(io::stderr().lock(), "{text}");
        }
    }

    /// The same, unless quiet.
    pub fn remark(&self, text: &str) {
        if !self.is_quiet {
            self.error(text);
        }
    }

    /// Prints to standard output. A reader that has gone away (`| head`) is no failure.
    ///
    /// # Errors
    ///
    /// What the system says, in words.
    pub fn output(&self, text: &str) -> Result<(), String> {
        let mut out = io::stdout().lock();
        match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
            Err(error) if error.kind() != ErrorKind::BrokenPipe => {
                Err(format!("cannot print: {error}"))
            }
            _ => Ok(()),
        }
    }
}
