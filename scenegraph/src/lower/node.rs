//! One node: its class, its fields by the registry, its children.

use iv_parser::{
    Atom, Child, FieldId, Form, Item, NodeId as TreeId, Severity, Span, Value, text_of,
};

use super::connect::Link;
use super::kits::Compound;
use super::names::display_name;
use super::upgrade::OldValue;
use super::value::Reader;
use super::{File, upgrade};
use crate::graph::{FieldEntry, FieldValue, Kind, Node, NodeId};
use crate::registry::{Class, ClassSpec, Family, FieldSpec, FieldType};

/// Words that describe an extension node to readers that do not know it; in nodes that are known
/// they say nothing new.
const DESCRIPTION: [&[u8]; 3] = [b"fields", b"inputs", b"isA"];

impl<'a> File<'_, '_, 'a, '_> {
    /// Adds all nodes of the tree.
    pub(super) fn nodes(&mut self) {
        let count = self.tree.node_count();
        self.builder.nodes.reserve(count);
        let mut splits = Vec::new();
        for i in 0..count as u32 {
            let mut old = Vec::new();
            let node = self.node(TreeId(i), &mut old);
            let is_kit =
                |c: Class| c == Class::GeneralizedCylinder || c.spec().family == Family::Kit;
            self.builder.late.has_kits |= node.class().is_some_and(is_kit);
            self.builder.nodes.push(node);
            self.drop_surplus_problems();
            if !old.is_empty() {
                splits.push((NodeId(self.base + i), old));
            }
        }
        for (id, old) in splits {
            upgrade::split(self, id, &old);
        }
    }

    /// Says once that nothing moves.
    pub(super) fn report_routes(&mut self) {
        if self.routes > 0 {
            let what = match self.routes {
                1 => "a ROUTE has".to_owned(),
                many => format!("{many} ROUTEs have"),
            };
            let message = format!("{what} no effect on a static picture");
            let hint = "fields keep the values that are written";
            self.problem(Severity::Note, "route", message, hint, Span::default());
        }
    }

    /// Keeps the list of problems short while a file that has one at every node is read.
    fn drop_surplus_problems(&mut self) {
        let limit = self.builder.limits.problems;
        if self.problems.len() > 2 * limit {
            self.dropped += self.problems.len() - limit;
            self.problems.truncate(limit);
        }
    }

    fn node(&mut self, id: TreeId, old: &mut Vec<OldValue>) -> Node {
        let tree = self.tree;
        let source = tree.node(id);
        self.owner = id;
        self.scope = self.names.scope(id);
        let start = source.span.start as usize;
        let pos = self.lines.position(tree.source, start);
        let name = source.def.and_then(display_name);
        let mut node = Node {
            kind: Kind::Known(Class::Group),
            name,
            fields: Vec::new(),
            children: Vec::new(),
            pos,
        };
        match source.form {
            Form::Node => {}
            Form::Proto | Form::ExternProto => {
                self.proto(id);
                return node;
            }
            Form::Route => {
                self.routes += 1;
                return node;
            }
        }
        match self.proto_of(id) {
            None => {}
            Some(Ok(proto)) => {
                self.instance(id, proto, &mut node);
                return node;
            }
            Some(Err(())) => {
                let name = text_of(&source.class[..source.class.len().min(80)]);
                self.problem(
                    Severity::Error,
                    "cycle",
                    format!("`{name}` is used inside its own definition"),
                    "a prototype cannot hold itself; this node was left out",
                    source.span,
                );
                return node;
            }
        }
        let known = if self.vrml2 {
            Class::from_vrml_name(source.class)
        } else {
            Class::from_name(source.class)
        };
        match known.or_else(|| self.class_from_description(id)) {
            Some(class) => {
                node.kind = Kind::Known(class);
                self.known(id, class, &mut node, old);
                let header = tree.header;
                if header.is_older_than(2, 1) {
                    upgrade::upgrade(&mut node, old, header.version);
                }
                if class == Class::WWWInline && node.entry("name").is_none() {
                    node.children = node.node_field("alternateRep").into_iter().collect();
                }
                settle(&mut node);
                if self.scope.is_none() {
                    let id = NodeId(self.base + id.0);
                    self.builder.note_include(id, &node);
                }
            }
            None if source.class.is_empty() => self.known(id, Class::Group, &mut node, old),
            None => {
                node.kind =
                    Kind::Unknown(text_of(&source.class[..source.class.len().min(200)]).into());
                self.unknown(id, &mut node);
            }
        }
        node
    }

    /// The first known class in `isA [ … ]` of a class that is not known (SGI's rule).
    fn class_from_description(&self, id: TreeId) -> Option<Class> {
        let tree = self.tree;
        tree.items(id).iter().find_map(|item| {
            let Item::Field(field) = item else {
                return None;
            };
            let field = tree.field(*field);
            let Value::Atoms { atoms, .. } = &field.value else {
                return None;
            };
            if field.name != b"isA" {
                return None;
            }
            tree.atoms(*atoms).iter().find_map(|atom| match atom {
                Atom::String(name, _) | Atom::Word(name, _) => Class::from_name(name),
                _ => None,
            })
        })
    }

    fn known(&mut self, id: TreeId, class: Class, node: &mut Node, old: &mut Vec<OldValue>) {
        let tree = self.tree;
        let spec = class.spec();
        let mut strays = 0;
        // Exact room: there are many nodes with a field or two.
        let is_field = |item: &&Item<'_>| matches!(item, Item::Field(_));
        let fields = tree.items(id).iter().filter(is_field).count();
        node.fields.reserve_exact(fields);
        if spec.is_group() {
            node.children.reserve_exact(tree.items(id).len() - fields);
        }
        for item in tree.items(id) {
            match *item {
                Item::Child(child) => match self.child(child) {
                    Some(child) if spec.is_group() => node.children.push(child),
                    Some(_) => strays += 1,
                    None => {}
                },
                // What a script declares is its own business.
                Item::Field(field) if tree.declaration(field).is_some() => {}
                Item::Field(field) => self.field(spec, field, node, old),
            }
        }
        if strays > 0 {
            self.problem(
                Severity::Warning,
                "no-group",
                format!("{} cannot have children", spec.name),
                "they were left out; close the node before them",
                head(tree.node(id).span, spec.name.len()),
            );
        }
    }

    fn field(
        &mut self,
        spec: &'static ClassSpec,
        id: FieldId,
        node: &mut Node,
        old: &mut Vec<OldValue>,
    ) {
        let tree = self.tree;
        let field = tree.field(id);
        if tree.header.is_older_than(2, 1)
            && let Some(old_spec) = spec.old_field(field.name, tree.header.version)
        {
            let value = self.value(spec, old_spec, id);
            old.extend(value.map(|value| OldValue {
                spec: old_spec,
                value,
            }));
            return;
        }
        let Some((index, field_spec)) = spec.field(field.name) else {
            return self.unknown_field(spec, id, node);
        };
        if let Value::Is(name) = field.value {
            return self.link_field(name, index, field_spec.field_type, id);
        }
        let value = self.value(spec, field_spec, id);
        if let Some(connection) = &field.connection {
            // A master that nobody has is said when it is looked up.
            let master = self.child(connection.master);
            match (&value, master) {
                (None, Some(master)) => self.builder.late.add_link(Link {
                    slave: NodeId(self.base + self.owner.0),
                    field: index as u16,
                    ignored: field.ignored,
                    master,
                    output: text_of(&connection.output[..connection.output.len().min(80)]),
                }),
                (None, None) => {}
                (Some(_), _) => self.problem(
                    Severity::Note,
                    "connection",
                    format!(
                        "`{}.{}` is connected to another field",
                        spec.name, field_spec.name
                    ),
                    "the value written is used",
                    field.span,
                ),
            }
            if value.is_none() {
                return;
            }
        }
        let value = match value {
            None if field.ignored => super::read_default(field_spec),
            None => return,
            Some(value) => value,
        };
        node.fields.push(FieldEntry {
            index: index as u16,
            ignored: field.ignored,
            value,
        });
    }

    /// The value written for a field, if it can be used.
    fn value(
        &mut self,
        spec: &ClassSpec,
        field_spec: &FieldSpec,
        id: FieldId,
    ) -> Option<FieldValue> {
        let tree = self.tree;
        let field = tree.field(id);
        if matches!(field.value, Value::Missing) {
            return None;
        }
        // The handles are looked up first: the reader borrows the problems.
        let mut handles = self.handles(&field.value).into_iter();
        let mut reader = Reader {
            tree,
            subject: &|| format!("`{}.{}`", spec.name, field_spec.name),
            node: &mut |_| handles.next().flatten(),
            problems: self.problems,
        };
        reader.read(&field.value, field_spec, field.span)
    }

    /// The handles of all nodes that stand in a value, in order.
    pub(super) fn handles(&mut self, value: &Value) -> Vec<Option<NodeId>> {
        let Value::Atoms { atoms, .. } = value else {
            return Vec::new();
        };
        let tree = self.tree;
        let children = tree.atoms(*atoms).iter().filter_map(|atom| match atom {
            Atom::Child(child) => Some(*child),
            _ => None,
        });
        children
            .collect::<Vec<Child<'a>>>()
            .into_iter()
            .map(|c| self.child(c))
            .collect()
    }

    /// An input of an engine that names the type of its inputs; false if it is none.
    fn input(&mut self, spec: &ClassSpec, id: FieldId, node: &Node) -> bool {
        let takes = matches!(
            spec.class,
            Class::Gate | Class::SelectOne | Class::Concatenate
        );
        let tree = self.tree;
        let name = tree.field(id).name;
        if !takes || !name.starts_with(b"input") {
            return false;
        }
        let named = node.text("type");
        let known = named.and_then(|name| FieldType::from_name(name.as_bytes()));
        let Some(field_type) = known else {
            return false;
        };
        if let Value::Is(outer) = tree.field(id).value {
            self.link_input(outer, text_of(name).into(), field_type, id);
            return true;
        }
        let field_spec = FieldSpec {
            name: "input",
            field_type,
            default: "",
            words: &[],
        };
        if let Some(value) = self.value(spec, &field_spec, id) {
            let node = NodeId(self.base + self.owner.0);
            let list = self.builder.late.inputs.entry(node).or_default();
            list.push((text_of(name).into(), value));
        }
        true
    }

    /// Whether a node describes a field of its own: `fields [ SFString maker ]`.
    fn declares(&self, id: TreeId, name: &[u8]) -> bool {
        let tree = self.tree;
        tree.items(id).iter().any(|item| {
            let Item::Field(field) = item else {
                return false;
            };
            let field = tree.field(*field);
            let Value::Atoms { atoms, .. } = &field.value else {
                return false;
            };
            let is_name = |atom: &Atom<'_>| matches!(atom, Atom::Word(word, _) if *word == name);
            field.name == b"fields" && tree.atoms(*atoms).iter().any(is_name)
        })
    }

    fn unknown_field(&mut self, spec: &ClassSpec, id: FieldId, node: &mut Node) {
        let tree = self.tree;
        let field = tree.field(id);
        // Events of VRML have no values, and are in no list.
        if matches!(field.value, Value::Is(_)) {
            self.input(spec, id, node);
            return;
        }
        if spec.family == Family::Kit && field.name.contains(&b'.') {
            let path = text_of(&field.name[..field.name.len().min(200)]);
            if let Some(&part) = self.handles(&field.value).iter().flatten().next() {
                self.builder.late.compounds.push(Compound {
                    kit: NodeId(self.base + self.owner.0),
                    path,
                    part,
                });
            }
            return;
        }
        if self.input(spec, id, node) {
            return;
        }
        let expected = DESCRIPTION.contains(&field.name) || spec.has_parts();
        if expected || self.declares(self.owner, field.name) {
            return;
        }
        let handles: Vec<NodeId> = self.handles(&field.value).into_iter().flatten().collect();
        if field.name == b"alternateRep" {
            return;
        }
        let name = text_of(&field.name[..field.name.len().min(80)]);
        let kept = spec.is_group() && !handles.is_empty();
        if kept {
            node.children.extend(handles);
        }
        let hint = match (kept, closest_field(spec, &name)) {
            (true, _) => "the node in it was kept as a child".to_owned(),
            (false, Some(near)) => format!("did you mean `{near}`? The value was ignored"),
            (false, None) => "the value was ignored".to_owned(),
        };
        let span = head(field.span, field.name.len());
        let message = format!("`{name}` is not a field of {}", spec.name);
        self.problem(Severity::Warning, "unknown-field", message, &hint, span);
    }

    /// A hint at the class that an unknown name may mean, looked for once for each name, and not at
    /// all once no more problems are kept.
    fn guess(&mut self, class: &str) -> String {
        if self.problems.len() >= self.builder.limits.problems {
            return String::new();
        }
        if let Some(known) = self.guesses.get(class) {
            return known.clone();
        }
        let found = match self.vrml2 {
            true => Class::closest(&format!("VRML{class}")).or_else(|| Class::closest(class)),
            false => Class::closest(class),
        };
        let text = found.map_or(String::new(), |c| {
            let name = if self.vrml2 { c.vrml_name() } else { c.name() };
            format!("; did you mean {name}?")
        });
        self.guesses.insert(class.to_owned(), text.clone());
        text
    }

    /// A class that nobody knows: what is drawn in its place are its `alternateRep`, else the
    /// nodes in it.
    fn unknown(&mut self, id: TreeId, node: &mut Node) {
        let tree = self.tree;
        let mut alternate = None;
        for item in tree.items(id) {
            match *item {
                Item::Child(child) => node.children.extend(self.child(child)),
                Item::Field(field) => {
                    let field = tree.field(field);
                    let handles: Vec<NodeId> =
                        self.handles(&field.value).into_iter().flatten().collect();
                    if field.name == b"alternateRep" {
                        alternate = handles.first().copied();
                    } else if field.name == b"children" {
                        node.children.extend(handles);
                    }
                }
            }
        }
        let class = node.class_name().to_owned();
        let guess = self.guess(&class);
        let (severity, what) = match (alternate, node.children.is_empty()) {
            (Some(alternate), _) => {
                node.children = vec![alternate];
                (Severity::Note, "its alternateRep is used".to_owned())
            }
            (None, false) => (
                Severity::Warning,
                format!("the nodes in it are used as in a Group{guess}"),
            ),
            (None, true) => (Severity::Warning, format!("it was left out{guess}")),
        };
        let span = head(tree.node(id).span, tree.node(id).class.len());
        self.problem(
            severity,
            "unknown-class",
            format!("the node class `{class}` is not known"),
            &what,
            span,
        );
    }
}

/// Puts what the fields of a VRML 2 group hold among its children.
pub(super) fn settle(node: &mut Node) {
    let Some(list) = node.class().and_then(|c| c.spec().child_list()) else {
        return;
    };
    if let FieldValue::Nodes(nodes) = node.value(list) {
        let nodes = nodes.clone();
        node.children.extend(nodes);
    }
    if let Some((index, _)) = node.class().and_then(|c| c.spec().field(list.as_bytes())) {
        node.fields.retain(|f| usize::from(f.index) != index);
    }
}

fn head(span: Span, len: usize) -> Span {
    Span {
        start: span.start,
        end: span.end.min(span.start + len as u32),
    }
}

/// A field whose name differs by case or one letter.
fn closest_field(spec: &ClassSpec, name: &str) -> Option<&'static str> {
    let near = |known: &str| {
        if known.eq_ignore_ascii_case(name) {
            return true;
        }
        // One letter more, less, wrong, or two swapped: the same letters outside a short middle.
        let same_start = known
            .bytes()
            .zip(name.bytes())
            .take_while(|(a, b)| a == b)
            .count();
        let rest = |s: &str| s.len() - same_start;
        let same_end = known
            .bytes()
            .rev()
            .zip(name.bytes().rev())
            .take(rest(known).min(rest(name)))
            .take_while(|(a, b)| a == b)
            .count();
        name.len() > 2 && rest(known) - same_end <= 2 && rest(name) - same_end <= 2
    };
    spec.fields.iter().map(|f| f.name).find(|known| near(known))
}
