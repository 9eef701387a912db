#!/usr/bin/env python3
"""Writes the first inputs of the fuzz targets, taken from the tests, below corpus/."""

import hashlib
import re
import struct
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent
LONGEST = 4000


def keep(target, data):
    """One input of `target`; small ones only."""
    if isinstance(data, str):
        data = data.encode()
    if len(data) <= LONGEST:
        folder = HERE / "corpus" / target
        folder.mkdir(parents=True, exist_ok=True)
        (folder / hashlib.sha1(data).hexdigest()).write_bytes(data)


def files(*suffixes):
    found = (path for part in ("tests", "mist-format/tests", "rise-bridge/tests", "examples")
             for path in sorted((ROOT / part).rglob("*")))
    return [path for path in found if path.is_file() and path.suffix in suffixes]


def document(fields):
    """A document of the Windows program."""
    data = b"\x11MISTWizardFile1.0"
    for kind, parts in fields:
        data += struct.pack("<I", kind)
        for part in parts:
            number = isinstance(part, int)
            data += struct.pack("<I", part) if number else bytes([len(part)]) + part.encode()
    return data


def archives():
    required = [("minsamples", "1"), ("differential", "(2*deg)^2"), ("incidentangle", "t*deg"),
                ("incidentpol", "(1,0,0,0); all"), ("rotation", "0")]
    return document(
        [(4, ["M", "note"]), (0, ["deg", "atan(1)/45", ""]), (0, ["t", "30", ""])]
        + [(1, [name, value, ""]) for name, value in required]
        + [(2, ["lambda", "0.5", 0, ""]), (2, ["stack", "1.5 0.1", 1, ""]), (3, ["psd", "P", ""]),
           (5, ["t", "0", "60", "5", ""]), (19, ["1", "f", "t*deg", "0", "incidentpol", "1", ""]),
           (22, ["g", "1", "1", "", "0", "0", "0", "0", "0.1", "0.2"]), (9, ["y=f*lambda", ""]),
           (10, ["results", "r.dat", ""]), (18, ["MoreData"])])


for path in files(".mist"):
    for target in ("program", "check", "archive"):
        keep(target, path.read_bytes())
    text = path.read_text(errors="replace")
    for value in re.findall(r'=\s*("[^"]*"|\S+)', text):
        for target in ("expression", "optics", "stack"):
            keep(target, value.strip('"'))
for path in files(".dat", ".txt", ".nk", ".lst", ".stk", ".grt"):
    for target in ("table", "spectrum", "stack"):
        keep(target, path.read_bytes())
for path in files(".mtab"):
    keep("mtab", path.read_bytes())
    text = path.read_text()
    head = text.replace("# columns", "# stokes I\n# columns").split("# columns")[0]
    head = head.replace("360 10 750 nm", "360 10 380 nm")
    keep("spectrum", head + "# columns thetai thetas phis omega 360 370 380\n45 60 0 1 1 2 3\n# end 1 0\n")
keep("archive", archives())
for shift in range(16):
    parts = [bytes((shift + k * 17 * step) % 255 for k in range(8)) for step in range(1, 7)]
    keep("round_trip", b"\xff".join(parts))
