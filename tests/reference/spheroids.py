#!/usr/bin/env python3
"""Writes spheroids.json: light scattered by spheroids that it meets along their axis.

    pip install python-flint && python3 tests/reference/spheroids.py > tests/reference/spheroids.json

The null-field equations are written down from their definition, with the vector fields M and N themselves on the
surface and the product n.(A x B) at every node, and solved with so many bits that no cancellation is left;
orders and bits rise until two results agree to 1e-6. Light along the axis has the order m = 1 alone.
Sizes are those of the longer half axis, x = 2 pi a / lambda. Amplitudes are those of Bohren and
Huffman: S2 (parallel) and S1 (perpendicular) at ANGLES, and Q = k^2 C_ext / (4 pi).
"""

import json
import sys

from flint import acb, acb_mat, arb, arb_poly, ctx

ANGLES = [0.5, 1.2, 2.5]


def legendre_rule(n):
    """Nodes and weights on (0, 1)."""
    out = []
    for j in range(n):
        x, w = arb.legendre_p_root(n, j, weight=True)
        out.append(((1 + x) / 2, w / 2))
    return out


def riccati(l_max, z, start):
    """psi_l(z) by downward recurrence from the two orders at the top, with bits to spare."""
    factor = (acb.pi() * z / 2).sqrt()
    values = [acb(0)] * (start + 2)
    values[start + 1] = factor * z.bessel_j(acb(start + 1) + acb(1) / 2)
    values[start] = factor * z.bessel_j(acb(start) + acb(1) / 2)
    for l in range(start, 0, -1):
        values[l - 1] = (2 * l + 1) / z * values[l] - values[l + 1]
    return values[:l_max + 1]


def irregular(l_max, x):
    """x y_l(x) upward."""
    values = [-x.cos(), -x.cos() / x - x.sin()]
    for l in range(1, l_max):
        values.append((2 * l + 1) / x * values[l] - values[l - 1])
    return values[:l_max + 1]


def angular(l_max, cos, sin):
    """pi_l = P_l^1/sin, tau_l = d P_l^1/d theta, P_l^1, l from 1, without (-1)^m."""
    pi = [arb(0), arb(1)]
    rows = []
    for l in range(1, l_max + 1):
        if l > 1:
            pi.append(((2 * l - 1) * cos * pi[l - 1] - l * pi[l - 2]) / (l - 1))
        tau = l * cos * pi[l] - (l + 1) * pi[l - 1]
        rows.append((pi[l], tau, pi[l] * sin))
    return rows


def solve(vertical, horizontal, index, l_max, nodes, bits):
    """a_l, b_l-like coefficients p_l of the scattered M and N waves of the order 1 for light along the axis."""
    ctx.prec = bits
    m = acb(arb(str(index[0])), arb(str(index[1])))
    v, h = arb(str(vertical)), arb(str(horizontal))
    # Rows: outer waves (M then N), columns: inner ones; by parity of l + kind.
    inside = [[], [], [], [], []]   # M_theta, M_phi, N_r, N_theta, N_phi for the meridional functions
    rows_in, rows_reg, rows_irr, weights = [], [], [], []
    for u, w in legendre_rule(nodes):
        theta = arb.pi() * u / 2
        sin, cos = theta.sin(), theta.cos()
        square = 1 / (cos * cos / (v * v) + sin * sin / (h * h))
        x = square.sqrt()
        lean = -square * (1 / (h * h) - 1 / (v * v)) * sin * cos
        weights.append((w * arb.pi() / 2 * square * sin, lean))
        ang = angular(l_max, cos, sin)
        z = m * x
        psi_in = riccati(l_max, z, l_max + 2)
        ax = acb(x)
        psi, chi = riccati(l_max, ax, l_max + 2), irregular(l_max, ax)
        rows_in.append(fields(psi_in, z, ang))
        rows_reg.append(fields(psi, ax, ang))
        rows_irr.append(fields(chi, ax, ang))
    def product(outer, pick_out, pick_in, factor):
        a = acb_mat([[outer[n][l][pick_out] * factor(n) for n in range(nodes)] for l in range(l_max)])
        b = acb_mat([[rows_in[n][l][pick_in] for l in range(l_max)] for n in range(nodes)])
        return a * b
    area = lambda n: weights[n][0]
    leaning = lambda n: weights[n][0] * weights[n][1]
    def cross(outer, a_out, a_in):
        """Integral of n.(A_in x B_out) r^2 sin, n = r^ - lean theta^; the fields are (r, theta, phi)."""
        (ro, to, po), (ri, ti, pi_) = a_out, a_in
        total = product(outer, po, ti, area) - product(outer, to, pi_, area)      # r component
        if ro is None and ri is None:
            return total
        # -lean times the theta component A_phi B_r - A_r B_phi
        if ro is not None:
            total -= product(outer, ro, pi_, leaning)
        if ri is not None:
            total += product(outer, po, ri, leaning)
        return total
    # Field slots: 0 M_theta, 1 M_phi, 2 N_r, 3 N_theta, 4 N_phi. Inner waves have e^{i phi}, outer e^{-i phi}.
    M, N = (None, 0, 1), (2, 3, 4)
    def j(outer):
        return {(o, i): cross(outer, oo, ii) for o, oo in (("M", M), ("N", N)) for i, ii in (("M", M), ("N", N))}
    conj = lambda outer: [[conjugated(f) for f in row] for row in outer]
    reg, irr = j(conj(rows_reg)), j(conj(rows_irr))
    out = {}
    for parity in (0, 1):
        kept = [(k, l) for k in "MN" for l in range(1, l_max + 1) if (l + (k == "N")) % 2 == parity]
        def q(J):
            other = {"M": "N", "N": "M"}
            return acb_mat([[m * J[(other[ko], ki)][lo - 1, li - 1] + J[(ko, {"M": "N", "N": "M"}[ki])][lo - 1, li - 1]
                             for ki, li in kept] for ko, lo in kept])
        # E inside ~ c, H inside ~ m c with M and N exchanged: the tangential fields pair with outer waves.
        Q0 = q(reg)
        Q = Q0 + q(irr) * acb(0, 1)
        t = Q.transpose().solve(Q0.transpose()).transpose() * -1
        out[parity] = (kept, t)
    return out


def fields(f, z, ang):
    """[M_theta, M_phi, N_r, N_theta, N_phi] of l from 1, for e^{+i phi}."""
    out = []
    for l in range(1, len(ang) + 1):
        pi, tau, p = ang[l - 1]
        value = f[l] / z
        slope = (f[l - 1] - l * value) / z
        norm = (arb(2 * l + 1) / (l * l * (l + 1) * (l + 1))).sqrt()
        i = acb(0, 1)
        out.append([i * pi * value * norm, -tau * value * norm, l * (l + 1) * p * value / z * norm,
                    tau * slope * norm, i * pi * slope * norm])
    return out


def conjugated(f):
    """The same wave with e^{-i phi}: the phi-derivative changes its sign."""
    return [-f[0], f[1], f[2], f[3], -f[4]]


def amplitudes(result, l_max):
    """(S1, S2) at ANGLES and Q_ext k^2/4pi for light along the axis, from T of m = 1 (m = -1 follows)."""
    i = acb(0, 1)
    t = {}
    for kept, matrix in result.values():
        for row, a in enumerate(kept):
            for column, b in enumerate(kept):
                t[(a, b)] = matrix[row, column]
    # A plane wave x^ e^{ikz}: sum over l, m = +-1 of i^l (M_l1 + N_l1) ..., each with the norm of fields().
    wave = {}
    for l in range(1, l_max + 1):
        size = (arb(2 * l + 1)).sqrt() * (i ** l)
        wave[l] = size
    scattered = {}
    for k in "MN":
        for l in range(1, l_max + 1):
            total = acb(0)
            for k2 in "MN":
                for l2 in range(1, l_max + 1):
                    if ((k, l), (k2, l2)) in t:
                        total += t[((k, l), (k2, l2))] * wave[l2]
            scattered[(k, l)] = total
    out = []
    for angle in [0.0] + ANGLES:
        theta = arb(str(angle))
        cos, sin = theta.cos(), theta.sin()
        ang = angular(l_max, cos, sin)
        s1 = s2 = acb(0)
        for l in range(1, l_max + 1):
            pi, tau, _ = ang[l - 1]
            norm = (arb(2 * l + 1) / (l * l * (l + 1) * (l + 1))).sqrt()
            far = (-i) ** (l + 1)
            # M: (i pi, -tau) h_l ; N: (tau, i pi) i h_l, h_l -> (-i)^{l+1} e^{ikr}/kr.
            a, b = scattered[("M", l)] * far * norm, scattered[("N", l)] * far * i * norm
            s2 += a * i * pi + b * tau
            s1 += a * -tau + b * i * pi
        # i and -1 turn them to the phases of Bohren and Huffman.
        out.append((-s1, i * s2))
    return out


def to_complex(z):
    return complex(float(z.real.mid()), float(z.imag.mid()))


def normalized(vertical, horizontal, index, l_max, nodes, bits):
    values = amplitudes(solve(vertical, horizontal, index, l_max, nodes, bits), l_max)
    return [(to_complex(a), to_complex(b)) for a, b in values]


def converged(vertical, horizontal, index):
    x = max(vertical, horizontal)
    aspect = max(vertical / horizontal, horizontal / vertical)
    l = int(x + 4.05 * x ** (1 / 3) + 4)
    before = None
    while l < 140:
        nodes = int(30 + 20 * aspect ** 0.5 + 2 * l)
        now = normalized(vertical, horizontal, index, l, nodes, 128 + 8 * l)
        if before and max(abs(a - b) for p, q in zip(now, before) for a, b in zip(p, q)) \
                < 1e-7 * max(abs(a) for p in now for a in p):
            return now, l
        before, l = now, l + 4 + l // 8
    return None, l


def main():
    if sys.argv[1:] == ["--sphere"]:
        import miepython
        import numpy
        for angle, got in zip([0.0] + ANGLES, normalized(2.0, 2.0, (1.5, 0.1), 12, 60, 200)):
            expected = miepython.S1_S2(1.5 - 0.1j, 2.0, numpy.cos([angle]), norm="bohren")
            print(got, [s[0].conjugate() / 2 for s in expected])  # its "bohren" is twice theirs
        return
    cases = []
    for index in [(1.001, 0), (1.33, 0), (1.59, 0), (0.2, 3.5)]:
        for aspect in [1, 1.5, 2, 3, 5, 10]:
            for x in [0.5, 1, 2, 5, 10, 20]:
                for vertical, horizontal in {(x, x / aspect), (x / aspect, x)}:
                    cases.append((vertical, horizontal, index))
    # The small ones first: what is written until then can be used.
    cases.sort(key=lambda case: max(case[:2]))
    print('{"angles": %s, "cases": [' % json.dumps(ANGLES))
    for at, case in enumerate(cases):
        values, l = converged(*case)
        row = {"vertical": case[0], "horizontal": case[1], "index": case[2], "orders": l}
        if values:
            row["extinction"] = values[0][0].real
            row["s1"] = [[s1.real, s1.imag] for s1, _ in values[1:]]
            row["s2"] = [[s2.real, s2.imag] for _, s2 in values[1:]]
        print(json.dumps(row) + ("," if at + 1 < len(cases) else ""), flush=True)
    print("]}")


main()
