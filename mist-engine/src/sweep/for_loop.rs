//! `FOR v FROM a TO b BY s`.
//!
//! The value is accumulated: a, b and s are evaluated whenever they are used, with the
//! variables of the step that just ended. The first value is never tested.

use mist_format::{
    Diagnostic,
    expr::Expr,
    number,
    program::{ForLoop, SourceText},
};

use super::{EntryContent, LoopContext, LoopWrite};
use crate::{
    fault::{Fault, placed},
    quirk::Quirk,
    scope::Memo,
    step::LoopCell,
};

/// A FOR loop as compiled.
pub(crate) struct ForPlan {
    pub(crate) statement: ForLoop,
    /// The entry of VARIABLES that it writes.
    pub(crate) entry: usize,
    /// Name of its column.
    pub(crate) title: String,
    /// Whether the entry is a text for the model, shown as it is written.
    pub(crate) is_text: bool,
    pub(crate) from: Expr,
    pub(crate) to: Expr,
    pub(crate) by: Expr,
    /// Whether a bound reads results of earlier steps, so that it may come to an end later.
    pub(crate) fed_back: bool,
}

/// Where a FOR loop stands.
pub(crate) struct ForState {
    value: f64,
    fraction: f64,
    /// How often it was advanced since it was started.
    at: usize,
    cell: LoopCell,
    /// What was made of the first values: a loop that is started again mostly has the same ones.
    made: Vec<PreparedValue>,
    bounds: LoopBounds,
}

/// What is made of a value.
#[derive(Clone)]
struct PreparedValue {
    /// Of the value.
    bits: u64,
    /// What is written into the entry.
    content: EntryContent,
    /// What is shown.
    cell: LoopCell,
}

/// What the expressions of a, b and s gave last.
#[derive(Default)]
struct LoopBounds {
    from: Option<Memo<f64>>,
    to: Option<Memo<f64>>,
    by: Option<Memo<f64>>,
}

/// Values of which a loop keeps what was made.
const KEPT: usize = 1 << 12;

fn bound(
    known: &mut Option<Memo<f64>>,
    (text, expr): (&SourceText, &Expr),
    context: &mut LoopContext<'_>,
) -> Result<f64, Fault> {
    if let Some(known) = known
        && known.holds(context.scope, expr.slots())
    {
        return Ok(known.value);
    }
    let value = context.scope.number(expr, context.stack).map_err(|error| {
        let known: Vec<&str> = context.scope.defined().map(|s| context.names.name(s)).collect();
        placed(text, error.diagnostic(known))
    })?;
    *known = Some(Memo::new(context.scope, value));
    Ok(value)
}

impl ForState {
    pub(crate) fn start(plan: &ForPlan, context: &mut LoopContext<'_>) -> Result<Self, Fault> {
        let mut state = Self {
            value: f64::NAN,
            fraction: 0.0,
            at: 0,
            cell: LoopCell::Text("".into()),
            made: Vec::new(),
            bounds: LoopBounds::default(),
        };
        state.restart(plan, context)?;
        Ok(state)
    }

    /// Goes to the first value.
    pub(crate) fn restart(
        &mut self,
        plan: &ForPlan,
        context: &mut LoopContext<'_>,
    ) -> Result<(), Fault> {
        self.value = bound(&mut self.bounds.from, (&plan.statement.from, &plan.from), context)?;
        (self.fraction, self.at) = (0.0, 0);
        Ok(())
    }

    /// Goes to the next value; false when it lies behind the last one.
    pub(crate) fn advance(
        &mut self,
        plan: &ForPlan,
        context: &mut LoopContext<'_>,
    ) -> Result<bool, Fault> {
        let before = self.value;
        let by = bound(&mut self.bounds.by, (&plan.statement.by, &plan.by), context)?;
        self.value += by;
        let from = bound(&mut self.bounds.from, (&plan.statement.from, &plan.from), context)?;
        let to = bound(&mut self.bounds.to, (&plan.statement.to, &plan.to), context)?;
        self.fraction = (self.value - from) / (to - from);
        let inside = if Quirk::LostNegativeEnd.applies_in(context.mode) {
            // The factors are NIST's; a negative end moves the wrong way.
            if to > from {
                self.value <= to * 1.00000000001
            } else {
                self.value >= to * 0.999999999999
            }
        } else {
            let slack = 1e-6 * by.abs();
            if to > from { self.value <= to + slack } else { self.value >= to - slack }
        };
        if inside && !plan.fed_back {
            let approaches = if to > from { by > 0.0 } else { by < 0.0 };
            if !approaches || self.value == before {
                return Err(endless(plan, from, to, by));
            }
        }
        self.at += usize::from(inside);
        Ok(inside)
    }

    /// What its column shows.
    pub(crate) fn cell(&self) -> &LoopCell {
        &self.cell
    }

    pub(crate) fn fraction(&self) -> f64 {
        self.fraction
    }

    /// Writes the value into its entry and its column.
    pub(crate) fn write(&mut self, plan: &ForPlan, written: &mut Vec<LoopWrite>) {
        let bits = self.value.to_bits();
        let before = self.made.get(self.at).filter(|made| made.bits == bits).cloned();
        let made = before.unwrap_or_else(|| {
            let made = PreparedValue::of(self.value, plan.is_text);
            match self.made.get_mut(self.at) {
                Some(before) => *before = made.clone(),
                None if self.at < KEPT => self.made.push(made.clone()),
                None => {}
            }
            made
        });
        self.cell = made.cell;
        written.push(LoopWrite { entry: plan.entry, content: made.content });
    }
}

impl PreparedValue {
    fn of(value: f64, is_text: bool) -> Self {
        let number = if is_text { None } else { number::reread(value) };
        let text = || number::loop_text(value);
        let cell = if is_text { LoopCell::Text(text().into()) } else { LoopCell::of(value) };
        let content =
            number.map_or_else(|| EntryContent::Text(text().into()), EntryContent::Number);
        Self { bits: value.to_bits(), content, cell }
    }
}

fn endless(plan: &ForPlan, from: f64, to: f64, by: f64) -> Fault {
    let message =
        format!("this loop never ends: from {from} in steps of {by} it does not pass {to}");
    let help = if from == to {
        "for a single value assign it in VARIABLES, or write BY -1".to_owned()
    } else {
        format!(
            "give BY the sign of the way from {from} to {to}, and a size that changes the value"
        )
    };
    Box::new(
        Diagnostic::error("loop/endless", plan.statement.span, message)
            .help(help)
            .note("NIST's program repeats this loop forever"),
    )
}
