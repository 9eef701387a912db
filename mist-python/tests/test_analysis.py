"""Fits, tolerances, colours, tables, files of renderers."""

import json

import numpy as np
import pytest

import mist

GOLD = mist.Material(
    "Facet_BRDF_Model",
    substrate=0.25 + 3.1j,
    sdf=mist.models.Gaussian_Slope_Distribution_Function(s=0.2),
)
PROGRAM = """MODEL = Facet_BRDF_Model
VARIABLES:
  s = 0.1  theta = 0
  incidentangle = 0.5  incidentpol = (1,0,0,0)  rotation = 0
  $substrate = (0.25,3.1)
  $sdf = Gaussian_Slope_Distribution_Function
  #sdf.s = s
END
VARY: FOR theta FROM 0 TO 1 BY 0.1 END
INTEGRALS: f = DIFFERENTIAL CENTER = (theta,0) END END
OUTPUTS: 1 f END
FILES: END
"""


def test_a_fit_finds_the_parameter_of_the_data():
    measured = mist.run(PROGRAM, values={"s": 0.25})
    columns = {"theta": measured["theta"], "f": measured["f"]}
    found = mist.fit(PROGRAM, columns, "s", bounds={"s": (0.01, 1)})
    assert abs(found.parameters[0].value - 0.25) < 1e-6
    assert found.residuals.chi_squared < 1e-9
    assert found.to_dict()["parameters"][0]["name"] == "s"
    with pytest.raises(mist.MistError, match="no variable"):
        mist.fit(PROGRAM, columns, "t")


def test_tolerances_are_those_of_the_colours():
    program = """MODEL = Lambertian_BRDF_Model
VARIABLES:
  r = 0.5  wl = 400
  incidentangle = 0  incidentpol = (1,0,0,0)  rotation = 0
  #lambda = wl/1000
  #reflectance.table = r
END
VARY: FOR wl FROM 400 TO 700 BY 10 END
COLOR: END
"""
    found = mist.tolerance(program, "r")
    greys = [mist.color([380, 580, 780], [r] * 3).Lab for r in (0.4995, 0.5005)]
    rate = mist.delta_e(*greys) / 0.001
    assert abs(found.parameters[0].largest / rate - 1) < 1e-3


def test_differences_of_colours_broadcast():
    found = mist.delta_e([[50, 2.6772, -79.7751], [50, 0, 0]], [50, 0, -82.7485])
    assert found.shape == (2,)
    assert abs(found[0] - 2.0425) < 5e-5


def test_tables_have_the_values_of_the_material(tmp_path):
    found = GOLD.table(thetai=[30], thetas=[20, 30], phis=[0], wavelengths=[530, 534])
    assert found.rgb.shape == (2, 3)
    wanted = GOLD.brdf(np.radians(30), np.radians([20, 30]))
    np.testing.assert_allclose(found.columns["I"], wanted, rtol=1e-8)
    for name in ("a.mtab", "a.json", "a.svg"):
        found.write(tmp_path / name)
        assert (tmp_path / name).stat().st_size > 200
    assert json.loads((tmp_path / "a.json").read_text())
    with pytest.raises(mist.MistError) as refused:
        GOLD.table(thetai="0:x:2")
    assert refused.value.part == "thetai"


def test_files_of_renderers_are_written(tmp_path):
    line = GOLD.export(tmp_path / "gold.pbsdf", wavelengths=[450, 500, 550, 600, 650], grid="5x6x7")
    assert "5" in line
    assert (tmp_path / "gold.pbsdf").read_bytes()[:12] == b"tensor_file\0"
    with pytest.raises(mist.MistError, match="format"):
        GOLD.export(tmp_path / "gold.xyz")
    assert [path.name for path in tmp_path.iterdir()] == ["gold.pbsdf"]


def test_the_client_of_the_service_is_there():
    assert mist.Service("http://127.0.0.1:1") is not None
