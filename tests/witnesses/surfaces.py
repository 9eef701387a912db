"""Compares particles on and below surfaces with smuthi, whose Sommerfeld integrals join them.

smuthi needs an older Python than the other packages; `run.sh` makes an environment for it.
"""

import contextlib
import os

import numpy as np
import smuthi.fields
import smuthi.initial_field
import smuthi.layers
import smuthi.particles
import smuthi.simulation
from smuthi.postprocessing.far_field import scattered_far_field

from asking import PLACES, compare_all, difference, matrices, mueller

SILICON = 4.05 + 0.05j
WAVELENGTH = 0.532
# Step of the trapezoidal rule along effective indices; the differences decrease with its square.
STEP = 2e-3


def scattered(layers, particle, highest):
    """Mueller BRDFs (1/sr) of one particle per area 1; layers (index, thickness), lowest first.

    `highest` ends the integrals: the largest effective index that still reaches the face.
    """
    system = smuthi.layers.LayerSystem(
        thicknesses=[d for _, d in layers], refractive_indices=[n for n, _ in layers]
    )
    found = []
    for theta_i, theta_s, phi in PLACES:
        (ss, sp), (ps, pp) = (
            amplitudes(system, particle, highest, theta_i, theta_s, phi, polarization)
            for polarization in (0, 1)
        )
        k = 2 * np.pi / WAVELENGTH
        # Its second basis vector is -p, before and after.
        m = mueller(ss, -ps, -sp, pp) / (k * k * np.cos(theta_i) * np.cos(theta_s))
        found.append(m)
    return found


def amplitudes(system, particle, highest, theta_i, theta_s, phi, polarization):
    """Far field along s and -p for incident light along s (0) or -p (1), times -ikr exp(-ikr)."""
    wave = smuthi.initial_field.PlaneWave(
        vacuum_wavelength=WAVELENGTH,
        polar_angle=np.pi - theta_i,
        azimuthal_angle=0,
        polarization=polarization,
    )
    with open(os.devnull, "w") as nowhere:
        with contextlib.redirect_stdout(nowhere), contextlib.redirect_stderr(nowhere):
            smuthi.simulation.Simulation(
                layer_system=system,
                particle_list=[particle],
                initial_field=wave,
                log_to_terminal=False,
                neff_imag=0.05,
                neff_max=highest,
                neff_resolution=STEP,
            ).run()
            # smuthi needs at least two polar angles.
            field = scattered_far_field(
                WAVELENGTH,
                [particle],
                system,
                polar_angles=np.array([theta_s, theta_s + 0.01]),
                azimuthal_angles=np.array([phi]),
            )
    return field.amplitude[:, 0, 0]


def above(films=()):
    return [(SILICON, 0), *films, (1.0, 0)]


def index(n):
    return "(%r,%r)" % (complex(n).real, complex(n).imag)


def sphere_near_silicon():
    radius, n, gap, l_max = 0.12, 1.59, 0.02, 9
    parameters = [
        ["lambda", WAVELENGTH],
        ["substrate", index(SILICON)],
        ["sphere", index(n)],
        ["radius", radius],
        ["delta", gap],
        ["lmax", l_max],
    ]
    got = matrices("Bobbert_Vlieger_BRDF_Model", parameters, PLACES)
    sphere = smuthi.particles.Sphere([0, 0, radius + gap], n, radius, l_max=l_max, m_max=l_max)
    return difference(got, scattered(above(), sphere, 8))


def sphere_on_a_film():
    """A metallic sphere that touches an oxide film on silicon."""
    radius, n, oxide, film, l_max = 0.08, 0.2 + 3.1j, 1.46, 0.1, 8
    parameters = [
        ["lambda", WAVELENGTH],
        ["substrate", index(SILICON)],
        ["stack", "SingleFilm_StackModel"],
        ["stack.material", index(oxide)],
        ["stack.thickness", film],
        ["sphere", index(n)],
        ["radius", radius],
        ["lmax", l_max],
    ]
    got = matrices("Bobbert_Vlieger_BRDF_Model", parameters, PLACES)
    sphere = smuthi.particles.Sphere([0, 0, film + radius], n, radius, l_max=l_max, m_max=l_max)
    return difference(got, scattered(above([(oxide, film)]), sphere, 30))


def sphere_below_glass():
    glass, radius, n, depth, l_max = 1.5, 0.12, 2.0 + 0.01j, 0.03, 9
    parameters = [
        ["lambda", WAVELENGTH],
        ["substrate", index(glass)],
        ["sphere", index(n)],
        ["radius", radius],
        ["delta", depth],
        ["lmax", l_max],
    ]
    got = matrices("Subsurface_Bobbert_Vlieger_BRDF_Model", parameters, PLACES)
    sphere = smuthi.particles.Sphere([0, 0, -radius - depth], n, radius, l_max=l_max, m_max=l_max)
    return difference(got, scattered([(glass, 0), (1.0, 0)], sphere, 8))


def spheroid_near_silicon():
    vertical, horizontal, n, gap, l_max = 0.1, 0.13, 1.59, 0.04, 9
    parameters = [
        ["lambda", WAVELENGTH],
        ["substrate", index(SILICON)],
        ["particle", index(n)],
        ["Shape.vertical", vertical],
        ["Shape.horizontal", horizontal],
        ["delta", gap],
        ["lmax", l_max],
    ]
    got = matrices("Axisymmetric_Particle_BRDF_Model", parameters, PLACES)
    spheroid = smuthi.particles.Spheroid(
        position=[0, 0, vertical + gap],
        refractive_index=n,
        semi_axis_c=vertical,
        semi_axis_a=horizontal,
        l_max=l_max,
        m_max=l_max,
        n_rank=l_max + 6,
    )
    return difference(got, scattered(above(), spheroid, 8))


WHY = "a trapezoidal rule"

COMPARISONS = [
    # Quantity, package, tolerance and its reason.
    ("sphere near silicon, whole Mueller matrix", "smuthi", sphere_near_silicon, 5e-5, WHY),
    ("metallic sphere on a film, whole Mueller matrix", "smuthi", sphere_on_a_film, 5e-5, WHY),
    ("sphere below a face of glass, whole Mueller matrix", "smuthi", sphere_below_glass, 5e-5, WHY),
    ("spheroid near silicon, whole Mueller matrix", "smuthi", spheroid_near_silicon, 5e-5, WHY),
]

if __name__ == "__main__":
    compare_all(COMPARISONS)
