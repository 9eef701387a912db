#!/usr/bin/env python3
"""Writes coated.json: amplitudes of coated spheres whose core nearly holds a whole number of half waves.

    pip install mpmath treams && python3 tests/reference/coated.py > tests/reference/coated.json

For every index n of the coat and whole number j the core has the radius j lambda/(2n), times 1 + offset,
and the coat a fifth of that more; one list has a second coat. The fields of each layer are
sums of spherical Bessel functions j and y with coefficients from the continuity at every face (C. F. Bohren
and D. R. Huffman, 1983, 8.1), solved with 50 digits. The script stops if treams, where it is installed,
has an extinction that differs by more than 1e-9.
"""

import json

from mpmath import mp, mpc, mpf, matrix, lu_solve, sqrt, pi, cos, besselj, bessely

mp.dps = 50
LAMBDA = mpf("0.5")
OFFSETS = ["0", "1e-12", "-1e-12", "1e-10", "-1e-8", "1e-7", "-1e-5", "1e-3", "-1e-3"]
ANGLE = mpf(2)


def riccati(f, n, z):
    """z f_n(z) and its derivative, f the spherical function of the cylindrical one."""
    value = lambda n: z * sqrt(pi / (2 * z)) * f(n + mpf("0.5"), z)
    at = value(n)
    return at, value(n - 1) - n * at / z


def coefficients(layers, n):
    """(a_n, b_n) of layers (index, size parameter of the outer face), from the inside out."""
    out = []
    for electric in (True, False):
        # Unknowns: one of the core, two of each coat, the scattered one. Continuous at a face: for a the
        # function and its slope over m, for b the function over m and its slope.
        size = 2 * len(layers)
        system, right = matrix(size, size), matrix(size, 1)
        for face, (m, x) in enumerate(layers):
            columns = [(0, besselj)] if face == 0 else [(2 * face - 1, besselj), (2 * face, bessely)]
            for column, f in columns:
                value, slope = riccati(f, n, m * x)
                system[2 * face, column] = value if electric else value / m
                system[2 * face + 1, column] = slope / m if electric else slope
            if face + 1 < len(layers):
                outer, first = layers[face + 1][0], 2 * face + 1
                for column, f in [(first, besselj), (first + 1, bessely)]:
                    value, slope = riccati(f, n, outer * x)
                    system[2 * face, column] = -(value if electric else value / outer)
                    system[2 * face + 1, column] = -(slope / outer if electric else slope)
            else:
                (psi, dpsi), (chi, dchi) = riccati(besselj, n, x), riccati(bessely, n, x)
                system[2 * face, size - 1] = psi + 1j * chi
                system[2 * face + 1, size - 1] = dpsi + 1j * dchi
                right[2 * face], right[2 * face + 1] = psi, dpsi
        out.append(lu_solve(system, right)[size - 1])
    return out


def amplitudes(layers):
    """Q_ext, S1 and S2 at ANGLE."""
    x = layers[-1][1]
    extinction, s1, s2 = mpf(0), mpc(0), mpc(0)
    before, at, c = mpf(0), mpf(1), cos(ANGLE)
    for n in range(1, int(x + 5 * x ** (mpf(1) / 3)) + 12):
        a, b = coefficients(layers, n)
        tau = n * c * at - (n + 1) * before
        extinction += (2 * n + 1) * (a + b).real
        factor = mpf(2 * n + 1) / (n * (n + 1))
        s1 += factor * (a * at + b * tau)
        s2 += factor * (a * tau + b * at)
        before, at = at, ((2 * n + 1) * c * at - (n + 1) * before) / n
    return 2 * extinction / x**2, s1, s2


def check_with_treams(layers, extinction):
    try:
        import numpy
        import treams
    except ImportError:
        return
    x = [float(x) for _, x in layers]
    n = int(x[-1] + 5 * x[-1] ** (1 / 3)) + 12
    materials = [complex(m) ** 2 for m, _ in layers] + [1]
    t = numpy.array([treams.coeffs.mie(l, x, materials, [1] * len(materials), [0] * len(materials))
                     for l in range(1, n)])
    total = -sum((2 * l + 1) * (t[l - 1][0, 0] + t[l - 1][1, 1]).real for l in range(1, n))
    got = 2 * total / x[-1] ** 2
    assert abs(got / float(extinction) - 1) < 1e-9, (layers, got, extinction)


def main():
    cases = []
    for coat in ["1.25", "1.5", "2", "2.5"]:
        for j in range(1, 9):
            for at, offset in enumerate(OFFSETS):
                core_index = mpc("1.7", "0") if (j + at) % 2 else mpc("1.4", "0.1")
                # The test sees radii as binary numbers.
                core = mpf(float(j * LAMBDA / (2 * mpf(coat)) * (1 + mpf(offset))))
                coats = [(mpc(coat), mpf(float(core / 5)))]
                if j % 4 == 3:
                    coats.append((mpc("1.3", "0.01"), mpf("0.03125")))
                k = 2 * pi / LAMBDA
                r, layers = core, [(core_index, k * core)]
                for index, thickness in coats:
                    r += thickness
                    layers.append((index, k * r))
                extinction, s1, s2 = amplitudes(layers)
                check_with_treams(layers, extinction)
                cases.append({
                    "core": [float(core_index.real), float(core_index.imag), float(core)],
                    "coats": [[float(m.real), float(m.imag), float(t)] for m, t in coats],
                    "extinction": float(extinction),
                    "s1": [float(s1.real), float(s1.imag)],
                    "s2": [float(s2.real), float(s2.imag)],
                })
    lines = ",\n".join(json.dumps(case) for case in cases)
    print('{"lambda": 0.5, "angle": 2.0, "cases": [\n%s\n]}' % lines)


main()
