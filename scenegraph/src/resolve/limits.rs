//! How much may come of a model: a few lines can ask for any number of copies. What a model may
//! become grows with what is written in it.

use crate::graph::{FieldValue, Graph};

/// Named limits for the largest models; smaller ones have lower limits, by what is
/// written in them. When one is reached, what comes behind in the model is left out, with an
/// error that says which it was.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ResolveLimits {
    /// Nodes visited, every occurrence counted; a few seconds of work.
    pub steps: usize,
    /// Nesting, sharing included.
    pub depth: usize,
    /// Nodes, instances, lights and cameras in the scene together.
    pub items: usize,
    /// Bytes of geometry made.
    pub geometry_bytes: usize,
}

impl Default for ResolveLimits {
    fn default() -> Self {
        Self {
            steps: 20_000_000,
            depth: 1000,
            items: 2_000_000,
            geometry_bytes: usize::try_from(16_u64 << 30).unwrap_or(usize::MAX),
        }
    }
}

/// What any model may become, however little is written in it: a tenth of a second or two.
const FREE: ResolveLimits = ResolveLimits {
    steps: 1_000_000,
    depth: usize::MAX,
    items: 500_000,
    geometry_bytes: 64 << 20,
};

/// Occurrences for each node and each use that are written: a model of a thousand uses of a part
/// that uses another a thousand times is well within.
const STEPS_EACH: usize = 5_000;
/// Items for each node and each use.
const ITEMS_EACH: usize = 500;
/// Bytes of geometry for each node: most spheres.
const BYTES_EACH_NODE: usize = 64 << 10;
/// Bytes of geometry for each number: a coordinate of a surface that is cut finely.
const BYTES_EACH_NUMBER: usize = 1 << 10;
/// Bytes of geometry for each character of a text.
const BYTES_EACH_CHARACTER: usize = 512;

impl ResolveLimits {
    /// The limits for one model: what any may become and so much more for each thing written in
    /// it, at most `self`.
    pub(super) fn of(self, graph: &Graph) -> Self {
        let mut handles = 0;
        let mut numbers = 0;
        let mut characters = 0;
        for node in graph.nodes() {
            handles += 1 + node.children.len();
            for field in &node.fields {
                match &field.value {
                    FieldValue::Nodes(nodes) => handles += nodes.len(),
                    FieldValue::Texts(texts) => {
                        characters += texts.iter().map(|text| text.len()).sum::<usize>();
                    }
                    value => numbers += value.numbers().len() + value.ints().len(),
                }
            }
        }
        let bytes = [
            graph.nodes().len().saturating_mul(BYTES_EACH_NODE),
            numbers.saturating_mul(BYTES_EACH_NUMBER),
            characters.saturating_mul(BYTES_EACH_CHARACTER),
        ];
        let bytes = bytes
            .into_iter()
            .fold(FREE.geometry_bytes, usize::saturating_add);
        let grown = |free: usize, each: usize| free.saturating_add(each.saturating_mul(handles));
        Self {
            steps: self.steps.min(grown(FREE.steps, STEPS_EACH)),
            depth: self.depth,
            items: self.items.min(grown(FREE.items, ITEMS_EACH)),
            geometry_bytes: self.geometry_bytes.min(bytes),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;
    use std::time::{Duration, Instant};

    use iv_parser::Severity;

    use crate::scene::Scene;
    use crate::{FileLoader, ResolveOptions, load, resolve};

    /// Groups that hold the one before twice, 40 levels of them.
    fn doubled(class: &str, leaf: &str) -> String {
        let mut text = format!("Separator {{ Switch {{ whichChild -1 DEF g0 {class} {{ {leaf} }}");
        for i in 1..40 {
            let before = i - 1;
            text += &format!(" DEF g{i} {class} {{ USE g{before} USE g{before} }}");
        }
        text + "} USE g39 }"
    }

    /// An upper bound of a scene's bytes but for its names.
    fn size(scene: &Scene) -> usize {
        let geometry = scene
            .meshes
            .iter()
            .map(|m| 4 * m.indices.len() + 48 * m.positions.len());
        let sets = scene.light_sets.iter().map(|set| 4 * set.len());
        geometry.sum::<usize>()
            + sets.sum::<usize>()
            + size_of_val(&scene.nodes[..])
            + size_of_val(&scene.instances[..])
            + size_of_val(&scene.lights[..])
            + size_of_val(&scene.cameras[..])
    }

    #[test]
    fn small_files_do_not_become_large_models() {
        let array = "Array { numElements1 1000 numElements2 1000 ";
        let twenty = "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1, ".repeat(20);
        let copies = format!("MultipleCopy {{ matrix [ {twenty} ] ");
        let net = "Coordinate3 { point [ 0 0 0, 1 0 0, 0 1 1, 1 1 -1 ] } NurbsSurface { \
                   numUControlPoints 2 numVControlPoints 2 uKnotVector [ 0 0 1 1 ] \
                   vKnotVector [ 0 0 1 1 ] }";
        let mut protos = "#VRML V2.0 utf8\nPROTO P0 [ field SFFloat x 1 ] { Group { children \
                          Shape { geometry Box { } } } }"
            .to_owned();
        let mut kits = "Separator { Switch { whichChild -1 DEF k0 ShapeKit { } ".to_owned();
        let mut boxes = doubled("Separator", "Cube { }");
        for i in 1..40 {
            let before = i - 1;
            protos += &format!(
                "PROTO P{i} [ field SFFloat x 1 ] {{ Group {{ children [ P{before} {{ x IS x }} \
                 P{before} {{ x IS x }} ] }} }}"
            );
            kits += &format!(
                "DEF k{i} SeparatorKit {{ childList NodeKitListPart {{ containerNode Separator {{ \
                 USE k{before} USE k{before} }} }} }}"
            );
            boxes += &format!(
                "Translation {{ translation = ComputeBoundingBox {{ node USE g{i} }} . max }}"
            );
        }
        let vrml = |body: &str| format!("#VRML V2.0 utf8\n{body}");
        let fine = "Complexity { value 1 } Scale { scaleFactor 1 1 1.1 }";
        let wide = "W@%8&".repeat(20);
        // What it is, and what is said about it.
        let rows: Vec<(&str, String, &[&str])> = vec![
            ("groups", doubled("Group", "Cube { }"), &["too-many-items"]),
            (
                "separators",
                doubled("Separator", "Cube { }"),
                &["too-many-items"],
            ),
            ("nothing", doubled("Group", ""), &["too-many-nodes"]),
            (
                "properties",
                doubled("Group", "Material { } Translation { translation 1 1 1 }"),
                &["too-many-nodes"],
            ),
            (
                "lights",
                doubled("Group", "PointLight { } Cube { }"),
                &["too-many-lights", "too-many-items"],
            ),
            (
                "cameras",
                doubled("Separator", "PerspectiveCamera { }"),
                &["too-many-items"],
            ),
            (
                "another plane each time",
                doubled("Group", "Translation { translation 1 0 0 } ClipPlane { }"),
                &["clip-plane", "too-many-nodes"],
            ),
            (
                "another sphere each time",
                doubled(
                    "Group",
                    &format!(
                        "Texture2Transform {{ translation 0.1 0 }} Texture2 {{ image 1 1 3 255 }} \
                         {fine} Sphere {{ }}"
                    ),
                ),
                &["too-much-geometry"],
            ),
            (
                "lines of spheres",
                doubled(
                    "Group",
                    &format!("DrawStyle {{ style LINES }} {fine} Sphere {{ }}"),
                ),
                &["transform-overflow", "too-many-nodes"],
            ),
            (
                "an array",
                format!("{array} numElements3 1000 Cube {{ }} }}"),
                &["too-many-items"],
            ),
            (
                "arrays in arrays of nothing",
                array.repeat(8) + "Group { }" + &"}".repeat(8),
                &["too-many-nodes"],
            ),
            (
                "copies of copies",
                copies.repeat(10) + "Cube { }" + &"}".repeat(10),
                &["too-many-items"],
            ),
            (
                "an array of text",
                format!("{array} Text3 {{ string \"{wide}\" }} }}"),
                &["too-many-items"],
            ),
            (
                "a long text",
                format!(
                    "{fine} Text3 {{ parts ALL string \"{}\" }}",
                    wide.repeat(3000)
                ),
                &["long-text", "too-much-geometry"],
            ),
            (
                "many texts",
                fine.to_owned()
                    + &format!("Text3 {{ parts ALL string \"{}\" }}", wide.repeat(10)).repeat(100),
                &["too-much-geometry"],
            ),
            (
                "a net of any size",
                net.replace("ControlPoints 2", "ControlPoints 2000000000"),
                &["bad-nurbs"],
            ),
            (
                "nets",
                doubled("Group", &format!("{fine} {net}")),
                &["transform-overflow", "too-many-nodes"],
            ),
            (
                "a grid of any size",
                vrml("Shape { geometry ElevationGrid { xDimension 60000 zDimension 60000 } }"),
                &["bad-shape"],
            ),
            (
                "a long extrusion",
                vrml(&format!(
                    "Shape {{ geometry Extrusion {{ crossSection [ {} ] spine [ {} ] }} }}",
                    "0 0, 1 1, ".repeat(5000),
                    "0 0 0, 1 1 1, ".repeat(5000)
                )),
                &["bad-shape"],
            ),
            ("prototypes", protos + "P39 { }", &["too-many-copies"]),
            ("kits", kits + "} USE k39 }", &["too-many-items"]),
            ("boxes", boxes, &["connection", "too-many-items"]),
        ];
        let mut wrong = Vec::new();
        for (name, body, codes) in rows {
            let text = match body.starts_with('#') {
                true => body,
                false => format!("#Inventor V2.1 ascii\n{body}"),
            };
            let start = Instant::now();
            let graph = load(text.as_bytes(), "t.iv", Path::new(""), &FileLoader::new([]));
            let resolved = resolve(&graph, &ResolveOptions::default());
            let time = start.elapsed();
            let said = graph.diagnostics.iter().chain(&resolved.diagnostics);
            let said = said.filter(|d| d.severity > Severity::Note);
            let mut said: Vec<&str> = said.map(|d| d.code).collect();
            said.dedup();
            let size = size(&resolved.scene) >> 20;
            if said != codes || size > 400 || time > Duration::from_secs(4) {
                wrong.push(format!("{name}: {said:?}, {size} MiB, {time:?}"));
            }
        }
        assert_eq!(wrong, [] as [String; 0]);
    }
}
