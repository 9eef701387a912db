"""Arrays: broadcasting, order, threads, forks, signals."""

import multiprocessing
import os
import signal
import subprocess
import sys
import textwrap
import threading
import time

import numpy as np
import pytest

import mist

MODELS = [
    "Lambertian_BRDF_Model",
    "Facet_BRDF_Model",
    "Microroughness_BRDF_Model",
    "Correlated_Roughness_Stack_BRDF_Model",
    "Diffuse_Subsurface_BRDF_Model",
    "Rayleigh_Defect_BRDF_Model",
    "Two_Source_BRDF_Model",
]


def grid():
    rng = np.random.default_rng(1)
    theta_i = rng.choice([0.1, 0.7, 1.2], (40, 1))
    rotation = rng.choice([0.0, 0.4], (1, 30))
    wave = rng.choice([0.45, 0.6], (40, 30))
    return theta_i, rng.uniform(0, 1.5, (40, 30)), rng.uniform(0, 6, 30), rotation, wave


@pytest.mark.parametrize("name", MODELS)
def test_order_batches_and_threads_do_not_change_a_bit(name):
    material = mist.Material(name)
    arguments = grid()
    expected = material.mueller(*arguments)
    assert expected.shape == (40, 30, 4, 4) and expected.flags.c_contiguous
    for threads in (1, 2, 7):
        mist.set_threads(threads)
        np.testing.assert_array_equal(material.mueller(*arguments), expected)
    mist.set_threads(None)
    flat = [np.ascontiguousarray(x).ravel() for x in np.broadcast_arrays(*arguments)]
    order = np.random.default_rng(2).permutation(flat[0].size)
    shuffled = material.mueller(*(x[order] for x in flat))
    np.testing.assert_array_equal(shuffled, expected.reshape(-1, 4, 4)[order])
    sevens = [material.mueller(*(x[k : k + 7] for x in flat)) for k in range(0, 1200, 7)]
    np.testing.assert_array_equal(np.concatenate(sevens), expected.reshape(-1, 4, 4))
    for k in (0, 17, 1199):
        single = material.mueller(*(float(x[k]) for x in flat))
        np.testing.assert_array_equal(single, expected.reshape(-1, 4, 4)[k])


def test_shapes_are_those_of_numpy():
    material = mist.Material("Lambertian_BRDF_Model")
    assert material.mueller(0.1, 0.2).shape == (4, 4)
    assert material.mueller([0.1], 0.2).shape == (1, 4, 4)
    assert material.mueller(np.zeros((3, 1)), np.zeros(0)).shape == (3, 0, 4, 4)
    assert material.mueller(np.zeros((3, 1), np.float32), [0, 1]).shape == (3, 2, 4, 4)
    assert isinstance(material.brdf(0.1, 0.2), float)
    with pytest.raises(ValueError, match="shapes"):
        material.mueller([0.1, 0.2], [0.1, 0.2, 0.3])
    with pytest.raises(ValueError, match="psps"):
        material.mueller(0.1, 0.2, basis="PSPS")
    with pytest.raises((ValueError, TypeError)):
        material.mueller("x", 0.2)


def test_nan_gives_nan_and_the_horizon_zero():
    material = mist.Material("Facet_BRDF_Model")
    got = material.mueller(0.3, [0.2, np.nan, np.pi / 2, 1.7])
    assert np.isfinite(got[0]).all() and np.isnan(got[1]).all() and not got[2:].any()
    assert np.isnan(material.mueller(np.nan, [0.1, 0.2])).all()
    assert np.isnan(material.mueller(0.1, 0.2, wavelength=[0.5, np.nan])[1]).all()
    assert not material.mueller([0.1, 1.8], 0.2)[1].any()


def test_results_go_into_an_array_that_is_given():
    material = mist.Material("Facet_BRDF_Model")
    theta = np.linspace(0, 1.5, 50)
    out = np.empty((50, 4, 4))
    assert material.mueller(0.3, theta, out=out) is out
    np.testing.assert_array_equal(out, material.mueller(0.3, theta))
    with pytest.raises(ValueError):
        material.mueller(0.3, theta, out=np.empty((49, 4, 4)))


def test_brdf_is_the_contracted_matrix():
    material = mist.Material("Facet_BRDF_Model")
    theta = np.linspace(0, 1.5, 50)
    m = material.mueller(0.3, theta, 0.2)
    expected = np.einsum("i,nij,j->n", [0.5, -0.5, 0, 0], m, [1, 1, 0, 0])
    got = material.brdf(0.3, theta, 0.2, incident="s", sensitivity="p")
    np.testing.assert_allclose(got, expected, rtol=0, atol=1e-15 * m.max())


def _digest(material):
    return material.mueller(0.3, np.linspace(0, 1.5, 20_000)).tobytes()


def test_forked_and_spawned_processes_give_the_same_bits():
    material = mist.Material("Facet_BRDF_Model", substrate=1.5 + 0.1j)
    expected = _digest(material)
    for method in ("fork", "spawn"):
        with multiprocessing.get_context(method).Pool(1) as pool:
            assert pool.apply_async(_digest, (material,)).get(60) == expected


def test_the_lock_is_released():
    material = mist.Material("Facet_BRDF_Model")
    theta = np.linspace(0, 1.5, 3_000_000)
    ticks, stop = 0, threading.Event()

    def count():
        nonlocal ticks
        while not stop.is_set():
            ticks += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    started = time.perf_counter()
    while time.perf_counter() - started < 1.0:
        material.brdf(0.3, theta, 0.2)
    stop.set()
    thread.join()
    assert ticks >= 200


@pytest.mark.skipif(not hasattr(signal, "SIGINT") or os.name != "posix", reason="posix signals")
def test_control_c_ends_an_evaluation_within_a_fifth_of_a_second():
    code = """
        import time, sys, numpy as np, mist, warnings
        warnings.simplefilter("ignore")
        material = mist.Material("Bobbert_Vlieger_BRDF_Model")
        theta = np.linspace(0, 1.5, 20_000_000)
        material.brdf(0.3, theta[:1000])
        print("begins", flush=True)
        try:
            material.brdf(0.3, theta)
        except KeyboardInterrupt:
            print("ended", time.time(), flush=True)
    """
    process = subprocess.Popen(
        [sys.executable, "-c", textwrap.dedent(code)], stdout=subprocess.PIPE, text=True
    )
    assert process.stdout.readline().strip() == "begins"
    time.sleep(1)
    sent = time.time()
    process.send_signal(signal.SIGINT)
    word, ended = process.stdout.readline().split()
    assert word == "ended" and float(ended) - sent < 0.2
    process.wait()
