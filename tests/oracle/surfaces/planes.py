"""Writes cases/surfaces: what must come out is derived here without the program.

Spline patches: tangent planes by differentiating the B-spline formula (SymPy). Tensor products of other curves and affine
maps: exact eigenvectors (SymPy). Every expectation of a dimension is then compared with the singular values of densely
sampled secants (float): points of the ring of the cycle, carried on by the cycle.
"""
import itertools
import random
from pathlib import Path

import numpy as np
import sympy as sp

OUT = Path(__file__).parent / "../../../cases/surfaces"
R = sp.Rational


def q(x):
    x = sp.nsimplify(x)
    return str(x) if x.is_Integer else f'"{x}"'


def rows(m):
    return "[" + ", ".join("[" + ", ".join(q(x) for x in m.row(i)) + "]" for i in range(m.rows)) + "]"


# ---- masks ------------------------------------------------------------------------------------------------------------

def bspline_mask(degree, arity):
    z = sp.symbols("z")
    p = sp.Poly(sum(z**k for k in range(arity)) ** (degree + 1) / sp.Integer(arity) ** degree, z)
    return list(reversed(p.all_coeffs()))


def operators(mask, arity):
    n = -(-(len(mask) - 1) // (arity - 1))
    def entry(e):
        return lambda i, j: mask[arity * i - j + e] if 0 <= arity * i - j + e < len(mask) else sp.Integer(0)
    return [sp.Matrix(n, n, entry(e)) for e in range(arity)]


def basis(degree):
    """Uniform B-spline basis on [0, 1], in the order of the coordinates (which run against the parameter)."""
    x = sp.symbols("x")
    def b(d, t):
        if d == 0:
            return [sp.Integer(1)]
        lower = b(d - 1, t)
        out = [sp.Integer(0)] * (d + 1)
        for k, f in enumerate(lower):
            # N_k of degree d-1 has its support from k - d + 1 to k + 1.
            out[k] += (k + 1 - t) / sp.Integer(d) * f
            out[k + 1] += (t - (k - d + 1)) / sp.Integer(d) * f
        return [sp.expand(f) for f in out]
    return x, list(reversed(b(degree, x)))


def spline_plane(degrees, control, u, v):
    (x, f), (_, g) = basis(degrees[0]), basis(degrees[1])
    point = sp.zeros(1, control.cols)
    y = sp.symbols("y")
    for i, a in enumerate(f):
        for j, b in enumerate(g):
            point += a * b.subs(x, y) * control.row(i * len(g) + j)
    at = {x: u, y: v}
    return [list(point.diff(x).subs(at)), list(point.diff(y).subs(at))]


# ---- sampling ---------------------------------------------------------------------------------------------------------

def sampled_rank(ops, cycle, view, turns, seed=7, tolerance=1e-3):
    """Singular values of secant directions at the fixed point of the cycle word, for an IFS of one state."""
    rng = random.Random(seed)
    ops = [np.array(o.tolist(), dtype=float) for o in ops]
    view = np.array(view.tolist(), dtype=float)
    n = ops[0].shape[0]
    m = np.eye(n)
    for k in cycle:
        m = m @ ops[k]
    x = np.ones(n) / n
    for _ in range(2000):
        x = m @ x
    fixed = x / x.sum()
    seen = []
    for _ in range(400):
        leave = rng.randrange(len(cycle))
        other = rng.choice([k for k in range(len(ops)) if k != cycle[leave]])
        word = list(cycle[:leave]) + [other] + [rng.randrange(len(ops)) for _ in range(30)]
        y = np.ones(n) / n
        for k in reversed(word):
            y = ops[k] @ y
        d = y - fixed
        for turn in range(turns + 6):
            d = d - d.sum() * fixed
            size = np.linalg.norm(d)
            if size == 0:
                break
            d /= size
            if turn >= turns:
                s = view @ d
                if np.linalg.norm(s) > 1e-7:
                    seen.append(s / np.linalg.norm(s))
            d = m @ d
    values = np.linalg.svd(np.array(seen) / np.sqrt(len(seen)), compute_uv=False)
    return int(sum(values > tolerance)), values


# ---- cases ------------------------------------------------------------------------------------------------------------

def point(address, verdict, dimension=None, plane=None):
    text = f'\n[[expect.point]]\naddress = "{address}"\nverdict = "{verdict}"\n'
    if verdict == "proved":
        text += 'kind = "tangent-plane"\n'
    if dimension is not None:
        text += f"dimension = {dimension}\n"
    if plane is not None:
        text += "plane = [" + ", ".join("[" + ", ".join(q(x) for x in v) + "]" for v in plane) + "]\n"
    return text


def write(name, title, source, body, verdict, points, examine=()):
    text = f'name = "{name}"\ntitle = "{title}"\nsource = "{source}"\n'
    text += body.rstrip() + "\n"
    text += "".join(f'\n[[examine]]\naddress = "{a}"\n' for a in examine)
    text += f'\n[expect]\nverdict = "{verdict}"\ncontraction = "proved"\n' + "".join(points)
    (OUT / f"{name}.toml").write_text(text)
    print("wrote", name)


def spline_cases():
    rng = random.Random(3)
    control = sp.Matrix(16, 3, lambda i, j: [3 - i // 4, 3 - i % 4, (7 * i * i + 3 * i) % 11][j])
    body = "control = [" + ", ".join(str([int(x) for x in control.row(i)]) for i in range(16)) + "]\n\n[scheme]\n"
    body += 'tensor = [{ name = "bspline", degree = 3 }, { name = "bspline", degree = 3 }]'
    spots = {"(0)": (0, 0), "(3)": (1, 1), "0(1)": (R(1, 2), 0), "0(3)": (R(1, 2), R(1, 2)), "(03)": (R(1, 3), R(1, 3)), "(01)": (R(1, 3), 0), "2(1)": (R(1, 2), R(1, 2))}
    points = [point(a, "proved", 2, spline_plane((3, 3), control, *uv)) for a, uv in spots.items()]
    write("bicubic-space", "A bicubic patch in space: corners, sides, a vertex inside, a point with a periodic address",
          "derivatives of the uniform bicubic B-spline", body, "proved", points, ["(03)", "(01)"])
    line = [0, 1, 2, 3, 5, 4, 7, 6, 9]
    body = "control = [" + ", ".join(str([x, 2 * x, 3 * x]) for x in line) + "]\n\n[scheme]\n"
    body += 'tensor = [{ name = "bspline", degree = 2 }, { name = "bspline", degree = 2 }]'
    write("collapsed-line", "A biquadratic patch with all control points on a line: dimension 1 everywhere",
          "the docs, section 5: all secants lie on the line", body, "refuted",
          [point("(0)", "refuted", 1), point("0(3)", "refuted", 1)])
    # The first derivative in v vanishes at the corner (0, 0): two equal rows of control points there.
    control = sp.Matrix(9, 3, lambda i, j: [2 - i // 3, [0, 1, 1][i % 3], [4, 1, 0, 5, 2, 0, 9, 3, 0][i]][j])
    body = "control = [" + ", ".join(str([int(x) for x in control.row(i)]) for i in range(9)) + "]\n\n[scheme]\n"
    body += 'tensor = [{ name = "bspline", degree = 2 }, { name = "bspline", degree = 2 }]'
    plane = spline_plane((2, 2), control, R(1, 2), R(1, 2))
    write("biquadratic-space", "A biquadratic patch in space", "derivatives of the uniform biquadratic B-spline", body,
          regular(control), [point("0(3)", "proved", 2, plane)])


def regular(control):
    """`proved` where the partial derivatives are independent at all nine vertices of the first level."""
    halves = [sp.Integer(0), R(1, 2), sp.Integer(1)]
    independent = all(sp.Matrix(spline_plane((2, 2), control, u, v)).rank() == 2 for u in halves for v in halves)
    return "proved" if independent else "undetermined"


def de_rham(a):
    """The corner-cutting family in its own coordinates (cases/README.md, two-parameter, with b = a)."""
    b = 1 - a
    return [sp.Matrix([[b, a, 0], [a, b, b], [0, 0, a]]), sp.Matrix([[a, 0, 0], [b, b, a], [0, a, b]])]


def product_cases():
    def eigen_plane(a, b):
        def first(ops):
            fixed = (ops[0] - sp.eye(ops[0].rows)).nullspace()[0]
            fixed = fixed / sum(fixed)
            values = sorted((v for v in ops[0].eigenvals() if v != 1), key=lambda v: -abs(v))
            vector = (ops[0] - values[0] * sp.eye(ops[0].rows)).nullspace()[0]
            return fixed, vector
        (p, x), (r, y) = first(a), first(b)
        kron = lambda m, n: [m[i] * n[j] for i in range(len(m)) for j in range(len(n))]
        return [kron(x, r), kron(p, y)]

    a, b = de_rham(R(1, 3)), de_rham(R(1, 5))
    return a, b, eigen_plane


def affine(name, title, source, maps, verdict, points, examine=(), view_rank=None, turns=200, cycle=(0,), tolerance=1e-3):
    n = maps[0][0].rows
    def operator(l, t):
        image = lambda k: (l * sp.Matrix([int(i == k) for i in range(n)]) if k >= 0 else sp.zeros(n, 1)) + t
        columns = [image(k - 1) for k in range(n + 1)]
        return sp.Matrix.hstack(*[sp.Matrix([1 - sum(c)] + list(c)) for c in columns])
    ops = [operator(l, t) for l, t in maps]
    control = [[0] * n] + [[int(i == k) for i in range(n)] for k in range(n)]
    body = f'convention = "columns"\ncontrol = {control}\nstart = "A"\n\n[[state]]\nname = "A"\nkind = "face"\nlayout = "{len(ops)}x1"\n'
    body += "".join(f'\n[[state.piece]]\nto = "A"\nmatrix = {rows(o)}\n' for o in ops)
    if view_rank is not None:
        found, values = sampled_rank(ops, cycle, sp.Matrix(control).T, turns, tolerance=tolerance)
        assert found == view_rank, (name, found, values)
    write(name, title, source, body, verdict, points, examine)


def around(linear, centres, ratio=R(1, 8)):
    n = linear.rows
    return [(linear, sp.zeros(n, 1))] + [(sp.eye(n) * ratio, sp.Matrix(c) * (1 - ratio)) for c in centres]


def table_cases():
    M, s = sp.Matrix, "the docs, section 5, the table"
    e = lambda n, *k: [[int(i == j) for i in range(n)] for j in k]
    c3 = [[1, 2, 1], [-2, 1, 1], [1, 1, -3]]
    others = [point("(1)", "refuted", 3)]
    affine("double-real", "A double real eigenvalue with two eigenvectors at the fixed point of the first map", s,
           around(M([[4, 0, 0], [0, 4, 0], [0, 0, 2]]) / 8, c3), "refuted",
           [point("(0)", "proved", 2, e(3, 0, 1))] + others, view_rank=2)
    affine("spiral", "A complex pair: the surface spirals into its tangent plane", s,
           around(M([[2, -3, 0], [3, 2, 0], [1, 1, 2]]) / 8, c3), "refuted",
           # The plane of the pair is the range of (L - 1/4), here with 8L - 2.
           [point("(0)", "proved", 2, [list(v) for v in (M([[0, -3, 0], [3, 0, 0], [1, 1, 0]])).T.tolist()[:2]])] + others,
           view_rank=2)
    affine("opposite", "Eigenvalues λ and -λ", s, around(M([[0, 4, 0], [2, 0, 0], [0, 0, 1]]) / 8, c3), "refuted",
           [point("(0)", "proved", 2, e(3, 0, 1))] + others, view_rank=2)
    affine("one-direction", "One real simple eigenvalue: the surface has dimension 1 at the point", s,
           around(M([[4, 0, 0], [0, 2, 0], [0, 0, 1]]) / 8, c3), "refuted", [point("(0)", "refuted", 1)], view_rank=1)
    affine("one-block", "One longest Jordan block: dimension 1, at the rate 1/m", s,
           around(M([[4, 1, 0], [0, 4, 0], [0, 0, 2]]) / 8, [[1, 2, 1], [1, 1, 3], [0, 1, -1]]), "refuted",
           [point("(0)", "refuted", 1)], view_rank=1, turns=1500, tolerance=2e-2)
    affine("two-blocks", "Two longest Jordan blocks of one eigenvalue", s,
           around(M([[4, 1, 0, 0], [0, 4, 0, 0], [0, 0, 4, 1], [0, 0, 0, 4]]) / 8,
                  [[1, 2, 1, 1], [0, 1, 0, 3], [1, 1, 0, -1], [0, 2, 1, 1]]), "refuted",
           [point("(0)", "proved", 2, e(4, 0, 2))], view_rank=2, turns=1500, tolerance=2e-2)
    affine("null-component", "The ring meets the complement of the first eigenvector: the plane of two eigenvalues",
           "the docs, section 5, Theorem 4", around(M([[4, 0, 0], [0, 3, 0], [0, 0, 1]]) / 8, [[0, 1, 1], [2, 1, 1], [1, -1, 1]]),
           "refuted", [point("(0)", "proved", 2, e(3, 0, 1))])
    affine("null-refuted", "The ring meets the complement of the plane of a double eigenvalue: three dimensions",
           "the docs, section 5, Theorem 4; witness the fixed point of the second map",
           around(M([[4, 0, 0], [0, 4, 0], [0, 0, 2]]) / 8, [[0, 0, 1], [2, 1, 1], [1, -2, 1]]), "refuted",
           [point("(0)", "refuted", 3)])
    affine("not-isolated", "A point of the ring falls into the point examined after one turn: not decided",
           "the docs, section 3, Isolation", around(M([[4, 0, 0], [0, 2, 0], [0, 0, 0]]) / 8, [[0, 0, 1], [2, 1, 1], [1, -2, 1]]),
           "refuted", [point("(0)", "undetermined")])


def main():
    OUT.mkdir(exist_ok=True)
    spline_cases()
    table_cases()
    products()


def products():
    a, b, eigen_plane = product_cases()
    body = '[scheme]\ntensor = [{ name = "de-rham", a = "1/3" }, { name = "de-rham", a = "1/5" }]'
    kron = [sp.Matrix(sp.kronecker_product(x, y)) for y in b for x in a]
    found, values = sampled_rank(kron, (0,), sp.eye(kron[0].rows), 300)
    plane = eigen_plane(a, b)
    # The slower direction is only seen near the edge, which random points of the ring miss.
    assert found <= sp.Matrix(plane).rank() == 2, values
    write("de-rham-product", "The product of de Rham's curves with a = 1/3 and a = 1/5: different rates in the two directions",
          "G. de Rham (1956): both curves have tangents at all dyadic points; the docs, section 9, tensor products", body, "proved",
          [point("(0)", "proved", 2, plane)])
    a, b = de_rham(R(3, 10)), operators(bspline_mask(2, 5), 5)
    body = '[scheme]\ntensor = [{ name = "de-rham", a = "3/10" }, { name = "bspline", degree = 2, arity = 5 }]'
    write("order-of-products", "Eigenvalues 2/5, 3/10 in one direction and 1/5 in the other: only the theorem on products decides",
          "the docs, section 9, tensor products", body, "proved", [point("(0)", "proved", 2, eigen_plane(a, b))])
    for name, title, scheme in [
        ("loop-regular", "The triangle patch of Loop's box spline", 'mesh = "loop"\nvalence = 6'),
        ("doo-sabin-regular", "The patch of Doo and Sabin's scheme at a regular vertex", 'mesh = "doo-sabin"\nvalence = 4'),
    ]:
        examine = ["(01)", "(3)" if "loop" in name else "(03)", "1(2)"]
        write(name, title, "a regular C1 spline surface", "[scheme]\n" + scheme, "proved",
              [point(x, "proved", 2) for x in ["(0)", "0(1)"] + examine], examine)


if __name__ == "__main__":
    main()
