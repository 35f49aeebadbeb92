//! `--info` for people: a few aligned lines for each input.

use std::fmt::Write;

use convert::command::messages::{number, printable};
use geometry::bounds::Aabb;
use glam::DVec3;
use iv_parser::Severity;

use super::measure::Amount;
use super::{Content, Info, TextureKind, format_name};

/// Significant digits of the largest extent that coordinates are shown with.
const DIGITS: i32 = 6;

/// The table of one input.
pub fn text(info: &Info, content: &Content) -> String {
    let mut table = Table::default();
    let header = content.files.first().map(|(_, header)| header);
    let format = header.map(format_name).unwrap_or_default();
    table.row(
        "format",
        &[format, grouped(info.bytes) + " bytes"].join(", "),
    );
    for (name, header) in content.files.iter().skip(1) {
        table.row("includes", &format!("{name}, {}", format_name(header)));
    }
    table.bounds(&content.bounds);
    table.amount("triangles", content.triangles);
    table.amount("lines", content.lines);
    table.amount("points", content.points);
    table.amount("meshes", content.meshes);
    table.row("materials", &grouped(content.materials as u64));
    table.textures(&content.textures);
    table.kinds("lights", &content.lights, &["directional", "point", "spot"]);
    table.kinds(
        "cameras",
        &content.cameras,
        &["perspective", "orthographic"],
    );
    table.remarks(info);
    table.classes(content);
    printable(&format!(
        "{}
{}
",
        info.path.display(),
        table.text
    ))
}

#[derive(Default)]
struct Table {
    text: String,
}

impl Table {
    fn row(&mut self, name: &str, value: &str) {
        // Writing to a String does not fail.
        let _ = writeln!(self.text, "  {name:<11} {value}");
    }

    fn amount(&mut self, name: &str, amount: Amount) {
        let value = match (amount.unique, amount.instanced) {
            (0, 0) => return,
            (unique, instanced) if unique == instanced => grouped(unique),
            (unique, instanced) => {
                format!("{} stored, {} drawn", grouped(unique), grouped(instanced))
            }
        };
        self.row(name, &value);
    }

    fn bounds(&mut self, bounds: &Aabb) {
        if bounds.is_empty() {
            self.row("bounds", "nothing is drawn");
            return;
        }
        let size = bounds.size();
        let decimals = decimals_for(size.max_element());
        for (name, point) in [("min", bounds.min), ("max", bounds.max), ("size", size)] {
            self.row(name, &coordinates(point, decimals));
        }
    }

    fn textures(&mut self, textures: &[TextureKind]) {
        if !textures.is_empty() {
            self.row("textures", &grouped(textures.len() as u64));
        }
        for texture in textures {
            let value = match texture {
                TextureKind::File(name) => name.clone(),
                TextureKind::Inline(width, height, components, bytes) => {
                    let bytes = grouped(*bytes as u64);
                    format!("inline, {width} x {height} x {components}, {bytes} bytes")
                }
            };
            self.row("", &format!("  {value}"));
        }
    }

    fn kinds(&mut self, name: &str, counts: &[usize], kinds: &[&str]) {
        let present = counts.iter().zip(kinds).filter(|&(&count, _)| count > 0);
        let parts: Vec<String> = present.map(|(n, kind)| format!("{n} {kind}")).collect();
        if !parts.is_empty() {
            self.row(name, &parts.join(", "));
        }
    }

    fn remarks(&mut self, info: &Info) {
        let mut parts = Vec::new();
        for severity in [Severity::Error, Severity::Warning, Severity::Note] {
            let of_it = info.diagnostics.iter().filter(|d| d.severity == severity);
            match of_it.count() {
                0 => {}
                count => parts.push(number(count, &severity.to_string())),
            }
        }
        if !parts.is_empty() {
            self.row("remarks", &parts.join(", "));
        }
    }

    /// Classes, the most frequent first.
    fn classes(&mut self, content: &Content) {
        self.row("nodes", &grouped(content.node_count() as u64));
        let mut classes: Vec<_> = content.classes.iter().collect();
        classes.sort_by_key(|&(name, count)| (std::cmp::Reverse(*count), name));
        let widest = classes.iter().map(|(name, _)| name.chars().count()).max();
        let widest = widest.unwrap_or(0).min(40);
        for (name, &count) in classes {
            let count = grouped(count as u64);
            self.row("", &format!("  {name:<widest$} {count:>9}"));
        }
    }
}

/// Decimals with which a length of this size has [`DIGITS`] digits in all.
fn decimals_for(size: f64) -> usize {
    if !size.is_finite() || size <= 0.0 {
        return DIGITS as usize;
    }
    let before_point = size.log10().floor() as i32 + 1;
    (DIGITS - before_point).clamp(0, 12) as usize
}

fn coordinates(point: DVec3, decimals: usize) -> String {
    let text = point.to_array().map(|v| {
        let text = format!("{v:.decimals$}");
        let text = if text.contains('.') {
            text.trim_end_matches('0').trim_end_matches('.')
        } else {
            &text
        };
        if text == "-0" {
            "0".to_owned()
        } else {
            text.to_owned()
        }
    });
    text.join("  ")
}

/// A number with its thousands set apart.
fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::with_capacity(digits.len() * 4 / 3);
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thousands_are_set_apart() {
        let rows = [
            (0, "0"),
            (999, "999"),
            (1000, "1,000"),
            (1234567, "1,234,567"),
        ];
        for (number, want) in rows {
            assert_eq!(grouped(number), want);
        }
    }

    #[test]
    fn coordinates_are_as_fine_as_the_model_is_large() {
        let rows = [
            ([0.0, -0.0, 1.5], 10.0, "0  0  1.5"),
            (
                [2_600_000.123_456, 100.0, -0.000_001],
                12.0,
                "2600000.1235  100  0",
            ),
            ([0.000_123_456_7, 0.0, 0.0], 0.001, "0.00012346  0  0"),
            ([1e7, 10.5, 0.0], 1e7, "10000000  10  0"),
            ([3.25, 0.0, 0.0], 0.0, "3.25  0  0"),
        ];
        for (point, size, want) in rows {
            let decimals = decimals_for(size);
            assert_eq!(coordinates(DVec3::from_array(point), decimals), want);
        }
    }
}
