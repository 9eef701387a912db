//! Tests of film stacks: special cases and conservation laws.

use num_complex::Complex64;

use super::*;

const ONE: Complex64 = Complex64::ONE;

fn c(re: f64, im: f64) -> Complex64 {
    Complex64::new(re, im)
}

fn stack() -> Films {
    Films::new(&[(c(2.3, 0.01), 0.13), (c(1.46, 0.0), 0.2)], ONE, c(1.5, 0.0), 0.55)
}

fn close(a: Complex64, b: Complex64, tolerance: f64) -> bool {
    (a - b).norm() <= tolerance
}

#[test]
fn glass_at_brewsters_angle_does_not_reflect_p() {
    let glass = Films::new(&[], ONE, c(1.5, 0.0), 0.55);
    let r = glass.r12(c(1.5f64.atan().sin(), 0.0));
    assert!(r.p.norm() < 1e-15);
    assert!(r.s.re < -0.3);
}

#[test]
fn a_film_of_zero_thickness_changes_nothing() {
    let bare = Films::new(&[], ONE, c(1.3, 1.2), 0.55);
    let film = Films::new(&[(c(2.3, 0.0), 0.0)], ONE, c(1.3, 1.2), 0.55);
    for kappa in [0.0, 0.5, 0.99] {
        let (a, b) = (bare.r12(c(kappa, 0.0)), film.r12(c(kappa, 0.0)));
        assert!(close(a.s, b.s, 1e-15) && close(a.p, b.p, 1e-15));
    }
}

#[test]
fn what_a_transparent_stack_does_not_reflect_it_transmits() {
    let films = Films::new(&[(c(2.3, 0.0), 0.13)], ONE, c(1.5, 0.0), 0.55);
    for sin in [0.0f64, 0.4, 0.95] {
        let (r, t) = (films.r12(c(sin, 0.0)), films.t12(c(sin, 0.0)));
        let ratio = (2.25 - sin * sin).sqrt() / (1.0 - sin * sin).sqrt();
        assert!((r.s.norm_sqr() + ratio * t.s.norm_sqr() - 1.0).abs() < 1e-14);
        assert!((r.p.norm_sqr() + ratio * t.p.norm_sqr() - 1.0).abs() < 1e-14);
    }
}

#[test]
fn transmission_both_ways_differs_by_the_ratio_of_n_cos() {
    let films = stack();
    let sin = 0.6f64;
    let ratio = (2.25 - sin * sin).sqrt() / (1.0 - sin * sin).sqrt();
    let (t12, t21) = (films.t12(c(sin, 0.0)), films.t21(c(sin, 0.0)));
    assert!(close(t21.s, t12.s * ratio, 1e-14) && close(t21.p, t12.p * ratio, 1e-14));
}

#[test]
fn the_known_cosine_gives_the_same_reflection() {
    let (sin, cos) = 0.7f64.sin_cos();
    for films in [stack(), Films::new(&[], ONE, c(1.3, 1.2), 0.55)] {
        let (a, b) = (films.r12(c(sin, 0.0)), films.r12_known(cos, sin * sin));
        assert!(close(a.s, b.s, 1e-15) && close(a.p, b.p, 1e-15));
    }
}

#[test]
fn beyond_the_critical_angle_the_wave_outside_decays() {
    // Below the surface of glass, evanescent outside: the field half a wavelength above is
    // smaller than at the surface.
    let glass = Films::new(&[], ONE, c(1.5, 0.0), 0.55);
    let kappa = glass.kappa_inside(0.9);
    let at = |depth| glass.fields_at_depth(IncidentSide::FromSubstrate, kappa, depth).e.norm();
    assert!(at(-0.275) < 0.2 * at(0.0));
    assert!((glass.r21(kappa).s.norm() - 1.0).abs() < 1e-15);
}

#[test]
fn thick_absorbing_films_neither_overflow_nor_pass_light() {
    let films = Films::new(&[(c(1.5, 1.0), 1e4)], ONE, c(1.5, 0.0), 0.5);
    let alone = Films::new(&[], ONE, c(1.5, 1.0), 0.5);
    let kappa = c(0.3, 0.0);
    assert!(close(films.r12(kappa).p, alone.r12(kappa).p, 1e-14));
    assert_eq!(films.t12(kappa).s, c(0.0, 0.0));
}

#[test]
fn a_film_in_which_light_just_grazes_is_regular() {
    // q = 0 in the film: the limit of its neighbours.
    let films = Films::new(&[(c(0.5, 0.0), 0.1)], ONE, c(1.5, 0.0), 0.55);
    let (at, near) = (films.r12(c(0.5, 0.0)), films.r12(c(0.5 + 1e-9, 0.0)));
    assert!(close(at.s, near.s, 1e-7) && close(at.p, near.p, 1e-7));
}

#[test]
fn fields_at_the_faces_are_one_plus_r_and_t() {
    let films = stack();
    let kappa = c(0.6, 0.0);
    let mut at = [TangentialFields::default(); 3];
    for (from, first, last) in
        [(IncidentSide::FromOutside, 2, 0), (IncidentSide::FromSubstrate, 0, 2)]
    {
        films.fields_at_interfaces(from, kappa, &mut at);
        let (r, t, entry, exit) = match from {
            IncidentSide::FromOutside => (films.r12(kappa), films.t12(kappa), 1.0, 1.5),
            IncidentSide::FromSubstrate => (films.r21(kappa), films.t21(kappa), 1.5, 1.0),
        };
        assert!(close(at[first].e, 1.0 + r.s, 1e-14));
        assert!(close(at[first].u, 1.0 + r.p, 1e-14));
        assert!(close(at[last].e, t.s, 1e-14));
        assert!(close(at[last].u, t.p * exit / entry, 1e-14));
    }
}

#[test]
fn fields_at_the_depth_of_an_interface_are_those_of_the_interface() {
    let films = stack();
    let kappa = c(0.6, 0.0);
    let mut at = [TangentialFields::default(); 3];
    for from in [IncidentSide::FromOutside, IncidentSide::FromSubstrate] {
        films.fields_at_interfaces(from, kappa, &mut at);
        for (interface, depth) in [(2, 0.0), (1, 0.2), (0, 0.33)] {
            for nudge in [-1e-12, 0.0, 1e-12] {
                let there = films.fields_at_depth(from, kappa, depth + nudge);
                assert!(close(there.e, at[interface].e, 1e-10), "{from:?} {interface}");
                assert!(close(there.u, at[interface].u, 1e-10));
                assert!(close(there.w, at[interface].w, 1e-10));
            }
        }
    }
}
