//! The hierarchy of a scene as a list of rows, each behind its parent: what a tree shows.

use scenegraph::scene::{NodeId, Scene, Topology};

/// What a row stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Item {
    /// A group of the source.
    Node(NodeId),
    /// Something drawn: its position in `Scene::instances`.
    Instance(usize),
}

/// A row of the tree.
#[derive(Clone, Debug)]
pub struct Row {
    /// What it is.
    pub item: Item,
    /// Its name, or else its class.
    pub label: String,
    /// The class, if the label is a name.
    pub class: Option<String>,
    /// Groups around it.
    pub depth: usize,
    /// The row of the group around it.
    pub parent: Option<usize>,
    /// The first row behind all that is in it.
    pub end: usize,
}

/// The rows of a scene.
#[derive(Clone, Debug, Default)]
pub struct Outline {
    /// In the order of traversal: what is in a group follows it.
    pub rows: Vec<Row>,
    /// The row of each instance.
    pub row_of_instance: Vec<usize>,
}

impl Outline {
    /// Of a scene; linear in its nodes and instances.
    pub fn new(scene: &Scene) -> Self {
        let mut outline = Self {
            rows: Vec::with_capacity(scene.nodes.len() + scene.instances.len()),
            row_of_instance: vec![0; scene.instances.len()],
        };
        let (roots, members) = members(scene);
        // A member, with its depth and parent; or the end of a row.
        enum Step {
            Begin(Item, usize, Option<usize>),
            End(usize),
        }
        let mut open: Vec<Step> = roots
            .into_iter()
            .rev()
            .map(|item| Step::Begin(item, 0, None))
            .collect();
        while let Some(step) = open.pop() {
            match step {
                Step::End(row) => outline.rows[row].end = outline.rows.len(),
                Step::Begin(item, depth, parent) => {
                    let row = outline.rows.len();
                    let (label, class) = words(scene, item);
                    outline.rows.push(Row {
                        item,
                        label,
                        class,
                        depth,
                        parent,
                        end: row + 1,
                    });
                    match item {
                        Item::Instance(instance) => outline.row_of_instance[instance] = row,
                        Item::Node(node) => {
                            open.push(Step::End(row));
                            let inside = members[node.index()].iter().rev();
                            open.extend(inside.map(|&i| Step::Begin(i, depth + 1, Some(row))));
                        }
                    }
                }
            }
        }
        outline
    }

    /// The instances in a row.
    pub fn instances(&self, row: usize) -> impl Iterator<Item = usize> {
        let end = self.rows.get(row).map_or(row, |r| r.end);
        let inside = self.rows.get(row..end).unwrap_or_default();
        inside.iter().filter_map(|r| match r.item {
            Item::Instance(instance) => Some(instance),
            Item::Node(_) => None,
        })
    }

    /// The rows around a row, from the inside out.
    pub fn ancestors(&self, row: usize) -> impl Iterator<Item = usize> {
        let parent = |row: &usize| self.rows.get(*row).and_then(|r| r.parent);
        std::iter::successors(parent(&row), parent)
    }
}

/// What stands at the top, and in each node; nodes and instances in the order in which the first
/// thing in them is drawn.
fn members(scene: &Scene) -> (Vec<Item>, Vec<Vec<Item>>) {
    let mut roots = Vec::new();
    let mut members = vec![Vec::new(); scene.nodes.len()];
    let mut is_placed = vec![false; scene.nodes.len()];
    for (i, instance) in scene.instances.iter().enumerate() {
        let mut item = Item::Instance(i);
        let mut at = instance.placement.node;
        while let Some(node) = at {
            members[node.index()].push(item);
            if std::mem::replace(&mut is_placed[node.index()], true) {
                break;
            }
            item = Item::Node(node);
            at = scene.nodes[node.index()].parent;
        }
        if at.is_none() {
            roots.push(item);
        }
    }
    (roots, members)
}

fn words(scene: &Scene, item: Item) -> (String, Option<String>) {
    let (name, class) = match item {
        Item::Node(id) => {
            let node = &scene.nodes[id.index()];
            (node.name.as_deref(), node.class.to_string())
        }
        Item::Instance(i) => {
            let instance = &scene.instances[i];
            let kind = match scene.meshes[instance.mesh.index()].topology {
                Topology::Triangles => "Faces",
                Topology::Lines => "Lines",
                Topology::Points => "Points",
            };
            (instance.placement.name.as_deref(), kind.to_owned())
        }
    };
    match name {
        Some(name) if !name.is_empty() => (name.to_owned(), Some(class)),
        _ => (class, None),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_follow_the_hierarchy() {
        let text = "#Inventor V2.1 ascii\nDEF House Separator { DEF Roof Cone { } \
                    Separator { Translation { translation 5 0 0 } DEF Door Cube { } Cube { } } \
                    Sphere { } }\nDEF Tree Separator { Separator { } DEF Trunk Cylinder { } }";
        let graph = scenegraph::load(
            text.as_bytes(),
            "a.iv",
            std::path::Path::new(""),
            &scenegraph::FileLoader::default(),
        );
        let scene = scenegraph::resolve(&graph, &scenegraph::ResolveOptions::default()).scene;
        let outline = Outline::new(&scene);
        let rows: Vec<String> = outline
            .rows
            .iter()
            .map(|r| format!("{}{}", "  ".repeat(r.depth), r.label))
            .collect();
        let expected = [
            "Separator",
            "  House",
            "    Roof",
            "    Separator",
            "      Door",
            "      Faces",
            "    Faces",
            "  Tree",
            "    Trunk",
        ];
        assert_eq!(rows, expected);
        assert_eq!(outline.instances(1).collect::<Vec<_>>(), [0, 1, 2, 3]);
        assert_eq!(outline.instances(3).collect::<Vec<_>>(), [1, 2]);
        assert_eq!(outline.instances(8).collect::<Vec<_>>(), [4]);
        assert_eq!(outline.instances(99).count(), 0);
        assert_eq!(outline.row_of_instance, [2, 4, 5, 6, 8]);
        assert_eq!(outline.ancestors(4).collect::<Vec<_>>(), [3, 1, 0]);
        assert_eq!(outline.rows[4].class.as_deref(), Some("Faces"));
        assert_eq!(outline.rows[3].class, None);
    }
}
