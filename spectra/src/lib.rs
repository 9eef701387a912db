//! Spectra, CIE colorimetry and RGB spaces.
