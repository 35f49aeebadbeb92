//! Defaults as values: the registry's texts, read once by the reader that reads files.

use std::sync::LazyLock;

use super::FieldValue;
use crate::lower::read_default;
use crate::registry::Class;

static DEFAULTS: LazyLock<Vec<Vec<FieldValue>>> = LazyLock::new(|| {
    let fields_of = |class: &Class| class.spec().fields.iter().map(read_default).collect();
    Class::ALL.iter().map(fields_of).collect()
});

/// The default of the field at `index` of `class`.
pub(super) fn of(class: Class, index: usize) -> &'static FieldValue {
    &DEFAULTS[class as usize][index]
}
