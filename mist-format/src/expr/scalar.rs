//! The short program of an expression of single numbers, used by nearly all evaluations.
//!
//! Where no name holds a vector and no parenthesis holds a list, frames and lists of the general
//! machine (`eval.rs`) stay empty; what is left are operations on a short stack whose top is in a
//! register. The general machine takes over wherever that does not hold, and finds the errors.

use super::functions::Function;
use super::memo::Memo;
use super::op::{Action, Op, Operation};
use super::scope::{Scope, signed};
use crate::number::whole_number;

/// Numbers below the top that a program may need.
const DEPTH: usize = 16;

/// An operation; "the top" is the number in the register.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Code {
    /// Pushes a number.
    Number(f64),
    /// Pushes the variable in this slot.
    Variable(u32),
    /// Changes the sign of the top.
    Negate,
    /// Takes the number below the top and the top.
    Binary(Op),
    /// Takes the top and a number.
    WithNumber(Op, f64),
    /// Takes the top and a variable.
    WithVariable(Op, u32),
    /// Pushes what a variable and a number give.
    OfNumber(Op, u32, f64),
    /// Pushes what two variables give.
    OfVariable(Op, u32, u32),
    /// A function of the top.
    One(Function),
    /// A function of the top whose values are worth remembering.
    Slow(Function),
    /// A function of the number below the top and the top.
    Two(Function),
    /// The same with three.
    Three(Function),
    /// A look-up in a file with the top, and with the column if it is given.
    File { file: u32, with_column: bool, library: bool },
}

/// The short program of `steps` with these files and slots of names, if they have one.
pub(super) fn shorten(steps: &[Operation], files: &[String], slots: &[u32]) -> Option<Vec<Code>> {
    let mut writer =
        ScalarCompiler { code: Vec::new(), frames: vec![Vec::new()], depth: 0, files, slots };
    for step in steps {
        writer.step(step.action)?;
    }
    let done = writer.frames.len() == 1 && writer.frames[0] == [Operand::Value];
    done.then_some(writer.code)
}

/// An operand of the general machine: on its stack, or moved to its lists.
#[derive(Clone, Copy, PartialEq)]
enum Operand {
    Value,
    Listed,
}

struct ScalarCompiler<'a> {
    code: Vec<Code>,
    /// The operands of each open frame, in the order of pushing.
    frames: Vec<Vec<Operand>>,
    /// The number of numbers on the stack, in all frames.
    depth: usize,
    files: &'a [String],
    slots: &'a [u32],
}

impl ScalarCompiler<'_> {
    fn step(&mut self, action: Action) -> Option<()> {
        match action {
            Action::Number(x) => self.push(Code::Number(x)),
            Action::Variable { name, negative, .. } => {
                self.push(Code::Variable(self.slots[name as usize]))?;
                self.negate_if(negative);
                Some(())
            }
            Action::Binary(op) => self.binary(op),
            Action::Comma => {
                let nested = self.frames.len() > 1;
                let last = self.frames.last_mut()?.last_mut()?;
                if !nested || *last == Operand::Listed {
                    return None;
                }
                *last = Operand::Listed;
                Some(())
            }
            Action::Open => {
                self.frames.push(Vec::new());
                Some(())
            }
            Action::Group { negative, .. } => {
                self.close(1)?;
                self.negate_if(negative);
                Some(())
            }
            Action::Call { function, negative, .. } => {
                let function = function?;
                self.close(function.arity())?;
                self.code.push(match function.arity() {
                    1 if function.is_slow() => Code::Slow(function),
                    1 => Code::One(function),
                    2 => Code::Two(function),
                    _ => Code::Three(function),
                });
                self.negate_if(negative);
                Some(())
            }
            Action::File { file, negative, library } => {
                let arguments = self.frames.last()?.len();
                if arguments > 2 || whole_number(&self.files[file as usize]).is_some() {
                    return None;
                }
                self.close(arguments)?;
                self.code.push(Code::File { file, with_column: arguments == 2, library });
                self.negate_if(negative);
                Some(())
            }
            Action::BareFile { .. } => None,
        }
    }

    fn push(&mut self, code: Code) -> Option<()> {
        self.frames.last_mut()?.push(Operand::Value);
        self.depth += 1;
        self.code.push(code);
        (self.depth <= DEPTH).then_some(())
    }

    fn negate_if(&mut self, negative: bool) {
        if negative {
            self.code.push(Code::Negate);
        }
    }

    fn binary(&mut self, op: Op) -> Option<()> {
        let frame = self.frames.last_mut()?;
        let [.., Operand::Value, Operand::Value] = frame[..] else { return None };
        frame.pop();
        self.depth -= 1;
        let code = match self.code.last()? {
            Code::Number(x) => Code::WithNumber(op, *x),
            Code::Variable(slot) => Code::WithVariable(op, *slot),
            _ => {
                self.code.push(Code::Binary(op));
                return Some(());
            }
        };
        self.code.pop();
        let code = match (self.code.last(), code) {
            (Some(Code::Variable(left)), Code::WithNumber(op, x)) => Code::OfNumber(op, *left, x),
            (Some(Code::Variable(left)), Code::WithVariable(op, right)) => {
                Code::OfVariable(op, *left, right)
            }
            _ => {
                self.code.push(code);
                return Some(());
            }
        };
        self.code.pop();
        self.code.push(code);
        Some(())
    }

    /// Ends a frame of one value and `count` − 1 listed ones; it is one operand from now on.
    fn close(&mut self, count: usize) -> Option<()> {
        let frame = self.frames.pop()?;
        let (first, rest) = frame.split_first()?;
        let listed = rest.iter().all(|operand| *operand == Operand::Listed);
        if *first == Operand::Listed || !listed || frame.len() != count {
            return None;
        }
        self.depth -= count - 1;
        self.frames.last_mut()?.push(Operand::Value);
        Some(())
    }
}

/// Runs a short program; none where a name is unknown or holds a vector, or a look-up fails.
pub(super) fn run(
    code: &[Code],
    files: &[String],
    scope: &mut impl Scope,
    memo: &mut Memo,
) -> Option<f64> {
    let mut stack = [0.0; DEPTH];
    let (mut top, mut height) = (f64::NAN, 0);
    for code in code {
        match *code {
            Code::Number(x) => {
                stack[height] = top;
                height += 1;
                top = x;
            }
            Code::Variable(slot) => {
                stack[height] = top;
                height += 1;
                top = scope.number(slot)?;
            }
            Code::Negate => top = signed(top, true),
            Code::Binary(op) => {
                height -= 1;
                top = op.apply(stack[height], top);
            }
            Code::WithNumber(op, x) => top = op.apply(top, x),
            Code::WithVariable(op, slot) => top = op.apply(top, scope.number(slot)?),
            Code::OfNumber(op, slot, x) => {
                stack[height] = top;
                height += 1;
                top = op.apply(scope.number(slot)?, x);
            }
            Code::OfVariable(op, left, right) => {
                stack[height] = top;
                height += 1;
                top = op.apply(scope.number(left)?, scope.number(right)?);
            }
            Code::One(function) => top = function.of_one(top),
            Code::Slow(function) => top = memo.value(function, top),
            Code::Two(function) => {
                height -= 1;
                top = function.of_two(stack[height], top);
            }
            Code::Three(function) => {
                height -= 2;
                top = function.of_three(stack[height], stack[height + 1], top);
            }
            Code::File { file, with_column, library } => {
                let (mut x, mut column) = (top, 2);
                if with_column {
                    height -= 1;
                    (x, column) = (stack[height], top as i64);
                }
                if library && column < 2 {
                    return None;
                }
                top = scope.table(&files[file as usize], x, column).ok()?;
            }
        }
    }
    Some(top)
}
