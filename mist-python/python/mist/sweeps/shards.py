"""Shards of ``mist run --shard``, read as one table."""

from __future__ import annotations

import glob
import os
import tempfile
from collections.abc import Iterable
from pathlib import Path

import numpy as np

from .. import _native
from ..errors import MistError


def read_shards(shards: str | os.PathLike[str] | Iterable[str | os.PathLike[str]]) -> dict[str, np.ndarray]:
    """The columns of the table that the shards of a run make: a pattern, or all their paths.

    The numbers are those of the table that ``mist merge`` writes; columns that are not numbers are texts.
    """
    if isinstance(shards, (str, os.PathLike)):
        paths = sorted(glob.glob(os.fspath(shards)))
        if not paths:
            raise MistError(f"no file fits {os.fspath(shards)!r}", code="sweep/no-shards")
    else:
        paths = [os.fspath(path) for path in shards]
    with tempfile.TemporaryDirectory() as folder:
        table = Path(folder) / "table.dat"
        steps = _native.merge_shards([Path(path) for path in paths], table)
        lines = table.read_text().splitlines()
    # Lines of the program's headers, the names, the steps.
    names, *rows = (line.rstrip("\t").split("\t") for line in lines[-steps - 1 :])
    return {name.strip(): _column([row[at] for row in rows]) for at, name in enumerate(names)}


def _column(texts: list[str]) -> np.ndarray:
    try:
        return np.array([float(text) for text in texts])
    except ValueError:
        return np.array([text.strip() for text in texts], dtype=object)
