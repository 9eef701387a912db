//! `mist help`: the help of a command, or a page about a topic.

use clap::Command;
use mist_format::suggestion::did_you_mean;

use super::{error::CommandError, output::print};

/// Pages that are not about one command: name, title, text.
const TOPICS: &[(&str, &str, &str)] = &[
    ("programs", "sections of a program, with an example", include_str!("help/programs.txt")),
    ("expressions", "operators, functions and constants", include_str!("help/expressions.txt")),
    ("apertures", "shapes of the detector in INTEGRALS", include_str!("help/apertures.txt")),
    ("integration", "accuracy and cost of integrals", include_str!("help/integration.txt")),
    ("polarization", "Stokes vectors, signs, filters", include_str!("help/polarization.txt")),
    ("color", "spectra, colours, illuminants", include_str!("help/color.txt")),
    ("units", "angles, lengths, wavelengths", include_str!("help/units.txt")),
    ("materials", "materials as JSON or programs", include_str!("help/materials.txt")),
    ("files", "data files, and where they are found", include_str!("help/files.txt")),
    ("renderers", "the way to each renderer", include_str!("help/renderers.txt")),
    ("compat", "sound runs and NIST's numbers", include_str!("help/compat.txt")),
    ("warnings", "warnings, errors and exit codes", include_str!("help/warnings.txt")),
];

/// Describe a command or a topic.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  mist help               commands and topics
  mist help run           a command, as mist run --help
  mist help units         a topic")]
pub(super) struct HelpArgs {
    /// A command or a topic.
    topic: Option<String>,
}

/// Prints the page.
pub(super) fn help(args: &HelpArgs, mut program: Command) -> Result<(), CommandError> {
    let Some(topic) = &args.topic else {
        return print(&format!("{}\n{}", program.render_long_help(), list()));
    };
    if let Some((.., text)) = TOPICS.iter().find(|(name, ..)| name.eq_ignore_ascii_case(topic)) {
        return print(text);
    }
    if topic == "topics" {
        return print(&list());
    }
    program.build();
    if let Some(command) = program.find_subcommand_mut(topic) {
        return print(&command.render_long_help().to_string());
    }
    let commands = program.get_subcommands().map(Command::get_name);
    let known = TOPICS.iter().map(|(name, ..)| *name).chain(commands);
    let hint = did_you_mean(topic, known).unwrap_or_else(|| "`mist help` lists all".into());
    Err(CommandError::Refused(format!("no command or topic is called {topic:?}: {hint}")))
}

fn list() -> String {
    let line = |(name, title, _): &(&str, &str, &str)| format!("  {name:<14} {title}\n");
    format!("Topics:\n{}", TOPICS.iter().map(line).collect::<String>())
}
