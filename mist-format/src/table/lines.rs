//! The lines of a file without comments.

/// A line without its comment.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SourceLine<'t> {
    pub(super) number: usize,
    pub(crate) text: &'t str,
    /// Offset of the text in the file.
    pub(super) start: usize,
    pub(super) ended: bool,
    commented: bool,
}

/// The lines of a file without comments.
pub(crate) fn lines(text: &str) -> impl Iterator<Item = SourceLine<'_>> {
    let mut start = 0;
    text.split_inclusive('\n').enumerate().map(move |(place, line)| {
        let ended = line.ends_with('\n');
        let body = line.trim_end_matches(['\n', '\r']);
        let comment = body.find(';');
        let text = &body[..comment.unwrap_or(body.len())];
        let found =
            SourceLine { number: place + 1, text, start, ended, commented: comment.is_some() };
        start += line.len();
        found
    })
}

/// The number of a last line with a comment but no line end; NIST's program never ends there.
pub(crate) fn open_comment(text: &str) -> Option<usize> {
    lines(text).last().filter(|line| line.commented && !line.ended).map(|line| line.number)
}
