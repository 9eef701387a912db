"""Fits, tolerances and colours."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from types import SimpleNamespace
from typing import Any

import numpy as np

from . import _native
from .program import Program


class Answer(SimpleNamespace):
    """Numbers of an analysis by their names; :meth:`to_dict` has them as dicts and lists."""

    def to_dict(self) -> dict[str, Any]:
        """The answer as dicts and lists."""
        return _plain(self)


def _plain(value: Any) -> Any:
    if isinstance(value, Answer):
        return {name: _plain(each) for name, each in vars(value).items()}
    return [_plain(each) for each in value] if isinstance(value, list) else value


def _answer(text: str) -> Any:
    return json.loads(text, object_hook=lambda found: Answer(**found))


def _program(program: Program | str) -> Program:
    return program if isinstance(program, Program) else Program(program)


def _names(vary: str | Iterable[str]) -> list[str]:
    return [vary] if isinstance(vary, str) else list(vary)


def _table(measured: Any) -> str:
    """A measured table as text: columns by name, a data frame, or the text itself."""
    if isinstance(measured, str):
        return measured
    columns = {str(name): np.asarray(measured[name]) for name in measured}
    rows = ("\t".join(repr(float(x)) for x in row) for row in zip(*columns.values()))
    return "\t".join(columns) + "\n" + "\n".join(rows) + "\n"


def fit(
    program: Program | str,
    measured: str | Mapping[str, Sequence[float]] | Any,
    vary: str | Iterable[str],
    *,
    start: Mapping[str, float] | None = None,
    bounds: Mapping[str, Sequence[float]] | None = None,
    step: float = 1e-4,
    confidence: float = 0.95,
    absolute: bool = False,
    iterations: int = 100,
) -> Answer:
    """Changes variables of a program until its outputs come nearest to measured ones.

    ``measured`` has columns as the results of the program: those of loops tell which step a row is about, those of
    outputs what was measured, ``sigma(OUTPUT)``, ``sigma`` or ``weight`` its uncertainty. It is a text, a dict of
    columns or a data frame. The answer has ``parameters`` (name, value, standard_error, interval), ``correlation``
    and ``residuals``.

    >>> program = '''MODEL = Lambertian_BRDF_Model
    ... VARIABLES: r = 0.5  incidentangle = 0  incidentpol = (1,0,0,0)  rotation = 0
    ...   #reflectance.table = r  END
    ... VARY: FOR incidentangle FROM 0 TO 1 BY 0.5 END
    ... INTEGRALS: f = DIFFERENTIAL CENTER = (0,0) END END
    ... OUTPUTS: 1 f END
    ... FILES: END
    ... '''
    >>> found = fit(program, {"incidentangle": [0, 0.5, 1], "f": [0.2, 0.2, 0.2]}, "r")
    >>> round(found.parameters[0].value, 6)
    0.628319
    """
    settings = {
        "start": {name: float(value) for name, value in (start or {}).items()},
        "bounds": {name: [float(x) for x in pair] for name, pair in (bounds or {}).items()},
        "step": float(step),
        "confidence": float(confidence),
        "absolute": absolute,
        "iterations": iterations,
    }
    native = _program(program)._native
    return _answer(_native.fit_program(native, _table(measured), _names(vary), settings))


def tolerance(program: Program | str, vary: str | Iterable[str], *, step: float = 1e-3) -> Answer:
    """How far the colours of a program move (CIEDE2000) per unit of its variables.

    The program has a section COLOR. The answer has ``parameters``: name, mean, largest, for_one, rows.
    """
    native = _program(program)._native
    return _answer(_native.colour_tolerance(native, _names(vary), float(step)))


def color(
    wavelengths: Sequence[float],
    values: Sequence[float],
    *,
    illuminant: str | float | None = "D65",
    observer: str = "CIE1931_2",
    space: str = "sRGB",
    adaptation: str = "Bradford",
) -> Answer:
    """The colour of a spectrum: wavelengths in nm, reflectances (or, without illuminant, radiances).

    The answer has ``XYZ``, ``white_XYZ``, ``xy``, ``Lab`` and ``rgb``: linear, encoded, u8, in_gamut.

    >>> grey = color([380, 480, 580, 680, 780], [0.5] * 5)
    >>> [round(x, 2) for x in grey.Lab], grey.rgb.u8
    ([76.07, 0.0, 0.0], [188, 188, 188])
    """
    case = {
        "wavelengths": [float(x) for x in wavelengths],
        "values": [float(x) for x in values],
        "illuminant": illuminant,
        "observer": observer,
        "rgb": [[space, adaptation]],
    }
    found = _answer(_native.colours(json.dumps(case))).results[0]
    found.rgb = found.rgb[0]
    return found


def delta_e(first: Sequence[float], second: Sequence[float]) -> Any:
    """CIEDE2000 between L*a*b* values; arrays of the shape (…, 3) broadcast.

    >>> round(delta_e([50, 2.6772, -79.7751], [50, 0, -82.7485]), 4)
    2.0425
    """
    a, b = np.broadcast_arrays(np.asarray(first, float), np.asarray(second, float))
    pairs = zip(a.reshape(-1, 3).tolist(), b.reshape(-1, 3).tolist())
    found = np.array([_native.ciede2000(x, y) for x, y in pairs]).reshape(a.shape[:-1])
    return float(found) if found.ndim == 0 else found
