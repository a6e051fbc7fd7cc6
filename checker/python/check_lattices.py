#!/usr/bin/env python3
"""A second opinion on secant's certificates of masks on lattices (kind `lattice`) and of borders between two of them (`border`), by
sections 9, 9.3 and 9.4 of docs/certificate.md, with the standard library only.

Usage: check_lattices.py CASE.toml CERTIFICATE.json     (exit 0 accepted, 1 rejected, 2 unreadable)

It is written for reading, not for hostile input: use secant-check where limits matter.
"""
import sys
import tomllib
from collections import namedtuple
from fractions import Fraction as Q
from itertools import combinations, product

import check_curves
from check_curves import apply, echelon, envelope, fields, fixed_point, identity, index, mul, need, rational, sub, transpose
from check_radii import System


def monomials(s, degree):
    """Exponents of degree up to `degree`."""
    return [a for a in product(range(degree + 1), repeat=s) if sum(a) <= degree]


def value(exponent, at):
    result = Q(1)
    for e, x in zip(exponent, at):
        result *= Q(x) ** e
    return result


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


def plus(a, b):
    return tuple(x + y for x, y in zip(a, b))


def determinant(rows):
    if not rows:
        return 1
    return sum((-1) ** k * rows[0][k] * determinant([r[:k] + r[k + 1:] for r in rows[1:]]) for k in range(len(rows)))


def whole(x, bound=1000):
    x = Q(x)
    need(x.denominator == 1 and abs(x) <= bound, "case")
    return int(x)


def points_of(items, s):
    found = []
    for item in items:
        p = [rational(x) for x in item]
        need(len(p) == s and all(x.denominator == 1 for x in p), "format")
        found.append(tuple(map(int, p)))
    need(1 <= len(found) <= 256 and all(a < b for a, b in zip(found, found[1:])), "window")
    return found


def kernel(rows, width):
    """The vectors that rows kill."""
    reduced, pivots = echelon(rows)
    found = []
    for f in range(width):
        if f not in pivots:
            v = [Q(0)] * width
            v[f] = Q(1)
            for row, p in zip(reduced, pivots):
                v[p] = -row[f]
            found.append(v)
    return found


def solved(a, columns):
    """X with A X = the columns, A of full column rank, both as lists of rows; rejected where there is none."""
    n = len(a[0])
    rows, pivots = echelon([list(r) + list(c) for r, c in zip(a, columns)])
    need(pivots == list(range(n)), "window")
    return [row[n:] for row in rows]


class Mask:
    def __init__(self, table, known):
        need(not set(table) - set(known), "case")
        self.origin = [whole(x) for x in table["origin"]]
        self.s = s = len(self.origin)
        self.terms = {}
        self.grid(table["grid"], ())
        self.m = [[whole(x) for x in row] for row in table.get("dilation", [[2 * (i == j) for j in range(s)] for i in range(s)])]
        need(1 <= s <= 4 and len(self.m) == s and all(len(r) == s for r in self.m), "case")
        need(all(abs(x) <= 64 for r in self.m for x in r), "case")
        self.det = determinant(self.m)
        need(2 <= abs(self.det) <= 64 and self.similar(), "case")
        self.inverse = solved([list(map(Q, r)) for r in self.m], identity(s))
        self.digits = [(0,) * s]
        for digit in self.digits:
            for axis in range(s):
                step = plus(digit, tuple(int(k == axis) for k in range(s)))
                if all(self.divide(minus(step, d)) is None for d in self.digits):
                    self.digits.append(step)
        need(len(self.digits) == abs(self.det), "case")
        self.directions = table.get("directions")

    def grid(self, item, place):
        if len(place) == self.s:
            if Q(item) != 0:
                self.terms[place] = Q(item)
            return
        for k, inner in enumerate(item):
            self.grid(inner, place + (self.origin[len(place)] + k,))

    def similar(self):
        """One modulus, diagonalisable."""
        if self.s == 2 and (self.m[0][0] + self.m[1][1]) ** 2 < 4 * self.det:
            return True
        own = [list(map(Q, r)) for r in self.m]
        power = own
        for _ in range(24):
            if power == [[power[0][0] * x for x in r] for r in identity(self.s)]:
                return True
            power = mul(power, own)
        return False

    def times(self, a):
        return tuple(sum(x * y for x, y in zip(row, a)) for row in self.m)

    def divide(self, a):
        """M^{-1} a, where it is a point of the lattice."""
        found = apply(self.inverse, list(a))
        return tuple(map(int, found)) if all(x.denominator == 1 for x in found) else None

    def moments(self, degree):
        """Whether all cosets have the same moments of this degree, 1 for the degree 0."""
        for a in monomials(self.s, degree):
            if sum(a) < degree:
                continue
            sums = [sum((c * value(a, p) for p, c in self.terms.items() if self.divide(minus(p, d)) is not None), Q(0))
                    for d in self.digits]
            if len(set(sums)) != 1 or degree == 0 and sums[0] != 1:
                return False
        return True


def modulo(nets, operators):
    """Operators on nets, modulo a space of nets (rows)."""
    rows, pivots = echelon(nets)
    free = [j for j in range(len(operators[0])) if j not in pivots]
    need(free, "window")
    letters = []
    for a in operators:
        q = []
        for i in free:
            row = list(a[i])
            for r, p in zip(rows, pivots):
                row = [x - r[i] * y for x, y in zip(row, a[p])]
            q.append(row)
        need(not any(x for row in mul(q, transpose(rows, len(a))) for x in row), "window")
        letters.append([[row[j] for j in free] for row in q])
    return letters


def bounds(letters, radius):
    return System([len(letters[0])], [(0, 0, m) for m in letters]).bounds(radius)


class Proved:
    """Section 9.3: what is proved of one mask."""

    def __init__(self, mask, proof):
        rules, window, radius, shifts, orders = fields(proof, "rules", "window", "radius", "shifts", "orders")
        need(index(rules, 13) >= 1 and all(mask.moments(k) for k in range(rules)), "rules")
        self.mask, self.points = mask, points_of(window, mask.s)
        self.window(rules - 1)
        self.operators = [[[mask.terms.get(minus(plus(i, d), mask.times(j)), Q(0)) for j in self.points] for i in self.points]
                          for d in mask.digits]
        values = [[value(a, p) for p in self.points] for a in monomials(mask.s, rules - 1)]
        low, high = bounds(modulo(values, self.operators), radius)
        size = lambda x, order: x ** mask.s * abs(mask.det) ** order
        if shifts is not None:
            need(high < 1, "shifts")
            self.stable(shifts)
        self.words, self.lines = [], []
        for order, item in enumerate(orders):
            need(order <= rules and "rough" not in self.words and "rules" not in self.words, "orders")
            if item == "smooth":
                need(order < rules and size(high, order) < 1, "orders")
            elif item == "rough":
                need(order < rules and (order == 0 or shifts is not None) and size(low, order) >= 1, "orders")
            else:
                need(item == "rules" and order == rules and shifts is not None and not mask.moments(rules), "orders")
            self.words.append(item)
            self.lines.append(f"{'proved' if item == 'smooth' else 'refuted'}: all limits are C^{order}")
        need(self.words, "orders")
        if high < 1:
            self.lines.append(f"proved: exponents from the radius, from {low} to {high}")

    def smooth(self, order):
        return self.words[order] == "smooth" if order < len(self.words) else None

    def window(self, degree):
        mask, held = self.mask, set(self.points)
        for i, d, a in product(self.points, mask.digits, mask.terms):
            need(mask.divide(minus(plus(i, d), a)) in held | {None}, "window")
        full = monomials(mask.s, degree)
        for axis in range(mask.s):
            unit = tuple(int(k == axis) for k in range(mask.s))
            common = [p for p in self.points if minus(p, unit) in held]
            need(len(echelon([[value(a, p) for p in common] for a in full])[1]) == len(full) if common else False, "window")

    def stable(self, shifts):
        mask = self.mask
        if shifts["stable"] == "interpolatory":
            _, at = fields(shifts, "stable", "at")
            at = tuple(map(int, map(rational, at)))
            coset = {a: c for a, c in mask.terms.items() if mask.divide(minus(a, at)) is not None}
            need(coset == {at: Q(1)}, "shifts")
        elif shifts["stable"] == "unimodular":
            fields(shifts, "stable")
            self.unimodular()
        else:
            need(shifts["stable"] == "samples", "format")
            self.samples(*fields(shifts, "stable", "words", "charts")[1:])

    def unimodular(self):
        mask = self.mask
        directions = [tuple(map(whole, v)) for v in mask.directions or []]
        need(mask.m == [[2 * (i == j) for j in range(mask.s)] for i in range(mask.s)], "shifts")
        need(1 <= len(directions) <= 24 and all(len(v) == mask.s and any(v) for v in directions), "shifts")
        spline = {(0,) * mask.s: Q(2) ** mask.s}
        for v in directions:
            longer = {}
            for a, c in spline.items():
                for b in (a, plus(a, v)):
                    longer[b] = longer.get(b, Q(0)) + c / 2
            spline = longer
        first, own = min(spline), min(mask.terms)
        need({plus(minus(a, first), own): c for a, c in spline.items()} == mask.terms, "shifts")
        choices = {determinant([list(v) for v in rows]) for rows in combinations(directions, mask.s)}
        need(choices <= {0, 1, -1} and choices & {1, -1}, "shifts")

    def samples(self, words, charts):
        start = fixed_point(transpose(self.operators[0]))
        need(1 <= len(words) <= 64, "shifts")
        symbols = []
        for word in words:
            row = start
            need(len(word) <= 16, "shifts")
            for k in word:
                row = apply(transpose(self.operators[index(k, len(self.operators))]), row)
            top = max(range(len(row)), key=lambda k: (abs(row[k]), -k))
            terms = [(minus(p, self.points[top]), c) for p, c in zip(self.points, row) if c]
            symbols.append((terms, sum((abs(c) * sum(map(abs, a)) for a, c in terms), Q(0))))

        def cell(signs, item, centre, half, depth):
            if isinstance(item, list):
                need(len(item) == 2 ** len(centre) and depth < 24, "shifts")
                for inner, moved in zip(item, product((-1, 1), repeat=len(centre))):
                    cell(signs, inner, [c + m * half / 2 for c, m in zip(centre, moved)], half / 2, depth + 1)
                return
            terms, slope = symbols[index(item, len(symbols))]
            axes = [(sign * (1 - t * t) / (1 + t * t), sign * 2 * t / (1 + t * t)) for sign, t in zip(signs, centre)]
            re, im = Q(0), Q(0)
            for a, c in terms:
                x, y = c, Q(0)
                for k, (p, q) in zip(a, axes):
                    for _ in range(abs(k)):
                        q_ = q if k > 0 else -q
                        x, y = x * p - y * q_, x * q_ + y * p
                re, im = re + x, im + y
            need(re * re + im * im > (2 * half * slope) ** 2, "shifts")

        need(len(charts) == 2 ** self.mask.s, "shifts")
        for signs, item in zip(product((1, -1), repeat=self.mask.s), charts):
            cell(signs, item, [Q(0)] * self.mask.s, Q(1), 0)


class Lattice:
    """A certificate of the kind `lattice`."""

    def __init__(self, text, value):
        case = opened(text, "mask")
        form, version, _, name, verdict, proof = envelope(value)
        need(form == "secant certificate" and version == 1 and verdict == "proved" and name == case["name"], "format")
        self.case, self.verdict = namedtuple("Named", "name")(name), verdict
        self.lines = Proved(Mask(case["mask"], ("dilation", "grid", "origin", "directions")), proof).lines


def opened(text, table):
    case = tomllib.loads(text, parse_float=lambda _: need(False, "case"))
    need(not set(case) - {"name", "title", "source", table}, "case")
    return case


# ---- borders ---------------------------------------------------------------------------------------------------------

class Border:
    """A certificate of the kind `border`."""

    def __init__(self, text, value):
        case = opened(text, "border")
        form, version, _, name, verdict, proof = envelope(value)
        need(form == "secant certificate" and version == 1 and verdict == "proved" and name == case["name"], "format")
        self.case, self.verdict, self.lines = namedtuple("Named", "name")(name), verdict, []
        table = case["border"]
        need(not set(table) - {"left", "right", "stencil"}, "case")
        self.masks = [Mask(table[side], ("grid", "origin", "place")) for side in ("left", "right")]
        need(all(m.m == [[2, 0], [0, 2]] for m in self.masks), "case")
        self.places = [tuple(map(Q, table[side]["place"])) for side in ("left", "right")]
        need(all(len(p) == 2 and p[0] > 0 for p in self.places), "case")
        self.own = {}
        for item in table["stencil"]:
            need(set(item) == {"at", "weights"}, "case")
            at = tuple(whole(x, 6) for x in item["at"])
            weights = [((whole(a, 6), whole(b, 6)), Q(w)) for a, b, w in item["weights"]]
            need(len(at) == 2 and at[1] in (0, 1) and at not in self.own and sum(w for _, w in weights) == 1, "case")
            self.own[at] = weights
        need({(0, 0), (0, 1)} <= set(self.own), "case")
        most = max([1] + [abs(a[0]) for m in self.masks for a in m.terms])
        for c, r in product(range(-most, most + 1), (0, 1)):
            if c and (c, r) not in self.own:
                need(all(a[0] * c >= 0 for a, _ in self.rule(c, r)), "case")
        sides, orders = fields(proof, "sides", "orders")
        need(len(sides) == 2 and 1 <= len(orders) <= 13, "format")
        self.sides = [Proved(m, side) for m, side in zip(self.masks, sides)]
        last = False
        for order, item in enumerate(orders):
            need(not last, "orders")
            last = self.order(order, item)

    def rule(self, column, row):
        """The old points on which a new one depends, with weights."""
        if (column, row % 2) in self.own:
            return [((a, b + row // 2), w) for (a, b), w in self.own[column, row % 2]]
        need(column != 0, "case")
        mask = self.masks[int(column > 0)]
        found = ((mask.divide((column - a[0], row - a[1])), c) for a, c in mask.terms.items())
        return [(old, c) for old, c in found if old is not None]

    def order(self, k, item):
        """Whether this order is the last."""
        if item["by"] in ("left", "right"):
            fields(item, "by")
            need(self.sides[int(item["by"] == "right")].smooth(k) is False, "orders")
            self.lines.append(f"refuted: all limits are C^{k} across the border (by one side)")
            return True
        by, reach, window, radius = fields(item, "by", "reach", "window", "radius")
        need(all(side.smooth(k) for side in self.sides), "orders")
        model = Triples(self, index(reach, 13), points_of(window, 2), k)
        if by == "radius":
            need(len(echelon([t[:model.n] for t in model.equal])[1]) == len(model.equal), "window")
            model.below(model.equal, radius, k)
            self.lines.append(f"proved: all limits are C^{k} across the border")
            return False
        need(by == "jump" and len(model.all) > len(model.equal), "orders")
        self.lines.append(f"refuted: all limits are C^{k} across the border")
        if radius is not None:
            model.below(model.all, radius, k)
            self.lines.append(f"proved: all limits are C^{k} up to the border")
        return True


def table(degree, points):
    return [[value(a, p) for a in monomials(2, degree)] for p in points]


def interpolated(degree, values):
    """Coefficients (rows) of the polynomials with these values (rows, at the exponents as points)."""
    return solved(table(degree, monomials(2, degree)), values)


class Triples:
    """Two polynomials and the values on column 0, with the operators on a window."""

    def __init__(self, border, reach, points, k):
        self.border, self.points, self.k = border, points, k
        self.n, place = len(monomials(2, k)), {p: i for i, p in enumerate(points)}
        need(reach >= 1 and all(abs(c) <= reach for c, _ in border.own), "window")
        need(all((c, 0) in place for c in range(-reach, reach + 1)), "window")
        for c, r in product((reach + 1, reach + 2, -reach - 1, -reach - 2), (0, 1)):
            need(all(a[0] * c > 0 and abs(a[0]) < abs(c) for a, _ in border.rule(c, r)), "window")
        self.operators = []
        for half in (0, 1):
            rows = []
            for p in points:
                row = [Q(0)] * len(points)
                for old, c in border.rule(p[0], p[1] + half):
                    need(old in place, "window")
                    row[place[old]] += c
                rows.append(row)
            self.operators.append(rows)
        middle = [i for i, p in enumerate(points) if p[0] == 0]
        n, width = self.n, 2 * self.n + len(middle)
        charts = [self.chart(side) for side in (0, 1)]
        self.nets = []
        for i, p in enumerate(points):
            row = [Q(0)] * width
            if p[0] == 0:
                row[2 * n + middle.index(i)] = Q(1)
            else:
                side = int(p[0] > 0)
                row[side * n:(side + 1) * n] = mul(table(k, [p]), charts[side])[0]
            self.nets.append(row)
        broken, steps = [], []
        for half, operator in enumerate(self.operators):
            image = mul(operator, self.nets)
            turned = self.substituted(Q(1, 2), half)
            zeros = lambda count: [Q(0)] * count
            step = [row + zeros(n + len(middle)) for row in turned] + [zeros(n) + row + zeros(len(middle)) for row in turned]
            step += [image[m] for m in middle]
            broken += [sub(a, b) for a, b in zip(image, mul(self.nets, step))]
            steps.append(step)
        apart = [a + [-x for x in a] + [Q(0)] * len(middle) for a in identity(n)]
        self.all = kernel(closed(broken, steps), width)
        self.equal = kernel(closed(broken + apart, steps), width)
        self.overlap()

    def substituted(self, scale, shift):
        """On coefficients: p(x, y) -> p(scale (x, y + shift))."""
        moved = [(scale * x, scale * (y + shift)) for x, y in monomials(2, self.k)]
        return interpolated(self.k, table(self.k, moved))

    def chart(self, side):
        """By the coefficients of a polynomial in the chart those of the net that has it as its limit."""
        mask, at, all_ = self.border.masks[side], self.border.places[side], monomials(2, self.k)
        # S on polynomials: the new values at the points of the simplex.
        images = []
        for a in all_:
            row = [Q(0)] * len(all_)
            for b, c in mask.terms.items():
                old = mask.divide(minus(a, b))
                if old is not None:
                    row = [x + c * y for x, y in zip(row, table(self.k, [old])[0])]
            images.append(row)
        step = interpolated(self.k, images)
        chart = transpose(interpolated(self.k, table(self.k, [(c * at[0], c * at[1] + r) for c, r in all_])))
        columns = []
        for a, leading in zip(all_, chart):
            # The eigenvector of 2^{-|a|} with this leading part.
            shifted = [[x - (Q(1, 2 ** sum(a)) if i == j else 0) for j, x in enumerate(row)] for i, row in enumerate(step)]
            lower = [j for j, b in enumerate(all_) if sum(b) < sum(a)]
            right = [-x for x in apply(shifted, leading)]
            net = list(leading)
            if lower:
                rest = solved([[row[j] for j in lower] for row in shifted], [[x] for x in right])
                for j, (x,) in zip(lower, rest):
                    net[j] += x
            need(not any(apply(shifted, net)), "window")
            columns.append(net)
        return transpose(columns)

    def overlap(self):
        place, n = {p: i for i, p in enumerate(self.points)}, self.n
        values = mul(self.nets, transpose(self.all, len(self.nets[0])))
        count = len(self.all)
        rows = [values[i] + [-x for x in values[place[p[0], p[1] - 1]]] for p, i in place.items() if (p[0], p[1] - 1) in place]
        moved = self.substituted(Q(1), 1)
        for both in kernel(rows, 2 * count):
            own, after = ([sum((c * t[j] for c, t in zip(part, self.all)), Q(0)) for j in range(2 * n)]
                          for part in (both[:count], both[count:]))
            for side in (0, n):
                need(apply(moved, own[side:side + n]) == after[side:side + n], "window")

    def below(self, triples, radius, order):
        nets = [apply(self.nets, t) for t in triples]
        _, high = bounds(modulo(nets, self.operators), radius)
        need(high < Q(1, 2 ** order), "orders")


def closed(rows, steps):
    """The smallest space of rows that steps keep from the right."""
    space = echelon(rows)[0]
    while True:
        longer = echelon(space + [row for step in steps for row in (mul(space, step) if space else [])])[0]
        if len(longer) == len(space):
            return longer
        space = longer


def check(case_text, certificate_text):
    value = check_curves.read(certificate_text)
    kind = value.get("kind") if isinstance(value, dict) else None
    need(kind in ("lattice", "border"), "format")
    return (Lattice if kind == "lattice" else Border)(case_text, value)


if __name__ == "__main__":
    sys.exit(check_curves.main(sys.argv[1:], check, __doc__))
