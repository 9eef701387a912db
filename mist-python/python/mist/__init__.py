"""mist: polarized scattering models as numpy arrays.

>>> import mist
>>> from mist import deg
>>> gold = mist.Material("Facet_BRDF_Model", wavelength=0.6, substrate=0.25 + 3.1j)
>>> gold.mueller(60 * deg, [50 * deg, 60 * deg]).shape
(2, 4, 4)

Angles are radians, lengths µm.
"""

from __future__ import annotations

import math
import os

from . import _native, models
from .analysis import color, delta_e, fit, tolerance
from ._native import set_threads, threads
from .errors import (
    Diagnostic,
    LimitError,
    MistError,
    MistWarning,
    NotCoherent,
    ParameterError,
    ProgramError,
    ServiceError,
    StepError,
)
from .material import Material
from .models import ModelObject, find
from .program import Program, run
from .result import Result
from .sweeps import paired, read_shards, sweep
from .table import Table, export, table
from .values import complex_text, number_text

#: Radians of a degree.
deg: float = math.pi / 180

__version__: str = _native.version

__all__ = [
    "Diagnostic",
    "LimitError",
    "Material",
    "MistError",
    "MistWarning",
    "ModelObject",
    "NotCoherent",
    "ParameterError",
    "Program",
    "ProgramError",
    "Result",
    "ServiceError",
    "StepError",
    "Table",
    "color",
    "complex_text",
    "deg",
    "delta_e",
    "export",
    "find",
    "fit",
    "models",
    "number_text",
    "paired",
    "read_shards",
    "run",
    "set_threads",
    "sweep",
    "table",
    "threads",
    "tolerance",
]



def __getattr__(name: str):
    """``Service`` with its modules for HTTP, when it is used."""
    if name == "Service":
        from .service import Service

        return Service
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


if hasattr(os, "register_at_fork"):
    # A forked process has none of the threads.
    os.register_at_fork(after_in_child=_native.forget_threads)
