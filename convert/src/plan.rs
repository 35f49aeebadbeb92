//! A conversion with everything decided and measured, and nothing written yet.

use std::io::{self, Write};

use glam::DVec3;
use rustc_hash::FxHashMap;
use scenegraph::scene::{Instance, MaterialId, MeshId, Scene, Topology};

use crate::bounds::{Bounds, corners_between};
use crate::formats::{Formats, Normals, Positions};
use crate::hierarchy::{Hierarchy, Origin};
use crate::instancing::TOLERANCE_SHARE;
use crate::json::Json;
use crate::layout::{Layout, Needs};
use crate::material::{GltfMaterial, Surroundings, VertexColors};
use crate::mesh::{Attributes, Facts, GltfMesh, MeshUse, can_be_lit, shows_texture};
use crate::prepare::Prepared;
use crate::remarks::Remarks;
use crate::texture::{TextureLoader, Textures};
use crate::{
    Container, Error, Materials, Options, Report, alternatives, binary, camera, extras, light,
};

/// A conversion with everything decided and measured: which materials, meshes, nodes and images
/// there are, and where each number goes.
pub(crate) struct Plan<'s> {
    pub(crate) scene: &'s Scene,
    pub(crate) options: Options,
    textures: Textures<'s>,
    materials: Vec<GltfMaterial>,
    meshes: Vec<GltfMesh>,
    /// By mesh of the scene.
    needs: Vec<Option<Needs>>,
    pub(crate) layout: Layout,
    hierarchy: Hierarchy<'s>,
    /// Bytes of the views before the images.
    copies: Vec<Vec<u8>>,
    bounds: Option<Bounds>,
    pub(crate) report: Report,
}

impl<'s> Plan<'s> {
    /// Decides everything; opens the images that something shows.
    ///
    /// # Errors
    ///
    /// [`Error::BinTooLarge`] if one array does not fit into a `.bin`.
    pub(crate) fn new(
        prepared: &'s Prepared<'_>,
        options: &Options,
        loader: &'s dyn TextureLoader,
    ) -> Result<Self, Error> {
        let scene = &*prepared.scene;
        let mut gathering = Gathering::new(scene, &prepared.formats, options, loader);
        let mut looks = Looks::new(scene);
        let meshes_of_instances: Vec<u32> = scene
            .instances
            .iter()
            .enumerate()
            .map(|(i, instance)| gathering.instance(instance, looks.next(i)))
            .collect();
        let Gathering {
            mut textures,
            materials,
            meshes,
            needs,
            remarks,
            triangles_drawn,
            ..
        } = gathering;

        let max_buffer_bytes = match options.container {
            Container::Glb | Container::Html | Container::GltfEmbedded => u64::MAX,
            Container::GltfBin => options.max_bin_bytes,
        };
        let image_lens = (0..textures.image_count()).map(|i| textures.image_bytes(i).len() as u64);
        let mut hierarchy = Hierarchy::new(scene, &prepared.formats, &needs, &meshes_of_instances);
        if options.instancing {
            let tolerance = options.quantize.map(|q| q.tolerance * TOLERANCE_SHARE);
            hierarchy.gather_copies(&boxes(&meshes, &needs), tolerance);
        }
        let copies = hierarchy.copies.views();
        let copy_lens = copies.iter().map(|view| view.len() as u64);
        let other_lens = copy_lens.chain(image_lens);
        let mut layout = if options.compress {
            let threads = options.threads;
            Layout::compressed(scene, &needs, other_lens, max_buffer_bytes, threads)?
        } else {
            Layout::new(scene, &needs, other_lens, max_buffer_bytes)?
        };
        layout.first_image_view += copies.len();
        let mut report = Report {
            losses: remarks.into_losses(),
            warnings: textures.take_warnings(),
            ..Report::default()
        };
        let counts = &mut report.counts;
        counts.meshes = meshes.len();
        counts.materials = materials.len();
        counts.images = textures.image_count();
        counts.lights = scene.lights.len();
        counts.cameras = scene.cameras.len();
        counts.triangles_drawn = triangles_drawn;
        counts.triangles = (scene.meshes.iter().zip(&needs))
            .filter(|(mesh, needs)| needs.is_some() && mesh.topology == Topology::Triangles)
            .map(|(mesh, _)| mesh.primitive_count() as u64)
            .sum();
        Ok(Self {
            bounds: Bounds::of(scene, &needs),
            hierarchy,
            copies,
            scene,
            options: options.clone(),
            textures,
            materials,
            meshes,
            needs,
            layout,
            report,
        })
    }

    /// What of the scene the glTF objects were made of.
    pub(crate) fn origins(&self) -> Origins {
        Origins {
            nodes: self.hierarchy.origins(),
            materials: self.materials.iter().map(|m| m.source).collect(),
            meshes: self.meshes.iter().map(|m| m.source).collect(),
        }
    }

    pub(crate) fn write_buffer(&self, buffer: usize, out: &mut dyn Write) -> io::Result<()> {
        let (layout, needs) = (&self.layout, &self.needs);
        let (copies, textures) = (&self.copies, &self.textures);
        binary::write_buffer(buffer, layout, self.scene, needs, copies, textures, out)
    }

    /// The glTF text, and the number of its nodes; `uri_of` names the files of the buffers.
    pub(crate) fn json(&self, uri_of: impl Fn(usize) -> Option<String>) -> (Vec<u8>, usize) {
        let with_extras = self.options.extras;
        let source = self.options.source.as_deref();
        // About what a node and an accessor take, so that the text need not move often.
        let guess = 1024 + 160 * self.scene.instances.len() + 170 * self.layout.accessors.len();
        let mut json = Json::with_capacity(guess);
        let mut nodes = 0;
        json.object(|json| {
            json.key("asset").object(|json| {
                json.key("version").str("2.0");
                json.key("generator")
                    .str(concat!("Ivory ivconvert ", env!("CARGO_PKG_VERSION")));
                if with_extras {
                    let source = source.filter(|_| self.hierarchy.is_empty());
                    extras::asset(json, &self.options, source);
                }
            });
            json.array_unless_empty("extensionsUsed", self.extensions(), Json::str);
            json.array_unless_empty("extensionsRequired", self.required(), Json::str);
            json.object_unless_empty("extensions", |json| self.write_extensions(json));
            let first_copy = self.layout.accessors.len();
            nodes = self
                .hierarchy
                .write(json, self.scene, first_copy, with_extras, source);
            json.array_unless_empty("cameras", &self.scene.cameras, |json, camera| {
                camera::write(json, camera, self.bounds.as_ref(), with_extras);
            });
            json.array_unless_empty("materials", &self.materials, |json, material| {
                let source = &self.scene.materials[material.source.index()];
                material.write(json, source, with_extras);
            });
            json.array_unless_empty("meshes", &self.meshes, |json, mesh| {
                let source = mesh.source.index();
                let topology = self.scene.meshes[source].topology;
                mesh.write(json, topology, &self.layout.meshes[source]);
            });
            let first_image_view = self.layout.first_image_view;
            self.textures
                .write(json, with_extras, |image| (first_image_view + image) as u32);
            let copies = &self.hierarchy.copies;
            self.layout
                .write(json, self.scene, &self.needs, copies, uri_of);
        });
        (json.into_bytes(), nodes)
    }

    fn write_extensions(&self, json: &mut Json) {
        if !self.scene.variants.is_empty() {
            alternatives::write_variants(json, self.scene);
        }
        if self.scene.lights.is_empty() {
            return;
        }
        json.key("KHR_lights_punctual").object(|json| {
            let in_sets = extras::has_light_sets(self.scene);
            let lights = self.scene.lights.iter().enumerate();
            json.array_unless_empty("lights", lights, |json, (number, light)| {
                let environment = &self.scene.environments[light.environment.index()];
                let bounds = self.bounds.as_ref();
                let (unit, extras) = (self.options.lights, self.options.extras);
                let number = in_sets.then_some(number);
                let extras = extras.then_some(number);
                light::write(json, light, environment, bounds, unit, extras);
            });
        });
    }

    /// Whether some number has a form that only `KHR_mesh_quantization` allows.
    fn is_quantized(&self) -> bool {
        self.needs.iter().flatten().any(|needs| {
            let Formats {
                positions, normals, ..
            } = needs.formats;
            let short_normals = needs.attributes.normals && normals != Normals::F32;
            positions != Positions::F32 || short_normals
        })
    }

    fn is_compressed(&self) -> bool {
        !self.layout.stored.is_empty()
    }

    /// The extensions without which the file cannot be shown.
    fn required(&self) -> impl Iterator<Item = &'static str> {
        let required = [
            ("EXT_mesh_gpu_instancing", !self.hierarchy.copies.is_empty()),
            ("EXT_meshopt_compression", self.is_compressed()),
            ("EXT_texture_webp", self.textures.has_webp()),
            ("KHR_mesh_quantization", self.is_quantized()),
        ];
        required
            .into_iter()
            .filter(|(_, required)| *required)
            .map(|(name, _)| name)
    }

    fn extensions(&self) -> impl Iterator<Item = &'static str> {
        let any = |test: fn(&GltfMaterial) -> bool| self.materials.iter().any(test);
        let [hides, has_levels] = self.hierarchy.alternatives();
        let used = [
            ("EXT_mesh_gpu_instancing", !self.hierarchy.copies.is_empty()),
            ("EXT_meshopt_compression", self.is_compressed()),
            ("EXT_texture_webp", self.textures.has_webp()),
            ("KHR_lights_punctual", !self.scene.lights.is_empty()),
            (
                "KHR_materials_ior",
                any(|m| !m.unlit && m.specular.is_some()),
            ),
            ("KHR_materials_specular", any(|m| !m.unlit && !m.is_simple)),
            ("KHR_materials_unlit", any(|m| m.unlit)),
            (alternatives::VARIANTS, !self.scene.variants.is_empty()),
            ("KHR_mesh_quantization", self.is_quantized()),
            (alternatives::VISIBILITY, hides),
            (alternatives::LEVELS, has_levels),
        ];
        used.into_iter()
            .filter(|(_, used)| *used)
            .map(|(name, _)| name)
    }
}

/// For each glTF object what of the scene it was made of.
#[derive(Debug)]
pub(crate) struct Origins {
    pub(crate) nodes: Vec<Origin>,
    pub(crate) materials: Vec<MaterialId>,
    pub(crate) meshes: Vec<MeshId>,
}

/// The materials that instances have in variants, asked for in the order of the instances.
struct Looks<'s> {
    rest: Vec<&'s [(u32, MaterialId)]>,
}

impl<'s> Looks<'s> {
    fn new(scene: &'s Scene) -> Self {
        let rest = scene.variants.iter().map(|v| v.materials.as_slice());
        Self {
            rest: rest.collect(),
        }
    }

    /// By variant, those that have one of their own.
    fn next(&mut self, instance: usize) -> Vec<(u32, MaterialId)> {
        let mut found = Vec::new();
        for (variant, rest) in self.rest.iter_mut().enumerate() {
            if let [(at, material), behind @ ..] = *rest
                && *at as usize == instance
            {
                found.push((variant as u32, *material));
                *rest = behind;
            }
        }
        found
    }
}

/// The corners of the boxes of meshes, in the numbers that are stored.
fn boxes(meshes: &[GltfMesh], needs: &[Option<Needs>]) -> Vec<[DVec3; 8]> {
    let corners = |mesh: &GltfMesh| {
        let Some(needs) = &needs[mesh.source.index()] else {
            return [DVec3::ZERO; 8];
        };
        let step = f64::from(needs.formats.positions.step().unwrap_or(1.0));
        let [min, max] =
            [needs.facts.min, needs.facts.max].map(|p| DVec3::from(p.map(f64::from)) / step);
        corners_between(min, max)
    };
    meshes.iter().map(corners).collect()
}

/// Meshes and materials being gathered from the instances, in their order.
struct Gathering<'s> {
    scene: &'s Scene,
    formats: &'s [Formats],
    look: Materials,
    textures: Textures<'s>,
    materials: Vec<GltfMaterial>,
    material_of: FxHashMap<(MaterialId, Surroundings), u32>,
    meshes: Vec<GltfMesh>,
    mesh_of: FxHashMap<MeshUse, u32>,
    needs: Vec<Option<Needs>>,
    remarks: Remarks<'s>,
    triangles_drawn: u64,
}

impl<'s> Gathering<'s> {
    fn new(
        scene: &'s Scene,
        formats: &'s [Formats],
        options: &Options,
        loader: &'s dyn TextureLoader,
    ) -> Self {
        Self {
            scene,
            formats,
            look: options.materials,
            textures: Textures::new(scene, loader, options.textures),
            materials: Vec::new(),
            material_of: FxHashMap::default(),
            meshes: Vec::new(),
            mesh_of: FxHashMap::default(),
            needs: vec![None; scene.meshes.len()],
            remarks: Remarks::new(scene),
            triangles_drawn: 0,
        }
    }

    /// The glTF mesh of an instance.
    fn instance(&mut self, instance: &Instance, in_variants: Vec<(u32, MaterialId)>) -> u32 {
        let source = &self.scene.meshes[instance.mesh.index()];
        if source.topology == Topology::Triangles {
            self.triangles_drawn += source.primitive_count() as u64;
        }
        let needs = self.needs[instance.mesh.index()].get_or_insert_with(|| Needs {
            facts: Facts::of(source),
            formats: self.formats[instance.mesh.index()],
            attributes: Attributes::default(),
        });
        let colors = needs.facts.colors;
        let key = (instance.mesh, instance.material, in_variants);
        let mesh = match self.mesh_of.get(&key) {
            Some(&known) => known,
            None => self.add_mesh(key),
        };
        let material = self.meshes[mesh as usize].material;
        self.remarks
            .instance(instance, &self.materials[material as usize], colors);
        mesh
    }

    fn add_mesh(&mut self, key: MeshUse) -> u32 {
        let (source, own, others) = &key;
        let material = self.material(*source, *own);
        let mut in_variants = Vec::new();
        if !others.is_empty() {
            in_variants.resize(self.scene.variants.len(), material);
            for &(variant, other) in others {
                in_variants[variant as usize] = self.material(*source, other);
            }
        }
        let mesh = &self.scene.meshes[source.index()];
        let all = in_variants.iter().chain([&material]);
        let read = all.map(|&m| Attributes::read_by(&self.materials[m as usize], mesh));
        let attributes = read.fold(Attributes::default(), Attributes::union);
        if let Some(needs) = &mut self.needs[source.index()] {
            needs.attributes = needs.attributes.union(attributes);
        }
        let index = self.meshes.len() as u32;
        self.meshes.push(GltfMesh {
            source: *source,
            material,
            attributes,
            in_variants,
        });
        self.mesh_of.insert(key, index);
        index
    }

    fn material(&mut self, mesh: MeshId, material: MaterialId) -> u32 {
        let source = &self.scene.materials[material.index()];
        let surroundings = self.surroundings(mesh, material);
        if let Some(&known) = self.material_of.get(&(material, surroundings)) {
            return known;
        }
        let texture = source.texture.filter(|_| surroundings.texcoords);
        let diffuse_srgb = match surroundings.colors {
            VertexColors::None => source.diffuse_srgb,
            // The vertices' colours multiply what is mixed.
            _ => [1.0; 3],
        };
        let texture = texture.and_then(|id| self.textures.show(id, diffuse_srgb));
        let index = self.materials.len() as u32;
        self.materials.push(GltfMaterial::new(
            material,
            source,
            surroundings,
            texture,
            self.look,
        ));
        self.material_of.insert((material, surroundings), index);
        index
    }

    fn surroundings(&self, mesh: MeshId, material: MaterialId) -> Surroundings {
        let source = &self.scene.meshes[mesh.index()];
        let facts = self.needs[mesh.index()]
            .as_ref()
            .map(|needs| needs.facts.colors);
        Surroundings {
            colors: facts.unwrap_or(VertexColors::None),
            texcoords: shows_texture(source, &self.scene.materials[material.index()]),
            can_be_lit: can_be_lit(source),
        }
    }
}
