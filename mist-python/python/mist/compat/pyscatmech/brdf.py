"""BRDFs of models."""

from __future__ import annotations

import cmath  # noqa: F401  Names that notebooks take from here.
import math  # noqa: F401

import numpy as np

from .model import Model
from .mueller import MuellerMatrix, StokesVector, deg, pi  # noqa: F401


class BRDF_Model(Model):
    """A model with a bidirectional reflectance distribution function, 1/sr; angles are rad.

    >>> white = BRDF_Model("Lambertian_BRDF_Model")
    >>> round(float(white.BRDF(thetai=0.3)), 6)
    0.31831
    """

    def _built(self):
        texts = tuple(self._texts(""))
        if getattr(self, "_key", None) != texts:
            self._material = self.material()
            self._key = texts
        return self._material

    def MuellerBRDF(self, thetai=0, thetas=0, phis=0, rotation=0, coords="psps"):
        """The Mueller matrix of the BRDF; arrays of angles give arrays of matrices."""
        found = self._built().mueller(thetai, thetas, phis, rotation, basis=coords)
        return MuellerMatrix(found) if found.shape == (4, 4) else found

    def JonesBRDF(self, thetai=0, thetas=0, phis=0, rotation=0, coords="psps"):
        """The Jones matrix whose Mueller matrix is the BRDF."""
        return self._built().jones(thetai, thetas, phis, rotation, basis=coords)

    def BRDF(
        self,
        thetai=0,
        thetas=0,
        phis=0,
        rotation=0,
        coords="psps",
        inc=StokesVector(1, 0, 0, 0),
        sens=StokesVector(1, 0, 0, 0),
    ):
        """The BRDF for the incident light ``inc`` and the sensitivity ``sens``."""
        return self._built().brdf(
            thetai,
            thetas,
            phis,
            rotation,
            incident=tuple(np.asarray(inc, float)),
            sensitivity=tuple(np.asarray(sens, float)),
            basis=coords,
        )
