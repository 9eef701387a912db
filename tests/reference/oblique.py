#!/usr/bin/env python3
"""Writes oblique.json: light scattered by spheroids that it meets at an angle to their axis, and by large ones.

    pip install python-flint && python3 tests/reference/oblique.py > tests/reference/oblique.json

The null-field equations of every order m, from the vector fields M and N on the surface, as in spheroids.py but
with the integrals as products of matrices; the orders of l rise until two results agree to TOLERANCE.
Lengths are in units of 1/k. The incident beam has the polar angle `incidence` and the azimuth 0; an intensity is
the sum of the squares of the four amplitudes (those of Bohren and Huffman) in a direction of DIRECTIONS.

    python3 tests/reference/oblique.py --check      compares with spheroids.json and with a sphere's series
"""

import json
import os
import sys

from flint import acb, acb_mat, arb, ctx

DIRECTIONS = [(0.4, 0.0), (1.1, 0.8), (2.3, 2.0)]
TOLERANCE = 1e-5
I = acb(0, 1)


def legendre_rule(n):
    """Nodes and weights on (0, 1)."""
    rule = [arb.legendre_p_root(n, j, weight=True) for j in range(n)]
    return [((1 + x) / 2, w / 2) for x, w in rule]


def regular(l_max, z):
    """psi_l(z), downward from two Bessel functions at the top."""
    top = l_max + 2
    factor = (acb.pi() * z / 2).sqrt()
    values = [acb(0)] * (top + 2)
    for l in (top + 1, top):
        values[l] = factor * z.bessel_j(acb(l) + acb(1) / 2)
    for l in range(top, 0, -1):
        values[l - 1] = (2 * l + 1) / z * values[l] - values[l + 1]
    return values[:l_max + 1]


def irregular(l_max, x):
    """x y_l(x), upward."""
    values = [-x.cos(), -x.cos() / x - x.sin()]
    for l in range(1, l_max):
        values.append((2 * l + 1) / x * values[l] - values[l - 1])
    return values


def angular(m, l_max, cos, sin):
    """{l: (m P/sin, dP/dtheta, P)} with P normalized so that the vector harmonics are: integral of |.|^2 is 1."""
    q = {}
    diagonal = (1 / (4 * arb.pi())).sqrt()
    for k in range(1, m + 1):
        diagonal *= (arb(2 * k + 1) / (2 * k)).sqrt() * sin
    q[m] = diagonal
    for l in range(m + 1, l_max + 1):
        a = (arb(4 * l * l - 1) / (l * l - m * m)).sqrt()
        b = (arb((2 * l + 1) * ((l - 1) ** 2 - m * m)) / ((2 * l - 3) * (l * l - m * m))).sqrt() if l > m + 1 else 0
        q[l] = a * cos * q[l - 1] - (b * q[l - 2] if l > m + 1 else 0)
    out = {}
    for l in range(max(1, m), l_max + 1):
        below = q[l - 1] * (arb((2 * l + 1) * (l * l - m * m)) / (2 * l - 1)).sqrt() if l > m else 0
        norm = (arb(1) / (l * (l + 1))).sqrt()
        out[l] = (m * q[l] / sin * norm, (l * cos * q[l] - below) / sin * norm, q[l] * norm)
    return out


class Surface:
    """The nodes from pole to equator with the radial functions there."""

    def __init__(self, vertical, horizontal, index, l_max, nodes):
        self.index, self.l_max = acb(arb(str(index[0])), arb(str(index[1]))), l_max
        v, h = arb(str(vertical)), arb(str(horizontal))
        self.nodes = []
        for u, w in legendre_rule(nodes):
            theta = arb.pi() * u / 2
            sin, cos = theta.sin(), theta.cos()
            square = 1 / (cos * cos / (v * v) + sin * sin / (h * h))
            x = acb(square.sqrt())
            lean = -square * (1 / (h * h) - 1 / (v * v)) * sin * cos
            area = w * arb.pi() / 2 * square * sin
            z = self.index * x
            waves = [radial(regular(l_max, z), z), radial(regular(l_max, x), x), radial(irregular(l_max, x), x)]
            self.nodes.append((sin, cos, area, lean, waves))

    def block(self, m):
        """T of the order m, as {(row kind, l): {(column kind, l'): value}}."""
        orders = range(max(1, m), self.l_max + 1)
        at_nodes = [angular(m, self.l_max, cos, sin) for sin, cos, _, _, _ in self.nodes]

        def table(which, f):
            """f(wave, angular functions, l) by node and l."""
            rows = []
            for (_, _, _, _, waves), harmonics in zip(self.nodes, at_nodes):
                rows.append([f(waves[which][l], harmonics[l], l) for l in orders])
            return rows

        # Fields without their factors i: M = (0, i a, -b), N = (r, t, i p).
        def fields(which):
            return {
                "a": table(which, lambda w, h, l: w[0] * h[0]),
                "b": table(which, lambda w, h, l: w[0] * h[1]),
                "r": table(which, lambda w, h, l: w[2] * (l * (l + 1) * h[2])),
                "t": table(which, lambda w, h, l: w[1] * h[1]),
                "p": table(which, lambda w, h, l: w[1] * h[0]),
            }

        inside = {name: acb_mat(rows) for name, rows in fields(0).items()}

        def integrals(which):
            outside = {}
            for name, rows in fields(which).items():
                straight = [[f * node[2] for f in row] for row, node in zip(rows, self.nodes)]
                leaning = [[f * (node[2] * node[3]) for f in row] for row, node in zip(rows, self.nodes)]
                outside[name] = (acb_mat(straight).transpose(), acb_mat(leaning).transpose())

            def of(name_out, name_in, lean=0):
                return outside[name_out][lean] * inside[name_in]

            # n.(A_in x B_out) = A_t B_p - A_p B_t - lean (A_p B_r - A_r B_p); the outer waves have e^{-im phi}:
            # M = (0, -i a, -b), N = (r, t, -i p).
            return {
                ("M", "M"): -I * (of("b", "a") + of("a", "b")),
                ("N", "M"): of("p", "a") + of("t", "b") + of("r", "b", 1),
                ("M", "N"): -of("b", "t") - of("a", "p") - of("b", "r", 1),
                ("N", "N"): -I * (of("p", "t") + of("t", "p") + of("r", "p", 1) + of("p", "r", 1)),
            }

        other = {"M": "N", "N": "M"}
        kinds = [(kind, l) for kind in "MN" for l in orders]
        first = max(1, m)
        systems = [integrals(1), integrals(2)]
        t = {key: {} for key in kinds}
        for parity in (0, 1):
            kept = [(kind, l) for kind, l in kinds if (l + (kind == "N")) % 2 == parity]
            if not kept:
                continue

            def q(j):
                rows = []
                for ko, lo in kept:
                    at = lambda outer, inner, li: j[(outer, inner)][lo - first, li - first]
                    rows.append([self.index * at(other[ko], ki, li) + at(ko, other[ki], li) for ki, li in kept])
                return acb_mat(rows)

            regular_part = q(systems[0])
            both = regular_part + q(systems[1]) * I
            x = both.transpose().solve(regular_part.transpose()).transpose()
            for row, to in enumerate(kept):
                for column, source in enumerate(kept):
                    t[to][source] = -x[row, column]
        return t


def radial(f, z):
    """(f/z, f'/z, f/z^2) by l."""
    out = [None]
    for l in range(1, len(f)):
        value = f[l] / z
        out.append((value, (f[l - 1] - l * value) / z, value / z))
    return out


def intensities(surface, incidence, directions=DIRECTIONS):
    """Sums of |S|^2 in the directions."""
    l_max = surface.l_max
    angle = arb(str(incidence))
    on_axis = incidence == 0
    # Far fields by direction and incident polarization.
    far = [[[acb(0), acb(0)] for _ in range(2)] for _ in directions]
    largest = 0.0
    for m in range(0, l_max + 1):
        if on_axis and m != 1:
            continue
        t = surface.block(m)
        if on_axis:
            # The limit of m P/sin and dP/dtheta at the pole, both from an angle that is small to all digits.
            small = arb("1e-60")
            beam = angular(m, l_max, small.cos(), small.sin())
        else:
            beam = angular(m, l_max, angle.cos(), angle.sin())
        size = 0.0
        for sign in ([1] if m == 0 else [1, -1]):
            for polarization in range(2):
                wave = {}
                for l, (pi, tau, _) in beam.items():
                    c = [-I * sign * pi, -acb(tau)][polarization]
                    b = [acb(tau), -I * sign * pi][polarization]
                    wave[("M", l)], wave[("N", l)] = I ** l * c, I ** l * -I * b
                scattered = {}
                for to, row in t.items():
                    flip = lambda source: sign if source[0] != to[0] else 1
                    scattered[to] = sum((z * flip(source) * wave[source] for source, z in row.items()), acb(0))
                for place, (theta, phi) in zip(far, directions):
                    theta, phi = arb(str(theta)), arb(str(phi))
                    harmonics = angular(m, l_max, theta.cos(), theta.sin())
                    turn = (I * m * sign * phi).exp() * 4 * acb.pi()
                    for l, (pi, tau, _) in harmonics.items():
                        w_m, w_n = scattered[("M", l)], scattered[("N", l)]
                        phase = (-I) ** (l + 1) * turn
                        part = [phase * (w_m * I * sign * pi + I * w_n * tau),
                                phase * (-w_m * tau - w_n * sign * pi)]
                        for k in range(2):
                            place[polarization][k] += part[k]
                            size = max(size, abs(to_complex(part[k])))
        largest = max(largest, size)
        if m > 1 and size < 1e-8 * largest:
            break
    return [sum(abs(to_complex(f)) ** 2 for pair in place for f in pair) for place in far]


def to_complex(z):
    return complex(float(z.real.mid()), float(z.imag.mid()))


def converged(vertical, horizontal, index, incidence):
    x = max(vertical, horizontal)
    aspect = max(vertical / horizontal, horizontal / vertical)
    l, before = int(x + 4.05 * x ** (1 / 3) + 2 + 2 * aspect), None
    while l < 110:
        ctx.prec = 128 + 8 * l
        surface = Surface(vertical, horizontal, index, l, int(30 + 20 * aspect ** 0.5 + 2 * l))
        now = intensities(surface, incidence)
        if before and max(abs(a / b - 1) for a, b in zip(now, before)) < TOLERANCE:
            return now, l
        before, l = now, l + 4 + l // 8
    return None, l


def check():
    with open(os.path.join(os.path.dirname(__file__), "spheroids.json")) as file:
        known = json.load(file)
    for case in known["cases"][40:219:45]:
        ctx.prec = 128 + 8 * case["orders"]
        aspect = max(case["vertical"] / case["horizontal"], case["horizontal"] / case["vertical"])
        surface = Surface(case["vertical"], case["horizontal"], case["index"], case["orders"],
                          int(30 + 20 * aspect ** 0.5 + 2 * case["orders"]))
        got = intensities(surface, 0, [(angle, 0.0) for angle in known["angles"]])
        for at, value in enumerate(got):
            expected = sum(abs(complex(*case[s][at])) ** 2 for s in ("s1", "s2"))
            print(case["vertical"], case["horizontal"], case["index"], value / expected - 1)
    # A sphere has no axis: the scattering angle alone counts.
    import math
    ctx.prec = 300
    surface = Surface(3.0, 3.0, (1.59, 0), 14, 60)
    for theta, phi in DIRECTIONS:
        cos = math.cos(0.9) * math.cos(theta) + math.sin(0.9) * math.sin(theta) * math.cos(phi)
        a, b = intensities(surface, 0.9, [(theta, phi)]), intensities(surface, 0, [(math.acos(cos), 0.0)])
        print("sphere", a[0] / b[0] - 1)


def main():
    if sys.argv[1:] == ["--check"]:
        return check()
    indices = [(1.001, 0), (1.33, 0), (1.59, 0), (0.2, 3.5)]
    cases = []
    # Oblique light.
    for x in [1, 2, 5]:
        for aspect in [1.5, 3]:
            cases += [(v, h, index, 0.9) for index in indices for v, h in ((x, x / aspect), (x / aspect, x))]
    for x, aspect in [(2, 10), (5, 8), (10, 2)]:
        cases += [(v, h, index, 0.9) for index in indices for v, h in ((x, x / aspect), (x / aspect, x))]
    # Large ones, along the axis.
    for aspect in [1, 1.5, 2, 3, 4]:
        cases += [(v, h, index, 0) for index in indices for v, h in sorted({(20, 20 / aspect), (20 / aspect, 20)})]
    part = sys.argv[1:] and [int(k) for k in sys.argv[1].split("/")] or [0, 1]
    rows = []
    print('{"directions": %s, "cases": [' % json.dumps(DIRECTIONS), flush=True)
    for at, (vertical, horizontal, index, incidence) in enumerate(cases):
        if at % part[1] != part[0]:
            continue
        values, l = converged(vertical, horizontal, index, incidence)
        row = {"vertical": vertical, "horizontal": horizontal, "index": index, "incidence": incidence, "orders": l}
        if values:
            row["intensities"] = values
        print((",\n" if rows else "") + json.dumps(row), end="", flush=True)
        rows.append(row)
    print("\n]}")


main()
