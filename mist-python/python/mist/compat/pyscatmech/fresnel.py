"""Optical constants, films and stacks of films.

Characteristic matrices: M. Born, E. Wolf, Principles of Optics, 7th ed., sec. 1.6. The field is
e^{i(kz − ωt)}; κ is the tangential component of the wave vector over that of vacuum.
"""

from __future__ import annotations

import cmath
import hashlib
from pathlib import Path

import numpy as np

from ...values import complex_text, number_text
from .mode import mode
from .mueller import JonesMueller, MuellerMatrix, deg, pi  # noqa: F401

#: Loss that NIST's library adds to the tangential index of light inside a medium (B13).
TINY_LOSS = 1e-10


class OpticalFunction:
    """An index of refraction n + ik: a number, ``"(n,k)"``, a file, or a function of the wavelength (µm).

    >>> OpticalFunction(1.5)(0.5)
    (1.5+0j)
    """

    def __init__(self, name, iter=None):
        self.name = name
        self._table = None
        self._constant = None
        self.wavelengths = iter
        if callable(name):
            self._function = name
            if iter is not None:
                rows = [(float(x), complex(name(x))) for x in iter]
                self._table = np.array([x for x, _ in rows]), np.array([z for _, z in rows])
        elif isinstance(name, str) and not name.strip().startswith("("):
            try:
                self._constant = complex(float(name))
            except ValueError:
                self._table = _read_table(name)
        elif isinstance(name, str):
            n, k = name.strip().strip("()").split(",")
            self._constant = complex(float(n), float(k))
        else:
            self._constant = complex(name)

    def __call__(self, wavelength):
        if self._constant is not None:
            return self._constant
        if callable(self.name):
            return self.name(wavelength)
        return self.tabulated(wavelength)

    def tabulated(self, wavelength):
        """The index that a model sees: straight lines between the wavelengths of a table."""
        if self._constant is not None:
            return self._constant
        if self._table is None:
            return complex(self.name(wavelength))
        x, z = self._table
        return complex(np.interp(wavelength, x, z.real), np.interp(wavelength, x, z.imag))

    def nkstr(self, wavelength=1):
        """The index as the text ``(n,k)``."""
        return complex_text(complex(self(wavelength)))

    def writeToFile(self, filename, wavelengths):
        """Writes a table of wavelength, n and k."""
        Path(filename).write_text(self._rows(wavelengths))

    def _rows(self, wavelengths):
        rows = ((x, complex(self(x))) for x in wavelengths)
        return "".join(
            f"{number_text(x)}\t{number_text(z.real)}\t{number_text(z.imag)}\n" for x, z in rows
        )

    def mist_text(self):
        """The text that sets a parameter to this function."""
        if self._constant is not None:
            return complex_text(self._constant)
        return self.name if isinstance(self.name, str) else self._file()[0]

    def mist_files(self):
        """The files of that text."""
        if self._constant is not None:
            return {}
        if isinstance(self.name, str):
            return {self.name: Path(self.name).read_text()}
        return dict([self._file()])

    def _file(self):
        if self.wavelengths is None:
            raise ValueError("a function in a parameter needs the wavelengths of its table: iter")
        text = self._rows(self.wavelengths)
        return f"index-{hashlib.sha256(text.encode()).hexdigest()[:16]}.txt", text

    def __str__(self):
        return self.mist_text()


def _read_table(name):
    rows = []
    for line in Path(name).read_text().splitlines():
        words = line.split(";")[0].replace(",", " ").split()
        try:
            rows.append([float(word) for word in words[:3]])
        except ValueError:
            continue
    table = np.array([row for row in rows if len(row) == 3])
    table = table[np.argsort(table[:, 0])]
    return table[:, 0], table[:, 1] + 1j * table[:, 2]


def _optical(material):
    return material if isinstance(material, OpticalFunction) else OpticalFunction(material)


class Film:
    """A film: its material and thickness (µm), or ``waves`` of the light of ``wavelength``.

    >>> Film(2.0, waves=0.25, wavelength=0.5).thickness
    0.0625
    """

    def __init__(self, material, thickness=None, waves=None, wavelength=None, angle=0):
        self.material = _optical(material)
        if thickness is None:
            n = complex(self.material(wavelength)).real
            inside = np.sqrt(1 - (np.sin(angle) / n) ** 2)
            thickness = waves * wavelength / n / inside
        self.thickness = float(thickness)

    def __mul__(self, a):
        return Film(self.material, self.thickness * a)

    __rmul__ = __mul__

    def __str__(self):
        return f"{self.material} {number_text(self.thickness)}"


class FilmStack:
    """Films on a substrate, the first next to it.

    Light comes from the medium ``no`` and goes into ``nt``: for type 12 from above, for 21 from the side of the first
    film; sin θ is that of vacuum. For 12i and 21i θ is the angle in ``no``.

    >>> round(FilmStack().Rs(0, 0.5, 1, 1.5), 12)
    0.04
    """

    def __init__(self, films=()):
        self.films = list(films.films if isinstance(films, FilmStack) else films)

    def grow(self, film):
        """Adds a film on top."""
        self.films.append(film)
        return self

    def clean(self):
        """Removes all films."""
        self.films.clear()
        return self

    def getStackCommand(self, wavelength):
        """The films as the text of a stack at a wavelength."""
        return " ".join(
            f"{film.material.nkstr(wavelength)} {number_text(film.thickness)}"
            for film in self.films
        )

    def getModelDict(self):
        """The stack as the parameters of a model."""
        if not self.films:
            return {None: "No_StackModel"}
        return {None: "Stack_StackModel", "stack": self}

    def mist_text(self):
        """The text that sets a parameter to this stack."""
        return " ".join(str(film) for film in self.films)

    def mist_files(self):
        """The files of that text."""
        files = {}
        for film in self.films:
            files.update(film.material.mist_files())
        return files

    def __str__(self):
        return self.mist_text()

    def _waves(self, theta, wavelength, no, nt, type):
        """q and n of the media from the side of incidence on, with the thickness of films."""
        index = [_optical(no).tabulated(wavelength), _optical(nt).tabulated(wavelength)]
        films = [(film.material.tabulated(wavelength), film.thickness) for film in self.films[::-1]]
        if type[:2] not in ("12", "21") or type[2:] not in ("", "i"):
            raise ValueError(f"the type {type!r} is none of 12, 21, 12i, 21i")
        if type[:2] == "21":
            films = films[::-1]
        kappa = cmath.sin(theta)
        if type.endswith("i"):
            kappa = index[0] * kappa
            if mode() == "compat":
                kappa -= 1j * TINY_LOSS
        indices = [index[0], *(n for n, _ in films), index[1]]
        q = [_decaying(n * n - kappa * kappa) for n in indices]
        return indices, q, [thickness for _, thickness in films]

    def _solve(self, theta, wavelength, no, nt, type):
        """r and t of s and p light, with n cosθ and n of both outer media."""
        n, q, thickness = self._waves(theta, wavelength, no, nt, type)
        k = 2 * np.pi / wavelength
        found = []
        for admittance in ([*q], [n * n / q for n, q in zip(n, q)]):
            matrix = np.eye(2, dtype=complex)
            for eta, q_film, d in zip(admittance[1:-1], q[1:-1], thickness):
                phase = k * q_film * d
                c, s = cmath.cos(phase), cmath.sin(phase)
                matrix = matrix @ np.array([[c, -1j * s / eta], [-1j * eta * s, c]])
            b, c = matrix @ np.array([1, admittance[-1]])
            first = admittance[0]
            found.append(((first * b - c) / (first * b + c), 2 * first / (first * b + c)))
        (rs, ts), (rp, tp) = found
        # From tangential fields to those of the waves.
        return (rs, -rp), (ts, tp * (q[0] / n[0]) / (q[-1] / n[-1])), n, q

    def reflectionCoefficient(self, theta, wavelength, no, nt, type="12"):
        """[[r_s, 0], [0, r_p]]."""
        (rs, rp), *_ = self._solve(theta, wavelength, no, nt, type)
        return np.diag([rs, rp])

    def transmissionCoefficient(self, theta, wavelength, no, nt, type="12"):
        """[[t_s, 0], [0, t_p]]."""
        _, (ts, tp), *_ = self._solve(theta, wavelength, no, nt, type)
        return np.diag([ts, tp])

    def R(self, theta, wavelength, no, nt, type="12"):
        """Mueller matrix of the reflectance."""
        return JonesMueller(self.reflectionCoefficient(theta, wavelength, no, nt, type))

    def T(self, theta, wavelength, no, nt, type="12"):
        """Mueller matrix of the transmittance: the transmitted power over the incident one."""
        _, (ts, tp), n, q = self._solve(theta, wavelength, no, nt, type)
        cos = [q / n for q, n in zip(q, n)]
        incident = (n[0] * cos[0]).real
        factors = np.array(
            [
                (n[-1] * cos[-1]).real / incident,
                (n[-1] * cos[-1].conjugate()).real / incident,
            ]
        )
        roots = np.sqrt(np.maximum(factors, 0))
        return JonesMueller(np.diag([ts * roots[0], tp * roots[1]]))

    def Rs(self, theta, wavelength, no, nt, type="12"):
        """Reflectance of s light."""
        return _of(self.R(theta, wavelength, no, nt, type), 1)

    def Rp(self, theta, wavelength, no, nt, type="12"):
        """Reflectance of p light."""
        return _of(self.R(theta, wavelength, no, nt, type), -1)

    def Ts(self, theta, wavelength, no, nt, type="12"):
        """Transmittance of s light."""
        return _of(self.T(theta, wavelength, no, nt, type), 1)

    def Tp(self, theta, wavelength, no, nt, type="12"):
        """Transmittance of p light."""
        return _of(self.T(theta, wavelength, no, nt, type), -1)


def _of(matrix: MuellerMatrix, sign: int) -> float:
    return float(matrix[0, 0] + sign * matrix[0, 1])


def _decaying(squared):
    """The root of a wave that decays on its way, or goes forward."""
    root = cmath.sqrt(squared)
    return -root if root.imag < 0 or (root.imag == 0 and root.real < 0) else root
