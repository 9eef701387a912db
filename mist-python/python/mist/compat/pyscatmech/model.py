"""Models with changeable parameters: trees of classes and texts."""

from __future__ import annotations

from collections.abc import Mapping


from ... import models
from ...material import Material
from ...values import ParameterTexts
from .mode import mode


class Model:
    """A class of the library and its parameters.

    ``Model("ABC_PSD_Function", A=0.2)``; parameters are also given as dicts, whose key None names a class, and as
    other models.

    >>> Model("ABC_PSD_Function", A=0.2).getParameters()
    {None: 'ABC_PSD_Function', 'A': '0.2', 'B': '362', 'C': '2.5'}
    """

    #: The class of a model without a name.
    DEFAULT = "Microroughness_BRDF_Model"

    def __init__(self, *args, **kw):
        self._files = {}
        self._set_class(self.DEFAULT)
        self.setParameters(*args, **kw)

    def _set_class(self, name):
        self._class = models.class_named(str(name))["name"]
        self._values = {}
        for parameter in models.class_named(self._class)["parameters"]:
            value = parameter["default"]
            is_object = parameter["kind"] == "member"
            self._values[parameter["name"]] = _object(value) if is_object else value

    # Setting.

    def setParameters(self, *args, **kw):
        """Sets the class (a name) and parameters (dicts, models, keywords); returns the model."""
        for given in (*args, kw):
            if isinstance(given, str):
                self._set_class(given)
            elif given is not None and hasattr(given, "getModelDict"):
                self.setParameters(given.getModelDict())
            elif isinstance(given, Model):
                self._set_class(given._class)
                self._values = {name: _copy(value) for name, value in given._values.items()}
                self._files.update(given._files)
            else:
                self._set_dict(given or {})
        return self

    def _set_dict(self, given):
        if None in given:
            self._set_class(given[None])
        for name, value in given.items():
            if name is not None:
                self.setParameter(name, value)

    def setParameter(self, parameter, value):
        """Sets the parameter with a dotted name."""
        owner, name = self._owner(parameter)
        known = owner._values.get(name)
        if isinstance(known, Model):
            if isinstance(value, (Mapping, Model)) or hasattr(value, "getModelDict"):
                known.setParameters(value)
            else:
                known._set_class(value)
            self._files.update(known._files)
            return
        if name not in owner._values and not _is_setting(owner, parameter):
            raise ValueError(f"{owner._class} has no parameter {name}")
        texts = ParameterTexts()
        text = getattr(value, "mist_text", None)
        owner._values[name] = text() if text else texts._text(name, value)
        files = texts.files if text is None else getattr(value, "mist_files", dict)()
        self._files.update(files)

    def _owner(self, parameter):
        name = "lambda" if parameter in ("lambda_", "wavelength") else parameter
        first, dot, rest = name.partition(".")
        inner = self._values.get(first)
        if dot and isinstance(inner, Model):
            return inner._owner(rest)
        if not dot and first not in self._values:
            raise ValueError(f"{self._class} has no parameter {first}")
        return self, name

    # Reading.

    def getParameter(self, parameter):
        """The text of a parameter."""
        owner, name = self._owner(parameter)
        value = owner._values[name]
        return value._class if isinstance(value, Model) else value

    def getParameters(self):
        """The class at None and the texts of all parameters by their dotted names."""
        return {None: self._class, **dict(self._texts(""))}

    def _texts(self, before):
        for name, value in self._values.items():
            if isinstance(value, Model):
                yield before + name, value._class
                yield from value._texts(f"{before}{name}.")
            else:
                yield before + name, value

    def getParameterDictionary(self):
        """Value, description, type and default of each parameter."""
        found = {}
        for described in models.class_named(self._class)["parameters"]:
            name = described["name"]
            unit = f" [{described['unit']}]" if described["unit"] not in ("", "1") else ""
            found[name] = {
                "value": self.getParameter(name),
                "description": described["doc"] + unit,
                "type": described["base"] or described["kind"],
                "default": described["default"],
            }
        return found

    def printParameters(self):
        """Prints the parameters, one on a line."""
        for name, each in self.getParameterDictionary().items():
            print(f"{name} = {each['value']} ({each['type']}: {each['description']})")

    def askParameters(self):
        """Asks for the parameters at the terminal; an empty answer keeps the value."""
        for name, each in self.getParameterDictionary().items():
            answer = input(f"{name} ({each['description']}) <{each['value']}>: ").strip()
            if answer:
                self.setParameter(name, answer)
            if isinstance(self._values[name], Model):
                self._values[name].askParameters()
        return self

    def getModelName(self):
        """The name of the class."""
        return self._class

    def mist_parameters(self):
        """Class and parameters, to nest the model in a material."""
        return self.getParameters()

    @property
    def files(self):
        """Texts of data files by their names."""
        return dict(self._files)

    def material(self) -> Material:
        """The model as a material of mist."""
        texts = {name: text for name, text in self._texts("")}
        return Material(self._class, texts, files=self._files, compat=mode() == "compat")

    def __repr__(self):
        return self._class

    def __str__(self):
        return strDictOfDict(self._nested())

    def _nested(self):
        values = {
            name: value._nested() if isinstance(value, Model) else value
            for name, value in self._values.items()
        }
        return {None: self._class, **values} if values else self._class

    def __copy__(self):
        return type(self)(self)

    def __deepcopy__(self, memo):
        return type(self)(self)

    def __reduce__(self):
        return _again, (type(self), self.getParameters(), self._files)


def _again(kind, parameters, files):
    model = kind(parameters.pop(None))
    model._files.update(files)
    for name, text in parameters.items():
        model.setParameter(name, text)
    return model


def _object(name):
    model = Model.__new__(Model)
    model._files = {}
    model._set_class(name)
    return model


def _copy(value):
    if not isinstance(value, Model):
        return value
    copied = _object(value._class)
    copied._values = {name: _copy(inner) for name, inner in value._values.items()}
    copied._files.update(value._files)
    return copied


def _is_setting(owner, parameter):
    """True for a setting of a table or of optical constants, such as interpolationx."""
    return "." in parameter and parameter.split(".")[0] in owner._values


def getModelDictionary(model="Model"):
    """Description and parent of every class below ``model``, and of itself."""
    classes = models.registry()
    bases = {described["base"] for described in classes.values()}
    found = {}
    if model == "Model" or model in bases:
        found = {base: {"description": base, "parent": "Model"} for base in sorted(bases)}
        if model != "Model":
            found = {model: found[model]}
    for name, described in classes.items():
        if model in ("Model", name, described["base"], described["parent"]):
            found[name] = {"description": described["summary"], "parent": described["parent"]}
    return found


def chooseModel(model):
    """Asks at the terminal for a class below ``model``."""
    names = list(getModelDictionary(model))
    for number, name in enumerate(names):
        print(f"({number}) {name}")
    return names[int(input("number: "))]


def chooseModelAndParameters(model):
    """Asks at the terminal for a class below ``model`` and its parameters."""
    return Model(chooseModel(model)).askParameters()


def createDictOfDict(theDict):
    """Nested dicts from dotted names.

    >>> createDictOfDict({"sdf": "G", "sdf.s": "0.1"})
    {'sdf': {None: 'G', 's': '0.1'}}
    """
    nested = {}
    for name, value in theDict.items():
        first, dot, rest = name.partition(".") if isinstance(name, str) else (name, "", "")
        if dot:
            inner = nested.get(first)
            if not isinstance(inner, dict):
                nested[first] = {} if inner is None else {None: inner}
            nested[first][rest] = value
        else:
            nested[first] = value
    return {
        name: createDictOfDict(value) if isinstance(value, dict) else value
        for name, value in nested.items()
    }


def strDictOfDict(thedict, indent="", result=None):
    """Nested dicts as text, one entry on a line."""
    if not isinstance(thedict, dict):
        return repr(thedict)
    lines = []
    for name, value in thedict.items():
        shown = "None" if name is None else repr(name)
        inner = " " * (len(shown) + 5)
        text = strDictOfDict(value, indent + inner) if isinstance(value, dict) else repr(value)
        lines.append(f"{shown} : {text}")
    return "{" + f",\n{indent}".join(lines) + "}"


def printDictOfDict(thedict):
    """Prints nested dicts."""
    print(strDictOfDict(thedict))


def DialogGetModel(top):
    """Asks for a class below ``top``; at the terminal, where there is no window."""
    return chooseModel(top)


def DialogGetModelParameters(model):
    """Asks for the parameters of ``model``; at the terminal, where there is no window."""
    return Model(model).askParameters()


