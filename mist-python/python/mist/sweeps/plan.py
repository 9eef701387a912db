"""The plan of a sweep: what is computed at which points, as a text with a digest."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from typing import Any

import numpy as np

from ..errors import ParameterError
from ..material import Material
from ..program import Program

#: Arguments of a material that are directions.
DIRECTIONS = ("theta_i", "theta_s", "phi_s", "rotation")

#: Version of the text.
VERSION = 1


class Paired(dict):
    """Names that vary together; their lists have one length."""


def paired(**values: Any) -> Paired:
    """Names that vary together instead of in all combinations.

    >>> paired(a=[1, 2], b=[3, 4])["b"]
    [3, 4]
    """
    lengths = {len(column) for column in values.values()}
    if len(lengths) != 1:
        raise ValueError(f"paired values have one length, not {sorted(lengths)}")
    return Paired(values)


class Plan:
    """What is computed, and the axes of its points; made by :meth:`of` or from its text."""

    def __init__(self, text: str) -> None:
        self.text = text
        description = json.loads(text)
        self.kind: str = description["kind"]
        self.what: dict[str, Any] = description["what"]
        #: Names with their values, axis by axis.
        self.axes: list[dict[str, list[Any]]] = [
            {name: [_read(value) for value in values] for name, values in axis.items()}
            for axis in description["axes"]
        ]
        self.shape = tuple(len(next(iter(axis.values()))) for axis in self.axes)

    @classmethod
    def of(cls, what: Material | Program | str, over: Mapping[str, Any]) -> Plan:
        """The plan of a sweep of ``what``."""
        from .. import __version__

        axes = []
        for name, values in over.items():
            columns = values if isinstance(values, Paired) else {name: values}
            axes.append({key: [_text(key, x) for x in column] for key, column in columns.items()})
        if any(not column for axis in axes for column in axis.values()):
            raise ValueError("an axis of the sweep has no values")
        if isinstance(what, Material):
            described = {"json": what.to_json(), "mode": what.mode}
            if what._functions:
                raise ParameterError(
                    "a sweep needs a material without functions of the wavelength",
                    code="sweep/function",
                    help="give a table, such as an array of rows (wavelength, n, k)",
                )
            kind = "material"
        else:
            program = what if isinstance(what, Program) else Program(what)
            text, _, _, seed, limits = program._given
            program.steps  # Reads all data files.
            described = {
                "text": text,
                "files": program.files,
                "mode": program.mode,
                "seed": seed,
                "limits": limits,
            }
            kind = "program"
        description = {
            "version": VERSION,
            "mist": __version__,
            "kind": kind,
            "what": described,
            "axes": axes,
        }
        return cls(json.dumps(description, sort_keys=False, ensure_ascii=False))

    @property
    def digest(self) -> str:
        """SHA-256 of the text."""
        return hashlib.sha256(self.text.encode()).hexdigest()

    @property
    def count(self) -> int:
        """Number of points."""
        return int(np.prod(self.shape, dtype=np.int64))

    def points(self, first: int, last: int) -> dict[str, np.ndarray]:
        """The values of all names at the points ``first`` to ``last``."""
        places = np.unravel_index(np.arange(first, last), self.shape) if self.shape else []
        found = {}
        for axis, place in zip(self.axes, places):
            for name, values in axis.items():
                column = np.empty(len(values), object)
                column[:] = values
                found[name] = column[place]
        return found


def _text(name: str, value: Any) -> Any:
    """A value in JSON, numbers with all their bits."""
    if isinstance(value, str):
        return {"text": value}
    if np.iscomplexobj(value):
        return {"complex": [float(value.real).hex(), float(value.imag).hex()]}
    try:
        return float(value).hex()
    except (TypeError, ValueError):
        raise ParameterError(
            f"{name}: a sweep takes numbers, complex numbers and texts, not {type(value).__name__}",
            code="sweep/value",
            part=name,
        ) from None


def _read(value: Any) -> Any:
    if isinstance(value, str):
        return float.fromhex(value)
    if "text" in value:
        return value["text"]
    return complex(*(float.fromhex(part) for part in value["complex"]))
