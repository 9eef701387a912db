"""Sweeps: one digest on every engine, resume, damaged and foreign parts, shards."""

import os
import signal
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

import mist

GOLD = mist.Material("Facet_BRDF_Model", substrate=0.25 + 3.1j, wavelength=0.6)
OVER = {
    "sdf.s": [0.1, 0.2, 0.3],
    "wavelength": [0.5, 0.6],
    "angles": mist.paired(theta_i=[0.1, 0.2, 0.3, 0.4], theta_s=[0.2, 0.2, 0.1, 0.0]),
}
PROGRAM = """
MODEL = Facet_BRDF_Model
VARIABLES:
  s = 0.1  theta = 0
  incidentangle = theta  incidentpol = (1,0,0,0)  rotation = 0
  #sdf.s = s
END
VARY: FOR theta FROM 0 TO 1 BY 0.5 END
INTEGRALS: f = DIFFERENTIAL CENTER = (0.2,0) END END
OUTPUTS: 1 f END
FILES: END
"""


def test_values_are_those_of_single_evaluations():
    found = mist.sweep(GOLD, OVER)
    assert found.values.shape == (3, 2, 4, 4, 4)
    wanted = GOLD.replace({"sdf.s": 0.2}).at(0.6).mueller(0.3, 0.1)
    np.testing.assert_array_equal(found.values[1, 1, 2], wanted)


def test_programs_run_with_other_values():
    found = mist.sweep(PROGRAM, {"s": [0.1, 0.2]})
    assert found.values.shape == (2, 3, 1)
    wanted = mist.run(PROGRAM, values={"s": 0.2})["f"]
    np.testing.assert_array_equal(found.values[1, :, 0], wanted)


def test_chunks_engines_and_files_do_not_change_the_digest(tmp_path):
    pytest.importorskip("pyarrow")
    pytest.importorskip("zarr")
    digests = {mist.sweep(GOLD, OVER).digest}
    digests.add(mist.sweep(GOLD, OVER, chunk=5).digest)
    digests.add(mist.sweep(GOLD, OVER, engine=2, chunk=5).digest)
    with ThreadPoolExecutor(2) as executor:
        digests.add(mist.sweep(GOLD, OVER, engine=executor, chunk=7).digest)
    for name in ("x.parquet", "x.zarr"):
        digests.add(mist.sweep(GOLD, OVER, out=str(tmp_path / name), chunk=5).digest)
    assert len(digests) == 1
    assert len(digests.pop()) == 64


def test_another_value_is_another_digest():
    other = {**OVER, "wavelength": [0.5, np.nextafter(0.6, 1)]}
    assert mist.sweep(GOLD, OVER).digest != mist.sweep(GOLD, other).digest


@pytest.mark.parametrize("name", ["x.parquet", "x.zarr"])
def test_only_missing_chunks_are_computed(tmp_path, name, monkeypatch):
    pytest.importorskip("pyarrow" if name.endswith("parquet") else "zarr")
    out = str(tmp_path / name)
    first = mist.sweep(GOLD, OVER, out=out, chunk=6)
    counted = []
    from mist.sweeps import engines

    compute = engines.compute
    monkeypatch.setattr(engines, "compute", lambda *a: counted.append(a[1:3]) or compute(*a))
    assert mist.sweep(GOLD, OVER, out=out, chunk=6).digest == first.digest
    assert counted == []
    if name.endswith("parquet"):
        part = sorted(Path(out).glob("part-*.parquet"))[1]
        part.write_bytes(part.read_bytes()[:-100])
        assert mist.sweep(GOLD, OVER, out=out, chunk=6).digest == first.digest
        assert counted == [(6, 12)]
    with pytest.raises(mist.MistError, match="another sweep"):
        mist.sweep(GOLD, {"wavelength": [0.5]}, out=out)


def test_a_killed_driver_leaves_its_finished_chunks(tmp_path):
    pytest.importorskip("pyarrow")
    out = tmp_path / "x.parquet"
    code = f"""
import os, signal, mist
gold = mist.Material("Facet_BRDF_Model", substrate=0.25 + 3.1j)
def progress(part):
    if part > 0.4:
        os.kill(os.getpid(), signal.SIGKILL)
mist.sweep(gold, {{"sdf.s": [0.1 + k / 100 for k in range(10)]}}, out={str(out)!r}, chunk=1,
           progress=progress)
"""
    done = subprocess.run([sys.executable, "-c", code], check=False)
    assert done.returncode == -signal.SIGKILL
    assert 1 <= len(list(out.glob("part-*.parquet"))) < 10
    over = {"sdf.s": [0.1 + k / 100 for k in range(10)]}
    gold = mist.Material("Facet_BRDF_Model", substrate=0.25 + 3.1j)
    assert mist.sweep(gold, over, out=str(out), chunk=1).digest == mist.sweep(gold, over).digest


def test_an_error_has_the_index_of_its_point():
    with pytest.raises(mist.MistError, match="point 1"):
        mist.sweep(GOLD, {"sdf.s": [0.1, -1.0], "theta_i": [0.1]}, chunk=1)


def test_dask_computes_the_same_with_a_killed_worker():
    distributed = pytest.importorskip("distributed")
    over = {"sdf.s": [0.1 + k / 1000 for k in range(300)], "theta_i": [0.1, 0.2]}
    cluster = distributed.LocalCluster(
        n_workers=2,
        threads_per_worker=1,
        host="127.0.0.1",
        dashboard_address=None,
        silence_logs=50,
    )
    with cluster, distributed.Client(cluster) as client:
        killed = []

        def kill(_):
            if not killed:
                pids = client.run(os.getpid)
                killed.append(next(iter(pids.values())))
                os.kill(killed[0], signal.SIGKILL)

        found = mist.sweep(GOLD, over, engine=client, chunk=20, progress=kill, retries=5)
    assert killed
    assert found.digest == mist.sweep(GOLD, over).digest


def test_results_have_the_forms_of_other_packages():
    pytest.importorskip("xarray")
    pytest.importorskip("pandas")
    found = mist.sweep(PROGRAM, {"s": [0.1, 0.2]})
    array = found.to_xarray()
    assert array.dims == ("s", "step", "output") and array.attrs["mist_digest"] == found.digest
    frame = found.to_pandas()
    assert list(frame.columns) == ["s", "f"] and len(frame) == 6


def test_shards_are_read_as_one_table(tmp_path):
    binary = os.environ.get("MIST_BIN")
    if not binary:
        with pytest.raises(mist.MistError, match="no file fits"):
            mist.read_shards(str(tmp_path / "a.*-of-2"))
        return
    (tmp_path / "a.mist").write_text(PROGRAM)
    for number in (1, 2):
        command = [binary, "run", "--shard", f"{number}/2", "a.mist"]
        subprocess.run(command, cwd=tmp_path, check=True, capture_output=True)
    table = mist.read_shards(str(tmp_path / "a.*-of-2"))
    np.testing.assert_allclose(table["f"], mist.run(PROGRAM)["f"], rtol=1e-5)
    assert table["theta"].tolist() == [0, 0.5, 1]
