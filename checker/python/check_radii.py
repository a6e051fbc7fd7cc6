#!/usr/bin/env python3
"""A second opinion on secant's certificates of joint spectral radii (kind `jsr`) and of orders of smoothness (`regularity`), by
sections 9 and 9.1 of docs/certificate.md, with the standard library only.

Usage: check_radii.py CASE.toml CERTIFICATE.json     (exit 0 accepted, 1 rejected, 2 unreadable)

It is written for reading, not for hostile input: use secant-check where limits matter.
"""
import sys
import tomllib
from collections import namedtuple
from fractions import Fraction as Q
from math import isqrt

import check_curves
from check_curves import (
    Case, Model, apply, characteristic, echelon, envelope, fields, identity, index, mul, need, rational,
    root_near, sub, transpose, vector,
)

MAX_ORDERS, MAX_LETTERS = 32, 1000


# ---- systems: `dims` by state, `arrows` (from, to, matrix) -----------------------------------------------------------

def times(a, b, columns):
    """The product, where `b` may have no rows."""
    return mul(a, b) if b else [[Q(0)] * columns for _ in a]


def part(matrix, rows, cols):
    return [row[cols[0]:cols[1]] for row in matrix[rows[0]:rows[1]]]


def is_zero(matrix):
    return not any(x for row in matrix for x in row)


def inverse(a):
    n = len(a)
    rows, pivots = echelon([row + unit for row, unit in zip(a, identity(n))])
    need(pivots == list(range(n)), "block")
    return [row[n:] for row in rows]


def modulus(re, im):
    """A bound of a modulus from above, exact for a real number."""
    if im == 0:
        return abs(re)
    scale, square = 1 << 100, re * re + im * im
    return Q(isqrt(-(-(square * scale * scale).numerator // (square * scale * scale).denominator)) + 1, scale)


class System:
    def __init__(self, dims, arrows):
        self.dims, self.arrows = dims, arrows

    def bounds(self, value):
        """What `{"lower", "upper", "bases", "blocks"}` proves of the joint spectral radius."""
        lower, upper, bases, blocks = fields(value, "lower", "upper", "bases", "blocks")
        low, high = Q(0) if lower is None else self.below(lower), rational(upper)
        need(len(bases) == len(self.dims), "format")
        frames = [transpose([vector(v, n) for v in basis], n) for basis, n in zip(bases, self.dims)]
        need(all(len(basis) == n for basis, n in zip(bases, self.dims)), "format")
        backs = [inverse(frame) for frame in frames]
        arrows = []
        for source, target, matrix in self.arrows:
            inner = times(matrix, frames[target], self.dims[target])
            arrows.append((source, target, times(backs[source], inner, self.dims[target])))
        used = [0] * len(self.dims)
        for block in blocks:
            dims, bound, norm = fields(block, "dims", "bound", "norm")
            bound, start = rational(bound), used
            need(len(dims) == len(used) and all(index(d, 65) == d for d in dims) and 0 <= bound <= high, "block")
            used = [u + d for u, d in zip(used, dims)]
            need(all(u <= n for u, n in zip(used, self.dims)), "block")
            inside = []
            for s, t, m in arrows:
                need(is_zero(part(m, (used[s], self.dims[s]), (start[t], used[t]))), "block")
                inside.append((s, t, part(m, (start[s], used[s]), (start[t], used[t]))))
            System(dims, inside).norm(norm, bound)
        need(used == self.dims and low <= high, "block")
        return low, high

    def below(self, value):
        if "pair" in value:
            letters, pair, bound = fields(value, "word", "pair", "bound")
            length, product = self.product(letters)
            (c, p), bound = vector(pair, 2), rational(bound)
            need(bound >= 0 and (p == 0 or p * p < 4 * c), "word")
            # Singular: 0 is an eigenvalue of M^2 + p M + c.
            square = times(product, product, len(product))
            shifted = [[x + p * y + (c if i == j else 0) for j, (x, y) in enumerate(zip(*rows))] for i, rows in enumerate(zip(square, product))]
            need(characteristic(shifted)[0] == 0 and bound ** (2 * length) <= abs(c), "word")
            return bound
        letters, centre, error, bound = fields(value, "word", "centre", "error", "bound")
        length, product = self.product(letters)
        (x, y), error, bound = vector(centre, 2), rational(error), rational(bound)
        need(error >= 0 and bound >= 0, "word")
        need(root_near(characteristic(product), (x, y), error), "word")
        need((bound ** length + error) ** 2 <= x * x + y * y, "word")
        return bound

    def product(self, letters):
        """The length and the product of a closed path in a space that is not 0."""
        letters = [index(a, len(self.arrows)) for a in letters]
        need(0 < len(letters) <= MAX_LETTERS, "word")
        path = [self.arrows[a] for a in letters]
        need(all(a[1] == b[0] for a, b in zip(path, path[1:] + path[:1])), "word")
        size = self.dims[path[0][0]]
        need(size > 0, "word")
        product = identity(size)
        for _, target, matrix in path:
            product = times(product, matrix, self.dims[target])
        return len(letters), product

    # ---- norms of a block ----

    def norm(self, value, bound):
        kind = value["norm"]
        if kind == "zero":
            fields(value, "norm")
            need(all(is_zero(m) for _, _, m in self.arrows), "zero")
        elif kind in ("symmetric", "monotone", "balanced"):
            self.polytope(value, kind, bound)
        elif kind == "quadratic":
            self.quadratic(value, bound)
        elif kind == "transposed":
            _, inner = fields(value, "norm", "of")
            need(inner["norm"] in ("symmetric", "monotone", "balanced", "tree"), "format")
            turned = [(t, s, transpose(m, self.dims[t])) for s, t, m in self.arrows]
            System(self.dims, turned).norm(inner, bound)
        else:
            need(kind == "tree", "format")
            self.tree(value, bound)

    def polytope(self, value, kind, bound):
        """A point is a list of pairs (real, imaginary part)."""
        _, points, inclusions, axes = fields(value, "norm", "points", "inclusions", "axes")
        scalar = (lambda x: tuple(vector(x, 2))) if kind == "balanced" else (lambda x: (rational(x), Q(0)))
        hull = []
        for item in points:
            state, coordinates = fields(item, "state", "coordinates")
            need(len(coordinates) == self.dims[index(state, len(self.dims))], "format")
            hull.append((state, [scalar(x) for x in coordinates]))
        read = lambda term: (index(term[0], len(hull)), scalar(term[1:]) if kind == "balanced" else scalar(*term[1:]))

        def rest(x, terms, state):
            """What is left of `x` without the combination, and the sum of its moduli."""
            total = Q(0)
            for k, (re, im) in map(read, terms):
                need(hull[k][0] == state and (kind != "monotone" or re >= 0), "inclusion")
                total += modulus(re, im)
                x = [(a - re * p + im * q, b - re * q - im * p) for (a, b), (p, q) in zip(x, hull[k][1])]
            return x, total

        size = lambda x: sum((abs(a) + abs(b) for a, b in x), Q(0))
        if kind == "monotone":
            need(all(a >= 0 for _, x in hull for a, _ in x), "monotone")
            need(all(x >= 0 for _, _, m in self.arrows for row in m for x in row), "monotone")
            reached = {(s, i) for s, x in hull for i, (a, _) in enumerate(x) if a > 0}
            need(reached == {(s, i) for s, d in enumerate(self.dims) for i in range(d)}, "monotone")
            interior = {s: Q(0) for s in range(len(self.dims))}
        else:
            interior = {s: Q(0) for s, d in enumerate(self.dims) if d == 0}
            for item in axes:
                state, units = fields(item, "state", "units")
                need(len(units) == self.dims[index(state, len(self.dims))], "interior")
                unit = lambda i, n: [(Q(int(i == j)), Q(0)) for j in range(n)]
                found = [rest(unit(i, len(units)), terms, state) for i, terms in enumerate(units)]
                error = max((size(x) for x, _ in found), default=Q(0))
                need(error < 1, "interior")
                interior[state] = max((total for _, total in found), default=Q(0)) / (1 - error)
            need(len(interior) == len(self.dims), "interior")
        seen = set()
        for item in inclusions:
            k, a, terms = fields(item, "point", "arrow", "terms")
            source, target, matrix = self.arrows[index(a, len(self.arrows))]
            state, point = hull[index(k, len(hull))]
            need(state == target, "inclusion")
            image = list(zip(*(apply(matrix, list(x)) for x in zip(*point)))) if point else [(Q(0), Q(0))] * len(matrix)
            left, total = rest(image, terms, source)
            need(kind != "monotone" or all(x <= 0 for x, _ in left), "inclusion")
            need(total + interior[source] * size(left) <= bound, "inclusion")
            seen.add((k, a))
        for k, (state, _) in enumerate(hull):
            for a, (_, target, matrix) in enumerate(self.arrows):
                need((k, a) in seen or target != state or is_zero(matrix), "inclusion")

    def quadratic(self, value, bound):
        _, forms, square = fields(value, "norm", "forms", "square")
        square, found = rational(square), [identity(d) for d in self.dims]
        for item in forms:
            state, form = fields(item, "state", "form")
            found[state] = check_curves.positive(form, self.dims[index(state, len(self.dims))])
        need(square <= bound * bound, "quadratic")
        for s, t, m in self.arrows:
            if self.dims[s] and self.dims[t]:
                image = mul(transpose(m), mul(found[s], m))
                need(semidefinite([sub([square * x for x in p], i) for p, i in zip(found[t], image)]), "quadratic")
            else:
                need(square >= 0, "quadratic")

    def tree(self, value, bound):
        _, codes = fields(value, "norm", "codes")
        weights, words = {s: [] for s, d in enumerate(self.dims) if d == 0}, {s: [] for s in range(len(self.dims))}
        for item in codes:
            state, w, listed = fields(item, "state", "weights", "words")
            weights[state] = vector(w, self.dims[index(state, len(self.dims))])
            need(all(x > 0 for x in weights[state]), "tree")
            words[state] += [tuple(index(a, len(self.arrows)) for a in letters) for letters in listed]
        need(len(weights) == len(self.dims), "tree")
        need(all(0 < len(w) <= MAX_LETTERS for code in words.values() for w in code), "tree")

        def descend(code, depth, start, at, product):
            if any(len(w) == depth for w in code):
                need(len(code) == 1, "tree")
                for column, weight in zip(zip(*product), weights[at]):
                    weighed = sum(abs(x) * w for x, w in zip(column, weights[start]))
                    need(weighed <= bound ** depth * weight, "tree")
                return
            if is_zero(product) and depth:
                return
            need(code, "tree")
            used = 0
            for a, (source, target, matrix) in enumerate(self.arrows):
                if source == at and self.dims[target]:
                    longer = [w for w in code if w[depth] == a]
                    used += len(longer)
                    descend(longer, depth + 1, start, target, mul(product, matrix))
            need(used == len(code), "tree")

        for state, n in enumerate(self.dims):
            if n:
                descend(words[state], 0, state, state, identity(n))


def semidefinite(a):
    rows = [list(r) for r in a]
    need(transpose(rows) == rows, "quadratic")
    for k, pivot in enumerate(rows):
        if pivot[k] <= 0:
            if pivot[k] < 0 or any(pivot[k:]):
                return False
            continue
        for i in range(k + 1, len(rows)):
            factor = rows[i][k] / pivot[k]
            rows[i] = [x - factor * p for x, p in zip(rows[i], pivot)]
    return True


class Radius:
    """A certificate of the kind `jsr`."""

    def __init__(self, text, value):
        form, version, _, name, verdict, proof = envelope(value)
        file = tomllib.loads(text)
        need(not set(file) - {"name", "matrices", "states", "arrows"}, "case")
        need(all(isinstance(x, (int, str)) for m in file["matrices"] for row in m for x in row), "case")
        matrices = [[[Q(x) for x in row] for row in m] for m in file["matrices"]]
        dims = file.get("states", [len(matrices[0])])
        arrows = file.get("arrows", [[0, 0, k] for k in range(len(matrices))])
        arrows = [(s, t, matrices[k]) for s, t, k in arrows]
        need(arrows and all((len(m), len(m[0])) == (dims[s], dims[t]) for s, t, m in arrows), "case")
        need(form == "secant certificate" and version == 1 and verdict == "proved", "format")
        need(name == file.get("name", ""), "format")
        low, high = System(dims, arrows).bounds(proof)
        self.case, self.verdict = namedtuple("Named", "name")(name), verdict
        self.lines = [f"proved: the joint spectral radius is at least {low} and at most {high}"]


# ---- orders of smoothness --------------------------------------------------------------------------------------------

class Smoothness:
    """A certificate of the kind `regularity`. Everything happens in the coordinates of the visible quotients."""

    def __init__(self, case, value):
        form, version, _, name, verdict, proof = envelope(value)
        shared = any(row is not None for row in case.shares)
        contraction, orders, *exponent = fields(proof, "contraction", "orders", *(["exponent"] if shared else []))
        need(form == "secant certificate" and version == 1 and verdict == "proved" and name == case.name, "format")
        self.case, self.verdict, self.lines = case, verdict, []
        model = Model(case, contraction)
        own = {e: case.shares[e] or [Q(1, len(model.states[e][1]))] * len(model.states[e][1]) for e in model.reachable}
        space, chord = self.first(model, own if shared else None)
        best = (0, space)
        need(0 < len(orders) <= MAX_ORDERS, "orders")
        last, low = False, Q(0)
        for k, item in enumerate(orders):
            need(not last, "orders")
            before, least = space, low
            order, dims, radius, outcome = fields(item, "order", "dims", "radius", "outcome")
            self.order = k
            if k:
                space = self.differences(k, chord)
            found = [len(space[e]) for e in model.reachable]
            need(index(order, MAX_ORDERS) == k and dims == found, "orders")
            low, high = self.radius(space, radius)
            last = not any(found)
            if outcome in ("holds", "joint"):
                need(k and high * self.n ** k < 1, "orders")
                ends = {e: [self.limit(k, e, side, space, chord) for side in (False, True)] for e in model.reachable}
                need(self.agree(k, ends) == (outcome == "holds"), "orders")
                chord = {e: sub(finish, start) for e, (start, finish) in ends.items()}
            elif outcome == "cycle":
                need(k and low * self.n ** k >= 1, "orders")
            elif outcome == "exponent":
                need(k and least * self.n ** k > 1, "orders")
            elif outcome == "chord":
                need(k and any(self.turns_back(e, before, space, chord) for e in model.reachable), "orders")
            else:
                need(k == 0 and outcome == "curve", "orders")
            smooth = outcome in ("curve", "holds")
            last = last or not smooth
            self.lines.append(f"{'proved' if smooth else 'refuted'}: the curve is C^{k}; radius from {low} to {high}")
            best = (k, space) if smooth else best
        if shared and any(best[1].values()):
            low, high = self.exponents(*best, exponent[0])
            self.lines.append(f"proved: the supremum of the exponents lies from {low} to {high}")

    def exponents(self, k, space, value):
        bounds = [Q(k), Q(k + 1)]
        for side, item in enumerate(fields(value, "below", "above")):
            if item is None:
                continue
            at, factors, radius = fields(item, "at", "factors", "radius")
            at = rational(at)
            need(bounds[0] < at < bounds[1] and len(factors) == len(self.model.reachable), "orders")
            factors = {e: [rational(x) for x in row] for e, row in zip(self.model.reachable, factors)}
            for e, row in factors.items():
                need(len(row) == len(self.shares[e]), "orders")
                for r, s in zip(row, self.shares[e]):
                    # r against s^(−p/q).
                    whole = r ** at.denominator * s ** at.numerator
                    need(r > 0 and (whole <= 1 if side else whole >= 1), "orders")
            low, high = self.radius(space, radius, factors)
            need(low >= 1 if side else high < 1, "orders")
            bounds[side] = at
        return bounds

    def first(self, model, shares=None):
        """The spaces and the chords of the curves themselves; shares are what pieces take of the parameter, where not alike."""
        self.model, start = model, model.case.start
        need(all(model.states[e][0] == "edge" for e in model.reachable), "orders")
        counts = {e: len(model.states[e][1]) for e in model.reachable}
        self.own = shares is not None
        self.n = 1
        self.shares = shares if self.own else {e: [Q(1, n)] * n for e, n in counts.items()}
        if not self.own:
            back = [n for e, n in counts.items() if any(e in check_reached(model, p[0]) for p in model.states[e][1])]
            self.n = back[0] if back else 0
            need(self.n >= 2 and set(back) == {self.n}, "orders")
        self.dim = {e: len(model.visible[e]) for e in model.reachable}
        self.maps = {e: [model.on_visible(e, p)[0] for p in model.states[e][1]] for e in model.reachable}
        need(self.dim[start] > 0, "orders")
        space = {e: identity(self.dim[e]) for e in model.reachable}
        return space, {e: self.seen(e, sub(model.end_point(e, True), model.end_point(e, False))) for e in model.reachable}

    def seen(self, e, v):
        return apply(self.model.own_view(e), v)

    def pieces(self):
        for e in self.model.reachable:
            for letter, ((target, _, _), matrix) in enumerate(zip(self.model.states[e][1], self.maps[e])):
                yield e, letter, target, matrix

    def scaled(self, k, e, letter, v):
        backwards = self.model.states[e][1][letter][2]
        factor = ((-1 if backwards else 1) / self.shares[e][letter]) ** k
        return [factor * x for x in v]

    def differences(self, k, chord):
        rows = {e: [] for e in self.model.reachable}
        for e, letter, target, matrix in self.pieces():
            rows[e].append(sub(self.scaled(k, e, letter, apply(matrix, chord[target])), chord[e]))
        rows, size = {e: echelon(r)[0] for e, r in rows.items()}, None
        while size != (size := [len(r) for r in rows.values()]):
            for e, _, target, matrix in self.pieces():
                rows[e] = echelon(rows[e] + [apply(matrix, v) for v in rows[target]])[0]
        return rows

    def radius(self, space, value, factors=None):
        place, arrows = {e: k for k, e in enumerate(self.model.reachable)}, []
        if value is None:
            need(not any(space.values()), "orders")
            return Q(0), Q(0)
        for e, letter, target, matrix in self.pieces():
            images, pivots = [apply(matrix, v) for v in space[target]], echelon(space[e])[1]
            coordinates = [[v[p] for p in pivots] for v in images]
            for c, v in zip(coordinates, images):
                need([sum(x * row[j] for x, row in zip(c, space[e])) for j in range(self.dim[e])] == v, "orders")
            # With shares it is the scaled operators whose radius is bounded.
            scale = factors[e][letter] if factors else (1 / self.shares[e][letter]) ** self.order if self.own else 1
            coordinates = [[scale * x for x in c] for c in coordinates]
            arrows.append((place[e], place[target], transpose(coordinates, len(pivots))))
        return System([len(space[e]) for e in self.model.reachable], arrows).bounds(value)

    def limit(self, k, e, side, space, chord):
        prefix, cycle = self.model.end_address(e, side, lambda p: False)
        home = self.model.path(e, prefix)[-1]
        around = lambda v: self.along(k, home, cycle, v)
        move = lambda v: sub(around(v), v)
        # c + Σ y f is fixed: Σ y (M − 1) f = −(M − 1) c.
        moved, right = [move(f) for f in space[home]], [-x for x in move(chord[home])]
        rows, pivots = echelon([list(row) for row in zip(*moved, right)])
        need(pivots == list(range(len(moved))), "orders")
        fixed = list(chord[home])
        for row, f in zip(rows, space[home]):
            fixed = [x + row[-1] * y for x, y in zip(fixed, f)]
        need(around(fixed) == fixed, "orders")
        return self.along(k, e, prefix, fixed)

    def along(self, k, e, letters, v):
        states = self.model.path(e, letters)
        for letter, state in reversed(list(zip(letters, states))):
            v = self.scaled(k, state, letter, apply(self.maps[state][letter], v))
        return v

    def agree(self, k, ends):
        for e in self.model.reachable:
            values = []
            for letter, (target, _, backwards) in enumerate(self.model.states[e][1]):
                start, finish = (self.scaled(k, e, letter, apply(self.maps[e][letter], ends[target][side]))
                                 for side in (backwards, not backwards))
                values.append((start, finish))
            if any(a[1] != b[0] for a, b in zip(values, values[1:])):
                return False
        return True

    def turns_back(self, e, before, space, chord):
        reached = lambda e: check_reached(self.model, e)
        closed = all(e in reached(d) for d in reached(e))
        return bool(before[e]) and closed and len(echelon(space[e] + [chord[e]])[0]) == len(space[e])


def graph(model, value, given=None):
    """The curve is a graph over its uniform parameter, or over the one with the given shares (Theorem 12)."""
    curve, start, shares = Smoothness.__new__(Smoothness), model.case.start, None
    curve.order = 1
    if given is not None:
        need(isinstance(given, list) and len(given) == len(model.reachable), "graph")
        shares = {e: [rational(x) for x in row] for e, row in zip(model.reachable, given)}
        for e, row in shares.items():
            need(len(row) == len(model.states[e][1]) and all(x > 0 for x in row) and sum(row) == 1, "graph")
    _, chord = curve.first(model, shares)
    space = curve.differences(1, chord)
    need(curve.radius(space, value)[1] * (1 if curve.own else curve.n) < 1, "graph")
    need(curve.agree(1, {e: [curve.limit(1, e, side, space, chord) for side in (False, True)] for e in model.reachable}),
         "graph")
    outside = lambda rows, v: len(echelon(rows + [v])[0]) > len(echelon(rows)[0])
    need(all(outside(space[e], chord[e]) for e in model.reachable), "graph")
    leading = echelon(model.visible[start])[1]
    # Any lift of a vector of the visible quotient is seen as the same vector.
    lift = lambda v: [sum(x * model.basis[start][p][j] for x, p in zip(v, leading)) for j in range(model.case.dims[start])]
    seen = lambda v: apply(model.case.view, lift(v))
    need(outside([seen(v) for v in space[start]], seen(chord[start])), "graph")


def check_reached(model, e):
    found = [e]
    for d in found:
        found += [t for t in dict.fromkeys(p[0] for p in model.states[d][1]) if t not in found]
    return found


def check(case_text, certificate_text):
    value = check_curves.read(certificate_text)
    kind = value.get("kind") if isinstance(value, dict) else None
    need(kind in ("jsr", "regularity"), "format")
    return Radius(case_text, value) if kind == "jsr" else Smoothness(Case(case_text), value)


if __name__ == "__main__":
    sys.exit(check_curves.main(sys.argv[1:], check, __doc__))
