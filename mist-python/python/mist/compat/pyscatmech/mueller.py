"""Mueller matrices, Stokes vectors and Jones matrices.

U = 2 Re(E_s* E_p) and V = 2 Im(E_s* E_p). A rotation by an angle turns the axes from s towards p.

R. A. Chipman, in Handbook of Optics (OSA, 1995), vol. II, ch. 22; S.-Y. Lu, R. A. Chipman, J. Opt. Soc. Am. A 13,
1106 (1996); S. R. Cloude, Proc. SPIE 1166, 177 (1989); R. Ossikovski, J. Opt. Soc. Am. A 26, 1109 (2009).
"""

from __future__ import annotations

import math

import numpy as np

from .decompositions import (
    closest_nondepolarizing,
    cloude,
    hermitian,
    lu_chipman,
    matrix_exp,
    matrix_log,
    mueller_of_hermitian,
    reverse_lu_chipman,
    symmetric,
)

pi = math.pi
deg = pi / 180

#: Eigenvalues of a physical coherency matrix are not below minus this part of its norm.
NEGATIVE = 1e-8


def unit(a):
    """The unit vector along ``a``."""
    a = np.asarray(a, float)
    return a / np.linalg.norm(a)


def perpto(a, b):
    """The unit vector perpendicular to ``a`` and ``b``."""
    return unit(np.cross(a, b))


def _values(x, count):
    if len(x) == 0:
        return np.zeros(count)
    values = np.asarray(x[0] if len(x) == 1 else x, float)
    if values.size != count:
        raise ValueError(f"{count} numbers are needed, not {values.size}")
    return values.reshape(count)


class MuellerMatrix(np.ndarray):
    """A Mueller matrix from 16 numbers, four rows or an array; zero without arguments.

    >>> MuellerMatrix(np.eye(4)).diattenuation()
    0.0
    """

    def __new__(cls, *x):
        return _values(x if len(x) != 4 else (np.array(x),), 16).reshape(4, 4).view(cls)

    def __array_finalize__(self, other):
        """No attribute is inherited."""

    def __mul__(a, b):
        return _product(a, b)

    def __matmul__(a, b):
        return _product(a, b)

    def __rmul__(a, b):
        return _like(a, np.asarray(a) * b)

    def __truediv__(a, b):
        return _like(a, np.asarray(a) / np.asarray(b))

    def __pow__(a, b):
        return MuellerMatrix(np.linalg.matrix_power(np.asarray(a), b))

    def _row(self):
        return float(np.linalg.norm(np.asarray(self)[0, 1:]))

    def Tmax(self):
        """Largest transmittance."""
        return float(self[0, 0]) + self._row()

    def Tmin(self):
        """Least transmittance."""
        return float(self[0, 0]) - self._row()

    def diattenuation(self):
        """(Tmax − Tmin)/(Tmax + Tmin)."""
        return self._row() / float(self[0, 0])

    def linear_diattenuation(self):
        """Diattenuation of linear polarization."""
        return float(np.hypot(self[0, 1], self[0, 2]) / self[0, 0])

    def polarization_dependent_loss(self):
        """10 log10(Tmax/Tmin), dB."""
        return 10 * math.log10(self.extinction_ratio())

    def polarizance(self):
        """Degree of polarization of transmitted unpolarized light."""
        return float(np.linalg.norm(np.asarray(self)[1:, 0]) / self[0, 0])

    def depolarization_index(self):
        """Depolarization index: 1 for a matrix that does not depolarize, 0 for an ideal depolarizer."""
        m = np.asarray(self)
        return math.sqrt((np.sum(m**2) - m[0, 0] ** 2) / (3 * m[0, 0] ** 2))

    def extinction_ratio(self):
        """Tmax/Tmin."""
        return self.Tmax() / self.Tmin()

    def rotate(self, angle):
        """The matrix of the element turned by ``angle``."""
        turn = np.asarray(MuellerRotator(angle))
        return MuellerMatrix(turn @ np.asarray(self) @ turn.T)

    def parity(self):
        """The matrix of the mirrored element."""
        mirror = np.diag([1.0, 1.0, -1.0, -1.0])
        return MuellerMatrix(mirror @ np.asarray(self) @ mirror)

    def transpose(self):
        """The transposed matrix."""
        return MuellerMatrix(np.asarray(self).T.copy())

    def inverse(self):
        """The inverse matrix."""
        return MuellerMatrix(np.linalg.inv(np.asarray(self)))

    def valid(self):
        """True if the matrix makes a Stokes vector of every Stokes vector."""
        m = np.asarray(self).copy()
        m[0, 0] += 1e-10
        g = np.diag([1.0, -1.0, -1.0, -1.0])
        values, vectors = np.linalg.eig(g @ m.T @ g @ m)
        largest = vectors[:, np.argmax(values.real)].real
        is_time_like = abs(largest[0]) >= np.linalg.norm(largest[1:]) * (1 - 1e-12)
        is_real = np.max(np.abs(values.imag)) <= 1e-9 * np.max(np.abs(values))
        return bool(is_real and is_time_like and m[0, 0] >= np.linalg.norm(m[0, 1:]))

    def physically_valid(self):
        """True if the matrix is a sum of matrices that do not depolarize."""
        values = np.linalg.eigvalsh(MuellerToHermitian(self))
        return bool(np.min(values) >= -NEGATIVE * np.sum(np.abs(values)))

    def Closest_NonDepolarizing(self):
        """The matrix without depolarization that is next to this one."""
        return MuellerMatrix(closest_nondepolarizing(np.asarray(self)))

    def normalized(self):
        """The matrix divided by its first element."""
        return MuellerMatrix(np.asarray(self) / self[0, 0])

    def entropy(self):
        """Entropy of the matrix: 0 without depolarization, 1 for an ideal depolarizer."""
        values = np.linalg.eigvalsh(hermitian(np.asarray(self)))
        p = np.clip(values / np.sum(values), 0, None)
        p = p[p > 0]
        return float(-np.sum(p * np.log(p)) / math.log(4))

    def Cloude_Decomposition(self):
        """Four matrices without depolarization whose sum is this one, the largest first."""
        return Cloude_Decomposition(self)

    def Lu_Chipman_Decomposition(self):
        """Depolarizer, retarder and diattenuator whose product is this matrix."""
        return Lu_Chipman_Decomposition(self)

    def Reverse_Lu_Chipman_Decomposition(self):
        """Diattenuator, retarder and depolarizer whose product is this matrix."""
        return Reverse_Lu_Chipman_Decomposition(self)

    def Symmetric_Decomposition(self):
        """Diattenuator, retarder, depolarizer, retarder, diattenuator whose product is this matrix."""
        return Symmetric_Decomposition(self)

    def MuellerLog(self):
        """The logarithm of the matrix."""
        return MuellerLog(self)

    def MuellerExp(self):
        """The exponential of the matrix."""
        return MuellerExp(self)


def _like(a, values):
    """The values as a matrix or vector like ``a``; plain for a part of one."""
    return values.view(type(a)) if values.shape in ((4, 4), (4,)) else values


def _product(a, b):
    if np.shape(a) != (4, 4):
        return np.asarray(a) * np.asarray(b)
    if isinstance(b, StokesVector) or np.shape(b) == (4,):
        return StokesVector(np.asarray(a) @ np.asarray(b))
    if np.ndim(b) == 0:
        return MuellerMatrix(np.asarray(a) * b)
    return MuellerMatrix(np.asarray(a) @ np.asarray(b))


class StokesVector(np.ndarray):
    """A Stokes vector from four numbers or an array; zero without arguments.

    >>> StokesVector(2, 0.6, 0, 0).DOP()
    0.3
    """

    def __new__(cls, *x):
        return _values(x, 4).view(cls)

    def __array_finalize__(self, other):
        """No attribute is inherited."""

    def __mul__(a, b):
        if np.shape(a) != (4,):
            return np.asarray(a) * np.asarray(b)
        if np.ndim(b) == 0:
            return StokesVector(np.asarray(a) * b)
        if np.shape(b) == (4, 4):
            return StokesVector(np.asarray(a) @ np.asarray(b))
        return float(np.asarray(a) @ np.asarray(b))

    def __matmul__(a, b):
        return a * b

    def __rmul__(a, b):
        return _like(a, np.asarray(a) * b)

    def __truediv__(a, b):
        return _like(a, np.asarray(a) / np.asarray(b))

    def I(self):
        """Intensity."""
        return float(self[0])

    def Q(self):
        """s minus p."""
        return float(self[1])

    def U(self):
        """+45° minus −45°."""
        return float(self[2])

    def V(self):
        """Left minus right."""
        return float(self[3])

    def q(self):
        """Q/I."""
        return float(self[1] / self[0])

    def u(self):
        """U/I."""
        return float(self[2] / self[0])

    def v(self):
        """V/I."""
        return float(self[3] / self[0])

    def rotate(self, angle):
        """The vector of the light turned by ``angle``."""
        return StokesVector(np.asarray(MuellerRotator(angle)) @ np.asarray(self))

    def eta(self):
        """Angle of the polarization, rad."""
        return math.atan2(self[2], self[1]) / 2

    def intensity(self):
        """Intensity."""
        return float(self[0])

    def _polarized(self):
        return float(np.linalg.norm(np.asarray(self)[1:]))

    def DOLP(self):
        """Degree of linear polarization."""
        return float(np.hypot(self[1], self[2]) / self[0])

    def DOP(self):
        """Degree of polarization."""
        return self._polarized() / float(self[0])

    def DOCP(self):
        """Degree of circular polarization."""
        return float(self[3] / self[0])

    def ellipticity(self):
        """Ratio of the axes of the ellipse, negative for right-handed light."""
        return math.tan(math.asin(float(self[3]) / self._polarized()) / 2)

    def delta(self):
        """Phase of p before s, rad."""
        return math.atan2(self[3], self[2])

    def psi(self):
        """Angle whose tangent is |E_p|/|E_s|, rad."""
        return math.acos(float(self[1]) / self._polarized()) / 2

    def eccentricity(self):
        """Eccentricity of the ellipse."""
        return math.sqrt(1 - self.ellipticity() ** 2)

    def valid(self):
        """True if the vector is that of light."""
        return bool(self[0] >= self._polarized())

    def pol_part(self):
        """The polarized part."""
        return StokesVector(self._polarized(), *np.asarray(self)[1:])

    def unpol_part(self):
        """The unpolarized part."""
        return StokesVector(float(self[0]) - self._polarized(), 0, 0, 0)

    def JonesVector(self):
        """Jones vector of the polarized part, E_s real."""
        intensity = self._polarized()
        s = math.sqrt((intensity + float(self[1])) / 2)
        if s == 0:
            return np.array([0, math.sqrt(intensity)], complex)
        return np.array([s, (self[2] + 1j * self[3]) / (2 * s)], complex)

    def normalized(self):
        """The vector divided by its intensity."""
        return StokesVector(np.asarray(self) / self[0])

    def __str__(self):
        return f"StokesVector({', '.join(repr(float(x)) for x in np.asarray(self))})"

    __repr__ = __str__


def JonesMueller(jones):
    """Mueller matrix of a Jones matrix."""
    j = np.asarray(jones, complex).reshape(4)
    return MuellerMatrix(mueller_of_hermitian(np.outer(j, j.conj())))


def JonesStokes(jones):
    """Stokes vector of a Jones vector."""
    s, p = np.asarray(jones, complex)
    cross = 2 * s.conjugate() * p
    return StokesVector(abs(s) ** 2 + abs(p) ** 2, abs(s) ** 2 - abs(p) ** 2, cross.real, cross.imag)


def MuellerToHermitian(m):
    """Coherency matrix of a Mueller matrix; its trace is twice M00."""
    return hermitian(np.asarray(m, float))


def HermitianToMueller(h):
    """Mueller matrix of a coherency matrix."""
    return MuellerMatrix(mueller_of_hermitian(np.asarray(h, complex)))


def Cloude_Decomposition(M):
    """Four matrices without depolarization whose sum is M, the largest first."""
    return tuple(MuellerMatrix(m) for m in cloude(np.asarray(M, float)))


#: The permutation symbol.
LeviCivita = np.array(
    [[[(i - j) * (j - k) * (k - i) / 2 for k in range(3)] for j in range(3)] for i in range(3)]
).astype(int)


def Lu_Chipman_Decomposition(M):
    """Depolarizer, retarder and diattenuator whose product is M."""
    return tuple(MuellerMatrix(m) for m in lu_chipman(np.asarray(M, float)))


def Test_Lu_Chipman_Decomposition(M):
    """Largest difference of M from the product of its decomposition."""
    depolarizer, retarder, diattenuator = lu_chipman(np.asarray(M, float))
    return float(np.max(np.abs(depolarizer @ retarder @ diattenuator - np.asarray(M, float))))


def Reverse_Lu_Chipman_Decomposition(M):
    """Diattenuator, retarder and depolarizer whose product is M."""
    return tuple(MuellerMatrix(m) for m in reverse_lu_chipman(np.asarray(M, float)))


def Symmetric_Decomposition(M):
    """Diattenuator, retarder, depolarizer, retarder, diattenuator whose product is M."""
    return tuple(MuellerMatrix(m) for m in symmetric(np.asarray(M, float)))


class CharacterizedMueller:
    """The Lu–Chipman decomposition of a matrix and the numbers that describe its parts."""

    def __init__(self, M):
        self.M = MuellerMatrix(M)
        self.Mdepol, self.Mret, self.Mdiatten = Lu_Chipman_Decomposition(self.M)
        diattenuator, retarder, depolarizer = map(
            np.asarray, (self.Mdiatten, self.Mret, self.Mdepol)
        )
        self.DiattenuationVector = diattenuator[0, 1:] / diattenuator[0, 0]
        self.Diattenuation = float(np.linalg.norm(self.DiattenuationVector))
        self.CircularDiattenuation = float(self.DiattenuationVector[2])
        self.LinearDiattenuation = float(np.hypot(*self.DiattenuationVector[:2]))
        self.DiattenuationAngle = (
            math.atan2(self.DiattenuationVector[1], self.DiattenuationVector[0]) / 2
        )
        self.PolarizanceVector = depolarizer[1:, 0]
        self.Polarizance = float(np.linalg.norm(self.PolarizanceVector))
        self.DepolarizationCoefficient = float(abs(np.trace(depolarizer) - 1) / 3)
        m = retarder
        self.Retardance = math.acos(np.clip(np.trace(m) / 2 - 1, -1, 1))
        self.OpticalRotation = math.atan2(m[2, 1] - m[1, 2], m[1, 1] + m[2, 2]) / 2
        self.LinearRetardance = math.acos(
            np.clip(np.hypot(m[1, 1] + m[2, 2], m[2, 1] - m[1, 2]) - 1, -1, 1)
        )
        # The axis of the linear retarder before the optical rotation.
        turned = math.atan2(m[3, 1] - m[1, 3], m[2, 3] - m[3, 2])
        self.RetardanceAngle = (turned - self.OpticalRotation) / 2

    def __str__(self):
        return "\n".join(f"{name} = {value}" for name, value in vars(self).items())


def MuellerLog(M):
    """The logarithm of a matrix."""
    return MuellerMatrix(matrix_log(np.asarray(M, float)))


def MuellerExp(L):
    """The exponential of a matrix."""
    return MuellerMatrix(matrix_exp(np.asarray(L, float)))


#: The metric of Stokes vectors.
MinkowskiG = MuellerMatrix(np.diag([1.0, -1.0, -1.0, -1.0]))

#: The identity and the three Pauli matrices, in the order of I, Q, U, V.
PauliMatrices = [
    np.array([[1, 0], [0, 1]]),
    np.array([[1, 0], [0, -1]]),
    np.array([[0, 1], [1, 0]]),
    np.array([[0, -1j], [1j, 0]]),
]


def JonesZero():
    """The Jones matrix of nothing."""
    return np.zeros((2, 2), complex)


def JonesUnit():
    """The Jones matrix of free space."""
    return np.eye(2, dtype=complex)


def JonesRotator(angle):
    """The Jones matrix that turns the axes by ``angle``."""
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[c, s], [-s, c]], complex)


def MuellerRotator(angle):
    """The Mueller matrix that turns the axes by ``angle``."""
    c, s = math.cos(2 * angle), math.sin(2 * angle)
    return MuellerMatrix([[1, 0, 0, 0], [0, c, s, 0], [0, -s, c, 0], [0, 0, 0, 1]])


def JonesBasis(angle=0, DOCP=None, jones=None):
    """Two orthonormal Jones vectors, the first along ``angle``, with the ``DOCP``, or along ``jones``."""
    if jones is None:
        # V = sin 2χ of an ellipse along `angle`.
        ellipse = math.asin(DOCP or 0) / 2
        along = np.array([math.cos(ellipse), 1j * math.sin(ellipse)])
        first = JonesRotator(-angle) @ along
    else:
        first = np.asarray(jones, complex) / np.linalg.norm(np.asarray(jones, complex))
    second = np.array([-first[1].conjugate(), first[0].conjugate()])
    return first, second


def _eigen(first_value, second_value, angle, DOCP, jones):
    first, second = JonesBasis(angle, DOCP, jones)
    return first_value * np.outer(first, first.conj()) + second_value * np.outer(
        second, second.conj()
    )


def JonesRetarder(phase=0, angle=0, DOCP=None, jones=None):
    """The Jones matrix of a retarder whose second eigenstate is delayed by ``phase``."""
    return _eigen(1, np.exp(1j * phase), angle, DOCP, jones)


def JonesDiattenuator(diatten=0, angle=0, DOCP=None, jones=None):
    """The Jones matrix of a diattenuator that passes ``diatten`` of its second eigenstate."""
    return _eigen(1, math.sqrt(diatten), angle, DOCP, jones)


def MuellerRetarder(phase=0, angle=0, DOCP=None, jones=None):
    """The Mueller matrix of :func:`JonesRetarder`."""
    return JonesMueller(JonesRetarder(phase, angle, DOCP, jones))


def MuellerDiattenuator(diatten=0, angle=0, DOCP=None, jones=None):
    """The Mueller matrix of :func:`JonesDiattenuator`."""
    return JonesMueller(JonesDiattenuator(diatten, angle, DOCP, jones))


JonesPolarizer = JonesDiattenuator
MuellerPolarizer = MuellerDiattenuator


def MuellerZero():
    """The Mueller matrix of nothing."""
    return MuellerMatrix()


def MuellerUnit(attenuation=1):
    """The Mueller matrix of a filter that passes ``attenuation`` of any light."""
    return MuellerMatrix(np.eye(4) * attenuation)


def MuellerDiagonal(a):
    """The Mueller matrix with the diagonal ``a``."""
    return MuellerMatrix(np.diag(np.asarray(a, float)))


def StokesZero():
    """The Stokes vector of darkness."""
    return StokesVector()


_LETTERS = {"s": (1, 0, 0), "p": (-1, 0, 0), "l": (0, 0, 1), "r": (0, 0, -1), "u": (0, 0, 0)}


def _direction(args, angle, ellipticity, jones):
    """The unit vector (q, u, v), or zero, that the arguments describe."""
    state = args[0] if args else None
    if isinstance(state, str):
        return np.array(_LETTERS[state.lower()], float)
    if jones is not None:
        stokes = JonesStokes(jones)
        return np.asarray(stokes)[1:] / stokes[0]
    angle = angle if state is None else float(state)
    if angle is None:
        return np.zeros(3)
    flat = math.cos(2 * ellipticity)
    return np.array(
        [flat * math.cos(2 * angle), flat * math.sin(2 * angle), math.sin(2 * ellipticity)]
    )


def Polarization(*args, angle=None, ellipticity=0, DOP=1, I=1, jones=None):
    """Stokes vector of light: s, p, L, R, U, an angle (rad), or an ellipse with its angle.

    >>> Polarization("p")
    StokesVector(1.0, -1.0, 0.0, 0.0)
    """
    return StokesVector(I, *(I * DOP * _direction(args, angle, ellipticity, jones)))


def Sensitivity(*args, angle=None, ellipticity=0, DOP=1, I=1, jones=None):
    """Stokes vector of a detector that passes this light: ½(1, 1, 0, 0) for s.

    >>> Sensitivity("s")
    StokesVector(0.5, 0.5, 0.0, 0.0)
    """
    direction = _direction(args, angle, ellipticity, jones)
    polarized = DOP * float(np.any(direction))
    return StokesVector(I * (1 - polarized / 2), *(I * polarized / 2 * direction))
