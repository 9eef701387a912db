//! Polarized scattering models: from the parameters of a material to Mueller matrices.
