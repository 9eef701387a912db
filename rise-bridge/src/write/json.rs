//! The colour table as JSON, with the keys of the text header and numbers that read back exactly.

use mist_engine::{
    Warning,
    colour::{ColourRow, ColourTable, RowOrder, TableAxis},
};
use serde::{Serialize, Serializer, ser::SerializeSeq};

use super::{
    error::WriteError,
    header::{GENERATOR, MAGIC, patch, symmetry},
    rows::finite,
};
use crate::column;

/// The document, in the order of the text header.
#[derive(Serialize)]
struct JsonTable<'a> {
    format: &'static str,
    generator: &'static str,
    material: &'a str,
    quantity: &'a str,
    incident: [f64; 4],
    frame: &'a str,
    wavelengths: &'a [f64],
    interpolation: &'a str,
    illuminant: &'a str,
    observer: &'a str,
    space: &'a str,
    adaptation: &'a str,
    white: [f64; 3],
    layout: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    symmetry: Option<&'static str>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    axis: Vec<JsonAxis<'a>>,
    patch: String,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    albedo: Vec<[f64; 5]>,
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    warnings: &'a [Warning],
    columns: Vec<String>,
    rows: JsonRows<'a>,
    end: usize,
}

#[derive(Serialize)]
struct JsonAxis<'a> {
    name: &'a str,
    nodes: &'a [f64],
}

/// JsonRows as arrays of numbers; the flags stay an integer.
struct JsonRows<'a> {
    table: &'a ColourTable,
    xyz: bool,
}

struct JsonRow<'a> {
    values: Vec<f64>,
    row: &'a ColourRow,
}

impl Serialize for JsonRows<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.table.rows.iter().map(|row| {
            let values = column::values(self.table, row, self.xyz);
            JsonRow { values, row }
        }))
    }
}

impl Serialize for JsonRow<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut seq = serializer.serialize_seq(Some(self.values.len() + 1))?;
        for value in &self.values {
            seq.serialize_element(value)?;
        }
        seq.serialize_element(&self.row.flags)?;
        seq.end()
    }
}

/// The table as one JSON document; `xyz` adds the columns X Y Z.
///
/// # Errors
///
/// If a number is not finite.
pub fn json(table: &ColourTable, xyz: bool) -> Result<String, WriteError> {
    let columns = column::names(table, xyz);
    for (i, row) in table.rows.iter().enumerate() {
        finite(i, &columns, &column::values(table, row, xyz))?;
    }
    let text = serde_json::to_string(&document(table, columns, xyz));
    Ok(text.expect("a document of numbers and text has a JSON form") + "\n")
}

fn document(table: &ColourTable, columns: Vec<String>, xyz: bool) -> JsonTable<'_> {
    let (layout, axes, half): (_, &[TableAxis], _) = match &table.layout {
        RowOrder::List => ("list", &[], None),
        RowOrder::Grid { axes, symmetry: half } => ("grid", axes, Some(symmetry(*half))),
    };
    JsonTable {
        format: MAGIC,
        generator: GENERATOR,
        material: &table.material,
        quantity: &table.quantity,
        incident: table.incident,
        frame: &table.frame,
        wavelengths: &table.wavelengths,
        interpolation: &table.interpolation,
        illuminant: &table.illuminant,
        observer: &table.observer,
        space: &table.space,
        adaptation: &table.adaptation,
        white: table.white,
        layout,
        symmetry: half,
        axis: axes.iter().map(|axis| JsonAxis { name: &axis.name, nodes: &axis.nodes }).collect(),
        patch: patch(&table.patch),
        albedo: table
            .albedo
            .iter()
            .map(|a| {
                let [r, g, b] = a.rgb;
                [a.thetai, r, g, b, a.intensity]
            })
            .collect(),
        warnings: &table.warnings,
        columns,
        rows: JsonRows { table, xyz },
        end: table.rows.len(),
    }
}
