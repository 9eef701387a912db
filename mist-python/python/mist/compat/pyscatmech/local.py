"""Differential scattering cross-sections of single particles and defects at a surface."""

from __future__ import annotations

import numpy as np

from .brdf import BRDF_Model
from .model import Model
from .mueller import MuellerMatrix, StokesVector, deg, pi  # noqa: F401


class Local_BRDF_Model(Model):
    """A particle or a defect with a differential scattering cross-section, µm²/sr; angles are rad.

    The cross-section is f cosθ_i cosθ_s/N with the BRDF f of N of them per area.
    """

    DEFAULT = "Bobbert_Vlieger_BRDF_Model"

    def _scaled(self, function, thetai, thetas, root=False):
        model = BRDF_Model(self)
        per_area = 1 / float(self._density())
        factor = np.cos(thetai) * np.cos(thetas) * per_area
        factor = np.sqrt(np.maximum(factor, 0)) if root else factor
        return function(model), factor

    def _density(self):
        return self.getParameter("density") if "density" in self._values else 1.0

    def MuellerDSC(self, thetai=0, thetas=0, phis=0, rotation=0, coords="psps"):
        """The Mueller matrix of the cross-section."""
        found, factor = self._scaled(
            lambda model: np.asarray(model.MuellerBRDF(thetai, thetas, phis, rotation, coords)),
            thetai,
            thetas,
        )
        found = found * np.asarray(factor)[..., None, None]
        return MuellerMatrix(found) if found.shape == (4, 4) else found

    def JonesDSC(self, thetai=0, thetas=0, phis=0, rotation=0, coords="psps"):
        """The Jones matrix whose Mueller matrix is the cross-section."""
        found, factor = self._scaled(
            lambda model: model.JonesBRDF(thetai, thetas, phis, rotation, coords),
            thetai,
            thetas,
            root=True,
        )
        return found * np.asarray(factor)[..., None, None]

    def DSC(
        self,
        thetai=0,
        thetas=0,
        phis=0,
        rotation=0,
        coords="psps",
        inc=StokesVector(1, 0, 0, 0),
        sens=StokesVector(1, 0, 0, 0),
    ):
        """The cross-section for the incident light ``inc`` and the sensitivity ``sens``."""
        found, factor = self._scaled(
            lambda model: model.BRDF(thetai, thetas, phis, rotation, coords, inc, sens),
            thetai,
            thetas,
        )
        return found * factor
