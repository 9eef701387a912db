"""Klems XML in Radiance: checkBSDF, and values in single directions."""

import os
import subprocess
from pathlib import Path

import numpy as np
import pyradiance
from pyradiance import bsdf

ROUGH = {"model": "Two_Source_BRDF_Model", "parameters": {
    "substrate": "(1.5,0)", "factor1": 1, "source1": "Facet_BRDF_Model",
    "source1.substrate": "(1.5,0)", "source1.sdf": "Gaussian_Slope_Distribution_Function",
    "source1.sdf.s": 0.6, "factor2": 1, "source2": "Lambertian_BRDF_Model",
    "source2.substrate": "(1.5,0)", "source2.reflectance": "Table_Reflectance",
    "source2.reflectance.table": 0.4}}


def check(mist, report):
    path, _ = mist.export(ROUGH, "rough.xml", "--lambda", "400:20:700")
    here = Path(pyradiance.__file__).parent
    said = subprocess.run([here / "bin" / "checkBSDF", path], capture_output=True, text=True,
                          env={**os.environ, "RAYPATH": f".:{here / 'lib'}"}, check=False).stdout
    report("Klems, lines of checkBSDF without Klems_Full", int("Klems_Full" not in said), 0)
    data = bsdf.load_file(path)
    errors = []
    for theta_i in (0.0, 20.0, 40.0, 60.0):
        for theta_o, phi in ((0.0, 0.0), (10.0, 45.0), (30.0, 90.0), (50.0, 180.0), (60.0, 0.0)):
            # The middles of patches; the viewer at azimuth phi, the light at 180 degrees.
            found = np.array(bsdf.query(data, theta_i, 180.0, theta_o, phi))[1]
            polar, azimuth = np.radians([theta_i, theta_o]), np.radians(phi)
            l = np.array([-np.sin(polar[0]), 0, np.cos(polar[0])])
            v = np.array([np.sin(polar[1]) * np.cos(azimuth), np.sin(polar[1]) * np.sin(azimuth),
                          np.cos(polar[1])])
            parameters = {f"{name}lambda": 0.55 for name in ("source1.", "source2.")}
            material = {**ROUGH, "parameters": {**ROUGH["parameters"], **parameters}}
            exact = mist.plane(material, [(l + 1e-6, v)], 550)[0, 0, 0]
            errors.append(abs(found / exact - 1))
    # Means over patches of 10 to 15 degrees against single directions.
    report("Klems, Radiance's values in single directions, median", np.median(errors), 0.05)
