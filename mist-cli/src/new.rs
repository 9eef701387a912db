//! `mist new`: a commented program or a material to begin with.

use std::{
    fs,
    io::{IsTerminal, Write, stdin, stdout},
    path::{Path, PathBuf},
    sync::Arc,
};

use mist_engine::{MemoryFiles, Options, compile, material::PreparedMaterial};
use mist_format::suggestion::did_you_mean;
use serde_json::Value;

use super::{error::CommandError, output::print};

/// The programs by name.
const PROGRAMS: &[(&str, &str)] = &[
    ("metallic-paint", include_str!("new/metallic-paint.mist")),
    ("pearl", include_str!("new/pearl.mist")),
    ("white-paint", include_str!("new/white-paint.mist")),
    ("plastic", include_str!("new/plastic.mist")),
    ("rough-metal", include_str!("new/rough-metal.mist")),
    ("brushed-metal", include_str!("new/brushed-metal.mist")),
    ("anodized", include_str!("new/anodized.mist")),
    ("wax", include_str!("new/wax.mist")),
    ("glass", include_str!("new/glass.mist")),
    ("mirror", include_str!("new/mirror.mist")),
    ("grating", include_str!("new/grating.mist")),
    ("wafer", include_str!("new/wafer.mist")),
];

/// Write a commented program, or a material, that runs as it is.
///
/// Without --from the command asks, if it runs in a terminal. A file name that ends in .json gets
/// the material alone, for `mist table`, `preview` and `export`; every other one the program.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  mist new                                   choose from a list
  mist new --list
  mist new --from metallic-paint paint.mist  then: mist run paint.mist
  mist new --from pearl pearl.json           then: mist preview pearl.json -o pearl.png")]
pub(super) struct NewArgs {
    /// The file to write [default: the name of the example with .mist].
    file: Option<PathBuf>,
    /// The example to begin with.
    #[arg(long, value_name = "EXAMPLE")]
    from: Option<String>,
    /// List the examples.
    #[arg(long, conflicts_with_all = ["file", "from"])]
    list: bool,
    /// Replace a file that exists.
    #[arg(long)]
    force: bool,
}

/// Writes the file, or lists the examples.
pub(super) fn new(args: &NewArgs) -> Result<(), CommandError> {
    if args.list {
        return print(&list());
    }
    let name = match &args.from {
        Some(name) => name.clone(),
        None if stdin().is_terminal() && stdout().is_terminal() => ask()?,
        None => {
            let message = format!("choose an example with --from:\n{}", list());
            return Err(CommandError::Refused(message.trim_end().to_owned()));
        }
    };
    let (name, program) = find(&name)?;
    let file = args.file.clone().unwrap_or_else(|| format!("{name}.mist").into());
    if file.exists() && !args.force {
        let message = format!("{} exists: choose another name, or --force", file.display());
        return Err(CommandError::Refused(message));
    }
    let is_material = file.extension().is_some_and(|extension| extension == "json");
    let text = if is_material { material(program)? } else { program.to_owned() };
    write(&file, &text)?;
    let next = if is_material { "mist preview" } else { "mist run" };
    print(&format!("{}: {}\nnext: {next} {0}\n", file.display(), title(program)))
}

fn write(file: &Path, text: &str) -> Result<(), CommandError> {
    fs::write(file, text)
        .map_err(|error| CommandError::Failed(format!("cannot write {}: {error}", file.display())))
}

fn find(name: &str) -> Result<(&'static str, &'static str), CommandError> {
    let number = name.parse::<usize>().ok().and_then(|number| number.checked_sub(1));
    let by_name = || PROGRAMS.iter().find(|(known, _)| *known == name);
    number.and_then(|at| PROGRAMS.get(at)).or_else(by_name).copied().ok_or_else(|| {
        let hint = did_you_mean(name, PROGRAMS.iter().map(|(name, _)| *name));
        let hint = hint.unwrap_or_else(|| "`mist new --list` lists all".into());
        CommandError::Refused(format!("no example is called {name:?}: {hint}"))
    })
}

/// The first sentence of the comment at the head of a program.
fn title(program: &str) -> &str {
    let line = program.lines().next().unwrap_or_default().trim_start_matches("; ");
    line.split_inclusive('.').next().unwrap_or(line)
}

fn list() -> String {
    let line = |(at, (name, program)): (usize, &(&str, &str))| {
        format!("{:>3}  {name:<15} {}\n", at + 1, title(program))
    };
    PROGRAMS.iter().enumerate().map(line).collect()
}

/// The user's choice from the list.
fn ask() -> Result<String, CommandError> {
    print(&format!("{}Number or name: ", list()))?;
    let failed =
        |error: std::io::Error| CommandError::Failed(format!("cannot read the answer: {error}"));
    stdout().flush().map_err(failed)?;
    let mut answer = String::new();
    stdin().read_line(&mut answer).map_err(failed)?;
    Ok(answer.trim().to_owned())
}

/// The model of a program's first step with the parameters that differ from their defaults, as JSON.
fn material(program: &str) -> Result<String, CommandError> {
    let wrong = |error: String| CommandError::Failed(format!("the example is wrong: {error}"));
    let job = compile(program, Arc::new(MemoryFiles::default()), &Options::default());
    let job = job.map_err(|found| wrong(found.iter().map(ToString::to_string).collect()))?;
    let prepared = PreparedMaterial::of_step(&job).map_err(|error| wrong(error.to_string()))?;
    let given = prepared.parameters().entries().into_iter().filter(|entry| !entry.is_default);
    let quoted = |text: &str| Value::from(text).to_string();
    let value = |text: &str| match text.parse::<f64>() {
        Ok(x) if x.is_finite() => text.to_owned(),
        _ => quoted(text),
    };
    let lines: Vec<String> =
        given.map(|entry| format!("    {}: {}", quoted(&entry.name), value(&entry.text))).collect();
    let (model, lines) = (quoted(job.class().name), lines.join(",\n"));
    Ok(format!("{{\n  \"model\": {model},\n  \"parameters\": {{\n{lines}\n  }}\n}}\n"))
}
