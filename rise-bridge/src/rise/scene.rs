//! The text of a RISE scene: its chunks, and replacement of chunks.

use std::ops::Range;

use crate::export::ExportError;

const FIRST_LINE: &str = "RISE ASCII SCENE";
/// The beginning of a comment for mist.
const MARK: &str = "mist:";

/// One chunk: a keyword and lines between braces.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SceneChunk {
    /// The keyword, such as `ggx_material`.
    pub keyword: String,
    /// Names and values in their order; names may repeat.
    pub lines: Vec<(String, String)>,
    /// Names and values of comments `# mist: NAME = VALUE`, in their order.
    pub notes: Vec<(String, String)>,
    /// Its range in the text, keyword and braces included.
    pub span: Range<usize>,
    /// The line of its keyword, from 1.
    pub line: usize,
}

impl SceneChunk {
    /// The last value of `name`.
    pub fn get(&self, name: &str) -> Option<&str> {
        self.lines.iter().rev().find(|(this, _)| this == name).map(|(_, value)| value.as_str())
    }

    /// The name of the chunk; empty if it has none.
    pub fn name(&self) -> &str {
        self.get("name").unwrap_or_default()
    }
}

/// The chunks of `text`, in their order.
///
/// # Errors
///
/// If the text is not a RISE scene; the error names the line.
pub fn chunks(text: &str) -> Result<Vec<SceneChunk>, ExportError> {
    if !text.starts_with(FIRST_LINE) {
        let problem = format!("the first line is not \"{FIRST_LINE} 7\"");
        return Err(ExportError::refused("scene", problem));
    }
    let (mut found, mut open): (Vec<SceneChunk>, Option<SceneChunk>) = Default::default();
    let mut waiting: Option<(String, usize, usize)> = None;
    let (mut at, mut in_comment) = (0, false);
    for (number, line) in text.split_inclusive('\n').enumerate().map(|(k, l)| (k + 1, l)) {
        let (start, end) = (at, at + line.len());
        at = end;
        let wrong = |problem: &str| {
            ExportError::refused(&format!("scene, line {number}"), problem.to_owned())
        };
        let bare = uncommented(line, &mut in_comment);
        let (code, comment) = bare.split_once('#').unwrap_or((&bare, ""));
        if let Some(note) = comment.trim().strip_prefix(MARK)
            && let Some(chunk) = &mut open
        {
            let (name, value) =
                note.split_once('=').ok_or_else(|| wrong("expected # mist: NAME = VALUE"))?;
            chunk.notes.push((name.trim().to_owned(), value.trim().to_owned()));
        }
        match (code.trim(), number) {
            ("", _) | (_, 1) => {}
            ("{", _) => {
                let (keyword, start, line) =
                    waiting.take().ok_or_else(|| wrong("an opening brace without a keyword"))?;
                let (lines, notes) = Default::default();
                open = Some(SceneChunk { keyword, lines, notes, span: start..end, line });
            }
            ("}", _) => {
                let mut chunk =
                    open.take().ok_or_else(|| wrong("a closing brace without an opening brace"))?;
                chunk.span.end = end;
                found.push(chunk);
            }
            (code, _) => match &mut open {
                Some(chunk) => {
                    let (name, value) = code.split_once(char::is_whitespace).unwrap_or((code, ""));
                    chunk.lines.push((name.to_owned(), value.trim().to_owned()));
                }
                None => waiting = Some((code.to_owned(), start, number)),
            },
        }
    }
    match open {
        Some(chunk) => {
            let part = format!("scene, line {}", chunk.line);
            Err(ExportError::refused(&part, format!("{} is never closed", chunk.keyword)))
        }
        None => Ok(found),
    }
}

/// `line` without comments between /* and */; `inside` is true inside a comment that spans lines.
fn uncommented(line: &str, inside: &mut bool) -> String {
    let (mut kept, mut rest) = (String::new(), line);
    loop {
        let mark = if *inside { "*/" } else { "/*" };
        let Some((before, after)) = rest.split_once(mark) else {
            if !*inside {
                kept += rest;
            }
            return kept;
        };
        if !*inside {
            kept += before;
        }
        *inside = !*inside;
        rest = after;
    }
}

/// `text` with the ranges of `pieces` replaced; ranges do not overlap.
pub fn replaced(text: &str, mut pieces: Vec<(Range<usize>, String)>) -> String {
    pieces.sort_by_key(|(span, _)| span.start);
    let (mut out, mut at) = (String::new(), 0);
    for (span, new) in pieces {
        out += &text[at..span.start];
        out += &new;
        at = span.end;
    }
    out + &text[at..]
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCENE: &str = "RISE ASCII SCENE 7\n# a comment\nggx_material\n{\n\tname\tm # own\n\
        \t# mist: model = Facet_BRDF_Model\n/* off\n\tior 9\n*/\n\tior\t1.5\n}\n\nfilm\n{\nwidth 4\n}\n";

    #[test]
    fn chunks_have_their_lines_and_comments_for_mist() {
        let found = chunks(SCENE).unwrap();
        assert_eq!(found.len(), 2);
        assert_eq!((found[0].name(), found[0].get("ior")), ("m", Some("1.5")));
        assert_eq!(found[0].notes, [("model".to_owned(), "Facet_BRDF_Model".to_owned())]);
        assert!(SCENE[found[0].span.clone()].starts_with("ggx_material"));
        let without = replaced(SCENE, vec![(found[0].span.clone(), "X\n".into())]);
        assert!(without.contains("# a comment\nX\n\nfilm") && !without.contains("ggx"));
    }

    #[test]
    fn invalid_scenes_are_refused_with_the_line() {
        assert!(chunks("film\n{\n}\n").is_err());
        let open = "RISE ASCII SCENE 7\nfilm\n{\nwidth 4\n";
        assert!(chunks(open).unwrap_err().to_string().contains("line 2"));
        assert!(chunks("RISE ASCII SCENE 7\n}\n").is_err());
    }
}
