//! Finds the losses of a scene.

use iv_parser::SourcePos;
use scenegraph::scene::{
    Faces, Instance, Light, LightId, LightKind, Material, Scene, TextureModel, Topology,
    ViewportMapping,
};

use crate::frame::uniform_scale;
use crate::loss::{LossKind, Losses};
use crate::material::{GltfMaterial, VertexColors};

/// Ambient light of Inventor's default environment on its default material. No more than this is
/// missing in most models, and a viewer's own ambient light makes up for it.
const UNNOTICED_AMBIENT: f64 = 0.2 * 0.2;
/// Of the ramp between glTF's two cones.
const GLTF_EXPONENT: f64 = 2.0;
/// Room for values that went through f32.
const AMBIENT_TOLERANCE: f64 = 1e-6;

/// Losses of one scene, found item by item.
pub(crate) struct Remarks<'s> {
    scene: &'s Scene,
    losses: Losses,
    /// For each light set, the first light that is not in it.
    not_reached_by: Vec<Option<LightId>>,
}

impl<'s> Remarks<'s> {
    pub(crate) fn new(scene: &'s Scene) -> Self {
        let sets = scene.light_sets.iter();
        let not_reached_by = sets.map(|set| first_missing(set, scene.lights.len()));
        Self {
            scene,
            losses: Losses::default(),
            not_reached_by: not_reached_by.collect(),
        }
    }

    pub(crate) fn into_losses(mut self) -> Vec<crate::Loss> {
        self.texts();
        self.lights();
        self.cameras();
        self.losses.into_sorted()
    }

    pub(crate) fn instance(
        &mut self,
        instance: &Instance,
        written: &GltfMaterial,
        colors: VertexColors,
    ) {
        let pos = instance.placement.pos;
        let material = &self.scene.materials[instance.material.index()];
        let environment = &self.scene.environments[instance.environment.index()];
        if let Some(fog) = &environment.fog {
            let fog_type = || format!("{:?}", fog.fog_type);
            self.losses
                .add(LossKind::Fog, known(environment.pos, pos), fog_type);
        }
        if !written.unlit {
            self.lit_instance(instance, material);
        }
        self.texture(material, written, colors);
        self.drawing_style(instance, material);
    }

    fn lit_instance(&mut self, instance: &Instance, material: &Material) {
        let pos = instance.placement.pos;
        if let Some(light) = self.not_reached_by[instance.light_set.index()] {
            let light = &self.scene.lights[light.index()];
            self.losses
                .add(LossKind::LightScope, light.placement.pos, || name_of(light));
        }
        let environment = &self.scene.environments[instance.environment.index()];
        let strongest = |of: &dyn Fn(usize) -> f64| {
            environment.ambient_intensity
                * (0..3)
                    .map(|channel| environment.ambient_color_srgb[channel] * of(channel))
                    .fold(0.0, f64::max)
        };
        let ambient = strongest(&|channel| material.ambient_srgb[channel]);
        if ambient > UNNOTICED_AMBIENT + AMBIENT_TOLERANCE {
            // The Environment is the cause if it is brighter than Inventor's default.
            let cause = if strongest(&|_| 1.0) > 0.2 + AMBIENT_TOLERANCE {
                environment.pos
            } else {
                material.pos
            };
            self.losses
                .add(LossKind::AmbientLight, known(cause, pos), || {
                    format!("{ambient:.2}")
                });
        }
        let topology = self.scene.meshes[instance.mesh.index()].topology;
        if topology == Topology::Triangles && material.faces == Faces::BothOneSidedLighting {
            self.losses
                .add(LossKind::OneSidedLighting, pos, String::new);
        }
    }

    fn texture(&mut self, material: &Material, written: &GltfMaterial, colors: VertexColors) {
        let (Some(id), Some(_)) = (material.texture, written.texture) else {
            return;
        };
        let texture = &self.scene.textures[id.index()];
        let approximated = match texture.model {
            TextureModel::Modulate => false,
            TextureModel::Blend => true,
            // Over the colour, but not lit apart from it.
            TextureModel::Decal if !written.unlit => true,
            // A texture without alpha leaves the vertices' alpha as it is.
            TextureModel::Decal | TextureModel::Replace => {
                colors == VertexColors::Translucent && !written.reads_colors
            }
        };
        if approximated {
            let model = || format!("{:?}", texture.model).to_uppercase();
            self.losses.add(LossKind::TextureModel, texture.pos, model);
        }
    }

    fn drawing_style(&mut self, instance: &Instance, material: &Material) {
        let pos = known(material.style_pos, instance.placement.pos);
        // Inventor's default of 0 is one pixel, too.
        let unusual = |size_px: f64| size_px != 0.0 && size_px != 1.0;
        let topology = self.scene.meshes[instance.mesh.index()].topology;
        let (width, size) = (material.line_width_px, material.point_size_px);
        if topology == Topology::Lines && unusual(width) {
            self.losses
                .add(LossKind::LineWidth, pos, || format!("{width} pixels"));
        }
        if topology == Topology::Lines && material.line_pattern != 0xffff {
            let pattern = || format!("{:#06x}", material.line_pattern);
            self.losses.add(LossKind::LinePattern, pos, pattern);
        }
        if topology == Topology::Points && unusual(size) {
            self.losses
                .add(LossKind::PointSize, pos, || format!("{size} pixels"));
        }
    }

    fn lights(&mut self) {
        for light in &self.scene.lights {
            let pos = light.placement.pos;
            if let LightKind::Directional { .. } = light.kind {
                continue;
            }
            let [a, b, c] = self.scene.environments[light.environment.index()].attenuation;
            self.losses
                .add(LossKind::LightAttenuation, pos, || format!("{a} {b} {c}"));
            let LightKind::Spot { drop_off_rate, .. } = light.kind else {
                continue;
            };
            match light.beam {
                // glTF's cones have this very ramp.
                Some(beam) if beam.exponent == GLTF_EXPONENT => {}
                Some(beam) => self.losses.add(LossKind::SpotDropOff, pos, || {
                    format!("concentrationExponent {}", beam.exponent)
                }),
                None if drop_off_rate == 0.0 => {}
                None => self
                    .losses
                    .add(LossKind::SpotDropOff, pos, || drop_off_rate.to_string()),
            }
        }
    }

    fn texts(&mut self) {
        for text in self.scene.texts.iter().filter(|text| text.faces_viewer) {
            let instance = self.scene.instances.get(text.instance as usize);
            let pos = instance.map_or_else(SourcePos::default, |i| i.placement.pos);
            let first = || {
                text.strings
                    .first()
                    .map_or_else(String::new, |s| s.to_string())
            };
            self.losses.add(LossKind::ScreenText, pos, first);
        }
    }

    fn cameras(&mut self) {
        for camera in &self.scene.cameras {
            let pos = camera.placement.pos;
            let mapping = match camera.viewport_mapping {
                ViewportMapping::AdjustCamera => None,
                ViewportMapping::CropViewport => Some("CROP_VIEWPORT"),
                ViewportMapping::LeaveAlone => Some("LEAVE_ALONE"),
            };
            if let Some(mapping) = mapping {
                self.losses
                    .add(LossKind::ViewportMapping, pos, || mapping.to_owned());
            }
            if uniform_scale(&camera.placement.world_from_local.matrix3).is_none() {
                self.losses.add(LossKind::CameraFrame, pos, String::new);
            }
        }
    }
}

/// The place of a cause; that of the shape where values come from nowhere in the source.
fn known(cause: SourcePos, shape: SourcePos) -> SourcePos {
    if cause.is_known() { cause } else { shape }
}

/// The light as the source calls it, or its class.
fn name_of(light: &Light) -> String {
    match (&light.placement.name, &light.kind) {
        (Some(name), _) => name.to_string(),
        (None, LightKind::Directional { .. }) => "DirectionalLight".to_owned(),
        (None, LightKind::Point { .. }) => "PointLight".to_owned(),
        (None, LightKind::Spot { .. }) => "SpotLight".to_owned(),
    }
}

/// The first of `count` lights that is not in the set.
fn first_missing(set: &[LightId], count: usize) -> Option<LightId> {
    let mut distinct = set.to_vec();
    distinct.sort_unstable();
    distinct.dedup();
    let in_row = distinct.iter().enumerate();
    let first = in_row.take_while(|(i, id)| id.index() == *i).count();
    (first < count).then_some(LightId(first as u32))
}
