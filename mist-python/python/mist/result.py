"""Results of programs as arrays, and in the forms of other packages."""

from __future__ import annotations

import functools
import html
from typing import TYPE_CHECKING, Any

import numpy as np

from .errors import Diagnostic, read_diagnostics

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .program import Program

#: Rows that a notebook shows.
SHOWN_ROWS = 20


class Result:
    """The result of a run: numbers before they are rounded, and the texts that `mist run` writes."""

    __slots__ = ("__dict__", "_columns", "_native", "program")

    def __init__(self, native: Any, columns: tuple, program: Program) -> None:
        self._native = native
        self._columns = columns
        self.program = program

    @property
    def text(self) -> str:
        """The table, byte for byte as `mist run` writes it."""
        return self._native.results

    @property
    def listing(self) -> str:
        """The listing."""
        return self._native.listing

    @property
    def samples(self) -> str:
        """The samples, if the program wants them."""
        return self._native.samples

    @property
    def steps(self) -> int:
        """Number of steps."""
        return self._native.steps

    @property
    def evaluations(self) -> float:
        """Evaluations of the model."""
        return self._native.evaluations

    @property
    def seconds(self) -> float:
        """Seconds the run took."""
        return self._native.seconds

    @functools.cached_property
    def notices(self) -> tuple[Diagnostic, ...]:
        """Warnings of the program, and remarks of its models."""
        return read_diagnostics(self._native.notices)

    @functools.cached_property
    def coordinates(self) -> dict[str, NDArray[Any]]:
        """Values of the loops with all their bits, one per step; texts where they are not numbers."""
        titles = self._columns[0]
        numbers = self._native.coordinates()
        texts = self._native.loops
        found: dict[str, NDArray[Any]] = {}
        for at, title in enumerate(titles):
            column = numbers[:, at] if len(numbers) else np.empty(0)
            if np.isnan(column).any():
                column = np.array(texts[at :: len(titles)], dtype=object)
            found[title] = column
        return found

    @functools.cached_property
    def outputs(self) -> dict[str, NDArray[np.float64]]:
        """Values of the outputs before they are rounded, one per step."""
        return self._named(self._columns[1], self._native.outputs())

    @functools.cached_property
    def errors(self) -> dict[str, NDArray[np.float64]]:
        """Estimated errors of the integrals; the error of R is called ``R.error``."""
        return self._named([title for title, _ in self._columns[2]], self._native.errors())

    @staticmethod
    def _named(titles: list[str], numbers: NDArray[np.float64]) -> dict[str, NDArray[np.float64]]:
        if not len(numbers):
            return {title: np.empty(0) for title in titles}
        return {title: numbers[:, at] for at, title in enumerate(titles)}

    def __getitem__(self, name: str) -> NDArray[Any]:
        for columns in (self.outputs, self.errors, self.coordinates):
            if name in columns:
                return columns[name]
        raise KeyError(name)

    def __len__(self) -> int:
        return self.steps

    @property
    def columns(self) -> dict[str, NDArray[Any]]:
        """All columns: loops, outputs, errors."""
        return {**self.coordinates, **self.outputs, **self.errors}

    def _metadata(self) -> dict[str, str]:
        from . import __version__

        return {
            "mist_version": __version__,
            "mist_program": self.program.text,
            "mist_mode": self.program.mode,
            "mist_seed": str(self.program.seed),
        }

    def to_pandas(self):
        """A data frame with a row per step."""
        import pandas

        frame = pandas.DataFrame(self.columns)
        frame.attrs.update(self._metadata())
        return frame

    def to_arrow(self):
        """A table of Arrow with a row per step; its metadata has program, version, mode and seed."""
        import pyarrow

        columns = {
            name: values.astype(str) if values.dtype == object else values
            for name, values in self.columns.items()
        }
        table = pyarrow.table({name: pyarrow.array(values) for name, values in columns.items()})
        return table.replace_schema_metadata(self._metadata())

    def to_xarray(self):
        """A data set whose dimensions are the loops if the steps are their product, else ``step``.

        The error of R is the variable ``R.error``, named in its ``ancillary_variables``.
        """
        import xarray

        shape, axes = self._product()
        if shape is None:
            dims: tuple[str, ...] = ("step",)
            coordinates: dict[str, Any] = {
                name: ("step", values) for name, values in self.coordinates.items()
            }
            shape = (self.steps,)
        else:
            dims = tuple(axes)
            coordinates = dict(axes)
        data = {}
        for name, values in {**self.outputs, **self.errors}.items():
            data[name] = (dims, values.reshape(shape))
        dataset = xarray.Dataset(data, coordinates, self._metadata())
        for title, after in self._columns[2]:
            if after is not None:
                output = self._columns[1][after]
                dataset[output].attrs["ancillary_variables"] = title
        return dataset

    def _product(self) -> tuple[tuple[int, ...] | None, dict[str, NDArray[Any]]]:
        """The lengths of the loops and their values, if the steps are the product of the loops."""
        if not self.coordinates or not self.steps or len(self.coordinates) < len(self._columns[0]):
            return None, {}
        axes: dict[str, NDArray[Any]] = {}
        for name, column in self.coordinates.items():
            _, first = np.unique(column.astype(str) if column.dtype == object else column, return_index=True)
            axes[name] = column[np.sort(first)]
        # The last declared loop runs fastest and stands first among the columns.
        order = list(axes)[::-1]
        shape = tuple(len(axes[name]) for name in order)
        if int(np.prod(shape)) != self.steps:
            return None, {}
        grids = np.meshgrid(*(np.arange(n) for n in shape), indexing="ij")
        for name, grid in zip(order, grids):
            if not (axes[name][grid.ravel()] == self.coordinates[name]).all():
                return None, {}
        return shape, {name: axes[name] for name in order}

    def _repr_html_(self) -> str:
        names = list(self.columns)
        rows = min(self.steps, SHOWN_ROWS)
        head = "".join(f"<th>{html.escape(name)}</th>" for name in names)
        cells = list(self.columns.values())
        body = "".join(
            "<tr>" + "".join(f"<td>{html.escape(_cell(column[k]))}</td>" for column in cells) + "</tr>"
            for k in range(rows)
        )
        more = f"<p>{self.steps - rows} more rows</p>" if self.steps > rows else ""
        return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>{more}"

    def __repr__(self) -> str:
        names = ", ".join(self.outputs)
        return f"Result({self.steps} steps: {names}; {self.evaluations:.3g} evaluations)"


def _cell(value: Any) -> str:
    return str(value) if isinstance(value, str) else f"{float(value):.6g}"
