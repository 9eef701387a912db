"""The mode in which models are evaluated: NIST's numbers or sound ones."""

from __future__ import annotations

_MODE = ["compat"]


def set_mode(mode: str) -> None:
    """``compat``: the numbers of NIST's library; ``sound``: without its defects."""
    if mode not in ("compat", "sound"):
        raise ValueError(f"the mode {mode!r} is neither compat nor sound")
    _MODE[0] = mode


def mode() -> str:
    """The present mode."""
    return _MODE[0]
