//! The results of a run as CSV and as JSON; the text itself is the table that programs write.

use serde_json::{Value, json};

/// A table of results, cell by cell.
pub struct Results<'a> {
    headers: Vec<&'a str>,
    names: Vec<&'a str>,
    rows: Vec<Vec<&'a str>>,
}

impl<'a> Results<'a> {
    /// Reads the text of a run whose program has so many header lines.
    pub fn read(text: &'a str, header_lines: usize) -> Self {
        let mut lines = text.lines();
        let headers = lines.by_ref().take(header_lines).collect();
        let names = tabbed(lines.next().unwrap_or(""));
        let rows = lines.map(|line| cells(line, names.len())).collect();
        Self { headers, names, rows }
    }

    /// Names, then rows, separated by commas (RFC 4180).
    pub fn csv(&self) -> String {
        let mut text = String::new();
        for row in std::iter::once(&self.names).chain(&self.rows) {
            let cells: Vec<String> = row.iter().map(|cell| quoted(cell)).collect();
            text.push_str(&cells.join(","));
            text.push_str("\r\n");
        }
        text
    }

    /// `{"headers": […], "columns": […], "rows": [[…], …]}`; cells that are not numbers are texts.
    pub fn json(&self) -> Value {
        let row = |row: &Vec<&str>| row.iter().map(|cell| value(cell)).collect::<Value>();
        json!({
            "headers": self.headers,
            "columns": self.names,
            "rows": self.rows.iter().map(row).collect::<Vec<_>>(),
        })
    }
}

fn tabbed(line: &str) -> Vec<&str> {
    line.strip_suffix('\t').unwrap_or(line).split('\t').map(str::trim).collect()
}

/// The cells of a row; a program's own format may separate them by other means than tabs.
fn cells(line: &str, count: usize) -> Vec<&str> {
    let cells = tabbed(line);
    if cells.len() == count {
        return cells;
    }
    let words: Vec<&str> =
        line.split([' ', '\t', ',', ';']).filter(|word| !word.is_empty()).collect();
    if words.len() == count { words } else { cells }
}

fn quoted(cell: &str) -> String {
    if cell.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", cell.replace('"', "\"\""))
    } else {
        cell.to_owned()
    }
}

fn value(cell: &str) -> Value {
    match cell.parse::<f64>() {
        Ok(x) if x.is_finite() => json!(x),
        _ => json!(cell),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_keep_their_columns_in_every_form() {
        let text = "a title\nthetai\tR\tname\t\n0\t      0.5\tx,y\t\n10\t      nan\tz\t\n";
        let results = Results::read(text, 1);
        assert_eq!(results.csv(), "thetai,R,name\r\n0,0.5,\"x,y\"\r\n10,nan,z\r\n");
        let json = results.json();
        assert_eq!(json["headers"], json!(["a title"]));
        assert_eq!(json["rows"], json!([[0.0, 0.5, "x,y"], [10.0, "nan", "z"]]));
    }

    #[test]
    fn a_format_without_tabs_is_split_at_its_blanks() {
        let results = Results::read("a\tb\t\n1, 2\n", 0);
        assert_eq!(results.json()["rows"], json!([[1.0, 2.0]]));
    }
}
