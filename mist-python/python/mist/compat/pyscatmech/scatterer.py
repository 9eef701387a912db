"""Particles in free space."""

from __future__ import annotations

import numpy as np

from ... import _native
from .decompositions import SIGMA
from .mode import mode
from .model import Model
from .mueller import JonesMueller, MuellerMatrix, deg, perpto, pi, unit  # noqa: F401


class Free_Space_Scatterer(Model):
    """A particle in a homogeneous medium; directions are vectors, polarizations along and across their plane.

    >>> sphere = Free_Space_Scatterer("MieScatterer", radius=0.1, sphere=1.59)
    >>> round(float(sphere.Extinction([0, 0, 1])[0, 0]), 6)
    0.016361
    """

    DEFAULT = "MieScatterer"

    def _native_scatterer(self):
        texts = tuple(self._texts(""))
        if getattr(self, "_key", None) != (texts, mode()):
            native = _native.Scatterer(
                self._class, list(texts), dict(self._files), mode() == "compat"
            )
            self._particle, self._key = native, (texts, mode())
        return self._particle

    def ScatteringMatrix(self, vi, vo):
        """The amplitude matrix, µm: |S|² is the differential cross-section."""
        return self._amplitudes(vi, vo, True)

    def _amplitudes(self, vi, vo, in_plane):
        particle = self._native_scatterer()
        directions = [[float(x) for x in v] for v in (vi, vo)]
        return particle.jones(*directions, in_plane) / particle.wave_number

    def DifferentialScatteringCrossSection(self, vi, vo):
        """The Mueller matrix of the differential cross-section, µm²/sr."""
        return JonesMueller(self.ScatteringMatrix(vi, vo))

    def Extinction(self, v):
        """The Mueller matrix of the extinction cross-section, µm²: the optical theorem.

        M. I. Mishchenko, L. D. Travis, A. A. Lacis, Scattering, Absorption, and Emission of Light by Small Particles
        (Cambridge, 2002), sec. 2.5.
        """
        forward = self._amplitudes(v, v, False)
        factor = pi / self._native_scatterer().wave_number
        matrix = [
            [
                factor * np.trace(s @ (forward @ t + t @ forward.conj().T)).real
                for t in SIGMA
            ]
            for s in SIGMA
        ]
        return MuellerMatrix(np.array(matrix))
