//! Suggestions: the known name that is most similar to a wrong one.

/// Names closer than this (Jaro–Winkler, 1 = equal) are worth proposing; strsim's authors and
/// cargo use values from 0.7 to 0.85 for the same purpose.
const CLOSE_ENOUGH: f64 = 0.8;

/// The known name most similar to `wrong`, if one is similar enough; a name that differs in case
/// only is preferred.
pub fn nearest<'a>(wrong: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let wrong_folded = wrong.to_lowercase();
    known
        .into_iter()
        .filter(|name| *name != wrong)
        .map(|name| (closeness(&wrong_folded, &name.to_lowercase()), name))
        .filter(|(score, _)| *score >= CLOSE_ENOUGH)
        .fold(None, |best: Option<(f64, &str)>, next| match best {
            Some(best) if best.0 >= next.0 => Some(best),
            _ => Some(next),
        })
        .map(|(_, name)| name)
}

/// ``did you mean `name`?`` for the nearest known name.
pub fn did_you_mean<'a>(wrong: &str, known: impl IntoIterator<Item = &'a str>) -> Option<String> {
    nearest(wrong, known).map(|name| format!("did you mean `{name}`?"))
}

fn closeness(a: &str, b: &str) -> f64 {
    let swapped = a.len() > 1 && strsim::damerau_levenshtein(a, b) <= 1;
    if swapped { 1.0 } else { strsim::jaro_winkler(a, b) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_name_is_proposed() {
        let known = ["lambda", "substrate", "type"];
        assert_eq!(nearest("lamda", known), Some("lambda"));
        assert_eq!(nearest("Substrate", known), Some("substrate"));
        assert_eq!(did_you_mean("tpye", known).as_deref(), Some("did you mean `type`?"));
    }

    #[test]
    fn a_far_name_is_not_proposed() {
        assert_eq!(nearest("zzz", ["lambda"]), None);
        assert_eq!(nearest("x", ["y"]), None);
    }
}
