"""Values of parameters as the texts that programs give them."""

from __future__ import annotations

import hashlib
import numbers
import os
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from .errors import ParameterError

#: A function of the wavelength (µm): an index of refraction n + ik, or a number.
OfWavelength = Callable[[float], complex]


def number_text(x: float) -> str:
    """The shortest text that reads back as ``x``.

    >>> number_text(0.1), number_text(1e-7)
    ('0.1', '1e-07')
    """
    x = float(x)
    return str(int(x)) if x.is_integer() and abs(x) < 1e15 else repr(x)


def complex_text(z: complex) -> str:
    """An index of refraction as programs write it.

    >>> complex_text(1.5 + 0.1j)
    '(1.5,0.1)'
    """
    return f"({number_text(z.real)},{number_text(z.imag)})"


class ParameterTexts:
    """Dotted names with texts, classes before what is inside of them, and the files that they name."""

    def __init__(self) -> None:
        self.texts: dict[str, str] = {}
        self.files: dict[str, str] = {}
        self.functions: dict[str, OfWavelength] = {}

    def add(self, values: Mapping[Any, Any], before: str = "") -> None:
        """Adds parameters; the key None or ``class`` chooses the class of the object ``before``."""
        for key, value in values.items():
            if key is None or key == "class":
                if not before:
                    raise ParameterError(
                        "the class of a material is its first argument", code="model/value"
                    )
                self.texts[before[:-1]] = str(value)
            else:
                name = parameter_name(str(key))
                self._add_value(before + name, value)

    def _add_value(self, name: str, value: Any) -> None:
        if isinstance(value, Mapping):
            self.add(value, name + ".")
        elif hasattr(value, "mist_parameters"):
            self.add(value.mist_parameters(), name + ".")
            self.files.update(getattr(value, "files", {}))
        elif callable(value) and not isinstance(value, type):
            self.functions[name] = value
            self.texts.pop(name, None)
        else:
            self.texts[name] = self._text(name, value)
            self.functions.pop(name, None)

    def _text(self, name: str, value: Any) -> str:
        if isinstance(value, str):
            return value
        if isinstance(value, os.PathLike):
            path = Path(value)
            data = path.read_bytes()
            try:
                self.files[str(value)] = data.decode()
            except UnicodeDecodeError:
                self.files[str(value)] = data.decode("latin-1")
            return str(value)
        if isinstance(value, np.ndarray) and value.ndim == 0:
            value = value.item()
        if isinstance(value, (bool, np.bool_)):
            return str(int(value))
        if isinstance(value, numbers.Integral):
            return str(int(value))
        if isinstance(value, numbers.Real):
            return number_text(value)
        if isinstance(value, numbers.Complex):
            return complex_text(complex(value))
        if isinstance(value, (np.ndarray, list, tuple)):
            return self._table(name, np.asarray(value))
        raise ParameterError(
            f"parameter {name}: a {type(value).__name__} is not a value of a parameter",
            code="model/value",
            part=name,
            help="give a number, a text, a complex number, an array, a dict, an object of "
            "mist.models or a path",
        )

    def _table(self, name: str, array: np.ndarray) -> str:
        if array.ndim == 2 and array.shape[1] == 2 and np.iscomplexobj(array):
            array = np.column_stack([array[:, 0].real, array[:, 1].real, array[:, 1].imag])
        if array.ndim != 2 or array.shape[1] < 2 or np.iscomplexobj(array):
            raise ParameterError(
                f"parameter {name}: a table has rows and at least two columns, not the shape "
                f"{array.shape}",
                code="model/value",
                part=name,
            )
        rows = (" ".join(number_text(x) for x in row) for row in array)
        text = "\n".join(rows) + "\n"
        file = f"table-{hashlib.sha256(text.encode()).hexdigest()[:16]}.txt"
        self.files[file] = text
        return file

    def in_order(self) -> list[tuple[str, str]]:
        """The texts, each class before the parameters of its object."""
        return sorted(self.texts.items(), key=lambda item: item[0].count("."))


def parameter_name(name: str) -> str:
    """The dotted name of a keyword.

    >>> parameter_name("sdf__s"), parameter_name("wavelength")
    ('sdf.s', 'lambda')
    """
    parts = name.replace("__", ".").split(".")
    return ".".join("lambda" if part == "wavelength" else part for part in parts)


def read_value(text: str, kind: str | None) -> Any:
    """The value of a parameter from its text: a number where it is one.

    >>> read_value("(1.5,0.25)", "index"), read_value("0.3", "number"), read_value("au.txt", "index")
    ((1.5+0.25j), 0.3, 'au.txt')
    """
    try:
        if kind == "integer":
            return int(text)
        if kind in ("number", "table", "formula"):
            return float(text)
        if kind == "index":
            n, k = text.strip("()").split(",")
            return complex(float(n), float(k))
    except ValueError:
        pass
    return text
