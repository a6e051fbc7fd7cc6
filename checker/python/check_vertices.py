#!/usr/bin/env python3
"""A second opinion on secant's certificates of extraordinary vertices, by docs/certificate.md, with the standard library only.

Usage: check_vertices.py CASE.toml CERTIFICATE.json     (exit 0 accepted, 1 rejected, 2 unreadable)

All arithmetic is in integers: a number is a disc of the complex plane, its centre and its radius are multiples of 2^-256.
"""
import json
import re
import sys
import tomllib
from fractions import Fraction as Q
from math import factorial, gcd, isqrt, prod

from check_curves import Rejected, envelope, fields, need, no_duplicates

BITS, SQUARINGS = 256, 40
ONE, HUGE = 1 << BITS, 1 << (BITS + 128)


class Disc:
    """The complex numbers within e of x + iy; none of them is larger than m."""
    __slots__ = ("x", "y", "e", "m")

    def __init__(self, x, y=0, e=0):
        self.x, self.y, self.e, self.m = x, y, e, isqrt(x * x + y * y) + 1 + e
        need(self.m < HUGE, "limit")

    def __add__(self, other):
        return Disc(self.x + other.x, self.y + other.y, self.e + other.e)

    def __sub__(self, other):
        return Disc(self.x - other.x, self.y - other.y, self.e + other.e)

    def __mul__(self, other):
        return dot([self], [other])

    def times(self, k):
        return Disc(k * self.x, k * self.y, abs(k) * self.e)

    def least(self):
        return isqrt(self.x**2 + self.y**2) - self.e

    def real_inverse(self):
        x = abs(self.x)
        need(x > self.e, "limit")
        return Disc(ONE * ONE // self.x, 0, self.e * ONE * ONE // (x * (x - self.e)) + 2)


ZERO, UNIT = Disc(0), Disc(ONE)


def dot(a, b):
    x = y = e = 0
    for u, v in zip(a, b):
        x, y, e = x + u.x * v.x - u.y * v.y, y + u.x * v.y + u.y * v.x, e + u.m * v.e + v.m * u.e
    return Disc(x >> BITS, y >> BITS, (e >> BITS) + 3)


def number(x, y=0):
    (a, b), (c, d) = Q(x).as_integer_ratio(), Q(y).as_integer_ratio()
    return Disc(a * ONE // b, c * ONE // d, 2)


def sign(x, error):
    return 1 if x > error else -1 if -x > error else 0


def one_sign(signs):
    return set(signs) in ({1}, {-1})


def quotient(matrix, v, p):
    """The matrix on the space divided by the line of v, where v_p = 1."""
    rest = [i for i in range(len(matrix)) if i != p]
    return [[matrix[i][j] - v[i] * matrix[p][j] for j in rest] for i in rest]


def norms(matrix, factor, bound=ONE):
    """The row sum norms of P, P^2, P^4, … for P = factor * matrix, up to the first one below the bound."""
    power, found = [[x * factor for x in row] for row in matrix], []
    while not found or found[-1] >= bound:
        need(len(found) <= SQUARINGS, "domination")
        if found:
            power = [[dot(row, column) for column in zip(*power)] for row in power]
        need(power, "domination")
        found.append(max(sum(x.m for x in row) for row in power))
    return found


# ---- reading ---------------------------------------------------------------------------------------------------------

def rational(text):
    need(isinstance(text, str) and len(text) <= 10000 and re.fullmatch("0|-?[1-9][0-9]*(/[1-9][0-9]*)?", text), "format")
    p, q = (int(part) for part in (text + "/1").split("/")[:2])
    need("/" not in text or q > 1 and gcd(p, q) == 1, "format")
    return Q(p, q)


def pair(value):
    need(isinstance(value, list) and len(value) == 2, "format")
    return [rational(x) for x in value]


def parse(text):
    def natural(digits):
        need(digits.isdecimal(), "format")
        return int(digits)

    refuse = lambda digits: need(False, "format")
    value = json.loads(text, object_pairs_hook=no_duplicates, parse_int=natural, parse_float=refuse, parse_constant=refuse)
    level, depth, count = [value], 0, 0
    while level:
        depth, count = depth + 1, count + len(level)
        need(depth <= 128 and count <= 10**6, "format")
        need(not any(isinstance(x, bool) for x in level), "format")
        level = [y for x in level if isinstance(x, (list, dict)) for y in (x.values() if isinstance(x, dict) else x)]
    return value


class Case:
    keys = {"catmull-clark-variant": {"alpha", "beta", "gamma"}, "loop-variant": {"beta"}, "doo-sabin": {"weights"},
            "doo-sabin-frequency": {"frequency"}}
    keys |= dict.fromkeys(("catmull-clark", "quad-triangle", "loop", "loop-warren", "doo-sabin-catmull-clark", "midedge"), set())

    def __init__(self, text):
        need(len(text) <= 1 << 18 and max(line.count(".") for line in text.split("\n")) <= 600, "limit")
        case = tomllib.loads(text, parse_float=str)
        self.name, self.table = case.get("name"), case.get("vertex")
        need(isinstance(self.name, str) and re.fullmatch(r"[\w.-]+", self.name) and isinstance(self.table, dict), "case")
        self.mesh, valence = self.table.get("mesh"), self.table.get("valence")
        need(isinstance(self.mesh, str) and self.mesh in self.keys, "scheme")
        need(set(case) <= {"name", "title", "source", "vertex", "expect"}, "case")
        need(set(self.table) <= {"mesh", "valence"} | self.keys[self.mesh], "case")
        need(type(valence) in (int, str) or "valence" not in self.table, "case")
        parts = str(valence).split(",") if "valence" in self.table else []
        self.named = [(3, 10**9)] if valence == "all" else [self.range(part) for part in parts]

    @staticmethod
    def range(part):
        ends = re.fullmatch(r" *([0-9]{1,9}) *(?:\.\. *([0-9]{1,9}) *)?", part)
        need(ends and 3 <= int(ends[1]) <= int(ends[2] or ends[1]), "case")
        return int(ends[1]), int(ends[2] or ends[1])

    def all_in(self, valences):
        return all(high <= 256 and set(range(low, high + 1)) <= set(valences) for low, high in self.named)

    def names(self, n):
        return not self.named or any(low <= n <= high for low, high in self.named)

    @staticmethod
    def exact(x):
        text = str(x) if type(x) is int else x
        need(isinstance(text, str) and len(text) <= 10000, "case")
        need(re.fullmatch(r"[+-]?[0-9]+(\.[0-9]+|/0*[1-9][0-9]*)?", text), "case")
        return Q(text)

    def given(self, key, otherwise=None):
        return self.exact(self.table.get(key, otherwise))


# ---- the lattice around a vertex, and the scheme on it ---------------------------------------------------------------

class Vertex:
    """Places are pairs in a sector, the centre is None; a stencil is a list of (weight, place, sector)."""

    def __init__(self, case, n, turn):
        self.case, self.n, mesh = case, n, case.mesh
        self.triangles, self.dual = mesh.startswith("loop"), mesh.startswith("doo") or mesh == "midedge"
        self.powers = self.roots(number(*turn))
        self.mask = {a: number(w) for a, w in self.weights().items()}
        ring = lambda i, j: max(i, j) + 1 if self.dual else i + j if self.triangles else max(i, j)
        every = [(i, j) for i in range(0 if self.dual else 1, 4) for j in range(4)]
        self.places, self.third = [p for p in every if ring(*p) <= 2], [p for p in every if ring(*p) == 3]
        if self.dual:
            self.special, self.middle = (0, 0), [(w, (0, 0), j) for j, w in enumerate(self.face())]
        else:
            near, far = self.centre()
            corners = [] if self.triangles else [(far, (1, 1), 0)]
            self.special, self.middle = None, [(UNIT - near - far, None, 0), (near, (1, 0), 0)] + corners

    def roots(self, w):
        """The powers of the root of unity near w."""
        before, last = UNIT, w
        for _ in range(self.n - 1):
            before, last = last, last * w
        need(before.least() > 0, "turn")
        w = Disc(w.x, w.y, w.e + (last - UNIT).m * ONE // before.least() + 1)
        powers = [UNIT, w]
        while 2 * len(powers) < self.n:
            powers.append(powers[-1] * w)
        need(all(z.y > z.e for z in powers[1:]), "turn")
        return powers + [Disc(-ONE)] * (self.n % 2 == 0) + [Disc(z.x, -z.y, z.e) for z in powers[:0:-1]]

    def cos(self, j):
        return Disc(self.powers[j % self.n].x, 0, self.powers[j % self.n].e)

    def weights(self):
        if self.triangles:
            return {(i, j): Q({0: 10, 1: 6}.get(max(abs(i), abs(j), abs(i + j)), 1 if i * j * (i + j) == 0 else 2), 16)
                    for i in range(-2, 3) for j in range(-2, 3) if abs(i + j) <= 2}
        if self.case.mesh == "midedge":
            return {(i, j): Q(2 - (i in (-1, 2)) - (j in (-1, 2)), 4) for i in range(-1, 3) for j in range(-1, 3)}
        start, c = (-1, [1, 3, 3, 1]) if self.dual else (-2, [1, 4, 6, 4, 1])
        return {(i + start, j + start): Q(4 * x * y, sum(c)**2) for i, x in enumerate(c) for j, y in enumerate(c)}

    def centre(self):
        """The weights of all edge neighbours together and of all opposite corners together."""
        n, mesh, given = self.n, self.case.mesh, self.case.given
        if mesh == "loop":
            part = number(Q(3, 8)) + self.cos(1) * number(Q(1, 4))
            return number(Q(5, 8)) - part * part, ZERO
        if mesh == "catmull-clark-variant":
            near, far = given("beta"), 1 - given("alpha") - given("beta")
            need("gamma" not in self.case.table or given("gamma") == far, "case")
        elif mesh == "loop-variant":
            near, far = n * given("beta"), 0
        else:
            near, far = {"catmull-clark": (Q(3, 2 * n), Q(1, 4 * n)), "quad-triangle": (Q(3, 8), Q(1, 16)),
                         "loop-warren": (Q(9, 16) if n == 3 else Q(3, 8), 0)}[mesh]
        return number(near), number(far)

    def face(self):
        """The weights in the central face, from the own corner on."""
        n, mesh, table = self.n, self.case.mesh, self.case.table
        own, beside = [Q(j == 0) for j in range(n)], [Q(j in (1, n - 1)) for j in range(n)]
        if mesh == "midedge":
            return [number(a / 2 + b / 4) for a, b in zip(own, beside)]
        if mesh == "doo-sabin-catmull-clark":
            return [number(a / 2 + b / 8 + Q(1, 4 * n)) for a, b in zip(own, beside)]
        if "weights" in table:
            need(isinstance(table["weights"], list) and len(table["weights"]) == n, "weights")
            w = [self.case.exact(x) for x in table["weights"]]
            need(sum(w) == 1 and w[1:] == w[:0:-1], "weights")
            return [number(x) for x in w]
        f = self.case.given("frequency", 2) if mesh == "doo-sabin-frequency" else Q(1)
        need(f.denominator == 1 and f % n != 0, "weights")
        return [number(a / 4 + Q(3, 4 * n)) + self.cos(int(f) * j) * number(Q(1, 2 * n)) for j, a in enumerate(own)]

    def turned(self, i, j):
        sector, d, shear = 0, int(self.dual), int(self.triangles)
        while (j < 0 or i < 1 - d) and (d or i or j):
            i, j, sector = (-d - j, i + shear * j, sector - 1) if j < 0 else (j + shear * i, -d - i, sector + 1)
        return None if (d, i, j) == (0, 0, 0) else (i, j), sector

    def stencil(self, p):
        if p == self.special:
            return self.middle
        old = ((w, p[0] - a, p[1] - b) for (a, b), w in self.mask.items())
        return [(w, *self.turned(i // 2, j // 2)) for w, i, j in old if i % 2 == j % 2 == 0]

    def basis(self, k):
        return self.places if k or self.dual else [None] + self.places

    def block(self, k):
        """The matrix of block k; for k = 0 the one on the quotient by the constant nets, and the first row."""
        matrix = []
        for p in self.basis(k):
            row = dict.fromkeys(self.basis(k), ZERO)
            for w, q, sector in self.stencil(p):
                if q in row:
                    row[q] += w * self.powers[k * sector % self.n]
            matrix.append(list(row.values()))
        return (matrix if k else quotient(matrix, [UNIT] * len(matrix), 0)), matrix[0][1:]


# ---- the leading eigenvector -----------------------------------------------------------------------------------------

def enclose(matrix, v, p, r, over):
    """The eigenvalue, a real number, and the eigenvector with entry 1 at p."""
    image = [dot(row, v) for row in matrix]
    value, t = image[p], sum(x.m for j, x in enumerate(matrix[p]) if j != p)
    need(value.least() > r, "eigenvector")
    s = max((y - value * x).m for i, (y, x) in enumerate(zip(image, v)) if i != p)
    sizes, inverse = norms(quotient(matrix, v, p), over, ONE // 2), over.m
    for x in sizes[:-1]:
        inverse = inverse * (ONE + x) // ONE + 1
    inverse = inverse * ONE // (ONE - sizes[-1]) + 1
    need(8 * inverse**2 * t * s <= ONE**4, "eigenvector")
    near = 2 * inverse * s // ONE + 1
    value = Disc(value.x, 0, value.e + near * t // ONE + 1)
    need(value.least() > r and value.m < ONE, "eigenvalue")
    return value, [x if i == p else Disc(x.x, x.y, x.e + near) for i, x in enumerate(v)]


def leading_net(vertex, k, r, vector):
    """The eigenvector of the leading eigenvalue, alone in the blocks k and n - k, as a function of places and sectors."""
    matrix, first = vertex.block(k)
    need(isinstance(vector, list) and len(vector) == len(matrix), "format")
    vector = [pair(v) for v in vector]
    need([1, 0] in vector, "eigenvector")
    p, over = vector.index([1, 0]), number(1 / r)
    value, v = enclose(matrix, [UNIT if i == p else number(*z) for i, z in enumerate(vector)], p, number(r).m, over)
    for b in range(vertex.n // 2 + 1):
        norms(quotient(matrix, v, p) if b == k else vertex.block(b)[0], over)
    if k == 0:
        shift = dot(first, v) * (value - UNIT).real_inverse()
        v = [shift] + [z + shift for z in v]
    net = dict(zip(vertex.basis(k), v))
    at = lambda q, sector: net[q] * vertex.powers[k * sector % vertex.n] if q or k == 0 else ZERO
    net |= {q: sum((w * at(*old) for w, *old in vertex.stencil(q)), ZERO) * value.real_inverse() for q in vertex.third}
    return lambda i, j: at(*vertex.turned(i, j))


# ---- patches: dictionaries by exponents of (positive multiples of) Bernstein coefficients ----------------------------

def mean(*terms):
    return sum((z.times(k) for k, z in terms), ZERO)


def product(at, i, j, dual):
    """A cell; exponents (a, d - a, b, d - b)."""
    rows = [[1, 1, 0], [0, 2, 0], [0, 1, 1]] if dual else [[1, 4, 1, 0], [0, 4, 2, 0], [0, 2, 4, 0], [0, 1, 4, 1]]
    d, places = len(rows) - 1, range(len(rows[0]))
    net = {(g, h): at(i - 1 + g, j - 1 + h) for g in places for h in places}
    return {(a, d - a, b, d - b): mean(*((rows[a][g] * rows[b][h], z) for (g, h), z in net.items()))
            for a in range(d + 1) for b in range(d + 1)}


def quartic(at, i, j, unit):
    """The triangle with the edges (unit, 0), (0, unit) from (i, j)."""
    triangle, found = [(i, j), (i + unit, j), (i, j + unit)], {}
    for k in range(3):
        x, y, z = (triangle[(k + m) % 3] for m in range(3))
        go = lambda e, f: at(*(a + e * (b - a) + f * (c - a) for a, b, c in zip(x, y, z)))
        o, e, f, ef, fe, me, mf = (go(*s) for s in ((0, 0), (1, 0), (0, 1), (1, -1), (-1, 1), (-1, 0), (0, -1)))
        for exponents, terms in (
                ((4, 0, 0), ((12, o), (2, e), (2, f), (2, fe), (2, me), (2, mf), (2, ef))),
                ((3, 1, 0), ((12, o), (4, e), (3, f), (3, ef), (1, fe), (1, mf))),
                ((3, 0, 1), ((12, o), (4, f), (3, e), (3, fe), (1, ef), (1, me))),
                ((2, 2, 0), ((8, o), (8, e), (4, f), (4, ef))),
                ((2, 1, 1), ((10, o), (6, e), (6, f), (1, ef), (1, fe)))):
            found[tuple(exponents[(m - k) % 3] for m in range(3))] = mean(*terms)
    return found


def quadratic(at, i, j):
    """The four triangles of a cell, from the right one on: its centre and two neighbouring corners."""
    own, sides = at(i, j), [at(i + 1, j), at(i, j + 1), at(i - 1, j), at(i, j - 1)]
    corners = [at(i + 1, j + 1), at(i - 1, j + 1), at(i - 1, j - 1), at(i + 1, j - 1)]
    for k in range(4):
        before, side, after = sides[k - 1], sides[k], sides[(k + 1) % 4]
        yield k, {(2, 0, 0): mean((4, own), *((1, z) for z in sides)), (0, 1, 1): mean((4, own), (4, side)),
                  (1, 1, 0): mean((4, own), (2, before), (2, side)), (1, 0, 1): mean((4, own), (2, side), (2, after)),
                  (0, 2, 0): mean((2, own), (2, before), (2, side), (2, corners[k - 1])),
                  (0, 0, 2): mean((2, own), (2, side), (2, after), (2, corners[k]))}


def patches_of(vertex, at):
    """The patches of the ring, each with the indices of the exponents that are 0 on its sides on the outer boundary."""
    cells = ((1, 0), [1]), ((1, 1), [1, 3]), ((0, 1), [3])
    if vertex.triangles:
        return [(quartic(at, 1, 0, 1), [0]), (quartic(at, 1, 1, -1), []), (quartic(at, 0, 1, 1), [0])]
    if vertex.case.mesh == "midedge":
        return [(patch, [0] if 2 * k + 1 in outer else []) for cell, outer in cells for k, patch in quadratic(at, *cell)]
    return [(product(at, *cell, vertex.dual), outer) for cell, outer in cells]


def groups(e):
    return [e] if len(e) == 3 else [e[:2], e[2:]]


def derivative(patch, up, down):
    step = lambda e, k, by: tuple(x + by * (m == k) for m, x in enumerate(e))
    lower = {step(e, down, -1) for e in patch if e[down] > 0}
    return {e: patch[step(e, up, 1)] - patch[step(e, down, 1)] for e in lower}


def determinant(patch):
    """The signs of the Bernstein coefficients of the Jacobian determinant."""
    first, second = ((1, 0), (2, 0)) if len(next(iter(patch))) == 3 else ((0, 1), (2, 3))
    binomial, found = lambda e: prod(factorial(sum(g)) // prod(map(factorial, g)) for g in groups(e)), {}
    for e, z in derivative(patch, *first).items():
        for f, w in derivative(patch, *second).items():
            key = tuple(x + y for x, y in zip(e, f))
            found[key] = found.get(key, ZERO) + (Disc(z.x, -z.y, z.e) * w).times(binomial(e) * binomial(f))
    return {e: sign(z.y, z.e) for e, z in found.items()}


# ---- the rules -------------------------------------------------------------------------------------------------------

def check_valence(case, n, item):
    _, rule, k, turn, others, vector, half_plane = fields(
        item, "valence", "rule", "frequency", "turn", "others", "vector", "half_plane")
    need(3 <= n <= 256, "valence")
    need(isinstance(k, int) and 2 * k <= n, "frequency")
    inner, r = 0 < 2 * k < n, rational(others)
    need(r > 0, "domination")
    vertex = Vertex(case, n, pair(turn))
    patches = patches_of(vertex, leading_net(vertex, k, r, vector))
    points = [z for patch, _ in patches for z in patch.values()]
    if half_plane is not None:
        x, y = pair(half_plane)
        need(inner and all(z.x > z.e for z in (number(x, -y) * z for z in points)), "half-plane")
    plane = "undetermined" if half_plane is None else "proved"
    if rule == "theorem-7":
        need(k == 1 and half_plane is not None, rule)
        need(one_sign(s for patch, _ in patches for s in determinant(patch).values()), rule)
        return "proved", "proved"
    if rule == "theorem-8-winding":
        need(k >= 2 and inner, rule)
    elif rule == "theorem-8-fold":
        corners = {s for patch, _ in patches for e, s in determinant(patch).items() if all(sum(g) == max(g) for g in groups(e))}
        need(inner and {1, -1} <= corners, rule)
    elif rule == "theorem-2":
        need(k == 0 and one_sign(sign(z.x, z.e) for z in points), rule)
        plane = "refuted"
    else:
        need(rule == "theorem-8-path", "format")
        need(k == 0, rule)
        outside = [z for patch, outer in patches for e, z in patch.items() if any(e[m] == 0 for m in outer)]
        need(one_sign(sign(z.x, z.e) for z in outside), rule)
    return "refuted", plane


def check(case, value):
    form, version, kind, name, verdict, proof = envelope(value)
    need((form, version, kind) == ("secant certificate", 1, "vertex"), "format")
    need(name == case.name, "case")
    items, = fields(proof, "valences")
    need(isinstance(items, list) and all(isinstance(item, dict) for item in items), "format")
    valences = [item.get("valence") for item in items]
    need(valences and all(isinstance(n, int) for n in valences) and valences == sorted(set(valences)), "valence")
    found = [check_valence(case, n, item) for n, item in zip(valences, items)]
    counted = [c1 for n, (c1, _) in zip(valences, found) if case.names(n)]
    complete = bool(counted) and case.all_in(valences)
    need(verdict == ("refuted" if "refuted" in counted else "proved" if complete else "undetermined"), "verdict")
    print(f"accepted: {name}: {verdict}")
    for n, both in zip(valences, found):
        for answer, what in zip(both, ("C1", "a tangent plane")):
            print(f"  {answer}: valence {n}: {what}")


def read(name, size):
    with open(name, "rb") as file:
        text = file.read(size + 1)
    need(len(text) <= size, "limit")
    return text.decode()


def main(arguments):
    if len(arguments) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    try:
        case, value = Case(read(arguments[0], 4 << 20)), parse(read(arguments[1], 16 << 20))
    except (Rejected, OSError, ValueError, RecursionError) as error:
        print(f"unreadable: {error}", file=sys.stderr)
        return 2
    try:
        check(case, value)
    except (Rejected, ValueError) as error:
        print(f"rejected: {error if isinstance(error, Rejected) else 'limit'}")
        return 1
    return 0


if __name__ == "__main__":
    sys.set_int_max_str_digits(10001)
    sys.exit(main(sys.argv[1:]))
