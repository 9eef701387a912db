#!/usr/bin/env python3
"""Inserts small faults into the language and the integration, and shows the tests that detect them.

    python3 tests/faults/run.py            all faults
    python3 tests/faults/run.py 7 31       these only
    python3 tests/faults/run.py --check    only whether each fault still finds its line

Every fault of faults.json is put into one copy of the project, switched by the environment variable
MIST_FAULT; the copy is built once, then each fault runs the tests until one fails. Prints a line of the
table in README.md for each. Exit status 1 if a fault that changes results survives.
"""

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
PROJECT = HERE.parents[1]
# The quickest first: most faults fall there.
PROGRAMS = [
    ("mist_format", "lib", ["--skip", "the_sound_dialect_reads_what_is_written"]),
    ("conformance", "mist-format/", []),
    ("conformance", "tests/", ["the_language", "shapes_are", "sampling_agrees", "polarization", "tables_and"]),
    ("sound", "tests/", []),
    ("mist_engine", "lib", ["--skip", "advice::"]),
    ("adaptive", "mist-engine/", []),
]
# Crates that get the switch; the others take that of mist_format.
SWITCHED = ["mist-format", "scattering"]
SWITCH = """
/// Whether fault `number` is switched on.
#[must_use]
pub fn fault(number: usize) -> bool {
    static ON: std::sync::OnceLock<usize> = std::sync::OnceLock::new();
    let read = || std::env::var("MIST_FAULT").ok().and_then(|text| text.parse().ok()).unwrap_or(0);
    *ON.get_or_init(read) == number
}
"""


def seeded(faults, folder):
    """Puts every fault into the files below `folder`; returns the faults without a matching line."""
    lost = []
    for number, fault in enumerate(faults, 1):
        path = folder / fault["file"]
        text = path.read_text(encoding="utf-8") if path.exists() else ""
        if text.count(fault["find"]) != 1:
            lost.append(f'{number}: {fault["file"]}: {fault["find"]}')
            continue
        crate = "crate" if fault["file"].split("/")[0] in SWITCHED else "mist_format"
        written = fault["write"].replace("FAULT", f"{crate}::fault({number})")
        path.write_text(text.replace(fault["find"], written), encoding="utf-8")
    return lost


def copied(folder):
    files = subprocess.run(
        ["git", "ls-files", "-z"], cwd=PROJECT, check=True, capture_output=True, text=True
    ).stdout.split("\0")
    for name in filter(None, files):
        target = folder / name
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(PROJECT / name, target)


def built(folder):
    """Builds the tests; gives their programs with the folders they run in, in the order of PROGRAMS."""
    command = ["cargo", "test", "--workspace", "--release", "--locked", "--no-run", "--message-format", "json"]
    # Cargo identifies copies of one project, so this one has its own target folder.
    target = Path(os.environ.get("CARGO_TARGET_DIR", PROJECT / "target")).resolve() / "faults"
    environment = dict(os.environ, CARGO_TARGET_DIR=str(target))
    lines = subprocess.run(
        command, cwd=folder, env=environment, check=True, stdout=subprocess.PIPE, text=True
    ).stdout.splitlines()
    made = [json.loads(line) for line in lines if line.startswith("{")]
    made = [m for m in made if m.get("profile", {}).get("test") and m.get("executable")]
    found = []
    for name, place, arguments in PROGRAMS:
        for m in made:
            source = str(Path(m["target"]["src_path"]).relative_to(folder))
            if m["target"]["name"] == name and ("lib" in m["target"]["kind"] if place == "lib" else source.startswith(place)):
                found.append((m["executable"], folder / source.split("/")[0], arguments))
    assert len(found) == len(PROGRAMS), f"{len(found)} of {len(PROGRAMS)} test programs"
    return found


def caught_by(number, programs):
    """The first tests that fail with a fault, or None."""
    for program, folder, arguments in programs:
        environment = dict(os.environ, MIST_FAULT=str(number), CARGO_MANIFEST_DIR=str(folder))
        try:
            run = subprocess.run(
                [program, *arguments], cwd=folder, env=environment, capture_output=True, text=True, timeout=300
            )
        except subprocess.TimeoutExpired:
            return "does not end"
        if run.returncode != 0:
            names = re.findall(r"^test (\S+) \.\.\. FAILED", run.stdout, re.MULTILINE)
            return names[0] if names else "a test program that stops"
    return None


def main():
    faults = json.loads((HERE / "faults.json").read_text(encoding="utf-8"))
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary).resolve() / "mist"
        copied(folder)
        lost = seeded(faults, folder)
        for line in lost:
            print(f"no longer there: {line}", file=sys.stderr)
        if lost or "--check" in sys.argv:
            return 1 if lost else 0
        for crate in SWITCHED:
            library = folder / crate / "src/lib.rs"
            library.write_text(library.read_text(encoding="utf-8") + SWITCH, encoding="utf-8")
        programs = built(folder)
        assert caught_by(0, programs) is None, "a test fails without any fault"
        wanted = [int(text) for text in sys.argv[1:]] or range(1, len(faults) + 1)
        survived = 0
        for number in wanted:
            fault = faults[number - 1]
            seen = caught_by(number, programs)
            harmless = fault.get("changes_nothing")
            survived += seen is None and harmless is None
            answer = f"`{seen}`" if seen else f"changes nothing: {harmless}" if harmless else "**survives**"
            what = fault["what"].replace("|", "\\|")
            print(f"| {number} | {what} | {answer} |", flush=True)
        return 1 if survived else 0


if __name__ == "__main__":
    sys.exit(main())
