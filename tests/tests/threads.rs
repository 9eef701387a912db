//! The bits of a table do not depend on the number of threads.

use mist_tests::corpus;
use rayon::ThreadPoolBuilder;
use scattering::Mode;

#[test]
fn tables_are_equal_to_the_last_bit_on_1_2_and_7_threads() {
    let folder = corpus::folder();
    // Every way of sampling, loops, sums, Monte Carlo and a spectral sweep.
    let wanted = [
        "v_shape_hemi_modes",
        "v_shape_circle_modes",
        "v_shape_annulus_modes",
        "v_shape_polygon_modes",
        "v_mc_hemi",
        "v_spec_paint",
        "v_lang_for_feedback",
        "v_three_source",
    ];
    let cases = corpus::cases(&folder);
    for name in wanted {
        let case = cases.iter().find(|case| case.name == name).expect("the program is there");
        for mode in [Mode::Compat, Mode::Sound] {
            let tables: Vec<String> = [1, 2, 7]
                .into_iter()
                .map(|threads| {
                    let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
                    let outcome = pool.install(|| corpus::run(&folder, case, mode));
                    outcome.unwrap_or_else(|e| panic!("{name}: {e}")).0.results
                })
                .collect();
            assert_eq!(tables[0], tables[1], "{name}, {mode:?}");
            assert_eq!(tables[0], tables[2], "{name}, {mode:?}");
        }
    }
}
