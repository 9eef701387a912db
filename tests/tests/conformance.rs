//! Every conformance program gives NIST's tables in compat mode.

use mist_engine::Failure;
use mist_tests::{
    compare::{Tolerance, masked_listing, tables},
    corpus::{self, Case},
};
use rayon::prelude::*;
use scattering::Mode;

/// Compares the outcome of one program with NIST's files; the error is the first difference.
fn judge(case: &Case) -> Result<(), String> {
    let folder = corpus::folder();
    let outcome = corpus::run(&folder, case, Mode::Compat);
    match (case.kind.as_str(), outcome) {
        ("error" | "hang", Err(Failure::Program(_) | Failure::Step { .. } | Failure::Limit(_))) => {
            Ok(())
        }
        ("error" | "hang", _) => Err("not refused".into()),
        (_, Err(failure)) => Err(failure.to_string()),
        (_, Ok((sink, _))) => case.files.iter().try_for_each(|file| {
            let want = corpus::expected(&folder, case, &file.name);
            match file.role.as_str() {
                "listing" if masked_listing(&sink.listing) == masked_listing(&want) => Ok(()),
                "listing" => Err("the listing differs".into()),
                "samples" => tables(&sink.samples, &want, SAMPLES),
                _ if case.kind == "mc" => monte_carlo(case, &sink.results),
                _ => tables(&sink.results, &want, tolerance(case)),
            }
            .map_err(|why: String| format!("{}: {why}", file.name))
        }),
    }
}

/// Samples files have six digits, and rounding noise where x, y or z is zero.
const SAMPLES: Tolerance =
    Tolerance { relative: 2e-5, of_row: 1e-6, header_lines: 1, loop_columns: 0 };

fn tolerance(case: &Case) -> Tolerance {
    Tolerance {
        relative: case.rtol,
        of_row: case.atol_frac,
        header_lines: case.header_lines,
        loop_columns: case.loop_columns,
    }
}

/// Every value lies within six standard deviations of NIST's mean.
fn monte_carlo(case: &Case, results: &str) -> Result<(), String> {
    let rows = results.lines().skip(1).filter(|line| !line.is_empty());
    for (row, known) in rows.zip(&case.mc) {
        let last = row.trim_end_matches('\t').rsplit('\t').next().unwrap_or("");
        let value: f64 = last.trim().parse().map_err(|_| format!("{last:?} is not a number"))?;
        if (value - known.mean).abs() > 6.0 * known.sigma {
            return Err(format!("{value} is not {} ± 6·{}", known.mean, known.sigma));
        }
    }
    Ok(())
}

/// Programs whose error depends on the file system; the tests of the command line run them.
const ABOUT_THE_DISK: &[&str] = &["v_err_files_unwritable"];

fn all_pass(area: impl Fn(&str) -> bool + Sync) {
    let cases: Vec<Case> = corpus::cases(&corpus::folder())
        .into_iter()
        .filter(|case| area(&case.area) && !ABOUT_THE_DISK.contains(&case.name.as_str()))
        .collect();
    assert!(!cases.is_empty(), "no programs of this area");
    let failures: Vec<String> = cases
        .par_iter()
        .filter_map(|case| {
            let why = judge(case).err()?;
            Some(format!("{} ({}): {why}", case.name, case.area))
        })
        .collect();
    assert!(failures.is_empty(), "{} of {}:\n{}", failures.len(), cases.len(), failures.join("\n"));
}

macro_rules! areas {
    ($($test:ident: $prefix:literal,)*) => {
        $(
            #[test]
            fn $test() {
                all_pass(|area| area.starts_with($prefix));
            }
        )*

        #[test]
        fn no_area_is_forgotten() {
            let known = [$($prefix),*];
            for case in corpus::cases(&corpus::folder()) {
                assert!(known.iter().any(|p| case.area.starts_with(p)), "{}", case.area);
            }
        }
    };
}

areas! {
    wrong_programs_are_refused: "errors/",
    the_language_means_what_nist_computes: "language/",
    models_give_nists_tables: "models/",
    polarization_is_carried_across_apertures: "polarization/",
    sampling_agrees_with_nist: "sampling/",
    shapes_are_sampled_as_nist_does: "shapes/",
    spectra_agree: "spectral",
    tables_and_optical_constants_are_read_as_nist_does: "tables/",
}
