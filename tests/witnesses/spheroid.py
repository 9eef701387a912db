"""A body of revolution by matching fields on its surface in the sense of least squares.

The scattered and the inner field are sums of multipoles of one azimuthal order; their coefficients
are those that make the tangential fields continuous at the points of a Gauss rule. Nothing is
integrated over the surface, as the extended boundary condition does.
"""

import numpy as np
from scipy.special import gammaln, lpmv, spherical_jn, spherical_yn


def angular(l_max, m, theta):
    """(P, dP/dtheta, m P/sin) of l from max(1, |m|), normalized to 1 on the sphere."""
    x, sin, order = np.cos(theta), np.sin(theta), abs(m)
    rows = []
    for l in range(max(1, order), l_max + 1):
        norm = np.sqrt((2 * l + 1) / (4 * np.pi) * np.exp(gammaln(l - order + 1) - gammaln(l + order + 1)))
        p = norm * lpmv(order, l, x)
        if order == 0:
            slope = norm * lpmv(1, l, x)
        else:
            above = lpmv(order + 1, l, x) if order < l else np.zeros_like(x)
            slope = -0.5 * norm * ((l + order) * (l - order + 1) * lpmv(order - 1, l, x) - above)
        sign = (-1) ** order if m < 0 else 1
        rows.append((sign * p, sign * slope, sign * m * p / sin))
    return rows


def radial(kind, l, z):
    """j or h of l, and its derivative."""
    value, slope = spherical_jn(l, z), spherical_jn(l, z, True)
    if kind == "outgoing":
        value = value + 1j * spherical_yn(l, z)
        slope = slope + 1j * spherical_yn(l, z, True)
    return value, slope


def tangential(kind, l_max, m, k, theta, r, lean):
    """Fields of M and N multipoles along the meridian and along the parallel, rows by l."""
    length = np.sqrt(r * r + lean * lean)
    magnetic, electric = [], []
    first = max(1, abs(m))
    for l, (p, tau, mu) in enumerate(angular(l_max, m, theta), first):
        z, dz = radial(kind, l, k * r)
        over, slope = z / (k * r), z / (k * r) + dz
        magnetic.append((1j * mu * z * r / length, -tau * z))
        along = (l * (l + 1) * over * p * lean + slope * tau * r) / length
        electric.append((along, 1j * mu * slope))
    return np.array(magnetic), np.array(electric)


def t_matrices(vertical, horizontal, index, k, l_max, points=80):
    """T by order m, M multipoles before N, for the half axes of a spheroid."""
    x, weight = np.polynomial.legendre.leggauss(points)
    theta = np.arccos(x)
    cos, sin = np.cos(theta), np.sin(theta)
    r = 1 / np.sqrt((cos / vertical) ** 2 + (sin / horizontal) ** 2)
    lean = -(r**3) * cos * sin * (1 / horizontal**2 - 1 / vertical**2)
    weight = np.sqrt(weight * r * np.sqrt(r * r + lean * lean))
    blocks = {}
    for m in range(-l_max, l_max + 1):
        size = l_max - max(1, abs(m)) + 1

        def column(kind, wave, ratio):
            # Electric fields over magnetic ones, which are those of the other kind of multipole.
            both = tangential(kind, l_max, m, wave, theta, r, lean)
            m_field, n_field = ((f * weight).reshape(size, -1).T for f in both)
            return np.hstack(
                [np.vstack([m_field, ratio * n_field]), np.vstack([n_field, ratio * m_field])]
            )

        system = np.hstack([column("outgoing", k, 1), -column("regular", k * index, index)])
        scale = np.linalg.norm(system, axis=0)
        answer = np.linalg.lstsq(system / scale, -column("regular", k, 1), rcond=1e-14)[0]
        blocks[m] = (answer / scale[:, None])[: 2 * size]
    return blocks


def polar(direction):
    """theta, phi and the unit vectors along both."""
    x, y, z = direction
    theta, phi = np.arccos(np.clip(z, -1, 1)), np.arctan2(y, x)
    along = np.array([np.cos(theta) * np.cos(phi), np.cos(theta) * np.sin(phi), -np.sin(theta)])
    return theta, phi, along, np.array([-np.sin(phi), np.cos(phi), 0.0])


def amplitude(blocks, l_max, k_in, k_out, frame_in, frame_out):
    """The Jones matrix between two beams in the frames (s, p) given, as Bohren & Huffman's S."""
    theta_i, phi_i, *axes_i = polar(k_in)
    theta_s, phi_s, *axes_s = polar(k_out)
    total = np.zeros((2, 2), complex)
    for m, block in blocks.items():
        regular, outgoing = [], []
        for kind in (0, 1):
            incoming_waves = angular(l_max, m, np.array([theta_i]))
            outgoing_waves = angular(l_max, m, np.array([theta_s]))
            first = max(1, abs(m))
            for l, ((_, t_i, u_i), (_, t_s, u_s)) in enumerate(
                zip(incoming_waves, outgoing_waves), first
            ):
                vectors = [
                    np.array([1j * u[0], -t[0]] if kind == 0 else [t[0], 1j * u[0]])
                    for t, u in ((t_i, u_i), (t_s, u_s))
                ]
                factor = 4 * np.pi * 1j**l / (l * (l + 1)) * (1 if kind == 0 else -1j)
                regular.append(factor * np.exp(-1j * m * phi_i) * vectors[0].conj())
                power = (-1j) ** (l + 1 if kind == 0 else l)
                outgoing.append(power * np.exp(1j * m * phi_s) * vectors[1])
        total += -1j * np.array(outgoing).T @ (block @ np.array(regular))
    turn = lambda axes, frame: np.array([[a @ f for f in frame] for a in axes])
    return turn(axes_s, frame_out).T @ total @ turn(axes_i, frame_in)
