//! `FOR v FROM a TO b BY s`.
//!
//! The value is accumulated: a, b and s are evaluated whenever they are used, with the
//! variables of the step that just ended. The first value is never tested.

use mist_format::{Diagnostic, number};
use scattering::Mode;

use super::content::{EntryContent, LoopContext, LoopWrite};
use crate::{deviation::EngineDeviation, fault::Fault, plan::ForPlan, step::LoopCell};

/// The position of a FOR loop.
pub(crate) struct ForState {
    value: f64,
    fraction: f64,
    /// Number of advances since the loop was started.
    at: usize,
    cell: LoopCell,
    /// The memo of the first values, by number of advances: a loop that starts again mostly has
    /// the same ones.
    prepared: Vec<PreparedValue>,
}

/// The texts and numbers made of a value.
#[derive(Clone)]
struct PreparedValue {
    /// The bits of the value.
    bits: u64,
    content: EntryContent,
    cell: LoopCell,
}

/// The largest number of prepared values of one loop.
const PREPARED: usize = 1 << 12;

impl ForState {
    pub(crate) fn start(plan: &ForPlan, context: &mut LoopContext<'_, '_>) -> Result<Self, Fault> {
        let mut state = Self {
            value: f64::NAN,
            fraction: 0.0,
            at: 0,
            cell: LoopCell::Text("".into()),
            prepared: Vec::new(),
        };
        state.restart(plan, context)?;
        Ok(state)
    }

    /// Goes to the first value.
    pub(crate) fn restart(
        &mut self,
        plan: &ForPlan,
        context: &mut LoopContext<'_, '_>,
    ) -> Result<(), Fault> {
        self.value = context.values.number(plan.from, &plan.statement.from)?;
        (self.fraction, self.at) = (0.0, 0);
        Ok(())
    }

    /// Goes to the next value; false when it lies behind the last one.
    pub(crate) fn advance(
        &mut self,
        plan: &ForPlan,
        context: &mut LoopContext<'_, '_>,
    ) -> Result<bool, Fault> {
        let before = self.value;
        let by = context.values.number(plan.by, &plan.statement.by)?;
        let from = context.values.number(plan.from, &plan.statement.from)?;
        let to = context.values.number(plan.to, &plan.statement.to)?;
        let intervals = if context.ends_only { ((to - from) / by + 1e-6).floor() } else { 1.0 };
        self.value += if intervals > 1.0 { by * intervals } else { by };
        self.fraction = (self.value - from) / (to - from);
        let inside = if EngineDeviation::LostNegativeEnd.applies_in(context.mode) {
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

    /// The content of its column.
    pub(crate) fn cell(&self) -> &LoopCell {
        &self.cell
    }

    pub(crate) fn fraction(&self) -> f64 {
        self.fraction
    }

    /// Writes the value into its entry and, if it `shows`, into its column.
    pub(crate) fn write(
        &mut self,
        plan: &ForPlan,
        (mode, shows): (Mode, bool),
        written: &mut Vec<LoopWrite>,
    ) {
        let bits = self.value.to_bits();
        let known = self.prepared.get(self.at).filter(|known| known.bits == bits).cloned();
        let PreparedValue { content, cell, .. } = known.unwrap_or_else(|| {
            let prepared = PreparedValue::new(self.value, plan.is_text, mode, shows);
            match self.prepared.get_mut(self.at) {
                Some(known) => *known = prepared.clone(),
                None if self.at < PREPARED => self.prepared.push(prepared.clone()),
                None => {}
            }
            prepared
        });
        self.cell = cell;
        written.push(LoopWrite { entry: plan.entry, content });
    }
}

impl PreparedValue {
    /// Under compat the entry gets the number that NIST's program reads in a text of sixteen
    /// digits. A value that is not finite is written as text, which is not a number: the step is
    /// refused.
    fn new(x: f64, is_text: bool, mode: Mode, shows: bool) -> Self {
        let number = match mode {
            _ if is_text => None,
            Mode::Compat => number::reread(x),
            Mode::Sound => Some(x).filter(|x| x.is_finite()),
        };
        let text = || number::loop_text(x);
        let cell = match shows {
            true if is_text => LoopCell::Number(x, text().into()),
            true => LoopCell::of(x),
            false => LoopCell::Number(x, "".into()),
        };
        let content = number
            .map_or_else(|| EntryContent::Text(text().into()), |x| EntryContent::Value(x.into()));
        Self { bits: x.to_bits(), content, cell }
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
