//! Writer of `.RISEdataBSDF`: means over rings for RISE.

use std::io::Write;

use mist_engine::{Control, material::PreparedMaterial};

use super::export::ExportRequest;
use crate::{export::ExportError, rise::product};

/// Nodes of each polar angle of a table for which none were asked: 2° apart.
const NODES: usize = 46;
/// Most nodes of each polar angle.
const MOST_NODES: usize = 181;

/// Writes the table.
pub(super) fn write(
    material: &PreparedMaterial,
    request: &ExportRequest,
    out: &mut dyn Write,
    control: &Control,
) -> Result<String, ExportError> {
    let filter = request.filter()?;
    let nodes = request.nodes.unwrap_or(NODES);
    if nodes > MOST_NODES {
        let problem = format!("{nodes}, more than {MOST_NODES}");
        return Err(ExportError::refused("nodes", problem));
    }
    let nm = request.wavelengths("380:10:780")?;
    let table = product::table_of(material, filter, nodes, &nm, control)?;
    out.write_all(&table.bytes())?;
    Ok(format!("{nodes}x{nodes} nodes, {} wavelengths", nm.len()))
}
