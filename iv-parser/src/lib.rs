//! Open Inventor syntax: bytes to a syntax tree with diagnostics, and back to text.
//!
//! This crate knows tokens, braces, numbers and names. It knows no node class, no field type and
//! no default; what a tree means is the business of `scenegraph`. [`parse()`] is total: any bytes
//! give a tree, and a [`Problem`] for each thing that was not as it should be.
//!
//! ```
//! let parse = iv_parser::parse(b"#Inventor V2.1 ascii\nDEF Door Cube { width 2 }");
//! assert!(parse.problems.is_empty());
//! let iv_parser::Child::Node(door) = parse.tree.children_of_root()[0] else { panic!() };
//! assert_eq!(parse.tree.node(door).class, b"Cube");
//! ```

mod binary;
mod diagnostic;
mod edit;
mod header;
mod lex;
mod limits;
mod list;
mod number;
mod parse;
mod print;
mod source;
mod text;
mod tree;

pub use binary::{ClassShape, Schema, ValueKind, ValueType, has_binary_form, print_binary};
pub use diagnostic::{Diagnostic, Severity, Snippet, SourcePos, collapsed};
pub use edit::TextEdits;
pub use header::{Dialect, Encoding, Header};
pub use limits::Limits;
pub use list::{List, Part};
pub use parse::{Parse, parse, parse_any, parse_with};
pub use print::{Layout, print};
pub use source::{LineCounter, Problem, Source, Span};
pub use text::{decode_string, text_of};
pub use tree::{
    Access, Atom, Child, Connection, Declaration, Field, FieldId, Form, Item, Node, NodeId,
    Numbers, Tree, Value,
};
