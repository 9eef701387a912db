//! Classes that fit a description in words.

use std::fmt::Write as _;

use mist_format::suggestion::did_you_mean;
use scattering::{Class, registry};

/// Words of users, and the classes that are taken for them.
const WORDS: &[(&[&str], &[&str])] = &[
    (
        &["metal", "metallic", "gold", "silver", "aluminium", "aluminum", "copper", "steel"],
        &[
            "Facet_BRDF_Model",
            "Shadowed_Facet_BRDF_Model",
            "Microroughness_BRDF_Model",
            "Pigmented_Coating_BRDF_Model",
            "Adding_Doubling_BRDF_Model",
            "Subsurface_Facet_BRDF_Model",
        ],
    ),
    (
        &["pearl", "pearlescent", "mica", "flake", "flakes", "effect", "iridescent"],
        &[
            "Pigmented_Coating_BRDF_Model",
            "Adding_Doubling_BRDF_Model",
            "Subsurface_Facet_BRDF_Model",
            "Shadowed_Subsurface_Facet_BRDF_Model",
        ],
    ),
    (
        &["paint", "lacquer", "varnish", "enamel", "pigment", "coating", "ink", "car"],
        &[
            "Pigmented_Coating_BRDF_Model",
            "Adding_Doubling_BRDF_Model",
            "Layered_BRDF_Model",
            "Kubelka_Munk_Reflectance",
            "Two_Source_BRDF_Model",
        ],
    ),
    (
        &["glass", "frosted", "window", "transparent", "transmission"],
        &["Facet_BRDF_Model", "Shadowed_Facet_BRDF_Model", "Transmit_BRDF_Model"],
    ),
    (
        &["plastic", "ceramic", "porcelain", "gloss", "glossy"],
        &["Diffuse_Subsurface_BRDF_Model", "Two_Source_BRDF_Model", "Shadowed_Facet_BRDF_Model"],
    ),
    (
        &["wax", "jade", "marble", "milk", "skin", "translucent", "turbid", "haze"],
        &["Pigmented_Coating_BRDF_Model", "Adding_Doubling_BRDF_Model", "First_Diffuse_BRDF_Model"],
    ),
    (
        &["anodized", "anodised", "film", "films", "interference", "thin", "oxide", "soap"],
        &[
            "SingleFilm_StackModel",
            "Stack_StackModel",
            "Roughness_Stack_BRDF_Model",
            "Two_Face_BRDF_Model",
        ],
    ),
    (
        &["grating", "diffraction", "hologram", "cd", "grooves", "rcwa", "orders"],
        &["RCW_BRDF_Model", "CrossRCW_BRDF_Model"],
    ),
    (
        &["wafer", "silicon", "contamination", "contaminated", "dust", "scanner", "particle"],
        &[
            "Double_Interaction_BRDF_Model",
            "Bobbert_Vlieger_BRDF_Model",
            "Polydisperse_Sphere_BRDF_Model",
            "Axisymmetric_Particle_BRDF_Model",
            "Microroughness_BRDF_Model",
        ],
    ),
    (
        &["mirror", "polished", "optic", "optics", "smooth", "roughness"],
        &["Microroughness_BRDF_Model", "Roughness_Stack_BRDF_Model", "ABC_PSD_Function"],
    ),
    (
        &["brushed", "anisotropic"],
        &[
            "Anisotropic_Gaussian_Slope_Distribution_Function",
            "Anisotropic_Exponential_Slope_Distribution_Function",
            "Ellipsoid_Slope_Distribution_Function",
            "Sancer_Shadow_Function",
        ],
    ),
    (&["ggx", "trowbridge"], &["Ellipsoid_Slope_Distribution_Function"]),
    (&["beckmann", "cook"], &["Gaussian_Slope_Distribution_Function", "Shadowed_Facet_BRDF_Model"]),
    (&["white", "matt", "matte", "diffuse", "diffuser", "spectralon"], &["Lambertian_BRDF_Model"]),
    (&["measured", "data"], &["ZernikeExpansion_BRDF_Model", "Table_Reflectance"]),
];

/// The classes that fit all `words`, models first: those that users' words stand for, then those
/// that contain the words in their name, summary, source or parameters.
pub(super) fn search(words: &[String]) -> Result<String, String> {
    let words: Vec<String> = words.iter().flat_map(|text| split(text)).collect();
    let ranked = |class: &&'static Class| {
        let score = words.iter().map(|word| score(class, word)).min().unwrap_or(0);
        (score > 0).then_some((std::cmp::Reverse(score), *class))
    };
    let all: Vec<&'static Class> = registry::classes().collect();
    let mut found: Vec<_> = all.iter().filter_map(ranked).collect();
    found.sort_by_key(|(score, _)| *score);
    if found.is_empty() {
        let known = WORDS.iter().flat_map(|(words, _)| words.iter().copied());
        let hint = words.iter().find_map(|word| did_you_mean(word, known.clone()));
        let hint = hint.unwrap_or_else(|| "`mist models` lists all".into());
        return Err(format!("no model fits {:?}: {hint}", words.join(" ")));
    }
    let width = found.iter().map(|(_, class)| class.name.len()).max().unwrap_or(0);
    let mut text = String::new();
    for (_, class) in found {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{:<width$}  {}", class.name, class.summary);
    }
    Ok(text + "\n`mist models NAME` has the parameters of one.\n")
}

fn split(text: &str) -> impl Iterator<Item = String> {
    text.split(|c: char| !c.is_alphanumeric())
        .filter(|word| !word.is_empty())
        .map(str::to_lowercase)
}

/// Rank of the class for the word: by a user's word, its name, its summary, or the rest; 0 if it
/// does not fit.
fn score(class: &Class, word: &str) -> usize {
    let listed = WORDS.iter().filter(|(words, _)| words.contains(&word));
    let place = listed.filter_map(|(_, classes)| classes.iter().position(|&c| c == class.name));
    if let Some(place) = place.min() {
        return 100 - place;
    }
    let has = |text: &str| text.to_lowercase().contains(word);
    if has(class.name) {
        return 20;
    }
    if split(class.summary).any(|other| other.starts_with(word)) {
        return 15;
    }
    let parameters = || class.parameters().any(|p| split(p.doc).any(|other| other == word));
    usize::from(has(class.source) || parameters())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_class_of_the_list_is_in_the_registry() {
        for name in WORDS.iter().flat_map(|(_, classes)| classes.iter()) {
            assert!(registry::find_class(name).is_some(), "{name}");
        }
    }

    #[test]
    fn words_of_users_find_models() {
        let first = |word: &str| {
            let text = search(&[word.to_owned()]).unwrap();
            text.split_whitespace().next().unwrap().to_owned()
        };
        assert_eq!(first("metallic"), "Facet_BRDF_Model");
        assert_eq!(first("Pearl"), "Pigmented_Coating_BRDF_Model");
        assert_eq!(first("GGX"), "Ellipsoid_Slope_Distribution_Function");
        let text = search(&["metallic paint".to_owned()]).unwrap();
        assert!(text.starts_with("Pigmented_Coating_BRDF_Model"), "{text}");
        assert!(search(&["metalic".to_owned()]).unwrap_err().contains("metallic"));
    }
}
