"""Calls of the command line of mist."""

import json
import subprocess
from pathlib import Path

import numpy as np

from frames import geometry


class Mist:
    """One binary and a folder for its files."""

    def __init__(self, binary, folder):
        self.binary, self.folder = Path(binary).resolve(), Path(folder)

    def run(self, *words, text=None):
        done = subprocess.run(
            [self.binary, *map(str, words)], input=text, capture_output=True, text=True,
            cwd=self.folder, check=False)
        if done.returncode != 0:
            raise SystemExit(f"mist {' '.join(map(str, words))}:\n{done.stderr}")
        return done.stdout

    def export(self, material, name, *words):
        """Exports the material (a dict); the path of the file and the output of mist."""
        source = self.folder / "material.json"
        source.write_text(json.dumps(material))
        said = self.run("export", source, *words, "-o", name)
        return str(self.folder / name), said

    def plane(self, material, pairs, nm):
        """Mueller matrices (1/sr) in the basis plane for pairs (l, v)."""
        parameters = {**material["parameters"], "lambda": nm / 1000}
        request = {"model": material["model"], "parameters": parameters, "basis": "plane",
                   "geometries": [geometry(l, v) for l, v in pairs]}
        answer = json.loads(self.run("eval", text=json.dumps(request)))
        return np.array(answer["mueller"], dtype=float).reshape(-1, 4, 4)
