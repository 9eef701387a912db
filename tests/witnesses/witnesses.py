"""Compares `mist eval` with independent programs.

Every comparison asks the command line for Mueller matrices and an independent package for the
same physics, and fails if they differ by more than the tolerance that stands beside it. Use
`run.sh`, which makes the environment and builds the program.
"""

import grcwa
import miepython
import numpy as np
import tmm
import treams

import spheroid
from asking import PLACES, compare_all, difference, matrices, mueller


def thin_films():
    """Facets of slope 0 reflect as their films do."""
    films = [((1.46, 0.0), 0.12), ((2.3, 0.01), 0.08), ((0.2, 3.1), 0.02)]
    substrate, wavelength = (3.8, 0.02), 0.6
    angles = [0.1, 0.6, 1.2, 1.5]
    text = " ".join(f"({n},{k}) {t}" for (n, k), t in films)
    parameters = [
        ["lambda", wavelength],
        ["substrate", "(%g,%g)" % substrate],
        ["sdf", "Unit_Slope_Distribution_Function"],
        ["stack", "Stack_StackModel"],
        ["stack.stack", text],
    ]
    got = matrices("Facet_BRDF_Model", parameters, [(t, t, 0.0) for t in angles])
    indices = [1.0] + [complex(*n) for n, _ in reversed(films)] + [complex(*substrate)]
    thicknesses = [np.inf] + [t for _, t in reversed(films)] + [np.inf]
    expected = []
    for theta in angles:
        r_s, r_p = (
            tmm.coh_tmm(pol, indices, thicknesses, theta, wavelength)["r"] for pol in "sp"
        )
        expected.append(mueller(r_s, 0, 0, r_p) / (4 * np.cos(theta) ** 2))
    return difference(got, expected)


def lone_particle(scatterer, parameters, wavelength):
    """A particle above a substrate of index 1, which reflects nothing, in the scattering plane."""
    every = [["lambda", wavelength], ["substrate", "(1,0)"], ["scatterer", scatterer]]
    every += [[f"scatterer.{name}", value] for name, value in parameters]
    return matrices("Double_Interaction_BRDF_Model", every, PLACES, "plane")


def in_plane(amplitudes, wavelength):
    """The matrices of S1 (across) and S2 (along the plane) for the cosine of the angle."""
    k = 2 * np.pi / wavelength
    expected = []
    for theta_i, theta_s, phi in PLACES:
        cos = np.sin(theta_i) * np.sin(theta_s) * np.cos(phi) - np.cos(theta_i) * np.cos(theta_s)
        s1, s2 = amplitudes(cos)
        m = mueller(s1, 0, 0, s2) / (k * k * np.cos(theta_i) * np.cos(theta_s))
        expected.append(m)
    return expected


def mie_spheres():
    worst = 0.0
    for radius, (n, k) in [(0.05, (1.59, 0.0)), (0.4, (1.33, 0.01)), (1.0, (0.3, 3.0))]:
        wavelength = 0.55
        got = lone_particle(
            "MieScatterer", [["radius", radius], ["sphere", f"({n},{k})"]], wavelength
        )
        x = 2 * np.pi * radius / wavelength

        def amplitudes(cos):
            # Fields exp(+i omega t): the conjugate index and conjugate amplitudes.
            s1, s2 = miepython.S1_S2(complex(n, -k), x, np.array([cos]), norm="wiscombe")
            return np.conj(s1[0]), np.conj(s2[0])

        worst = max(worst, difference(got, in_plane(amplitudes, wavelength)))
    return worst


def series(a, b):
    """S1 and S2 of Mie coefficients, Bohren & Huffman (4.74)."""

    def amplitudes(cos):
        s1 = s2 = 0
        before, pi = 0.0, 1.0
        for l in range(1, len(a) + 1):
            tau = l * cos * pi - (l + 1) * before
            factor = (2 * l + 1) / (l * (l + 1))
            s1 += factor * (a[l - 1] * pi + b[l - 1] * tau)
            s2 += factor * (a[l - 1] * tau + b[l - 1] * pi)
            before, pi = pi, ((2 * l + 1) * cos * pi - (l + 1) * before) / l
        return s1, s2

    return amplitudes


def coated_spheres():
    wavelength, radius, coat = 0.6, 0.35, 0.12
    core, shell = (1.5, 0.02), (2.4, 0.0)
    got = lone_particle(
        "CoatedMieScatterer",
        [
            ["radius", radius],
            ["thickness", coat],
            ["sphere", "(%g,%g)" % core],
            ["coating", "(%g,%g)" % shell],
        ],
        wavelength,
    )
    k = 2 * np.pi / wavelength
    sizes = [k * (radius - coat), k * radius]
    permittivity = [complex(*core) ** 2, complex(*shell) ** 2, 1]
    a, b = [], []
    for l in range(1, 16):
        # Helicities: their sums are the electric multipole, their differences the magnetic one.
        t = treams.coeffs.mie(l, sizes, permittivity, [1, 1, 1], [0, 0, 0])
        a.append(-(t[0, 0] + t[0, 1]))
        b.append(-(t[0, 0] - t[0, 1]))
    return difference(got, in_plane(series(a, b), wavelength))


def gratings():
    """Efficiencies of a lamellar grating; light with its field along the lines."""
    wavelength, period, height, width = 0.5, 0.8, 0.3, 0.4
    theta, cone = 0.3, 0.01
    line, substrate = 2.0, 1.5
    parameters = [
        ["lambda", wavelength],
        ["substrate", f"({substrate},0)"],
        ["order", 25],
        ["alpha", cone],
        ["grating", "Single_Line_Grating"],
        ["grating.period", period],
        ["grating.medium_t", f"({substrate},0)"],
        ["grating.material", f"({line},0)"],
        ["grating.height", height],
        ["grating.topwidth", width],
        ["grating.bottomwidth", width],
        ["grating.nlevels", 1],
    ]
    orders, places = [0, -1], []
    for order in orders:
        sine = np.sin(theta) + order * wavelength / period
        places.append((theta, np.arcsin(abs(sine)), 0.0 if sine >= 0 else np.pi))
    got = []
    for (_, theta_s, _), m in zip(places, matrices("RCW_BRDF_Model", parameters, places)):
        got.append((m[0, 0] + m[0, 1]) * np.pi * cone**2 * np.cos(theta_s))

    grcwa.set_backend("numpy")
    freq = 1 / wavelength
    points = 2000
    profile = np.where(np.abs((np.arange(points) + 0.5) / points - 0.5) < width / period / 2, line**2, 1.0)
    program = grcwa.obj(51, [period, 0], [0, 1e-3], freq, theta, 0.0, verbose=0)
    program.Add_LayerUniform(0, 1.0)
    program.Add_LayerGrid(height, points, 1)
    program.Add_LayerUniform(0, substrate**2)
    program.Init_Setup()
    program.GridLayer_geteps(profile)
    program.MakeExcitationPlanewave(0, 0, 1, 0, order=0)
    reflected, _ = program.RT_Solve(normalize=1, byorder=1)
    rows = [tuple(g) for g in program.G]
    expected = [reflected[rows.index((order, 0))].real for order in orders]
    return max(abs(a - b) / b for a, b in zip(got, expected))


def spheroids():
    """A body of revolution in free space with an oblique axis."""
    wavelength, vertical, horizontal, index = 0.613, 0.121, 0.16, 1.6 + 0.05j
    alpha, beta = 0.6, 0.813
    parameters = [
        ["lambda", wavelength],
        ["substrate", "(1,0)"],
        ["alpha", alpha],
        ["beta", beta],
        ["scatterer", "TMatrix_Axisymmetric_Scatterer"],
        ["scatterer.particle", f"({index.real},{index.imag})"],
        ["scatterer.Shape.vertical", vertical],
        ["scatterer.Shape.horizontal", horizontal],
        ["scatterer.lmax", 10],
    ]
    got = matrices("Double_Interaction_BRDF_Model", parameters, PLACES)
    # Matching at points needs more multipoles than integrals for the same accuracy.
    k, l_max = 2 * np.pi / wavelength, 20
    blocks = spheroid.t_matrices(vertical, horizontal, index, k, l_max)
    (ca, sa), (cb, sb) = ((np.cos(t), np.sin(t)) for t in (alpha, beta))
    turn = np.array([[ca * cb, sa, -ca * sb], [-cb * sa, ca, sa * sb], [sb, 0, cb]])
    expected = []
    for theta_i, theta_s, phi in PLACES:
        k_i = np.array([np.sin(theta_i), 0, -np.cos(theta_i)])
        k_s = np.array([np.sin(theta_s) * np.cos(phi), np.sin(theta_s) * np.sin(phi), np.cos(theta_s)])
        beams = []
        for beam, s in ((k_i, np.array([0, 1, 0])), (k_s, np.array([-np.sin(phi), np.cos(phi), 0]))):
            beams.append((turn @ beam, (turn @ s, turn @ np.cross(beam, s))))
        (k_in, frame_in), (k_out, frame_out) = beams
        jones = spheroid.amplitude(blocks, l_max, k_in, k_out, frame_in, frame_out)
        m = mueller(*jones.ravel())
        expected.append(m / (k * k * np.cos(theta_i) * np.cos(theta_s)))
    return difference(got, expected)


COMPARISONS = [
    # Quantity, package, tolerance and its reason.
    ("three films on silicon, whole Mueller matrix", "tmm", thin_films, 1e-12, "rounding"),
    ("spheres, whole Mueller matrix", "miepython", mie_spheres, 1e-11, "rounding of recurrences"),
    ("coated sphere, whole Mueller matrix", "treams", coated_spheres, 1e-9, "terms that the rule for their number leaves out"),
    ("oblique spheroid, whole Mueller matrix", "spheroid.py", spheroids, 1e-6, "multipoles cut off"),
    ("lamellar grating, s", "grcwa", gratings, 2e-3, "its profile is a grid of points"),
]


if __name__ == "__main__":
    compare_all(COMPARISONS)
