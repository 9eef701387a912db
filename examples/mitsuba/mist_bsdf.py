"""A BSDF for Mitsuba 3 that reads tables of `mist export --plugin`: any number of wavelengths.

    import mitsuba as mi
    mi.set_variant("llvm_ad_spectral_polarized")       # or scalar_spectral_polarized: slow
    import mist_bsdf                                    # registers the BSDF `mist`
    bsdf = mi.load_dict({"type": "mist", "filename": "gold31.pbsdf", "alpha": 0.2})

In the place of `filename` stands `url`, a table of `mist serve`; it is kept in a cache and asked for
again by its ETag, so that it is computed and sent once. `alpha` is the roughness of the GGX lobe
from which directions are sampled; it changes the noise and nothing else. The table holds Mueller
matrices in 1/sr without a cosine, in the frame of docs/formats/pbsdf.md.
"""

import hashlib
import json
import os
import struct
import time
import urllib.error
import urllib.parse
import urllib.request
from pathlib import Path

import drjit as dr
import mitsuba as mi
import numpy as np

KINDS = {1: "u1", 2: "i1", 3: "<u2", 4: "<i2", 5: "<u4", 6: "<i4", 7: "<u8", 8: "<i8",
         9: "<f2", 10: "<f4", 11: "<f8"}
# Fraction of the directions that are sampled from the lobe; the others are cosine-weighted.
LOBE = 0.9


def read_tensors(data):
    """The fields of a tensor file, by name."""
    if data[:12] != b"tensor_file\0" or data[12] != 1:
        raise ValueError("this is no tensor file of version 1")
    (count,) = struct.unpack_from("<I", data, 14)
    at, fields = 18, {}
    for _ in range(count):
        (length,) = struct.unpack_from("<H", data, at)
        name = data[at + 2:at + 2 + length].decode()
        at += 2 + length
        dimensions, kind, offset = struct.unpack_from("<HBQ", data, at)
        shape = struct.unpack_from(f"<{dimensions}Q", data, at + 11)
        at += 11 + 8 * dimensions
        numbers = int(np.prod(shape, dtype=np.int64))
        fields[name] = np.frombuffer(data, KINDS[kind], numbers, offset).reshape(shape)
    return fields


def cache_folder():
    base = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    folder = Path(base) / "mist"
    folder.mkdir(parents=True, exist_ok=True)
    return folder


def fetch(url, folder=None, patience=600.0):
    """The bytes behind `url`, from the cache if the service answers that they have not changed."""
    folder = Path(folder) if folder else cache_folder()
    stem = folder / hashlib.sha256(url.encode()).hexdigest()
    body, note = stem.with_suffix(".table"), stem.with_suffix(".json")
    headers = {}
    if body.exists() and note.exists():
        headers["If-None-Match"] = json.loads(note.read_text())["etag"]
    end, ask = time.monotonic() + patience, url
    while True:
        try:
            with urllib.request.urlopen(urllib.request.Request(ask, headers=headers)) as answer:
                if answer.status == 202 and time.monotonic() < end:
                    ask = urllib.parse.urljoin(url, answer.headers.get("Location", url))
                    time.sleep(float(answer.headers.get("Retry-After", 1)))
                    continue
                if answer.status != 200:
                    raise RuntimeError(f"{url}: answered {answer.status}")
                data, tag = answer.read(), answer.headers.get("ETag")
        except urllib.error.HTTPError as error:
            if error.code == 304:
                return body.read_bytes()
            raise RuntimeError(f"{url}: {error.code} {error.read().decode(errors='replace')}") from None
        if tag:
            partial = stem.with_suffix(f".{os.getpid()}.part")
            partial.write_bytes(data)
            partial.replace(body)
            note.write_text(json.dumps({"url": url, "etag": tag}))
        return data


class Axis:
    """Increasing nodes, and positions between them."""

    def __init__(self, nodes):
        self.nodes = np.ravel(nodes).astype(np.float32)
        self.count = len(self.nodes)
        self.shared = mi.Float(self.nodes) if dr.is_jit_v(mi.Float) else None

    def place(self, x):
        """The node below x and the position of x between it and the next, limited to the ends."""
        if self.count == 1:
            return mi.UInt32(0), mi.Float(0)
        if self.shared is None:
            low = int(np.clip(np.searchsorted(self.nodes, x, side="right") - 1, 0, self.count - 2))
            a, b = float(self.nodes[low]), float(self.nodes[low + 1])
        else:
            low = dr.binary_search(0, self.count,
                                   lambda k: dr.gather(mi.Float, self.shared, k) <= x)
            low = dr.clip(mi.Int32(low) - 1, 0, self.count - 2)
            low = mi.UInt32(low)
            a = dr.gather(mi.Float, self.shared, low)
            b = dr.gather(mi.Float, self.shared, low + 1)
        return low, dr.clip((x - a) / (b - a), 0, 1)


class MistBSDF(mi.BSDF):
    """Mueller matrices between the nodes of a table, in Mitsuba's frames."""

    def __init__(self, props):
        super().__init__(props)
        if mi.is_rgb:
            raise RuntimeError("the BSDF `mist` needs a spectral variant of Mitsuba")
        url, name = str(props.get("url", "")), str(props.get("filename", ""))
        if bool(url) == bool(name):
            raise RuntimeError("the BSDF `mist` takes either `filename` or `url`")
        fields = read_tensors(fetch(url) if url else Path(name).read_bytes())
        axes = [fields[name] for name in ("phi_d", "theta_d", "theta_h", "wvls")]
        self.axes = [Axis(nodes) for nodes in axes]
        table = fields["M"]
        if table.shape != (*[axis.count for axis in self.axes], 4, 4):
            raise RuntimeError(f"M has the shape {table.shape}, which is not that of the axes")
        self.table = np.ravel(table)
        self.shared = mi.Float(self.table) if dr.is_jit_v(mi.Float) else None
        self.alpha = float(props.get("alpha", 0.3))
        self.m_components = [mi.BSDFFlags.GlossyReflection | mi.BSDFFlags.FrontSide]
        self.m_flags = self.m_components[0]

    def fetched(self, index, active):
        if self.shared is None:
            return float(self.table[index])
        return dr.gather(mi.Float, self.shared, index, active)

    def table_matrix(self, l, v, wavelengths, active):
        """Four times four spectra: the matrix in the frame of the table."""
        h = dr.normalize(l + v)
        b = dr.normalize(dr.cross(mi.Vector3f(0, 0, 1), h))
        t = dr.cross(b, h)
        across = l - dr.dot(l, h) * h
        at = [dr.atan2(dr.dot(b, across), dr.dot(t, across)),
              dr.safe_acos(dr.dot(h, l)), dr.safe_acos(h.z)]
        places = [axis.place(x) for axis, x in zip(self.axes, at)]
        count = [axis.count for axis in self.axes]
        matrix = [[mi.UnpolarizedSpectrum(0) for _ in range(4)] for _ in range(4)]
        size = 4 if mi.is_polarized else 1
        for number in range(len(wavelengths)):
            waves = self.axes[3].place(wavelengths[number])
            for bits in range(16):
                index, weight = mi.UInt32(0), mi.Float(1)
                for axis, (low, part) in enumerate([*places, waves]):
                    upper = bits >> axis & 1
                    if upper and count[axis] == 1:
                        weight = mi.Float(0)
                        upper = 0
                    index = index * count[axis] + low + upper
                    weight = weight * (part if upper else 1 - part)
                for row in range(size):
                    for column in range(size):
                        value = self.fetched(index * 16 + 4 * row + column, active)
                        matrix[row][column][number] += weight * value
        return matrix

    def eval(self, ctx, si, wo, active=True):
        cos_i, cos_o = mi.Frame3f.cos_theta(si.wi), mi.Frame3f.cos_theta(wo)
        active = active & (cos_i > 0) & (cos_o > 0)
        towards_light = ctx.mode == mi.TransportMode.Radiance
        l, v = (wo, si.wi) if towards_light else (si.wi, wo)
        matrix = self.table_matrix(l, v, si.wavelengths, active)
        if not mi.is_polarized:
            return dr.select(active, matrix[0][0] * cos_o, 0)
        value = dr.zeros(mi.Spectrum)
        for row in range(4):
            for column in range(4):
                value[row, column] = matrix[row][column]
        x = dr.normalize(dr.cross(l, v))
        value = mi.mueller.rotate_mueller_basis(
            value, -l, x, mi.mueller.stokes_basis(-l), v, x, mi.mueller.stokes_basis(v))
        # Specular directions have no azimuth about the half vector, opposite rays no plane.
        known = active & (dr.squared_norm(dr.cross(l, v)) > 1e-12)
        return dr.select(known, value * cos_o, mi.Spectrum(0))

    def lobe(self):
        return mi.MicrofacetDistribution(mi.MicrofacetType.GGX, self.alpha, self.alpha, True)

    def pdf(self, ctx, si, wo, active=True):
        cos_i, cos_o = mi.Frame3f.cos_theta(si.wi), mi.Frame3f.cos_theta(wo)
        active = active & (cos_i > 0) & (cos_o > 0)
        m = dr.normalize(wo + si.wi)
        lobe = self.lobe().pdf(si.wi, m) / (4 * dr.dot(wo, m))
        diffuse = mi.warp.square_to_cosine_hemisphere_pdf(wo)
        return dr.select(active, LOBE * lobe + (1 - LOBE) * diffuse, 0)

    def eval_pdf(self, ctx, si, wo, active=True):
        return self.eval(ctx, si, wo, active), self.pdf(ctx, si, wo, active)

    def sample(self, ctx, si, sample1, sample2, active=True):
        m, _ = self.lobe().sample(si.wi, sample2)
        mirrored = 2 * dr.dot(si.wi, m) * m - si.wi
        wo = dr.select(sample1 < LOBE, mirrored, mi.warp.square_to_cosine_hemisphere(sample2))
        bs = dr.zeros(mi.BSDFSample3f)
        bs.wo = wo
        bs.eta = 1.0
        bs.sampled_type = mi.UInt32(+mi.BSDFFlags.GlossyReflection)
        bs.sampled_component = mi.UInt32(0)
        bs.pdf = self.pdf(ctx, si, wo, active)
        active = active & (bs.pdf > 0)
        value = self.eval(ctx, si, wo, active) / dr.select(active, bs.pdf, 1)
        return bs, dr.select(active, value, mi.Spectrum(0))

    def to_string(self):
        return f"MistBSDF[{' x '.join(str(axis.count) for axis in self.axes)} nodes]"


mi.register_bsdf("mist", MistBSDF)
