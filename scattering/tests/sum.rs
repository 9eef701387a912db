//! Sums of models against NIST's library.

mod reference;

#[test]
fn sums_of_models_agree_with_the_library() {
    reference::check(&[
        "Two_Source_BRDF_Model",
        "Three_Source_BRDF_Model",
        "Four_Source_BRDF_Model",
    ]);
}
