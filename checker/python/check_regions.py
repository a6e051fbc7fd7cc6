#!/usr/bin/env python3
"""A second opinion on secant's certificates of families of masks and curves with a parameter (kind `region`), by section 9.2 of
docs/certificate.md, with the standard library only.

Usage: check_regions.py CASE.toml CERTIFICATE.json     (exit 0 accepted, 1 rejected, 2 unreadable)

It is written for reading, not for hostile input: use secant-check where limits matter.
"""
import sys
import tomllib
from collections import namedtuple
from fractions import Fraction as Q
from itertools import product

import check_curves
from check_curves import (
    characteristic, combine, echelon, envelope, fields, identity, index, mul, need, rational, times, transpose, trim, vector, word
)

# ---- polynomials in the parameter: lists of coefficients, lowest first, [] for 0 -------------------------------------


def value(f, x):
    v = Q(0)
    for c in reversed(f):
        v = v * x + c
    return v


def plus(f, g, factor=1):
    return combine(f, factor, g)


def minus(f, g):
    return plus(f, g, -1)


def scaled(f, c):
    return trim(x * c for x in f)


def division(f, g):
    need(g, "division")
    rest, quotient = list(f), [Q(0)] * max(len(f) - len(g) + 1, 0)
    for k in reversed(range(len(quotient))):
        c = quotient[k] = rest[k + len(g) - 1] / g[-1]
        for j, x in enumerate(g):
            rest[k + j] -= c * x
    return trim(quotient), trim(rest)


def divided(f, g):
    quotient, rest = division(f, g)
    need(not rest, "division")
    return quotient


def common(f, g):
    """A monic common divisor; of two zeros 0."""
    while g:
        f, g = g, division(f, g)[1]
        g = scaled(g, 1 / g[-1]) if g else g
    return scaled(f, 1 / f[-1]) if f else f


def roots(f, a, b):
    """The number of different roots of f in (a, b] (Sturm)."""
    need(f, "roots")
    slope = lambda h: trim(k * c for k, c in enumerate(h))[1:] if len(h) > 1 else []
    derivative = lambda h: trim([k * c for k, c in enumerate(h)][1:])
    f = divided(f, common(f, derivative(f))) if derivative(f) else f
    chain = [f, derivative(f)]
    while len(chain[-1]) > 1:
        chain.append(scaled(division(chain[-2], chain[-1])[1], -1))
    def changes(x):
        signs = [v > 0 for v in (value(h, x) for h in chain if h) if v != 0]
        return sum(s != t for s, t in zip(signs, signs[1:]))
    return changes(a) - changes(b)


class End:
    """A real number."""

    def __init__(self, item):
        polynomial, interval = fields(item, "polynomial", "interval")
        self.polynomial, (self.lo, self.hi) = vector(polynomial), vector(interval, 2)
        f = self.polynomial
        need(len(f) >= 2 and f[-1] == 1, "end")
        if len(f) == 2:
            need(self.lo == self.hi == -f[0], "end")
        else:
            need(self.lo < self.hi and value(f, self.lo) * value(f, self.hi) < 0 and roots(f, self.lo, self.hi) == 1, "end")

    def same(self, other):
        return (self.polynomial, self.lo, self.hi) == (other.polynomial, other.lo, other.hi)

    def equals(self, number):
        return self.polynomial == [-number, Q(1)]

    def vanishes(self, f):
        if self.lo == self.hi:
            return value(f, self.lo) == 0
        g = common(f, self.polynomial)
        return len(g) > 1 and roots(g, self.lo, self.hi) == 1

    def far(self, f):
        return value(f, self.lo) != 0 and (self.lo == self.hi or roots(f, self.lo, self.hi) == 0)


class Part:
    """A point, or an open interval."""

    def __init__(self, start, finish, point):
        self.start, self.finish, self.point = start, finish, point
        self.middle = start.lo if point else (start.hi + finish.lo) / 2

    def free(self, f):
        """Whether f is seen to have no root on the part."""
        if self.point:
            return self.start.far(f)
        own = int(self.start.lo < self.start.hi and self.start.vanishes(f)) + int(self.finish.vanishes(f))
        return roots(f, self.start.lo, self.finish.hi) == own

    def sign(self, f):
        if not f:
            return 0
        if self.point and self.start.vanishes(f):
            return 0
        need(self.free(f), "sign")
        v = value(f, self.middle)
        return (v > 0) - (v < 0)

    def nonzero(self, v):
        return self.sign(dot(v, v)) != 0


# ---- matrices of polynomials -----------------------------------------------------------------------------------------

def dot(v, w):
    total = []
    for x, y in zip(v, w):
        total = plus(total, times(x, y))
    return total


def image(m, v):
    return [dot(row, v) for row in m]


def column(m, j):
    return [row[j] for row in m]


def multiplied(a, b):
    return [[dot(row, col) for col in zip(*b)] for row in a]


def unit(n):
    return [[[Q(1)] if i == j else [] for j in range(n)] for i in range(n)]


def faddeev(m):
    """det(x − M), lowest coefficient first, and the M_k with adj(x − M) = Σ M_k x^k."""
    n, chi, following, all_ = len(m), [[Q(1)]], unit(len(m)), []
    for k in range(1, n + 1):
        all_.append(following)
        following = multiplied(m, following)
        trace = []
        for i in range(n):
            trace = plus(trace, following[i][i])
        c = scaled(trace, Q(-1, k))
        following = [[plus(x, c) if i == j else x for j, x in enumerate(row)] for i, row in enumerate(following)]
        chi.append(c)
    return chi[::-1], all_[::-1]


def at(coefficients, x):
    v = []
    for c in reversed(coefficients):
        v = plus(times(v, x), c)
    return v


def adjugate(all_, x):
    n = len(all_)
    return [[at([m[i][j] for m in all_], x) for j in range(n)] for i in range(n)]


def determinant(m):
    return scaled(faddeev(m)[0][0], (-1) ** len(m))


def turned(v, sign):
    return [scaled(f, sign) for f in v]


def stable(m):
    """All eigenvalues in the open unit disc (Schur, Cohn)."""
    p = characteristic(m)
    while len(p) > 1:
        if abs(p[0]) >= abs(p[-1]):
            return False
        ratio = p[0] / p[-1]
        p = [p[k] - ratio * p[len(p) - 1 - k] for k in range(1, len(p))]
    return True


def member(m, x):
    return [[value(f, x) for f in row] for row in m]


class Word:
    """A word of matrices and its critical polynomials, of which one vanishes where an eigenvalue comes to the circle."""

    def __init__(self, letters, w):
        need(w and all(k < len(letters) for k in w), "word")
        m = unit(len(letters[0]))
        for k in w:
            m = multiplied(m, letters[k])
        chi, n = faddeev(m)[0], len(m)
        pairs = [(i, j) for i in range(n) for j in range(i)]
        second = [[minus(times(m[i][k], m[j][l]), times(m[i][l], m[j][k])) for k, l in pairs] for i, j in pairs]
        of = lambda c, x: at(c, [Q(x)])
        self.m, self.critical = m, [of(chi, 1), of(chi, -1), of(faddeev(second)[0], 1) if pairs else [Q(1)]]

    def large(self, part):
        """True, False (below 1), or None."""
        if not all(self.critical):
            return True
        if part.point and any(part.start.vanishes(f) for f in self.critical):
            return True
        if not all(part.free(f) for f in self.critical):
            return None
        return not stable(member(self.m, part.middle))


# ---- hulls: functions on a piece of the range as mid + slope t ± rest, −1 <= t <= 1 ----------------------------------

PLACES = 1 << 160


class Model:
    """In units of 1/PLACES."""

    def __init__(self, mid, slope=0, rest=0):
        self.mid, self.slope, self.rest = mid, slope, rest

    @staticmethod
    def line(mid, slope=Q(0), rest=Q(0)):
        down = lambda q: (q.numerator * PLACES) // q.denominator
        return Model(down(mid), down(slope), -down(-rest) + 2)

    def __add__(self, other):
        return Model(self.mid + other.mid, self.slope + other.slope, self.rest + other.rest)

    def __sub__(self, other):
        return Model(self.mid - other.mid, self.slope - other.slope, self.rest + other.rest)

    def __mul__(self, other):
        # The square t^2 lies between 0 and 1: half of it goes to the middle.
        square = self.slope * other.slope
        rest = abs(square) + 2 * (other.rest * (abs(self.mid) + abs(self.slope) + self.rest) + self.rest * (abs(other.mid) + abs(other.slope)))
        mid, slope = 2 * self.mid * other.mid + square, self.mid * other.slope + self.slope * other.mid
        return Model(mid // (2 * PLACES), slope // PLACES, rest // (2 * PLACES) + 3)

    def size(self):
        return abs(self.mid) + abs(self.slope) + self.rest

    def sign(self):
        return 0 if abs(self.mid) <= abs(self.slope) + self.rest else 1 if self.mid > 0 else -1


def total(models):
    result = Model(0)
    for m in models:
        result = result + m
    return result


def moved(m, v):
    return [total(a * x for a, x in zip(row, v)) for row in m]


def enclosed(f, x):
    v = Model(0)
    for c in reversed(f):
        v = v * x + Model.line(c)
    return v


class Hull:
    def __init__(self, letters, item):
        seeds, vertices, start, pieces = fields(item, "seeds", "vertices", "from", "pieces")
        self.n = n = len(letters[0])
        known = lambda w: need(all(k < len(letters) for k in w), "word") or tuple(w)
        self.seeds = []
        for seed in seeds:
            w, c, s = fields(seed, "word", "column", "scale")
            self.seeds.append((known(word(w)), index(c, n), rational(s)))
        self.labels = []
        for vertex in vertices:
            seed, w = fields(vertex, "seed", "word")
            self.labels.append((index(seed, len(self.seeds)), known(word(w))))
        need(self.labels and len(set(self.labels)) == len(self.labels) <= 400 and pieces, "hull")
        self.inside = [(v, i) for v, (seed, w) in enumerate(self.labels) for i in range(len(letters)) if not self.known(seed, w, i)]
        need(self.inside, "hull")
        self.start = here = rational(start)
        for piece in pieces:
            to, values, bases = fields(piece, "to", "values", "bases")
            to = rational(to)
            need(here < to, "hull")
            p = Model.line((here + to) / 2, (to - here) / 2)
            self.piece([[[enclosed(f, p) for f in row] for row in m] for m in letters], values, bases)
            here = to
        self.finish = here
        self.words = [w for w, _, _ in self.seeds if w]

    def known(self, seed, w, letter):
        longer = (letter,) + w
        return (seed, longer) in self.labels or (longer == self.seeds[seed][0] and (seed, ()) in self.labels)

    def piece(self, letters, values, bases):
        lines = iter(values)
        starts = []
        for w, c, s in self.seeds:
            e = [Model.line(Q(int(i == c))) for i in range(self.n)]
            v = self.eigenvector(letters, w, e, vector(next(lines), 3)) if w else e
            starts.append([x * Model.line(s) for x in v])
        need(next(lines, None) is None and len(bases) == len(self.inside), "hull")
        points = []
        for seed, w in self.labels:
            v = starts[seed]
            for k in reversed(w):
                v = moved(letters[k], v)
            points.append(v)
        for (v, letter), basis in zip(self.inside, bases):
            need(len(basis) == self.n and all(a < b for a, b in zip(basis, basis[1:])), "hull")
            need(basis[0] >= 0 and basis[-1] < len(points), "hull")
            need(self.combined([points[b] for b in basis], moved(letters[letter], points[v])), "hull")

    def eigenvector(self, letters, w, e, line):
        mid, slope, rest = line
        need(rest > 0, "hull")
        m = letters[w[0]]
        for k in w[1:]:
            m = [[total(x * y for x, y in zip(row, col)) for col in zip(*letters[k])] for row in m]
        # det(x − M) and adj(x − M) e by Faddeev and Le Verrier.
        n, chi, following, ys = self.n, [Model.line(Q(1))], [[Model.line(Q(int(i == j))) for j in range(self.n)] for i in range(self.n)], []
        for k in range(1, n + 1):
            ys.append(moved(following, e))
            following = [[total(x * y for x, y in zip(row, col)) for col in zip(*following)] for row in m]
            c = total(following[i][i] for i in range(n)) * Model.line(Q(-1, k))
            following = [[x + c if i == j else x for j, x in enumerate(row)] for i, row in enumerate(following)]
            chi.append(c)
        def side(x):
            v = Model(0)
            for c in chi:
                v = v * x + c
            return v.sign()
        need(side(Model.line(mid - rest, slope)) * side(Model.line(mid + rest, slope)) == -1, "hull")
        x, out = Model.line(mid, slope, rest), [Model(0)] * n
        for y in ys:
            out = [a * x + b for a, b in zip(out, y)]
        return out

    def combined(self, basis, x):
        """Whether x is a combination of the basis with Σ|c| < 1, at every t."""
        n = self.n
        rows = [[Q(v[i].mid, PLACES) for v in basis] + [Q(int(i == j)) for j in range(n)] for i in range(n)]
        reduced, pivots = echelon(rows)
        need(pivots == list(range(n)), "hull")
        near = [[Model.line(Q(int(y * 2 ** 60), 2 ** 60)) for y in row[n:]] for row in reduced]
        error = [[Model.line(Q(int(i == j))) - total(a * b for a, b in zip(row, v)) for j, v in enumerate(basis)]
                 for i, row in enumerate(near)]
        size = max(sum(x.size() for x in row) for row in error)
        need(size < PLACES, "hull")
        # c = z + E z + …, z = Y x.
        z = moved(near, x)
        first = moved(error, z)
        largest = max(c.size() for c in z)
        rest = size * size * largest // (PLACES * (PLACES - size)) + 1
        whole = Model(0)
        for a, b in zip(z, first):
            c = a + b
            c = Model(c.mid, c.slope, c.rest + rest)
            whole = whole + c if c.sign() > 0 else whole - c if c.sign() < 0 else whole + Model(c.size())
        return whole.size() < PLACES

    def covers(self, part):
        return self.start <= part.start.lo and part.finish.hi <= self.finish


# ---- tables of parts -------------------------------------------------------------------------------------------------

class Family:
    def __init__(self, text, value, keys):
        form, version, kind, name, verdict, self.proof = envelope(value)
        self.file = file = tomllib.loads(text)
        need(form == "secant certificate" and version == 1 and kind == "region" and name == file["name"], "format")
        need(set(file) == {"name", "parameter", "range", *keys}, "case")
        self.range = vector(file["range"], 2)
        need(self.range[0] < self.range[1], "case")
        self.case, self.verdict, self.lines, self.found = namedtuple("Named", "name")(name), verdict, [], []

    def finish(self):
        order = ["refuted", "undetermined", "proved"]
        need(self.found and min(self.found, key=order.index) == self.verdict, "verdict")

    def parts(self, items, about, judge):
        need(len(items) % 2 == 1, "parts")
        last = None
        for number, item in enumerate(items):
            start, finish, verdict, rule, by = fields(item, "from", "to", "verdict", "rule", "by")
            start, finish = End(start), End(finish)
            need(start.equals(self.range[0]) if last is None else start.same(last), "parts")
            need(start.same(finish) if number % 2 == 0 else start.hi < finish.lo, "parts")
            part = Part(start, finish, number % 2 == 0)
            need(verdict == ("undetermined" if rule == "none" else judge(part, rule, by)), "parts")
            self.found.append(verdict)
            self.lines.append(f"{verdict}: {about}, " + (f"at the root of {[str(c) for c in start.polynomial]} near {start.lo}"
                              if part.point else f"between those near {start.lo} and {finish.hi}"))
            last = finish
        need(last.equals(self.range[1]), "parts")

    def contracts(self, letters, hulls, number, part):
        hull = hulls[index(number, len(hulls))]
        need(hull.covers(part), "hull")
        need(all(self.word(letters, w).large(part) is False for w in hull.words), "hull")

    def word(self, letters, w):
        key = (id(letters), tuple(w))
        self.words = getattr(self, "words", {})
        if key not in self.words:
            self.words[key] = Word(letters, w)
        return self.words[key]


class Masks(Family):
    def __init__(self, text, value):
        super().__init__(text, value, ("arity", "mask"))
        self.arity = n = index(self.file["arity"], 17)
        mask = [trim(vector(f)) for f in self.file["mask"]]
        need(n >= 2 and 1 <= len(mask) <= 64 and mask[0] and mask[-1], "case")
        for r in range(n):
            total_ = []
            for f in mask[r::n]:
                total_ = plus(total_, f)
            need(total_ == [Q(1)], "case")
        self.rules, b = 0, mask
        while True:
            quotient, rest = self.smoothed(b)
            if not quotient or any(rest):
                break
            self.rules, b = self.rules + 1, quotient
        need(self.rules >= 1, "case")
        self.rest, independent, orders = [f for f in rest if f], *fields(self.proof, "independent", "orders")
        self.guard = self.independent(self.digits(mask, 1), independent)
        need(orders, "orders")
        for k, item in enumerate(orders):
            order, hulls, parts = fields(item, "order", "hulls", "parts")
            need(order == k <= self.rules, "orders")
            letters = self.digits(b, n ** k)
            hulls = [Hull(letters, h) for h in hulls]
            self.parts(parts, "converges" if k == 0 else f"C^{k}", lambda part, rule, by: self.judge(letters, hulls, k, part, rule, by))
        self.finish()

    def smoothed(self, a):
        """Quotient and rest of a division by 1 + z + … + z^{N−1}, from the lowest coefficient up."""
        rest, quotient = list(a), []
        for k in range(len(a) - self.arity + 1):
            c = rest[k]
            quotient.append(c)
            for j in range(k, k + self.arity):
                rest[j] = minus(rest[j], c)
        return quotient, rest

    def digits(self, b, factor):
        n, size = self.arity, max(-(-(len(b) - 1) // (self.arity - 1)), 1)
        entry = lambda k: scaled(b[k], factor) if 0 <= k < len(b) else []
        return [[[entry(n * i - j + e) for j in range(size)] for i in range(size)] for e in range(n)]

    def independent(self, letters, choices):
        guard, n = [], len(letters[0])
        for item in choices:
            c, words = fields(item, "column", "words")
            words = [word(w) for w in words]
            need(len(words) == n - 1 and all(k < len(letters) for w in words for k in w), "independent")
            x = column(adjugate(faddeev(letters[0])[1], [Q(1)]), index(c, n))
            rows = [x]
            for w in words:
                y = x
                for k in reversed(w):
                    y = image(letters[k], y)
                rows.append([minus(a, b) for a, b in zip(y, x)])
            guard = common(determinant(rows), guard)
        return guard

    def judge(self, letters, hulls, k, part, rule, by):
        if rule == "hull":
            need(k < self.rules and len(by) == 1, "hull")
            self.contracts(letters, hulls, by[0], part)
            return "proved"
        need(k == 0 or self.guard and part.free(self.guard), "independent")
        if rule == "word":
            need(k < self.rules and self.word(letters, word(by)).large(part) is True, "word")
        else:
            need(rule == "sum-rules" and k == self.rules and by == [], "sum-rules")
            divisor = []
            for f in self.rest:
                divisor = common(f, divisor)
            need(divisor and part.free(divisor), "sum-rules")
        return "refuted"


class Curves(Family):
    def __init__(self, text, value):
        super().__init__(text, value, ("reversed", "control", "pieces"))
        need(set(self.file["reversed"]) <= {"0", "1"}, "case")
        self.back = [x == "1" for x in self.file["reversed"]]
        pieces = [[[trim(vector(f)) for f in row] for row in m] for m in self.file["pieces"]]
        d = len(pieces[0])
        need(2 <= d <= 5 and 2 <= len(pieces) == len(self.back) <= 8, "case")
        need(all(len(m) == d and all(len(row) == d for row in m) for m in pieces), "case")
        add = lambda v: v[0] if len(v) == 1 else plus(v[0], add(v[1:]))
        need(all(add(column(m, j)) == [Q(1)] for m in pieces for j in range(d)), "case")
        control = [vector(row, d) for row in self.file["control"]]
        need(not control or len(echelon([[x - row[0] for x in row[1:]] for row in control])[1]) == d - 1, "case")
        self.linear = [[[minus(m[i][j], m[i][0]) for j in range(1, d)] for i in range(1, d)] for m in pieces]
        self.n, self.germs, ends = d - 1, [self.germ(True), self.germ(False)], []
        for _, prefix, cycle in self.germs:
            m = unit(d)
            for k in cycle:
                m = multiplied(m, pieces[k])
            adj = adjugate(faddeev(m)[1], [Q(1)])
            fixed = next((v for v in (column(adj, j) for j in range(d)) if add(v)), None)
            need(fixed is not None, "case")
            divisor = []
            for f in fixed:
                divisor = common(f, divisor) if f else divisor
            fixed = [divided(f, divisor) for f in fixed]
            for k in reversed(prefix):
                fixed = image(pieces[k], fixed)
            ends.append(fixed)
        self.sums = [add(v) for v in ends]
        for k in range(1, len(pieces)):
            a = image(pieces[k - 1], ends[int(not self.back[k - 1])])
            b = image(pieces[k], ends[int(self.back[k])])
            need(all(times(x, add(b)) == times(y, add(a)) for x, y in zip(a, b)), "case")
        both = times(*self.sums)
        self.chord = [times(minus(times(y, self.sums[0]), times(x, self.sums[1])), both) for x, y in list(zip(*ends))[1:]]
        hulls, contraction, self.facts, claims = fields(self.proof, "hulls", "contraction", "facts", "claims")
        hulls = [Hull(self.linear, h) for h in hulls]

        def contraction_judge(part, rule, by):
            if rule == "hull":
                need(len(by) == 1, "hull")
                self.contracts(self.linear, hulls, by[0], part)
                return "proved"
            need(rule == "word" and self.word(self.linear, word(by)).large(part) is True, "word")
            return "refuted"

        def claim_judge(claim):
            def judge(part, rule, by):
                need(rule == "fact" and len(by) == 2, "parts")
                self.contracts(self.linear, hulls, by[1], part)
                return Argument(self, part, self.facts[index(by[0], len(self.facts))]).about(claim)
            return judge

        self.parts(contraction, "contracts", contraction_judge)
        need(len(claims) == 3, "claims")
        for wanted, item in zip(("ends", "joints", "g1"), claims):
            claim, parts = fields(item, "claim", "parts")
            need(claim == wanted, "claims")
            self.parts(parts, claim, claim_judge(claim))
        self.finish()

    def germ(self, start):
        """At which end the cycle is, the prefix, the cycle."""
        side, seen, letters = start, [], []
        while side not in seen:
            seen.append(side)
            letters.append(0 if side else len(self.back) - 1)
            side ^= self.back[letters[-1]]
        k = seen.index(side)
        return side, letters[:k], letters[k:]

    def along(self, w):
        m = unit(self.n)
        for k in w:
            need(k < len(self.linear), "word")
            m = multiplied(m, self.linear[k])
        return m

    def turn(self, w):
        return (-1) ** sum(self.back[k] for k in w)


Leading = namedtuple("Leading", "positive projection")
Line = namedtuple("Line", "ray positive row forward")


class Argument:
    """A FACT on a part."""

    def __init__(self, curve, part, fact):
        names = ("claim", "verdict", "why", "span", "at", "values", "rays", "cycles")
        self.claim, self.verdict, self.why, span, self.at, self.values, rays, self.cycles = fields(fact, *names)
        self.curve, self.part, self.sign = curve, part, part.sign
        self.rays = [[trim(vector(f)) for f in ray] for ray in rays]
        need(len(self.values) == 2 and all(self.sign(s) for s in curve.sums) and part.nonzero(curve.chord), "chord")
        need(all(part.nonzero([x for row in m for x in row]) for m in curve.linear), "chord")
        images = []
        for w in span:
            v = curve.chord
            for k in reversed(word(w)):
                v = image(curve.linear[k], v)
            images.append(v)
        need(len(images) == curve.n and self.sign(determinant(images)) != 0, "span")

    def about(self, claim):
        need(self.claim == claim, "fact")
        allowed = {"spiral": ("ends", "g1"), "alternates": ("g1",), "corner": ("joints", "g1"), "cusp": ("g1",), "jumps": ("g1",),
                   "in-cone": ("ends", "joints"), "cones": ("ends", "joints", "g1")}
        need(claim in allowed[self.why], "why")
        getattr(self, self.why.replace("-", "_"))()
        found = "proved" if self.why in ("in-cone", "cones") else "refuted"
        if found == "proved" and claim == "joints":
            need(all(self.sign(determinant(m)) != 0 for m in self.curve.linear), "injective")
        return found

    def parallel(self, a, b):
        return all(self.sign(minus(times(a[i], b[j]), times(a[j], b[i]))) == 0 for i in range(len(a)) for j in range(i))

    def leading(self, w, item):
        lam = trim(vector(item))
        chi, all_ = faddeev(self.curve.along(w))
        need(not at(chi, lam) and self.sign(lam) != 0, "lead")
        psi = []
        for c in reversed(chi[1:]):
            psi.append(plus(times(psi[-1], lam), c) if psi else c)
        psi.reverse()
        rest, power = [], [Q(1)]
        for c in psi:
            rest.append(times(c, power))
            power = times(power, lam)
        while len(rest) > 1:
            first, last, n = rest[0], rest[-1], len(rest) - 1
            need(self.sign(minus(times(last, last), times(first, first))) > 0, "lead")
            rest = [minus(times(last, rest[k]), times(first, rest[n - k])) for k in range(1, n + 1)]
        side = self.sign(at(psi, lam))
        need(side != 0, "lead")
        return Leading(self.sign(lam) > 0, [turned(row, side) for row in adjugate(all_, lam)])

    def line(self, end):
        curve = self.curve
        at_start, prefix, cycle = curve.germs[end]
        need(self.values[end] is not None, "values")
        lead, through, forward = self.leading(cycle, self.values[end]), curve.along(prefix), 1 if at_start else -1
        count = len(curve.linear)
        differences, total_ = [turned(curve.chord, forward)], [[]] * curve.n
        for k in range(count - 1):
            l = k if at_start else count - 1 - k
            step = turned(image(curve.linear[l], curve.chord), forward * curve.turn([l]))
            total_ = [plus(a, b) for a, b in zip(total_, step)]
            differences.append(total_)
        for a in differences:
            v = image(lead.projection, a)
            if any(v) and self.part.nonzero(v):
                for k, x in enumerate(v):
                    s = self.sign(x)
                    if s:
                        ray = image(through, v)
                        need(self.part.nonzero(ray), "lead")
                        return Line(ray, lead.positive, turned(lead.projection[k], s), forward)
        need(False, "lead")

    def joint(self, k):
        lines, curve, sides = [self.line(0), self.line(1)], self.curve, []
        need(k + 1 < len(curve.linear), "joint")
        for letter, finish in ((k, True), (k + 1, False)):
            line = lines[int(finish != curve.back[letter])]
            ray = image(curve.linear[letter], line.ray)
            need(self.part.nonzero(ray), "joint")
            sides.append((ray, line.positive))
        return sides

    def turns(self, sides):
        (a, up), (b, on) = sides
        return self.sign(dot(a, b)) if up and on and self.parallel(a, b) else None

    def spiral(self):
        _, prefix, cycle = self.curve.germs[index(self.at[0], 2)]
        chi = faddeev(self.curve.along(cycle))[0]
        need(self.curve.n == 2 and self.sign(minus(times(chi[1], chi[1]), scaled(chi[0], 4))) < 0, "spiral")
        need(self.sign(determinant(self.curve.along(prefix))) != 0, "spiral")

    def alternates(self):
        need(not self.line(index(self.at[0], 2)).positive, "why")

    def corner(self):
        (a, _), (b, _) = self.joint(index(self.at[0], 8))
        need(not self.parallel(a, b), "why")

    def cusp(self):
        need(self.turns(self.joint(index(self.at[0], 8))) == 1, "why")

    def jumps(self):
        line = self.joint(index(self.at[0], 8))[index(self.at[1], 2)][0]
        need(len(self.cycles) == 1, "cycles")
        w, lam = fields(self.cycles[0], "word", "value")
        w = word(w)
        need(w, "cycles")
        lead, kept = self.leading(w, lam), image(self.curve.along(w), line)
        need(self.part.nonzero(kept) and self.parallel(kept, line), "cycles")
        for j in range(len(line)):
            v = column(lead.projection, j)
            if any(v) and self.part.nonzero(v):
                need(not self.parallel(v, line), "cycles")
                return
        need(False, "cycles")

    def cone(self):
        """By letter which coefficients of the images of the rays are positive."""
        curve, n = self.curve, self.curve.n
        need(len(self.rays) == n and all(len(r) == n for r in self.rays), "cone")
        cone = [list(row) for row in zip(*self.rays)]
        det = self.sign(determinant(cone))
        need(det != 0, "cone")
        # adj(−G) = (−1)^(n−1) adj(G)
        inverse = [turned(row, det * (-1) ** (n - 1)) for row in adjugate(faddeev(cone)[1], [])]
        need(all(self.sign(c) >= 0 for c in image(inverse, curve.chord)), "cone")
        patterns = []
        for l, m in enumerate(curve.linear):
            signs = [[self.sign(f) * curve.turn([l]) for f in row] for row in multiplied(multiplied(inverse, m), cone)]
            need(all(s >= 0 for row in signs for s in row) and all(any(col) for col in zip(*signs)), "cone")
            patterns.append([[s > 0 for s in row] for row in signs])
        return patterns

    def in_cone(self):
        lines = [self.line(0), self.line(1)]
        self.cone()
        for line in lines:
            need(line.positive and all(self.sign(dot(line.row, r)) * line.forward >= 0 for r in self.rays), "why")
        if self.claim == "joints":
            for k in range(len(self.curve.linear) - 1):
                (a, _), (b, _) = self.joint(k)
                need(self.parallel(a, b), "why")

    def cones(self):
        window, patterns = index(self.at[0], 7), self.cone()
        need(window >= 1, "cycles")
        n = self.curve.n
        after = lambda a, b: [[any(a[i][k] and b[k][j] for k in range(n)) for j in range(n)] for i in range(n)]
        idle = [((), [])]
        for _ in range(window):
            longer = []
            for w, ends in idle:
                for letter, step in enumerate(patterns):
                    products = [after(end, step) for end in ends] + [step]
                    if not any(all(x for row in m for x in row) for m in products):
                        longer.append((w + (letter,), products))
            idle = longer
            need(len(idle) <= 400, "limit")
        words = [w for w, _ in idle]
        following = [[k for k, b in enumerate(words) if a[1:] == b[:-1]] for a in words]
        cycles = [[words[k][0] for k in cycle] for cycle in disjoint(following)]
        need(len(cycles) == len(self.cycles), "cycles")
        for item, cycle in zip(self.cycles, cycles):
            w, lam = fields(item, "word", "value")
            need(word(w) == cycle, "cycles")
            lead = self.leading(cycle, lam)
            need(lead.positive == (self.curve.turn(cycle) > 0), "cycles")
            need(any(self.pulls(row) for row in lead.projection), "cycles")
        for k in range(len(self.curve.linear) - 1):
            need(self.turns(self.joint(k)) == -1, "why")

    def pulls(self, row):
        try:
            return {self.sign(dot(row, r)) for r in self.rays} in ({1}, {-1})
        except check_curves.Rejected:
            return False


def disjoint(following):
    """The cycles of a graph of which no two meet."""
    n, reach = len(following), []
    for k in range(n):
        seen, open_ = set(), list(following[k])
        while open_:
            j = open_.pop()
            if j not in seen:
                seen.add(j)
                open_ += following[j]
        reach.append(seen)
    back = [[j for j in following[k] if k in reach[j]] for k in range(n)]
    need(all(len(b) <= 1 for b in back), "cycles")
    cycles, done = [], set()
    for k in range(n):
        cycle = []
        while k not in done and back[k]:
            done.add(k)
            cycle.append(k)
            k = back[k][0]
        if cycle:
            cycles.append(cycle)
    return cycles


def check(case_text, certificate_text):
    value = check_curves.read(certificate_text)
    need(isinstance(value, dict) and value.get("kind") == "region", "format")
    return (Curves if "claims" in value["proof"] else Masks)(case_text, value)


if __name__ == "__main__":
    sys.exit(check_curves.main(sys.argv[1:], check, __doc__))
