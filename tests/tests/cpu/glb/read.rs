//! A GLB as a consumer reads it: arrays by the `gltf` crate, which validates as it goes, and node
//! transforms by `serde_json`, whose numbers are f64.

use glam::{DAffine3, DQuat, DVec3};
use gltf::Gltf;
use gltf::mesh::Mode;
use scenegraph::scene::Topology;
use serde_json::Value;

/// A GLB, read.
pub struct Glb {
    /// Its text.
    pub json: Value,
    /// By glTF mesh.
    pub meshes: Vec<Arrays>,
    /// All nodes, parents before children.
    pub nodes: Vec<Placed>,
}

/// The one primitive of a mesh.
pub struct Arrays {
    pub topology: Topology,
    pub positions: Vec<[f32; 3]>,
    pub normals: Vec<[f32; 3]>,
    pub texcoords: Vec<[f32; 2]>,
    pub colors_linear: Vec<[f32; 4]>,
    /// Counted up where the file has none.
    pub indices: Vec<u32>,
    /// The accessor of the positions.
    pub accessor: usize,
    pub material: usize,
}

/// A node in the world.
pub struct Placed {
    /// Names of its ancestors that have one, and its own.
    pub path: Vec<String>,
    pub name: Option<String>,
    pub world_from_local: DAffine3,
    pub mesh: Option<usize>,
    pub light: Option<usize>,
    pub camera: Option<usize>,
}

impl Glb {
    /// Reads all of it.
    pub fn read(bytes: &[u8]) -> Self {
        let json: Value = serde_json::from_slice(json_chunk(bytes)).expect("the text of a GLB");
        let gltf = Gltf::from_slice(bytes).expect("a GLB that the gltf crate reads");
        let bin = gltf.blob.as_deref().unwrap_or_default();
        let meshes = gltf.document.meshes().map(|mesh| arrays(&mesh, bin));
        Self {
            meshes: meshes.collect(),
            nodes: placed(&json),
            json,
        }
    }

    /// The nodes that show something, with what they show.
    pub fn shown(&self) -> impl Iterator<Item = (&Placed, &Arrays)> {
        let mesh_of = |node: &Placed| node.mesh.map(|mesh| &self.meshes[mesh]);
        self.nodes
            .iter()
            .filter_map(move |node| Some((node, mesh_of(node)?)))
    }
}

impl Placed {
    /// A position of its mesh, in the world.
    pub fn p_in_world(&self, p_in_local: [f32; 3]) -> DVec3 {
        let p_in_local = DVec3::from(p_in_local.map(f64::from));
        self.world_from_local.transform_point3(p_in_local)
    }
}

fn json_chunk(bytes: &[u8]) -> &[u8] {
    let word = |at: usize| {
        let word = bytes[at..at + 4].try_into().expect("four bytes");
        u32::from_le_bytes(word) as usize
    };
    assert_eq!(
        (&bytes[..4], word(4), word(8)),
        (&b"glTF"[..], 2, bytes.len())
    );
    assert_eq!(&bytes[16..20], b"JSON");
    &bytes[20..20 + word(12)]
}

fn arrays(mesh: &gltf::Mesh, bin: &[u8]) -> Arrays {
    assert_eq!(mesh.primitives().len(), 1);
    let primitive = mesh.primitives().next().expect("a primitive");
    let reader = primitive.reader(|_| Some(bin));
    let positions: Vec<_> = reader.read_positions().expect("positions").collect();
    let counted = 0..positions.len() as u32;
    let accessor = primitive.get(&gltf::Semantic::Positions);
    Arrays {
        topology: match primitive.mode() {
            Mode::Triangles => Topology::Triangles,
            Mode::Lines => Topology::Lines,
            Mode::Points => Topology::Points,
            other => panic!("mode {other:?}"),
        },
        normals: reader.read_normals().into_iter().flatten().collect(),
        texcoords: (reader.read_tex_coords(0).into_iter())
            .flat_map(|t| t.into_f32())
            .collect(),
        colors_linear: (reader.read_colors(0).into_iter())
            .flat_map(|c| c.into_rgba_f32())
            .collect(),
        indices: (reader.read_indices()).map_or(counted.collect(), |i| i.into_u32().collect()),
        accessor: accessor.expect("positions").index(),
        material: primitive.material().index().expect("a material"),
        positions,
    }
}

/// All nodes that the scene reaches; each must be reached once.
fn placed(json: &Value) -> Vec<Placed> {
    let nodes = json["nodes"].as_array().map_or(&[][..], |nodes| nodes);
    let roots = indices(&json["scenes"][0]["nodes"]);
    let mut open: Vec<_> = roots
        .into_iter()
        .map(|node| (node, DAffine3::IDENTITY, Vec::new()))
        .collect();
    let mut reached = vec![false; nodes.len()];
    let mut placed = Vec::new();
    while let Some((index, world_from_parent, mut path)) = open.pop() {
        assert!(!reached[index], "node {index} is reached twice");
        reached[index] = true;
        let node = &nodes[index];
        let name = node["name"].as_str().map(str::to_owned);
        path.extend(name.clone());
        let world_from_local = world_from_parent * parent_from_local(node);
        for child in indices(&node["children"]) {
            open.push((child, world_from_local, path.clone()));
        }
        let index_at = |pointer| Some(node.pointer(pointer)?.as_u64()? as usize);
        placed.push(Placed {
            path,
            name,
            world_from_local,
            mesh: index_at("/mesh"),
            light: index_at("/extensions/KHR_lights_punctual/light"),
            camera: index_at("/camera"),
        });
    }
    assert!(reached.iter().all(|&reached| reached));
    placed
}

fn indices(list: &Value) -> Vec<usize> {
    let list = list.as_array().into_iter().flatten();
    list.map(|i| i.as_u64().expect("an index") as usize)
        .collect()
}

fn parent_from_local(node: &Value) -> DAffine3 {
    assert!(node["matrix"].is_null());
    let vec3 = |key: &str, default: DVec3| match numbers(&node[key])[..] {
        [x, y, z] => DVec3::new(x, y, z),
        _ => default,
    };
    let rotation = match numbers(&node["rotation"])[..] {
        [x, y, z, w] => DQuat::from_xyzw(x, y, z, w),
        _ => DQuat::IDENTITY,
    };
    DAffine3::from_scale_rotation_translation(
        vec3("scale", DVec3::ONE),
        rotation,
        vec3("translation", DVec3::ZERO),
    )
}

/// The numbers of a list; empty when there is none.
pub fn numbers(list: &Value) -> Vec<f64> {
    let list = list.as_array().into_iter().flatten();
    list.map(|x| x.as_f64().expect("a number")).collect()
}
