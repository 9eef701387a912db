"""Mitsuba's frames in numpy, independent of the Rust code (docs/formats/pbsdf.md)."""

import numpy as np

FLIP = np.diag([1.0, 1.0, 1.0, -1.0])


def basis(k):
    """x of Mitsuba's Stokes basis for light along k (Duff et al. 2017)."""
    sign = np.copysign(1.0, k[2])
    a = -1.0 / (sign + k[2])
    return np.array([1 + sign * k[0] ** 2 * a, sign * k[0] * k[1] * a, -sign * k[0]])


def turn(theta):
    """Stokes vectors in a frame rotated by theta from x towards y."""
    c, s = np.cos(2 * theta), np.sin(2 * theta)
    return np.array([[1, 0, 0, 0], [0, c, s, 0], [0, -s, c, 0], [0, 0, 0, 1.0]])


def angle(k, a, b):
    return np.arctan2(np.dot(np.cross(a, b), k), np.dot(a, b))


def between_axes(plane, l, v, x_in, x_out):
    """The matrix `plane` of mist in frames with these first axes."""
    x = np.cross(l, v)
    x /= np.linalg.norm(x)
    return turn(angle(v, x, x_out)) @ FLIP @ plane @ FLIP @ turn(angle(-l, x, x_in)).T


def directions(phi_d, theta_d, theta_h):
    """(l, v) of half and difference angles."""
    h = np.array([np.sin(theta_h), 0, np.cos(theta_h)])
    t = np.array([np.cos(theta_h), 0, -np.sin(theta_h)])
    across = np.cos(phi_d) * t + np.sin(phi_d) * np.array([0, 1.0, 0])
    l = np.cos(theta_d) * h + np.sin(theta_d) * across
    return l, 2 * np.dot(l, h) * h - l


def geometry(l, v):
    """The angles that `mist eval` takes; the x axis of the frame is that of the sample."""
    forward = np.arctan2(-l[1], -l[0])
    polar = [float(np.arctan2(np.hypot(w[0], w[1]), w[2])) for w in (l, v)]
    return {"theta_i": polar[0], "theta_s": polar[1],
            "phi_s": float(np.arctan2(v[1], v[0]) - forward), "rotation": float(-forward)}
