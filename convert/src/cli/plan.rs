//! Which output each input gets, settled before anything is read, so that no output can destroy
//! an input or another output.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use super::args::{Args, Format};
use super::inputs::{Input, identity, without_packing};

/// The output of each input; `None` for an input that is a fault.
///
/// # Errors
///
/// Says which arguments or files are in each other's way.
pub fn outputs(args: &Args, inputs: &[Input]) -> Result<Vec<Option<PathBuf>>, String> {
    check_single(args, inputs)?;
    let format = args.format()?;
    let mut taken = BTreeSet::new();
    let outputs: Vec<Option<PathBuf>> = inputs
        .iter()
        .map(|input| {
            if input.fault.is_some() {
                return None;
            }
            let mut output = output_of(args, format, input);
            // Of files found in folders, `a.wrl` beside `a.iv` keeps its whole name.
            if !taken.insert(identity(&output)) && input.is_found {
                let mut name = input.path.file_name().unwrap_or_default().to_owned();
                name.push(".");
                name.push(format.extension());
                output.set_file_name(name);
            }
            Some(output)
        })
        .collect();
    check_distinct(args, format, inputs, &outputs)?;
    Ok(outputs)
}

/// `-o` goes with one named file.
fn check_single(args: &Args, inputs: &[Input]) -> Result<(), String> {
    let Some(output) = &args.output else {
        return Ok(());
    };
    if args.inputs.len() > 1 || inputs.iter().any(|input| input.is_found) {
        return Err(
            "-o is for a single input file; use --out-dir for several and for folders".to_owned(),
        );
    }
    if output == Path::new("-") {
        return Err("outputs are files; standard output is not one of them".to_owned());
    }
    if output.is_dir() {
        return Err(format!(
            "`{}` is a folder; use --out-dir to write into it",
            output.display()
        ));
    }
    Ok(())
}

fn output_of(args: &Args, format: Format, input: &Input) -> PathBuf {
    let path = match (&args.output, &args.out_dir) {
        (Some(output), _) => return output.clone(),
        (None, Some(folder)) => folder.join(&input.relative),
        (None, None) => input.path.clone(),
    };
    without_packing(&path).with_extension(format.extension())
}

/// What a path is used for.
#[derive(Clone, Copy)]
enum Use<'a> {
    Input(&'a Path),
    Output { of: &'a Path },
    Report,
}

fn check_distinct(
    args: &Args,
    format: Format,
    inputs: &[Input],
    outputs: &[Option<PathBuf>],
) -> Result<(), String> {
    let mut uses = BTreeMap::new();
    for input in inputs {
        // Both what is named and, for a link, what it leads to.
        let target = input.path.canonicalize().ok();
        let ids = [Some(identity(&input.path)), target];
        for id in ids.into_iter().flatten() {
            uses.insert(id, Use::Input(&input.path));
        }
    }
    for (input, output) in inputs.iter().zip(outputs) {
        let Some(output) = output else { continue };
        claim(&mut uses, output, Use::Output { of: &input.path })?;
        if format == Format::Gltf {
            let bin = output.with_extension("bin");
            claim(&mut uses, &bin, Use::Output { of: &input.path })?;
        }
    }
    if let Some(report) = &args.report {
        claim(&mut uses, report, Use::Report)?;
    }
    Ok(())
}

fn claim<'a>(
    uses: &mut BTreeMap<PathBuf, Use<'a>>,
    path: &Path,
    wanted: Use<'a>,
) -> Result<(), String> {
    let shown = path.display();
    let Some(known) = uses.insert(identity(path), wanted) else {
        return Ok(());
    };
    Err(match (known, wanted) {
        (Use::Input(a), Use::Output { of }) if a == of => {
            format!("`{shown}` would be written over itself; give -o or --out-dir")
        }
        (Use::Input(_), Use::Output { of }) => format!(
            "`{shown}` is an input and would be overwritten by the output of `{}`",
            of.display()
        ),
        (Use::Output { of: a }, Use::Output { of: b }) if a == b => {
            format!("`{shown}` cannot be both the glTF text and its .bin file")
        }
        (Use::Output { of: a }, Use::Output { of: b }) => format!(
            "`{}` and `{}` would both be written to `{shown}`; convert them apart",
            a.display(),
            b.display()
        ),
        (Use::Input(_), _) => format!("`{shown}` is an input and cannot be the report"),
        (_, _) => format!("`{shown}` is an output and cannot be the report"),
    })
}
