"""OpenMATERIAL lookup tables against JSON Schemas: ours, and ASAM's where OPENMATERIAL_SCHEMA names
its material_brdf_schema.json."""

import json
import os
from pathlib import Path

import jsonschema

from polarized import METAL

SCHEMA = Path(__file__).with_name("openmaterial.schema.json")


def check(mist, report):
    path, _ = mist.export(METAL, "metal_brdf.xompt", "--lambda", "450,550,650", "--grid",
                          "thetai=0:20:80,thetas=0:10:80,phis=0:30:330")
    table = json.loads(Path(path).read_text())
    checker = validator(SCHEMA)
    report("OpenMATERIAL, violations of the schema", len(list(checker.iter_errors(table))), 0)
    if named := os.environ.get("OPENMATERIAL_SCHEMA"):
        report("OpenMATERIAL, violations of ASAM's schema",
               len(list(validator(Path(named)).iter_errors(table))), 0)
    rows = table["brdf"]["lookupTable"]
    report("OpenMATERIAL, rows missing", 3 * 5 * 9 * 12 - len(rows), 0)
    report("OpenMATERIAL, rows out of order", int(rows != sorted(rows)), 0)
    rows[5][4] = -1.0
    report("OpenMATERIAL, negative values accepted", int(checker.is_valid(table)), 0)


def validator(path):
    return jsonschema.Draft7Validator(json.loads(path.read_text()))
