//! Warnings of requests whose numbers look like slips of units.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::{
    evaluation::{EvaluationRequest, GeometryAngles},
    table::{TableDirections, TableRequest},
};
use crate::Warning;

/// Room for numbers with a few digits: π/2 is also 1.5708, 2π is also 6.2832.
const ROUNDED: f64 = 1.0001;
/// Wavelengths that observers see, nm.
const VISIBLE_NM: [f64; 2] = [360.0, 830.0];
/// Shorter wavelengths in nm are rather ones in µm.
const SHORTEST_NM: f64 = 30.0;
/// Longer wavelengths in nm are outside of the light that the models are used for.
const LONGEST_NM: f64 = 1e5;
/// Photon energy times wavelength, eV nm.
const EV_NM: f64 = 1_239.841_984;

impl EvaluationRequest {
    /// Warnings of angles that are not directions above the surface in radians.
    pub fn warnings(&self) -> Vec<Warning> {
        type Angle = fn(&GeometryAngles) -> f64;
        let angles: [(&str, Angle, f64); 4] = [
            ("theta_i", |a| a.theta_i, FRAC_PI_2),
            ("theta_s", |a| a.theta_s, FRAC_PI_2),
            ("phi_s", |a| a.phi_s, TAU),
            ("rotation", |a| a.rotation, TAU),
        ];
        angles.iter().filter_map(|(name, of, most)| radians(name, self, *of, *most)).collect()
    }
}

fn radians(
    name: &str,
    request: &EvaluationRequest,
    of: fn(&GeometryAngles) -> f64,
    most: f64,
) -> Option<Warning> {
    let too_large = |x: &f64| x.abs() > most * ROUNDED;
    let all = || request.geometries.iter().map(of).filter(too_large);
    let x = all().max_by(|a, b| a.abs().total_cmp(&b.abs()))?;
    let count = match all().count() {
        1 => String::new(),
        many => format!(" (in {many} geometries)"),
    };
    if x.abs() <= PI {
        let message = format!("{name} = {x} rad is below the horizon{count}: the value there is 0");
        return Some(Warning::new("angle/horizon", message).help("polar angles end at pi/2"));
    }
    let message = format!("{name} is read in radians, and {x} looks like degrees{count}");
    let help = format!("write {:.6} for {x} degrees", x.to_radians());
    Some(Warning::new("angle/degrees", message).help(help))
}

impl TableRequest {
    /// Warnings of nodes beyond the horizon, nodes that look like radians, and wavelengths in
    /// another unit than nm.
    pub fn warnings(&self) -> Vec<Warning> {
        let unit = wavelength_warning(&self.wavelengths);
        let unseen = || invisible_warning(&self.wavelengths);
        let mut found: Vec<Warning> = unit.or_else(unseen).into_iter().collect();
        let (polar, azimuths): (Vec<(&str, Vec<f64>)>, Vec<f64>) = match &self.directions {
            TableDirections::Grid(grid) => (
                vec![("thetai", grid.thetai.clone()), ("thetas", grid.thetas.clone())],
                grid.phis.clone(),
            ),
            TableDirections::List(rows) => (
                vec![
                    ("thetai", rows.iter().map(|row| row.thetai).collect()),
                    ("thetas", rows.iter().map(|row| row.thetas).collect()),
                ],
                rows.iter().map(|row| row.phis).collect(),
            ),
        };
        found.extend(polar.iter().filter_map(|(name, nodes)| below_horizon(name, nodes)));
        found.extend(in_radians(&polar, &azimuths));
        found
    }
}

fn below_horizon(name: &str, nodes: &[f64]) -> Option<Warning> {
    let below = || nodes.iter().filter(|x| x.abs() > 90.0);
    let largest = below().copied().max_by(|a, b| a.abs().total_cmp(&b.abs()))?;
    let message = format!(
        "{name}: {} of {} polar angles are beyond 90 degrees, up to {largest}: their rows have the \
         values of 89.9 degrees",
        below().count(),
        nodes.len()
    );
    Some(Warning::new("angle/horizon", message).help("end the nodes at 90 degrees"))
}

/// A warning if all angles are at most those of a half turn in radians, and one is π/2, π or 2π.
fn in_radians(polar: &[(&str, Vec<f64>)], azimuths: &[f64]) -> Option<Warning> {
    let is_part_of_pi =
        |x: &f64| [FRAC_PI_2, PI, TAU].iter().any(|part| (x.abs() / part - 1.0).abs() < 1e-3);
    let small = polar.iter().all(|(_, nodes)| nodes.iter().all(|x| x.abs() < FRAC_PI_2 * 1.01));
    let all = || polar.iter().flat_map(|(_, nodes)| nodes).chain(azimuths);
    if !(small && azimuths.iter().all(|x| x.abs() < TAU * 1.01)) {
        return None;
    }
    let x = all().find(|x| is_part_of_pi(x))?;
    let message = format!("nodes are read in degrees, and {x} looks like radians");
    let help = format!("write {:.4} for {x} radians", x.to_degrees());
    Some(Warning::new("angle/radians", message).help(help))
}

/// A warning if wavelengths that are read in nm are rather in another unit.
pub fn wavelength_warning(nm: &[f64]) -> Option<Warning> {
    let low = nm.iter().copied().fold(f64::INFINITY, f64::min);
    let high = nm.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if nm.is_empty() || (low >= SHORTEST_NM && high <= LONGEST_NM) {
        return None;
    }
    let are = |from: f64, to: f64| from <= VISIBLE_NM[1] && to >= VISIBLE_NM[0];
    let (unit, help) = if are(1000.0 * low, 1000.0 * high) || high < 20.0 && low > 0.05 {
        ("um", format!("write {} for {low} um", rounded(1000.0 * low)))
    } else if are(EV_NM / high, EV_NM / low) {
        ("eV", format!("{low} eV are {:.2} nm", EV_NM / low))
    } else if high > LONGEST_NM {
        ("another unit", "give wavelengths in nm".to_owned())
    } else {
        ("another unit", format!("light has 100 nm and more; {low} um are {} nm", 1000.0 * low))
    };
    let range = if low == high { format!("{low}") } else { format!("{low} to {high}") };
    let message = format!("wavelengths are read in nm, and {range} look like {unit}");
    Some(Warning::new("wavelength/unit", message).help(help))
}

/// A warning if an observer sees none of the wavelengths (nm), so that colours are those of the
/// values at their ends.
pub fn invisible_warning(nm: &[f64]) -> Option<Warning> {
    let visible = |nm: &f64| (VISIBLE_NM[0]..=VISIBLE_NM[1]).contains(nm);
    let low = nm.iter().copied().fold(f64::INFINITY, f64::min);
    let high = nm.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let covers = low < VISIBLE_NM[0] && high > VISIBLE_NM[1];
    (!nm.is_empty() && !covers && !nm.iter().any(visible)).then(|| {
        let message = format!(
            "no wavelength from {low} to {high} nm is visible: colours are those of the end values"
        );
        Warning::new("spectrum/coverage", message).help("colours need wavelengths of 380 to 780 nm")
    })
}

/// A number without the last bits of a product.
fn rounded(x: f64) -> f64 {
    (1e6 * x).round() / 1e6
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::request::TableQuery;

    fn table(grid: &str, lambda: &str) -> Vec<&'static str> {
        let query = TableQuery {
            grid: Some(grid.into()),
            lambda: Some(lambda.into()),
            ..TableQuery::default()
        };
        let found = query.request("gold", None).unwrap().warnings();
        found.into_iter().map(|warning| warning.code).collect()
    }

    #[test]
    fn usual_requests_have_no_warning() {
        for grid in
            ["thetai=0:2:90,thetas=0:2:90,phis=0:2:180", "thetai=0,1,thetas=0:0.1:1.5,phis=0"]
        {
            for lambda in ["360:5:830", "200:100:2500"] {
                assert_eq!(table(grid, lambda), [""; 0], "{grid} {lambda}");
            }
        }
    }

    #[test]
    fn slips_of_units_are_told() {
        let grid = "thetai=0:45:90,thetas=0:45:90,phis=0,180";
        for um in ["0.4:0.02:0.7", "0.55", "10.6", "1.5,2.5"] {
            assert_eq!(table(grid, um), ["wavelength/unit"], "{um}");
        }
        assert_eq!(table("thetai=0:45:90,thetas=0:10:170,phis=0", "550"), ["angle/horizon"]);
        let radians = "thetai=0,0.785,1.5708,thetas=0,1.5,phis=0,3.14159";
        assert_eq!(table(radians, "550"), ["angle/radians"]);
    }

    #[test]
    fn angles_of_evaluations_are_told_with_their_largest_value() {
        let json = r#"{"model": "Lambertian_BRDF_Model", "geometries": [
            {"theta_i": 45, "theta_s": 1.5707963267948966, "phi_s": 3.14159},
            {"theta_i": 30, "theta_s": 1.6, "phi_s": 180}]}"#;
        let request: EvaluationRequest = serde_json::from_str(json).unwrap();
        let found: Vec<String> = request.warnings().iter().map(ToString::to_string).collect();
        assert_eq!(found.len(), 3, "{found:?}");
        assert!(found[0].contains("theta_i") && found[0].contains("45 looks like degrees (in 2"));
        assert!(found[1].contains("theta_s = 1.6 rad is below the horizon"));
        assert!(found[2].contains("phi_s") && found[2].contains("180"));
    }
}
