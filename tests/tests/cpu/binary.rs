//! Text and binary forms of the same model say the same.

use std::fs;

use iv_parser::{Limits, Problem, Tree, has_binary_form, parse_any, print_binary};
use scenegraph::RegistryLayout;
use tests::fuzz_body::print;
use tests::same_tree;
use tests::stored_tree::difference;

use super::models::{Model, check_all};
use super::roundtrip;

fn binary(tree: &Tree<'_>) -> (Vec<u8>, Vec<Problem>) {
    let mut out = Vec::new();
    let told = print_binary(tree, &RegistryLayout, &mut out).expect("a form in binary");
    (out, told)
}

/// Any form to binary to tree, to text and to binary again.
fn check(model: &Model) -> Result<(), String> {
    let bytes = fs::read(&model.path).map_err(|e| e.to_string())?;
    let limits = Limits::default();
    let text = parse_any(&bytes, &RegistryLayout, &limits);
    if !has_binary_form(&text.tree.header) {
        return Ok(());
    }
    let (stored, told) = binary(&text.tree);
    let read = parse_any(&stored, &RegistryLayout, &limits);
    if let Some(problem) = read.problems.first() {
        return Err(format!("not read back: {problem:?}"));
    }
    if let Some(difference) = difference(&text.tree, &read.tree, &told) {
        return Err(difference);
    }
    let printed = print(&read.tree);
    let again = parse_any(&printed, &RegistryLayout, &limits);
    if let Some(problem) = again.problems.first() {
        return Err(format!("its text: {problem:?}"));
    }
    let (second, told_again) = binary(&again.tree);
    if second != stored || !told_again.is_empty() {
        return Err(format!("a second time it is different: {told_again:?}"));
    }
    let scene = |bytes: &[u8]| roundtrip::scene_of(bytes, model);
    let from_binary = scene(&stored);
    if let Some(part) = roundtrip::difference(&from_binary, &scene(&printed)) {
        return Err(format!("{part} differ of binary and its text"));
    }
    // Else numbers were rounded, which shows.
    if same_tree::difference(&text.tree, &read.tree).is_none()
        && let Some(part) = roundtrip::difference(&from_binary, &scene(&bytes))
    {
        return Err(format!("{part} differ of binary and source"));
    }
    Ok(())
}

#[test]
fn every_form_says_and_shows_the_same() {
    check_all(check);
}

/// Text of at most six digits a number comes back from binary to the last bit.
#[test]
fn short_numbers_come_back_exactly() {
    let text = b"#Inventor V2.1 ascii\nSeparator { Translation { translation 0.1 -22.3456 1e-6 } \
        Coordinate3 { point [ 0.3 0.7 123.456, 9.99999 10.0001 0.00123 ] } PointSet { } }";
    let parsed = iv_parser::parse(text);
    let (stored, told) = binary(&parsed.tree);
    assert_eq!(told, []);
    let read = parse_any(&stored, &RegistryLayout, &Limits::default());
    assert_eq!(print(&read.tree), print(&parsed.tree));
}
