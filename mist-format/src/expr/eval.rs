//! Running the postfix program of an expression.

use super::compiled::CompiledExpr;
use super::error::{EvalError, EvalErrorKind};
use super::memo::Memo;
use super::op::Action;
use super::scope::{Scope, signed};
use crate::number;
use crate::table::TableError;

/// Working memory of evaluations; reuse it, so that they need none of their own.
#[derive(Clone, Debug, Default)]
pub struct OperandStack {
    values: Vec<f64>,
    lists: Vec<f64>,
    frames: Vec<StackFrame>,
    arguments: Vec<f64>,
    pub(super) memo: Memo,
}

#[derive(Clone, Copy, Debug)]
struct StackFrame {
    values: usize,
    lists: usize,
}

impl OperandStack {
    /// First element and the others of the value of `expr`.
    pub(super) fn run(
        &mut self,
        expr: &CompiledExpr,
        scope: &mut impl Scope,
    ) -> Result<(f64, &[f64]), EvalError> {
        self.values.clear();
        self.lists.clear();
        self.frames.clear();
        for step in &expr.steps {
            self.step(expr, scope, step.action)
                .map_err(|kind| EvalError { span: step.span, kind })?;
        }
        let first = self.values.last().copied();
        Ok((first.unwrap_or(f64::NAN), &self.lists))
    }

    fn step(
        &mut self,
        expr: &CompiledExpr,
        scope: &mut impl Scope,
        action: Action,
    ) -> Result<(), EvalErrorKind> {
        match action {
            Action::Number(x) => self.values.push(x),
            Action::Variable { name, negative, only_scalar } => {
                let elements = scope.variable(expr.slots[name as usize]);
                let Some([first, rest @ ..]) = elements else {
                    let name = expr.names[name as usize].clone();
                    return Err(EvalErrorKind::UnknownName { name });
                };
                if let (Some(deviation), false) = (only_scalar, rest.is_empty()) {
                    return Err(EvalErrorKind::Vector { deviation });
                }
                self.values.push(signed(*first, negative));
                self.lists.extend(rest.iter().map(|x| signed(*x, negative)));
            }
            Action::Binary(op) => {
                let (b, a) = (self.pop(), self.pop());
                self.values.push(op.apply(a, b));
            }
            Action::Comma => {
                let right = self.pop();
                self.lists.push(right);
            }
            Action::Open => {
                self.frames.push(StackFrame { values: self.values.len(), lists: self.lists.len() });
            }
            Action::Group { negative, only_scalar } => {
                let frame = self.close();
                if let (Some(deviation), true) = (only_scalar, self.lists.len() > frame.lists) {
                    return Err(EvalErrorKind::Vector { deviation });
                }
                if negative {
                    self.lists[frame.lists..].iter_mut().for_each(|x| *x = -*x);
                }
                let first = self.pop();
                self.values.truncate(frame.values);
                self.values.push(signed(first, negative));
            }
            Action::Call { function, call, negative } => {
                self.take_arguments();
                let value = function.and_then(|function| function.apply(&self.arguments));
                let Some(value) = value else {
                    let name = expr.calls[call as usize].clone();
                    let arguments = self.arguments.len();
                    return Err(EvalErrorKind::UnknownFunction { name, arguments });
                };
                self.values.push(signed(value, negative));
            }
            Action::File { file, negative, library } => {
                self.take_arguments();
                let value = self.look_up(&expr.files[file as usize], library, scope)?;
                self.values.push(signed(value, negative));
            }
            Action::BareFile { file } => {
                let file = expr.files[file as usize].clone();
                return Err(EvalErrorKind::FileArguments { file, arguments: 0 });
            }
        }
        Ok(())
    }

    fn look_up(
        &self,
        file: &str,
        library: bool,
        scope: &mut impl Scope,
    ) -> Result<f64, EvalErrorKind> {
        let (x, column) = match self.arguments[..] {
            [x] => (x, 2),
            [x, column] => (x, column as i64),
            _ => {
                let arguments = self.arguments.len();
                return Err(EvalErrorKind::FileArguments { file: file.into(), arguments });
            }
        };
        let failed = |error| EvalErrorKind::Table { file: file.into(), error };
        if library && column < 2 {
            return Err(failed(TableError::MissingColumn { column, columns: None }));
        }
        // A name that is itself a number is that number.
        match number::whole_number(file) {
            Some(constant) => Ok(constant),
            None => scope.table(file, x, column).map_err(failed),
        }
    }

    fn close(&mut self) -> StackFrame {
        self.frames.pop().unwrap_or(StackFrame { values: 0, lists: 0 })
    }

    /// Closes a frame; what it holds becomes the arguments.
    fn take_arguments(&mut self) {
        let frame = self.close();
        let first = self.pop();
        self.arguments.clear();
        self.arguments.push(first);
        self.arguments.extend(self.lists.drain(frame.lists..));
        self.values.truncate(frame.values);
    }

    fn pop(&mut self) -> f64 {
        // The scan never takes more than it has pushed.
        self.values.pop().unwrap_or(f64::NAN)
    }
}
