//! Shadow volumes of lights on the device, kept while neither the light nor a caster moves. How
//! they are made is in `volume_maker`.

use std::ops::Range;

use glam::{DAffine3, DVec3, DVec4};
use rustc_hash::FxHashMap;

use super::binding::Layouts;
use super::casters::Casters;
use super::device::Gpu;
use super::volume_maker::make;
use crate::content::{Content, LightShape, WorldLight};
use crate::frame::{VolumeDraw, VolumeMethod};
use crate::volume::{CasterMesh, count_at_infinity};

/// Entries of one object, or of a part of it, in the buffer of a light.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Parts {
    pub object: u32,
    pub sides: Range<u32>,
    pub cap_pos: Range<u32>,
    pub cap_neg: Range<u32>,
}

/// What the start value of z-pass is counted from, for a parallel projection.
pub(super) struct Signs {
    pub object: u32,
    /// Of a part of a caster.
    pub part: Option<CasterMesh>,
    pub signs: Vec<i8>,
}

/// The volumes of one light.
pub struct LightVolumes {
    pub(super) shape: LightShape,
    pub(super) method: VolumeMethod,
    /// Sets of volumes that may share eight bits of stencil, each ascending by object.
    pub(super) layers: Vec<Vec<Parts>>,
    /// For each of them.
    pub(super) signs: Vec<Vec<Signs>>,
    /// Group 2.
    pub group: wgpu::BindGroup,
    /// Where they may end, in the world.
    pub far_plane: Option<DVec4>,
    /// On the device.
    pub(super) bytes: u64,
}

/// The draws of a volume pass: ranges of entries.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct VolumeRanges {
    /// Sides counted in front of the scene.
    pub z_pass_sides: Vec<Range<u32>>,
    /// Caps counted in front of it, of triangles that face the light.
    pub z_pass_cap_pos: Vec<Range<u32>>,
    /// Of triangles that face away.
    pub z_pass_cap_neg: Vec<Range<u32>>,
    /// Sides counted behind it.
    pub z_fail_sides: Vec<Range<u32>>,
    /// Caps of triangles that face the light.
    pub cap_pos: Vec<Range<u32>>,
    /// Caps of triangles that face away.
    pub cap_neg: Vec<Range<u32>>,
}

/// The volumes of all lights, with what it took to make them.
#[derive(Default)]
pub struct VolumeCache {
    lights: FxHashMap<u32, LightVolumes>,
    /// Lights whose volumes were made anew.
    pub made: u32,
    /// Lights whose volumes were kept.
    pub kept: u32,
}

impl VolumeCache {
    /// Makes the volumes of a light if they are not those kept.
    pub fn prepare(
        &mut self,
        gpu: &Gpu,
        layouts: &Layouts,
        content: &Content,
        casters: &Casters,
        (index, light): (u32, &WorldLight),
        method: VolumeMethod,
    ) {
        let is_kept = self
            .lights
            .get(&index)
            .is_some_and(|kept| kept.shape == light.shape && kept.method == method);
        if is_kept {
            self.kept += 1;
            return;
        }
        let made = make(gpu, layouts, content, casters, light, method);
        self.lights.insert(index, made);
        self.made += 1;
    }

    /// Bytes on the device.
    pub fn bytes(&self) -> u64 {
        self.lights.values().map(|volumes| volumes.bytes).sum()
    }

    /// The volumes of a light.
    pub fn of(&self, light: u32) -> Option<&LightVolumes> {
        self.lights.get(&light)
    }
}

impl LightVolumes {
    /// In how many goes the volumes are counted: more than one if more could lie on top of each
    /// other than eight bits count.
    pub fn layer_count(&self) -> usize {
        self.layers.len()
    }

    /// The entries of these volumes in a layer, neighbours joined. `draws` ascend by object.
    pub fn ranges(&self, layer: usize, draws: &[VolumeDraw]) -> VolumeRanges {
        let mut ranges = VolumeRanges::default();
        let mut draws = draws.iter().peekable();
        for parts in &self.layers[layer] {
            while draws.next_if(|draw| draw.object < parts.object).is_some() {}
            match draws.peek() {
                Some(draw) if draw.object == parts.object => ranges.add(parts, draw),
                _ => {}
            }
        }
        ranges
    }

    /// How many of these volumes, of a layer, hold the point at infinity from where a parallel
    /// projection looks.
    pub fn count_at_infinity(
        &self,
        layer: usize,
        content: &Content,
        casters: &Casters,
        draws: &[VolumeDraw],
        towards_viewer: DVec3,
    ) -> u32 {
        let mut count = 0;
        let mut draws = draws.iter().peekable();
        for Signs {
            object,
            part,
            signs,
        } in &self.signs[layer]
        {
            while draws.next_if(|draw| draw.object < *object).is_some() {}
            if draws.peek().is_none_or(|draw| draw.object != *object) {
                continue;
            }
            let object = &content.objects[*object as usize];
            let whole = casters.mesh(object.mesh).map(|(mesh, _)| mesh);
            let Some(mesh) = part.as_ref().or(whole) else {
                continue;
            };
            let viewer_in_mesh = object.world_from_mesh.matrix3.inverse() * towards_viewer;
            let light = light_in_mesh(&self.shape, &object.world_from_mesh);
            count += count_at_infinity(mesh, signs, viewer_in_mesh, light);
        }
        count
    }
}

impl VolumeRanges {
    fn add(&mut self, parts: &Parts, draw: &VolumeDraw) {
        if draw.is_z_pass {
            if draw.has_sides {
                join(&mut self.z_pass_sides, &parts.sides);
            }
            if draw.has_light_caps {
                join(&mut self.z_pass_cap_pos, &parts.cap_pos);
                join(&mut self.z_pass_cap_neg, &parts.cap_neg);
            }
        } else {
            join(&mut self.z_fail_sides, &parts.sides);
            join(&mut self.cap_pos, &parts.cap_pos);
            join(&mut self.cap_neg, &parts.cap_neg);
        }
    }
}

fn join(list: &mut Vec<Range<u32>>, range: &Range<u32>) {
    if range.is_empty() {
        return;
    }
    match list.last_mut() {
        Some(last) if last.end == range.start => last.end = range.end,
        _ => list.push(range.clone()),
    }
}

/// The light in the world, homogeneous.
pub fn light_in_world(light: &LightShape) -> DVec4 {
    match *light {
        LightShape::Directional { towards } => towards.extend(0.0),
        LightShape::Point { p_in_world } | LightShape::Spot { p_in_world, .. } => {
            p_in_world.extend(1.0)
        }
    }
}

/// The light in the frame of a mesh, homogeneous.
pub fn light_in_mesh(light: &LightShape, world_from_mesh: &DAffine3) -> DVec4 {
    let mesh_from_world = world_from_mesh.matrix3.inverse();
    match *light {
        LightShape::Directional { towards } => (mesh_from_world * towards).extend(0.0),
        LightShape::Point { p_in_world } | LightShape::Spot { p_in_world, .. } => {
            // Subtracted first: far from the world's origin the inverse would cancel.
            let offset: DVec3 = p_in_world - world_from_mesh.translation;
            (mesh_from_world * offset).extend(1.0)
        }
    }
}
