"""Results of sweeps."""

from __future__ import annotations

import hashlib
from typing import Any

import numpy as np

from .chunk import described
from .plan import Plan


class SweepResult:
    """The values of a sweep: an array with an axis for each axis of the sweep, then those of one point."""

    def __init__(self, plan: Plan, values: np.ndarray) -> None:
        self.plan = plan
        self._flat = values
        #: Mueller matrices (…, 4, 4), or outputs (…, steps, outputs).
        self.values = values.reshape(*plan.shape, *values.shape[1:])

    @property
    def axes(self) -> list[dict[str, list[Any]]]:
        """Names with their values, axis by axis."""
        return self.plan.axes

    @property
    def digest(self) -> str:
        """SHA-256 of the plan and of all bits of the values, hexadecimal."""
        found = hashlib.sha256(self.plan.digest.encode())
        found.update(np.ascontiguousarray(self._flat, "<f8").tobytes())
        return found.hexdigest()

    def to_xarray(self):
        """A data array with the names of the axes as dimensions."""
        import xarray

        dims = [next(iter(axis)) for axis in self.axes]
        coordinates = {}
        for dim, axis in zip(dims, self.axes):
            coordinates.update({name: (dim, values) for name, values in axis.items()})
        inner = ["row", "column"] if self.plan.kind == "material" else ["step", "output"]
        if self.plan.kind == "program":
            coordinates["output"] = described(self.plan)
        attributes = {"mist_plan": self.plan.text, "mist_digest": self.digest}
        return xarray.DataArray(self.values, coordinates, [*dims, *inner], attrs=attributes)

    def to_pandas(self):
        """A data frame with a row per point and step."""
        import pandas

        names = described(self.plan)
        rows = self._flat.reshape(-1, len(names))
        steps = len(rows) // self.plan.count
        columns: dict[str, Any] = {
            name: np.repeat(values, steps)
            for name, values in self.plan.points(0, self.plan.count).items()
        }
        columns.update({name: rows[:, at] for at, name in enumerate(names)})
        return pandas.DataFrame(columns).infer_objects()

    def __repr__(self) -> str:
        names = ", ".join(name for axis in self.axes for name in axis)
        return f"SweepResult({self.plan.count} points over {names}; {self.digest[:12]})"
