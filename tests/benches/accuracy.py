#!/usr/bin/env python3
"""Time of NIST's MIST and of mist for a required accuracy.

    cargo build --release
    tests/benches/accuracy.py /path/to/nist/MIST target/release/mist

Reflectance of facets into the hemisphere and into a cone around the mirror direction. NIST's method is a grid
(`integrationmode = 2`): of the settings of `differential` and `polygonsides` below the cheapest whose error is
small enough, and that of all finer grids too, is timed with NIST's program; which that is, `mist run --compat`
finds, which has the same grids and values. With `-` in place of NIST's binary only that is shown. Ours is
`integrationmode = 20`. Errors are relative, against `integrationmode = 20` with `tolerance = 1e-10`. Times are
those of whole processes, the median of --runs; "per integral" is ours without the start of the process.
"""

import argparse
import os
import shlex
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

DIFFERENTIALS = [1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 3e-6, 1e-6, 3e-7, 1e-7, 3e-8, 1e-8]
SIDES = [360, 3600, 36000]
# Finer grids take too long.
MOST = 2e7
HEMISPHERE = ("hemisphere", "HEMI END", 6.3)
CONE = ("cone of 5 degrees", "CIRCLE CENTER = (0.6,0) ALPHA = 5*atan(1)/45 END", 0.024)
CASES = [(0.3, HEMISPHERE, 1e-6), (0.3, CONE, 1e-6), (0.01, HEMISPHERE, 1e-4), (0.01, CONE, 1e-4)]
MANY = 2000

PROGRAM = """MODEL = Facet_BRDF_Model
VARIABLES:
  i = 0
  incidentangle = 0.6+i*1e-9  incidentpol = (1,0,0,0)  rotation = 0
  differential = {differential}  minsamples = 1  integrationmode = {mode}  polygonsides = {sides}
  {demand}
  $sdf = Gaussian_Slope_Distribution_Function
  #sdf.s = {slope}
END
VARY: {loop} END
INTEGRALS: R = {region} END
OUTPUTS: 1 R END
FILES: format = %.15le\\t END
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("nist", help="command of NIST's MIST, or -")
    parser.add_argument("mist", nargs="?", default="target/release/mist", help="our binary [%(default)s]")
    parser.add_argument("--runs", type=int, default=5, help="runs of each program [%(default)s]")
    args = parser.parse_args()
    for slope, (shape, region, solid_angle), target in CASES:
        print(f"slope {slope}, {shape}, to {target:g}")
        show(args, {"slope": slope, "region": region}, solid_angle, target)


def show(args, case, solid_angle, target):
    mist = [os.path.abspath(args.mist), "run"]
    exact = run(mist, case | adaptive(1e-10))[0]
    off = lambda value: abs(value / exact - 1)
    ours, evaluations, _ = run(mist, case | adaptive(target))
    seconds = statistics.median(run(mist, case | adaptive(target))[2] for _ in range(args.runs))
    many = run(mist + ["--threads", "1"], case | adaptive(target) | {"loop": f"FOR i FROM 0 TO {MANY} BY 1"})[2]
    one = run(mist + ["--threads", "1"], case | adaptive(target))[2]
    each = (many - one) / MANY
    print(f"  mist: error {off(ours):.1e}, {evaluations:.3g} evaluations, {seconds:.4f} s; {each:.2g} s per integral")
    found = cheapest(mist + ["--compat"], case, solid_angle, lambda value: off(value) <= target)
    if not found:
        print("  NIST's method: not reached")
        return
    setting, value, evaluations = found
    chosen = f"differential {setting['differential']:g}, polygonsides {setting['sides']}"
    print(f"  NIST's method: {chosen}: error {off(value):.1e}, {evaluations:.3g} evaluations")
    if args.nist != "-":
        nist = statistics.median(run(shlex.split(args.nist), case | setting)[2] for _ in range(args.runs))
        print(f"  NIST's program: {nist:.3f} s, {nist / seconds:.0f} times ours, {nist / each:.0f} times per integral")


def cheapest(command, case, solid_angle, is_enough):
    """The cheapest setting for which it and all finer ones suffice, its value and its evaluations."""
    found = []
    for sides in SIDES:
        last = None
        for differential in (d for d in reversed(DIFFERENTIALS) if solid_angle / d <= MOST):
            value, evaluations, _ = run(command, case | grid(differential, sides))
            if not is_enough(value):
                break
            last = (grid(differential, sides), value, evaluations)
        found += [last] if last else []
    # NIST's program tests every point against every side.
    return min(found, key=lambda each: (1000 + each[0]["sides"]) * each[2], default=None)


def grid(differential, sides):
    return {"mode": 2, "differential": differential, "sides": sides, "demand": "", "loop": ""}


def adaptive(tolerance):
    return {"mode": 20, "differential": 1e-4, "sides": 360, "demand": f"tolerance = {tolerance}", "loop": ""}


def run(command, values):
    """The integral of the first step, the evaluations that mist prints, and the seconds of the process."""
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "job.mist").write_text(PROGRAM.format(**values))
        started = time.perf_counter()
        done = subprocess.run(command + ["job.mist"], cwd=folder, stdin=subprocess.DEVNULL, capture_output=True)
        seconds = time.perf_counter() - started
        table = Path(folder) / "job.dat"
        if not table.exists():
            sys.exit(f"{command[0]} wrote no table: {done.stderr.decode(errors='replace')}")
        rows = table.read_text().splitlines()
    said = done.stdout.decode(errors="replace").split(" evaluations")[0].split()
    evaluations = float(said[-1]) if command[1:2] == ["run"] else float("nan")
    return float(rows[1].split()[-1]), evaluations, seconds


if __name__ == "__main__":
    main()
