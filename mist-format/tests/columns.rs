//! Layouts of data files as other programs write them: read where the meaning is certain, refused
//! with their line otherwise.

use mist_format::Dialect;
use mist_format::table::{ColumnTable, TableError};

fn rows(text: &str) -> Vec<Vec<f64>> {
    let table = ColumnTable::parse(text, Dialect::Sound).unwrap_or_else(|e| panic!("{text}: {e}"));
    table.rows().map(<[f64]>::to_vec).collect()
}

fn error(text: &str) -> TableError {
    ColumnTable::parse(text, Dialect::Sound).expect_err(text)
}

#[test]
fn every_certain_layout_gives_the_same_rows() {
    let expected = [[0.45, 1.55, 0.01], [0.5, 1.54, 0.012], [0.55, 1.53, 0.015]];
    for text in [
        "wl n k\n0.45 1.55 0.01\n0.5 1.54 0.012\n0.55 1.53 0.015\n",
        "wl,n,k\n0.45,1.55,0.01\n0.5,1.54,0.012\n0.55,1.53,0.015",
        "0.45, 1.55, 0.01\r\n0.5,1.54,0.012\r\n0.55, 1.53,0.015\r\n",
        "0.45,1.55,0.01,\n0.5,1.54,0.012,\n0.55,1.53,0.015,\n",
        "wl;n;k\n0.45;1.55;0.01\n0.5;1.54;0.012\n0.55;1.53;0.015\n",
        "Wellenlaenge;n;k\n0,45;1,55;0,01\n0,5;1,54;0,012\n0,55;1,53;0,015\n",
        "\"wl\",\"n\",\"k\"\n\"0.45\",\"1.55\",\"0.01\"\n\"0.5\",\"1.54\",\"0.012\"\n0.55,1.53,0.015\n",
        "# wl n k\n0.45 1.55 0.01 # note\n0.5 1.54 0.012 # 2 notes\n0.55 1.53 0.015 ; note\n",
        "\u{feff}0.45\t1.55\t0.01\n\n0.5\t1.54\t0.012\n0.55\t1.53\t0.015\n",
        "25C 633nm\n0.45 1.55 0.01\n0.5 1.54 0.012\n0.55 1.53 0.015\n",
        "wl,n\n0.45,1.55\n0.5,1.54\n0.55,1.53\n\nwl,k\n0.45,0.01\n0.5,0.012\n0.55,0.015\n",
        "0.45 1.55 0.01 of gold\nremark\n0.5 1.54 0.012\n0.55 1.53 0.015\n",
    ] {
        assert_eq!(rows(text), expected, "{text}");
    }
}

#[test]
fn rows_that_lack_numbers_are_refused_with_their_line() {
    let sopra = error("2 .45 .65 4\n1.50 0.01\n1.60 0.02\n");
    assert_eq!(sopra, TableError::ShortRow { line: 2, found: 2, expected: 4, first: 1 });
    assert!(sopra.to_string().contains("line 2: 2 numbers, but line 1 has 4"), "{sopra}");
    let missing = error("wl n k\n0.4 1.5 0\n0.5 1.5\n");
    assert_eq!(missing, TableError::ShortRow { line: 3, found: 2, expected: 3, first: 2 });
}

#[test]
fn texts_of_uncertain_meaning_are_refused_with_their_line() {
    for (text, line) in [
        ("0,45 1,55\n0,5 1,54\n", 1),
        ("wl n k\n0,45\t1,55\t0,01\n", 2),
        ("0,45,1,55\n0,50,1,54\n", 1),
    ] {
        assert!(
            matches!(error(text), TableError::DecimalComma { line: l, .. } if l == line),
            "{text}: {}",
            error(text)
        );
    }
    let unit = error("0.45um 1.55\n0.5um 1.54\n");
    assert!(matches!(unit, TableError::Refused { line: 1, .. }), "{unit}");
    for text in [
        "wl,n\n0.4,1.5\n0.5,1.4\nwl,n\n0.4,1.6\n",
        "wl,n\n0.4,1.5\n0.5,1.4\nwl,k\n0.4,1.6\n0.6,0.1\n",
    ] {
        assert_eq!(error(text), TableError::SecondTable { line: 4 }, "{text}");
    }
}

#[test]
fn compat_reads_what_nists_program_reads() {
    let table = |text| ColumnTable::parse(text, Dialect::Compat).unwrap();
    assert_eq!(table("2 .45 .65 4\n1.50 0.01\n").rows().len(), 1);
    assert_eq!(table("0.4,1.5,0\n").columns(), 1);
    assert_eq!(table("0.45;1.55\n").columns(), 1);
}
