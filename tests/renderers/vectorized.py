"""The BSDF of examples/mitsuba in the llvm variants, in processes of their own: a variant that cannot
run ends the process.

    python vectorized.py matrices TABLE PAIRS.json      matrices at 620 nm, llvm_ad_spectral_polarized
    python vectorized.py picture VARIANT TABLE          mean, and number of values that are no numbers
"""

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np

from frames import directions
from polarized import METAL, predicted

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "examples" / "mitsuba"))
PLUGIN = ["--plugin", "--lambda", "400:20:700", "--grid", "19x10x12"]


def matrices(path, pairs):
    """The matrices, with the cosine, of all pairs at once."""
    import mitsuba as mi
    mi.set_variant("llvm_ad_spectral_polarized")
    import drjit as dr
    import mist_bsdf  # noqa: F401, registers the BSDF

    bsdf = mi.load_dict({"type": "mist", "filename": path, "alpha": 0.35})
    l, v = np.array(pairs, dtype=np.float32).transpose(1, 2, 0)
    si = dr.zeros(mi.SurfaceInteraction3f, len(pairs))
    si.wi, si.wavelengths = mi.Vector3f(v), mi.UnpolarizedSpectrum(620)
    value = bsdf.eval(mi.BSDFContext(), si, mi.Vector3f(l))
    dr.eval(value)
    found = [[np.array(value[i, j])[0] for j in range(4)] for i in range(4)]
    return np.array(found, dtype=float).transpose(2, 0, 1).tolist()


def picture(variant, path):
    """Mean of a ball under an even sky, and the number of values that are no numbers."""
    import mitsuba as mi
    mi.set_variant(variant)
    import mist_bsdf  # noqa: F401, registers the BSDF

    samples = 32 if variant.startswith("scalar") else 512
    camera = mi.ScalarTransform4f().look_at([0, 0, 5], [0, 0, 0], [0, 1, 0])
    film = {"type": "hdrfilm", "width": 16, "height": 16, "rfilter": {"type": "box"}}
    scene = mi.load_dict({
        "type": "scene", "integrator": {"type": "path", "max_depth": 3},
        "sensor": {"type": "perspective", "fov": 20, "to_world": camera, "film": film,
                   "sampler": {"type": "independent", "sample_count": samples}},
        "sky": {"type": "constant"},
        "ball": {"type": "sphere", "bsdf": {"type": "mist", "filename": path, "alpha": 0.35}}})
    image = np.array(mi.render(scene, seed=1))
    return {"mean": float(image.mean()), "nan": int((~np.isfinite(image)).sum())}


def child(*words):
    """The answer of this file in a process of its own."""
    done = subprocess.run([sys.executable, __file__, *words], capture_output=True, text=True,
                          check=False)
    if done.returncode != 0:
        raise SystemExit(f"vectorized.py {' '.join(words)}:\n{done.stderr}")
    return json.loads(done.stdout.splitlines()[-1])


def pairs_at_nodes():
    rng = np.random.default_rng(4)
    found = []
    while len(found) < 40:
        l, v = directions(np.radians(-180 + 20 * rng.integers(0, 19)),
                          np.radians(10 * rng.integers(1, 8)),
                          (rng.integers(3, 9) / 11) ** 2 * np.pi / 2)
        if min(l[2], v[2]) > 0.05:
            found.append((l, v))
    return found


def check(mist, report):
    if not os.environ.get("DRJIT_LIBLLVM_PATH"):
        print("SKIP llvm variants: DRJIT_LIBLLVM_PATH does not name LLVM's library", flush=True)
        return
    path, _ = mist.export(METAL, "metal16.pbsdf", *PLUGIN)
    pairs = pairs_at_nodes()
    listed = Path(mist.folder) / "pairs.json"
    listed.write_text(json.dumps([[list(l), list(v)] for l, v in pairs]))
    found = np.array(child("matrices", path, str(listed)))
    wanted = np.array([predicted(plane, l, v)
                       for (l, v), plane in zip(pairs, mist.plane(METAL, pairs, 620))])
    errors = np.abs(found - wanted).max(axis=(1, 2)) / np.abs(wanted).max(axis=(1, 2))
    report("plugin in llvm_ad_spectral_polarized, eval at nodes, 90 %",
           np.quantile(errors, 0.9), 3e-5)
    scalar, llvm = (child("picture", f"{kind}_spectral", path) for kind in ("scalar", "llvm_ad"))
    report("plugin, values of both pictures that are no numbers", scalar["nan"] + llvm["nan"], 0)
    # Both pictures have noise, below 1 %.
    report("plugin, picture in llvm and in scalar", abs(llvm["mean"] / scalar["mean"] - 1), 0.02)


if __name__ == "__main__":
    kind, *rest = sys.argv[1:]
    if kind == "matrices":
        print(json.dumps(matrices(rest[0], json.loads(Path(rest[1]).read_text()))))
    else:
        print(json.dumps(picture(*rest)))
