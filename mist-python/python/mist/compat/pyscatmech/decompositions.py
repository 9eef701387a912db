"""Decompositions of Mueller matrices, as plain arrays."""

from __future__ import annotations

import numpy as np

#: Matrices whose expectation values are the Stokes parameters.
SIGMA = np.array(
    [[[1, 0], [0, 1]], [[1, 0], [0, -1]], [[0, 1], [1, 0]], [[0, -1j], [1j, 0]]], complex
)


def hermitian(m):
    """Coherency matrix C = <vec J vec J†> of a Mueller matrix, vec J row by row."""
    return np.einsum("ij,iba,jdc->bcad", m, SIGMA, SIGMA).reshape(4, 4) / 2


def mueller_of_hermitian(h):
    """Mueller matrix of a coherency matrix."""
    c = np.asarray(h).reshape(2, 2, 2, 2)
    return np.einsum("iab,jcd,bcad->ij", SIGMA, SIGMA, c).real / 2


def cloude(m):
    """Four matrices without depolarization whose sum is ``m``, the largest first."""
    values, vectors = np.linalg.eigh(hermitian(m))
    order = np.argsort(-values)
    return [
        mueller_of_hermitian(values[k] * np.outer(vectors[:, k], vectors[:, k].conj()))
        for k in order
    ]


def closest_nondepolarizing(m):
    """The matrix of rank one next to ``m``."""
    return cloude(m)[0]


def diattenuator(vector, transmittance=1.0):
    """Diattenuator with a diattenuation vector (Lu and Chipman 1996, eq. 36)."""
    d2 = float(vector @ vector)
    m = np.empty((4, 4))
    m[0, 0] = 1
    m[0, 1:] = m[1:, 0] = vector
    root = np.sqrt(max(0.0, 1 - d2))
    m[1:, 1:] = root * np.eye(3)
    if d2 > 0:
        m[1:, 1:] += (1 - root) * np.outer(vector, vector) / d2
    return m * transmittance


def lu_chipman(m):
    """Depolarizer, retarder and diattenuator whose product is ``m`` (eqs. 36, 48 to 53)."""
    diattenuation = diattenuator(m[0, 1:] / m[0, 0], m[0, 0])
    rest = m @ np.linalg.inv(diattenuation)
    inner = rest[1:, 1:]
    # The polar decomposition of the inner matrix: symmetric times rotation.
    left, singular, right = np.linalg.svd(inner)
    sign = np.sign(np.linalg.det(inner)) or 1.0
    symmetric_part = sign * (left * singular) @ left.T
    depolarizer = np.eye(4)
    depolarizer[1:, 0] = rest[1:, 0]
    depolarizer[1:, 1:] = symmetric_part
    retarder = np.eye(4)
    retarder[1:, 1:] = sign * left @ right
    return depolarizer, retarder, diattenuation


def reverse_lu_chipman(m):
    """Diattenuator, retarder and depolarizer whose product is ``m``."""
    depolarizer, retarder, diattenuation = lu_chipman(m.T)
    return diattenuation.T, retarder.T, depolarizer.T


def symmetric(m):
    """Diattenuator, retarder, depolarizer, retarder and diattenuator whose product is ``m``.

    Ossikovski (2009): the diattenuation vectors are the eigenvectors of Mᵀ G M G and M G Mᵀ G for the
    largest eigenvalue.
    """
    g = np.diag([1.0, -1.0, -1.0, -1.0])

    def diattenuation(matrix):
        values, vectors = np.linalg.eig(matrix)
        vector = vectors[:, np.argmax(values.real)].real
        return diattenuator(vector[1:] / vector[0])

    # M = D2 M' D1, with the first column and row of M' zero but for its first element.
    entrance = diattenuation(m.T @ g @ m @ g)
    exit_ = diattenuation(m @ g @ m.T @ g)
    inner = np.linalg.inv(exit_) @ m @ np.linalg.inv(entrance)
    left, singular, right = np.linalg.svd(inner[1:, 1:])
    for rotation in (left, right):
        if np.linalg.det(rotation) < 0:
            rotation *= -1
            singular = -singular
    retarders = [np.eye(4), np.eye(4)]
    retarders[0][1:, 1:], retarders[1][1:, 1:] = left, right
    depolarizer = np.diag([inner[0, 0], *singular])
    return exit_, retarders[0], depolarizer, retarders[1], entrance


def matrix_log(m):
    """Principal logarithm of a matrix by its eigenvectors."""
    values, vectors = np.linalg.eig(m.astype(complex))
    return (vectors @ np.diag(np.log(values)) @ np.linalg.inv(vectors)).real


def matrix_exp(m):
    """Exponential of a matrix by its eigenvectors."""
    values, vectors = np.linalg.eig(m.astype(complex))
    return (vectors @ np.diag(np.exp(values)) @ np.linalg.inv(vectors)).real
