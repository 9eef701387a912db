"""Programs: check, run, results."""

from __future__ import annotations

import os
import warnings
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from . import _native
from .errors import Diagnostic, MistWarning, read_diagnostics
from .result import Result

#: Called with the fraction that is done, at most ten times a second; an exception ends the run.
Progress = Callable[[float], object]

#: Names of the limits of a run, in the order of the extension module.
LIMITS = ("evaluations", "directions", "steps", "seconds")


class Program:
    """A compiled program.

    ``source`` is its text, or the path of a file: texts have line breaks. ``files`` has texts of
    data files by name; others are looked up in the working folder, beside the program and along
    SCATMECH.

    >>> white = Program('''
    ...     MODEL = Lambertian_BRDF_Model
    ...     VARIABLES: incidentangle = 0  incidentpol = (1,0,0,0)  rotation = 0
    ...         differential = 0.1  minsamples = 20 END
    ...     VARY: FOR incidentangle FROM 0 TO 1 BY 0.5 END
    ...     INTEGRALS: R = HEMI END END
    ...     OUTPUTS: 1 R END
    ...     FILES: END
    ... ''')
    >>> white.steps, white.model
    (3, 'Lambertian_BRDF_Model')
    >>> result = white.run()
    >>> result["R"].round(9).tolist()
    [1.0, 1.0, 1.0]
    """

    __slots__ = ("_given", "_native")

    def __init__(
        self,
        source: str | os.PathLike[str],
        files: Mapping[str, str] | None = None,
        *,
        compat: bool = False,
        seed: int = 1,
        limits: Mapping[str, float] | None = None,
    ) -> None:
        text, path = _source(source)
        unknown = set(limits or {}) - set(LIMITS)
        if unknown:
            raise TypeError(f"{sorted(unknown)[0]} is not one of the limits {', '.join(LIMITS)}")
        bounds = [None if (limits or {}).get(name) is None else float(limits[name]) for name in LIMITS]
        self._given = (text, path, compat, seed, dict(limits or {}))
        self._native = _native.Program(text, dict(files or {}), path, compat, seed, bounds)

    @property
    def text(self) -> str:
        """The text."""
        return self._native.text

    @property
    def files(self) -> dict[str, str]:
        """Texts of the data files that were read."""
        return self._native.files

    @property
    def model(self) -> str:
        """Name of the class of the model."""
        return self._native.model

    @property
    def mode(self) -> str:
        """``sound``, or ``compat`` for NIST's numbers."""
        return "compat" if self._given[2] else "sound"

    @property
    def seed(self) -> int:
        """Seed of the Monte Carlo modes."""
        return self._given[3]

    @property
    def columns(self) -> tuple[list[str], list[str]]:
        """Names of the loops, the first one slowest, and of the outputs."""
        loops, outputs, _ = self._native.columns()
        return loops, outputs

    @property
    def steps(self) -> int:
        """Number of steps of its loops."""
        return self._native.steps()

    def check(self) -> tuple[Diagnostic, ...]:
        """Everything in its text that is probably a mistake."""
        return read_diagnostics(self._native.advice())

    def format(self) -> str:
        """The text in the layout of ``mist fmt``."""
        return _native.formatted(self.text, self._given[2])

    def run(
        self,
        *,
        values: Mapping[str, float] | None = None,
        threads: int | None = None,
        progress: bool | Progress | None = None,
    ) -> Result:
        """Runs it, with other ``values`` of some variables.

        ``progress`` is called with the fraction done; True shows a bar of tqdm.
        """
        given = [(name, float(value)) for name, value in (values or {}).items()]
        with _Bar(progress) as report:
            native = self._native.run(given, threads, report)
        result = Result(native, self._native.columns(), self)
        for notice in result.notices:
            warning = MistWarning(str(notice), code=notice.code)
            warnings.warn(warning, stacklevel=2)
        return result

    def __reduce__(self):
        text, path, compat, seed, limits = self._given
        return _restore, (text, self.files, path, compat, seed, limits)

    def _identity(self) -> tuple:
        text, _, compat, seed, _ = self._given
        return text, tuple(sorted(self.files.items())), compat, seed

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Program):
            return NotImplemented
        return self._identity() == other._identity()

    def __hash__(self) -> int:
        return hash(self._identity())

    def __repr__(self) -> str:
        loops, outputs = self.columns
        return f"Program({self.model}: {', '.join(loops) or 'one step'} -> {', '.join(outputs)})"


def run(
    source: str | os.PathLike[str],
    files: Mapping[str, str] | None = None,
    *,
    values: Mapping[str, float] | None = None,
    compat: bool = False,
    seed: int = 1,
    threads: int | None = None,
    progress: bool | Progress | None = None,
    limits: Mapping[str, float] | None = None,
) -> Result:
    """Runs a program: its text, or the path of its file."""
    program = Program(source, files, compat=compat, seed=seed, limits=limits)
    return program.run(values=values, threads=threads, progress=progress)


def _source(source: str | os.PathLike[str]) -> tuple[str, str | None]:
    """The text of a program, and its path if it is a file."""
    if isinstance(source, str) and ("\n" in source or "\r" in source):
        return source, None
    data = Path(source).read_bytes()
    try:
        text = data.decode()
    except UnicodeDecodeError:
        text = data.decode("latin-1")
    return text, os.fspath(source)


def _restore(text, files, path, compat, seed, limits) -> Program:
    """The program that was pickled; its data files come with it."""
    program = Program.__new__(Program)
    program._given = (text, path, compat, seed, limits)
    bounds = [limits.get(name) for name in LIMITS]
    program._native = _native.Program(text, files, path, compat, seed, bounds)
    return program


class _Bar:
    """Reports progress to a function or to a bar of tqdm."""

    def __init__(self, progress: bool | Progress | None) -> None:
        self._bar: Any = None
        self._progress = progress

    def __enter__(self) -> Progress | None:
        if self._progress is True:
            from tqdm.auto import tqdm

            self._bar = tqdm(total=1.0, bar_format="{l_bar}{bar}| {elapsed}<{remaining}")
            return self._set
        return self._progress or None

    def _set(self, fraction: float) -> None:
        self._bar.update(fraction - self._bar.n)

    def __exit__(self, *_: object) -> None:
        if self._bar is not None:
            self._bar.close()
