"""The BSDF of examples/mitsuba: more wavelengths than the built-in reader has, and the service."""

import json
import socket
import subprocess
import sys
import tempfile
import time
import urllib.request
from pathlib import Path

import numpy as np
import mitsuba as mi

from polarized import METAL, evaluated, predicted
from frames import directions

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "examples" / "mitsuba"))


def at_nodes(mist, bsdf, what, report):
    rng = np.random.default_rng(4)
    pairs = []
    while len(pairs) < 40:
        l, v = directions(np.radians(-180 + 20 * rng.integers(0, 19)),
                          np.radians(10 * rng.integers(1, 8)),
                          (rng.integers(3, 9) / 11) ** 2 * np.pi / 2)
        if min(l[2], v[2]) > 0.05:
            pairs.append((l, v))
    errors = []
    for (l, v), plane in zip(pairs, mist.plane(METAL, pairs, 620)):
        wanted = predicted(plane, l, v)
        errors.append(np.abs(evaluated(bsdf, l, v, 620) - wanted).max() / np.abs(wanted).max())
    # Positions between coarse nodes are computed in 32 bits, which adds a little of a bright neighbour.
    report(f"plugin, {what}, eval at nodes, 90 %", np.quantile(errors, 0.9), 3e-5)


class Service:
    """`mist serve` on a free port."""

    def __init__(self, mist):
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            port = probe.getsockname()[1]
        self.url = f"http://127.0.0.1:{port}"
        self.process = subprocess.Popen([mist.binary, "serve", "--listen", f"127.0.0.1:{port}"],
                                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        for _ in range(100):
            try:
                urllib.request.urlopen(f"{self.url}/healthz").close()
                return
            except OSError:
                time.sleep(0.1)
        raise SystemExit("mist serve does not answer")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait(10)

    def put(self, name, material):
        request = urllib.request.Request(f"{self.url}/v1/materials/{name}", method="PUT",
                                         data=json.dumps(material).encode(),
                                         headers={"content-type": "application/json"})
        urllib.request.urlopen(request).close()


def check(mist, report):
    mi.set_variant("scalar_spectral_polarized")
    import mist_bsdf

    words = ["--plugin", "--lambda", "400:20:700", "--grid", "19x10x12"]
    path, _ = mist.export(METAL, "metal16.pbsdf", *words)
    bsdf = mi.load_dict({"type": "mist", "filename": path, "alpha": 0.35})
    at_nodes(mist, bsdf, "16 wavelengths from a file", report)

    with Service(mist) as service, tempfile.TemporaryDirectory() as cache:
        service.put("metal", METAL)
        url = (f"{service.url}/v1/materials/metal/table.pbsdf"
               "?plugin=1&lambda=400:20:700&grid=19x10x12")
        first = mist_bsdf.fetch(url, cache)
        again = mist_bsdf.fetch(url, cache)
        report("plugin, bytes that differ when the service says they are the same",
               int(first != again), 0)
        fields = mist_bsdf.read_tensors(first)
        own = mist_bsdf.read_tensors(Path(path).read_bytes())
        report("plugin, numbers that differ between service and file",
               int((fields["M"] != own["M"]).sum()), 0)
