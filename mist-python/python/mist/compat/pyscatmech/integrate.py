"""Sums of BRDFs and cross-sections over grids of directions.

A grid point (x, y) is a direction with the azimuth atan2(y, x) and the polar angle θ of ρ = √(x² + y²): type 1
θ = ρπ/2, type 2 cosθ = 1 − ρ², type 3 sinθ = ρ.
"""

from __future__ import annotations

import math

import numpy as np

from .mueller import StokesVector, deg, pi, unit  # noqa: F401


class SolidAngle:
    """A set of directions with a sensitivity; ``&``, ``|`` and ``~`` combine them.

    ``inside(v)`` of the projected direction v = (x, y) gives (True or False, the sensitivity).
    """

    def inside(self, v):
        """Whether the direction belongs to it, and the sensitivity there."""
        raise NotImplementedError

    def __and__(self, other):
        return _Combined(lambda a, b: a and b, (self, other))

    def __or__(self, other):
        return _Combined(lambda a, b: a or b, (self, other))

    def __invert__(self):
        return _Inverse(self)


class _Combined(SolidAngle):
    def __init__(self, operation, parts):
        self.operation = operation
        self.parts = parts

    def inside(self, v):
        (a, s), (b, t) = (part.inside(v) for part in self.parts)
        if a and b:
            return True, StokesVector((np.asarray(s) + np.asarray(t)) / 2)
        return self.operation(a, b), s if a else t


class _Inverse(SolidAngle):
    def __init__(self, region):
        self.region = region

    def inside(self, v):
        inside, sensitivity = self.region.inside(v)
        return not inside, sensitivity


def _turned(sensitivity, polphi, phi, plain=False):
    """The sensitivity in the axes x and y."""
    sensitivity = StokesVector(*np.asarray(sensitivity, float))
    if polphi == "xy" or (plain and polphi is None):
        return sensitivity
    if polphi in (None, "sp"):
        return sensitivity.rotate(-phi)
    return sensitivity.rotate(polphi if plain else -polphi)


class Hemisphere(SolidAngle):
    """All directions above the surface."""

    def __init__(self, sensitivity=StokesVector(1, 0, 0, 0), polphi=None):
        self.sensitivity = _turned(sensitivity, polphi, 0, plain=True)

    def inside(self, v):
        return v[0] ** 2 + v[1] ** 2 < 1, self.sensitivity


class _Cone(SolidAngle):
    def __init__(
        self,
        theta=0,
        phi=0,
        alpha=0,
        gamma=0,
        sensitivity=StokesVector(1, 0, 0, 0),
        polphi=None,
    ):
        self.sines = [math.sin(a) for a in (alpha if np.ndim(alpha) else (alpha, alpha))]
        self.sensitivity = _turned(sensitivity, polphi, phi)
        st, ct, sp, cp = math.sin(theta), math.cos(theta), math.sin(phi), math.cos(phi)
        self.axis = np.array([st * cp, st * sp, ct])
        # The x axis seen from the cone's axis, and the axis across it.
        x = unit(np.array([1.0, 0.0, 0.0]) - self.axis[0] * self.axis)
        y = np.cross(self.axis, x)
        c, s = math.cos(gamma), math.sin(gamma)
        self.axes = np.array([c * x + s * y, -s * x + c * y])

    def _components(self, v):
        square = 1 - v[0] ** 2 - v[1] ** 2
        if square < 0:
            return None
        direction = np.array([v[0], v[1], math.sqrt(square)])
        if direction @ self.axis <= 0:
            return None
        return self.axes @ direction


class EllipticalCone(_Cone):
    """A cone around (theta, phi) with the half angle ``alpha``, or two along x and y turned by gamma."""

    def inside(self, v):
        w = self._components(v)
        found = w is not None and sum((w / self.sines) ** 2) < 1
        return bool(found), self.sensitivity


class RectangularCone(_Cone):
    """A rectangular cone around (theta, phi) with the half angles ``alpha``."""

    def inside(self, v):
        w = self._components(v)
        found = w is not None and np.all(np.abs(w) < self.sines)
        return bool(found), self.sensitivity


CircularCone = EllipticalCone
SquareCone = RectangularCone


class ProjectedPolygon(SolidAngle):
    """A polygon in the plane of projected directions."""

    def __init__(self, boundary, sensitivity=StokesVector(1, 0, 0, 0), polphi=None):
        self.boundary = [tuple(map(float, corner)) for corner in boundary]
        x, y = np.mean(self.boundary, axis=0)
        self.sensitivity = _turned(sensitivity, polphi, math.atan2(y, x))

    def inside(self, v):
        x, y = v
        inside = False
        for (x1, y1), (x2, y2) in zip(self.boundary, self.boundary[1:] + self.boundary[:1]):
            if (y1 > y) != (y2 > y) and x < x1 + (y - y1) / (y2 - y1) * (x2 - x1):
                inside = not inside
        return inside and x * x + y * y < 1, self.sensitivity


class Integrator:
    """A sum over the directions of a grid inside ``detector``.

    >>> from .brdf import BRDF_Model
    >>> white = BRDF_Model("Lambertian_BRDF_Model")
    >>> round(Integrator(2 * deg, Hemisphere(), type=2).Reflectance(white, 0.3), 3)
    1.0
    """

    def __init__(self, gridsize, detector, type=1):
        if type not in (1, 2, 3):
            raise ValueError(f"the type {type!r} is none of 1, 2, 3")
        step = gridsize
        ticks = np.arange(-1, 1, step)
        x, y = (axis.ravel() for axis in np.meshgrid(ticks, ticks, indexing="ij"))
        rho = np.hypot(x, y)
        x, y, rho = (axis[rho < 1] for axis in (x, y, rho))
        if type == 1:
            theta = rho * pi / 2
            ratio = np.sinc(theta / pi)
            weight = np.cos(theta) * ratio * (step * pi / 2) ** 2
        elif type == 2:
            theta = np.arccos(1 - rho**2)
            weight = 2 * np.cos(theta) * step**2
        else:
            theta = np.arcsin(rho)
            weight = np.full_like(rho, step**2)
        phi = np.arctan2(y, x)
        points = np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi)
        found = [detector.inside(point) for point in zip(*points)]
        inside = np.array([bool(each[0]) for each in found], bool)
        self.x, self.y = (axis[inside] for axis in points)
        self.z = np.cos(theta)[inside]
        self.weights = self.w = weight[inside]
        self.theta, self.phi = theta[inside], phi[inside]
        kept = [np.asarray(each[1], float) for each in found if each[0]]
        self.sens = np.array(kept).reshape(-1, 4)

    def _values(self, model, name, thetai, incpol, rotation):
        incpol = np.asarray(incpol, float)
        matrices = getattr(model, f"Mueller{name}", None)
        if matrices is not None:
            if not len(self.w):
                return np.zeros(0)
            found = np.asarray(matrices(thetai, self.theta, self.phi, rotation, "xyxy"))
            return np.einsum("ni,nij,j->n", self.sens, found, incpol)
        function = getattr(model, name)
        return np.array(
            [
                function(
                    thetai=thetai,
                    thetas=theta,
                    phis=phi,
                    rotation=rotation,
                    coords="xyxy",
                    inc=StokesVector(incpol),
                    sens=StokesVector(sens),
                )
                for theta, phi, sens in zip(self.theta, self.phi, self.sens)
            ]
        )

    def BRDF(self, model, thetai, incpol=StokesVector(1, 0, 0, 0), rotation=0):
        """The BRDFs at the directions."""
        return self._values(model, "BRDF", thetai, incpol, rotation)

    def Reflectance(self, model, thetai, incpol=StokesVector(1, 0, 0, 0), rotation=0):
        """The reflectance into the detector."""
        return float(np.sum(self.w * self.BRDF(model, thetai, incpol, rotation)))

    def DSC(self, model, thetai, incpol=StokesVector(1, 0, 0, 0), rotation=0):
        """The differential cross-sections at the directions, µm²/sr."""
        return self._values(model, "DSC", thetai, incpol, rotation)

    def CrossSection(self, model, thetai, incpol=StokesVector(1, 0, 0, 0), rotation=0):
        """The cross-section of scattering into the detector, µm²."""
        return float(np.sum(self.w / self.z * self.DSC(model, thetai, incpol, rotation)))

    def PlotSamplingPoints(self, figsize=5, expand=1, color="b", circlecolor="r"):
        """Draws the projected directions; needs matplotlib."""
        import matplotlib.pyplot as plt

        _, axes = plt.subplots(figsize=(figsize, figsize))
        axes.add_patch(plt.Circle((0, 0), 1, fill=False, color=circlecolor))
        axes.scatter(self.x, self.y, s=4 * expand, color=color)
        axes.set_xlim(-1.05, 1.05)
        axes.set_ylim(-1.05, 1.05)
        axes.set_aspect("equal")
        plt.show()
