"""Names of states of polarization, as Stokes vectors (I, Q, U, V) with Q = I_s - I_p."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from .errors import ParameterError

#: States of light of power 1: Q, U, V.
STATES = {
    "u": (0.0, 0.0, 0.0),
    "s": (1.0, 0.0, 0.0),
    "p": (-1.0, 0.0, 0.0),
    "45": (0.0, 1.0, 0.0),
    "-45": (0.0, -1.0, 0.0),
    "l": (0.0, 0.0, 1.0),
    "r": (0.0, 0.0, -1.0),
}


def stokes(state: str | Sequence[float] | Any, *, detector: bool = False) -> tuple[float, ...]:
    """The Stokes vector of a state, or of a detector that passes light of this state whole.

    >>> stokes("p")
    (1.0, -1.0, 0.0, 0.0)
    >>> stokes("p", detector=True)
    (0.5, -0.5, 0.0, 0.0)
    """
    if isinstance(state, str):
        found = STATES.get(state.lower())
        if found is None:
            raise ParameterError(
                f"{state!r} is not a state of polarization",
                code="polarization/state",
                help=f"write one of {', '.join(STATES)}, or a Stokes vector",
            )
        half = 0.5 if detector and state.lower() != "u" else 1.0
        return (half, *(half * x if x else 0.0 for x in found))
    vector = np.asarray(state, float)
    if vector.shape != (4,):
        raise ParameterError(
            f"a Stokes vector has four components, not the shape {vector.shape}",
            code="polarization/state",
        )
    return tuple(vector.tolist())
