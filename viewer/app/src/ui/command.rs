//! What the user can ask for by a menu or a key: one table for menus, keys and the cheat sheet.

use egui::{Key, KeyboardShortcut, Modifiers};
use viewer::navigate::Standard;

/// Something to do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Command {
    /// Ask for a file.
    Open,
    /// Read the file again.
    Reload,
    /// The next of the files given.
    NextFile,
    /// The one before.
    PreviousFile,
    /// Ask where the picture goes.
    SavePicture,
    /// The picture to the clipboard.
    CopyPicture,
    /// Ask where the scene goes, converted.
    Export,
    /// Ask where what is selected goes.
    ExportSelection,
    /// Ask for a saved view.
    LoadView,
    /// Ask where the view goes.
    SaveView,
    /// Leave.
    Quit,
    /// Show all.
    ZoomAll,
    /// Show what is selected.
    ZoomSelection,
    /// Look from there.
    Look(Standard),
    /// Perspective or parallel.
    ChangeLens,
    /// Upright again.
    Level,
    /// Turn on a table, or as a ball.
    ChangeTurning,
    /// As first seen.
    FirstView,
    /// The next camera of the file.
    NextCamera,
    /// Shadows on or off.
    Shadows,
    /// The light at the eye.
    Headlight,
    /// Edges of triangles.
    Wireframe,
    /// Outlines and creases.
    Edges,
    /// Corners.
    Points,
    /// Normals.
    Normals,
    /// Silhouettes as lights see them.
    Silhouettes,
    /// Shadow volumes.
    Volumes,
    /// A grid below the model.
    Grid,
    /// The axes.
    Axes,
    /// Cut the model open.
    Section,
    /// Hide what is selected.
    Hide,
    /// Show nothing else.
    Isolate,
    /// Show everything again.
    ShowAll,
    /// Select nothing.
    Deselect,
    /// Measure between points.
    Measure,
    /// The tree of the model.
    Tree,
    /// The settings.
    Settings,
    /// The list of keys.
    Help,
}

/// Under which menu a command stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Menu {
    /// Files.
    File,
    /// Where one looks from.
    View,
    /// What is shown.
    Show,
    /// What is selected.
    Select,
    /// Help.
    Help,
}

/// A row of the table.
pub struct Entry {
    /// What it does.
    pub command: Command,
    /// In words.
    pub text: &'static str,
    /// Where it stands.
    pub menu: Menu,
    /// Its key.
    pub key: Option<KeyboardShortcut>,
}

const fn plain(key: Key) -> Option<KeyboardShortcut> {
    Some(KeyboardShortcut::new(Modifiers::NONE, key))
}

const fn ctrl(key: Key) -> Option<KeyboardShortcut> {
    Some(KeyboardShortcut::new(Modifiers::COMMAND, key))
}

const fn shift(key: Key) -> Option<KeyboardShortcut> {
    Some(KeyboardShortcut::new(Modifiers::SHIFT, key))
}

const fn entry(
    menu: Menu,
    command: Command,
    text: &'static str,
    key: Option<KeyboardShortcut>,
) -> Entry {
    Entry {
        command,
        text,
        menu,
        key,
    }
}

/// Everything there is, in the order of the menus.
pub const ALL: &[Entry] = &[
    entry(Menu::File, Command::Open, "Open…", ctrl(Key::O)),
    entry(Menu::File, Command::Reload, "Reload", plain(Key::F5)),
    entry(
        Menu::File,
        Command::NextFile,
        "Next file",
        plain(Key::PageDown),
    ),
    entry(
        Menu::File,
        Command::PreviousFile,
        "Previous file",
        plain(Key::PageUp),
    ),
    entry(
        Menu::File,
        Command::SavePicture,
        "Save picture…",
        ctrl(Key::S),
    ),
    entry(
        Menu::File,
        Command::CopyPicture,
        "Copy picture",
        ctrl(Key::C),
    ),
    entry(Menu::File, Command::Export, "Export…", ctrl(Key::E)),
    entry(
        Menu::File,
        Command::ExportSelection,
        "Export selection…",
        None,
    ),
    entry(Menu::File, Command::Quit, "Quit", ctrl(Key::Q)),
    entry(Menu::View, Command::ZoomAll, "Zoom all", plain(Key::A)),
    entry(
        Menu::View,
        Command::ZoomSelection,
        "Zoom selection",
        plain(Key::F),
    ),
    entry(
        Menu::View,
        Command::FirstView,
        "First view",
        plain(Key::Home),
    ),
    entry(
        Menu::View,
        Command::NextCamera,
        "Next camera of the file",
        plain(Key::C),
    ),
    entry(
        Menu::View,
        Command::Look(Standard::Front),
        "Front",
        plain(Key::Num1),
    ),
    entry(
        Menu::View,
        Command::Look(Standard::Back),
        "Back",
        plain(Key::Num2),
    ),
    entry(
        Menu::View,
        Command::Look(Standard::Left),
        "Left",
        plain(Key::Num3),
    ),
    entry(
        Menu::View,
        Command::Look(Standard::Right),
        "Right",
        plain(Key::Num4),
    ),
    entry(
        Menu::View,
        Command::Look(Standard::Top),
        "Top",
        plain(Key::Num5),
    ),
    entry(
        Menu::View,
        Command::Look(Standard::Bottom),
        "Bottom",
        plain(Key::Num6),
    ),
    entry(
        Menu::View,
        Command::Look(Standard::ThreeQuarter),
        "Three-quarter",
        plain(Key::Num7),
    ),
    entry(
        Menu::View,
        Command::ChangeLens,
        "Perspective or parallel",
        plain(Key::P),
    ),
    entry(
        Menu::View,
        Command::ChangeTurning,
        "Turntable or ball",
        plain(Key::B),
    ),
    entry(
        Menu::View,
        Command::Level,
        "Level the horizon",
        plain(Key::L),
    ),
    entry(Menu::View, Command::LoadView, "Load view…", ctrl(Key::L)),
    entry(
        Menu::View,
        Command::SaveView,
        "Save view…",
        Some(KeyboardShortcut::new(
            Modifiers::COMMAND.plus(Modifiers::SHIFT),
            Key::S,
        )),
    ),
    entry(Menu::Show, Command::Shadows, "Shadows", plain(Key::S)),
    entry(Menu::Show, Command::Headlight, "Headlight", plain(Key::H)),
    entry(Menu::Show, Command::Wireframe, "Wireframe", plain(Key::W)),
    entry(Menu::Show, Command::Edges, "Edges", plain(Key::E)),
    entry(Menu::Show, Command::Points, "Points", plain(Key::D)),
    entry(Menu::Show, Command::Normals, "Normals", plain(Key::N)),
    entry(
        Menu::Show,
        Command::Silhouettes,
        "Silhouettes from the lights",
        plain(Key::O),
    ),
    entry(
        Menu::Show,
        Command::Volumes,
        "Shadow volumes",
        plain(Key::V),
    ),
    entry(Menu::Show, Command::Grid, "Grid", plain(Key::G)),
    entry(Menu::Show, Command::Axes, "Axes", plain(Key::X)),
    entry(Menu::Show, Command::Section, "Section plane", plain(Key::K)),
    entry(
        Menu::Show,
        Command::Tree,
        "Tree of the model",
        plain(Key::F2),
    ),
    entry(Menu::Show, Command::Settings, "Settings", plain(Key::F3)),
    entry(
        Menu::Select,
        Command::Deselect,
        "Select nothing",
        plain(Key::Escape),
    ),
    entry(Menu::Select, Command::Hide, "Hide", plain(Key::Delete)),
    entry(Menu::Select, Command::Isolate, "Isolate", plain(Key::I)),
    entry(
        Menu::Select,
        Command::ShowAll,
        "Show everything",
        plain(Key::U),
    ),
    entry(Menu::Select, Command::Measure, "Measure", plain(Key::M)),
    entry(
        Menu::Help,
        Command::Help,
        "Keys and mouse",
        shift(Key::Questionmark),
    ),
];

/// What the mouse does, for the cheat sheet.
pub const MOUSE: &[(&str, &str)] = &[
    ("Drag", "turn around the point below the mouse"),
    ("Shift + drag, middle drag", "move"),
    ("Right drag", "look around; with W A S D Q E held, fly"),
    ("Wheel, pinch", "zoom to the mouse"),
    ("Two fingers sideways", "move (with Shift)"),
    ("Click", "select"),
    ("Double click", "go to the point"),
    ("Arrows", "turn; with Shift, move"),
    ("+ and -", "zoom"),
];

/// The commands whose keys were pressed. Keys belong to a text field that has the focus.
pub fn pressed(ctx: &egui::Context) -> Vec<Command> {
    if ctx.egui_wants_keyboard_input() {
        return Vec::new();
    }
    let mut commands = Vec::new();
    ctx.input_mut(|input| {
        // On some systems these come as events of their own.
        if input
            .events
            .iter()
            .any(|event| matches!(event, egui::Event::Copy))
        {
            commands.push(Command::CopyPicture);
        }
        if input
            .events
            .iter()
            .any(|event| matches!(event, egui::Event::Text(t) if t == "?"))
        {
            commands.push(Command::Help);
        }
        // The most specific first: Ctrl+S is not S.
        let mut entries: Vec<&Entry> = ALL.iter().collect();
        entries.sort_by_key(|entry| {
            let modifiers = entry.key.map_or(Modifiers::NONE, |key| key.modifiers);
            std::cmp::Reverse(u8::from(modifiers.shift) + u8::from(modifiers.command))
        });
        for entry in entries {
            if let Some(key) = entry.key
                && entry.command != Command::Help
                && input.modifiers.matches_exact(key.modifiers)
                && input.consume_key(key.modifiers, key.logical_key)
            {
                commands.push(entry.command);
            }
        }
    });
    commands
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_commands_share_a_key_or_a_name() {
        for (i, a) in ALL.iter().enumerate() {
            for b in &ALL[i + 1..] {
                assert_ne!(a.text, b.text);
                assert_ne!(a.command, b.command);
                assert!(
                    a.key.is_none() || a.key != b.key,
                    "{} and {}",
                    a.text,
                    b.text
                );
            }
        }
    }
}
