//! The command `ivview`.

use std::process::ExitCode;
use std::sync::Arc;

fn main() -> ExitCode {
    let args: Vec<String> = std::env::args().collect();
    let path = std::path::PathBuf::from(&args[1]);
    let out = &args[2];
    let (w, h) = (1024, 768);
    let bytes = std::fs::read(&path).unwrap();
    let folder = path.parent().unwrap().canonicalize().unwrap();
    let files = scenegraph::FileLoader::new([folder.as_path()]);
    let graph = scenegraph::load(&bytes, "x", &folder, &files);
    let resolved = scenegraph::resolve(&graph, &scenegraph::ResolveOptions::default());
    let scene = Arc::new(resolved.scene);
    struct L(scenegraph::FileLoader);
    impl convert::TextureLoader for L {
        fn load(&self, beside: &std::path::Path, name: &str) -> Result<Vec<u8>, String> {
            use scenegraph::Loader;
            self.0
                .load(beside, name)
                .map(|l| l.bytes)
                .map_err(|e| e.to_string())
        }
    }
    let images = viewer::texture::Images::load(&scene, &L(files));
    let gpu = viewer::gpu::Gpu::new(viewer::gpu::AdapterChoice::Any).unwrap();
    eprintln!("{:?}", gpu.info);
    let mut renderer = viewer::gpu::Renderer::new(gpu, scene.clone(), &images).unwrap();
    let (view, region) = match scene.cameras.first() {
        Some(c) if args.len() < 4 => viewer::view::View::from_scene_camera(c, w, h),
        _ => {
            let region = viewer::view::Region::whole(w, h);
            (
                viewer::view::View::of_whole(
                    &renderer.content().bounds,
                    viewer::view::framing::Up::Z,
                    region.aspect,
                ),
                region,
            )
        }
    };
    let mut settings = viewer::frame::Settings::default();
    settings.background_srgb = [[0.4, 0.5, 0.6], [0.8, 0.8, 0.8]];
    use viewer::frame::{Extraction, Shadows, VolumeMethod};
    let volumes = |method, extraction| Shadows::Volumes { method, extraction };
    settings.shadows = match std::env::var("SH").as_deref() {
        Ok("none") => Shadows::None,
        Ok("map") => Shadows::Map {
            size: std::env::var("MS").unwrap().parse().unwrap(),
        },
        Ok("rays") => Shadows::Rays,
        Ok("compute") => volumes(VolumeMethod::Silhouette, Extraction::Compute),
        Ok("ref") => volumes(VolumeMethod::ReferenceEdge, Extraction::Cpu),
        Ok("tri") => volumes(VolumeMethod::PerTriangle, Extraction::Cpu),
        _ => Shadows::default(),
    };
    if std::env::var("MSAA").is_ok() {
        settings.samples = 4;
    }
    for _ in 0..2 {
        let (plan, report) = renderer.draw(&view, &region, (w, h), &settings).unwrap();
        eprintln!("{}\n{:?}", plan.brief(), report);
    }
    let pixels = renderer.read().unwrap();
    image::RgbaImage::from_raw(w, h, pixels)
        .unwrap()
        .save(out)
        .unwrap();
    ExitCode::SUCCESS
}
