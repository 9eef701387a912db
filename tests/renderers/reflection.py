"""`.bsdf` in Mitsuba's measured: spectra in scalar_spectral, colours in scalar_rgb."""

import numpy as np
import mitsuba as mi

from polarized import METAL, random_pairs

RIDGES = {"model": "Facet_BRDF_Model", "parameters": {
    "substrate": "(0.7,2.4)", "sdf": "Anisotropic_Gaussian_Slope_Distribution_Function",
    "sdf.sigmax": 0.15, "sdf.sigmay": 0.35}}
SPECTRAL = [400 + 10 * k for k in range(31)]


def value(bsdf, l, v, nm):
    si = mi.SurfaceInteraction3f()
    si.wi = mi.Vector3f(v)
    if nm is not None:
        si.wavelengths = [nm] * 4
    return float(np.ravel(bsdf.eval(mi.BSDFContext(), si, mi.Vector3f(l)))[0])


def albedo(bsdf, theta, count=20000):
    """Directional reflectance for a viewer at theta, by the sampling of the reader."""
    rng = np.random.default_rng(5)
    v = mi.Vector3f([float(np.sin(theta)), 0.0, float(np.cos(theta))])
    total = 0.0
    for x, y, z in rng.random((count, 3)):
        si = mi.SurfaceInteraction3f()
        si.wi = v
        _, weight = bsdf.sample(mi.BSDFContext(), si, float(x), mi.Point2f(float(y), float(z)))
        total += float(np.ravel(weight)[0])
    return total / count


def ridges(mist, report):
    """An anisotropic material."""
    mi.set_variant("scalar_spectral")
    path, _ = mist.export(RIDGES, "ridges.bsdf", "--lambda", "500,550", "--grid", "37x20x64")
    bsdf = mi.load_dict({"type": "measured", "filename": path})
    pairs = random_pairs(600, 5, lowest=0.2)
    exact = mist.plane(RIDGES, pairs, 550)[:, 0, 0] * [l[2] for l, _ in pairs]
    errors = np.abs([value(bsdf, l, v, 550) for l, v in pairs] - exact)
    report("bsdf of ridges, sum of differences over sum", errors.sum() / exact.sum(), 0.02)


def check(mist, report):
    ridges(mist, report)
    for variant, words in [
        ("scalar_spectral", ["--spectral", "--lambda", ",".join(map(str, SPECTRAL))]),
        ("scalar_rgb", ["--rgb"]),
    ]:
        mi.set_variant(variant)
        name = f"metal_{variant}.bsdf"
        path, _ = mist.export(METAL, name, "--format", "bsdf", "--grid", "32x96", *words)
        bsdf = mi.load_dict({"type": "measured", "filename": path})
        nm = 555 if variant == "scalar_spectral" else None
        # The metal has the same index at all wavelengths: its colour is grey.
        pairs = random_pairs(1500, 7, lowest=0.15)
        exact = mist.plane(METAL, pairs, 555)[:, 0, 0] * [l[2] for l, _ in pairs]
        found = np.array([value(bsdf, l, v, nm) for l, v in pairs])
        errors = np.abs(found - exact)
        report(f"bsdf in {variant}, median", np.median(errors / exact), 0.01)
        report(f"bsdf in {variant}, sum of differences over sum", errors.sum() / exact.sum(), 0.02)
        theta = 0.6
        sampled = albedo(bsdf, theta)
        step = np.pi / 2 / 180
        t, p = np.meshgrid((np.arange(180) + 0.5) * step, (np.arange(72) + 0.5) * np.pi / 36)
        v = np.array([np.sin(theta), 0.0, np.cos(theta)])
        around = [np.array([np.sin(a) * np.cos(b), np.sin(a) * np.sin(b), np.cos(a)])
                  for a, b in zip(t.ravel(), p.ravel())]
        summed = mist.plane(METAL, [(l, v) for l in around], 555)[:, 0, 0]
        weights = np.array([l[2] for l in around]) * np.sin(t.ravel()) * step * np.pi / 36
        report(f"bsdf in {variant}, reflectance by sampling", abs(sampled / (summed @ weights) - 1),
               0.02)
