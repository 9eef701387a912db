//! Instrument signatures and tabulated standards against NIST's library.

mod reference;

use reference::check;

#[test]
fn scattering_by_air_agrees_with_the_library() {
    check(&["Rayleigh_Instrument_BRDF_Model"]);
}

#[test]
fn the_zernike_expansion_agrees_with_the_library() {
    check(&["ZernikeExpansion_BRDF_Model"]);
}
