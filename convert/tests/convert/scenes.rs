//! Small scenes, and images from memory.

use std::collections::BTreeMap;
use std::io::Cursor;
use std::path::Path;
use std::sync::Mutex;

use convert::TextureLoader;
use glam::{DAffine3, DQuat, DVec3};
use iv_parser::SourcePos;
use scenegraph::scene::{
    Camera, Environment, EnvironmentId, Faces, Instance, Light, LightId, LightKind, LightModel,
    LightSetId, Material, MaterialId, Mesh, MeshId, Node, NodeId, Placement, Projection, Scene,
    Texture, TextureId, TextureModel, TextureSource, Topology, ViewportMapping, Wrap,
};

pub fn at_line(line: u32) -> SourcePos {
    SourcePos {
        file: 0,
        line,
        column: u32::from(line > 0),
    }
}

/// One triangle in the plane z = 0, with normals.
pub fn triangle() -> Mesh {
    Mesh {
        topology: Topology::Triangles,
        origin: DVec3::ZERO,
        positions: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        normals: vec![[0.0, 0.0, 1.0]; 3],
        texcoords: Vec::new(),
        colors_srgb: Vec::new(),
        indices: vec![0, 1, 2],
        pos: at_line(1),
    }
}

pub fn textured_triangle() -> Mesh {
    Mesh {
        texcoords: vec![[0.0, 0.0], [1.0, 0.25], [-0.5, 1.0]],
        ..triangle()
    }
}

pub fn lines() -> Mesh {
    Mesh {
        topology: Topology::Lines,
        normals: Vec::new(),
        indices: vec![0, 1, 1, 2],
        ..triangle()
    }
}

pub fn points() -> Mesh {
    Mesh {
        topology: Topology::Points,
        normals: Vec::new(),
        ..triangle()
    }
}

/// Inventor's default.
pub fn material() -> Material {
    Material {
        name: None,
        ambient_srgb: [0.2; 3],
        diffuse_srgb: [0.8; 3],
        specular_srgb: [0.0; 3],
        emissive_srgb: [0.0; 3],
        shininess: 0.2,
        transparency: 0.0,
        light_model: LightModel::Phong,
        faces: Faces::BothTwoSidedLighting,
        texture: None,
        line_width_px: 0.0,
        point_size_px: 0.0,
        line_pattern: 0xffff,
        style_pos: at_line(0),
        pos: at_line(0),
    }
}

pub fn file_texture(name: &str) -> Texture {
    Texture {
        name: None,
        source: TextureSource::File {
            name: name.into(),
            beside: "folder".into(),
        },
        wrap_s: Wrap::Repeat,
        wrap_t: Wrap::Repeat,
        model: TextureModel::Modulate,
        blend_color_srgb: [0.0; 3],
        pos: at_line(40),
    }
}

pub fn shift(x: f64, y: f64, z: f64) -> DAffine3 {
    DAffine3::from_translation(DVec3::new(x, y, z))
}

pub fn scale(x: f64, y: f64, z: f64) -> DAffine3 {
    DAffine3::from_scale(DVec3::new(x, y, z))
}

pub fn turn(axis: DVec3, angle_rad: f64) -> DAffine3 {
    DAffine3::from_quat(DQuat::from_axis_angle(axis.normalize(), angle_rad))
}

/// A scene being put together; the first mesh and material are there from the start.
pub struct Build {
    pub scene: Scene,
}

impl Build {
    pub fn new() -> Self {
        let scene = Scene {
            light_sets: vec![Vec::new()],
            environments: vec![Environment::default()],
            ..Scene::default()
        };
        Self { scene }
    }

    /// One instance of a mesh in a material, at the root.
    pub fn one(mesh: Mesh, material: Material) -> Self {
        let mut build = Self::new();
        build.instance(None, None, DAffine3::IDENTITY, mesh, material);
        build
    }

    /// One textured triangle.
    pub fn textured(texture: Texture, material: Material) -> Self {
        let mut build = Self::one(
            textured_triangle(),
            Material {
                texture: Some(TextureId(0)),
                ..material
            },
        );
        build.scene.textures.push(texture);
        build
    }

    pub fn group(&mut self, parent: Option<u32>, name: Option<&str>, local: DAffine3) -> u32 {
        self.scene.nodes.push(Node {
            parent: parent.map(NodeId),
            name: name.map(Into::into),
            class: "Separator".into(),
            notes: Vec::new(),
            link: None,
            parent_from_local: local,
            shown: scenegraph::scene::Shown::Always,
            pos: at_line(2),
        });
        self.scene.nodes.len() as u32 - 1
    }

    pub fn placement(&self, group: Option<u32>, name: Option<&str>, local: DAffine3) -> Placement {
        let mut world_from_local = local;
        let mut node = group.map(NodeId);
        while let Some(id) = node {
            let group = &self.scene.nodes[id.index()];
            world_from_local = group.parent_from_local * world_from_local;
            node = group.parent;
        }
        Placement {
            node: group.map(NodeId),
            parent_from_local: local,
            world_from_local,
            name: name.map(Into::into),
            pos: at_line(10 + self.scene.instances.len() as u32),
        }
    }

    pub fn instance(
        &mut self,
        group: Option<u32>,
        name: Option<&str>,
        local: DAffine3,
        mesh: Mesh,
        material: Material,
    ) {
        let mesh = index_of(&mut self.scene.meshes, mesh);
        let material = index_of(&mut self.scene.materials, material);
        let placement = self.placement(group, name, local);
        self.scene.instances.push(Instance {
            placement,
            mesh: MeshId(mesh),
            material: MaterialId(material),
            light_set: LightSetId(0),
            environment: EnvironmentId(0),
        });
    }

    /// The default triangle.
    pub fn shape(&mut self, group: Option<u32>, name: Option<&str>, local: DAffine3) {
        self.instance(group, name, local, triangle(), material());
    }

    pub fn light(&mut self, group: Option<u32>, local: DAffine3, kind: LightKind) {
        let placement = self.placement(group, None, local);
        let id = LightId(self.scene.lights.len() as u32);
        self.scene.light_sets[0].push(id);
        self.scene.lights.push(Light {
            placement,
            kind,
            color_srgb: [1.0; 3],
            intensity: 1.0,
            beam: None,
            radius_in_world: None,
            environment: EnvironmentId(0),
        });
    }

    pub fn camera(&mut self, group: Option<u32>, local: DAffine3, projection: Projection) {
        let placement = self.placement(group, None, local);
        self.scene.cameras.push(Camera {
            placement,
            position: DVec3::new(0.0, 0.0, 5.0),
            orientation: DQuat::IDENTITY,
            aspect_ratio: 1.5,
            near_distance: 1.0,
            far_distance: 10.0,
            focal_distance: 5.0,
            projection,
            viewport_mapping: ViewportMapping::AdjustCamera,
        });
    }
}

fn index_of<T: PartialEq>(items: &mut Vec<T>, item: T) -> u32 {
    let known = items.iter().position(|other| *other == item);
    known.unwrap_or_else(|| {
        items.push(item);
        items.len() - 1
    }) as u32
}

/// Images from memory, which remembers what it was asked for.
#[derive(Default)]
pub struct Images {
    files: BTreeMap<String, Vec<u8>>,
    pub asked: Mutex<Vec<String>>,
}

impl Images {
    pub fn with(files: &[(&str, Vec<u8>)]) -> Self {
        let files = files
            .iter()
            .map(|(name, bytes)| ((*name).to_owned(), bytes.clone()));
        Self {
            files: files.collect(),
            asked: Mutex::default(),
        }
    }
}

impl TextureLoader for Images {
    fn load(&self, beside: &Path, name: &str) -> Result<Vec<u8>, String> {
        self.asked
            .lock()
            .unwrap()
            .push(format!("{}/{name}", beside.display()));
        self.files
            .get(name)
            .cloned()
            .ok_or_else(|| "not found".to_owned())
    }
}

/// A PNG with one row of RGBA pixels.
pub fn png(pixels: &[[u8; 4]]) -> Vec<u8> {
    let raw = pixels.concat();
    let image = image::RgbaImage::from_raw(pixels.len() as u32, 1, raw).unwrap();
    let mut out = Cursor::new(Vec::new());
    image.write_to(&mut out, image::ImageFormat::Png).unwrap();
    out.into_inner()
}
