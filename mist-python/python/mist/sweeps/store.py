"""Stores of sweeps: memory, a folder of Parquet files, an array of Zarr."""

from __future__ import annotations

import hashlib
import json
import os
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import MistError
from .chunk import described
from .plan import Plan

Span = tuple[int, int]


def opened(out: str | None, plan: Plan, size: int, resume: bool) -> Any:
    """The store that ``out`` names."""
    if out is None:
        return Memory()
    kind = Path(out).suffix
    stores = {".parquet": ParquetFolder, ".zarr": ZarrArray}
    if kind not in stores:
        raise ValueError(f"{out!r} ends neither in .parquet nor in .zarr")
    return stores[kind](Path(out), plan, size, resume)


def checksum(values: np.ndarray) -> str:
    """SHA-256 of the bits of the values."""
    return hashlib.sha256(np.ascontiguousarray(values, "<f8").tobytes()).hexdigest()


def refuse(path: Path) -> None:
    """Refuses a store of another sweep."""
    raise MistError(
        f"{path} belongs to another sweep",
        code="sweep/foreign",
        help="choose another name, or remove it",
    )


class Memory:
    """Chunks in memory."""

    def __init__(self) -> None:
        self._chunks: dict[Span, np.ndarray] = {}

    def __contains__(self, span: Span) -> bool:
        return span in self._chunks

    def put(self, span: Span, values: np.ndarray) -> None:
        """Keeps a chunk."""
        self._chunks[span] = values

    def values(self, spans: list[Span]) -> np.ndarray:
        """All chunks in order."""
        return np.concatenate([self._chunks[span] for span in spans])


class ParquetFolder:
    """A file per chunk, renamed when it is whole; a row per point and step."""

    def __init__(self, path: Path, plan: Plan, size: int, resume: bool) -> None:
        import pyarrow.parquet

        self._parquet = pyarrow.parquet
        self._arrow = pyarrow
        self._path, self._plan = path, plan
        self._names = described(plan)
        self._whole: set[Span] = set()
        path.mkdir(parents=True, exist_ok=True)
        for file in sorted(path.glob("part-*.parquet")):
            self._look_at(file, resume)

    def _look_at(self, file: Path, resume: bool) -> None:
        """Keeps a part of this sweep, refuses one of another, removes a damaged one."""
        try:
            table = self._parquet.read_table(file)
            given = json.loads(table.schema.metadata[b"mist_sweep"])
        except (OSError, KeyError, TypeError, ValueError, self._arrow.ArrowException):
            file.unlink()
            return
        if given["plan"] != self._plan.digest:
            refuse(self._path)
        if resume and checksum(self._numbers(table)) == given["values"]:
            self._whole.add((given["first"], given["last"]))
        else:
            file.unlink()

    def _file(self, span: Span) -> Path:
        return self._path / f"part-{span[0]:012d}-{span[1]:012d}.parquet"

    def __contains__(self, span: Span) -> bool:
        return span in self._whole

    def put(self, span: Span, values: np.ndarray) -> None:
        """Writes a chunk."""
        first, last = span
        steps = values.shape[1] if self._plan.kind == "program" else 1
        rows = values.reshape((last - first) * steps, -1)
        columns: dict[str, Any] = {"point": np.repeat(np.arange(first, last), steps)}
        if steps > 1:
            columns["step"] = np.tile(np.arange(steps), last - first)
        for name, column in self._plan.points(first, last).items():
            columns.update(_plain(name, np.repeat(column, steps)))
        columns.update({name: rows[:, at] for at, name in enumerate(self._names)})
        metadata = {
            "plan": self._plan.digest,
            "first": first,
            "last": last,
            "shape": values.shape[1:],
            "values": checksum(rows),
        }
        table = self._arrow.table(columns).replace_schema_metadata(
            {"mist_sweep": json.dumps(metadata), "mist_plan": self._plan.text}
        )
        file = self._file(span)
        part = file.with_suffix(".tmp")
        self._parquet.write_table(table, part, compression="zstd")
        os.replace(part, file)
        self._whole.add(span)

    def _numbers(self, table: Any) -> np.ndarray:
        return np.stack([table[name].to_numpy() for name in self._names], axis=-1)

    def values(self, spans: list[Span]) -> np.ndarray:
        """All chunks in order."""
        chunks = []
        for span in spans:
            table = self._parquet.read_table(self._file(span))
            shape = json.loads(table.schema.metadata[b"mist_sweep"])["shape"]
            chunks.append(self._numbers(table).reshape(span[1] - span[0], *shape))
        return np.concatenate(chunks)


def _plain(name: str, column: np.ndarray) -> dict[str, np.ndarray]:
    """A column of an axis: numbers, texts, or real and imaginary parts."""
    if any(isinstance(x, complex) for x in column):
        z = column.astype(complex)
        return {f"{name}.n": z.real, f"{name}.k": z.imag}
    if any(isinstance(x, str) for x in column):
        return {name: column.astype(str)}
    return {name: column.astype(float)}


class ZarrArray:
    """The array ``values`` of a Zarr group, NaN until it is computed, with the list of whole chunks."""

    def __init__(self, path: Path, plan: Plan, size: int, resume: bool) -> None:
        import zarr

        self._zarr = zarr
        self._path, self._plan, self._size = path, plan, size
        self._group = zarr.open_group(str(path), mode="a")
        known = self._group.attrs.get("plan")
        if known is not None and known != plan.digest:
            refuse(path)
        same = known is not None and self._group.attrs.get("chunk") == size
        whole = self._group.attrs.get("whole", {}) if resume and same else {}
        self._whole = {
            span: digest
            for span, digest in ((_span(text), digest) for text, digest in whole.items())
            if checksum(self._group["values"][span[0] : span[1]]) == digest
        }
        self._group.attrs.update({"plan": plan.digest, "plan_text": plan.text, "chunk": size})

    def __contains__(self, span: Span) -> bool:
        return span in self._whole

    def put(self, span: Span, values: np.ndarray) -> None:
        """Writes a chunk."""
        if "values" not in self._group or not self._whole:
            shape = (self._plan.count, *values.shape[1:])
            self._group.create_array(
                "values",
                shape=shape,
                chunks=(min(self._size, shape[0]), *shape[1:]),
                dtype="f8",
                fill_value=float("nan"),
                overwrite=True,
            )
        self._group["values"][span[0] : span[1]] = values
        self._whole[span] = checksum(values)
        self._group.attrs["whole"] = {
            f"{first}-{last}": digest for (first, last), digest in sorted(self._whole.items())
        }

    def values(self, spans: list[Span]) -> np.ndarray:
        """All chunks in order."""
        return np.asarray(self._group["values"][:])


def _span(text: str) -> Span:
    first, last = text.split("-")
    return int(first), int(last)
