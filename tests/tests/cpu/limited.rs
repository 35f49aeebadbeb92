//! Mutated inputs through all that the command does with one, in processes that may take 2 GiB each
//! and 10 seconds for an input: no crash, no hang, no limit hit.

use std::fs;
use std::process::Command;
use std::time::{Duration, Instant};

use convert::command::access::{Access, PackedArgs};
use convert::command::model;
use convert::{Options, write_glb};
use scenegraph::{ResolveOptions, resolve};
use tests::mutate::{Rng, mutate};

use super::robustness::{Watch, any_forms, keep};

/// Processes, and inputs of each: 5,000 together.
const SHARES: u64 = 10;
const EACH: u64 = 500;

/// Bytes that a process may map.
const MEMORY_KIB: u64 = 2 << 20;

/// Longest time for one input.
const SLOW: Duration = Duration::from_secs(10);

/// Which share a process is to do, if the other test has begun it.
const SHARE: &str = "IVORY_SHARE_OF_INPUTS";

#[test]
fn five_thousand_inputs() {
    let program = std::env::current_exe().expect("the path of the tests");
    let begin = |share: u64| {
        Command::new("sh")
            .args(["-c", "ulimit -v \"$1\"; shift; exec \"$@\"", "sh"])
            .arg(MEMORY_KIB.to_string())
            .arg(&program)
            .args(["--exact", "cpu::limited::one_share", "--nocapture"])
            .env(SHARE, share.to_string())
            .stdout(std::process::Stdio::piped())
            .stderr(std::process::Stdio::piped())
            .spawn()
            .expect("a process")
    };
    let shares: Vec<u64> = (0..SHARES).collect();
    for pair in shares.chunks(2) {
        let processes: Vec<_> = pair.iter().map(|&share| (share, begin(share))).collect();
        for (share, process) in processes {
            let output = process.wait_with_output().expect("its end");
            let told = String::from_utf8_lossy(&output.stdout);
            let errors = String::from_utf8_lossy(&output.stderr);
            let is_whole = told.contains(&format!("{EACH} inputs done"));
            assert!(
                output.status.success() && is_whole,
                "share {share}: {}\n{errors}",
                output.status
            );
        }
    }
}

/// Does a share when [`five_thousand_inputs`] asks for it in a process of its own.
#[test]
fn one_share() {
    let share = std::env::var(SHARE).ok();
    let Some(share) = share.and_then(|share| share.parse::<u64>().ok()) else {
        return;
    };
    let forms = any_forms();
    let mut rng = Rng::new(1000 + share);
    let folder = tempfile::tempdir().expect("a folder");
    let packed = PackedArgs {
        password: Some("ivory".to_owned()),
        ..PackedArgs::default()
    };
    let access = Access::new(&[], &packed).expect("no file is read");
    for number in 0..EACH {
        let base = &forms[rng.below(forms.len())];
        let input = mutate(&mut rng, base, &forms);
        let path = folder.path().join("model.iv");
        fs::write(&path, &input).expect("a file");
        let began = Instant::now();
        let watch = Watch::over(&input);
        if let Ok(opened) = model::open(&path, &access) {
            let (graph, files) = opened.into_graph();
            let scene = resolve(&graph, &ResolveOptions::default()).scene;
            let images = model::Images(&files);
            let options = Options::default();
            // Any answer is right.
            let _ = write_glb(&scene, &options, &images, &mut std::io::sink());
        }
        drop(watch);
        let took = began.elapsed();
        assert!(
            took < SLOW,
            "input {number} took {took:?}; kept as {}",
            keep(&input)
        );
    }
    println!("{EACH} inputs done");
}
