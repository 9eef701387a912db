"""Ray: the digest of one process, also with a killed worker, in a network of its own."""

import shutil
import subprocess
import sys
import textwrap

import pytest

SCRIPT = """
import os, signal
import mist
gold = mist.Material("Facet_BRDF_Model", substrate=0.25 + 3.1j)
over = {"sdf.s": [0.1 + k / 1000 for k in range(40)], "theta_i": [0.1, 0.2]}
import ray
ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False)
killed = []

@ray.remote
def own_pid():
    return os.getpid()

def kill(_):
    if not killed:
        killed.append(ray.get(own_pid.remote()))
        os.kill(killed[0], signal.SIGKILL)

found = mist.sweep(gold, over, engine="ray", chunk=5, progress=kill, retries=5)
assert killed
assert found.digest == mist.sweep(gold, over).digest
print("same", flush=True)
os._exit(0)
"""


def namespace() -> list[str] | None:
    """A command that runs others in a network with the loopback device alone."""
    if not shutil.which("unshare") or not shutil.which("ip"):
        return None
    command = ["unshare", "-rn", "sh", "-c", 'ip link set lo up && exec "$@"', "sh"]
    works = subprocess.run([*command, "true"], capture_output=True, check=False)
    return command if works.returncode == 0 else None


def test_ray_computes_the_same_with_a_killed_worker(tmp_path):
    pytest.importorskip("ray")
    command = namespace()
    if command is None:
        pytest.skip("no network namespace can be made here")
    script = tmp_path / "sweep.py"
    script.write_text(textwrap.dedent(SCRIPT))
    done = subprocess.run(
        [*command, "env", "RAY_USAGE_STATS_ENABLED=0", sys.executable, str(script)],
        capture_output=True,
        text=True,
        timeout=240,
        check=False,
    )
    assert "same" in done.stdout, done.stdout + done.stderr
