#!/usr/bin/env python3
"""A second opinion on secant's certificates, by docs/certificate.md, with the standard library only.

Usage: check_curves.py CASE.toml CERTIFICATE.json     (exit 0 accepted, 1 rejected, 2 unreadable)

It covers the certificates of curves and sets (but boundary operators of vertices), of spectra and of unknown entries; its neighbours
those of radii, lattices, regions, surfaces and vertices.  It is written for reading, not for hostile input: use secant-check where limits matter.
"""
import json
import sys
import tomllib
from collections import namedtuple
from fractions import Fraction as Q
from math import gcd, lcm


class Rejected(Exception):
    pass


def need(condition, rule):
    if not condition:
        raise Rejected(rule)


# ---- rational linear algebra: a matrix is a list of rows -------------------------------------------------------------

def mul(a, b):
    columns = list(zip(*b))
    return [[sum((x * y for x, y in zip(row, col)), Q(0)) for col in columns] for row in a]


def apply(a, v):
    return [sum((x * y for x, y in zip(row, v)), Q(0)) for row in a]


def transpose(a, width=0):
    return [list(col) for col in zip(*a)] if a else [[] for _ in range(width)]


def identity(n):
    return [[Q(int(i == j)) for j in range(n)] for i in range(n)]


def sub(a, b):
    return [x - y for x, y in zip(a, b)]


def echelon(rows):
    rows, pivots = [list(r) for r in rows], []
    for j in range(len(rows[0]) if rows else 0):
        top = len(pivots)
        found = next((i for i in range(top, len(rows)) if rows[i][j] != 0), None)
        if found is None:
            continue
        rows[top], rows[found] = rows[found], rows[top]
        rows[top] = [x / rows[top][j] for x in rows[top]]
        for i, row in enumerate(rows):
            if i != top and row[j] != 0:
                rows[i] = [x - row[j] * p for x, p in zip(row, rows[top])]
        pivots.append(j)
    return rows[:len(pivots)], pivots


def grow(rows, matrix):
    """The smallest row space that contains `rows` and is closed under right multiplication."""
    rows, pivots = echelon(rows)
    while True:
        more, more_pivots = echelon(rows + (mul(rows, matrix) if rows else []))
        if len(more_pivots) == len(pivots):
            return rows, pivots
        rows, pivots = more, more_pivots


def fixed_point(op):
    n = len(op)
    rows, pivots = echelon([[x - y for x, y in zip(r, s)] for r, s in zip(op, identity(n))])
    need(len(pivots) == n - 1, "fixed-point")
    free = next(j for j in range(n) if j not in pivots)
    v = [Q(0)] * n
    v[free] = Q(1)
    for i, p in enumerate(pivots):
        v[p] = -rows[i][free]
    need(sum(v) != 0, "fixed-point")
    return [x / sum(v) for x in v]


def characteristic(a):
    n = len(a)
    c, m = [Q(0)] * n + [Q(1)], identity(n)
    for k in range(1, n + 1):
        product = mul(a, m)
        c[n - k] = -sum(product[i][i] for i in range(n)) / k
        m = [[x + c[n - k] * int(i == j) for j, x in enumerate(row)] for i, row in enumerate(product)]
    return c


def power(a, k):
    p = identity(len(a))
    for _ in range(k):
        p = mul(p, a)
    return p


# ---- intervals, polynomials, fields ----------------------------------------------------------------------------------

def i_add(a, b):
    return a[0] + b[0], a[1] + b[1]


def i_sub(a, b):
    return a[0] - b[1], a[1] - b[0]


def i_mul(a, b):
    ends = [x * y for x in a for y in b]
    return min(ends), max(ends)


def i_sign(a):
    return 1 if a[0] > 0 else -1 if a[1] < 0 else 0


def horner(p, x):
    value = (Q(0), Q(0))
    for c in reversed(p):
        value = i_add(i_mul(value, x), (c, c))
    return value


def horner_complex(p, z):
    re = im = (Q(0), Q(0))
    for c in reversed(p):
        re, im = (i_add(i_sub(i_mul(re, z[0]), i_mul(im, z[1])), (c, c)), i_add(i_mul(re, z[1]), i_mul(im, z[0])))
    return re, im


def trim(p):
    p = list(p)
    while p and p[-1] == 0:
        p.pop()
    return p


def combine(a, factor, b):
    n = max(len(a), len(b))
    at = lambda p, k: p[k] if k < len(p) else Q(0)
    return trim(at(a, k) + factor * at(b, k) for k in range(n))


def weighted(row, v):
    total = []
    for c, p in zip(row, v):
        total = combine(total, c, p)
    return total


def times(f, g):
    if not f or not g:
        return []
    out = [Q(0)] * (len(f) + len(g) - 1)
    for i, x in enumerate(f):
        for j, y in enumerate(g):
            out[i + j] += x * y
    return trim(out)


class Ring:
    """Polynomials modulo a monic one, which need not be irreducible."""

    def __init__(self, m, most=64):
        self.m = m
        need(2 <= len(m) <= most + 1 and m[-1] == 1, "field")

    def mul(self, a, b):
        p, d = times(a, b), len(self.m) - 1
        while len(p) > d:
            lead, k = p[-1], len(p) - 1
            for i, c in enumerate(self.m):
                p[k - d + i] -= lead * c
            p = trim(p)
        return p

    def dot(self, row, column):
        total = []
        for a, b in zip(row, column):
            total = combine(total, 1, self.mul(a, b))
        return total

    def theta(self, sign):
        return self.mul([Q(0), Q(sign)], [Q(1)])

    def vector(self, items, n):
        need(isinstance(items, list) and len(items) == n, "format")
        return [poly(x, len(self.m) - 1) for x in items]

    def chain(self, matrix, sign, items, rule):
        vectors, theta = [self.vector(v, len(matrix)) for v in items], self.theta(sign)
        need(vectors, rule)
        for k, v in enumerate(vectors):
            for i, row in enumerate(matrix):
                image = combine(weighted(row, v), -1, self.mul(theta, v[i]))
                need(image == (vectors[k - 1][i] if k else []), rule)
        return vectors


def root_near(p, z, e):
    """Whether n |p(z)| <= e |p'(z)|, n >= 1, e >= 0: then a root of p is within e of z. A constant has no root."""
    if len(p) < 2 or p[-1] == 0 or e < 0:
        return False
    size = lambda p: sum(part[0] ** 2 for part in horner_complex(p, [(x, x) for x in z]))
    return (len(p) - 1) ** 2 * size(p) <= e * e * size([k * c for k, c in enumerate(p)][1:])


class Field(Ring):
    def __init__(self, m, interval):
        super().__init__(m)
        self.interval = lo, hi = interval
        if len(m) == 2:
            need(lo == hi == -m[0], "field")
        else:
            at = lambda x: horner(m, (x, x))[0]
            need(lo < hi and at(lo) * at(hi) < 0, "field")
            need(i_sign(horner([k * c for k, c in enumerate(m)][1:], interval)) != 0, "field")

    def value(self, element):
        return horner(element, self.interval)

    def equals(self, number, x):
        """Whether the element x is the root that generates the field `number`."""
        value = []
        for c in reversed(number.m):
            value = combine(self.mul(value, x), 1, trim([c]))
        (lo, hi), (a, b) = number.interval, self.value(x)
        return not value and (len(number.m) == 2 or lo <= a <= b <= hi)


def inside(p):
    if len(p) == 1:
        need(p[0] != 0, "disc")
        return 0
    n = len(p) - 1
    delta = p[0] ** 2 - p[n] ** 2
    need(delta != 0, "disc")
    count = inside([(p[0] * p[k] - p[n] * p[n - k]) / delta for k in range(n)])
    return count if delta > 0 else n - count


def not_parallel(v, w):
    minors = (i_sub(i_mul(v[i], w[j]), i_mul(v[j], w[i])) for i in range(len(v)) for j in range(i))
    return any(i_sign(m) for m in minors)


def plane(vectors, rule):
    need(any(not_parallel(v, w) for k, v in enumerate(vectors) for w in vectors[:k]), rule)


# ---- reading ---------------------------------------------------------------------------------------------------------

def rational(text):
    # Exponents are no canonical form, and would be written out at any length.
    need(isinstance(text, str) and len(text) <= 10000 and set(text) <= set("-0123456789/"), "format")
    need(str(Q(text)) == text, "format")
    return Q(text)


def vector(items, count=None):
    need(isinstance(items, list) and (count is None or len(items) == count), "format")
    return [rational(x) for x in items]


def poly(items, bound):
    p = vector(items)
    need(len(p) <= bound and (not p or p[-1] != 0), "format")
    return p


def fields(value, *names):
    need(isinstance(value, dict) and list(value) == list(names), "format")
    return [value[name] for name in names]


def index(k, bound):
    need(isinstance(k, int) and not isinstance(k, bool) and 0 <= k < bound, "format")
    return k


def word(items):
    need(isinstance(items, list) and len(items) <= 1000, "format")
    return [index(k, 64) for k in items]


def address(value):
    prefix, cycle = fields(value, "prefix", "cycle")
    need(cycle, "format")
    return word(prefix), word(cycle)


def no_duplicates(pairs):
    need(len({k for k, _ in pairs}) == len(pairs), "format")
    return dict(pairs)


def written_out(pieces):
    """The maps g f, where maps of finite order generate the group of the g, and the f are the other maps of a set."""
    maps, one = [op for _, op, _ in pieces], identity(len(pieces[0][1]))

    def finite(op):
        power = op
        for _ in range(12):
            if power == one:
                return True
            power = mul(power, op)
        return False

    turns, others = [op for op in maps if finite(op)], [op for op in maps if not finite(op)]
    if not turns or not others:
        return pieces
    group = [one]
    for g in group:
        for product in (mul(turn, g) for turn in turns):
            if product not in group:
                group.append(product)
        if len(group) > 48:
            return pieces
    products = []
    for product in (mul(g, f) for g in group for f in others):
        if product not in products:
            products.append(product)
    return [(0, op, False) for op in products] if len(products) <= 64 else pieces


class Case:
    def __init__(self, text):
        case = tomllib.loads(text, parse_float=lambda s: Q(s))
        number = lambda x: (lambda parts: Q(parts[0]) / Q(parts[1] if parts[1:] else 1))(str(x).split("/"))
        matrix = lambda m: [[number(x) for x in row] for row in m]
        operator = lambda m: transpose(matrix(m)) if case.get("convention") == "rows" else matrix(m)
        kind = {"curve": "edge", "set": "set"}[case.get("kind", "curve")]
        self.name, self.start = case["name"], 0
        if "map" in case:
            pieces = []
            for m in case["map"]:
                a, s = matrix(m["linear"]), [number(x) for x in m["shift"]]
                columns = [s] + [[s[i] + a[i][j] for i in range(len(s))] for j in range(len(s))]
                pieces.append((0, transpose([[1 - sum(c)] + c for c in columns]), m.get("reversed", False)))
            self.states = [(kind, written_out(pieces) if kind == "set" else pieces)]
        elif "pieces" in case:
            backwards = case.get("reversed", [])
            self.states = [(kind, [(0, operator(m), k in backwards) for k, m in enumerate(case["pieces"])])]
        else:
            names = [s["name"] for s in case["state"]]
            self.start = names.index(case["start"]) if "start" in case else 0
            piece = lambda p: (names.index(p["to"]), operator(p["matrix"]), p.get("reversed", False))
            self.states = [(s.get("kind", kind), [piece(p) for p in s["piece"]]) for s in case["state"]]
        self.dims = [len(pieces[0][1]) for _, pieces in self.states]
        given = [case.get("map")] if "map" in case else [s["piece"] for s in case["state"]] if "state" in case else []
        given = [[p.get("share") for p in pieces] for pieces in given] or [case.get("shares", [None])]
        self.shares = [None if set(row) == {None} else [number(x) for x in row] for row in given]
        for (kind, pieces), row in zip(self.states, self.shares):
            whole = row is None or kind == "edge" and len(row) == len(pieces) and all(x > 0 for x in row) and sum(row) == 1
            need(whole, "case")
        for e, (_, pieces) in enumerate(self.states):
            for target, op, _ in pieces:
                need(len(op) == self.dims[e] and len(op[0]) == self.dims[target], "case")
                need(all(sum(col) == 1 for col in zip(*op)), "case")
        self.view = identity(self.dims[self.start])
        if "map" in case:
            self.view = self.view[1:]
        if "control" in case:
            self.view = transpose(matrix(case["control"]))
        self.examine = [self.parse(e["address"]) for e in case.get("examine", [])]

    @staticmethod
    def parse(text):
        prefix, cycle = text.strip().rstrip(")").split("(")
        split = lambda part: [int(x) for x in (part.strip(",").split(",") if "," in text else part) if x.strip()]
        return split(prefix.strip()), split(cycle.strip())


def letter(addr, k):
    prefix, cycle = addr
    return prefix[k] if k < len(prefix) else cycle[(k - len(prefix)) % len(cycle)]


# ---- the model -------------------------------------------------------------------------------------------------------

class Model:
    def __init__(self, case, contraction):
        self.case, self.states = case, case.states
        self.reachable = [case.start]
        for e in self.reachable:
            self.reachable += [t for t in dict.fromkeys(p[0] for p in self.states[e][1]) if t not in self.reachable]
        self.base, self.basis, self.pivots, self.visible, self.radius, self.hull = {}, {}, {}, {}, {}, {}
        for e in self.reachable:
            self.base[e] = self.point(e, self.normalise(([], [0]), e))
        self.spaces()
        self.contract(contraction)
        for e in self.reachable:
            pieces = self.states[e][1]
            if self.states[e][0] == "edge":
                for a, b in zip(pieces, pieces[1:]):
                    ends = apply(a[1], self.end_point(a[0], not a[2]))
                    need(ends == apply(b[1], self.end_point(b[0], b[2])), "curve")

    def spaces(self):
        spans, rows = {}, {e: [] for e in self.reachable}
        for e in self.reachable:
            spans[e] = echelon([sub(apply(op, self.base[t]), self.base[e]) for t, op, _ in self.states[e][1]])[0]
        rows[self.case.start] = echelon(self.case.view)[0]
        size = None
        while size != (size := [(len(spans[e]), len(rows[e])) for e in self.reachable]):
            for e in self.reachable:
                for t, op, _ in self.states[e][1]:
                    if spans[t]:
                        spans[e] = echelon(spans[e] + mul(spans[t], transpose(op)))[0]
                    if rows[e]:
                        rows[t] = echelon(rows[t] + mul(rows[e], op))[0]
        for e in self.reachable:
            self.basis[e], self.pivots[e] = echelon(spans[e])
            on_v = mul(rows[e], transpose(self.basis[e], self.case.dims[e])) if self.basis[e] else []
            self.visible[e] = echelon(on_v)[0]

    def path(self, e, letters):
        states = [e]
        for k in letters:
            need(k < len(self.states[states[-1]][1]), "word")
            states.append(self.states[states[-1]][1][k][0])
        return states

    def product(self, e, letters):
        p, states = identity(self.case.dims[e]), self.path(e, letters)
        for k, s in zip(letters, states):
            p = mul(p, self.states[s][1][k][1])
        return p, states[-1]

    def orientation(self, e, letters):
        sign = 1
        for k, s in zip(letters, self.path(e, letters)):
            sign *= -1 if self.states[s][1][k][2] else 1
        return sign

    def point(self, e, addr):
        p, s = self.product(e, addr[0])
        m, back = self.product(s, addr[1])
        need(back == s, "word")
        return apply(p, fixed_point(m))

    def normalise(self, addr, e):
        length = len(addr[0]) + len(addr[1]) * (len(self.states) + 1)
        letters = [letter(addr, k) for k in range(3 * length)]
        pairs = list(zip(self.path(e, letters), letters))
        repeats = lambda start, p: pairs[start + p:] == pairs[start:3 * length - p]
        p = next(p for p in range(1, length + 1) if repeats(length, p))
        start = next(s for s in range(length + 1) if repeats(s, p))
        return letters[:start], letters[start:start + p]

    def linear(self, op, to, source):
        """Column k: the coordinates in V_to of op applied to basis vector k of V_source."""
        images = [apply(op, v) for v in self.basis[source]]
        return [[v[p] for v in images] for p in self.pivots[to]]

    def is_point(self, piece):
        return all(x == 0 for v in self.basis[piece[0]] for x in apply(piece[1], v))

    def end_address(self, e, finish, skip):
        seen, letters, at, side = [], [], e, finish
        while (at, side) not in seen:
            seen.append((at, side))
            order = range(len(self.states[at][1]))
            k = next((k for k in (reversed(order) if side else order) if not skip(self.states[at][1][k])), None)
            need(k is not None, "end")
            letters.append(k)
            target, _, backwards = self.states[at][1][k]
            at, side = target, side != backwards
        k = seen.index((at, side))
        return letters[:k], letters[k:]

    def end_point(self, e, finish):
        return self.point(e, self.end_address(e, finish, lambda p: False))

    def joints(self, e):
        solid = [k for k, p in enumerate(self.states[e][1]) if not self.is_point(p)]
        return list(zip(solid, solid[1:]))

    def contract(self, entries):
        need(len(entries) == len(self.reachable), "contraction")
        codes, hulls = [], []
        for entry, e in zip(entries, self.reachable):
            state, radius, code, hull = fields(entry, "state", "radius", "code", "hull")
            need(index(state, len(self.states)) == e and isinstance(code, (list, dict)), "contraction")
            self.radius[e], self.hull[e] = rational(radius), []
            codes.append((e, e, identity(self.case.dims[e]), code))
            hulls.append((e, hull))
        if all(isinstance(code, dict) for *_, code in codes):
            self.polytopes([(e, code) for e, _, _, code in codes], True)
            codes = []
        if all(hull == "simplex" for _, hull in hulls):
            # Columns of sum 1 without negative entries keep the simplices of the unit vectors.
            need(all(x >= 0 for e, _ in hulls for p in self.states[e][1] for row in p[1] for x in row), "hull")
            self.hull = {e: identity(self.case.dims[e]) for e, _ in hulls}
        elif any(hull is not None for _, hull in hulls):
            self.polytopes(hulls, False)
        while codes:
            start, e, op, tree = codes.pop()
            if tree == ".":
                columns = list(zip(*op))
                norm = lambda v: sum(map(abs, v), Q(0))
                tau = max((norm(sub(a, b)) for a in columns for b in columns), default=Q(0)) / 2
                shift = norm(sub(apply(op, self.base[e]), self.base[start]))
                need(tau < 1 and shift + tau * self.radius[e] <= self.radius[start], "contraction")
            else:
                pieces = self.states[e][1]
                need(isinstance(tree, list) and len(tree) == len(pieces), "contraction")
                codes += [(start, t, mul(op, piece), child) for (t, piece, _), child in zip(pieces, tree)]

    def reading(self, e):
        """Reads the coordinates of a vector of the relevant space."""
        return [[Q(int(p == j)) for j in range(self.case.dims[e])] for p in self.pivots[e]]

    def own_view(self, e):
        return mul(self.visible[e], self.reading(e))

    def polytopes(self, hulls, shrinking):
        """Hulls that are mapped into one another; with a share in common in all images they prove contraction (Lemma 1')."""
        for e, hull in hulls:
            self.hull[e] = [vector(v, self.case.dims[e]) for v in fields(hull, "points", "images")[0]]
            need(self.hull[e] and all(sum(v) == 1 for v in self.hull[e]), "hull")
        for e, hull in hulls:
            need(self.states[e][1] and len(hull["images"]) == len(self.states[e][1]), "hull")
            for (target, op, _), images in zip(self.states[e][1], hull["images"]):
                need(len(images) == len(self.hull[target]), "hull")
                common = set(range(len(self.hull[e])))
                for v, terms in zip(self.hull[target], images):
                    pairs = [fields(term, "vertex", "weight") for term in terms]
                    need(all(a[0] < b[0] for a, b in zip(pairs, pairs[1:])), "hull")
                    common &= {k for k, _ in pairs}
                    pairs = [(rational(w), self.hull[e][index(k, len(self.hull[e]))]) for k, w in pairs]
                    need(all(w > 0 for w, _ in pairs) and sum(w for w, _ in pairs) == 1, "hull")
                    need(apply(op, v) == [sum(w * x[i] for w, x in pairs) for i in range(len(op))], "hull")
                need(common or not shrinking, "contraction")
            if shrinking:
                need(len(echelon(self.hull[e])[0]) == self.case.dims[e], "contraction")
                away = max(sum(map(abs, sub(v, self.base[e])), Q(0)) for v in self.hull[e])
                need(away <= self.radius[e], "contraction")

    def on_visible(self, e, piece):
        onto = mul(self.visible[e], self.linear(piece[1], e, piece[0])) if self.visible[e] else []
        _, pivots = echelon(self.visible[piece[0]])
        return [[row[p] for p in pivots] for row in onto], len(pivots)


class Germ:
    def __init__(self, model, root, view, addr):
        self.model = model
        prefix, e = model.product(root, addr[0])
        cycle, back = model.product(e, addr[1])
        need(back == e and addr[1], "word")
        self.state, self.fixed = e, fixed_point(cycle)
        on_v = mul(mul(view, prefix), transpose(model.basis[e], model.case.dims[e]))
        linear_v = model.linear(cycle, e, e)
        rows, pivots = grow(on_v, linear_v)
        self.n = len(pivots)
        need(self.n > 0, "germ")
        pick = lambda m: [[row[p] for p in pivots] for row in m]
        self.linear, self.view = pick(mul(rows, linear_v)), pick(on_v)
        self.chart = mul(rows, model.reading(e))
        self.turn = model.orientation(e, addr[1]) if model.states[e][0] == "edge" else 1
        self.prefix = model.orientation(root, addr[0])
        self.falls = power(self.linear, self.n)
        self.ring = self.find_ring(addr[1])

    def coordinates(self, x):
        return apply(self.chart, sub(x, self.fixed))

    def find_ring(self, cycle):
        model, kept, product, at, forward = self.model, [], identity(self.model.case.dims[self.state]), self.state, True
        for i, turn in enumerate(cycle):
            kind, pieces = model.states[at]
            level = []
            for j, piece in enumerate(pieces):
                op = mul(product, piece[1])
                position = 0 if kind != "edge" else -1 if (j < turn) == forward else 1
                repeated = position == 0 and (piece[:2] == pieces[turn][:2] or (piece[0], op) in level)
                image = apply(op, model.base[piece[0]])
                if j == turn or repeated or (model.is_point(piece) and image == self.fixed):
                    continue
                level.append((piece[0], op))
                vectors = [self.coordinates(image)] + [apply(self.chart, apply(op, v)) for v in model.basis[piece[0]]]
                if any(x != 0 for v in vectors for x in apply(self.falls, v)):
                    kept.append((cycle[:i] + [j], piece[0], position))
            product, at, forward = mul(product, pieces[turn][1]), pieces[turn][0], forward != pieces[turn][2]
        return kept

    def functional(self, field, row):
        """The row on points and its error."""
        middle, error = [], Q(0)
        for g, chart in zip(row, self.chart):
            lo, hi = field.value(g)
            middle.append((lo + hi) / 2)
            error += (hi - lo) / 2 * (max(chart) - min(chart)) * self.model.radius[self.state]
        return self.on_points(middle), error

    def on_points(self, on_y):
        row = mul([on_y], self.chart)[0]
        at_fixed = apply([row], self.fixed)[0]
        return [x - at_fixed for x in row]

    def enclose(self, f, e):
        row, error = f
        centre = apply([row], self.model.base[e])[0]
        spread = (max(row) - min(row)) / 2 * self.model.radius[e] + error
        lo, hi = centre - spread, centre + spread
        values = [apply([row], v)[0] for v in self.model.hull[e]]
        return (max(lo, min(values) - error), min(hi, max(values) + error)) if values else (lo, hi)

    def moved(self, f, letters):
        op, e = self.model.product(self.state, letters)
        return (mul([f[0]], op)[0], f[1]), e

    def placed_point(self, value):
        """The coordinates of a point of the ring, and the part of the ring where it lies."""
        addr = address(value)
        letters = [letter(addr, k) for k in range(max((len(w) for w, _, _ in self.ring), default=0))]
        parts = [part for w, _, part in self.ring if letters[:len(w)] == w]
        need(parts, "ring")
        return self.coordinates(self.model.point(self.state, addr)), parts[0]

    def group(self, radius, rows, cover):
        """Rows that read the eigenvalues of modulus above a radius, and have no common zero on the ring: their span."""
        r, rows = rational(radius), [vector(v, self.n) for v in rows]
        need(r > 0 and rows, "disc")
        space, pivots = echelon(rows)
        images = mul(space, self.linear)
        inner = [[v[p] for p in pivots] for v in images]
        need(mul(inner, space) == images, "group")
        outside = lambda m: len(m) - inside([c * r ** k for k, c in enumerate(characteristic(m))])
        need(len(space) == outside(self.linear) == outside(inner), "group")
        self.cover([(self.on_points(v), Q(0)) for v in rows], cover)
        return space, pivots

    def cover(self, functionals, items, part=None):
        pieces_seen = [piece for piece in self.ring if part in (None, piece[2])]
        need(isinstance(items, list) and len(items) == len(pieces_seen), "cover")
        # Where nothing is covered, or by nothing, no leaf says anything.
        need(pieces_seen and functionals, "cover")
        cells = []
        for item, (piece, end, position) in zip(items, pieces_seen):
            letters, tree = fields(item, "piece", "cells")
            need(word(letters) == piece, "cover")
            stack = [([self.moved(f, piece)[0] for f in functionals], end, tree)]
            while stack:
                rows, e, tree = stack.pop()
                if isinstance(tree, str):
                    names = {s + str(k): (k, v) for k in range(len(rows)) for s, v in (("+", 1), ("-", -1))}
                    need(tree in names, "cover")
                    k, sign = names[tree]
                    need(i_sign(self.enclose(rows[k], e)) == sign, "cover")
                    cells.append((position, sign, k))
                else:
                    pieces = self.model.states[e][1]
                    need(isinstance(tree, list) and len(tree) == len(pieces), "cover")
                    stack += [([(mul([r], p[1])[0], err) for r, err in rows], p[0], t) for p, t in zip(pieces, tree)]
        return cells


# ---- the top of a spectrum -------------------------------------------------------------------------------------------

class Top:
    def __init__(self, value, linear):
        n = self.n = len(linear)
        kind = self.kind = value.get("top") if isinstance(value, dict) else None
        names = {"real": ["polynomial", "interval", "chains"], "pair": ["polynomial", "centre", "error", "vectors"],
                 "conformal": ["basis", "gram", "square"]}
        need(kind in names, "format")
        _, radius, *rest = fields(value, "top", "radius", *names[kind])
        r = rational(radius)
        need(r > 0, "disc")
        count = n - inside([c * r ** k for k, c in enumerate(characteristic(linear))])
        # A top without eigenvalues would have nothing to prove.
        need(count > 0, "disc")
        getattr(self, kind)(linear, r, count, *rest)

    def real(self, linear, r, count, m, interval, chains):
        f = self.field = Field(poly(m, 65), tuple(vector(interval, 2)))
        need(f.interval[0] > r or f.interval[1] < -r, "top-real")
        self.chains = []
        for chain in chains:
            sign, vectors = fields(chain, "sign", "vectors")
            need(sign in ("+", "-"), "format")
            sign = 1 if sign == "+" else -1
            self.chains.append((sign, f.chain(linear, sign, vectors, "top-real")))
        need(sum(len(v) for _, v in self.chains) == count, "top-real")
        for s in (1, -1):
            starts = [[f.value(x) for x in v[0]] for t, v in self.chains if t == s]
            need(len(starts) <= 2, "top-real")
            need(len(starts) != 1 or any(map(i_sign, starts[0])), "top-real")
            need(len(starts) != 2 or not_parallel(*starts), "top-real")

    def pair(self, linear, r, count, m, centre, error, vectors):
        ring, (x, y), e = Ring(poly(m, 65)), vector(centre, 2), rational(error)
        need(y > e > 0 and x * x + y * y > (r + e) ** 2 and root_near(ring.m, (x, y), e), "top-pair")
        self.ring, self.vectors = ring, ring.chain(linear, 1, vectors, "top-pair")
        self.value = ((x - e, x + e), (y - e, y + e))
        need(2 * len(self.vectors) == count, "top-pair")
        need(any(map(i_sign, sum(self.directions(identity(self.n)), []))), "top-pair")

    def conformal(self, linear, r, count, basis, gram, square):
        rows, s = [vector(v, self.n) for v in basis], rational(square)
        reduced, pivots = echelon(rows)
        need(reduced == rows and len(rows) == count, "top-conformal")
        images = mul(rows, transpose(linear))
        b = [[v[p] for p in pivots] for v in images]
        need(mul(b, rows) == images, "top-conformal")
        h = positive(gram, count)
        need(s > r * r and mul(mul(b, h), transpose(b)) == [[s * x for x in row] for row in h], "top-conformal")
        self.basis = rows

    def directions(self, view):
        if self.kind == "real":
            longest = max(len(v) for _, v in self.chains)
            ends = [v[0] for _, v in self.chains if len(v) == longest]
            return [[self.field.value(weighted(row, v)) for row in view] for v in ends]
        if self.kind == "pair":
            values = [horner_complex(weighted(row, self.vectors[0]), self.value) for row in view]
            return [[z[0] for z in values], [z[1] for z in values]]
        return [[(x, x) for x in apply(view, v)] for v in self.basis]


def positive(gram, n):
    rows = h = [vector(v, n) for v in gram]
    need(len(h) == n and transpose(h) == h, "gram")
    rows = [list(r) for r in rows]
    for k in range(n):
        need(rows[k][k] > 0, "gram")
        for i in range(k + 1, n):
            factor = rows[i][k] / rows[k][k]
            rows[i] = [x - factor * p for x, p in zip(rows[i], rows[k])]
    return h


def linked(model, start, lists):
    """Pairs of addresses of one point join the pieces of each state that is reached: its attractor is connected."""
    order = [start]
    for e in order:
        order += [t for t in dict.fromkeys(p[0] for p in model.states[e][1]) if t not in order]
    need(isinstance(lists, list) and len(lists) == len(order), "links")
    for e, pairs in zip(order, lists):
        part = list(range(len(model.states[e][1])))
        for pair in pairs:
            a, b = (address(x) for x in pair)
            need(model.point(e, a) == model.point(e, b), "links")
            old, new = part[letter(b, 0)], part[letter(a, 0)]
            part = [new if p == old else p for p in part]
        need(len(set(part)) == 1, "links")


# ---- rules for a branch ----------------------------------------------------------------------------------------------

class Line:
    def __init__(self, germ, field, v, left=(), right=()):
        self.field, self.left, self.right, self.exact = field, list(left), list(right), True
        self.vector = [weighted(row, v) for row in germ.view]
        self.values = [field.value(x) for x in self.vector]
        need(any(map(i_sign, self.values)), "line")

    def relation(self, w):
        for i in range(len(w)):
            for j in range(i):
                need(self.field.mul(self.vector[i], w[j]) == self.field.mul(self.vector[j], w[i]), "line")
        signs = [i_sign(x) * i_sign(self.field.value(y)) for x, y in zip(self.values, w)]
        return next((s for s in signs if s), None)


class Branch:
    def __init__(self, germ):
        self.germ = germ

    def check(self, value):
        rules = {
            "theorem-2": ["top", "functional", "cover"], "theorem-3": ["top", "functional", "cover"],
            "corollary-line": [], "corollary": ["top"], "null-point": ["top", "functional", "address"],
            "sign-change": ["top", "functional", "isolation", "positive", "negative"],
            "orbit": ["top", "address", "own"], "direction": ["top"],
            "crossing": ["top", "second", "first", "positive", "negative", "cover"],
            "leading-sign": ["top", "functional", "radius", "rows", "cover", "positive", "negative", "links"]}
        rule = value.get("rule") if isinstance(value, dict) else None
        need(rule in rules, "format")
        _, *rest = fields(value, "rule", *rules[rule])
        if rest:
            rest[0] = Top(rest[0], self.germ.linear)
        return getattr(self, rule.replace("-", "_"))(*rest)

    def leading(self, top):
        need(top.kind == "real", "leading")
        length = max(len(v) for _, v in top.chains)
        longest = [k for k, (_, v) in enumerate(top.chains) if len(v) == length]
        need(len(longest) == 1, "leading")
        self.field, self.longest, self.length = top.field, longest[0], length
        self.sign, self.vectors = top.chains[longest[0]]
        self.eigenvalue_sign = self.sign * i_sign(top.field.interval)

    def residual(self, row):
        theta = self.field.theta(self.sign)
        columns = transpose(self.germ.linear)
        return [combine(weighted(c, row), -1, self.field.mul(theta, g)) for c, g in zip(columns, row)]

    def row(self, items):
        need(isinstance(items, list) and len(items) == self.germ.n, "format")
        return self.field.vector(items, self.germ.n)

    def leading_row(self, top, items):
        self.leading(top)
        row = self.row(items)
        need(not any(self.residual(row)), "leading")
        for k, (_, v) in enumerate(top.chains):
            need(k == self.longest or not self.field.dot(row, v[-1]), "leading")
        self.pairing = i_sign(self.field.value(self.field.dot(row, self.vectors[-1])))
        need(self.pairing != 0, "leading")
        return row

    def theorem_2(self, top, functional, cover, length=1):
        row, germ = self.leading_row(top, functional), self.germ
        need((self.length == 1) == (length == 1), "theorem")
        parity = self.eigenvalue_sign if self.length % 2 == 0 else 1
        rays = {-1: [], 1: []}
        for position, sign, _ in germ.cover([germ.functional(self.field, row)], cover):
            for m in (0, 1):
                side = (position or 1) * germ.turn ** m * germ.prefix
                ray = sign * self.pairing * parity * self.eigenvalue_sign ** m
                if ray not in rays[side]:
                    rays[side].append(ray)
        return Line(germ, self.field, self.vectors[0], rays[-1], rays[1])

    def theorem_3(self, top, functional, cover):
        return self.theorem_2(top, functional, cover, length=2)

    def corollary_line(self):
        need(self.germ.n == 1 and self.germ.linear[0][0] != 0, "corollary-line")
        return Line(self.germ, Field([Q(0), Q(1)], (Q(0), Q(0))), [[Q(1)]])

    def corollary(self, top):
        plane(top.directions(self.germ.view), "corollary")

    def injective(self):
        need(len(echelon(self.germ.view)[1]) == self.germ.n, "injective")

    def null_point(self, top, functional, addr):
        row, y = self.leading_row(top, functional), self.germ.placed_point(addr)[0]
        need(self.length == 1 and not weighted(y, row) and any(apply(self.germ.falls, y)), "null-point")
        self.injective()

    def changing_part(self, row, positive_point, negative_point):
        parts = []
        for value, sign in ((positive_point, 1), (negative_point, -1)):
            y, part = self.germ.placed_point(value)
            need(i_sign(self.field.value(weighted(y, row))) == sign, "sign-change")
            parts.append(part)
        need(parts[0] == parts[1] != 0, "sign-change")
        return parts[0]

    def sign_change(self, top, functional, isolation, positive_point, negative_point):
        row, germ = self.leading_row(top, functional), self.germ
        need(self.length == 1, "sign-change")
        self.changing_part(row, positive_point, negative_point)
        germ.cover([(germ.on_points(r), Q(0)) for r in echelon(germ.falls)[0]], isolation)
        self.injective()

    def leading_sign(self, top, functional, radius, rows, cover, positive_point, negative_point, links):
        row, germ, model = self.leading_row(top, functional), self.germ, self.germ.model
        if links is None:
            self.changing_part(row, positive_point, negative_point)
        else:
            pieces = []
            for value, sign in ((positive_point, 1), (negative_point, -1)):
                y, addr = germ.placed_point(value)[0], address(value)
                need(i_sign(self.field.value(weighted(y, row))) == sign, "sign-change")
                pieces.append(next(p for p in germ.ring if [letter(addr, k) for k in range(len(p[0]))] == p[0]))
            need(pieces[0][0] == pieces[1][0], "sign-change")
            linked(model, pieces[0][1], links)
        space, pivots = germ.group(radius, rows, cover)
        # The sum of the eigenspaces outside is the image of the characteristic polynomial of L on the common kernel.
        image, free = identity(germ.n), [k for k in range(germ.n) if k not in pivots]
        if free:
            kernel = []
            for j in free:
                v = [Q(int(k == j)) for k in range(germ.n)]
                for s, p in zip(space, pivots):
                    v[p] = -s[j]
                kernel.append(v)
            own = transpose([[apply(germ.linear, v)[j] for j in free] for v in kernel])
            image = [[Q(0)] * germ.n for _ in range(germ.n)]
            for c in reversed(characteristic(own)):
                image = mul(image, germ.linear)
                for k in range(germ.n):
                    image[k][k] += c
        need(len(echelon(mul(germ.view, image))[0]) == len(space), "leading-sign")

    def direction(self, top):
        self.leading(top)
        line = Line(self.germ, self.field, self.vectors[0])
        line.exact = False
        return line

    def orbit(self, top, addr, own):
        y, _ = self.germ.placed_point(addr)
        hull, pivots = grow([y], transpose(self.germ.linear))
        need(hull, "orbit")
        images = mul(hull, transpose(self.germ.linear))
        own = Top(own, [[images[j][p] for j in range(len(hull))] for p in pivots])
        plane(top.directions(self.germ.view) + own.directions(mul(self.germ.view, transpose(hull))), "orbit")

    def crossing(self, top, second, first, positive_point, negative_point, cover):
        c2, germ = self.leading_row(top, second), self.germ
        need(len(top.chains) == 1 and self.length == 2, "crossing")
        c1 = self.row(first)
        need(self.residual(c1) == c2, "crossing")
        part = self.changing_part(c2, positive_point, negative_point)
        cells = germ.cover([germ.functional(self.field, c) for c in (c2, c1)], cover, part)
        need(len({sign for _, sign, k in cells if k == 1}) == 1, "crossing")
        plane([[self.field.value(weighted(r, v)) for r in germ.view] for v in self.vectors], "crossing")


# ---- points and answers ----------------------------------------------------------------------------------------------

def hidden_between(model, root, view, path, state, pair):
    """Whether all pieces between two, which are more than points, are single points where they are looked at."""
    pieces, (left, right) = model.states[state][1], pair
    if not left < right < len(pieces) or any(model.is_point(pieces[k]) for k in pair):
        return False
    seen = mul(view, model.product(root, path)[0])
    images = [apply(mul(seen, op), v) for target, op, _ in pieces[left + 1:right] for v in model.basis[target]]
    return not any(x for v in images for x in v)


def branches_of(model, root, view, place):
    at = place.get("at") if isinstance(place, dict) else None
    skip = model.is_point
    if at in ("left end", "right end"):
        fields(place, "at")
        return [("right" if at == "left end" else "left", model.end_address(root, at == "right end", skip))]
    if at == "joint":
        _, path, left, right = fields(place, "at", "path", "left", "right")
        path, state = word(path), model.path(root, word(path))[-1]
        pair = (index(left, 64), index(right, 64))
        need(pair in model.joints(state) or hidden_between(model, root, view, path, state, pair), "joint")
        branches = []
        for k, finish in ((left, True), (right, False)):
            target, _, backwards = model.states[state][1][k]
            prefix, cycle = model.end_address(target, finish != backwards, skip)
            branches.append((path + [k] + prefix, cycle))
        if model.orientation(root, path) < 0:
            branches.reverse()
        return list(zip(("left", "right"), branches))
    need(at in ("inside", "of set"), "format")
    addr = address(fields(place, "at", "address")[1])
    need(model.normalise(addr, root) == addr and place_of(model, addr, root) == place, "place")
    return [("both", addr)]


def check_point(model, root, view, value):
    place, verdict, kind, rule, common, items = fields(value, "place", "verdict", "kind", "rule", "common", "branches")
    addresses = branches_of(model, root, view, place)
    need(len(addresses) == len(items), "point")
    found = [(side, item and (Branch(Germ(model, root, view, a)).check(item) or "plane"))
             for (side, a), item in zip(addresses, items)]
    lines = [line for _, line in found if isinstance(line, Line)]
    if rule == "plane":
        need([f for _, f in found if f is not None] == ["plane"] and common is None, "plane")
        conclusion = ("refuted", "none")
    elif rule == "differ":
        need(len(lines) == 2 == len(found) and common is None and not_parallel(lines[0].values, lines[1].values), "differ")
        single = len(lines[0].left) == 1 == len(lines[1].right) and lines[0].exact and lines[1].exact
        conclusion = ("refuted", "corner" if single else "none")
    else:
        need(rule == "line" and len(lines) == len(found) and all(line.exact for line in lines), "point")
        left, right, factors = [], [], [1]
        if common is None:
            need(len(lines) == 1, "line")
        elif all(isinstance(x, str) for x in common):
            common = vector(common, len(view))
            factors = [line.relation([trim([x]) for x in common]) for line in lines]
        else:
            need(len(common) == len(view), "format")
            numbers = [fields(x, "polynomial", "interval", "elements") for x in common]
            numbers = [(Field(poly(m, 65), tuple(vector(i, 2))), elements) for m, i, elements in numbers]
            need(all(len(elements) == len(lines) for _, elements in numbers), "format")
            for k, line in enumerate(lines):
                w = line.field.vector([elements[k] for _, elements in numbers], len(view))
                need(all(line.field.equals(x, y) for (x, _), y in zip(numbers, w)), "line")
                factors = factors[:k] + [line.relation(w)]
            common = None
        for (side, line), factor in zip(found, factors):
            need(factor, "line")
            left += [s * factor for s in line.left] if side != "right" else []
            right += [s * factor for s in line.right] if side != "left" else []
        sizes, at = (len(left), len(right)), place["at"]
        if 2 in sizes:
            name = "oscillating"
        elif sum(sizes) == 1 and at in ("left end", "right end", "of set"):
            name = "half-tangent"
        else:
            name = ("cusp" if left == right else "regular") if sizes == (1, 1) else "none"
        conclusion = ("proved", name)
    need((verdict, kind) == conclusion, "point")
    return Point(place, verdict, kind, common)


Point = namedtuple("Point", "place verdict kind common")


def place_of(model, addr, root):
    states = model.path(root, addr[0])
    if any(model.states[e][0] != "edge" for e in states + model.path(states[-1], addr[1])):
        return {"at": "of set", "address": {"prefix": addr[0], "cycle": addr[1]}}

    def is_end(side):
        at = states[-1]
        for k in addr[1] * 2:
            pieces = model.states[at][1]
            if not all(model.is_point(p) for p in (pieces[k + 1:] if side else pieces[:k])):
                return False
            at, side = pieces[k][0], side != pieces[k][2]
        return True

    side = next((s for s in (False, True) if is_end(s)), None)
    if side is None:
        return {"at": "inside", "address": {"prefix": addr[0], "cycle": addr[1]}}
    for k in reversed(range(len(addr[0]))):
        pieces = model.states[states[k]][1]
        side = side != pieces[addr[0][k]][2]
        if model.is_point(pieces[addr[0][k]]):
            before, after = ([p for p in part if not model.is_point(p)]
                             for part in (pieces[:addr[0][k]], pieces[addr[0][k] + 1:]))
            if bool(before) == bool(after):
                return {"at": "inside", "address": {"prefix": addr[0], "cycle": addr[1]}}
            side = bool(before)
        for left, right in model.joints(states[k]):
            if addr[0][k] == (left if side else right):
                return {"at": "joint", "path": addr[0][:k], "left": left, "right": right}
    return {"at": "right end" if side else "left end"}


def envelope(value):
    return fields(value, "format", "version", "kind", "case", "verdict", "proof")


DERIVATIVE = "every point by its derivative"
SHARES = "every point by its derivative in shares"
ARCS = "every point by polynomials"
COMPONENTS = "every point by components"
NOT_KILLED = "joints not killed"


class Certificate:
    def __init__(self, case, value):
        form, version, of_kind, name, verdict, proof = envelope(value)
        contraction, points, answers = fields(proof, "contraction", "points", "answers")
        need(of_kind == "certify", "format")
        need(form == "secant certificate" and version == 1 and name == case.name, "format")
        self.case, self.model = case, Model(case, contraction)
        self.points = [check_point(self.model, case.start, case.view, p) for p in points]
        places = [p[0] for p in self.points]
        need(all(p not in places[:k] for k, p in enumerate(places)), "points")
        self.used, self.lines = set(), []
        found = [self.answer(q, a) for q, a in zip(self.questions(answers), answers)]
        found = [verdict for verdict in found if verdict is not None]
        need(self.used == set(range(len(points))), "points")
        self.verdict = self.together(found)
        need(verdict == self.verdict, "verdict")

    @staticmethod
    def together(verdicts):
        if "refuted" in verdicts:
            return "refuted"
        return "proved" if verdicts and set(verdicts) == {"proved"} else "undetermined"

    def questions(self, answers):
        kind, pieces = self.model.states[self.case.start]
        asked = [self.model.normalise(a, self.case.start) for a in self.case.examine]
        own = [([], [k]) for k, p in enumerate(pieces) if p[0] == self.case.start]
        asked = (["ends", "joints"] if kind == "edge" else own) + asked
        asked = [a for k, a in enumerate(asked) if a not in asked[:k]]
        need(len(answers) >= len(asked), "answers")
        for k in range(len(asked), len(answers)):
            question = answers[k].get("question")
            if question in ("every point", DERIVATIVE, SHARES, ARCS, COMPONENTS, NOT_KILLED):
                need(question not in asked and (question != NOT_KILLED or kind == "edge"), "answers")
            elif k + 1 < len(answers) or question != "any point":
                question = address(answers[k].get("address"))
                normal = self.model.normalise(question, self.case.start)
                need(normal == question and question not in asked, "answers")
            asked.append(question)
        return asked

    def select(self, items):
        chosen = [index(k, len(self.points)) for k in items]
        need(chosen == sorted(set(chosen)), "answers")
        self.used |= set(chosen)
        return [self.points[k] for k in chosen]

    def answer(self, question, value):
        if question == "joints":
            what, verdict, theorem, items, upstairs = fields(value, "question", "verdict", "theorem", "points", "upstairs")
            found, text = self.joints(theorem, self.select(items), upstairs), "joints, theorem " + theorem
        elif question == "every point":
            what, verdict, *rest = fields(value, "question", "verdict", "cones", "maps", "view", "window", "slow", "rate",
                                          "joints", "witness")
            need(verdict == Cones(self.model, self.points, self.used).check(*rest), "answers")
            self.lines.append(f"{verdict}: every point")
            return None
        elif question == NOT_KILLED:
            what, verdict, theorem, upstairs = fields(value, "question", "verdict", "theorem", "upstairs")
            need(verdict == "proved" and theorem in ("5'", "11'") and upstairs != [], "joints")
            if theorem == "11'":
                Frames(self.model, False).check(upstairs)
            else:
                self.injective()
                self.upstairs(upstairs)
            self.lines.append("proved: joints not killed, theorem " + theorem)
            return None
        elif question in (DERIVATIVE, SHARES):
            keys = ("shares", "radius") if question == SHARES else ("radius",)
            what, verdict, *shares, radius = fields(value, "question", "verdict", *keys)
            import check_radii
            try:
                check_radii.graph(self.model, radius, *shares)
            except Exception:  # that module has its own copy of this one, and of its exceptions
                need(False, "graph")
            need(verdict == "proved", "answers")
            self.lines.append("proved: every point, by its derivative")
            return None
        elif question in (ARCS, COMPONENTS):
            keys = ("degree", "arcs") if question == ARCS else ("parts", "seen")
            what, verdict, *evidence = fields(value, "question", "verdict", *keys)
            import check_turns
            try:
                found = check_turns.arcs(self.model, *evidence) if question == ARCS else None
                if question == COMPONENTS:
                    check_turns.Parts(self.model).check(*evidence)
            except Exception:  # as above
                need(False, "components")
            need(verdict == (found or "proved"), "answers")
            self.lines.append(f"{verdict}: {question}")
            return None
        elif question == "any point":
            what, verdict, products = fields(value, "question", "verdict", "products")
            found, text = self.similarities(products), "any point"
        else:
            if question == "ends":
                what, verdict, items = fields(value, "question", "verdict", "points")
                places, text = [{"at": "left end"}, {"at": "right end"}], "ends"
            else:
                what, of, verdict, items = fields(value, "question", "address", "verdict", "points")
                need(address(of) == question, "answers")
                places, text, question = [place_of(self.model, question, self.case.start)], f"address {question}", "address"
            chosen = self.select(items)
            need(all(p[0] in places for p in chosen), "answers")
            found = self.together([p[1] for p in chosen])
            if found == "proved" and len(chosen) < len(places):
                found = "undetermined"
        need((what, verdict) == (question, found), "answers")
        self.lines.append(f"{found}: {text}")
        return found

    def joints(self, theorem, chosen, upstairs):
        model, start = self.model, self.case.start
        need(all(p[0]["at"] == "joint" for p in chosen), "joints")
        need(theorem in ("5'", "11", "11'") or upstairs == [], "joints")
        verdicts = [p[1] for p in chosen]
        if theorem == "none":
            return "refuted" if "refuted" in verdicts else "undetermined"
        need(theorem in ("5", "5'", "11", "11'") and chosen and set(verdicts) == {"proved"}, "joints")
        if theorem in ("11", "11'"):
            Frames(model, theorem == "11").check(upstairs)
            return "proved"
        need(self.required() == {(model.path(start, p["path"])[-1], p["left"], p["right"]) for p, *_ in chosen}, "joints")
        self.injective()
        if theorem == "5":
            on_v = mul(self.case.view, transpose(model.basis[start], len(self.case.view[0])))
            need(len(echelon(on_v)[1]) == len(model.visible[start]), "joints")
            return "proved"
        self.upstairs(upstairs)
        return "proved"

    def required(self):
        return {(e, *pair) for e in self.model.reachable for pair in self.model.joints(e)}

    def injective(self):
        for e in self.model.reachable:
            for piece in self.model.states[e][1]:
                rows, width = self.model.on_visible(e, piece)
                need(len(echelon(rows)[1]) == width, "joints")

    def upstairs(self, upstairs):
        model, required = self.model, self.required()
        listed, spans = [], {e: [] for e in model.reachable}
        for item in upstairs:
            e, point = fields(item, "state", "point")
            need(index(e, len(model.states)) in model.reachable, "joints")
            place, verdict, _, common = check_point(model, e, model.own_view(e), point)
            need(place["at"] == "joint" and place["path"] == [] and verdict == "proved", "joints")
            listed.append((e, place["left"], place["right"]))
            spans[e] += [common] if common is not None else []
        need(len(set(listed)) == len(listed) and set(listed) == required, "joints")
        size = None
        while size != (size := [len(spans[e]) for e in model.reachable]):
            for e in model.reachable:
                for piece in model.states[e][1]:
                    if spans[piece[0]]:
                        spans[e] = spans[e] + mul(spans[piece[0]], transpose(model.on_visible(e, piece)[0]))
                spans[e] = echelon(spans[e])[0]
        need(all(len(spans[e]) == len(model.visible[e]) for e in model.reachable), "joints")

    def similarities(self, products):
        model = self.model
        need(len(products) == len(model.reachable), "similarities")
        h = {e: positive(p, len(model.basis[e])) for e, p in zip(model.reachable, products)}
        for e in model.reachable:
            need(len(model.basis[e]) >= 2, "similarities")
            for target, op, _ in model.states[e][1]:
                linear = model.linear(op, e, target)
                pulled = mul(mul(transpose(linear), h[e]), linear)
                ratio = pulled[0][0] / h[target][0][0]
                need(ratio > 0 and pulled == [[ratio * x for x in row] for row in h[target]], "similarities")
        on_v = mul(self.case.view, transpose(model.basis[self.case.start]))
        need(len(echelon(on_v)[1]) == len(model.basis[self.case.start]), "similarities")
        return "refuted"


# ---- frames: Theorems 11, 11' and 11'' --------------------------------------------------------------------------------

class Frames:
    """Joints of shapes that start somewhere. A frame is a state with the echelon rows, on V, of what is seen of it."""

    def __init__(self, model, every):
        self.model, self.every = model, every
        need(all(model.states[e][0] == "edge" for e in model.reachable), "frames")

    def behind(self, frame, k):
        e, rows = frame
        target, op, _ = self.model.states[e][1][k]
        return target, echelon(mul(rows, self.model.linear(op, e, target)))[0] if rows else []

    def joints(self, frame):
        kept = [k for k in range(len(self.model.states[frame[0]][1])) if self.behind(frame, k)[1]]
        return list(zip(kept, kept[1:]))

    def view(self, frame):
        """The rows on the coordinates of the state."""
        e, rows = frame
        out = [[Q(0)] * self.model.case.dims[e] for _ in rows]
        for new, row in zip(out, rows):
            for p, x in zip(self.model.pivots[e], row):
                new[p] = x
        return out

    def below(self, e):
        found, open_ = set(), [e]
        while open_:
            for target, *_ in self.model.states[open_.pop()][1]:
                if target not in found:
                    found.add(target)
                    open_.append(target)
        return found

    def family(self, frame, states):
        found = {e: [] for e in states}
        found[frame[0]], size = frame[1], None
        while size != (size := [len(found[e]) for e in states]):
            for e in states:
                for k in range(len(self.model.states[e][1])):
                    target, rows = self.behind((e, found[e]), k)
                    if target in found:
                        found[target] = echelon(found[target] + rows)[0]
        return [(e, found[e]) for e in states]

    def check(self, items):
        model = self.model
        on_v = mul(model.case.view, transpose(model.basis[model.case.start], len(model.case.view[0])))
        open_, count = [(model.case.start, echelon(on_v)[0])], 0
        need(open_[0][1], "frames")
        for frame in open_:
            need(len(open_) <= 200, "limit")
            need(len(items) >= len(open_), "frames")
            joints, exits = self.frame(frame, items[open_.index(frame)])
            count += joints
            for further in exits:
                if further[1] and further not in open_:
                    open_.append(further)
        need(len(items) == len(open_) and count > 0, "frames")

    def frame(self, frame, item):
        model = self.model
        state, joints, cones = fields(item, "state", "joints", "cones")
        e = frame[0]
        need(index(state, len(model.states)) == e, "frames")
        ahead = self.below(e)
        own = [f for f in model.reachable if f in ahead and e in self.below(f)]
        component = self.family(frame, own) if own else [frame]
        ranks = {f: len(rows) for f, rows in component}
        good = ranks[e] == len(frame[1]) and all(
            len(self.behind(f, k)[1]) == ranks[p[0]]
            for f in component for k, p in enumerate(model.states[f[0]][1]) if p[0] in own)
        if not own or good:
            need(cones is None, "frames")
            count, _ = self.examined(component, joints)
            return count, [self.behind(f, k) for f in component for k, p in enumerate(model.states[f[0]][1])
                           if p[0] not in own]
        states = [f for f in model.reachable if f in ahead]
        family = self.family(frame, states)
        count, lines = self.examined(family, joints)
        if cones is None:
            need(not self.every, "frames")
            self.spans(family, lines)
        else:
            self.in_sight(frame, states, cones)
        return count, []

    def examined(self, family, items):
        wanted = [(f, pair) for f in family for pair in self.joints(f)]
        lines = {f[0]: [] for f in family}
        need(len(items) == len(wanted), "frames")
        for item, (frame, (left, right)) in zip(items, wanted):
            e, point = fields(item, "state", "point")
            need(index(e, len(self.model.states)) == frame[0], "frames")
            place, verdict, _, common = check_point(self.model, e, self.view(frame), point)
            need(place == {"at": "joint", "path": [], "left": left, "right": right} and verdict == "proved", "frames")
            lines[e] += [common] if common is not None else []
        return len(wanted), lines

    def spans(self, family, lines):
        spans, rows, size = {e: echelon(lines[e])[0] for e, _ in family}, dict(family), None
        while size != (size := [len(spans[e]) for e, _ in family]):
            for e, own in family:
                for target, op, _ in self.model.states[e][1]:
                    if spans[target]:
                        onto = mul(own, self.model.linear(op, e, target))
                        leading = echelon(rows[target])[1]
                        on_quotient = [[row[p] for p in leading] for row in onto]
                        need(mul(on_quotient, rows[target]) == onto, "frames")
                        spans[e] = echelon(spans[e] + mul(spans[target], transpose(on_quotient)))[0]
        need(all(len(spans[e]) == len(own) for e, own in family), "frames")

    def in_sight(self, frame, states, value):
        model, e = self.model, frame[0]
        cones, maps, code, above = fields(value, "cones", "maps", "code", "above")
        need(len(cones) == len(maps) == len(states), "cone")
        found = Cones(model, [], set())
        found.rays = {f: found.cone(f, c) for f, c in zip(states, cones)}
        for f, m in zip(states, maps):
            found.images(f, m)
        words = [(word(w), h) for w, h in (fields(item, "word", "functional") for item in code)]
        inner, open_, leaves = [], [[]], 0
        while open_:
            letters = open_.pop()
            op, end = model.product(e, letters)
            own = [h for w, h in words if w == letters]
            if own:
                leaves += 1
                seen = [apply(mul(self.view(frame), op), ray) for ray in found.rays[end]]
                h = vector(own[0], len(frame[1]))
                need(seen and all(sum(x * y for x, y in zip(h, ray)) > 0 for ray in seen), "frames")
                continue
            need(any(len(w) > len(letters) and w[:len(letters)] == letters for w, _ in words), "frames")
            inner.append(letters)
            open_ += [letters + [k] for k in range(len(model.states[end][1]))]
        need(leaves == len(words), "frames")
        listed = []
        for item in above:
            (point,) = fields(item, "point")
            point = check_point(model, e, self.view(frame), point)
            need(point.place["at"] == "joint" and point.verdict == "proved", "frames")
            listed.append((point.place["path"], point.place["left"], point.place["right"]))
        for letters in inner:
            at = frame
            for k in letters:
                at = self.behind(at, k)
            need(all((letters, *pair) in listed for pair in self.joints(at)), "frames")


# ---- every point: Theorems 6 and 6' ----------------------------------------------------------------------------------

class Cones:
    """The answer to "every point": the verdict on G1 that follows."""

    def __init__(self, model, points, used):
        self.model, self.points, self.used, self.states = model, points, used, model.reachable
        need(model.states[model.case.start][0] == "edge", "every-point")

    def check(self, cones, maps, view, window, slow, rate, joints, witness):
        model = self.model
        need(len(witness) <= 1, "format")
        for k in witness:
            point = self.points[index(k, len(self.points))]
            need(point.verdict == "refuted" or point.kind in ("cusp", "oscillating"), "every-point")
            self.used.add(k)
        if not cones:
            need(witness and maps == slow == joints == [] and view is None is rate and window == 0, "every-point")
            return "refuted"
        need(len(cones) == len(maps) == len(model.reachable), "cone")
        self.rays = {e: self.cone(e, c) for e, c in zip(model.reachable, cones)}
        self.maps = {e: self.images(e, m) for e, m in zip(model.reachable, maps)}
        if view is not None:
            seen = [apply(model.case.view, ray) for ray in self.rays[model.case.start]]
            need(all(sum(x * y for x, y in zip(vector(view, len(ray)), ray)) > 0 for ray in seen), "cone")
        need(0 < index(window, 9), "slow")
        cycles = self.idle_cycles(window)
        need(len(slow) == len(cycles), "slow")
        for item, (e, letters) in zip(slow, cycles):
            self.pulls(item, e, letters)
        if rate is not None:
            self.rate(*fields(rate, "length", "cross_ratio"))
        # A curve that is more than a point has joints.
        need(any(model.joints(e) for e in model.reachable), "every-point")
        if agree := joints != []:
            self.joints(joints)
        return "refuted" if witness else "proved" if agree and view is not None else "undetermined"

    def cone(self, e, value):
        model = self.model
        rays, functional, chord = fields(value, "rays", "functional", "chord")
        n = model.case.dims[e]
        rays, f, y = [vector(v, n) for v in rays], vector(functional, n), vector(chord, len(rays))
        basis = model.basis[e]
        need(model.states[e][0] == "edge" and basis, "cone")
        need(all(apply(transpose(basis), [v[p] for p in model.pivots[e]]) == v for v in rays), "cone")
        need(len(echelon(rays)[1]) == len(basis), "cone")
        need(all(sum(a * b for a, b in zip(f, v)) > 0 for v in rays), "cone")
        ends = sub(model.end_point(e, True), model.end_point(e, False))
        need(any(y) and min(y) >= 0 and apply(transpose(rays), y) == ends, "cone")
        return rays

    def images(self, e, items):
        pieces, found = self.model.states[e][1], []
        need(len(items) == len(pieces), "format")
        for item, (target, op, backwards) in zip(items, pieces):
            b = [vector(row, len(self.rays[target])) for row in item]
            need(len(b) == len(self.rays[e]) and all(any(col) and min(col) >= 0 for col in zip(*b)), "cone")
            for ray, column in zip(self.rays[target], zip(*b)):
                image = [-x if backwards else x for x in apply(op, ray)]
                need(image == apply(transpose(self.rays[e]), column), "cone")
            found.append(b)
        return found

    def positive(self, e, letters):
        """Whether the product of a word is positive."""
        states = self.model.path(e, letters)
        product = self.maps[e][letters[0]]
        for s, k in zip(states[1:], letters[1:]):
            product = mul(product, self.maps[s][k])
        return all(x > 0 for row in product for x in row)

    def idle_cycles(self, window):
        """The cycles of the graph of words of a length that have no positive factor."""
        model, words = self.model, [(e, ()) for e in self.states]
        for _ in range(window):
            longer = [(e, w + (k,)) for e, w in words for k in range(len(model.states[model.path(e, w)[-1]][1]))]
            ends = lambda e, w: zip(model.path(e, w), (w[j:] for j in range(len(w))))
            words = [(e, w) for e, w in longer if not any(self.positive(s, tail) for s, tail in ends(e, w))]
            need(len(words) <= 1000, "limit")
        follows = lambda a, b: model.path(a[0], a[1][:1])[-1] == b[0] and a[1][1:] == b[1][:-1]
        after = [[k for k, b in enumerate(words) if follows(a, b)] for a in words]
        reach = []
        for k in range(len(words)):
            open_, seen = list(after[k]), set()
            while open_:
                j = open_.pop()
                if j not in seen:
                    seen.add(j)
                    open_ += after[j]
            reach.append(seen)
        cycles, seen = [], set()
        for k in range(len(words)):
            if k not in reach[k]:
                continue
            need(sum(k in reach[j] for j in after[k]) == 1, "slow")
            at, letters = k, []
            while at not in seen:
                seen.add(at)
                letters.append(words[at][1][0])
                at = next(j for j in after[at] if at in reach[j])
            if letters:
                cycles.append((words[k][0], letters))
        return cycles

    def pulls(self, value, e, letters):
        """All rays tend to the leading eigenvector of the cycle, or lie on it."""
        model = self.model
        state, word_, top, functional = fields(value, "state", "word", "top", "functional")
        need(index(state, len(model.states)) == e and word(word_) == letters, "slow")
        turn = model.orientation(e, letters)
        linear = [[turn * x for x in row] for row in model.linear(model.product(e, letters)[0], e, e)]
        need(isinstance(top, dict) and top.get("top") == "real", "slow")
        branch = Branch(namedtuple("Germ", "linear n")(linear, len(linear)))
        row = branch.leading_row(Top(top, linear), functional)
        need(branch.eigenvalue_sign > 0, "slow")
        v, f = branch.vectors[0], branch.field
        for ray in self.rays[e]:
            ray = [ray[p] for p in model.pivots[e]]
            if i_sign(f.value(weighted(ray, row))) > 0:
                continue
            scaled = lambda x, p: trim([x * c for c in p])
            need(all(scaled(x, v[j]) == scaled(ray[j], v[i]) for i, x in enumerate(ray) for j in range(i)), "slow")
            along = next(i_sign(f.value(y)) * (1 if x > 0 else -1) for x, y in zip(ray, v) if x and i_sign(f.value(y)))
            need(along == branch.pairing, "slow")

    def rate(self, length, bound):
        bound, layer = rational(bound), [(e, identity(len(self.rays[e]))) for e in self.model.reachable]
        need(bound >= 1 and 0 < index(length, 13), "rate")
        for _ in range(length):
            layer = [(piece[0], mul(p, b)) for e, p in layer for piece, b in zip(self.model.states[e][1], self.maps[e])]
            need(len(layer) <= 5000, "limit")
        for _, b in layer:
            need(all(x > 0 for row in b for x in row), "rate")
            for j in range(len(b[0])):
                for k in range(j):
                    ratios = [row[j] / row[k] for row in b]
                    need(max(ratios) <= bound * min(ratios), "rate")

    def joints(self, items):
        model, listed = self.model, set()
        for item in items:
            if "listed" in item:
                e, k = fields(item, "state", "listed")
                point = self.points[index(k, len(self.points))]
                need(point.place["at"] == "joint", "every-point")
                op, end = model.product(model.case.start, point.place["path"])
                seen = mul(mul(model.case.view, op), transpose(model.basis[end], model.case.dims[end]))
                need(end == index(e, len(model.states)) and len(echelon(seen)[1]) == len(model.visible[e]), "every-point")
            else:
                e, point = fields(item, "state", "point")
                need(index(e, len(model.states)) in model.reachable, "word")
                point = check_point(model, e, model.own_view(e), point)
                need(point.place["at"] == "joint" and point.place["path"] == [], "every-point")
            need((point.verdict, point.kind) == ("proved", "regular"), "every-point")
            listed.add((e, point.place["left"], point.place["right"]))
        need(all((e, *pair) in listed for e in model.reachable for pair in model.joints(e)), "every-point")


# ---- spectra ---------------------------------------------------------------------------------------------------------

class Spectra:
    def __init__(self, text, value):
        form, version, _, name, verdict, proof = envelope(value)
        (items,) = fields(proof, "spectra")
        need(form == "secant certificate" and version == 1 and verdict == "proved", "format")
        if items and items[0].get("operator") is None:
            own, places = "matrix", [(None, self.plain(text))]
        else:
            case = Case(text)
            own, places = case.name, [({"state": e, "piece": k}, p[1]) for e, (_, pieces) in enumerate(case.states)
                                      for k, p in enumerate(pieces) if p[0] == e]
        need(own == name and len(items) == len(places) > 0, "spectrum")
        self.case, self.verdict, self.lines = namedtuple("Named", "name")(name), verdict, []
        for item, (place, matrix) in zip(items, places):
            operator, factors, modulus, classes = fields(item, "operator", "factors", "modulus", "classes")
            need(operator == place and (place is None or list(operator) == list(place)), "spectrum")
            self.spectrum(matrix, factors, modulus, classes)

    @staticmethod
    def plain(text):
        words = [w for line in text.splitlines() for w in line.split("#")[0].split()]
        n, numbers = int(words[0]), [Q(w) for w in words[1:]]
        need(0 < n <= 256 and len(numbers) == n * n, "matrix")
        return [numbers[k * n:(k + 1) * n] for k in range(n)]

    def spectrum(self, a, factors, modulus, classes):
        self.discs, rows, n = [], [], len(a)
        for item in factors:
            m, roots, chains = fields(item, "polynomial", "roots", "chains")
            ring, before = Ring(vector(m), n), len(self.discs)
            for root in roots:
                centre, error = fields(root, "centre", "error")
                (x, y), e = vector(centre, 2), rational(error)
                need(e >= 0 and (y == 0 or y > e) and root_near(ring.m, (x, y), e), "roots")
                self.discs.append((x, y, e, ring.m))
            need(sum(1 + (d[1] > 0) for d in self.discs[before:]) == len(ring.m) - 1, "roots")
            lengths, chains = [len(c) for c in chains], [ring.chain(a, 1, c, "chains") for c in chains]
            need(lengths and lengths == sorted(lengths, reverse=True), "chains")
            for v in (v for c in chains for v in c):
                rows += transpose([p + [Q(0)] * (len(ring.m) - 1 - len(p)) for p in v])
            self.lines.append(f"proved: factor of degree {len(ring.m) - 1}, Jordan blocks {lengths}")
        need(all(self.apart(c, d) for k, c in enumerate(self.discs) for d in self.discs[:k]), "roots")
        need(len(rows) == n and 2 <= index(modulus, 1 << 31), "chains")
        den = lcm(*(x.denominator for row in rows for x in row))
        rows = [[int(x * den) % modulus for x in row] for row in rows]
        for j in range(n):
            k = next((k for k in range(j, n) if gcd(rows[k][j], modulus) == 1), None)
            need(k is not None, "chains")
            rows[j], rows[k] = rows[k], rows[j]
            inverse = pow(rows[j][j], -1, modulus)
            for k in range(j + 1, n):
                factor = rows[k][j] * inverse
                rows[k] = [(x - factor * y) % modulus for x, y in zip(rows[k], rows[j])]
        self.moduli(classes)

    @staticmethod
    def apart(c, d, slack=0):
        far = (c[2] + d[2] + slack) ** 2
        return all((c[0] - d[0]) ** 2 + (c[1] - y) ** 2 > far for y in (d[1], -d[1]))

    def moduli(self, classes):
        listed, above = [], None
        for k, item in enumerate(classes):
            members, square, below = fields(item, "members", "square", "below")
            need(members, "moduli")
            listed += [index(m, len(self.discs)) for m in members]
            last = below is None
            need(not last or k + 1 == len(classes), "moduli")
            below = None if last else rational(below)
            for x, y, e, _ in (self.discs[m] for m in members):
                need(above is None or (above > e and x * x + y * y < (above - e) ** 2), "moduli")
                need(last or (below >= 0 and x * x + y * y > (below + e) ** 2), "moduli")
            if square is None:
                need(all(self.opposite(members[0], m) for m in members[1:]), "moduli")
            else:
                need(all(self.inverted(m, rational(square)) for m in members), "moduli")
            above = below
        need(listed and sorted(listed) == list(range(len(self.discs))), "moduli")
        self.lines.append(f"proved: classes of equal modulus {[len(c['members']) for c in classes]}")

    def others(self, m):
        return [d for k, d in enumerate(self.discs) if k != m and d[3] is self.discs[m][3]]

    def opposite(self, a, b):
        x, y, e, p = self.discs[a]
        reflected = [c * (-1) ** (len(p) - 1 - k) for k, c in enumerate(p)] == self.discs[b][3]
        return reflected and all(self.apart((-x, y, e), d) for d in self.others(b))

    def inverted(self, m, s):
        x, y, e, p = self.discs[m]
        d, least = len(p) - 1, max(abs(x), abs(y)) - e
        closed = s > 0 and all(p[d - j] * s ** (d - j) == p[0] * p[j] for j in range(d + 1))
        if not closed or least <= 0:
            return False
        moved = (abs(s - x * x - y * y) + 2 * (abs(x) + abs(y)) * e + e * e) / least
        return all(self.apart((x, y, e), other, moved) for other in self.others(m))


# ---- unknown entries -------------------------------------------------------------------------------------------------

class Solved:
    """A case with unknown entries: an operator is a list of rows whose entries are rationals or numbers of unknowns."""

    def __init__(self, text, value):
        case = tomllib.loads(text, parse_float=lambda s: Q(s))
        form, version, _, name, self.verdict, proof = envelope(value)
        need(form == "secant certificate" and version == 1 and name == case["name"] and "map" not in case, "format")
        self.case, self.rows, self.names, self.count = namedtuple("Named", "name")(name), case["convention"] == "rows", {}, 0
        states = case.get("state") or [{"name": "", "piece": [{"to": "", "matrix": m} for m in case["pieces"]]}]
        need(not any("layout" in s or "reversal" in s for s in states), "case")
        self.kinds = [s.get("kind", "edge") for s in states]
        names = [s["name"] for s in states]
        size = lambda m: len(m[0]) if self.rows else len(m)
        dims = [s["dimension"] if "dimension" in s else size(s["piece"][0]["matrix"]) for s in states]
        self.pieces, self.ends = [], []
        for s, n in zip(states, dims):
            target = lambda key, of: names.index(of[key])
            self.pieces.append([(target("to", p), self.operator(p["matrix"], n, dims[target("to", p)]),
                                 p.get("reversed", False)) for p in s["piece"]])
            ends = [s.get("left"), s.get("right")]
            self.ends.append([e and (target("vertex", e), self.inclusion(e["points"], n) if "points" in e else
                                     self.operator(e["matrix"], n, dims[target("vertex", e)])) for e in ends])
        self.open = [op for p, e in zip(self.pieces, self.ends) for op in [x[1] for x in p] + [x[1] for x in e if x]
                     if any(isinstance(x, int) for row in op for x in row)]
        self.equations = self.write_down()
        self.judge(*fields(proof, "solutions", "values", "directions", "conflict"))

    @staticmethod
    def inclusion(points, n):
        return [[Q(int(p == i)) for p in points] for i in range(n)]

    def operator(self, m, rows, cols):
        get = (lambda i, j: "?") if m == "?" else (lambda i, j: m[j][i]) if self.rows else (lambda i, j: m[i][j])
        return [[self.entry(get(i, j)) for j in range(cols)] for i in range(rows)]

    def entry(self, x):
        if not (isinstance(x, str) and x.startswith("?")):
            parts = str(x).split("/")
            return Q(parts[0]) / Q(parts[1] if parts[1:] else 1)
        if x == "?" or x not in self.names:
            self.names[x], self.count = self.count, self.count + 1
        return self.names[x]

    def identities(self):
        for e, pieces in enumerate(self.pieces):
            inner = lambda k, finish: self.ends[pieces[k][0]][finish != pieces[k][2]]
            if self.kinds[e] != "edge":
                continue
            for k, finish in ((0, 0), (len(pieces) - 1, 1)):
                if self.ends[e][finish] and inner(k, finish):
                    vertex, outer = self.ends[e][finish]
                    step = self.pieces[vertex][0]
                    need(step[0] == inner(k, finish)[0], "curve")
                    yield outer, step[1], pieces[k][1], inner(k, finish)[1]
            for k in range(1, len(pieces)):
                if inner(k - 1, 1) and inner(k, 0):
                    need(inner(k - 1, 1)[0] == inner(k, 0)[0], "curve")
                    yield pieces[k - 1][1], inner(k - 1, 1)[1], pieces[k][1], inner(k, 0)[1]

    def write_down(self):
        """For each identity and each open operator its equations: the coefficients of the unknowns, then the right side."""
        def at(x):
            value = lambda op: [[x[y] if isinstance(y, int) else y for y in row] for row in op]
            found = []
            for a, b, c, d in identities:
                left, right = mul(value(a), value(b)), mul(value(c), value(d))
                found.append([y for r, s in zip(left, right) for y in sub(r, s)])
            return found + [[sum(col) - 1 for col in zip(*value(op))] for op in self.open]

        identities, n = list(self.identities()), self.count
        for a, b, c, d in identities:
            need(not any(x in self.open and y in self.open for x, y in ((a, b), (c, d))), "solve")
        zero = at([Q(0)] * n)
        units = [at([Q(int(i == k)) for i in range(n)]) for k in range(n)]
        return [[[u[s][i] - z for u in units] + [-z] for i, z in enumerate(values)] for s, values in enumerate(zero)]

    def ranks(self, chosen):
        pivots = echelon([row for k in chosen for row in self.equations[k]])[1]
        return len([p for p in pivots if p < self.count]), len(pivots)

    def judge(self, solutions, values, directions, conflict):
        n, chosen = self.count, [index(k, len(self.equations)) for k in conflict]
        contradict = lambda part: len(set(self.ranks(part))) == 2
        if solutions == "none":
            need(values is None and directions == [] and chosen and chosen == sorted(set(chosen)), "solve")
            need(contradict(chosen), "solve")
            need(not any(contradict([k for k in chosen if k != left_out]) for left_out in chosen), "solve")
        else:
            need(solutions == ("family" if directions else "one") and not chosen, "solve")
            point, along = vector(values, n), [vector(d, n) for d in directions]
            everything = self.ranks(range(len(self.equations)))
            need(everything == (n - len(along),) * 2 and len(echelon(along)[1]) == len(along), "solve")
            for row in (row for source in self.equations for row in source):
                dot = lambda v: sum(x * y for x, y in zip(row, v))
                need(dot(point) == row[-1] and not any(map(dot, along)), "solve")
        need(self.verdict == ("refuted" if solutions == "none" else "proved"), "verdict")
        self.lines = [f"{self.verdict}: {n} unknowns, {solutions}, {len(directions)} parameters"]


def read(certificate_text):
    refuse = lambda text: need(False, "format")
    return json.loads(certificate_text, object_pairs_hook=no_duplicates, parse_float=refuse, parse_constant=refuse)


def check(case_text, certificate_text):
    value = read(certificate_text)
    kind = value.get("kind") if isinstance(value, dict) else None
    others = {"spectrum": Spectra, "solve": Solved}
    return others[kind](case_text, value) if kind in others else Certificate(Case(case_text), value)


def main(arguments, check=check, usage=__doc__):
    if len(arguments) != 2:
        print(usage, file=sys.stderr)
        return 2
    try:
        texts = [open(name, encoding="utf-8").read() for name in arguments]
    except OSError as error:
        print(f"unreadable: {error}", file=sys.stderr)
        return 2
    try:
        found = check(*texts)
    except (Rejected, ValueError, TypeError, KeyError, IndexError, AttributeError, ZeroDivisionError) as error:
        print(f"rejected: {error or type(error).__name__}")
        return 1
    print(f"accepted: {found.case.name}: {found.verdict}")
    for line in found.lines:
        print(f"  {line}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
