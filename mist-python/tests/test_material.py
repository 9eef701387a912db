"""Materials: parameters, values, identity, errors."""

import pickle
import copy
import warnings

import numpy as np
import pytest

import mist
from mist import deg


@pytest.fixture
def gold():
    sdf = mist.models.Exponential_Slope_Distribution_Function(s=0.1)
    return mist.Material("Facet_BRDF_Model", wavelength=0.6, substrate=0.25 + 3.1j, sdf=sdf)


def test_parameters_are_read_as_they_were_set(gold):
    assert gold.sdf.s == gold["sdf.s"] == gold["sdf__s"] == 0.1
    assert gold.substrate == gold.parameters["substrate"] == 0.25 + 3.1j
    assert gold.wavelength == gold["lambda"] == gold["wavelength"] == 0.6
    assert gold.sdf == "Exponential_Slope_Distribution_Function"
    assert {"sdf", "substrate", "mueller"} <= set(dir(gold))
    assert dir(gold.sdf) == ["s"]


@pytest.mark.parametrize("x", [0.1 + 0.2, 1 / 3, 1e-7, 5e-324, 0.6328000000000001, 1e15 + 2])
def test_numbers_keep_all_their_bits(x):
    assert mist.Material("Facet_BRDF_Model", {"sdf.s": x})["sdf.s"] == x


def test_all_forms_of_a_value_give_the_same_material():
    given = [
        mist.Material("Facet_BRDF_Model", {"substrate": "(1.5,0.25)", "sdf.s": 0.2}),
        mist.Material("Facet_BRDF_Model", substrate=1.5 + 0.25j, sdf__s=np.float64(0.2)),
        mist.Material("Facet_BRDF_Model", {"sdf.s": "0.2"}, substrate=np.complex128(1.5 + 0.25j)),
        mist.Material("Facet_BRDF_Model", {"sdf": {"s": 0.2}, "substrate": "(1.5,0.25)"}),
    ]
    assert len(set(given)) == 1
    assert len({material.digest for material in given}) == 1


def test_a_class_is_set_before_what_is_inside_of_it():
    name = "Exponential_Slope_Distribution_Function"
    material = mist.Material("Facet_BRDF_Model", {"sdf.s": 0.3, "sdf": name})
    assert material.sdf == name and material.sdf.s == 0.3


def test_arrays_are_tables_and_paths_are_files(tmp_path):
    rows = np.array([[0.4, 1.2, 3.0], [0.8, 1.4, 4.0]])
    material = mist.Material("Facet_BRDF_Model", substrate=rows, wavelength=0.6)
    other = mist.Material("Facet_BRDF_Model", substrate=1.3 + 3.5j, wavelength=0.6)
    close = dict(rtol=1e-12)
    np.testing.assert_allclose(material.mueller(1, 0.5), other.mueller(1, 0.5), **close)
    path = tmp_path / "gold.txt"
    path.write_text("0.4 1.2 3\n0.8 1.4 4\n")
    material = mist.Material("Facet_BRDF_Model", substrate=path, wavelength=0.6)
    path.unlink()
    again = pickle.loads(pickle.dumps(material))
    assert again == material and again.digest == material.digest
    np.testing.assert_array_equal(again.mueller(1, 0.5), material.mueller(1, 0.5))


def test_a_function_of_the_wavelength_is_called_where_it_is_needed():
    def index(wavelength):
        return 1.4 + 0.01 / wavelength**2

    material = mist.Material("Facet_BRDF_Model", substrate=index, wavelength=0.5)
    waves = np.array([0.4, 0.5, 0.7, 0.4])
    expected = [
        mist.Material("Facet_BRDF_Model", substrate=index(w), wavelength=w).mueller(0.6, 0.5)
        for w in waves
    ]
    np.testing.assert_array_equal(material.mueller(0.6, 0.5, wavelength=waves), expected)
    np.testing.assert_array_equal(material.at(0.7).mueller(0.6, 0.5), expected[2])


def test_replace_begins_a_new_object_where_it_names_a_class(gold):
    assert gold.replace({"sdf.s": 0.2}).sdf.s == 0.2
    assert gold.replace(wavelength=0.5).sdf.s == 0.1
    fresh = gold.replace(sdf="Exponential_Slope_Distribution_Function")
    described = mist.models.class_named("Exponential_Slope_Distribution_Function")
    assert fresh.sdf.s == float(described["parameters"][0]["default"])
    assert fresh.substrate == gold.substrate
    assert gold.replace() == gold


def test_materials_are_equal_by_content_and_survive_pickle_copy_and_json(gold):
    for again in (
        pickle.loads(pickle.dumps(gold)),
        copy.copy(gold),
        copy.deepcopy(gold),
        mist.Material.from_json(gold.to_json()),
        gold.at(0.6),
    ):
        assert again == gold and hash(again) == hash(gold) and again.digest == gold.digest
        np.testing.assert_array_equal(again.mueller(1.0, 0.9), gold.mueller(1.0, 0.9))
    assert gold.at(0.5) != gold
    assert mist.Material("Facet_BRDF_Model", compat=True) != mist.Material("Facet_BRDF_Model")


def test_every_class_has_a_callable_with_its_parameters():
    for name, described in mist.models.registry().items():
        make = getattr(mist.models, name)
        assert described["summary"] in make.__doc__
        if described["base"] == "BRDF_Model":
            material = make()
            assert pickle.loads(pickle.dumps(material)) == material
        else:
            assert make().model == name


def test_errors_have_codes_parts_and_help():
    with pytest.raises(mist.ParameterError) as caught:
        mist.Material("Facet_BRDF_Modell")
    assert caught.value.code == "model/unknown" and "Facet_BRDF_Model" in caught.value.help
    with pytest.raises(mist.ParameterError) as caught:
        mist.Material("Facet_BRDF_Model", substrat=1.5)
    assert (caught.value.code, caught.value.part) == ("model/unknown-parameter", "substrat")
    assert "substrate" in str(caught.value)
    with pytest.raises(ValueError) as caught:
        mist.Material("Facet_BRDF_Model", substrate=-1.5).check()
    assert caught.value.part == "substrate"
    with pytest.raises(mist.ParameterError):
        mist.Material("Facet_BRDF_Model", substrate="missing.txt")
    with pytest.raises(mist.ParameterError):
        mist.Material("Facet_BRDF_Model", substrate=object())
    error = pickle.loads(pickle.dumps(caught.value))
    assert error.part == "substrate" and str(error) == str(caught.value)


def test_degrees_and_nanometres_are_warned_of_once():
    material = mist.Material("Lambertian_BRDF_Model")
    with warnings.catch_warnings(record=True) as met:
        warnings.simplefilter("always")
        material.mueller(0.1, 60.0)
        material.mueller(0.1, 60.0)
        material.mueller(0.1, 0.2, wavelength=550.0)
    assert [warning.message.code for warning in met] == ["angle/degrees", "wavelength/nanometres"]
    assert met[0].filename == __file__


def test_jones_matrices_give_the_mueller_matrices_and_depolarizing_models_have_none():
    material = mist.Material("Microroughness_BRDF_Model", wavelength=0.6)
    # Stokes vectors of the products E_i E_k*, with V = 2 Im(E_s* E_p).
    stokes = np.array([[1, 0, 0, 1], [1, 0, 0, -1], [0, 1, 1, 0], [0, 1j, -1j, 0]])
    for basis in ("psps", "xyxy", "plane"):
        j = material.jones(50 * deg, [0.2, 0.9], [0.3, 2.0], basis=basis)
        products = np.einsum("...ij,...kl->...ikjl", j, j.conj()).reshape(2, 4, 4)
        m = stokes @ products @ np.linalg.inv(stokes)
        expected = material.mueller(50 * deg, [0.2, 0.9], [0.3, 2.0], basis=basis)
        np.testing.assert_allclose(m, expected, rtol=0, atol=1e-14 * abs(expected).max())
    assert material.jones(2.0, 0.1).tolist() == [[0, 0], [0, 0]]
    with pytest.raises(mist.NotCoherent):
        mist.Material("Lambertian_BRDF_Model").jones(0.1, 0.2)
