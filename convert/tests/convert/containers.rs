//! `.glb`, `.gltf`, files, and limits.

use std::fs;
use std::io::{self, Write};
use std::path::Path;

use convert::{Container, Error, Options, write_file, write_glb, write_gltf};
use glam::DAffine3;
use scenegraph::scene::{LightSetId, MeshId, NodeId, Scene, TextureId};
use serde_json::{Value, json};

use crate::read::{convert, convert_with};
use crate::scenes::{Build, Images, file_texture, material, png, triangle};

fn gltf_bin() -> Options {
    Options {
        container: Container::GltfBin,
        ..Options::default()
    }
}

fn textured() -> (Build, Images) {
    let build = Build::textured(file_texture("a.png"), material());
    (build, Images::with(&[("a.png", png(&[[1, 2, 3, 4]; 9]))]))
}

fn names_in(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<_> = entries
        .map(|e| e.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn an_empty_scene_is_a_valid_model() {
    let converted = convert(&Scene::default());
    let want = json!({
        "asset": {
            "version": "2.0",
            "generator": concat!("Ivory ivconvert ", env!("CARGO_PKG_VERSION")),
            "extras": {"iv": {"version": 1}},
        },
    });
    assert_eq!(converted.json, want);
    assert!(converted.bin.is_empty());
}

#[test]
fn the_same_scene_gives_the_same_bytes() {
    let (build, images) = textured();
    let once = convert_with(&build.scene, &Options::default(), &images).bytes;
    let twice = convert_with(&build.scene, &Options::default(), &images).bytes;
    assert!(once == twice);
}

#[test]
fn gltf_and_glb_hold_the_same() {
    let (build, images) = textured();
    let glb = convert_with(&build.scene, &Options::default(), &images);
    let (mut text, mut bin) = (Vec::new(), Vec::new());
    let report = write_gltf(
        &build.scene,
        &Options::default(),
        &images,
        "x.bin",
        &mut text,
        &mut bin,
    )
    .unwrap();
    let mut json: Value = serde_json::from_slice(&text).unwrap();
    assert_eq!(
        json["buffers"][0].as_object_mut().unwrap().remove("uri"),
        Some(json!("x.bin"))
    );
    assert_eq!(json, glb.json);
    assert!(glb.bin.starts_with(&bin));
    assert_eq!(json["buffers"][0]["byteLength"], bin.len());
    assert_eq!(report.counts.bytes, (text.len() + bin.len()) as u64);
}

#[test]
fn files_are_written_whole_under_their_names() {
    let folder = tempfile::tempdir().unwrap();
    let (build, images) = textured();
    let glb = folder.path().join("a b.glb");
    fs::write(&glb, "old").unwrap();
    let report = write_file(&build.scene, &Options::default(), &images, &glb).unwrap();
    assert_eq!(fs::metadata(&glb).unwrap().len(), report.counts.bytes);
    let gltf = folder.path().join("a b.gltf");
    let report = write_file(&build.scene, &gltf_bin(), &images, &gltf).unwrap();
    assert_eq!(names_in(folder.path()), ["a b.bin", "a b.glb", "a b.gltf"]);
    let lengths = ["a b.bin", "a b.gltf"].map(|n| fs::metadata(folder.path().join(n)).unwrap());
    assert_eq!(
        lengths.iter().map(fs::Metadata::len).sum::<u64>(),
        report.counts.bytes
    );
    let json: Value = serde_json::from_slice(&fs::read(&gltf).unwrap()).unwrap();
    assert_eq!(json["buffers"][0]["uri"], "a%20b.bin");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        let plain = folder.path().join("plain");
        fs::write(&plain, "").unwrap();
        let mode = |path: &Path| fs::metadata(path).unwrap().permissions().mode();
        assert_eq!(mode(&glb), mode(&plain));
    }
}

#[test]
fn a_failure_leaves_nothing_behind() {
    let folder = tempfile::tempdir().unwrap();
    let (build, images) = textured();
    let old = folder.path().join("old.glb");
    fs::write(&old, "old").unwrap();
    let small = Options {
        max_glb_bytes: 100,
        max_bin_bytes: 8,
        ..Options::default()
    };
    let small_bin = Options {
        container: Container::GltfBin,
        ..small.clone()
    };
    let gone = folder.path().join("gone").join("x.glb");
    // A folder stands where the second file must go.
    let blocked = folder.path().join("blocked.gltf");
    fs::create_dir(&blocked).unwrap();
    let blocked_bin = folder.path().join("half.bin");
    fs::create_dir(&blocked_bin).unwrap();
    for (options, path) in [
        (&small, &old),
        (&small_bin, &folder.path().join("x.gltf")),
        (&Options::default(), &gone),
        (&gltf_bin(), &blocked),
        (&gltf_bin(), &folder.path().join("half.gltf")),
    ] {
        assert!(write_file(&build.scene, options, &images, path).is_err());
        assert_eq!(
            names_in(folder.path()),
            ["blocked.gltf", "half.bin", "old.glb"]
        );
    }
    assert_eq!(fs::read(&old).unwrap(), b"old");
    // The first .bin has its name already when the second finds a folder in its place.
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("m.1.bin")).unwrap();
    let plain = Build::one(triangle(), material());
    let halves = Options {
        max_bin_bytes: 40,
        ..gltf_bin()
    };
    assert!(
        write_file(
            &plain.scene,
            &halves,
            &images,
            &folder.path().join("m.gltf")
        )
        .is_err()
    );
    assert_eq!(names_in(folder.path()), ["m.1.bin"]);
}

#[test]
fn a_glb_beyond_its_limit_is_refused_before_a_byte_is_written() {
    let (build, images) = textured();
    let length = convert_with(&build.scene, &Options::default(), &images)
        .bytes
        .len() as u64;
    let mut out = Vec::new();
    let fits = Options {
        max_glb_bytes: length,
        ..Options::default()
    };
    write_glb(&build.scene, &fits, &images, &mut out).unwrap();
    out.clear();
    let tight = Options {
        max_glb_bytes: length - 1,
        ..Options::default()
    };
    let error = write_glb(&build.scene, &tight, &images, &mut out).unwrap_err();
    assert!(matches!(error, Error::GlbTooLarge { bytes, .. } if bytes == length));
    assert!(error.to_string().contains(".gltf"));
    assert!(out.is_empty());
}

#[test]
fn a_large_gltf_spreads_over_several_bins() {
    let (mut build, images) = textured();
    for i in 0..5 {
        let mut mesh = triangle();
        mesh.positions[0][0] = i as f32;
        mesh.indices = vec![0, 2, 1];
        build.instance(None, None, DAffine3::IDENTITY, mesh, material());
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("m.gltf");
    let options = Options {
        max_bin_bytes: 130,
        ..gltf_bin()
    };
    write_file(&build.scene, &options, &images, &path).unwrap();
    if let Some(dump) = std::env::var_os("GLTF_DUMP") {
        for name in names_in(folder.path()) {
            fs::copy(folder.path().join(&name), Path::new(&dump).join(name)).unwrap();
        }
    }
    let names = names_in(folder.path());
    assert!(names.len() > 4, "{names:?}");
    // Read through the gltf crate, the arrays are those of a single buffer.
    let gltf = gltf::Gltf::open(&path).unwrap();
    let bins: Vec<_> = gltf
        .buffers()
        .map(|buffer| match buffer.source() {
            gltf::buffer::Source::Uri(uri) => fs::read(folder.path().join(uri)).unwrap(),
            gltf::buffer::Source::Bin => panic!("no file"),
        })
        .collect();
    assert!(bins.iter().all(|bin| bin.len() <= 130));
    for (mesh, source) in gltf.meshes().zip(&build.scene.meshes) {
        let primitive = mesh.primitives().next().unwrap();
        let reader = primitive.reader(|buffer| Some(&bins[buffer.index()][..]));
        assert!(
            reader
                .read_positions()
                .unwrap()
                .eq(source.positions.iter().copied())
        );
        assert!(
            reader
                .read_normals()
                .unwrap()
                .eq(source.normals.iter().copied())
        );
        if let Some(indices) = reader.read_indices() {
            assert!(indices.into_u32().eq(source.indices.iter().copied()));
        }
    }
    let mut out = Vec::new();
    let mut bin = Vec::new();
    let error = write_gltf(&build.scene, &options, &images, "m.bin", &mut out, &mut bin);
    assert!(matches!(error, Err(Error::SeveralBins { count }) if count == bins.len()));
    assert_eq!((out, bin), (Vec::new(), Vec::new()));
}

#[test]
fn an_unsound_scene_is_refused() {
    type Break = fn(&mut Scene);
    let breaks: [Break; 8] = [
        |s| s.instances[0].mesh = MeshId(9),
        |s| s.instances[0].light_set = LightSetId(9),
        |s| s.instances[0].placement.node = Some(NodeId(0)),
        |s| s.materials[0].texture = Some(TextureId(9)),
        |s| s.meshes[0].positions.clear(),
        |s| s.meshes[0].indices.clear(),
        |s| s.meshes[0].indices.truncate(2),
        |s| s.meshes[0].normals.truncate(2),
    ];
    for break_it in breaks {
        let mut scene = Build::one(triangle(), material()).scene;
        break_it(&mut scene);
        let result = write_glb(
            &scene,
            &Options::default(),
            &Images::default(),
            &mut io::sink(),
        );
        assert!(matches!(result, Err(Error::Scene(_))));
    }
    let mut build = Build::new();
    build.group(None, None, DAffine3::IDENTITY);
    build.scene.nodes[0].parent = Some(NodeId(0));
    let result = write_glb(
        &build.scene,
        &Options::default(),
        &Images::default(),
        &mut io::sink(),
    );
    assert!(matches!(result, Err(Error::Scene(_))));
}

#[test]
fn an_error_of_the_stream_comes_through() {
    struct Full(usize);
    impl Write for Full {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            let taken = bytes.len().min(self.0);
            self.0 -= taken;
            if taken == 0 {
                Err(io::ErrorKind::StorageFull.into())
            } else {
                Ok(taken)
            }
        }
        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }
    let (build, images) = textured();
    let length = convert_with(&build.scene, &Options::default(), &images)
        .bytes
        .len();
    for room in [0, 15, 100, length - 1] {
        let result = write_glb(&build.scene, &Options::default(), &images, &mut Full(room));
        assert!(matches!(result, Err(Error::Io { .. })), "{room}");
    }
}
