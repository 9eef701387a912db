"""Loads the files of `mist export` in renderers: python check.py path/to/mist"""

import sys
import tempfile

import plugin
import polarized
import radiance
import reflection
import tables
import vectorized
from mist import Mist


def main(binary):
    counts = {"passed": 0, "failed": 0}

    def report(what, error, bound):
        good = error <= bound
        counts["passed" if good else "failed"] += 1
        print(f"{'ok  ' if good else 'FAIL'} {what}: {error:.3g} (bound {bound:.3g})", flush=True)

    with tempfile.TemporaryDirectory() as folder:
        mist = Mist(binary, folder)
        for part in (polarized, reflection, plugin, vectorized, tables, radiance):
            part.check(mist, report)
    print(f"{counts['passed']} passed, {counts['failed']} failed")
    return 1 if counts["failed"] else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
