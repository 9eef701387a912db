//! Programs with `integrationmode = 20`, and with none.

use std::sync::Arc;

use mist_engine::{Control, Failure, MemoryFiles, MemorySink, Options, RunSummary, compile};
use scattering::Mode;

const FACETS: &str = "MODEL = Facet_BRDF_Model
VARIABLES:
  incidentangle = 0.6  incidentpol = (1,0,0,0)  rotation = 0
  differential = 1e-3  minsamples = 100
  integrationmode = 20  tolerance = 1e-7  uncertainty = 1
  $sdf = Gaussian_Slope_Distribution_Function
  #sdf.s = 0.01
END
VARY: END
INTEGRALS:
  R = CIRCLE  CENTER = (0.6,0)  ALPHA = 0.1  END
  H = HEMI END
END
OUTPUTS: 1 total=H 2 R 3 sum=R+H 4 relative=R.error/R END
FILES: format = %.12e\\t END
";

pub(crate) fn run_in(mode: Mode, program: &str) -> Result<(MemorySink, RunSummary), Failure> {
    let options = Options { mode, ..Options::default() };
    let job =
        compile(program, Arc::new(MemoryFiles::default()), &options).map_err(Failure::Program)?;
    let mut sink = MemorySink::default();
    let summary = job.run(&mut sink, &Control::default())?;
    Ok((sink, summary))
}

pub(crate) fn run(program: &str) -> (MemorySink, RunSummary) {
    run_in(Mode::Sound, program).unwrap()
}

fn refused(program: &str) -> String {
    match run_in(Mode::Sound, program) {
        Err(Failure::Program(diagnostics)) => {
            diagnostics.iter().map(|d| format!("{d} {:?}\n", d.help)).collect()
        }
        other => panic!("{:?}", other.map(|(sink, _)| sink)),
    }
}

pub(crate) fn numbers(sink: &MemorySink, line: usize) -> Vec<f64> {
    let line = sink.results.lines().nth(line).unwrap();
    line.split('\t').filter(|cell| !cell.is_empty()).map(|cell| cell.parse().unwrap()).collect()
}

#[test]
fn the_column_of_an_error_follows_that_of_its_integral() {
    let (sink, _) = run(FACETS);
    let head = sink.results.lines().next().unwrap();
    assert_eq!(head, "total\tH.error\tR\tR.error\tsum\trelative");
    let row = numbers(&sink, 1);
    assert!(row[1] > 0.0 && row[1] <= 1e-7 * row[0], "{row:?}");
    assert!((row[5] - row[3] / row[2]).abs() < 1e-15, "{row:?}");
    let without = FACETS.replace("2 R 3 sum=R+H 4 relative=R.error/R", "2 sum=R+H");
    let (sink, _) = run(&without);
    assert_eq!(sink.results.lines().next().unwrap(), "total\tH.error\tsum\tR.error");
    let (sink, _) = run(&without.replace("uncertainty = 1", "uncertainty = 0"));
    assert_eq!(sink.results.lines().next().unwrap(), "total\tsum");
}

#[test]
fn under_compat_mode_20_has_exact_apertures_too() {
    let (sound, compat) = (run(FACETS).0, run_in(Mode::Compat, FACETS).unwrap().0);
    let (a, b) = (numbers(&sound, 1), numbers(&compat, 1));
    // The slope density of NIST's library has constants of twelve digits.
    assert!((a[0] - b[0]).abs() < 1e-11 && (a[2] - b[2]).abs() < 1e-11, "{a:?} {b:?}");
}

#[test]
fn a_grid_in_the_same_run_has_no_error() {
    let program = FACETS.replace("VARY:", "VARY: FOR integrationmode FROM 2 TO 20 BY 18 END");
    let (sink, _) = run(&program.replace("END END\nINTEGRALS", "END\nINTEGRALS"));
    let (grid, adaptive) = (numbers(&sink, 1), numbers(&sink, 2));
    assert!(grid[2].is_nan() && adaptive[2] > 0.0, "{}", sink.results);
}

#[test]
fn uncertainty_means_nothing_without_adaptive_integrals() {
    let grid = FACETS.replace("integrationmode = 20", "integrationmode = 2");
    let program = grid.replace("4 relative=R.error/R", "");
    let (sink, _) = run(&program.replace("uncertainty = 1", "uncertainty = 7"));
    assert_eq!(sink.results.lines().next().unwrap(), "total\tR\tsum");
}

#[test]
fn one_integration_serves_all_sixteen_elements() {
    let element = |i: usize, j: usize| {
        let unit = |k: usize| match k {
            0 => "(1,0,0,0)",
            1 => "(0,1,0,0)",
            2 => "(0,0,1,0)",
            _ => "(0,0,0,1)",
        };
        format!(
            "m{i}{j} = CIRCLE CENTER = (0.6,0) ALPHA = 0.1 POL = {} INPOL = {} END\n",
            unit(i),
            unit(j)
        )
    };
    let all: String = (0..16).map(|k| element(k / 4, k % 4)).collect();
    let integrals = "  R = CIRCLE  CENTER = (0.6,0)  ALPHA = 0.1  END\n  H = HEMI END\n";
    let outputs = "OUTPUTS: 1 total=H 2 R 3 sum=R+H 4 relative=R.error/R END";
    let one = FACETS.replace(integrals, &element(0, 0)).replace(outputs, "OUTPUTS: 1 m00 END");
    let sixteen = FACETS.replace(integrals, &all).replace(outputs, "OUTPUTS: 1 m00 2 m33 END");
    let ((one, spent_one), (sixteen, spent_sixteen)) = (run(&one), run(&sixteen));
    assert_eq!(spent_one.evaluations, spent_sixteen.evaluations);
    let (a, b) = (numbers(&one, 1), numbers(&sixteen, 1));
    assert_eq!((a[0], a[1]), (b[0], b[1]));
    assert!(b[2] < -0.1 * b[0] && b[3] > 0.0, "{b:?}");
}

#[test]
fn a_tolerance_out_of_reach_is_refused_with_what_was_reached() {
    let said =
        refused(&FACETS.replace("tolerance = 1e-7", "tolerance = 1e-9 maxevaluations = 3000"));
    for word in ["R: the tolerance 1e-9 is not reached", "evaluations", "maxevaluations"] {
        assert!(said.contains(word), "{said}");
    }
    for wrong in ["tolerance = 0", "tolerance = -1", "tolerance = 1e-6 maxevaluations = 1e99"] {
        let said = refused(&FACETS.replace("tolerance = 1e-7", wrong));
        assert!(said.contains("is not"), "{said}");
    }
    let said = refused(&FACETS.replace("uncertainty = 1", "uncertainty = 2"));
    assert!(said.contains("uncertainty = 2"), "{said}");
}

#[test]
fn the_samples_of_an_adaptive_integral_lie_in_its_aperture() {
    let program =
        FACETS.replace("FILES:", "FILES: samples = a.smp").replace("  H = HEMI END\n", "");
    let program = program.replace("1 total=H 2 R 3 sum=R+H 4", "1 R 2");
    let (sink, _) = run(&program);
    let mut count = 0;
    for line in sink.samples.lines().skip(1) {
        let cells: Vec<f64> = line.split('\t').map(|cell| cell.parse().unwrap()).collect();
        let cosine = cells[3] * 0.6_f64.sin() + cells[5] * 0.6_f64.cos();
        // Six digits of the components.
        assert!(cosine > 0.1_f64.cos() - 2e-6, "{line}");
        count += 1;
    }
    assert!(count > 500, "{count}");
}

#[test]
fn the_orders_of_a_grating_are_found_and_cut_exactly() {
    let program = |mode: &str, order: i32| {
        format!(
            "MODEL = RCW_BRDF_Model
            VARIABLES:
              incidentangle = 0.3  incidentpol = (1,0,0,0)  rotation = 0
              differential = 2e-6  minsamples = 100  {mode}
              #alpha = 0.003  %order = {order}
            END
            VARY: END
            INTEGRALS: H = HEMI END  cut = CIRCLE CENTER = (0.302,0) ALPHA = 0.002 END END
            OUTPUTS: 1 H 2 cut END
            FILES: format = %.12e\\t END"
        )
        .replace("%order", "#order")
    };
    let (adaptive, spent) = run(&program("integrationmode = 20  tolerance = 1e-8", 5));
    let (grid, _) = run(&program("integrationmode = 2", 5));
    let (a, g) = (numbers(&adaptive, 1), numbers(&grid, 1));
    // The grid sees a cone of 14 directions; its rim is worth a tenth of them.
    assert!(a[0] > 0.0 && (g[0] / a[0] - 1.0).abs() < 0.1, "{a:?} {g:?}");
    assert!((g[1] / a[1] - 1.0).abs() < 0.02, "{a:?} {g:?}");
    assert!(spent.evaluations < 1e6, "{}", spent.evaluations);
}

#[test]
fn without_a_mode_a_narrow_lobe_is_integrated_whatever_the_settings_of_a_grid_are() {
    let lobe = FACETS.replace("#sdf.s = 0.01", "#sdf.s = 0.05");
    let exact = numbers(&run(&lobe).0, 1)[0];
    let settings = "differential = 1e-3  minsamples = 100\n";
    let mode = "  integrationmode = 20  tolerance = 1e-7  uncertainty = 1";
    for grid in ["differential = 1  minsamples = 1", ""] {
        let program = lobe.replace(settings, grid).replace(mode, "\n  uncertainty = 1");
        let (sink, summary) = run(&program);
        let row = numbers(&sink, 1);
        assert!((row[0] - exact).abs() <= row[1] && row[1] <= 1e-5 * exact, "{row:?} {exact}");
        assert!(summary.warnings.is_empty(), "{:?}", summary.warnings);
    }
}

#[test]
fn a_grid_that_misses_a_lobe_is_told_with_the_adaptive_value() {
    let lobe = FACETS.replace("#sdf.s = 0.01", "#sdf.s = 0.05").replace("uncertainty = 1", "");
    let lobe = lobe.replace("4 relative=R.error/R", "").replace("tolerance = 1e-7", "");
    let grid = |differential: &str| {
        let settings = format!("differential = {differential}");
        let program = lobe.replace("integrationmode = 20", "integrationmode = 2");
        run(&program.replace("differential = 1e-3", &settings)).1.warnings
    };
    let told = grid("1");
    assert!(told.iter().any(|d| d.code == "integral/missed-lobe"), "{told:?}");
    let of_hemisphere = told.iter().find(|d| d.message.starts_with("H:")).unwrap();
    assert!(of_hemisphere.message.contains("3.6434"), "{of_hemisphere:?}");
    assert!(grid("1e-4").is_empty(), "{:?}", grid("1e-4"));
}

#[test]
fn an_error_above_the_default_tolerance_is_told_and_the_value_stands() {
    let program = FACETS.replace("integrationmode = 20  tolerance = 1e-7", "maxevaluations = 3000");
    let (sink, summary) = run(&program);
    let row = numbers(&sink, 1);
    assert!(row[0].is_finite() && row[1] > 1e-5 * row[0], "{row:?}");
    assert!(summary.warnings.iter().any(|d| d.code == "integral/accuracy"), "{summary:?}");
}

#[test]
fn a_grid_needs_its_settings_and_compat_keeps_the_grid() {
    let settings = "differential = 1e-3  minsamples = 100\n";
    let said = refused(
        &FACETS.replace(settings, "").replace("integrationmode = 20", "integrationmode = 2"),
    );
    assert!(said.contains("differential is missing"), "{said}");
    let plain = FACETS.replace("integrationmode = 20  tolerance = 1e-7  uncertainty = 1", "");
    let plain = plain.replace("4 relative=R.error/R", "");
    assert!(run_in(Mode::Compat, &plain.replace(settings, "")).is_err());
    let grid = plain.replace("#sdf.s", "integrationmode = 2\n  #sdf.s");
    let [a, b] = [&plain, &grid].map(|p| run_in(Mode::Compat, p).unwrap().0.results);
    assert_eq!(a, b);
}
