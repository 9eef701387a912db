"""Colour tables of materials and files of renderers."""

from __future__ import annotations

import json
import os
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _native

if TYPE_CHECKING:
    from .material import Material

#: Nodes of a table that is asked for without angles, degrees.
USUAL = {"thetai": "0:15:75", "thetas": "0:15:75", "phis": "0:30:180"}


def _nodes(values: Any) -> str:
    """Nodes as the text of a request: ``0:15:75``, or numbers."""
    if isinstance(values, str):
        return values
    return ",".join(repr(float(x)) for x in np.atleast_1d(np.asarray(values, float)))


class Table:
    """The colours of a material over directions; angles are degrees, wavelengths nm, as in the files.

    ``columns`` has a column per name: thetai, thetas, phis, omega, R, G, B, I and, with Stokes components, RQ, ….
    """

    def __init__(self, texts: dict[str, str]) -> None:
        self._texts = texts
        description = json.loads(texts["json"])
        #: The table as ``mist table -o x.json`` writes it.
        self.json: dict[str, Any] = description

    @property
    def columns(self) -> dict[str, np.ndarray]:
        """The columns of the table by name."""
        lines = [line for line in self._texts["mtab"].splitlines() if line]
        names = next(line for line in lines if line.startswith("# columns")).split()[2:]
        rows = np.array([line.split() for line in lines if not line.startswith("#")], float)
        return {name: rows[:, at] for at, name in enumerate(names)}

    @property
    def rgb(self) -> np.ndarray:
        """Linear RGB of each row, of the shape (rows, 3)."""
        columns = self.columns
        return np.stack([columns[name] for name in "RGB"], axis=-1)

    def text(self, format: str = "mtab") -> str:
        """The table in the format mtab, mspd, json or svg."""
        return self._texts[format]

    def write(self, path: str | os.PathLike[str]) -> None:
        """Writes the table; the extension is its format."""
        path = Path(path)
        format = path.suffix.removeprefix(".")
        if format not in self._texts:
            raise ValueError(f"{path} does not end in one of {', '.join(self._texts)}")
        path.write_text(self._texts[format])

    def _repr_svg_(self) -> str:
        return self._texts["svg"]

    def __repr__(self) -> str:
        return f"Table({len(self.columns['R'])} rows)"


def table(
    material: Material,
    *,
    thetai: Any = None,
    thetas: Any = None,
    phis: Any = None,
    patch: str = "point",
    wavelengths: Any = "360:5:830",
    illuminant: str = "D65",
    observer: str = "CIE1931_2",
    space: str = "sRGB",
    adaptation: str = "Bradford",
    quantity: str = "brdf",
    filters: Sequence[str] = (),
    incident: Sequence[float] = (1, 0, 0, 0),
    stokes: bool = False,
    name: str = "material",
) -> Table:
    """The colours of a material on a grid of angles in degrees, at wavelengths in nm.

    >>> import mist
    >>> white = mist.Material("Lambertian_BRDF_Model")
    >>> found = table(white, thetai=[0, 45], thetas=[0], phis=[0], wavelengths="400:100:700")
    >>> found.rgb.round(3).tolist()
    [[0.318, 0.318, 0.318], [0.318, 0.318, 0.318]]
    """
    given = {"thetai": thetai, "thetas": thetas, "phis": phis}
    if all(nodes is None for nodes in given.values()):
        given = USUAL
    query = {
        **{axis: _nodes(nodes) for axis, nodes in given.items() if nodes is not None},
        "patch": patch,
        "lambda": _nodes(wavelengths),
        "incident": _nodes(incident),
        "stokes": stokes,
        "colours": {
            "illuminant": illuminant,
            "observer": observer,
            "space": space,
            "adaptation": adaptation,
            "quantity": quantity,
            "filters": list(filters),
        },
    }
    formats = ["mtab", "mspd", "json", "svg"]
    texts = _native.colour_table(material._native, name, json.dumps(query), formats)
    return Table(dict(zip(formats, texts)))


def export(
    material: Material,
    path: str | os.PathLike[str],
    *,
    wavelengths: Any = None,
    grid: str | None = None,
    rgb: bool = False,
    plugin: bool = False,
) -> str:
    """Writes the file of a renderer, whose format is that of its name; gives the line about it.

    The formats are those of ``mist export``; ``wavelengths`` are nm. The file appears when it is whole.
    """
    path = Path(path)
    waves = None if wavelengths is None else _nodes(wavelengths)
    data, line = _native.export_file(material._native, path, waves, grid, rgb, plugin)
    part = path.with_name(path.name + ".part")
    part.write_bytes(data)
    os.replace(part, path)
    return line
