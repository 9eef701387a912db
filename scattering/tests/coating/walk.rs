//! A polarized random walk through a pigmented coating, which knows nothing of the crate's models:
//! Gaussian facets met at random heights with any number of bounces, Fresnel's equations, flakes as
//! rough sheets of one film or of metal, and a body of spheres over a backing.
//!
//! The walk over a random surface: E. Heitz et al., *Multiple-scattering microfacet BSDFs with the
//! Smith model*, ACM Trans. Graph. 35, 58 (2016), with heights equally frequent from −1 to 1.

use std::f64::consts::{FRAC_1_SQRT_2, PI, TAU};

use glam::DVec3;
use num_complex::Complex64;

/// Components of the coating. Gaps and flakes are columns that light does not leave.
#[derive(Clone, Debug)]
pub(super) struct WalkCoat {
    /// Index of the binder.
    pub(super) n: f64,
    /// κL.
    pub(super) binder: f64,
    /// Standard deviations of the slopes of the surface.
    pub(super) surface: (f64, f64),
    /// Flakes, if there are any.
    pub(super) flakes: Option<WalkSheet>,
    /// The body.
    pub(super) body: WalkBody,
}

/// Flakes: facets with these slopes in a binder.
#[derive(Clone, Debug)]
pub(super) struct WalkSheet {
    /// τ.
    pub(super) depth: f64,
    pub(super) slopes: (f64, f64),
    /// Index of the core: metal, or the binder's own.
    pub(super) core: Complex64,
    /// Index of a film on the core and its thickness over the vacuum wavelength.
    pub(super) film: Option<(f64, f64)>,
}

/// Spheres in front of a backing that scatters all light diffusely.
#[derive(Clone, Copy, Debug)]
pub(super) struct WalkBody {
    pub(super) depth: f64,
    pub(super) albedo: f64,
    pub(super) g: f64,
    pub(super) backing: f64,
}

/// Numbers from 0 to 1 from a key and a counter (the finalizer of SplitMix64: G. L. Steele et al.,
/// OOPSLA 2014): ray k draws the same numbers whatever ray was walked before.
pub(super) struct WalkRandom {
    key: u64,
    counter: u64,
}

impl WalkRandom {
    pub(super) fn new(seed: u64, ray: u64) -> Self {
        Self { key: mixed(mixed(seed).wrapping_add(ray)), counter: 0 }
    }

    fn next(&mut self) -> f64 {
        self.counter += 1;
        let bits = mixed(self.key.wrapping_add(self.counter.wrapping_mul(0x9E37_79B9_7F4A_7C15)));
        ((bits >> 11) as f64 + 0.5) / (1u64 << 53) as f64
    }

    fn normal(&mut self) -> (f64, f64) {
        let radius = (-2.0 * self.next().ln()).sqrt();
        let (sin, cos) = (TAU * self.next()).sin_cos();
        (radius * cos, radius * sin)
    }
}

fn mixed(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

/// Light of unit intensity.
#[derive(Clone, Copy, Debug)]
pub(super) struct WalkRay {
    /// Direction of propagation in the frame of the sample.
    pub(super) k: DVec3,
    /// First axis of its Stokes vector; the second is k × e.
    e: DVec3,
    /// Q, U, V over I.
    q: [f64; 3],
}

impl WalkRay {
    /// A beam with Q = `q` in the basis of the plane of incidence, on a sample turned by
    /// `rotation`.
    pub(super) fn incident(theta: f64, rotation: f64, q: f64) -> Self {
        let (sin, cos) = theta.sin_cos();
        let turn = |v: DVec3| turned(v, -rotation);
        Self { k: turn(DVec3::new(sin, 0.0, -cos)), e: turn(DVec3::Y), q: [q, 0.0, 0.0] }
    }

    /// Q in the basis of the surface.
    pub(super) fn q_at_surface(&self) -> f64 {
        let across = self.k.cross(DVec3::Z);
        self.along(across.try_normalize().unwrap_or(self.e)).q[0]
    }

    /// The same light with the axis `e`.
    fn along(&self, e: DVec3) -> Self {
        let (cos, sin) = (self.e.dot(e), self.k.cross(self.e).dot(e));
        let (c, s) = (cos * cos - sin * sin, 2.0 * sin * cos);
        let [q, u, v] = self.q;
        Self { k: self.k, e, q: [q * c + u * s, u * c - q * s, v] }
    }

    /// The intensity that amplitudes of s and p leave of it, and the light that goes along `k`.
    fn after(&self, (s, p): (Complex64, Complex64), k: DVec3) -> (f64, Self) {
        let (ss, pp, sp) = (s.norm_sqr(), p.norm_sqr(), s * p.conj());
        let [q, u, v] = self.q;
        let intensity = 0.5 * (ss + pp + (ss - pp) * q);
        let uv = sp * Complex64::new(u, v) / intensity;
        let q = 0.5 * (ss - pp + (ss + pp) * q) / intensity;
        (intensity, Self { k, e: self.e, q: [q, uv.re, uv.im] })
    }

    fn depolarized(k: DVec3) -> Self {
        Self { k, e: k.any_orthonormal_vector(), q: [0.0; 3] }
    }
}

pub(super) fn turned(v: DVec3, angle: f64) -> DVec3 {
    let (s, c) = angle.sin_cos();
    DVec3::new(v.x * c - v.y * s, v.y * c + v.x * s, v.z)
}

/// Amplitudes of a facet.
struct WalkFacet {
    reflected: (Complex64, Complex64),
    /// Over the root of the intensity that goes on; nothing if all of it is absorbed.
    passed: Option<((Complex64, Complex64), DVec3)>,
}

/// Fresnel's equations from the index `a` into `b`: (r, t, cosine inside).
fn fresnel(a: Complex64, b: Complex64, cos_a: Complex64) -> [(Complex64, Complex64); 2] {
    let cos_b = (1.0 - (a / b) * (a / b) * (1.0 - cos_a * cos_a)).sqrt();
    let (s, p) = (a * cos_a + b * cos_b, b * cos_a + a * cos_b);
    let r = ((a * cos_a - b * cos_b) / s, (b * cos_a - a * cos_b) / p);
    [r, (2.0 * a * cos_a / s, 2.0 * a * cos_a / p)]
}

/// The boundary of two clear media for light along `k` onto the facet `m` that faces it.
fn boundary(from: f64, to: f64, k: DVec3, m: DVec3) -> WalkFacet {
    let cos = -k.dot(m);
    let sin2 = (from / to).powi(2) * (1.0 - cos * cos);
    let [reflected, (s, p)] = fresnel(from.into(), to.into(), cos.into());
    let passed = (sin2 < 1.0).then(|| {
        let inside = (1.0 - sin2).sqrt();
        let power = (to * inside / (from * cos)).sqrt();
        ((s * power, p * power), k * (from / to) + m * (from / to * cos - inside))
    });
    WalkFacet { reflected, passed }
}

/// A flake in the binder.
fn flake(sheet: &WalkSheet, n: f64, k: DVec3, m: DVec3) -> WalkFacet {
    let cos = Complex64::from(-k.dot(m));
    let n = Complex64::from(n);
    let clear = sheet.core == n;
    let Some((index, thickness)) = sheet.film else {
        let [r, t] = fresnel(n, sheet.core, cos);
        return WalkFacet { reflected: r, passed: clear.then_some((t, k)) };
    };
    let film = Complex64::from(index);
    let inside = (1.0 - (n / film).powi(2) * (1.0 - cos * cos)).sqrt();
    let phase = (Complex64::I * TAU * film * thickness * inside).exp();
    let (upper, lower) = (fresnel(n, film, cos), fresnel(film, sheet.core, inside));
    let both = |of: fn(&(Complex64, Complex64)) -> Complex64| {
        let [r1, t1] = [of(&upper[0]), of(&upper[1])];
        let [r2, t2] = [of(&lower[0]), of(&lower[1])];
        let trips = 1.0 + r1 * r2 * phase * phase;
        ((r1 + r2 * phase * phase) / trips, t1 * t2 * phase / trips)
    };
    let (s, p) = (both(|x| x.0), both(|x| x.1));
    WalkFacet { reflected: (s.0, p.0), passed: clear.then_some(((s.1, p.1), k)) }
}

/// (e^{−a²}/(√π a) − erfc a)/2, −1 less that of the reversed direction for a < 0.
fn lambda(k: DVec3, up: f64, slopes: (f64, f64)) -> f64 {
    let across = (k.x * slopes.0).hypot(k.y * slopes.1);
    let a = up * FRAC_1_SQRT_2 / across.max(1e-300);
    if a.abs() > 30.0 {
        return if a > 0.0 { 0.0 } else { -1.0 };
    }
    0.5 * ((-a * a).exp() / (PI.sqrt() * a) - libm::erfc(a))
}

/// Facets met after each other: the light that leaves above or below, or nothing if it is
/// absorbed. `above` says where it comes from.
fn sheet_walk(
    mut ray: WalkRay,
    mut above: bool,
    slopes: (f64, f64),
    facet: &dyn Fn(bool, DVec3, DVec3) -> WalkFacet,
    random: &mut WalkRandom,
) -> Option<(WalkRay, bool)> {
    // The part of the surface that lies lower, seen from the side where the light is.
    let mut lower = 1.0f64;
    for _ in 0..1000 {
        let side = if above { 1.0 } else { -1.0 };
        let up = ray.k.z * side;
        let lambda = lambda(ray.k, up, slopes);
        let free = if up > 0.0 { lower.powf(lambda) } else { 0.0 };
        let u = random.next();
        if u > 1.0 - free {
            return Some((ray, above));
        }
        lower = (lower / (1.0 - u).powf(1.0 / lambda)).clamp(0.0, 1.0);
        let m = facing(ray.k, side, slopes, random)?;
        let WalkFacet { reflected, passed } = facet(above, ray.k, m);
        let across = ray.k.cross(m).try_normalize();
        let seen = ray.along(across.unwrap_or(ray.e));
        let mirrored = ray.k - 2.0 * ray.k.dot(m) * m;
        let (back, reflected) = seen.after(reflected, mirrored);
        if random.next() < back {
            ray = reflected;
            continue;
        }
        let (amplitudes, k) = passed?;
        let (on, passed) = seen.after(amplitudes, k);
        // What is neither reflected nor passed is absorbed.
        if random.next() * (1.0 - back) >= on * (1.0 + 1e-12) {
            return None;
        }
        ray = passed;
        (above, lower) = (!above, 1.0 - lower);
    }
    None
}

/// A facet that the light along `k` meets, as often as it is seen.
fn facing(k: DVec3, side: f64, slopes: (f64, f64), random: &mut WalkRandom) -> Option<DVec3> {
    let toward = -k.z * side;
    let widest = toward + 6.0 * (k.x * slopes.0).hypot(k.y * slopes.1);
    for _ in 0..1_000_000 {
        let (a, b) = random.normal();
        let (x, y) = (a * slopes.0, b * slopes.1);
        let seen = toward + k.x * x + k.y * y;
        if random.next() * widest < seen {
            return Some(DVec3::new(-x, -y, side).normalize());
        }
    }
    None
}

/// A direction of diffuse light that goes up.
fn diffuse(random: &mut WalkRandom) -> WalkRay {
    let (sin2, phi) = (random.next(), TAU * random.next());
    let (s, c) = phi.sin_cos();
    let sin = sin2.sqrt();
    WalkRay::depolarized(DVec3::new(sin * c, sin * s, (1.0 - sin2).sqrt()))
}

impl WalkBody {
    /// Light that is returned upwards.
    fn returns(&self, down: &WalkRay, random: &mut WalkRandom) -> Option<WalkRay> {
        let (mut z, mut k) = (0.0, down.k);
        loop {
            let depth = z + random.next().ln() * k.z;
            if depth < 0.0 {
                return Some(WalkRay::depolarized(k));
            }
            if depth > self.depth {
                if random.next() >= self.backing {
                    return None;
                }
                (z, k) = (self.depth, diffuse(random).k);
                if z == 0.0 {
                    return Some(WalkRay::depolarized(k));
                }
                continue;
            }
            if random.next() >= self.albedo {
                return None;
            }
            (z, k) = (depth, self.scattered(k, random));
        }
    }

    /// After L. G. Henyey and J. L. Greenstein.
    fn scattered(&self, k: DVec3, random: &mut WalkRandom) -> DVec3 {
        let g = self.g;
        let cos = if g.abs() < 1e-6 {
            2.0 * random.next() - 1.0
        } else {
            let part = (1.0 - g * g) / (1.0 - g + 2.0 * g * random.next());
            (1.0 + g * g - part * part) / (2.0 * g)
        };
        let (x, y) = k.any_orthonormal_pair();
        let (s, c) = (TAU * random.next()).sin_cos();
        let sin = (1.0 - cos * cos).max(0.0).sqrt();
        (k * cos + (x * c + y * s) * sin).normalize()
    }
}

impl WalkCoat {
    /// The light that comes back of `ray`, if it does.
    pub(super) fn walk(&self, ray: WalkRay, random: &mut WalkRandom) -> Option<WalkRay> {
        // The level of the flake in this column; the body is at 1.
        let level = self.flakes.as_ref().and_then(|sheet| {
            let covered = -(-sheet.depth).exp_m1();
            (random.next() < covered).then(|| -(-random.next() * covered).ln_1p() / sheet.depth)
        });
        let surface = |above: bool, k: DVec3, m: DVec3| {
            if above { boundary(1.0, self.n, k, m) } else { boundary(self.n, 1.0, k, m) }
        };
        let (mut ray, above) = sheet_walk(ray, true, self.surface, &surface, random)?;
        if above {
            return Some(ray);
        }
        loop {
            self.survives(&ray, level.unwrap_or(1.0), random)?;
            ray = match (&self.flakes, level) {
                (Some(sheet), Some(level)) => self.below(ray, sheet, level, random)?,
                _ => self.body.returns(&ray, random)?,
            };
            self.survives(&ray, level.unwrap_or(1.0), random)?;
            let above;
            (ray, above) = sheet_walk(ray, false, self.surface, &surface, random)?;
            if above {
                return Some(ray);
            }
        }
    }

    /// Light that a flake reflects upwards.
    fn below(
        &self,
        mut ray: WalkRay,
        sheet: &WalkSheet,
        level: f64,
        random: &mut WalkRandom,
    ) -> Option<WalkRay> {
        let facet = |_: bool, k: DVec3, m: DVec3| flake(sheet, self.n, k, m);
        let mut from_above = true;
        loop {
            let above;
            (ray, above) = sheet_walk(ray, from_above, sheet.slopes, &facet, random)?;
            if above {
                return Some(ray);
            }
            self.survives(&ray, 1.0 - level, random)?;
            ray = self.body.returns(&ray, random)?;
            self.survives(&ray, 1.0 - level, random)?;
            from_above = false;
        }
    }

    /// Nothing if the binder absorbs the ray on the part `part` of the thickness.
    fn survives(&self, ray: &WalkRay, part: f64, random: &mut WalkRandom) -> Option<()> {
        if self.binder == 0.0 {
            return Some(());
        }
        (random.next() < (-self.binder * part / ray.k.z.abs()).exp()).then_some(())
    }
}
