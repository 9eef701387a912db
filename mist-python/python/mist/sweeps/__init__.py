"""Sweeps: a material or a program at many values, in chunks that any engine computes."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..material import Material
from ..program import Program
from .engines import results
from .plan import Paired, Plan, paired
from .result import SweepResult
from .shards import read_shards
from .store import opened

__all__ = ["Paired", "Plan", "SweepResult", "paired", "read_shards", "sweep"]

#: Points of a chunk without ``chunk``: materials are cheap, programs are not.
USUAL_CHUNK = {"material": 4096, "program": 16}


def sweep(
    what: Material | Program | str,
    over: Mapping[str, Any],
    *,
    engine: Any = None,
    out: str | None = None,
    chunk: int | None = None,
    retries: int = 2,
    progress: Any = None,
    resume: bool = True,
    threads: int = 1,
) -> SweepResult:
    """Evaluates ``what`` at every combination of the values in ``over``, the first name slowest.

    Names of a material are its parameters, ``wavelength`` and the angles ``theta_i``, ``theta_s``, ``phi_s`` and
    ``rotation`` (0 unless given); its results are Mueller matrices. Names of a program are its variables; its results
    are the outputs of all steps. :func:`paired` varies names together.

    ``engine`` is None (this process), a number of processes, an executor, a client of Dask, or ``"ray"``. With
    ``out``, a name that ends in ``.parquet`` or ``.zarr``, chunks are written as they are finished, and the same call
    goes on after an interruption. ``retries`` counts lost workers; an error of mist ends the sweep with its index.
    ``progress`` is called with the fraction done. The digest does not depend on engine, chunks and ``out``.

    >>> import mist
    >>> white = mist.Material("Lambertian_BRDF_Model")
    >>> found = sweep(white, {"wavelength": [0.5, 0.6], "theta_s": [0.1, 0.2, 0.3]})
    >>> found.values.shape, len(found.digest)
    ((2, 3, 4, 4), 64)
    """
    plan = Plan.of(what, over)
    size = chunk or USUAL_CHUNK[plan.kind]
    if size < 1:
        raise ValueError(f"chunk is {chunk}, not a positive number")
    chunks = [(first, min(first + size, plan.count)) for first in range(0, plan.count, size)]
    store = opened(out, plan, size, resume)
    missing = [each for each in chunks if each not in store]
    done = len(chunks) - len(missing)
    for span, values in results(engine, plan.text, missing, retries, threads):
        store.put(span, values)
        done += 1
        if progress is not None:
            progress(done / len(chunks))
    return SweepResult(plan, store.values(chunks))


