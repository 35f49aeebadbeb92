//! What the source says of nodes, as Inventor fields: read again in the background when somebody
//! wants to know, and kept by the thread that answers.

use std::path::Path;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;

use convert::command::access::Access;
use convert::command::model;
use iv_parser::SourcePos;
use scenegraph::graph::{FieldEntry, FieldValue, Graph, Node, NodeId};
use scenegraph::registry::{Class, Family};

use crate::cli::args::Args;
use crate::load::Wake;

/// Numbers of a list that are shown.
const SHOWN: usize = 6;
/// Characters of a text that are shown.
const TEXT: usize = 80;

/// A node of the source.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SourceNode {
    /// Its class.
    pub class: String,
    /// Its DEF name.
    pub name: Option<String>,
    /// Its line; 0 in a binary file.
    pub line: u32,
    /// Fields that the source sets: name, value.
    pub fields: Vec<(String, String)>,
    /// All other fields, with their defaults.
    pub defaults: Vec<(String, String)>,
}

/// A node, and the property nodes in it if it is a group.
pub type Answer = (SourcePos, Vec<SourceNode>);

/// Asks the thread, and keeps its last answer.
pub struct Fields {
    questions: Sender<SourcePos>,
    answers: Receiver<Answer>,
    asked: Option<SourcePos>,
    known: Option<Answer>,
}

impl Fields {
    /// Begins to read. `wake` is called when there is an answer.
    pub fn new(path: &Path, args: &Args, wake: Wake) -> Self {
        let (questions, asked) = channel::<SourcePos>();
        let (answer, answers) = channel();
        let (path, args) = (path.to_owned(), args.clone());
        thread::spawn(move || {
            let graph = read(&path, &args);
            for pos in asked {
                let nodes = graph
                    .as_ref()
                    .map_or(Vec::new(), |graph| nodes_at(graph, pos));
                if answer.send((pos, nodes)).is_err() {
                    return;
                }
                wake();
            }
        });
        Self {
            questions,
            answers,
            asked: None,
            known: None,
        }
    }

    /// Whether the last question is answered.
    pub fn is_settled(&self) -> bool {
        self.asked == self.known.as_ref().map(|(pos, _)| *pos)
    }

    /// What stands at a place, once it is known.
    pub fn at(&mut self, pos: SourcePos) -> Option<&[SourceNode]> {
        if self.asked != Some(pos) {
            self.asked = Some(pos);
            // A thread that is gone answers nothing.
            let _ = self.questions.send(pos);
        }
        if let Some(answer) = self.answers.try_iter().last() {
            self.known = Some(answer);
        }
        let known = self.known.as_ref().filter(|(at, _)| *at == pos);
        known.map(|(_, nodes)| nodes.as_slice())
    }
}

fn read(path: &Path, args: &Args) -> Option<Graph> {
    let access = Access::new(&args.search, &args.packed).ok()?;
    let opened = model::open(path, &access).ok()?;
    // glTF has no Inventor fields.
    (!convert::is_gltf(&opened.bytes)).then(|| opened.into_graph().0)
}

fn nodes_at(graph: &Graph, pos: SourcePos) -> Vec<SourceNode> {
    let Some(node) = graph.nodes().iter().find(|node| node.pos == pos) else {
        return Vec::new();
    };
    let properties = node
        .children
        .iter()
        .map(|&id| graph.node(id))
        .filter(|child| {
            child.class().is_some_and(|class| {
                matches!(
                    class.spec().family,
                    Family::Transform | Family::Appearance | Family::Property | Family::Information
                )
            })
        });
    std::iter::once(node)
        .chain(properties)
        .map(|node| described(graph, node))
        .collect()
}

fn described(graph: &Graph, node: &Node) -> SourceNode {
    let mut described = SourceNode {
        class: node.class_name().to_owned(),
        name: node.name.as_deref().map(str::to_owned),
        line: node.pos.line,
        ..SourceNode::default()
    };
    let Some(class) = node.class() else {
        return described;
    };
    for field in class.spec().fields {
        match node.entry(field.name) {
            Some(entry) => {
                let value = shown(graph, class, entry);
                described.fields.push((field.name.to_owned(), value));
            }
            None => described
                .defaults
                .push((field.name.to_owned(), field.default.to_owned())),
        }
    }
    described
}

fn shown(graph: &Graph, class: Class, entry: &FieldEntry) -> String {
    let spec = &class.spec().fields[usize::from(entry.index)];
    let mut text = match &entry.value {
        FieldValue::None => String::new(),
        FieldValue::Bool(true) => "TRUE".to_owned(),
        FieldValue::Bool(false) => "FALSE".to_owned(),
        value @ (FieldValue::Few(..) | FieldValue::Many(_)) => list(value.numbers()),
        value @ (FieldValue::Int(_) | FieldValue::Ints(_)) => list(value.ints()),
        FieldValue::Word(value) => words(spec.words, *value),
        FieldValue::Texts(texts) => {
            let quoted: Vec<String> = texts
                .iter()
                .take(SHOWN)
                .map(|t| format!("\"{t}\""))
                .collect();
            cut(&quoted.join(", "))
        }
        FieldValue::Nodes(nodes) => {
            let name = |id: &NodeId| graph.node(*id).class_name().to_owned();
            let names: Vec<String> = nodes.iter().take(SHOWN).map(name).collect();
            names.join(", ")
        }
        FieldValue::Image(Some(image)) => format!("{} × {} pixels", image.width, image.height),
        FieldValue::Image(None) => "no pixels".to_owned(),
    };
    if entry.ignored {
        text.push_str(" ~");
    }
    text
}

fn words(words: &[scenegraph::registry::Word], value: u32) -> String {
    if let Some(word) = words.iter().find(|word| word.value == value) {
        return word.name.to_owned();
    }
    let bits = words
        .iter()
        .filter(|word| word.value != 0 && value & word.value == word.value);
    let names: Vec<&str> = bits.map(|word| word.name).collect();
    names.join(" | ")
}

fn list<T: std::fmt::Display>(values: &[T]) -> String {
    let words: Vec<String> = values.iter().take(SHOWN).map(T::to_string).collect();
    let text = words.join(" ");
    match values.len() {
        count if count > SHOWN => format!("{text} … ({count} numbers)"),
        _ => text,
    }
}

fn cut(text: &str) -> String {
    if text.chars().count() <= TEXT {
        return text.to_owned();
    }
    let start: String = text.chars().take(TEXT).collect();
    format!("{start}…")
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    #[test]
    fn nodes_are_told_as_they_are_written() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.iv");
        let text = "#Inventor V2.1 ascii\nSeparator {\n  DEF Red Material { diffuseColor 1 0 0 \
                    shininess 0.5 ~ }\n  ShapeHints { vertexOrdering CLOCKWISE }\n  \
                    Coordinate3 { point [ 0 0 0, 1 0 0, 0 1 0 ] }\n  DEF Lid FaceSet { numVertices 3 }\n}\n";
        std::fs::write(&path, text).unwrap();
        let args = Args::parse_from(["ivview"]);
        let graph = read(&path, &args).unwrap();
        let pos = |class: &str| {
            graph
                .nodes()
                .iter()
                .find(|n| n.class_name() == class)
                .unwrap()
                .pos
        };
        let lid = nodes_at(&graph, pos("FaceSet"));
        assert_eq!(
            (lid.len(), lid[0].line, lid[0].name.as_deref()),
            (1, 6, Some("Lid"))
        );
        assert_eq!(lid[0].fields, [("numVertices".to_owned(), "3".to_owned())]);
        assert!(
            lid[0]
                .defaults
                .iter()
                .any(|(name, value)| name == "startIndex" && value == "0")
        );
        let group = nodes_at(&graph, pos("Separator"));
        let classes: Vec<&str> = group.iter().map(|n| n.class.as_str()).collect();
        assert_eq!(
            classes,
            ["Separator", "Material", "ShapeHints", "Coordinate3"]
        );
        let value = |node: usize, field: &str| {
            let fields = &group[node].fields;
            fields
                .iter()
                .find(|(name, _)| name == field)
                .unwrap()
                .1
                .clone()
        };
        assert_eq!(value(1, "diffuseColor"), "1 0 0");
        assert_eq!(value(1, "shininess"), "0.5 ~");
        assert_eq!(value(2, "vertexOrdering"), "CLOCKWISE");
        assert_eq!(value(3, "point"), "0 0 0 1 0 0 … (9 numbers)");
        assert_eq!(nodes_at(&graph, SourcePos::default()), []);
    }
}
