#!/usr/bin/env python3
"""Counts the instructions of the bench programs on one thread: a measure that does not depend on the load of the machine.

    cargo build --release
    tests/benches/instructions.py target/release/mist            compare with instructions.json
    tests/benches/instructions.py target/release/mist --save     write instructions.json

Needs valgrind. Exit status 1 if a program takes 5 % more instructions than recorded. Counts differ a little between
C libraries and compilers: record them anew on another machine before comparing.
"""

import argparse
import json
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
PROGRAMS = HERE.parent / "conformance" / "bench"
RECORD = HERE / "instructions.json"
MORE = 1.05


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mist", help="the binary")
    parser.add_argument("--only", metavar="REGEX", help="only programs with such names")
    parser.add_argument("--save", action="store_true", help="record the counts")
    args = parser.parse_args()
    if not shutil.which("valgrind"):
        sys.exit("valgrind is not installed")
    recorded = json.loads(RECORD.read_text()) if RECORD.exists() else {}
    worse = False
    for folder in sorted(path for path in PROGRAMS.iterdir() if path.is_dir()):
        name = folder.name
        if args.only and not re.search(args.only, name):
            continue
        count, before = instructions(Path(args.mist).resolve(), folder), recorded.get(name)
        change = f"{count / before - 1:+8.1%}" if before else "     new"
        print(f"{name:28} {count / 1e6:10.1f} M {change}", flush=True)
        worse |= bool(before) and count > MORE * before
        if args.save:
            recorded[name] = count
    if args.save:
        RECORD.write_text(json.dumps(recorded, indent=1) + "\n")
    return 1 if worse and not args.save else 0


def instructions(mist, folder):
    with tempfile.TemporaryDirectory() as scratch:
        run = Path(scratch) / "run"
        shutil.copytree(folder, run, ignore=shutil.ignore_patterns("expected"))
        command = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", mist]
        command += ["run", "--compat", "--threads", "1", f"{folder.name}.mist"]
        done = subprocess.run(command, cwd=run, stdin=subprocess.DEVNULL, capture_output=True, text=True)
        found = re.search(r"Collected : (\d+)", done.stderr)
        if done.returncode != 0 or not found:
            sys.exit(f"{folder.name}: {done.stderr}")
        return int(found.group(1))


if __name__ == "__main__":
    sys.exit(main())
