"""The values of a chunk: a pure function of the plan's text and the range of points."""

from __future__ import annotations

import functools

import numpy as np

from .. import _native
from ..errors import MistError
from ..material import Material
from ..program import Program
from .plan import DIRECTIONS, Plan


@functools.lru_cache(maxsize=4)
def _prepared(text: str) -> tuple[Plan, Material | Program]:
    plan = Plan(text)
    what = plan.what
    compat = what["mode"] == "compat"
    if plan.kind == "material":
        return plan, Material.from_json(what["json"], compat=compat)
    program = Program(
        what["text"] + "\n", what["files"], compat=compat, seed=what["seed"], limits=what["limits"]
    )
    return plan, program


def compute(text: str, first: int, last: int, threads: int = 1) -> np.ndarray:
    """The results at the points ``first`` to ``last`` of the plan."""
    _native.set_threads(threads)
    plan, what = _prepared(text)
    points = plan.points(first, last)
    values = _matrices if isinstance(what, Material) else _outputs
    return values(what, points, first, last - first)


def _matrices(material: Material, points: dict, first: int, count: int) -> np.ndarray:
    angles = {name: np.zeros(count) for name in DIRECTIONS}
    wavelength = points.pop("wavelength", None)
    for name in DIRECTIONS:
        if name in points:
            angles[name] = points.pop(name).astype(float)
    values = np.empty((count, 4, 4))
    groups: dict[tuple, list[int]] = {}
    for at, key in enumerate(zip(*points.values()) if points else ((),) * count):
        groups.setdefault(key, []).append(at)
    for key, places in groups.items():
        try:
            here = material.replace(dict(zip(points, key))) if points else material
            waves = None if wavelength is None else wavelength[places].astype(float)
            values[places] = here.mueller(
                *(angles[name][places] for name in DIRECTIONS), wavelength=waves
            )
        except MistError as error:
            raise _placed(error, first + places[0])
    return values


def _outputs(program: Program, points: dict, first: int, count: int) -> np.ndarray:
    rows = []
    for at in range(count):
        try:
            result = program.run(values={name: float(x[at]) for name, x in points.items()}, threads=1)
        except MistError as error:
            raise _placed(error, first + at)
        rows.append(np.stack(list(result.outputs.values()), axis=-1))
    return np.array(rows, float)


def _placed(error: MistError, index: int) -> MistError:
    """The error with the index of its point."""
    error.args = (f"point {index}: {error.args[0]}", *error.args[1:])
    return error


def described(plan: Plan) -> list[str]:
    """Names of the numbers of one point: elements of a matrix, or outputs."""
    if plan.kind == "material":
        return [f"m{row}{column}" for row in range(4) for column in range(4)]
    return _prepared(plan.text)[1].columns[1]


