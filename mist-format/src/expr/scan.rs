//! The scan that turns a text into a postfix program: an operand, then an operator, and so on.
//!
//! Blanks: one is skipped behind an operator and one before an operand; a sign is looked for
//! only then; the number reader skips any number of them and takes one more sign. One blank is
//! skipped behind an operand, one more behind a bare name, and one before an operator; what
//! follows is the next operand, even if it looks like an operator.

mod frame;
mod interner;
mod letters;
mod rules;

pub(super) use rules::Rules;

use super::compiled::CompiledExpr;
use super::error::{ExprError, ExprErrorKind};
use super::functions::Function;
use super::limits::MAX_TOKENS;
use super::op::{Action, Op, Operation};
use super::scalar;
use crate::dialect::TextDeviation;
use crate::number::{is_blank, number_prefix, unit_length, without_unit};
use crate::span::Span;
use frame::{FrameKind, OpenFrame};
use interner::Interner;
use letters::{begins_name, begins_operand, continues_name};

pub(super) fn compile(text: &str, rules: Rules) -> Result<CompiledExpr, ExprError> {
    let mut scan = Scan::new(text, rules);
    if let Err((start, end, kind)) = scan.run() {
        return Err(ExprError { span: scan.span(start, end), kind });
    }
    let slots: Vec<u32> = (0..scan.names.list.len() as u32).collect();
    let (names, files, calls) = (scan.names.list, scan.files.list, scan.calls.list);
    let steps = scan.steps;
    let short = scalar::shorten(&steps, &files, &slots);
    Ok(CompiledExpr { text: text.to_owned(), steps, short, names, slots, files, calls })
}

/// An error between two positions of the scanned bytes.
type ScanError = (usize, usize, ExprErrorKind);

/// The next item of the scan.
enum Next {
    Operand,
    Operator,
    Nothing,
}

struct Scan<'t> {
    text: &'t str,
    /// The text, for the library without white space.
    bytes: Vec<u8>,
    /// Offset of each byte in the text; empty if they are equal to the indices.
    places: Vec<usize>,
    rules: Rules,
    at: usize,
    tokens: usize,
    /// The whole expression.
    top: OpenFrame,
    /// Open parentheses.
    open: Vec<OpenFrame>,
    steps: Vec<Operation>,
    names: Interner,
    files: Interner,
    calls: Interner,
}

impl<'t> Scan<'t> {
    fn new(text: &'t str, rules: Rules) -> Self {
        let (bytes, places) = if rules.library {
            let kept = text.bytes().enumerate().filter(|(_, byte)| !is_blank(*byte));
            kept.map(|(place, byte)| (byte, place)).unzip()
        } else {
            (text.as_bytes().to_vec(), Vec::new())
        };
        Self {
            text,
            bytes,
            places,
            rules,
            at: 0,
            tokens: 0,
            top: OpenFrame::new(FrameKind::Group, false, 0, 0),
            open: Vec::new(),
            steps: Vec::new(),
            names: Interner::default(),
            files: Interner::default(),
            calls: Interner::default(),
        }
    }

    fn run(&mut self) -> Result<(), ScanError> {
        let mut next = Next::Operand;
        loop {
            next = match next {
                Next::Operand => self.operand()?,
                Next::Operator if self.ends() => self.close()?,
                Next::Operator => self.operator()?,
                Next::Nothing => return Ok(()),
            }
        }
    }

    /// Reads an operand, or opens a parenthesis whose inside follows.
    fn operand(&mut self) -> Result<Next, ScanError> {
        self.skip_blank();
        let start = self.at;
        let negative = self.sign(start)?;
        if self.peek() == Some(b'(') {
            return self.open(FrameKind::Group, negative, start);
        }
        let signed = self.at > start;
        let read = number_prefix(&self.bytes[self.at..]);
        let from = self.at + read.start;
        self.at += read.taken;
        if let Some(value) = read.value {
            self.push(Action::Number(if negative { -value } else { value }), start)?;
            if read.sign == Some(b'-') && !signed {
                self.check_power_of_signed(from)?;
            }
            return Ok(Next::Operator);
        }
        if !self.peek().is_some_and(begins_name) {
            return Err(self.no_operand(from, read.has_body()));
        }
        if read.has_body() && self.rules.refuses(TextDeviation::NumberJunk) {
            return Err(self.refused(TextDeviation::NumberJunk, from, self.at));
        }
        if read.sign == Some(b'-') && self.rules.refuses(TextDeviation::SignLost) {
            return Err(self.refused(TextDeviation::SignLost, from, from + 1));
        }
        self.name(negative, start)
    }

    /// Takes a sign directly before an operand. A minus that begins a frame is `0 -`; true if a
    /// minus elsewhere belongs to the operand.
    fn sign(&mut self, start: usize) -> Result<bool, ScanError> {
        let sign = self.peek().filter(|byte| matches!(byte, b'+' | b'-'));
        self.at += usize::from(sign.is_some());
        let minus = sign == Some(b'-');
        if minus && self.frame().values == 0 {
            self.push(Action::Number(0.0), start)?;
            self.push_operator(Op::Subtract, start)?;
            return Ok(false);
        }
        Ok(minus)
    }

    /// `  -2^2`: the minus belongs to the number although it begins the expression.
    fn check_power_of_signed(&self, minus: usize) -> Result<(), ScanError> {
        let behind = self.bytes[self.at..].iter().find(|byte| !is_blank(**byte));
        let odd = self.frame().values == 1 && behind == Some(&b'^');
        if odd && self.rules.refuses(TextDeviation::SignBindsToNumber) {
            return Err(self.refused(TextDeviation::SignBindsToNumber, minus, self.at));
        }
        Ok(())
    }

    /// The error of a missing operand; `from` is the start of the search for a number.
    fn no_operand(&self, from: usize, unfinished: bool) -> ScanError {
        let text = || String::from_utf8_lossy(&self.bytes[from..self.at]).into_owned();
        if unfinished {
            (from, self.at, ExprErrorKind::InvalidNumber { text: text() })
        } else if self.ends() {
            (self.at, self.at, ExprErrorKind::MissingValue)
        } else if self.peek() == Some(b')') {
            (self.at, self.at + 1, ExprErrorKind::Parentheses { opening: false })
        } else {
            (self.at, self.at + 1, ExprErrorKind::InvalidValue { found: self.character() })
        }
    }

    /// A variable, a function with its arguments or a file with its arguments.
    fn name(&mut self, negative: bool, start: usize) -> Result<Next, ScanError> {
        let from = self.at;
        while self.peek().is_some_and(continues_name) {
            self.at += 1;
        }
        let name = String::from_utf8_lossy(&self.bytes[from..self.at]).into_owned();
        let end = self.at;
        self.skip_blank();
        let file = name.strip_prefix('@').map(str::to_owned);
        let called = self.peek() == Some(b'(');
        let empty = called && self.bytes.get(self.at + 1) == Some(&b')');
        if called && !empty {
            let kind = match file {
                Some(file) => FrameKind::File(self.files.intern(&file)),
                None => FrameKind::Call(self.calls.intern(&name)),
            };
            return self.open(kind, negative, start);
        }
        let after = self.at;
        let action = match file {
            Some(file) => Action::BareFile { file: self.files.intern(&file) },
            None => {
                let name = self.names.intern(&name);
                Action::Variable { name, negative, only_scalar: None }
            }
        };
        self.at = end;
        self.push(action, from)?;
        self.at = if empty { after + 2 } else { after };
        Ok(Next::Operator)
    }

    /// Reads an operator behind an operand that does not end its frame.
    fn operator(&mut self) -> Result<Next, ScanError> {
        let before = self.at;
        self.skip_blank();
        self.skip_blank();
        if let Some(op) = self.peek().and_then(Op::find) {
            self.push_operator(op, self.at)?;
            self.at += 1;
            self.skip_blank();
            return Ok(Next::Operand);
        }
        self.check_missing_operator(before)?;
        Ok(Next::Operand)
    }

    /// Checks a missing operator: the end, a lost operator, or an operand follows.
    fn check_missing_operator(&self, before: usize) -> Result<(), ScanError> {
        let blanks = self.bytes[self.at..].iter().take_while(|byte| is_blank(**byte)).count();
        let next = self.at + blanks;
        let found = self.bytes.get(next).copied();
        if found.is_none() || (found == Some(b')') && !self.open.is_empty()) {
            return Err((before, next, ExprErrorKind::TrailingBlank));
        }
        let is_operator = found.and_then(Op::find).is_some();
        if self.rules.library && !is_operator {
            let found = self.character_at(next);
            return Err((next, next + 1, ExprErrorKind::InvalidOperator { found }));
        }
        if is_operator && self.rules.refuses(TextDeviation::OperatorLostToBlanks) {
            return Err(self.refused(TextDeviation::OperatorLostToBlanks, next, next + 1));
        }
        if self.rules.refuses(TextDeviation::AdjacentOperands) {
            self.check_unit(before, next)?;
        }
        let is_operand = found.is_some_and(begins_operand);
        if is_operand && self.rules.refuses(TextDeviation::AdjacentOperands) {
            return Err(self.refused(TextDeviation::AdjacentOperands, next, next + 1));
        }
        Ok(())
    }

    /// Refuses a unit at `next` behind a number that ends at `before`.
    fn check_unit(&self, before: usize, next: usize) -> Result<(), ScanError> {
        let text = |bytes| std::str::from_utf8(bytes).unwrap_or_default();
        let digits = |byte: &u8| byte.is_ascii_digit() || *byte == b'.';
        let start = before - self.bytes[..before].iter().rev().take_while(|b| digits(b)).count();
        if start > 0 && continues_name(self.bytes[start - 1]) {
            return Ok(());
        }
        let length = unit_length(text(&self.bytes[next..]));
        let unit = text(&self.bytes[next..next + length]);
        match without_unit(text(&self.bytes[start..before]), unit) {
            Some(help) => Err((start, next + length, ExprErrorKind::Unit { help })),
            None => Ok(()),
        }
    }

    fn open(&mut self, kind: FrameKind, negative: bool, start: usize) -> Result<Next, ScanError> {
        let parenthesis = self.at;
        self.at += 1;
        self.add_step(Action::Open, start)?;
        self.open.push(OpenFrame::new(kind, negative, start, parenthesis));
        Ok(Next::Operand)
    }

    /// Ends the innermost frame; its value is an operand of the one around it.
    fn close(&mut self) -> Result<Next, ScanError> {
        self.reduce_above(0)?;
        self.bind_vectors();
        let Some(frame) = self.open.pop() else { return Ok(Next::Nothing) };
        if self.at == self.bytes.len() {
            let at = frame.parenthesis;
            return Err((at, at + 1, ExprErrorKind::Parentheses { opening: true }));
        }
        self.at += 1;
        let negative = frame.negative;
        let action = match frame.kind {
            FrameKind::Group => Action::Group { negative, only_scalar: None },
            FrameKind::Call(call) => {
                let function = Function::find(&self.calls.list[call as usize]);
                Action::Call { function, call, negative }
            }
            FrameKind::File(file) => Action::File { file, negative, library: self.rules.library },
        };
        self.push(action, frame.start)?;
        Ok(Next::Operator)
    }

    /// Marks the vectors of a frame whose operators, in the sound dialect, need numbers.
    fn bind_vectors(&mut self) {
        let Some(deviation) =
            self.frame().binding.filter(|deviation| self.rules.refuses(*deviation))
        else {
            return;
        };
        for step in std::mem::take(&mut self.frame_mut().vectors) {
            if let Action::Variable { only_scalar, .. } | Action::Group { only_scalar, .. } =
                &mut self.steps[step].action
            {
                *only_scalar = Some(deviation);
            }
        }
    }

    /// Adds a step that pushes an operand which began at `start`.
    fn push(&mut self, action: Action, start: usize) -> Result<(), ScanError> {
        if matches!(action, Action::Variable { .. } | Action::Group { .. }) {
            let step = self.steps.len();
            self.frame_mut().vectors.push(step);
        }
        self.frame_mut().values += 1;
        self.add_step(action, start)
    }

    fn push_operator(&mut self, op: Op, at: usize) -> Result<(), ScanError> {
        self.reduce_above(op.power())?;
        let frame = self.frame_mut();
        frame.pending.push((op, at));
        frame.binding = match (op, frame.binding) {
            (Op::Comma, None) => Some(TextDeviation::NestedLists),
            (Op::Comma, bound) => bound,
            _ => Some(TextDeviation::VectorArithmetic),
        };
        Ok(())
    }

    /// Adds the pending operators that bind at least as tightly as `power`.
    fn reduce_above(&mut self, power: u8) -> Result<(), ScanError> {
        while let Some((op, at)) = self.frame_mut().pending.pop_if(|top| top.0.power() >= power) {
            self.frame_mut().values -= 1;
            let action = if op == Op::Comma { Action::Comma } else { Action::Binary(op) };
            let end = std::mem::replace(&mut self.at, at + 1);
            self.add_step(action, at)?;
            self.at = end;
        }
        Ok(())
    }

    /// Adds a step for the bytes from `start` to here.
    fn add_step(&mut self, action: Action, start: usize) -> Result<(), ScanError> {
        self.tokens += 1;
        if self.tokens > MAX_TOKENS {
            return Err((start, self.at, ExprErrorKind::TooLong));
        }
        let span = self.span(start, self.at);
        self.steps.push(Operation { action, span });
        Ok(())
    }

    fn refused(&self, deviation: TextDeviation, start: usize, end: usize) -> ScanError {
        (start, end, ExprErrorKind::Refused { deviation })
    }

    fn frame(&self) -> &OpenFrame {
        self.open.last().unwrap_or(&self.top)
    }

    fn frame_mut(&mut self) -> &mut OpenFrame {
        self.open.last_mut().unwrap_or(&mut self.top)
    }

    fn peek(&self) -> Option<u8> {
        self.bytes.get(self.at).copied()
    }

    fn skip_blank(&mut self) {
        self.at += usize::from(self.peek().is_some_and(is_blank));
    }

    /// True if the frame ends here.
    fn ends(&self) -> bool {
        match self.peek() {
            None => true,
            Some(byte) => byte == b')' && !self.open.is_empty(),
        }
    }

    fn character(&self) -> char {
        self.character_at(self.at)
    }

    fn character_at(&self, at: usize) -> char {
        self.span(at, at + 1).of(self.text).chars().next().unwrap_or(char::REPLACEMENT_CHARACTER)
    }

    /// The span in the text of a range of scanned bytes, widened to whole characters.
    fn span(&self, start: usize, end: usize) -> Span {
        let place = |at: usize| match self.places.get(at) {
            Some(place) => *place,
            None if self.rules.library => self.text.len(),
            None => at.min(self.text.len()),
        };
        let mut first = place(start);
        let mut last = if end > start { place(end - 1) + 1 } else { first };
        while !self.text.is_char_boundary(first) {
            first -= 1;
        }
        while last < self.text.len() && !self.text.is_char_boundary(last) {
            last += 1;
        }
        Span::new(first, last.min(self.text.len()))
    }
}
