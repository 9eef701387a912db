//! Tokens and names, as NIST's program reads them, in a text without comments.
//!
//! A comment goes from `;` to the end of the line, also inside quotes. A *token* is a quoted
//! text or everything up to white space; a *name* is everything up to white space or `=`.

use super::text::SourceText;
use super::tree::Comment;
use crate::number::is_blank;
use crate::span::Span;

/// The number of words, numbers and signs in `text` without its comments: a measure of the work
/// of a program before it runs.
pub fn count_tokens(text: &str) -> usize {
    let is_word = |byte: u8| byte.is_ascii_alphanumeric() || b"_.".contains(&byte) || byte >= 0x80;
    let (mut count, mut in_word) = (0, false);
    for line in text.lines() {
        let code = line.split(';').next().unwrap_or_default();
        for byte in code.bytes() {
            let goes_on = in_word && is_word(byte);
            count += usize::from(!(is_blank(byte) || goes_on));
            in_word = is_word(byte);
        }
        in_word = false;
    }
    count
}

/// The text ends where more is expected. NIST's program waits forever in each of these cases.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum UnexpectedEnd {
    /// The text ends.
    End,
    /// The text ends inside the quotes that open here.
    OpenQuote(Span),
    /// A comment in the last line, which has no line end.
    OpenComment(Span),
}

/// A token with its irregularities.
#[derive(Clone, Debug)]
pub(super) struct LexedToken {
    pub(super) text: SourceText,
    /// Comments inside the quotes.
    pub(super) comments: Vec<Span>,
}

/// A name with its irregularities.
#[derive(Clone, Debug)]
pub(super) struct LexedName {
    pub(super) text: SourceText,
    /// An equal sign before it.
    pub(super) equals: Option<Span>,
}

/// Reads a text from the beginning to the end.
#[derive(Debug)]
pub(super) struct Lexer<'t> {
    text: &'t str,
    at: usize,
    comments: Vec<Comment>,
    open_comment: Option<Span>,
}

impl<'t> Lexer<'t> {
    pub(super) fn new(text: &'t str) -> Self {
        Self { text, at: 0, comments: Vec::new(), open_comment: None }
    }

    /// The text after the current position.
    pub(super) fn rest(&self) -> &'t str {
        &self.text[self.at..]
    }

    pub(super) fn at(&self) -> usize {
        self.at
    }

    /// Moves to a position; comments after it are read again.
    pub(super) fn go_to(&mut self, at: usize) {
        self.at = at;
        self.open_comment = None;
        self.comments.truncate(self.comments.partition_point(|comment| comment.span.start < at));
    }

    pub(super) fn into_comments(self) -> Vec<Comment> {
        self.comments
    }

    /// Skips white space and comments; true if something follows.
    pub(super) fn skip_blanks(&mut self) -> bool {
        while self.peek().is_some_and(is_blank) {
            self.at += 1;
        }
        self.peek().is_some()
    }

    /// Reads a token.
    pub(super) fn token(&mut self) -> Result<LexedToken, UnexpectedEnd> {
        if !self.skip_blanks() {
            return Err(self.stop());
        }
        if self.peek() == Some(b'"') {
            return self.quoted();
        }
        let text = self.word(is_blank);
        Ok(LexedToken { text, comments: Vec::new() })
    }

    /// Reads a name.
    pub(super) fn name(&mut self) -> Result<LexedName, UnexpectedEnd> {
        let mut equals = None;
        while let Some(byte) = self.peek().filter(|byte| is_blank(*byte) || *byte == b'=') {
            if byte == b'=' && equals.is_none() {
                equals = Some(Span::new(self.at, self.at + 1));
            }
            self.at += 1;
        }
        if self.peek().is_none() {
            return Err(self.stop());
        }
        Ok(LexedName { text: self.word(|byte| is_blank(byte) || byte == b'='), equals })
    }

    /// Moves past the next `=`; gives the span of other text before it, which is ignored.
    pub(super) fn equals(&mut self) -> Result<Option<Span>, UnexpectedEnd> {
        let mut junk: Option<Span> = None;
        while let Some(byte) = self.peek() {
            let here = Span::new(self.at, self.at + 1);
            self.at += 1;
            match byte {
                b'=' => return Ok(junk),
                byte if is_blank(byte) => {}
                _ => junk = Some(junk.map_or(here, |junk| junk.to(here))),
            }
        }
        Err(self.stop())
    }

    /// The reason why nothing follows.
    pub(super) fn stop(&self) -> UnexpectedEnd {
        self.open_comment.map_or(UnexpectedEnd::End, UnexpectedEnd::OpenComment)
    }

    /// Everything up to a byte that ends it, or to a comment, which reaches to a line end.
    fn word(&mut self, ends: impl Fn(u8) -> bool) -> SourceText {
        let start = self.at;
        let rest = &self.text.as_bytes()[start..];
        let len = rest.iter().position(|byte| ends(*byte) || *byte == b';').unwrap_or(rest.len());
        self.at += len;
        SourceText::new(&self.text[start..self.at], start)
    }

    fn quoted(&mut self) -> Result<LexedToken, UnexpectedEnd> {
        let quote = self.at;
        self.at += 1;
        let mut text = String::new();
        let mut pieces = vec![(0, self.at)];
        let mut comments = Vec::new();
        let mut piece = self.at;
        loop {
            match self.text.as_bytes().get(self.at) {
                None => return Err(UnexpectedEnd::OpenQuote(Span::new(quote, quote + 1))),
                Some(b'"') => break,
                Some(b';') => {
                    text.push_str(&self.text[piece..self.at]);
                    let from = self.at;
                    if self.peek().is_none() {
                        return Err(UnexpectedEnd::OpenQuote(Span::new(quote, quote + 1)));
                    }
                    comments.push(Span::new(from, self.at));
                    piece = self.at;
                    pieces.push((text.len(), piece));
                }
                Some(_) => self.at += 1,
            }
        }
        text.push_str(&self.text[piece..self.at]);
        self.at += 1;
        Ok(LexedToken {
            text: SourceText::read(text, Span::new(quote, self.at), true, pieces),
            comments,
        })
    }

    /// The next byte outside of comments; comments before it are recorded.
    fn peek(&mut self) -> Option<u8> {
        let bytes = self.text.as_bytes();
        if bytes.get(self.at) == Some(&b';') {
            let line = &self.text[self.at..];
            let Some(len) = line.find('\n') else {
                self.open_comment = Some(Span::new(self.at, self.text.len()));
                self.at = self.text.len();
                return None;
            };
            let text = line[1..len].trim_end_matches('\r').to_owned();
            let span = Span::new(self.at, self.at + 1 + text.len());
            let before = &self.text[..self.at];
            let line = &before[before.rfind('\n').map_or(0, |at| at + 1)..];
            let own_line = line.trim().is_empty();
            self.comments.push(Comment { text, span, own_line });
            self.at += len;
        }
        bytes.get(self.at).copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_numbers_and_signs_outside_of_comments_count() {
        assert_eq!(count_tokens("FOR t FROM 0 TO 1e3 BY 2.5 ; not this\na=-(b+c)"), 16);
        assert_eq!(count_tokens(" \n ; nothing"), 0);
    }

    fn tokens(text: &str) -> (Vec<String>, UnexpectedEnd) {
        let mut reader = Lexer::new(text);
        let mut found = Vec::new();
        loop {
            match reader.token() {
                Ok(token) => found.push(token.text.to_string()),
                Err(stop) => return (found, stop),
            }
        }
    }

    #[test]
    fn a_token_is_quoted_or_ends_at_white_space() {
        let (found, stop) = tokens("a \"b c\"d e\"f;x\n\"\"");
        assert_eq!(found, ["a", "b c", "d", "e\"f", ""]);
        assert_eq!(stop, UnexpectedEnd::End);
    }

    #[test]
    fn a_comment_cuts_words_and_strings_alike() {
        assert_eq!(tokens("a;b\nc").0, ["a", "c"]);
        let text = "\"a;b\nc\" ";
        let token = Lexer::new(text).token().unwrap();
        assert_eq!(token.text.as_str(), "a\nc");
        assert_eq!(token.comments[0].of(text), ";b");
        assert_eq!(token.text.locate(Span::new(2, 3)).of(text), "c");
    }

    #[test]
    fn names_end_at_equal_signs_and_skip_them() {
        let mut reader = Lexer::new(" = = a=b c");
        let name = reader.name().unwrap();
        assert_eq!((name.text.as_str(), name.equals), ("a", Some(Span::new(1, 2))));
        assert_eq!(reader.equals(), Ok(None));
        assert_eq!(reader.name().unwrap().text.as_str(), "b");
    }

    #[test]
    fn junk_before_an_equal_sign_has_a_span() {
        let text = "c junk words = 5";
        let mut reader = Lexer::new(text);
        reader.name().unwrap();
        assert_eq!(reader.equals().unwrap().unwrap().of(text), "junk words");
    }

    #[test]
    fn open_quotes_and_comments_are_reported() {
        assert_eq!(tokens("\"ab").1, UnexpectedEnd::OpenQuote(Span::new(0, 1)));
        assert_eq!(tokens("a ;b").1, UnexpectedEnd::OpenComment(Span::new(2, 4)));
    }

    #[test]
    fn comments_are_kept_without_line_ends() {
        let mut reader = Lexer::new("; one\r\na ; two\n");
        while reader.token().is_ok() {}
        let texts: Vec<_> = reader.into_comments().into_iter().map(|c| c.text).collect();
        assert_eq!(texts, [" one", " two"]);
    }
}
