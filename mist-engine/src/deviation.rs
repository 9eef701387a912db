//! Deviations of NIST's program from the expected behaviour, all layers in one list.
//!
//! The entries stand where they act: reading of texts in [`mist_format::TextDeviation`], running of
//! programs in [`EngineDeviation`], physics in [`scattering::Defect`]. [`all`] gathers them, and
//! [`chapter`] prints the chapter of the manual.

use mist_format::{Dialect, TextDeviation, dialect::SoundReading};
use scattering::{Defect, Mode};

/// Declares the deviations of the engine; the documentation of an entry and the text behind `=>`
/// are its row in the manual.
macro_rules! engine_deviations {
    ($($(#[doc = $doc:literal])+ $name:ident => $sound:literal,)*) => {
        /// A deviation in loops, parameters or apertures that only compat reproduces.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum EngineDeviation {
            $($(#[doc = $doc])+ $name,)*
        }

        impl EngineDeviation {
            /// All deviations, in the order of the manual.
            pub const ALL: &'static [Self] = &[$(Self::$name),*];

            /// Behaviour of NIST's program and of a sound run, as the manual states them.
            pub fn describe(self) -> (&'static str, &'static str) {
                match self {
                    $(Self::$name => (concat!($($doc),+).trim_ascii(), $sound),)*
                }
            }
        }
    };
}

engine_deviations! {
    /// `pi` and `deg` are not defined while VARIABLES is read for the first time.
    LateConstants => "defined everywhere, unless the program defines them",
    /// A FOR loop with a negative last value does not reach it: `FROM -3 TO -1 BY 1` ends at −2.
    LostNegativeEnd => "ends at −1",
    /// A sub-parameter keeps its default after its parent was replaced.
    NoResend => "it is set again",
    /// A loop over `incidentpol` changes the variable but not the incident light.
    FixedIncidentPolarization => "refused, unless INPOL reads it",
    /// Numbers for the model are read up to the first character that does not fit: `0.5um` is 0.5.
    NumericPrefix => "refused",
    /// `default` for a number of a nested object is read as a number: 0.
    NestedDefault => "the default",
    /// A changed interpolation or formula parameter of an index acts at the next wavelength only.
    StaleInterpolation => "it acts at once",
    /// Circles and the hemisphere are polygons of `polygonsides` edges, cut and shifted at the
    /// horizon.
    PolygonApertures => "exact outlines",
    /// Integrals are sums over a grid of `differential` and `minsamples`, whatever lies between its
    /// directions.
    GridIntegrals => "adaptive with a stated error; `integrationmode` asks for a grid",
}

impl EngineDeviation {
    /// True if `mode` reproduces it.
    pub fn applies_in(self, mode: Mode) -> bool {
        mode == Mode::Compat
    }
}

/// Dialect of texts in `mode`.
pub fn dialect(mode: Mode) -> Dialect {
    match mode {
        Mode::Sound => Dialect::Sound,
        Mode::Compat => Dialect::Compat,
    }
}

/// The part of a run in which a deviation acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DeviationLayer {
    /// Reading of programs and data files.
    Reading,
    /// Loops, parameters and apertures.
    Running,
    /// Models.
    Physics,
}

/// An entry of the list of all deviations.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Deviation {
    /// Its name in the sources and in the manual.
    pub id: String,
    /// The layer in which it acts.
    pub layer: DeviationLayer,
    /// Behaviour of NIST's program, and under `--compat`.
    pub effect: &'static str,
    /// Behaviour of a sound run.
    pub sound: &'static str,
}

/// All deviations, by layer.
pub fn all() -> Vec<Deviation> {
    let reading = TextDeviation::ALL.iter().map(|one| Deviation {
        id: format!("{one:?}"),
        layer: DeviationLayer::Reading,
        effect: one.deviation(),
        sound: match one.sound_reading() {
            SoundReading::Same => "the same",
            SoundReading::Refused => "refused",
            SoundReading::Plain => "read as written",
        },
    });
    let running = EngineDeviation::ALL.iter().map(|one| {
        let (effect, sound) = one.describe();
        Deviation { id: format!("{one:?}"), layer: DeviationLayer::Running, effect, sound }
    });
    let physics = Defect::ALL.iter().map(|one| Deviation {
        id: format!("{one:?}"),
        layer: DeviationLayer::Physics,
        effect: one.deviation(),
        sound: "the sound value",
    });
    reading.chain(running).chain(physics).collect()
}

/// The tables of the manual's chapter on sound and compat, in Markdown.
pub fn chapter() -> String {
    let all = all();
    let mut text = String::new();
    for (layer, title) in [
        (DeviationLayer::Reading, "Reading"),
        (DeviationLayer::Running, "Running"),
        (DeviationLayer::Physics, "Physics"),
    ] {
        text += &format!(
            "### {title}\n\n| variant | NIST's program, and `--compat` | without `--compat` |\n"
        );
        text += "| --- | --- | --- |\n";
        for Deviation { id, effect, sound, .. } in all.iter().filter(|one| one.layer == layer) {
            let effect = effect.replace('|', "\\|");
            text += &format!("| `{id}` | {effect} | {sound} |\n");
        }
        text.push('\n');
    }
    text
}
