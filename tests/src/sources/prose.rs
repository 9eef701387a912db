//! Doc comments of a source, as text.

/// Words that a doc comment does not begin with: it names its item or says what the item does.
pub const FORBIDDEN_STARTS: &[&str] = &["What", "Who", "Where", "Whether", "How"];

/// Lines, from 1, on which a doc comment begins with a word of [`FORBIDDEN_STARTS`].
pub fn forbidden_starts(text: &str) -> Vec<(usize, &str)> {
    let mut found = Vec::new();
    let mut before = "";
    for (index, line) in text.lines().enumerate() {
        let line = line.trim_start();
        let marker = ["///", "//!"].into_iter().find(|marker| line.starts_with(marker));
        if let Some(marker) = marker {
            let first = line[marker.len()..].split_whitespace().next().unwrap_or("");
            let word = first.trim_matches(|c: char| !c.is_alphabetic());
            if !before.starts_with(marker) && FORBIDDEN_STARTS.contains(&word) {
                found.push((index + 1, line));
            }
        }
        before = line;
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_first_line_of_a_comment_counts() {
        let text =
            "/// Where it is.\n/// What it is.\nfn f() {}\n/// A place.\n/// How it looks.\n";
        assert_eq!(forbidden_starts(text), [(1, "/// Where it is.")]);
    }
}
