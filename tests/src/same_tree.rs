//! Whether two trees mean the same text: equal but for places, layout, whether whole numbers are
//! written with a point, and whether they were read from text or from binary.

use iv_parser::{Atom, Child, Field, Item, Node, NodeId, Numbers, Tree, Value};

/// The first difference found, or `None`.
pub fn difference(a: &Tree<'_>, b: &Tree<'_>) -> Option<String> {
    let family = |tree: &Tree<'_>| (tree.header.dialect, tree.header.version);
    if family(a) != family(b) {
        return Some(format!("header {:?}, {:?}", a.header, b.header));
    }
    let mut pairs = Pairs {
        a,
        b,
        open: Vec::new(),
    };
    let (x, y) = (a.children_of_root(), b.children_of_root());
    if x.len() != y.len() {
        return Some(format!("{} roots, {}", x.len(), y.len()));
    }
    for (x, y) in x.iter().zip(y) {
        if !pairs.child(x, y) {
            return Some(format!("roots {x:?}, {y:?}"));
        }
    }
    while let Some((x, y)) = pairs.open.pop() {
        if let Some(difference) = pairs.node(x, y) {
            return Some(difference);
        }
    }
    None
}

/// Pairs of nodes still to compare.
struct Pairs<'t, 'a, 'b> {
    a: &'t Tree<'a>,
    b: &'t Tree<'b>,
    open: Vec<(NodeId, NodeId)>,
}

impl Pairs<'_, '_, '_> {
    fn child(&mut self, x: &Child<'_>, y: &Child<'_>) -> bool {
        match (x, y) {
            (Child::Node(x), Child::Node(y)) => {
                self.open.push((*x, *y));
                true
            }
            (Child::Use(x, _), Child::Use(y, _)) => x == y,
            (Child::Null, Child::Null) => true,
            _ => false,
        }
    }

    fn node(&mut self, x: NodeId, y: NodeId) -> Option<String> {
        let (m, n): (&Node<'_>, &Node<'_>) = (self.a.node(x), self.b.node(y));
        let (items, others) = (self.a.items(x), self.b.items(y));
        if m.form != n.form || m.class != n.class || m.def != n.def || items.len() != others.len() {
            return Some(format!(
                "node {} of {} items, {} of {}",
                text(m.class),
                items.len(),
                text(n.class),
                others.len()
            ));
        }
        for (item, other) in items.iter().zip(others) {
            let same = match (item, other) {
                (Item::Child(c), Item::Child(d)) => self.child(c, d),
                (Item::Field(f), Item::Field(g)) => {
                    self.a.declaration(*f) == self.b.declaration(*g)
                        && self.field(self.a.field(*f), self.b.field(*g))
                }
                _ => false,
            };
            if !same {
                let name = |tree: &Tree<'_>, item: &Item<'_>| match item {
                    Item::Field(f) => format!("{:?}", tree.field(*f)),
                    other => format!("{other:?}"),
                };
                let (x, y) = (name(self.a, item), name(self.b, other));
                return Some(format!("in {}: {x}, {y}", text(m.class)));
            }
        }
        None
    }

    fn field(&mut self, x: &Field<'_>, y: &Field<'_>) -> bool {
        let connected = match (&x.connection, &y.connection) {
            (None, None) => true,
            (Some(c), Some(d)) => c.output == d.output && self.child(&c.master, &d.master),
            _ => false,
        };
        connected && x.name == y.name && x.ignored == y.ignored && self.value(&x.value, &y.value)
    }

    fn value(&mut self, x: &Value, y: &Value) -> bool {
        match (x, y) {
            (Value::Missing, Value::Missing) => true,
            (
                Value::Numbers {
                    numbers: x,
                    bracketed: p,
                    ..
                },
                Value::Numbers {
                    numbers: y,
                    bracketed: q,
                    ..
                },
            ) => p == q && numbers(self.a, x) == numbers(self.b, y),
            (
                Value::Atoms {
                    atoms: x,
                    bracketed: p,
                },
                Value::Atoms {
                    atoms: y,
                    bracketed: q,
                },
            ) => p == q && self.atoms(*x, *y),
            (Value::Mask(x), Value::Mask(y)) | (Value::Is(x), Value::Is(y)) => self.atoms(*x, *y),
            _ => false,
        }
    }

    fn atoms(&mut self, x: (u32, u32), y: (u32, u32)) -> bool {
        let (x, y) = (self.a.atoms(x), self.b.atoms(y));
        x.len() == y.len() && x.iter().zip(y).all(|(x, y)| self.atom(x, y))
    }

    fn atom(&mut self, x: &Atom<'_>, y: &Atom<'_>) -> bool {
        match (x, y) {
            (Atom::Number(x, _), Atom::Number(y, _)) => x.to_bits() == y.to_bits(),
            (Atom::String(x, _), Atom::String(y, _)) | (Atom::Word(x, _), Atom::Word(y, _)) => {
                x == y
            }
            (Atom::Child(x), Atom::Child(y)) => self.child(x, y),
            _ => false,
        }
    }
}

/// Bit by bit, integers as the f64 they are equal to.
fn numbers(tree: &Tree<'_>, numbers: &Numbers) -> Vec<u64> {
    let ints = tree.ints(numbers).unwrap_or_default();
    let floats = tree.floats(numbers).unwrap_or_default();
    let ints = ints.iter().map(|&i| f64::from(i).to_bits());
    ints.chain(floats.iter().map(|x| x.to_bits())).collect()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}
