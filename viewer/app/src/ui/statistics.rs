//! Numbers about the scene, the frame and the device.

use egui::{Grid, Stroke, Ui, pos2, vec2};
use scenegraph::scene::Topology;
use viewer::frame::PassKind;

use super::state::App;

impl App {
    pub(super) fn statistics(&mut self, ui: &mut Ui) {
        self.graph(ui);
        let Some(model) = &self.model else {
            return;
        };
        let scene = &model.scene;
        let content = model.renderer.content();
        let primitives = |topology: Topology, corners: usize| {
            let meshes = scene.meshes.iter().filter(|m| m.topology == topology);
            let unique: usize = meshes.map(|m| m.indices.len() / corners).sum();
            let drawn = content
                .objects
                .iter()
                .map(|o| &scene.meshes[o.mesh.index()]);
            let instanced: usize = drawn
                .filter(|m| m.topology == topology)
                .map(|m| m.indices.len() / corners)
                .sum();
            format!("{unique} ({instanced})")
        };
        let bytes = model.renderer.bytes();
        let names = ["meshes", "textures", "casters", "shadows", "images"];
        let gpu = &model.renderer.gpu.info;
        let ms = |time: std::time::Duration| format!("{:.1} ms", time.as_secs_f64() * 1e3);
        Grid::new("statistics")
            .num_columns(2)
            .striped(true)
            .show(ui, |ui| {
                let mut row = |name: &str, value: String| {
                    ui.label(name);
                    ui.label(value);
                    ui.end_row();
                };
                row("Adapter", gpu.name.clone());
                row(
                    "Parts (meshes)",
                    format!("{} ({})", scene.instances.len(), scene.meshes.len()),
                );
                row("Triangles (drawn)", primitives(Topology::Triangles, 3));
                row("Segments (drawn)", primitives(Topology::Lines, 2));
                row("Points (drawn)", primitives(Topology::Points, 1));
                row(
                    "Materials, textures",
                    format!("{}, {}", scene.materials.len(), scene.textures.len()),
                );
                row(
                    "Lights, cameras",
                    format!("{}, {}", scene.lights.len(), scene.cameras.len()),
                );
                for (name, bytes) in names.iter().zip(bytes) {
                    row(
                        &format!("Device: {name}"),
                        format!("{:.1} MiB", bytes as f64 / 1_048_576.0),
                    );
                }
                let times = &model.times;
                row("Read", ms(times.read));
                row("Resolve", ms(times.resolve));
                row("Upload", ms(times.upload));
                row("Compile", ms(times.compile));
                row("First draw", ms(times.draw));
                row("First picture after", ms(times.total));
                if let Some((plan, report)) = &self.canvas.last {
                    row(
                        "Picture",
                        format!("{} × {}", self.canvas.size.0, self.canvas.size.1),
                    );
                    row("Passes", plan.passes.len().to_string());
                    let calls: u64 = report.passes.iter().map(|p| p.draw_calls).sum();
                    let drawn: u64 = report.passes.iter().map(|p| p.primitives).sum();
                    row("Draw calls", calls.to_string());
                    row("Primitives", drawn.to_string());
                    row(
                        "Shaders, pipelines made",
                        format!(
                            "{}, {}",
                            report.pipelines.shaders, report.pipelines.pipelines
                        ),
                    );
                    row("Plan", ms(report.plan));
                    row("Shadows", ms(report.shadows));
                    row("Encode", ms(report.encode));
                    row("Occlusion", ms(report.occlusion));
                    row("Draw", ms(report.draw));
                }
                for pass in self.passes() {
                    row("Pass", pass);
                }
                row("Pictures drawn", self.counters.pictures.to_string());
                row("Passes of the window", self.counters.passes.to_string());
            });
    }

    /// What each pass of the last picture did.
    fn passes(&self) -> Vec<String> {
        let Some((plan, report)) = &self.canvas.last else {
            return Vec::new();
        };
        let reports = report.passes.iter();
        let described = plan.passes.iter().zip(reports).map(|(pass, report)| {
            let light = |light: u32| {
                let name = plan
                    .lights
                    .get(light as usize)
                    .and_then(|l| l.name.as_deref());
                name.map_or_else(|| format!("light {light}"), str::to_owned)
            };
            let what = match pass.kind {
                PassKind::Depth { .. } => "depth".to_owned(),
                PassKind::First { light: None, .. } => "ambient".to_owned(),
                PassKind::First { light: Some(i), .. } => format!("ambient and {}", light(i)),
                PassKind::Volumes { light: i } => format!("volumes of {}", light(i)),
                PassKind::Map { light: i } => format!("map of {}", light(i)),
                PassKind::Rays { light: i } => format!("rays to {}", light(i)),
                PassKind::Light { light: i, .. } => light(i),
                PassKind::Transparent => "transparent".to_owned(),
            };
            let skipped: usize = pass.skipped.iter().map(|skip| skip.count).sum();
            format!(
                "{what}: {} drawn in {} calls, {skipped} left out",
                report.primitives, report.draw_calls
            )
        });
        described.collect()
    }

    /// How long the last pictures took.
    fn graph(&self, ui: &mut Ui) {
        let size = vec2(ui.available_width(), 48.0);
        let (rect, _) = ui.allocate_exact_size(size, egui::Sense::hover());
        let history = &self.canvas.history;
        let most = history
            .iter()
            .max()
            .map_or(0.0, std::time::Duration::as_secs_f64);
        ui.painter()
            .rect_filled(rect, 2.0, ui.visuals().extreme_bg_color);
        if most <= 0.0 {
            return;
        }
        let step = rect.width() / 120.0;
        let color = ui.visuals().hyperlink_color;
        for (i, took) in history.iter().enumerate() {
            let x = rect.left() + (i as f32 + 0.5) * step;
            let top = rect.bottom() - rect.height() * (took.as_secs_f64() / most) as f32;
            let line = [pos2(x, rect.bottom()), pos2(x, top)];
            ui.painter()
                .line_segment(line, Stroke::new(step * 0.8, color));
        }
        ui.weak(format!(
            "longest of the last {}: {:.1} ms",
            history.len(),
            most * 1e3
        ));
    }
}
