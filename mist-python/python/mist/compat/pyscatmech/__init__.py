"""The interface of NIST's package pySCATMECH on top of mist.

After :func:`install` existing notebooks run with their own imports:

>>> import mist.compat.pyscatmech as compat
>>> compat.install()
>>> from pySCATMECH.brdf import BRDF_Model
>>> model = BRDF_Model("Lambertian_BRDF_Model")
>>> round(float(model.MuellerBRDF(thetas=0.3)[0, 0]), 6)
0.31831

Numbers are those of NIST's library, defects included; ``set_mode("sound")`` gives the sound ones. Errors of the
package itself are mended; ``docs/python.md`` lists them.
"""

from __future__ import annotations

import importlib
import sys

from .mode import mode, set_mode

#: The modules of the package.
MODULES = ("model", "mueller", "brdf", "local", "fresnel", "scatterer", "integrate")

__all__ = ["install", "mode", "set_mode", *MODULES]


def install() -> None:
    """Puts this package in the place of ``pySCATMECH``."""
    sys.modules["pySCATMECH"] = sys.modules[__name__]
    for name in MODULES:
        sys.modules[f"pySCATMECH.{name}"] = importlib.import_module(f"{__name__}.{name}")
