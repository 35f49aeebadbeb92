//! Text and binary forms of the same model say the same.

use std::fs;

use iv_parser::{Limits, Problem, Tree, has_binary_form, parse_any, print_binary};
use scenegraph::RegistryLayout;
use tests::fuzz_body::print;
use tests::stored_tree::difference;

use super::models::{corpus, samples};
use super::roundtrip;

fn binary(tree: &Tree<'_>) -> (Vec<u8>, Vec<Problem>) {
    let mut out = Vec::new();
    let told = print_binary(tree, &RegistryLayout, &mut out).expect("a form in binary");
    (out, told)
}

/// Text to binary to tree, to text and to binary again.
fn check(bytes: &[u8]) -> Result<(), String> {
    let limits = Limits::default();
    let text = parse_any(bytes, &RegistryLayout, &limits);
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
    let (second, told) = binary(&again.tree);
    if second != stored || !told.is_empty() {
        return Err(format!("a second time it is different: {told:?}"));
    }
    Ok(())
}

#[test]
fn text_and_binary_say_the_same() {
    let mut failures = Vec::new();
    let mut count = 0;
    for model in samples().iter().chain(&corpus()) {
        let bytes = fs::read(&model.path).expect("a model that is listed");
        let parsed = parse_any(&bytes, &RegistryLayout, &Limits::default());
        if !has_binary_form(&parsed.tree.header) {
            continue;
        }
        count += 1;
        if let Err(why) = check(&bytes) {
            failures.push(format!("{}: {why}", model.name));
        }
    }
    assert!(count >= samples().len() / 2);
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// The binary form and the text of it resolve to equal scenes.
#[test]
fn both_forms_give_the_same_scene() {
    let mut failures = Vec::new();
    for model in samples().iter().chain(&corpus()) {
        let bytes = fs::read(&model.path).expect("a model that is listed");
        let limits = Limits::default();
        let parsed = parse_any(&bytes, &RegistryLayout, &limits);
        if !has_binary_form(&parsed.tree.header) {
            continue;
        }
        let (stored, _) = binary(&parsed.tree);
        let text = print(&parse_any(&stored, &RegistryLayout, &limits).tree);
        let scenes = [&stored, &text].map(|bytes| roundtrip::scene_of(bytes, model));
        if let Some(part) = roundtrip::difference(&scenes[0], &scenes[1]) {
            failures.push(format!("{}: {part} differ", model.name));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
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
