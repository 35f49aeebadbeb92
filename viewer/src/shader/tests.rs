//! Every text is valid WGSL, holds what its key asks for, and shares its layout with Rust.

use std::collections::BTreeMap;

use naga::valid::{Capabilities, ValidationFlags, Validator};

use super::*;

fn validated(text: &str) -> Result<naga::Module, String> {
    let module = naga::front::wgsl::parse_str(text).map_err(|e| e.emit_to_string(text))?;
    Validator::new(
        ValidationFlags::all(),
        Capabilities::default() | Capabilities::MULTISAMPLED_SHADING,
    )
    .validate(&module)
    .map_err(|e| e.emit_to_string(text))?;
    Ok(module)
}

#[test]
fn every_reachable_key_gives_a_valid_shader_of_its_own() {
    let mut keys_by_text = BTreeMap::new();
    let keys = ShaderKey::reachable();
    assert!(keys.len() > 1000, "{} keys", keys.len());
    for key in keys {
        let text = emit(&key);
        if let Some(other) = keys_by_text.insert(text.clone(), key) {
            panic!("{key:?} and {other:?} give the same text");
        }
        if let Err(error) = validated(&text) {
            panic!("{key:?}\n{error}\n{text}");
        }
    }
}

#[test]
fn fixed_shaders_are_valid() {
    let texts = [
        format!("{TYPES}{VOLUME}"),
        format!("{TYPES}{MAP}"),
        EXTRACT.to_owned(),
        emit_rays(1),
        emit_rays(4),
        emit_present(1),
        emit_present(4),
        include_str!("wgsl/background.wgsl").to_owned(),
    ];
    for text in texts {
        if let Err(error) = validated(&text) {
            panic!("{error}\n{text}");
        }
    }
}

#[test]
fn structs_have_the_same_layout_in_rust_and_wgsl() {
    let module = validated(TYPES).unwrap();
    type Layout = (usize, Vec<(String, usize)>);
    let in_wgsl: BTreeMap<&str, Layout> = module
        .types
        .iter()
        .filter_map(|(_, of)| match &of.inner {
            naga::TypeInner::Struct { members, span } => Some((
                of.name.as_deref()?,
                (
                    *span as usize,
                    members
                        .iter()
                        .map(|m| (m.name.clone().unwrap_or_default(), m.offset as usize))
                        .collect(),
                ),
            )),
            _ => None,
        })
        .collect();
    for (name, size, fields) in layouts() {
        let fields: Vec<(String, usize)> =
            fields.into_iter().map(|(f, o)| (f.to_owned(), o)).collect();
        assert_eq!(in_wgsl.get(name), Some(&(size, fields)), "{name}");
    }
    assert_eq!(in_wgsl.len(), layouts().len());
}
