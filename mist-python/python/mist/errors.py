"""Exceptions and warnings of the package."""

from __future__ import annotations

import dataclasses

__all__ = [
    "Diagnostic",
    "LimitError",
    "MistError",
    "MistWarning",
    "NotCoherent",
    "ParameterError",
    "ProgramError",
    "ServiceError",
    "StepError",
]


@dataclasses.dataclass(frozen=True)
class Diagnostic:
    """A remark on the text of a program, with its place; lines and columns begin at 1."""

    code: str
    severity: str
    message: str
    line: int
    column: int
    help: str | None = None
    notes: tuple[str, ...] = ()
    marked: int = 0

    def __str__(self) -> str:
        place = f"{self.line}:{self.column}: " if self.line else ""
        help = f"; {self.help}" if self.help else ""
        return f"{place}{self.severity}[{self.code}]: {self.message}{help}"


class MistError(Exception):
    """An error of mist: ``code`` is stable, ``part`` is the parameter at fault, ``help`` the remedy.

    >>> import mist
    >>> try:
    ...     mist.Material("Facet_BRDF_Model", substrat=1.5)
    ... except mist.MistError as error:
    ...     print(error.code, error.part)
    model/unknown-parameter substrat
    """

    def __init__(
        self,
        message: str,
        *,
        code: str = "mist",
        part: str | None = None,
        help: str | None = None,
    ) -> None:
        super().__init__(message)
        self.code = code
        self.part = part
        self.help = help

    def __str__(self) -> str:
        message = super().__str__()
        return f"{message}\n  help: {self.help}" if self.help else message

    def __reduce__(self):
        return _again, (type(self), self.args, self.__dict__.copy())


def _again(kind, arguments, attributes):
    """An exception with its attributes, as it was before it was pickled."""
    error = kind.__new__(kind, *arguments)
    error.args = arguments
    error.__dict__.update(attributes)
    return error


class ParameterError(MistError, ValueError):
    """A name or a value that a model does not take."""


class ProgramError(MistError, ValueError):
    """A program that is refused; ``diagnostics`` has every error with its line and column."""

    def __init__(self, message: str, *, diagnostics: tuple[Diagnostic, ...] = (), **more) -> None:
        super().__init__(message, **more)
        self.diagnostics = diagnostics


class StepError(MistError):
    """A run that failed in a later step; ``step`` is its number, from 0."""

    def __init__(self, message: str, *, step: int = 0, **more) -> None:
        super().__init__(message, **more)
        self.step = step


class LimitError(MistError):
    """A run that needs more than its limits allow."""


class NotCoherent(MistError):
    """A model that depolarizes has no Jones matrix."""


class ServiceError(MistError):
    """An answer of the HTTP service that is not a result."""


class MistWarning(UserWarning):
    """A result that is probably not what was meant; it has ``code`` and ``help``."""

    def __init__(self, message: str, *, code: str = "mist", help: str | None = None) -> None:
        super().__init__(message)
        self.code = code
        self.help = help

    def __str__(self) -> str:
        message = super().__str__()
        return f"{message}; {self.help}" if self.help else message


def read_diagnostics(found: list[tuple]) -> tuple[Diagnostic, ...]:
    """Diagnostics from the tuples of the extension module."""
    return tuple(
        Diagnostic(code, severity, message, line, column, help, tuple(notes), marked)
        for code, severity, message, line, column, marked, help, notes in found
    )


def excerpt(found: Diagnostic, text: str) -> str:
    """The line of a diagnostic with the marked place under it, notes and help."""
    lines = [f"{found.severity}[{found.code}]: {found.message}"]
    source = text.split("\n")
    if 0 < found.line <= len(source) and len(source[found.line - 1]) < 2000:
        number = str(found.line)
        blank = " " * len(number)
        line = source[found.line - 1].rstrip("\r")
        under = "".join("\t" if c == "\t" else " " for c in line[: found.column - 1])
        lines += [
            f"{blank}--> {found.line}:{found.column}",
            f"{blank} |",
            f"{number} | {line}",
            f"{blank} | {under}{'^' * max(found.marked, 1)}",
        ]
    lines += [f"  note: {note}" for note in found.notes]
    if found.help:
        lines.append(f"  help: {found.help}")
    return "\n".join(lines)


def program_error(found: list[tuple], text: str) -> ProgramError:
    """The exception of a program with these diagnostics."""
    diagnostics = read_diagnostics(found)
    errors = [each for each in diagnostics if each.severity == "error"] or list(diagnostics)
    message = "\n".join(excerpt(each, text) for each in errors)
    code = errors[0].code if errors else "program"
    return ProgramError(message, diagnostics=diagnostics, code=code)


def step_error(step: int, found: list[tuple], text: str) -> StepError:
    """The exception of a run that failed in a step."""
    [fault] = read_diagnostics(found)
    message = f"step {step + 1}: {excerpt(fault, text)}"
    return StepError(message, step=step, code=fault.code)
