//! `mist models`: what the registry knows.

use scattering::{Class, registry};

use super::{error::CommandError, flags::JsonFlag, output::print};

mod json;
mod kinds;
mod markdown;
mod search;
mod text;

/// List the models and what they are made of, or describe one.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  mist models
  mist models Shadowed_Facet_BRDF_Model
  mist models --search metallic paint
  mist models Gaussian_PSD_Function --json")]
pub(super) struct ModelsArgs {
    /// A model, or a class that models are made of.
    name: Option<String>,
    #[command(flatten)]
    json: JsonFlag,
    /// Find models by words: a material, a property, an author.
    #[arg(long, value_name = "WORD", num_args = 1.., conflicts_with_all = ["name", "json"])]
    search: Vec<String>,
    /// The manual page docs/models.md.
    #[arg(long, conflicts_with_all = ["name", "json", "search"])]
    markdown: bool,
}

/// Prints the list or the description.
pub(super) fn models(args: &ModelsArgs) -> Result<(), CommandError> {
    if !args.search.is_empty() {
        return print(&search::search(&args.search).map_err(CommandError::Refused)?);
    }
    let Some(name) = &args.name else {
        return print(&match (args.json.json, args.markdown) {
            (true, _) => json::list(),
            (_, true) => markdown::manual(),
            _ => text::list(),
        });
    };
    let class = find(name)?;
    print(&if args.json.json { json::class(class) } else { text::class(class) })
}

fn find(name: &str) -> Result<&'static Class, CommandError> {
    registry::find_class(name).ok_or_else(|| {
        let all = registry::classes().map(|class| class.name);
        let hint = mist_format::suggestion::did_you_mean(name, all);
        let hint = hint.unwrap_or_else(|| "`mist models` lists all".into());
        CommandError::Refused(format!("there is no model called {name:?}: {hint}"))
    })
}
