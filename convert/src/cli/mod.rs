//! The command line: arguments in, files, messages and an exit code out.
//!
//! All that is decided before the first file is read is in [`args`], [`inputs`] and [`plan`]. One
//! input is then one call of [`job`] or [`info`], which touch no terminal; [`screen`] alone does.
//!
//! Exit codes: 0 done, 1 done but not everything came over (with `--strict`), 2 something failed.

mod args;
mod choices;
mod from_gltf;
mod info;
mod inputs;
mod inventor;
mod job;
mod length;
mod messages;
mod plan;
mod pool;
mod references;
mod report;
mod screen;

use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Instant;

use clap::Parser;
use convert::command::access::Access;
use convert::command::messages::{error, error_line};
use convert::command::{atomic, json};

use args::Args;
use inputs::Input;
use messages::Totals;
use pool::Event;
use screen::Screen;

/// Everything done.
const DONE: u8 = 0;
/// Done, but something of the model is not in the output.
const INCOMPLETE: u8 = 1;
/// Something was not done.
const FAILED: u8 = 2;

/// The whole command, with the arguments of the process.
pub fn run() -> ExitCode {
    let args = Args::parse();
    let inputs = inputs::find(&args.inputs, args.out_dir.as_deref());
    let outcome = Access::new(&args.search, &args.packed).and_then(|access| {
        if args.info {
            return Ok(show(&args, &inputs, &access));
        }
        let outputs = plan::outputs(&args, &inputs)?;
        Ok(convert(&args, &inputs, &outputs, access))
    });
    let code = outcome.unwrap_or_else(|why| {
        // The arguments are well formed, so how they are written is not explained again.
        Screen::new(0, true).message(&error(&why));
        FAILED
    });
    ExitCode::from(code)
}

/// Converts all inputs; returns the exit code.
fn convert(args: &Args, inputs: &[Input], outputs: &[Option<PathBuf>], access: Access) -> u8 {
    let start = Instant::now();
    let settings = job::Settings::of(args, inputs.len(), access);
    let mut screen = Screen::new(inputs.len(), args.quiet);
    let mut totals = Totals::default();
    let mut report = args.report.as_ref().map(|_| report::Report::new(args));
    let style = messages::style(args);
    pool::run(
        inputs.len(),
        args.jobs(),
        |i| job::run(&inputs[i], outputs[i].as_deref(), &settings),
        |event| match event {
            Event::Tick { finished } => screen.tick(finished),
            Event::Next { index, result } => {
                let outcome = result.unwrap_or_else(|panic| {
                    job::Outcome::broken(&inputs[index], outputs[index].as_deref(), &panic)
                });
                screen.message(&messages::block(&outcome, &style));
                totals.add(&outcome);
                if let Some(report) = &mut report {
                    report.add(&outcome);
                }
            }
        },
    );
    let written = report.zip(args.report.as_ref()).map(|(report, path)| {
        let text = report.finish(&totals, start.elapsed());
        atomic::write_json(path, &text)
    });
    if let Some(Err(why)) = written {
        totals.report_failed = true;
        screen.message(&error_line("--report", &why));
    }
    screen.finish();
    let code = totals.exit_code(args.strict);
    // Even a quiet run says why it does not end with 0.
    if !args.quiet || code != DONE {
        screen.message(&totals.summary(start.elapsed()));
    }
    code
}

/// Shows what is in all inputs; returns the exit code.
fn show(args: &Args, inputs: &[Input], access: &Access) -> u8 {
    let mut screen = Screen::new(inputs.len(), args.quiet);
    let mut documents = Vec::new();
    let mut failed = false;
    let style = messages::style(args);
    pool::run(
        inputs.len(),
        args.jobs(),
        |i| info::of(&inputs[i], args, access),
        |event| match event {
            Event::Tick { finished } => screen.tick(finished),
            Event::Next { index, result } => {
                let info =
                    result.unwrap_or_else(|panic| info::Info::broken(&inputs[index], &panic));
                failed |= info.failure.is_some();
                screen.message(&messages::lines(
                    &info.path,
                    &info.diagnostics,
                    &[],
                    info.failure.as_deref(),
                    &style,
                ));
                if args.json {
                    documents.push(info::json::document(&info));
                } else if let Some(content) = &info.content {
                    screen.output(&info::table::text(&info, content));
                }
            }
        },
    );
    screen.finish();
    if args.json {
        screen.output(&json::text(&serde_json::json!({ "inputs": documents })));
    }
    if failed || screen.output_failed() {
        FAILED
    } else {
        DONE
    }
}
