//! Reads `.mtab` (`MIST-TABLE 1`).

use mist_engine::colour::{
    Albedo, ColourRow, ColourTable, RowOrder, RowPatch, Symmetry, TableAxis,
};

use super::{
    error::ReadError,
    text::{HeaderLine, TextTable},
};
use crate::column;

/// Reads `.mtab` text.
///
/// X and Z of the rows are 0 where the text has no columns for them, and no row has a spectrum.
///
/// # Errors
///
/// If the text is not a table, is truncated or was changed.
pub fn mtab(text: &str) -> Result<ColourTable, ReadError> {
    let text = TextTable::parse(text)?;
    let mut table = describe(&text)?;
    let columns = MtabColumns::find(&text, table.leading.len(), table.stokes)?;
    table.rows = text.rows.iter().map(|row| columns.row(row)).collect::<Result<_, _>>()?;
    Ok(table)
}

/// The header as a table without rows.
pub(super) fn describe(text: &TextTable<'_>) -> Result<ColourTable, ReadError> {
    let thetai = text.column("thetai")?;
    Ok(ColourTable {
        material: text.owned("material")?,
        quantity: text.owned("quantity")?,
        incident: text.line("incident")?.numbers()?,
        frame: text.owned("frame")?,
        wavelengths: wavelengths(text.line("wavelengths")?)?,
        interpolation: text.owned("interpolation")?,
        illuminant: text.owned("illuminant")?,
        observer: text.owned("observer")?,
        space: space(text.line("space")?)?,
        adaptation: text.owned("adaptation")?,
        white: text.line("white")?.numbers()?,
        layout: layout(text)?,
        patch: patch(text.line("patch")?)?,
        leading: text.columns[..thetai].iter().map(|&name| name.to_owned()).collect(),
        stokes: stokes(text),
        rows: Vec::new(),
        albedo: text.lines("albedo").map(albedo).collect::<Result<_, _>>()?,
        warnings: Vec::new(),
    })
}

/// Number of Stokes components with columns of their own.
fn stokes(text: &TextTable<'_>) -> usize {
    let has = |name| text.columns.contains(&name);
    match (has("RQ"), has("RV")) {
        (false, _) => 1,
        (true, false) => 3,
        (true, true) => 4,
    }
}

/// `FIRST STEP LAST nm` or `list W1 … WN nm`.
fn wavelengths(line: HeaderLine<'_>) -> Result<Vec<f64>, ReadError> {
    let list = line.value.strip_suffix("nm").ok_or_else(|| line.error("the unit nm is missing"))?;
    if let Some(list) = list.strip_prefix("list") {
        return list.split_ascii_whitespace().map(|word| line.parse(word)).collect();
    }
    let words = list.split_ascii_whitespace().map(|word| line.parse(word));
    let [first, step, last]: [f64; 3] =
        words.collect::<Result<Vec<_>, _>>()?.try_into().map_err(|_| {
            line.error("expected the first wavelength, the step and the last wavelength")
        })?;
    let steps = ((last - first) / step).round();
    if !(0.0..MAX_WAVELENGTHS).contains(&steps) {
        return Err(line.error("the steps do not lead from the first to the last"));
    }
    Ok((0..=steps as usize).map(|i| first + i as f64 * step).collect())
}

/// Maximum number of wavelengths; limits the memory for an invalid step.
const MAX_WAVELENGTHS: f64 = 1e6;

fn space(line: HeaderLine<'_>) -> Result<String, ReadError> {
    let name = line.value.strip_suffix(" linear");
    name.map(str::to_owned).ok_or_else(|| line.error("only linear values are supported"))
}

fn layout(text: &TextTable<'_>) -> Result<RowOrder, ReadError> {
    let line = text.line("layout")?;
    match line.words().collect::<Vec<_>>()[..] {
        ["list", count] => {
            text.check_count(line.parse(count)?, "\"# layout\"")?;
            Ok(RowOrder::List)
        }
        ["grid"] => {
            let axes = text.lines("axis").map(axis).collect::<Result<Vec<_>, _>>()?;
            let product = axes.iter().try_fold(1_usize, |n, a| n.checked_mul(a.nodes.len()));
            text.check_count(product.unwrap_or(usize::MAX), "\"# axis\"")?;
            Ok(RowOrder::Grid { axes, symmetry: symmetry(text.line("symmetry")?)? })
        }
        _ => Err(line.error("expected \"list N\" or \"grid\"")),
    }
}

fn axis(line: HeaderLine<'_>) -> Result<TableAxis, ReadError> {
    let mut words = line.words();
    let (Some(name), Some(count)) = (words.next(), words.next()) else {
        return Err(line.error("expected a name, the number of nodes and the nodes"));
    };
    let nodes = words.map(|word| line.parse(word)).collect::<Result<Vec<f64>, _>>()?;
    if nodes.len() != line.parse::<usize>(count)? {
        return Err(line.error(format!("{} nodes where {count} are stated", nodes.len())));
    }
    Ok(TableAxis { name: name.to_owned(), nodes })
}

fn symmetry(line: HeaderLine<'_>) -> Result<Symmetry, ReadError> {
    match line.value {
        "mirror" => Ok(Symmetry::Mirror),
        "none" => Ok(Symmetry::None),
        _ => Err(line.error("expected \"mirror\" or \"none\"")),
    }
}

fn patch(line: HeaderLine<'_>) -> Result<RowPatch, ReadError> {
    Ok(match line.words().collect::<Vec<_>>()[..] {
        ["point"] => RowPatch::Point,
        ["cell"] => RowPatch::Cell,
        ["ring"] => RowPatch::Ring,
        ["circle", alpha] => RowPatch::Circle(line.parse(alpha)?),
        _ => RowPatch::Other(line.value.to_owned()),
    })
}

fn albedo(line: HeaderLine<'_>) -> Result<Albedo, ReadError> {
    let [thetai, r, g, b, intensity] = line.numbers()?;
    Ok(Albedo { thetai, rgb: [r, g, b], intensity })
}

/// The indices of the columns.
struct MtabColumns {
    leading: usize,
    patch: [usize; 4],
    colours: Vec<[usize; 4]>,
    xyz: Option<[usize; 3]>,
    flags: usize,
}

impl MtabColumns {
    fn find(text: &TextTable<'_>, leading: usize, stokes: usize) -> Result<Self, ReadError> {
        let colour = |at| -> Result<[usize; 4], ReadError> {
            let [r, g, b, i] = column::colour_names(at).map(|name| text.column(&name));
            Ok([r?, g?, b?, i?])
        };
        let [thetai, thetas, phis, omega] = column::PATCH.map(|name| text.column(name));
        let xyz = match column::XYZ.map(|name| text.column(name)) {
            [Ok(x), Ok(y), Ok(z)] => Some([x, y, z]),
            _ => None,
        };
        Ok(Self {
            leading,
            patch: [thetai?, thetas?, phis?, omega?],
            colours: (0..stokes).map(colour).collect::<Result<_, _>>()?,
            xyz,
            flags: text.column(column::FLAGS)?,
        })
    }

    fn row(&self, values: &[f64]) -> Result<ColourRow, ReadError> {
        let [thetai, thetas, phis, omega] = self.patch.map(|at| values[at]);
        let mut row = ColourRow {
            leading: values[..self.leading].to_vec(),
            thetai,
            thetas,
            phis,
            omega,
            rgb: [[0.0; 3]; 4],
            xyz: [[0.0; 3]; 4],
            spectra: Default::default(),
            flags: values[self.flags] as u8,
        };
        for ((rgb, xyz), at) in row.rgb.iter_mut().zip(&mut row.xyz).zip(&self.colours) {
            let [r, g, b, i] = at.map(|at| values[at]);
            *rgb = [r, g, b];
            xyz[1] = i;
        }
        if let Some(at) = self.xyz {
            row.xyz[0] = at.map(|at| values[at]);
        }
        Ok(row)
    }
}
