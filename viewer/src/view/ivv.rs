//! Saved views as text.
