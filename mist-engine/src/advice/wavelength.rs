//! Wavelengths that look like nanometres where micrometres are read.

use mist_format::number::whole_number;

use super::{
    origin::Element,
    reading::{Reading, ReadingSource, Unit},
};
use crate::Job;

/// The models are used for light from 0.1 to some 20 µm: 100 µm are rather 100 nm.
const LONGEST_UM: f64 = 100.0;

/// The wavelengths of the model and of the section COLOR.
pub(super) fn readings(job: &Job) -> Vec<Reading<'_>> {
    let model = job.plan.entries.iter().filter_map(|entry| {
        let name = entry.parameter_name()?;
        if name.rsplit('.').next() != Some("lambda") {
            return None;
        }
        let text = &job.plan.program.variables[entry.variable].value;
        let source = match entry.slot {
            Some(slot) => ReadingSource::Slot(slot),
            None => ReadingSource::Number(whole_number(text.as_str())?),
        };
        Some(reading(name.to_owned(), text, source))
    });
    let colour = job.plan.colour.as_ref().and_then(|colour| {
        let placed = &colour.wavelength;
        Some(reading("wavelength".into(), placed.text.as_ref()?, ReadingSource::Expr(&placed.expr)))
    });
    model.chain(colour).collect()
}

fn reading<'j>(
    what: String,
    text: &'j mist_format::program::SourceText,
    source: ReadingSource<'j>,
) -> Reading<'j> {
    let (unit, element) = (Unit::Micrometres, Element::Last);
    Reading { what, unit, text, source, element, most: LONGEST_UM, extreme: 0.0 }
}
