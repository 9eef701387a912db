"""Asks `mist eval` for Mueller matrices and compares them with those of an independent package."""

import json
import subprocess
import sys

import numpy as np

MIST = sys.argv[1]

PLACES = [(0.3, 0.7, 0.4), (0.9, 0.2, 2.5), (0.1, 1.3, -1.9), (1.2, 1.0, 3.0)]


def matrices(model, parameters, geometries, basis="psps"):
    """4x4 Mueller BRDFs (1/sr) of a model, one per (theta_i, theta_s, phi_s)."""
    names = ("theta_i", "theta_s", "phi_s")
    request = {
        "model": model,
        "parameters": parameters,
        "basis": basis,
        "geometries": [dict(zip(names, g)) for g in geometries],
    }
    done = subprocess.run([MIST, "eval"], input=json.dumps(request), capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(f"{model}: {done.stderr}")
    return [np.reshape(m, (4, 4)) for m in json.loads(done.stdout)["mueller"]]


def mueller(ss, ps, sp, pp):
    """The Mueller matrix of a Jones matrix: I = |s|^2 + |p|^2, U = 2 Re s*p, V = 2 Im s*p."""
    jones = np.array([[ss, ps], [sp, pp]])
    # Coherency vectors (ss*, sp*, ps*, pp*) to Stokes vectors.
    to_stokes = np.array([[1, 0, 0, 1], [1, 0, 0, -1], [0, 1, 1, 0], [0, 1j, -1j, 0]])
    return (to_stokes @ np.kron(jones, jones.conj()) @ np.linalg.inv(to_stokes)).real


def difference(got, expected):
    """Largest difference relative to the largest element."""
    return max(np.abs(a - b).max() / np.abs(b).max() for a, b in zip(got, expected))


def compare_all(comparisons):
    """Prints one line per comparison and ends the program, with failure if one differs too much."""
    failed = False
    for what, whom, compare, tolerance, why in comparisons:
        worst = compare()
        good = worst <= tolerance
        failed |= not good
        mark = "ok" if good else "DIFFERS"
        print(f"{mark:8}{what} ({whom}): {worst:.1e}, allowed {tolerance:.0e}: {why}", flush=True)
    sys.exit(failed)
