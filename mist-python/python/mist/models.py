"""One callable for each class of the registry, with signature, units and description.

>>> import mist
>>> sdf = mist.models.Gaussian_Slope_Distribution_Function(s=0.1)
>>> mist.models.Facet_BRDF_Model(sdf=sdf).sdf.s
0.1
"""

from __future__ import annotations

import difflib
import functools
import inspect
import json
from typing import Any

from . import _native
from .errors import ParameterError
from .material import Material
from .values import parameter_name, read_value

#: Base of the classes that are materials by themselves.
BRDF_FAMILY = "BRDF_Model"


class ModelObject:
    """An object that a parameter of a model can hold: a class with some of its parameters."""

    def __init__(self, model: str, /, **values: Any) -> None:
        known = [parameter["name"] for parameter in class_named(model)["parameters"]]
        for name in values:
            if parameter_name(name).split(".")[0] not in known:
                near = difflib.get_close_matches(name, known, 1)
                raise ParameterError(
                    f"{model} has no parameter {name}",
                    code="model/unknown-parameter",
                    part=name,
                    help=f"did you mean {near[0]}?" if near else f"it has {', '.join(known)}",
                )
        self.model = model
        self.values = values

    def mist_parameters(self) -> dict[Any, Any]:
        """The class and its values."""
        return {None: self.model, **self.values}

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, ModelObject):
            return NotImplemented
        return self.mist_parameters() == other.mist_parameters()

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        shown = ", ".join(f"{name}={value!r}" for name, value in self.values.items())
        return f"{self.model}({shown})"


@functools.cache
def registry() -> dict[str, dict[str, Any]]:
    """All classes by name: parent, base, summary, equation, source and parameters."""
    families = json.loads(_native.families())["families"]
    return {
        described["name"]: {**described, "base": family["base"]}
        for family in families
        for described in family["classes"]
    }


def class_named(name: str) -> dict[str, Any]:
    """The description of a class."""
    found = registry().get(name)
    if found is None:
        near = difflib.get_close_matches(name, registry(), 1)
        raise ParameterError(
            f"no class is called {name!r}",
            code="model/unknown",
            part="model",
            help=f"did you mean {near[0]}?" if near else None,
        )
    return found


def find(text: str) -> list[str]:
    """Names of the classes whose name, summary or parent contains ``text``.

    >>> "Facet_BRDF_Model" in find("facet")
    True
    """
    text = text.lower()
    return [
        name
        for name, described in registry().items()
        if any(text in described[key].lower() for key in ("name", "summary", "parent"))
    ]


@functools.cache
def _callable(name: str):
    described = class_named(name)
    is_material = described["base"] == BRDF_FAMILY
    kind = Material if is_material else ModelObject

    def make(**values: Any):
        return kind(name, **values)

    make.__name__ = make.__qualname__ = name
    make.__module__ = __name__
    lines = [described["summary"] + ".", "", described["equation"], "", "Parameters:"]
    parameters = []
    for parameter in described["parameters"]:
        keyword = "wavelength" if parameter["name"] == "lambda" else parameter["name"]
        default = read_value(parameter["default"], parameter["kind"])
        unit = f", {parameter['unit']}" if parameter["unit"] else ""
        lines.append(f"    {keyword} ({parameter['kind']}{unit}; {default}): {parameter['doc']}")
        parameters.append(
            inspect.Parameter(keyword, inspect.Parameter.KEYWORD_ONLY, default=default)
        )
    make.__doc__ = "\n".join(lines)
    names_are_valid = all(parameter.name.isidentifier() for parameter in parameters)
    if names_are_valid:
        make.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
    return make


def __getattr__(name: str):
    if name.startswith("_") or name not in registry():
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return _callable(name)


def __dir__() -> list[str]:
    return sorted([*registry(), "ModelObject", "class_named", "find", "registry"])
