//! The generated document is the one in the repository, and its tables are whole.

use std::path::Path;

use crate::registry::nodes_markdown;

#[test]
fn the_document_is_up_to_date() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/NODES.md");
    let wanted = nodes_markdown();
    if std::env::var_os("UPDATE_DOCS").is_some_and(|value| value == "1") {
        std::fs::write(&path, &wanted).expect("docs/NODES.md can be written");
    }
    let found = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(
        found == wanted,
        "docs/NODES.md is out of date: run this test with UPDATE_DOCS=1"
    );
}

#[test]
fn document_rows_have_the_columns_of_their_table() {
    let columns = |line: &str| line.matches('|').count();
    let mut expected = 0;
    for line in nodes_markdown().lines() {
        if line.starts_with('|') {
            if expected > 0 {
                assert_eq!(columns(line), expected, "{line}");
            }
            expected = columns(line);
        } else {
            expected = 0;
        }
    }
}
