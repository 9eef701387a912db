"""Materials: a model with parameters and data files, evaluated for arrays of directions."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _native
from .errors import ParameterError
from .polarization import stokes
from .values import (
    OfWavelength,
    ParameterTexts,
    complex_text,
    number_text,
    parameter_name,
    read_value,
)

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

#: Version of the canonical form of which the digest is made.
DIGEST_FORM = 1


class Material:
    """A BRDF model with its parameters and data files. It does not change.

    Angles are radians, lengths and wavelengths µm. Values are numbers, complex indices n + ik,
    texts as programs write them, dicts or objects of :mod:`mist.models` for classes, arrays for
    tables, paths for files, and functions of the wavelength for indices. In keywords ``__`` stands
    for the dot, and ``wavelength`` for ``lambda``.

    >>> import mist
    >>> white = mist.Material("Lambertian_BRDF_Model", reflectance__table=0.5, wavelength=0.6)
    >>> round(white.brdf(0.3, 0.2) * 3.141592653589793, 15)
    0.5
    >>> white.mueller(0.3, [0.1, 0.2, 0.3]).shape
    (3, 4, 4)
    """

    __slots__ = ("_fields", "_functions", "_native", "_tree")

    _native: _native.Material
    _functions: dict[str, OfWavelength]

    def __init__(
        self,
        model: str,
        parameters: Mapping[Any, Any] | None = None,
        /,
        *,
        files: Mapping[str, str] | None = None,
        compat: bool = False,
        **values: Any,
    ) -> None:
        texts = ParameterTexts()
        for given in (parameters or {}, values):
            texts.add(given)
        self._set(model, texts, files or {}, compat)

    def _set(
        self, model: str, texts: ParameterTexts, files: Mapping[str, str], compat: bool
    ) -> None:
        pairs = texts.in_order()
        all_files = {**files, **texts.files}
        if texts.functions:
            wavelength = texts.texts.get("lambda")
            if wavelength is None:
                bare = _native.Material(model, [], {}, compat)
                wavelength = next(entry[1] for entry in bare.entries() if entry[0] == "lambda")
            pairs += _texts_at(texts.functions, float(wavelength))
        self._functions = dict(texts.functions)
        self._fields = None
        self._tree = None
        self._native = _native.Material(model, pairs, all_files, compat)

    @classmethod
    def _of(cls, native: _native.Material, functions: dict[str, OfWavelength]) -> Material:
        self = cls.__new__(cls)
        self._functions = functions
        self._fields = None
        self._tree = None
        self._native = native
        return self

    @classmethod
    def from_json(cls, text: str, *, compat: bool = False) -> Material:
        """The material that a JSON text ``{"model": …, "parameters": …, "files": …}`` describes.

        >>> Material.from_json('{"model": "Lambertian_BRDF_Model"}').model
        'Lambertian_BRDF_Model'
        """
        description = json.loads(text)
        if not isinstance(description, dict) or "model" not in description:
            raise ParameterError(
                "the JSON text is not a material: it has no key model", code="material/json"
            )
        unknown = set(description) - {"model", "parameters", "files"}
        if unknown:
            raise ParameterError(
                f"the JSON text has the unknown key {sorted(unknown)[0]}", code="material/json"
            )
        given = description.get("parameters", {})
        texts = ParameterTexts()
        if isinstance(given, Mapping):
            texts.add(given)
            pairs = texts.in_order()
        else:
            pairs = [(name, texts._text(name, value)) for name, value in given]
        native = _native.Material(
            description["model"], pairs, description.get("files", {}), compat
        )
        return cls._of(native, {})

    def to_json(self) -> str:
        """The material as JSON, with its data files, as files and the service take it."""
        return json.dumps(
            {"model": self.model, "parameters": self._changed(), "files": self.files},
            ensure_ascii=False,
        )

    # Parameters.

    @property
    def model(self) -> str:
        """Name of the class."""
        return self._native.model

    @property
    def mode(self) -> str:
        """``sound``, or ``compat`` for NIST's numbers."""
        return "compat" if self._native.compat else "sound"

    @property
    def files(self) -> dict[str, str]:
        """Texts of the data files that parameters read, by name."""
        return self._native.files

    @property
    def wavelength(self) -> float:
        """Vacuum wavelength, µm."""
        return self["lambda"]

    def _entries(self) -> dict[str, tuple]:
        if self._fields is None:
            self._fields = {entry[0]: entry for entry in self._native.entries()}
        return self._fields

    def _changed(self) -> list[tuple[str, str]]:
        return [(entry[0], entry[1]) for entry in self._entries().values() if not entry[2]]

    @property
    def parameters(self) -> dict[str, Any]:
        """All parameters by their dotted names.

        >>> import mist
        >>> mist.Material("Facet_BRDF_Model").parameters["substrate"]
        (4.05+0.05j)
        """
        return {
            name: read_value(entry[1], entry[3]) for name, entry in self._entries().items()
        }

    def mist_parameters(self) -> dict[Any, Any]:
        """The class and the parameters that are not defaults, to nest the model in another."""
        return {None: self.model, **dict(self._changed()), **self._functions}

    def __getitem__(self, name: str) -> Any:
        name = parameter_name(name)
        if name in self._functions:
            return self._functions[name]
        entry = self._entries().get(name)
        if entry is None:
            raise KeyError(name)
        return read_value(entry[1], entry[3])

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__") or name in Material.__slots__:
            raise AttributeError(name)
        return _attribute(self, "", name)

    def __dir__(self) -> list[str]:
        own = [name for name in self._entries() if "." not in name and name != "lambda"]
        return sorted({*super().__dir__(), *own})

    def replace(
        self, parameters: Mapping[Any, Any] | None = None, /, **values: Any
    ) -> Material:
        """The material with other values of some parameters.

        A parameter that names a class begins a new object with its defaults.

        >>> import mist
        >>> mist.Material("Facet_BRDF_Model").replace({"sdf.s": 0.2}).sdf.s
        0.2
        """
        new = ParameterTexts()
        for given in (parameters or {}, values):
            new.add(given)
        replaced = [*new.texts, *new.functions]
        texts = ParameterTexts()
        kept = [*self._changed(), *self._functions.items()]
        for name, value in kept:
            if not any(name == other or name.startswith(other + ".") for other in replaced):
                texts._add_value(name, value)
        texts.texts.update(new.texts)
        texts.functions.update(new.functions)
        material = Material.__new__(Material)
        material._set(self.model, texts, {**self.files, **new.files}, self._native.compat)
        return material

    def at(self, wavelength: float) -> Material:
        """The material at another wavelength (µm), of the model and of all objects in it."""
        native = self._native.at(wavelength)
        if not self._functions:
            return Material._of(native, {})
        material = Material._of(native, {})
        texts = ParameterTexts()
        for name, text in material._changed():
            texts.texts[name] = text
        texts.functions.update(self._functions)
        again = Material.__new__(Material)
        again._set(self.model, texts, self.files, self._native.compat)
        return again

    # Evaluation.

    def mueller(
        self,
        theta_i: ArrayLike,
        theta_s: ArrayLike,
        phi_s: ArrayLike = 0.0,
        rotation: ArrayLike = 0.0,
        wavelength: ArrayLike | None = None,
        *,
        basis: str = "psps",
        out: NDArray[np.float64] | None = None,
    ) -> NDArray[np.float64]:
        """Mueller matrices of the BRDF, 1/sr, of the shape (…, 4, 4); rows are outputs.

        The arguments broadcast as in numpy. ``basis`` is psps, xyxy or plane. At and below the
        horizon the matrices are zero; NaN gives NaN.
        """
        if self._functions and wavelength is not None:
            return self._by_wavelength(
                "mueller", (theta_i, theta_s, phi_s, rotation), wavelength, (4, 4), basis=basis
            )
        return self._native.mueller(theta_i, theta_s, phi_s, rotation, wavelength, basis, out)

    def brdf(
        self,
        theta_i: ArrayLike,
        theta_s: ArrayLike,
        phi_s: ArrayLike = 0.0,
        rotation: ArrayLike = 0.0,
        wavelength: ArrayLike | None = None,
        *,
        incident: str | Sequence[float] | NDArray[np.float64] = "u",
        sensitivity: str | Sequence[float] | NDArray[np.float64] = "u",
        basis: str = "psps",
        out: NDArray[np.float64] | None = None,
    ) -> Any:
        """The BRDF, 1/sr, for one incident light and one sensitivity of the detector.

        Both are Stokes vectors or letters: u, s, p, ``45``, ``-45``, l, r. A letter is light of
        power 1 and a detector that passes light of this state whole.

        >>> import mist
        >>> gold = mist.Material("Facet_BRDF_Model", substrate=0.25 + 3.1j)
        >>> gold.brdf(1.0, [0.9, 1.0], incident="p", sensitivity="s").shape
        (2,)
        """
        light = stokes(incident)
        detector = stokes(sensitivity, detector=True)
        if self._functions and wavelength is not None:
            arguments = (theta_i, theta_s, phi_s, rotation)
            given = {"incident": light, "sensitivity": detector, "basis": basis}
            return self._by_wavelength("brdf", arguments, wavelength, (), **given)
        return self._native.brdf(
            theta_i, theta_s, phi_s, rotation, wavelength, light, detector, basis, out
        )

    def jones(
        self,
        theta_i: ArrayLike,
        theta_s: ArrayLike,
        phi_s: ArrayLike = 0.0,
        rotation: ArrayLike = 0.0,
        wavelength: ArrayLike | None = None,
        *,
        basis: str = "psps",
    ) -> NDArray[np.complex128]:
        """Jones matrices whose Mueller matrices are the BRDF, of the shape (…, 2, 2): [[ss, ps], [sp, pp]].

        Raises NotCoherent for a model that depolarizes.
        """
        if self._functions and wavelength is not None:
            return self._by_wavelength(
                "jones", (theta_i, theta_s, phi_s, rotation), wavelength, (2, 2), basis=basis
            )
        return self._native.jones(theta_i, theta_s, phi_s, rotation, wavelength, basis)

    def _by_wavelength(self, call, arguments, wavelength, matrix, **given):
        """Evaluates each wavelength with the values of the functions there."""
        *angles, waves = np.broadcast_arrays(*arguments, np.asarray(wavelength, float))
        kind = complex if call == "jones" else float
        result = np.empty(waves.shape + matrix, kind)
        for wave in np.unique(waves):
            at = waves == wave
            material = self.at(float(wave))
            result[at] = getattr(material, call)(*(angle[at] for angle in angles), **given)
        return result if result.ndim else result[()]

    def check(self) -> Material:
        """Builds the model, so that values which it does not take are told now; gives itself."""
        self._native.build()
        return self

    @property
    def is_coherent(self) -> bool:
        """True if the model does not depolarize, and has Jones matrices."""
        return self._native.is_coherent()

    # Identity.

    def _identity(self) -> tuple:
        return self.model, tuple(self._changed()), tuple(sorted(self.files.items())), self.mode

    @property
    def digest(self) -> str:
        """SHA-256 of the class, all values, the texts of the files and the mode."""
        model, parameters, files, mode = self._identity()
        form = [DIGEST_FORM, model, parameters, files, mode]
        return hashlib.sha256(json.dumps(form).encode()).hexdigest()

    # Tables and files.

    def table(self, **request: Any):
        """Its colours over directions: see :func:`mist.table`."""
        from .table import table

        return table(self, **request)

    def export(self, path: Any, **request: Any) -> str:
        """Writes the file of a renderer: see :func:`mist.export`."""
        from .table import export

        return export(self, path, **request)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Material):
            return NotImplemented
        return self._identity() == other._identity() and self._functions == other._functions

    def __hash__(self) -> int:
        return hash(self._identity())

    def __reduce__(self):
        parameters = dict(self._changed())
        return _restore, (self.model, parameters, self.files, self._native.compat, self._functions)

    def __repr__(self) -> str:
        shown = ", ".join(f"{name}={text!r}" for name, text in self._changed()[:8])
        more = ", …" if len(self._changed()) > 8 else ""
        return f"Material({self.model}{': ' if shown else ''}{shown}{more})"

    def _repr_html_(self) -> str:
        from .display import material_html

        return material_html(self)


class ParameterView:
    """The parameters of an object inside of a material."""

    __slots__ = ("_material", "_path")

    def __init__(self, material: Material, path: str) -> None:
        self._material = material
        self._path = path

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__") or name in ParameterView.__slots__:
            raise AttributeError(name)
        return _attribute(self._material, self._path + ".", name)

    def __getitem__(self, name: str) -> Any:
        return self._material[f"{self._path}.{name}"]

    def __dir__(self) -> list[str]:
        start = self._path + "."
        names = (name[len(start) :] for name in self._material._entries() if name.startswith(start))
        return sorted(name for name in names if "." not in name)

    @property
    def model(self) -> str:
        """Name of the class."""
        return self._material._entries()[self._path][1]

    def mist_parameters(self) -> dict[Any, Any]:
        """The class and the parameters that are not defaults."""
        start = self._path + "."
        own = (item for item in self._material._changed() if item[0].startswith(start))
        return {None: self.model, **{name[len(start) :]: text for name, text in own}}

    def __eq__(self, other: object) -> bool:
        if isinstance(other, str):
            return self.model == other
        if not isinstance(other, ParameterView):
            return NotImplemented
        return self.mist_parameters() == other.mist_parameters()

    def __hash__(self) -> int:
        return hash(self.model)

    def __repr__(self) -> str:
        shown = ", ".join(f"{name}={getattr(self, name)!r}" for name in self.__dir__())
        return f"{self.model}({shown})"


def _attribute(material: Material, before: str, name: str) -> Any:
    """The value of the parameter ``name``; a view if it is an object."""
    dotted = before + parameter_name(name)
    entry = material._entries().get(dotted)
    if entry is None:
        owner = before[:-1] or material.model
        raise AttributeError(f"{owner} has no parameter {name}")
    if entry[3] == "member":
        return ParameterView(material, dotted)
    return material[dotted]


def _texts_at(functions: Mapping[str, OfWavelength], wavelength: float) -> list[tuple[str, str]]:
    """The values of ``functions`` at a wavelength (µm) as texts."""
    texts = []
    for name, function in functions.items():
        value = complex(function(wavelength))
        text = number_text(value.real) if value.imag == 0 else complex_text(value)
        texts.append((name, text))
    return texts


def _restore(model, parameters, files, compat, functions) -> Material:
    """The material that was pickled."""
    texts = ParameterTexts()
    texts.texts.update(parameters)
    texts.functions.update(functions)
    material = Material.__new__(Material)
    material._set(model, texts, files, compat)
    return material
