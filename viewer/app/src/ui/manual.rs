//! The list of keys as a document.

use std::fmt::Write;

use super::command::{ALL, MOUSE, Menu};

/// What docs/VIEWER.md says of keys and mouse.
pub fn keys_markdown() -> String {
    let mut text = String::from("| key | menu | does |\n| --- | --- | --- |\n");
    for entry in ALL {
        let key = entry.key.as_ref().map_or(String::new(), key_name);
        let menu = match entry.menu {
            Menu::File => "File",
            Menu::View => "View",
            Menu::Show => "Show",
            Menu::Select => "Select",
            Menu::Help => "Help",
        };
        let _ = writeln!(text, "| {key} | {menu} | {} |", entry.text);
    }
    text.push_str("\n| mouse | does |\n| --- | --- |\n");
    for (what, does) in MOUSE {
        let _ = writeln!(text, "| {what} | {does} |");
    }
    text
}

fn key_name(key: &egui::KeyboardShortcut) -> String {
    if key.logical_key == egui::Key::Questionmark {
        return "`?`".to_owned();
    }
    let command = if key.modifiers.command { "Ctrl+" } else { "" };
    let shift = if key.modifiers.shift { "Shift+" } else { "" };
    format!("`{command}{shift}{}`", key.logical_key.name())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_document_is_up_to_date() {
        const BEGIN: &str = "<!-- keys -->\n";
        const END: &str = "<!-- end -->";
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/VIEWER.md");
        let stored = std::fs::read_to_string(path).unwrap();
        let (head, rest) = stored.split_once(BEGIN).unwrap();
        let (_, tail) = rest.split_once(END).unwrap();
        let text = format!("{head}{BEGIN}{}{END}{tail}", keys_markdown());
        if std::env::var_os("UPDATE_DOCS").is_some() {
            std::fs::write(path, &text).unwrap();
        }
        let stored = std::fs::read_to_string(path).unwrap();
        assert!(
            stored == text,
            "docs/VIEWER.md is out of date: run with UPDATE_DOCS=1"
        );
    }
}
