//! Visible differences: the probability that an observer sees, at each pixel, that two pictures
//! differ.
//!
//! [`detect`] is the visible differences predictor of Daly in the form for high dynamic range of
//! Mantiuk and others. Two pictures of luminances in cd/m², seen from a known distance, pass
//!
//! 1. the optics of the eye and the response of its receptors ([`FrontEnd`]),
//! 2. the contrast sensitivity S(ρ, θ) at the luminance to which the eye is adapted,
//! 3. the cortex: 31 channels c of spatial frequency and orientation, in which structure of the
//!    pictures masks their difference,
//!
//! $$ P_c = 1 - \exp\left[-\left(\frac{|t_c - r_c|}{m_c}\right)^{3.5}\right], \qquad
//!    P = 1 - \prod_c (1 - P_c), $$
//!
//! where t_c and r_c are the test and the reference in units of the threshold and m_c ≥ 1 is the
//! threshold elevation by structure. A map is summarized by the fraction of pixels with P > 0.75 and
//! P > 0.95 ([`DetectionMap::percent_above`]).
//!
//! Limits: luminance only. A difference of hue at equal luminance is not seen; [`colour`] and
//! [`flip`](mod@flip) cover it. Pictures are continued periodically: what leaves on the
//! right enters on the left. In [`FrontEnd::Daly1993`] the contrast is not calibrated, and
//! differences are about twelve times too visible.
//!
//! S. Daly, in *Digital Images and Human Vision*, ed. A. B. Watson (MIT Press, 1993), 179;
//! R. Mantiuk, S. Daly, K. Myszkowski, H.-P. Seidel, Proc. SPIE 5666, 204 (2005).
//!
//! ```
//! use pictures::visible::{Luminances, DetectorSettings, Viewing, detect};
//!
//! let wave = |contrast: f64| -> Vec<f64> {
//!     (0..64 * 64).map(|i| 50.0 * (1.0 + contrast * (i as f64 * 0.9).sin())).collect()
//! };
//! let [test, reference] = [0.05, 0.0].map(|c| Luminances::new(64, 64, wave(c)).unwrap());
//! let seen = detect(&test, &reference, &Viewing::default(), &DetectorSettings::default())?;
//! assert!(seen.percent_above(0.75) > 50.0);
//! # Ok::<(), pictures::visible::VisibleError>(())
//! ```

mod channel;
pub mod colour;
mod cortex;
mod detection;
mod error;
mod eye;
pub mod flip;
mod luminance;
mod sensitivity;
mod transform;
mod viewing;

pub use detection::{DetectionMap, DetectorSettings, FrontEnd, detect};
pub use error::{MOST_PIXELS, VisibleError};
pub use luminance::Luminances;
pub use viewing::Viewing;
