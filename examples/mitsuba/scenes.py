"""A material on a sphere or a mesh in Mitsuba 3, without and with a filter.

    mist export gold.json --lambda 450,500,550,600,650 -o gold.pbsdf
    python scenes.py gold.pbsdf                              # sphere.png, sphere_dolp.png, …
    python scenes.py gold.pbsdf --filter linear:90           # a linear polarizer before the camera
    python scenes.py gold.pbsdf --filter circular --mesh dragon.ply
    python scenes.py gold31.pbsdf --plugin                   # any number of wavelengths
    python scenes.py http://127.0.0.1:8650/v1/materials/gold/table.pbsdf --plugin

Written are the picture (EXR and PNG), the degree of linear polarization (DoLP, grey from 0 to 1) and
its angle (AoLP, hue over 180 degrees from the horizontal, as bright as the DoLP).
"""

import argparse
import colorsys

import numpy as np


def material(mi, table, plugin, alpha):
    if not plugin:
        return {"type": "measured_polarized", "filename": table, "alpha_sample": alpha}
    import mist_bsdf  # registers the BSDF
    del mist_bsdf
    where = "url" if "://" in table else "filename"
    return {"type": "mist", where: table, "alpha": alpha}


def filter_bsdf(text):
    """`linear:DEGREES` transmits light that is polarized at this angle to the horizontal."""
    kind, _, degrees = text.partition(":")
    if kind == "linear":
        return {"type": "polarizer", "theta": -float(degrees or 0)}
    if kind == "circular":
        return {"type": "circular", "left_handed": degrees == "left"}
    raise SystemExit(f"--filter {text}: expected none, linear:DEGREES, circular or circular:left")


def scene(mi, bsdf, args):
    look_at = mi.ScalarTransform4f().look_at
    origin, up = [0, 0.5, 5], [0, 1, 0]
    shape = ({"type": "sphere", "bsdf": bsdf} if args.mesh is None else
             {"type": args.mesh.rsplit(".", 1)[-1], "filename": args.mesh, "bsdf": bsdf})
    found = {
        "type": "scene",
        "integrator": {"type": "stokes", "nested": {"type": "volpath", "max_depth": 4}},
        "sensor": {
            "type": "perspective", "fov": 30, "to_world": look_at(origin, [0, 0, 0], up),
            "film": {"type": "hdrfilm", "width": args.size, "height": args.size,
                     "component_format": "float32", "rfilter": {"type": "box"}},
            "sampler": {"type": "independent", "sample_count": args.samples}},
        "lamp": {"type": "sphere", "center": [3, 4, 1], "radius": 0.7,
                 "emitter": {"type": "area", "radiance": {"type": "uniform", "value": 25.0}}},
        "sky": {"type": "constant", "radiance": {"type": "uniform", "value": 0.3}},
        "shape": shape,
    }
    if args.filter != "none":
        # In front of the camera, facing it, with x to the right.
        to_world = look_at([0, 0.45, 4.5], origin, up) @ mi.ScalarTransform4f().scale(0.4)
        found["filter"] = {"type": "rectangle", "to_world": to_world,
                           "bsdf": filter_bsdf(args.filter)}
    return mi.load_dict(found)


def pictures(stokes, dark=1e-6):
    """DoLP and AoLP of the luminance, as RGB from 0 to 1."""
    s0, s1, s2 = (stokes[k] @ [0.2126, 0.7152, 0.0722] for k in range(3))
    dolp = np.where(s0 > dark, np.hypot(s1, s2) / np.maximum(s0, dark), 0).clip(0, 1)
    aolp = (0.5 * np.arctan2(s2, s1) / np.pi) % 1
    hue = np.array([[colorsys.hsv_to_rgb(h, 1, v) for h, v in zip(*row)] for row in zip(aolp, dolp)])
    return np.repeat(dolp[..., None], 3, axis=2), hue


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("table", help="a .pbsdf, or with --plugin its URL")
    parser.add_argument("--plugin", action="store_true", help="use mist_bsdf.py")
    parser.add_argument("--mesh", help="a PLY or OBJ file within two units of the origin")
    parser.add_argument("--filter", default="none")
    parser.add_argument("--alpha", type=float, default=0.3, help="roughness for sampling")
    parser.add_argument("--size", type=int, default=256)
    parser.add_argument("--samples", type=int, default=64)
    parser.add_argument("--variant", default="scalar_spectral_polarized")
    parser.add_argument("--out", help="how the names of the pictures begin")
    args = parser.parse_args()

    import mitsuba as mi
    mi.set_variant(args.variant)
    bsdf = material(mi, args.table, args.plugin, args.alpha)
    image = np.array(mi.render(scene(mi, bsdf, args), seed=1))
    # RGB(A), then the Stokes components in RGB each.
    # Mitsuba's own reader gives NaN for light that returns exactly to where it came from.
    image = np.nan_to_num(image)
    stokes = np.moveaxis(image[..., -12:].reshape(*image.shape[:2], 4, 3), 2, 0)
    out = args.out or ("mesh" if args.mesh else "sphere")
    mi.Bitmap(stokes[0].astype(np.float32)).write(f"{out}.exr")
    dolp, aolp = pictures(stokes)
    for name, picture in [(out, stokes[0]), (f"{out}_dolp", dolp), (f"{out}_aolp", aolp)]:
        mi.util.write_bitmap(f"{name}.png", mi.TensorXf(picture.astype(np.float32)),
                             write_async=False)
    print(f"{out}.exr, {out}.png, {out}_dolp.png, {out}_aolp.png")


if __name__ == "__main__":
    main()
