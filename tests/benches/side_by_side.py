#!/usr/bin/env python3
"""Compares the times of mist and NIST's MIST for the bench programs, on one machine, in one run.

    cargo build --release
    tests/benches/side_by_side.py /path/to/nist/MIST target/release/mist

Every program runs --runs times with either binary, in turn, each time in a fresh copy of its folder; the
time is that of the whole process. The tables must agree as closely as the `test.json` of each program says. Without
NIST's binary (`-`) its medians in the `test.json` files are used, which were measured on another machine, and the tables
recorded there. Exit status 1 if a table differs.
"""

import argparse
import json
import math
import os
import re
import shlex
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

PROGRAMS = Path(__file__).resolve().parent.parent / "conformance" / "bench"
NUMBER = re.compile(r"[-+]?(?:nan|inf|(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)")


def main():
    args = arguments()
    tests = sorted(PROGRAMS.glob("*/test.json"))
    cases = [{"name": test.parent.name, **json.loads(test.read_text())} for test in tests]
    print(f"load before: {load()}   threads: {args.threads or os.cpu_count()}   runs: {args.runs}\n")
    print(f"{'program':28} {'NIST s':>9} {'mist s':>9} {'ratio':>8}   table")
    ratios, all_agree = [], True
    for case in cases:
        if args.only and not re.search(args.only, case["name"]):
            continue
        nist, ours, verdict = compare(case, args)
        ratios.append(nist / ours)
        all_agree &= verdict == "agrees"
        print(f"{case['name']:28} {nist:9.4f} {ours:9.4f} {nist / ours:8.1f}   {verdict}", flush=True)
    if ratios:
        mean = math.exp(statistics.fmean(map(math.log, ratios)))
        print(f"{'geometric mean':48} {mean:8.1f}")
    print(f"\nload after: {load()}")
    return 0 if all_agree else 1


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("nist", help="command of NIST's MIST, or - for its figures in test.json")
    parser.add_argument("mist", nargs="?", default="target/release/mist", help="our binary [%(default)s]")
    parser.add_argument("--runs", type=int, default=5, help="runs of each program [%(default)s]")
    parser.add_argument("--threads", type=int, help="threads of mist [one per processor]")
    parser.add_argument("--only", metavar="REGEX", help="only programs with such names")
    args = parser.parse_args()
    if not shutil.which(args.mist):
        parser.error(f"{args.mist} is not a program; `cargo build --release` makes target/release/mist")
    return args


def compare(case, args):
    """Median seconds of both programs, and whether their tables agree."""
    mist = [os.path.abspath(args.mist), "run", "--compat"]
    if args.threads:
        mist += ["--threads", str(args.threads)]
    times = {"nist": [], "mist": []}
    tables = {}
    for _ in range(args.runs):
        if args.nist != "-":
            seconds, tables["nist"] = run(shlex.split(args.nist), case)
            times["nist"].append(seconds)
        seconds, tables["mist"] = run(mist, case)
        times["mist"].append(seconds)
    if args.nist == "-":
        times["nist"] = [case["seconds"]]
        expected = PROGRAMS / case["name"] / "expected"
        tables["nist"] = (expected / results(case)).read_text()
    worst = difference(tables["mist"], tables["nist"], case)
    verdict = "agrees" if worst is None else worst
    return statistics.median(times["nist"]), statistics.median(times["mist"]), verdict


def run(command, case):
    """Seconds of one run in a fresh folder, and the table it wrote."""
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch) / "run"
        shutil.copytree(PROGRAMS / case["name"], folder, ignore=shutil.ignore_patterns("expected"))
        started = time.perf_counter()
        done = subprocess.run(command + case["args"], cwd=folder, stdin=subprocess.DEVNULL, capture_output=True)
        seconds = time.perf_counter() - started
        table = folder / results(case)
        if not table.exists():
            sys.exit(f"{command[0]} wrote no table for {case['name']}: {done.stderr.decode(errors='replace')}")
        return seconds, table.read_text()


def results(case):
    return next(file["name"] for file in case["files"] if file["role"] == "results")


def difference(got, want, case):
    """The first difference of a table, or None."""
    got, want = got.rstrip("\n").split("\n"), want.rstrip("\n").split("\n")
    if len(got) != len(want):
        return f"{len(got)} lines, not {len(want)}"
    for number, (a, b) in enumerate(zip(got, want), 1):
        ours, theirs = numbers(a), numbers(b)
        if NUMBER.sub("#", a).split() != NUMBER.sub("#", b).split() or len(ours) != len(theirs):
            return f"line {number} has other text"
        largest = max((abs(x) for x in theirs if math.isfinite(x)), default=0.0)
        for x, y in zip(ours, theirs):
            allowed = max(case["rtol"] * max(abs(x), abs(y)), case["atol_frac"] * largest)
            if abs(x - y) > allowed or math.isnan(x) != math.isnan(y):
                return f"line {number}: {x!r} is not {y!r}"
    return None


def numbers(line):
    return [float(text) for text in NUMBER.findall(line)]


def load():
    return " ".join(f"{x:.2f}" for x in os.getloadavg())


if __name__ == "__main__":
    sys.exit(main())
