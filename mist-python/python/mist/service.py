"""Tables of mist and its service, from Python.

Needs the standard library; arrays are numpy's where numpy is installed, lists elsewhere.

    import mist_client

    service = mist_client.Service("http://127.0.0.1:8650")
    service.put("gold", {"model": "Facet_BRDF_Model", "parameters": {"substrate": "(0.4,2.5)"}})
    table = service.table("gold", thetai="0:15:75", thetas="0:15:75", phis="0:30:180", stokes=1)
    table.lookup(45, 44.5, 0)                 # {"R": …, "G": …, "B": …, "I": …, …}
    table.lookup(45, 44.5, 0, filter=30)      # behind a polarizer at 30° from s

    wi, wo = [0, 0, 1], [0.6, 0, 0.8]
    service.evaluate("gold", [wi + wo], out="rgb", lambda_="400:10:700")
    service.spectra("gold", thetai="45", thetas="0:15:75", phis="0", lambda_="400:50:700")
    service.export("gold", "table.bsdf", grid="8x16", lambda_="400:100:700")

    with open("white.mist") as file:
        job = service.submit(file.read())
    job.wait()
    print(job.results())

A table that takes long is promised (202); the client asks again until it is there.

Angles are degrees in tables and queries; directions are unit vectors in the local shading frame
(z is the normal, x the fiducial axis), both away from the surface.
"""

import array
import bisect
import hashlib
import json
import math
import sys
import time
import urllib.error
import urllib.parse
import urllib.request

try:
    import numpy
except ImportError:
    numpy = None

ANGLES = ("thetai", "thetas", "phis")
#: Degrees by which a direction may miss the end of an axis, for rounding.
EDGE = 1e-9
#: Columns that are not values in a direction.
PLACES = ANGLES + ("omega", "flags")


class Refused(Exception):
    """The service refused: `status`, and `problem`, the body of application/problem+json."""

    def __init__(self, status, problem):
        self.status = status
        self.problem = problem
        super().__init__(f"{status}: {problem.get('message') or problem}")


class Table:
    """A table `MIST-TABLE 1`: `header` (key to words), `columns`, `rows`."""

    def __init__(self, header, columns, rows):
        self.header = header
        self.columns = columns
        self.rows = rows if numpy is None else numpy.array(rows)
        self.axes = {words[0]: [float(w) for w in words[2:]] for words in header.get("axis", [])}
        self._at = {name: index for index, name in enumerate(columns)}

    @classmethod
    def read(cls, path):
        """Reads a file; ValueError if it is truncated or was changed."""
        with open(path, encoding="utf-8", newline="") as file:
            return cls.parse(file.read())

    @classmethod
    def parse(cls, text):
        """Reads a text; ValueError if it is truncated or was changed."""
        lines = text.splitlines(keepends=True)
        if not lines or lines[0].strip() != "# MIST-TABLE 1":
            raise ValueError("the first line is not '# MIST-TABLE 1'")
        body = [line for line in lines if not line.startswith("#")]
        checksum = hashlib.sha256("".join(body).encode()).hexdigest()[:16]
        words = [line[1:].split() for line in lines if line.startswith("#")]
        if words[-1] != ["end", str(len(body)), checksum]:
            raise ValueError("the table is cut off or was changed")
        header = {}
        for key, *values in words[1:-1]:
            header.setdefault(key, []).append(values)
        columns = header["columns"][0]
        rows = [[float(word) for word in line.split()] for line in body]
        return cls(header, columns, rows)

    def column(self, name):
        """All values of a column."""
        at = self._at[name]
        return [row[at] for row in self.rows] if numpy is None else self.rows[:, at]

    def lookup(self, thetai, thetas, phis, filter=None):
        """Values in a direction (degrees), linear between the nodes of a grid.

        With `filter` only R, G, B and I: behind a linear polarizer at that angle (degrees) from s.
        ValueError outside of the grid, and with `filter` if the table has no Stokes components.
        """
        if set(self.axes) != set(ANGLES):
            raise ValueError("this table is a list, not a grid: look at its rows")
        if filter is not None and not all(c + s in self._at for c in "RGBI" for s in "QU"):
            raise ValueError("the table has no Stokes components: ask for it with stokes=1")
        phis = (phis + 180.0) % 360.0 - 180.0
        mirrored = self.header["symmetry"][0][0] == "mirror" and phis < 0
        phis = -phis if mirrored else phis
        low, high = self.axes["phis"][0], self.axes["phis"][-1]
        if phis < low - EDGE:
            phis += 360.0
        if phis > high + EDGE:
            phis -= 360.0
        values = self._between(thetai, thetas, phis)
        if mirrored:
            # U and V change their signs under reflection at the plane of incidence.
            values = {n: -v if n[-1] in "UV" else v for n, v in values.items()}
        return values if filter is None else filtered(values, filter)

    def _between(self, *angles):
        corners = [(0, 1.0)]
        for name, angle in zip(ANGLES, angles):
            nodes = self.axes[name]
            if not nodes[0] - EDGE <= angle <= nodes[-1] + EDGE:
                raise ValueError(f"{name} {angle} is outside of the grid, {nodes[0]} to {nodes[-1]}")
            low, part = _cell(nodes, angle)
            high = min(low + 1, len(nodes) - 1)
            corners = [
                (index * len(nodes) + node, weight * share)
                for index, weight in corners
                for node, share in ((low, 1.0 - part), (high, part))
            ]
        names = [name for name in self.columns if name not in PLACES]
        return {n: sum(w * float(self.rows[i][self._at[n]]) for i, w in corners) for n in names}


def filtered(values, angle):
    """R, G, B and I behind a linear polarizer at `angle` degrees from s."""
    cos, sin = math.cos(math.radians(2 * angle)), math.sin(math.radians(2 * angle))
    return {
        name: 0.5 * (values[name] + cos * values[name + "Q"] + sin * values[name + "U"])
        for name in "RGBI"
    }


def _cell(nodes, angle):
    """The node at or below `angle`, and the position between it and the next, limited to the ends."""
    low = min(max(bisect.bisect_right(nodes, angle) - 1, 0), max(len(nodes) - 2, 0))
    if len(nodes) == 1:
        return 0, 0.0
    part = (angle - nodes[low]) / (nodes[low + 1] - nodes[low])
    return low, min(max(part, 0.0), 1.0)


class Service:
    """The HTTP service at `url`; `key` is a bearer key if the service requires one."""

    def __init__(self, url, key=None, timeout=600):
        self.url = url.rstrip("/")
        self.key = key
        self.timeout = timeout
        self._known = {}

    def put(self, name, material):
        """Stores a material: material JSON, or {"program": text, "files": {name: text}}; its hash."""
        body = json.dumps(material).encode()
        path = f"/v1/materials/{urllib.parse.quote(name)}"
        return json.loads(self._ask("PUT", path, body)[0])["hash"]

    def table(self, name, **query):
        """A colour table; a repeated request transfers it only if it has changed."""
        path = f"/v1/materials/{urllib.parse.quote(name)}/table.mtab{_query(query)}"
        tag, known = self._known.get(path, (None, None))
        body, headers = self._ask("GET", path, tag=tag)
        if body is None:
            return known
        table = Table.parse(body.decode())
        self._known[path] = (headers.get("ETag"), table)
        return table

    def spectra(self, name, **query):
        """A table of spectra, a column per wavelength (`component` 0 to 3 for I, Q, U, V)."""
        return Table.parse(self.export(name, "table.mspd", **query).decode())

    def export(self, name, file, **query):
        """The bytes of `table.pbsdf`, `.bsdf`, `.xompt`, `.astm`, `.csv`, `.xml`, `.svg`, …"""
        path = f"/v1/materials/{urllib.parse.quote(name)}/{file}{_query(query)}"
        return self._ask("GET", path)[0]

    def delete(self, name):
        """Deletes a material."""
        self._ask("DELETE", f"/v1/materials/{urllib.parse.quote(name)}")

    def integrate(self, name, rows, **query):
        """A table of solid angles: rows `thetai thetas phis circle 2`, degrees."""
        path = f"/v1/materials/{urllib.parse.quote(name)}/integrate{_query(query)}"
        return Table.parse(self._ask("POST", path, "\n".join(rows).encode(), "application/x-mist")[0].decode())

    def evaluate(self, name, directions, **query):
        """Rows of [wi.x, wi.y, wi.z, wo.x, wo.y, wo.z] in, rows of 32-bit numbers out."""
        flat = array.array("f", [number for row in directions for number in row])
        if sys.byteorder == "big":
            flat.byteswap()
        path = f"/v1/materials/{urllib.parse.quote(name)}/evaluate{_query(query)}"
        body = self._ask("POST", path, flat.tobytes(), "application/octet-stream")[0]
        answer = array.array("f", body)
        if sys.byteorder == "big":
            answer.byteswap()
        width = len(answer) // max(len(directions), 1)
        rows = [answer[at : at + width].tolist() for at in range(0, len(answer), width or 1)]
        return rows if numpy is None else numpy.array(rows, dtype="float32")

    def run(self, program, files=None, compat=False):
        """Runs a program with its data files; the text of its results."""
        body = json.dumps({"program": program, "files": files or {}, "compat": compat}).encode()
        return self._ask("POST", "/v1/run", body)[0].decode()

    def submit(self, program, files=None, compat=False, name=None, seed=1):
        """Runs a program in the background; its `Job`."""
        request = {"program": program, "files": files or {}, "compat": compat, "seed": seed}
        if name:
            request["job"] = name
        accepted = self._ask("POST", "/v1/jobs", json.dumps(request).encode())[0]
        return Job(self, json.loads(accepted)["id"])

    def jobs(self):
        """The status of every stored job."""
        return json.loads(self._ask("GET", "/v1/jobs")[0])

    def _ask(self, method, path, body=None, kind="application/json", tag=None):
        end = time.monotonic() + self.timeout
        while True:
            content, headers, status = self._ask_once(method, path, body, kind, tag)
            again = headers.get("Retry-After") if status == 202 else None
            if again is None:
                return content, headers
            if time.monotonic() + float(again) > end:
                raise TimeoutError(f"{path} was not ready within {self.timeout} s")
            time.sleep(float(again))

    def _ask_once(self, method, path, body, kind, tag):
        request = urllib.request.Request(self.url + path, data=body, method=method)
        if body is not None:
            request.add_header("Content-Type", kind)
        if tag:
            request.add_header("If-None-Match", tag)
        if self.key:
            request.add_header("Authorization", f"Bearer {self.key}")
        try:
            with urllib.request.urlopen(request, timeout=self.timeout) as answer:
                return answer.read(), answer.headers, answer.status
        except urllib.error.HTTPError as error:
            if error.code == 304:
                return None, error.headers, 304
            raise Refused(error.code, _problem(error.read())) from None


class Job:
    """A program that runs in the background."""

    def __init__(self, service, id):
        self.service = service
        self.id = id

    def status(self):
        """`state` (queued, running, done, failed, cancelled), `progress`, and more."""
        return json.loads(self._get(""))

    def wait(self, timeout=86400.0):
        """Waits until the job has ended; its status. TimeoutError after `timeout` seconds."""
        end, pause = time.monotonic() + timeout, 0.05
        while True:
            status = self.status()
            if status["state"] not in ("queued", "running"):
                return status
            if time.monotonic() + pause > end:
                raise TimeoutError(f"the job {self.id} is {status['state']}")
            time.sleep(pause)
            pause = min(2 * pause, 2.0)

    def results(self):
        """The table as the program writes it; `Refused` unless the job is done."""
        return self._get("/results")

    def listing(self):
        """The listing."""
        return self._get("/listing")

    def samples(self):
        """The samples, if the program asks for them."""
        return self._get("/samples")

    def table(self):
        """The colour table, if the program has a section COLOR."""
        return Table.parse(self._get("/table"))

    def delete(self):
        """Cancels the job, or deletes it if it has ended."""
        self.service._ask("DELETE", f"/v1/jobs/{self.id}")

    def _get(self, what):
        return self.service._ask("GET", f"/v1/jobs/{self.id}{what}")[0].decode()


def _problem(body):
    try:
        return json.loads(body)
    except ValueError:
        return {"message": body.decode(errors="replace")}


def _query(query):
    """`lambda` is a keyword of Python; `lambda_` replaces it."""
    pairs = {name.rstrip("_"): value for name, value in query.items()}
    return "?" + urllib.parse.urlencode(pairs) if pairs else ""
