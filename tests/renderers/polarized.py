"""`.pbsdf` in Mitsuba's measured_polarized, and comparison with Mitsuba's models."""

import re

import numpy as np
import mitsuba as mi

from frames import between_axes, basis, directions

METAL = {"model": "Facet_BRDF_Model", "parameters": {
    "substrate": "(0.7,2.4)", "sdf": "Gaussian_Slope_Distribution_Function", "sdf.s": 0.35}}
BODY = {"model": "Diffuse_Subsurface_BRDF_Model", "parameters": {"substrate": "(1.5,0)"}}
NM = [450, 500, 550, 600, 650]


def random_pairs(count, seed, lowest=0.1):
    """Pairs of directions above the horizon, neither mirror images nor opposite."""
    rng = np.random.default_rng(seed)
    found = []
    while len(found) < count:
        l, v = rng.normal(size=(2, 3))
        l, v = l / np.linalg.norm(l), v / np.linalg.norm(v)
        h = (l + v) / max(np.linalg.norm(l + v), 1e-9)
        apart = np.linalg.norm(np.cross(l, v)) > 1e-2 and np.hypot(h[0], h[1]) > 1e-2
        if min(l[2], v[2]) > lowest and apart:
            found.append((l, v))
    return found


def evaluated(bsdf, l, v, nm):
    """The matrix (with the cosine) that Mitsuba's BSDF gives at nm."""
    si = mi.SurfaceInteraction3f()
    si.wi = mi.Vector3f(v)
    si.wavelengths = mi.Color0f() if mi.is_rgb else [nm] * 4
    value = bsdf.eval(mi.BSDFContext(), si, mi.Vector3f(l))
    return np.array([[np.ravel(value[i, j])[0] for j in range(4)] for i in range(4)], dtype=float)


def predicted(plane, l, v):
    return l[2] * between_axes(plane, l, v, basis(-l), basis(v))


def nodes(mist, report):
    """At its nodes the table is the material, to the 32 bits of Mitsuba."""
    path, said = mist.export(METAL, "metal.pbsdf", "--format", "pbsdf", "--lambda",
                             ",".join(map(str, NM)), "--grid", "37x46x91")
    bsdf = mi.load_dict({"type": "measured_polarized", "filename": path, "alpha_sample": 0.35})
    rng = np.random.default_rng(1)
    pairs = []
    while len(pairs) < 200:
        at = (np.radians(-180 + 10 * rng.integers(0, 37)), np.radians(2 * rng.integers(1, 40)),
              (rng.integers(8, 70) / 90) ** 2 * np.pi / 2)
        l, v = directions(*at)
        if min(l[2], v[2]) > 0.05:
            pairs.append((l, v))
    exact = mist.plane(METAL, pairs, 550)
    errors = []
    for (l, v), plane in zip(pairs, exact):
        wanted = predicted(plane, l, v)
        errors.append(np.abs(evaluated(bsdf, l, v, 550) - wanted).max() / np.abs(wanted).max())
    # Mitsuba computes positions between the nodes in 32 bits, so the largest error is a little larger.
    report("pbsdf, eval at 200 nodes, median", np.median(errors), 1e-6)
    report("pbsdf, eval at 200 nodes, 95 %", np.quantile(errors, 0.95), 1e-5)
    return bsdf, said


def between(mist, bsdf, said, report):
    """Between the nodes the error is the one that `mist export` states."""
    stated = [float(number) / 100 for number in re.findall(r"(\d+\.\d+) %", said)]
    pairs = random_pairs(2000, 2)
    exact = mist.plane(METAL, pairs, 600)
    rows = []
    for (l, v), plane in zip(pairs, exact):
        value = evaluated(bsdf, l, v, 600)[0, 0] / l[2]
        rows.append((abs(value / plane[0, 0] - 1), plane[0, 0] * l[2] * v[2]))
    rows.sort()
    light = np.cumsum([weight for _, weight in rows])
    quantile = lambda part: rows[np.searchsorted(light, part * light[-1])][0]
    # The directions differ from those of `mist export`, so the median may be a little larger.
    report("pbsdf, between nodes, median (bound: stated and a quarter)", quantile(0.5),
           1.25 * stated[0])
    report("pbsdf, between nodes, 95 % (bound: stated)", quantile(0.95), stated[1])


def own_models(mist, report):
    """Mitsuba's roughconductor and pplastic have the polarization of our facets and bodies."""
    conductor = mi.load_dict({
        "type": "roughconductor", "distribution": "beckmann", "alpha": 0.35,
        "eta": {"type": "uniform", "value": 0.7}, "k": {"type": "uniform", "value": 2.4}})
    plastic = mi.load_dict({
        "type": "pplastic", "int_ior": 1.5, "ext_ior": 1.0, "alpha": 0.1,
        "specular_reflectance": {"type": "uniform", "value": 0.0},
        "diffuse_reflectance": {"type": "uniform", "value": 0.5}})
    for name, material, bsdf in [("roughconductor", METAL, conductor), ("pplastic", BODY, plastic)]:
        pairs = random_pairs(300, 3)
        worst = 0.0
        for (l, v), plane in zip(pairs, mist.plane(material, pairs, 550)):
            ours, theirs = predicted(plane, l, v), evaluated(bsdf, l, v, 550)
            if theirs[0, 0] > 1e-6:
                worst = max(worst, np.abs(ours / ours[0, 0] - theirs / theirs[0, 0]).max())
        report(f"{name}, all elements over M00", worst, 1e-5)


def render(mist, bsdf, report):
    """One pixel of a plane under distant light, without and with a polarizer in front of the camera."""
    # A node of the table, so that nothing is interpolated.
    l, v = directions(np.radians(-100), np.radians(36), np.radians(22.5))
    up = np.array([0.3, 0.2, 1.0])
    right = np.cross(-v, up)
    right /= np.linalg.norm(right)
    plane = mist.plane(METAL, [(l, v)], 550)[0]
    i, q, u, w = between_axes(plane, l, v, basis(-l), right)[:, 0]

    def pixel(filter_degrees=None):
        """S0 … S3 of the green channel; the camera's frame is x right, y up."""
        look_at = mi.ScalarTransform4f().look_at
        scene = {
            "type": "scene",
            "integrator": {"type": "stokes", "nested": {"type": "volpath", "max_depth": 6}},
            "sensor": {
                "type": "perspective", "fov": 0.001,
                "to_world": look_at(list(5 * v), [0, 0, 0], list(up)),
                "film": {"type": "hdrfilm", "width": 1, "height": 1, "pixel_format": "luminance",
                         "component_format": "float32", "rfilter": {"type": "box"}},
                "sampler": {"type": "independent", "sample_count": 64}},
            "sun": {"type": "directional", "direction": list(-l),
                    "irradiance": {"type": "uniform", "value": 3.0}},
            "plane": {"type": "rectangle", "to_world": mi.ScalarTransform4f().scale(50),
                      "bsdf": bsdf}}
        if filter_degrees is not None:
            # The polarizer faces the camera with its x to the right: its transmission axis is at -theta.
            scene["filter"] = {
                "type": "rectangle", "to_world": look_at(list(2.5 * v), list(5 * v), list(up)),
                "bsdf": {"type": "polarizer", "theta": filter_degrees}}
        return np.array(mi.render(mi.load_dict(scene), seed=1))[0, 0][1:].reshape(4, 3)[:, 1]

    open_ = pixel()
    error = np.abs(open_ / open_[0] - np.array([i, q, u, w]) / i).max()
    report("render without filter, Stokes vector over I", error, 1e-4)
    for degrees in (0, 30, 45, 77):
        # With the same seed crossed filters use the same wavelengths.
        passed, stopped = pixel(degrees)[0], pixel(degrees + 90)[0]
        angle_2 = -2 * np.radians(degrees)
        wanted = 0.5 * (1 + (q * np.cos(angle_2) + u * np.sin(angle_2)) / i)
        error = abs(passed / (passed + stopped) - wanted)
        report(f"render behind a linear polarizer at {degrees} degrees, share of the light", error,
               1e-4)


def check(mist, report):
    mi.set_variant("scalar_spectral_polarized")
    bsdf, said = nodes(mist, report)
    between(mist, bsdf, said, report)
    own_models(mist, report)
    render(mist, bsdf, report)
