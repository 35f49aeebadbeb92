//! The document of `--stats`. Its keys are promised in docs/STATS.md.

use std::collections::HashSet;
use std::path::Path;
use std::time::Duration;

use clap::ValueEnum;
use scenegraph::scene::{Scene, Topology};
use serde_json::{Map, Value, json};
use viewer::content::{LightShape, WorldLight};
use viewer::frame::{Headlight, Pass, PassKind, Skip};
use viewer::gpu::{PassReport, Renderer};
use viewer::view::Lens;

use super::Shown;
use super::args::Args;

/// Times that are not in the frame's report.
#[derive(Clone, Copy, Debug, Default)]
pub struct Times {
    /// Reading and parsing the model.
    pub read: Duration,
    /// From graph to scene.
    pub resolve: Duration,
    /// Reading and decoding images.
    pub textures: Duration,
    /// Making the device.
    pub device: Duration,
    /// Encoding and writing the picture.
    pub png: Duration,
    /// All.
    pub total: Duration,
}

/// What the document is about.
pub struct Told<'a> {
    /// What was asked for.
    pub args: &'a Args,
    /// The model's file.
    pub model: &'a Path,
    /// `inventor` or `gltf`.
    pub format: &'a str,
    /// What was drawn.
    pub scene: &'a Scene,
    /// By what.
    pub renderer: &'a Renderer,
    /// How.
    pub shown: &'a Shown,
    /// How long it took.
    pub times: &'a Times,
}

impl Told<'_> {
    /// The document.
    pub fn document(&self) -> Value {
        json!({
            "generator": concat!("ivview ", env!("CARGO_PKG_VERSION")),
            "model": self.model.display().to_string(),
            "format": self.format,
            "adapter": self.adapter(),
            "settings": self.settings(),
            "view": self.view(),
            "times_ms": self.times(),
            "scene": self.scene(),
            "lights": self.lights(),
            "passes": self.passes(),
            "shaders": self.shaders(),
            "device_bytes": self.device_bytes(),
        })
    }

    fn adapter(&self) -> Value {
        let gpu = &self.renderer.gpu;
        json!({
            "name": gpu.info.name,
            "driver": gpu.info.driver,
            "driver_info": gpu.info.driver_info,
            "backend": gpu.info.backend.to_string(),
            "kind": format!("{:?}", gpu.info.device_type),
            "is_software": gpu.is_software(),
        })
    }

    fn settings(&self) -> Value {
        let settings = self.args.settings();
        let (width, height) = self.args.size;
        json!({
            "width": width,
            "height": height,
            "samples": settings.samples,
            "shadows": name_of(&self.args.shadows),
            "extraction": name_of(&self.args.extraction),
            "background_srgb": settings.background_srgb,
            "has_headlight": settings.headlight != Headlight::Off,
        })
    }

    fn view(&self) -> Value {
        let view = &self.shown.view;
        let region = &self.shown.region;
        let (lens, size) = match view.lens {
            Lens::Perspective { tan_half_height } => ("perspective", tan_half_height),
            Lens::Orthographic { half_height } => ("orthographic", half_height),
        };
        json!({
            "eye": view.eye.to_array(),
            "forward": view.forward().to_array(),
            "up": view.up().to_array(),
            "lens": lens,
            "half_height": size,
            "region": [region.x, region.y, region.width, region.height],
            "aspect": region.aspect,
        })
    }

    fn times(&self) -> Value {
        let (times, report) = (self.times, &self.shown.report);
        json!({
            "read": ms(times.read),
            "resolve": ms(times.resolve),
            "textures": ms(times.textures),
            "device": ms(times.device),
            "upload": ms(self.renderer.upload_time),
            "plan": ms(report.plan),
            "shadows": ms(report.shadows),
            "compile": ms(report.compile),
            "encode": ms(report.encode),
            "occlusion": ms(report.occlusion),
            "draw": ms(report.draw),
            "readback": ms(self.shown.readback_time),
            "png": ms(times.png),
            "total": ms(times.total),
        })
    }

    fn scene(&self) -> Value {
        let scene = self.scene;
        let content = self.renderer.content();
        // Indices of all meshes, and of all that is drawn, by topology.
        let mut unique = [0_u64; 3];
        let mut instanced = [0_u64; 3];
        for mesh in &scene.meshes {
            unique[kind(mesh.topology)] += mesh.indices.len() as u64;
        }
        for object in &content.objects {
            if let Some(mesh) = scene.meshes.get(object.mesh.index()) {
                instanced[kind(mesh.topology)] += mesh.indices.len() as u64;
            }
        }
        let primitives = |at: usize, corners: u64| json!({ "unique": unique[at] / corners, "instanced": instanced[at] / corners });
        let vertices: u64 = scene.meshes.iter().map(|m| m.positions.len() as u64).sum();
        json!({
            "nodes": scene.nodes.len(),
            "instances": scene.instances.len(),
            "objects": content.objects.len(),
            "opaque_objects": content.opaque_count(),
            "meshes": scene.meshes.len(),
            "vertices": vertices,
            "triangles": primitives(0, 3),
            "segments": primitives(1, 2),
            "points": primitives(2, 1),
            "materials": scene.materials.len(),
            "textures": scene.textures.len(),
            "images": self.renderer.texture_count(),
            "lights": scene.lights.len(),
            "cameras": scene.cameras.len(),
        })
    }

    fn lights(&self) -> Value {
        let plan = &self.shown.plan;
        let count = self.renderer.content().lights.len();
        let light = |(index, light): (usize, &WorldLight)| {
            let skipped = plan.skipped_lights.iter();
            let mut reasons = skipped.filter(|(skipped, _)| *skipped as usize == index);
            json!({
                "index": index,
                "name": light.name.as_deref(),
                "kind": match light.shape {
                    _ if index >= count => "headlight",
                    LightShape::Directional { .. } => "directional",
                    LightShape::Point { .. } => "point",
                    LightShape::Spot { .. } => "spot",
                },
                "casts_shadows": light.casts_shadows,
                "skipped": reasons.next().map(|(_, reason)| reason.name()),
            })
        };
        plan.lights.iter().enumerate().map(light).collect()
    }

    fn passes(&self) -> Value {
        let passes = self.shown.plan.passes.iter();
        // A pass without a report drew nothing.
        let reports = self.shown.report.passes.iter().copied();
        let reports = reports.chain(std::iter::repeat(PassReport::default()));
        passes.zip(reports).map(|(p, r)| pass(p, r)).collect()
    }

    fn shaders(&self) -> Value {
        let counts = &self.shown.report.pipelines;
        let passes = self.shown.plan.passes.iter();
        let keys: HashSet<_> = passes.flat_map(|p| &p.draws).map(|d| d.shader).collect();
        json!({
            "keys": keys.len(),
            "shaders": counts.shaders,
            "pipelines": counts.pipelines,
            "hits": counts.hits,
            "compile_ms": ms(counts.time),
        })
    }

    fn device_bytes(&self) -> Value {
        let bytes = self.renderer.bytes();
        let names = ["meshes", "textures", "casters", "shadows", "images"];
        let named = names.iter().zip(bytes);
        let mut document: Map<String, Value> = named
            .map(|(name, bytes)| ((*name).to_owned(), json!(bytes)))
            .collect();
        document.insert("total".to_owned(), json!(bytes.iter().sum::<u64>()));
        Value::Object(document)
    }
}

fn pass(pass: &Pass, report: PassReport) -> Value {
    let (kind, light) = match pass.kind {
        PassKind::Depth { .. } => ("depth", None),
        PassKind::First { light, .. } => ("first", light),
        PassKind::Volumes { light } => ("volumes", Some(light)),
        PassKind::Map { light } => ("map", Some(light)),
        PassKind::Rays { light } => ("rays", Some(light)),
        PassKind::Light { light, .. } => ("light", Some(light)),
        PassKind::Transparent => ("transparent", None),
    };
    let z_pass = pass.volumes.iter().filter(|volume| volume.is_z_pass);
    let z_pass = z_pass.count();
    json!({
        "kind": kind,
        "light": light,
        "objects": pass.object_count(),
        "z_pass": z_pass,
        "z_fail": pass.volumes.len() - z_pass,
        "draw_calls": report.draw_calls,
        "primitives": report.primitives,
        "scissor": pass.scissor,
        "skipped": pass.skipped.iter().map(skip).collect::<Value>(),
    })
}

fn skip(skip: &Skip) -> Value {
    json!({ "reason": skip.reason.name(), "count": skip.count })
}

/// The word for a value on the command line.
fn name_of(value: &impl ValueEnum) -> Option<String> {
    let value = value.to_possible_value()?;
    Some(value.get_name().to_owned())
}

fn kind(topology: Topology) -> usize {
    match topology {
        Topology::Triangles => 0,
        Topology::Lines => 1,
        Topology::Points => 2,
    }
}

/// Milliseconds, to a microsecond.
fn ms(time: Duration) -> f64 {
    (time.as_secs_f64() * 1e6).round() / 1e3
}
