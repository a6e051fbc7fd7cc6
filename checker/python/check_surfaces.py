#!/usr/bin/env python3
"""A second opinion on certificates of tangent planes, by section 8.1 of docs/certificate.md, with the standard library only.

Usage: check_surfaces.py CASE.toml CERTIFICATE.json     (exit 0 accepted, 1 rejected, 2 unreadable)

It covers cases whose operators are written out, at points, at a dense set, and "every point" by a point or by the curves of a product;
what rests on the rules `derivative` and `cones` is rejected as not covered.
"""
import sys
import tomllib
from fractions import Fraction as Q
from itertools import combinations

import check_curves
from check_curves import (
    ARCS, COMPONENTS, DERIVATIVE, SHARES, Case, Certificate, Germ, Model, Top, address, apply, check_point, combine,
    echelon, envelope, fields, grow, horner_complex, i_add, i_mul, i_sign, i_sub, identity, index, mul, need, place_of,
    rational, sub, transpose, vector, weighted)


# ---- parameters ------------------------------------------------------------------------------------------------------

QUAD, TRIANGLE = [(0, 0), (1, 0), (1, 1), (0, 1)], [(0, 0), (1, 0), (0, 1)]


class NoParameters(Exception):
    pass


class Chart:
    """The faces of a case as divisions of one square or one triangle: parameters are pairs (u, v)."""

    def __init__(self, case, table, reachable):
        self.case, names = case, [s["name"] for s in table]
        if table[case.start].get("kind") != "face":
            raise NoParameters
        self.triangle = "side01" in table[case.start]
        self.corners = TRIANGLE if self.triangle else QUAD
        self.maps, self.turned, shares = {}, {}, False
        for e in reachable:
            state = table[e]
            sides = ("side01", "side12", "side02") if self.triangle else ("bottom", "right", "top", "left")
            if state.get("kind") != "face" or not all(s in state for s in sides):
                raise NoParameters
            need("layout" in state and (state["layout"] == "triangle") == self.triangle, "case")
            cells, parts = self.cells(state["layout"])
            need(len(cells) == len(case.states[e][1]), "case")
            if min(parts) < 2:
                raise NoParameters
            edges = [names.index(state[s]["edge"]) for s in sides]
            own = [case.shares[k] for k in edges]
            shares = shares or any(s is not None for s in own)
            cuts = [self.cuts(s, parts[k % 2]) for k, s in enumerate(own)]
            if self.triangle and any(s is not None for s in own):
                raise NoParameters
            if not self.triangle and (cuts[0] != cuts[2] or cuts[1] != cuts[3]):
                raise NoParameters
            if [len(c) - 1 for c in cuts[:2]] != parts:
                raise NoParameters
            self.maps[e], self.turned[e] = [], []
            for piece, cell in zip(state["piece"], cells):
                order = piece.get("corners", list(range(len(cell))))
                need(sorted(order) == list(range(len(cell))), "case")
                at = [cell[k] for k in order]
                if len(at) == 4 and any(at[0][i] + at[2][i] != at[1][i] + at[3][i] for i in (0, 1)):
                    raise NoParameters
                places = [(cuts[0][i], cuts[1][j]) for i, j in at]
                origin, last = places[0], places[-1]
                columns = [sub(places[1], origin), sub(last, origin)]
                self.maps[e].append((transpose(columns), list(origin)))
                self.turned[e].append(at != cell)
        if shares and any(any(t) for t in self.turned.values()):
            raise NoParameters

    @staticmethod
    def cells(layout):
        if layout == "triangle":
            corner = lambda u, v: [(u, v), (u + 1, v), (u, v + 1)]
            return [corner(0, 0), corner(1, 0), corner(0, 1), [(1, 1), (0, 1), (1, 0)]], [2, 2]
        columns, rows = (int(n) for n in layout.split("x"))
        need(columns > 0 and rows > 0, "case")
        cell = lambda i, j: [(i + a, j + b) for a, b in QUAD]
        return [cell(i, j) for j in range(rows) for i in range(columns)], [columns, rows]

    @staticmethod
    def cuts(shares, parts):
        ends = [Q(0)]
        for share in shares or [Q(1, parts)] * parts:
            ends.append(ends[-1] + share)
        return ends

    def placed(self, e, letter, x):
        linear, shift = self.maps[e][letter]
        return tuple(a + b for a, b in zip(apply(linear, x), shift))

    def local(self, e, letter, x):
        """The parameter of the piece at x."""
        ((a, b), (c, d)), shift = self.maps[e][letter]
        u, v = sub(x, shift)
        det = a * d - b * c
        need(det != 0, "case")
        return (d * u - b * v) / det, (a * v - c * u) / det

    def margins(self, x):
        u, v = x
        return (u, v, 1 - u - v) if self.triangle else (u, v, 1 - u, 1 - v)

    def locate(self, model, e, addr):
        """The parameter of an address: the fixed parameter of the cycle, behind the prefix."""
        states = model.path(e, addr[0] + addr[1])
        need(states[-1] == states[len(addr[0])], "word")

        def under(letters, states, linear, shift):
            for k, s in reversed(list(zip(letters, states))):
                a, p = self.maps[s][k]
                linear, shift = mul(a, linear), [x + y for x, y in zip(apply(a, shift), p)]
            return linear, shift

        (a, b), s = under(addr[1], states[len(addr[0]):], identity(2), [Q(0), Q(0)])
        u, v, det = 1 - a[0], 1 - b[1], (1 - a[0]) * (1 - b[1]) - a[1] * b[0]
        need(det != 0, "case")
        fixed = [(v * s[0] + a[1] * s[1]) / det, (u * s[1] + b[0] * s[0]) / det]
        linear, shift = under(addr[0], states, identity(2), [Q(0), Q(0)])
        return tuple(x + y for x, y in zip(apply(linear, fixed), shift))

    def addresses(self, model, e, x):
        found, open_, steps = [], [([(e, tuple(x))], [])], 0
        while open_:
            cells, letters = open_.pop()
            state, here = cells[-1]
            steps += 1
            need(steps <= 20000, "limit")
            if (state, here) in cells[:-1]:
                k = cells.index((state, here))
                found.append(model.normalise((letters[:k], letters[k:]), e))
                continue
            for k in reversed(range(len(self.maps[state]))):
                local = self.local(state, k, here)
                if min(self.margins(local)) >= 0:
                    open_.append((cells + [(model.states[state][1][k][0], local)], letters + [k]))
        return found

    def vertices(self):
        start = self.case.start
        all_ = [self.placed(start, k, c) for k in range(len(self.maps[start])) for c in self.corners]
        return list(dict.fromkeys(all_))


# ---- tangent subspaces -----------------------------------------------------------------------------------------------

class Surface(Model):
    """A case without contraction where all points are those of a product."""

    def contract(self, entries):
        if entries is not None:
            super().contract(entries)


def determinant(rows):
    if len(rows) == 1:
        return rows[0][0]
    total = (Q(0), Q(0))
    for k, x in enumerate(rows[0]):
        minor = i_mul(x, determinant([r[:k] + r[k + 1:] for r in rows[1:]]))
        total = i_sub(total, minor) if k % 2 else i_add(total, minor)
    return total


def independent(vectors, count):
    """Whether so many of the enclosed vectors have a minor of known sign."""
    for rows in combinations(vectors, count):
        for columns in combinations(range(len(rows[0])), count):
            if i_sign(determinant([[r[c] for c in columns] for r in rows])):
                return True
    return False


def coefficients(top, view):
    """Rational vectors in whose span those lie that span U: of each vector over a field, one for each power."""
    if top.kind == "conformal":
        return [apply(view, v) for v in top.basis]
    if top.kind == "pair":
        chosen = [top.vectors[0]]
    else:
        longest = max(len(v) for _, v in top.chains)
        chosen = [v[0] for _, v in top.chains if len(v) == longest]
    out = []
    for v in chosen:
        seen = [weighted(row, v) for row in view]
        out += [[x[k] if k < len(x) else Q(0) for x in seen] for k in range(max((len(x) for x in seen), default=0))]
    return out


class Part:
    """What one branch contains and by what it is bounded."""

    def __init__(self, germ, value):
        self.germ = germ
        top, orbits, bound = fields(value, "top", "orbits", "bound")
        top = Top(top, germ.linear)
        self.contained, self.rational = top.directions(germ.view), coefficients(top, germ.view)
        need(isinstance(orbits, list), "format")
        for orbit in orbits:
            addr, own = fields(orbit, "address", "own")
            y, _ = germ.placed_point(addr)
            hull, pivots = grow([y], transpose(germ.linear))
            need(hull, "orbit")
            images = mul(hull, transpose(germ.linear))
            own = Top(own, [[images[j][p] for j in range(len(hull))] for p in pivots])
            seen = mul(germ.view, transpose(hull))
            self.contained += own.directions(seen)
            self.rational += coefficients(own, seen)
        if bound is None:
            self.rational = transpose(germ.view)
            self.dimension = len(echelon(germ.view)[1])
            return
        rule = bound.get("by") if isinstance(bound, dict) else None
        need(rule in ("leading", "group"), "format")
        keys = {"leading": ["functionals", "cover"], "group": ["radius", "rows", "cover"]}[rule]
        self.dimension = getattr(self, rule)(top, *fields(bound, "by", *keys)[1:])
        need(1 <= self.dimension <= 3 and independent(self.contained, self.dimension), "bound")

    def leading(self, top, functionals, cover):
        germ = self.germ
        need(top.kind in ("real", "pair") and isinstance(functionals, list), "leading")
        if top.kind == "real":
            ring, longest = top.field, max(len(v) for _, v in top.chains)
            count = sum(len(v) == longest for _, v in top.chains)
            lasts = [v[-1] for _, v in top.chains if len(v) < longest]
        else:
            ring, count, lasts = top.ring, 2, []
        rows = []
        for items in functionals:
            row = ring.vector(items, germ.n)
            images = [weighted(c, row) for c in transpose(germ.linear)]
            residual = lambda s: [combine(x, -1, ring.mul(ring.theta(s), g)) for x, g in zip(images, row)]
            need(not any(residual(1)) or not any(residual(-1)), "leading")
            need(not any(ring.dot(row, v) for v in lasts), "leading")
            if top.kind == "real":
                rows.append(self.on_points([ring.value(g) for g in row]))
            else:
                values = [horner_complex(g, top.value) for g in row]
                rows += [self.on_points([z[k] for z in values]) for k in (0, 1)]
        germ.cover(rows, cover)
        return count

    def on_points(self, values):
        germ, reach = self.germ, self.germ.model.radius[self.germ.state]
        width = lambda chart: (max(chart) - min(chart)) * reach
        error = sum(((hi - lo) / 2 * width(chart) for (lo, hi), chart in zip(values, germ.chart)), Q(0))
        return germ.on_points([(lo + hi) / 2 for lo, hi in values]), error

    def group(self, top, radius, rows, cover):
        return len(self.germ.group(radius, rows, cover)[0])


# ---- products --------------------------------------------------------------------------------------------------------

class Factor:
    """A curve of one state without control points."""

    def __init__(self, value):
        operators, contraction, points = fields(value, "operators", "contraction", "points")
        need(isinstance(operators, list) and operators and all(isinstance(a, list) and a for a in operators), "format")
        n = len(operators[0])
        self.operators = [[vector(row, n) for row in a] for a in operators]
        need(all(len(a) == n and all(sum(c) == 1 for c in zip(*a)) for a in self.operators), "product")
        self.name, self.start, self.states = "factor", 0, [("edge", [(0, a, False) for a in self.operators])]
        self.dims, self.view, self.shares, self.examine = [n], identity(n), [None], []
        self.model = Model(self, contraction)
        self.points = [check_point(self.model, 0, self.view, p) for p in points]
        linear = [self.model.linear(a, 0, 0) for a in self.operators]
        need(self.lasting(linear) or self.lasting([transpose(a) for a in linear]), "product")

    @staticmethod
    def lasting(operators):
        """Whether the smallest K with T^-1 K in K is not everything: rows that vanish on K are kept."""
        n = len(operators[0])
        rows, size = identity(n), None
        while size != (size := len(rows)):
            images, common = [mul(rows, t) if rows else [] for t in operators], []
            kernels = [kernel(image, n) for image in images]
            common = echelon([v for basis in kernels for v in basis])[0]
            rows = kernel(common, n)
        return n > 0 and size > 0

    def turns(self, value):
        """The verdict of an answer about every point of this curve."""
        question = value.get("question") if isinstance(value, dict) else None
        need(question in ("every point", DERIVATIVE, SHARES, ARCS, COMPONENTS), "every")
        asked = object.__new__(Certificate)
        asked.case, asked.model, asked.points, asked.used, asked.lines = self, self.model, self.points, set(), []
        asked.answer(question, value)
        return value["verdict"]


def kernel(rows, n):
    reduced, pivots = echelon(rows)
    basis = []
    for j in (j for j in range(n) if j not in pivots):
        v = [Q(int(k == j)) for k in range(n)]
        for row, p in zip(reduced, pivots):
            v[p] = -row[j]
        basis.append(v)
    return basis


class Product:
    def __init__(self, case, chart, value):
        need(chart is not None, "product")
        self.first, self.second = (Factor(v) for v in fields(value, "first", "second"))
        a, b = self.first.operators, self.second.operators
        pieces, start = case.states[case.start][1], case.start
        need(not chart.triangle and len(pieces) == len(a) * len(b), "product")
        cells = [chart.placed(start, k, c) for k in range(len(pieces)) for c in QUAD]
        need(len({u for u, _ in cells}) == len(a) + 1 and len({v for _, v in cells}) == len(b) + 1, "product")
        need(not any(chart.turned[start]) and all(p[0] == start for p in pieces), "product")
        for k, (_, op, _) in enumerate(pieces):
            x, y = a[k % len(a)], b[k // len(a)]
            m = len(y)
            size = len(x) * m
            need(op == [[x[r // m][c // m] * y[r % m][c % m] for c in range(size)] for r in range(size)], "product")

    def verdict(self, addr, chosen):
        need(isinstance(chosen, list) and len(chosen) == 2, "product")
        columns, verdicts = len(self.first.operators), []
        for k, curve, part in zip(chosen, (self.first, self.second), (lambda n: n % columns, lambda n: n // columns)):
            own = curve.model.normalise(([part(n) for n in addr[0]], [part(n) for n in addr[1]]), 0)
            point = curve.points[index(k, len(curve.points))]
            need(point.place == place_of(curve.model, own, 0), "product")
            verdicts.append(point.verdict)
        if "refuted" in verdicts:
            return "refuted"
        need(verdicts == ["proved", "proved"], "product")
        return "proved"


# ---- the certificate -------------------------------------------------------------------------------------------------

class Planes:
    def __init__(self, case_text, value):
        form, version, kind, name, verdict, proof = envelope(value)
        self.case = case = Case(case_text)
        need(form == "secant certificate" and version == 1 and kind == "surface" and name == case.name, "format")
        keys = ["contraction", "product", "further", "points", "dense", "answers"]
        every = proof.get("every")
        if "every" in proof:
            need(list(proof) == keys[:5] + ["every"] + keys[5:], "format")
            proof = {k: proof[k] for k in keys}
        contraction, product, further, points, dense, answers = fields(proof, *keys)
        table = tomllib.loads(case_text).get("state", [])
        self.model = model = Surface(case, contraction)
        need(case.states[case.start][0] in ("set", "face"), "surface")
        need(any(case.states[e][0] == "face" for e in model.reachable), "surface")
        try:
            self.chart = Chart(case, table, model.reachable)
        except NoParameters:
            self.chart = None
        self.contracts = contraction is not None
        self.product = Product(case, self.chart, product) if product is not None else None
        questions, places = self.questions(further)
        need(len(points) == len(places), "points")
        self.found = [p and self.plane(case.start, case.view, x, p) for x, p in zip(places, points)]
        self.every = self.everywhere(every)
        of = {x: v for x, v in zip(places, self.found)}
        verdicts = []
        for question in questions:
            if question == "dense":
                if dense is not None:
                    self.dense(dense)
                verdicts.append("proved" if dense is not None or self.every == "proved" else "undetermined")
            else:
                verdicts.append(Certificate.together([of[x] or "undetermined" for x in question]))
        need(dense is None or "dense" in questions, "dense")
        need(answers == verdicts, "answers")
        self.verdict = Certificate.together(verdicts)
        need(verdict == self.verdict, "verdict")
        self.lines = [f"{v}: {q if q == 'dense' else 'the points asked for'}" for q, v in zip(questions, verdicts)]

    def questions(self, further):
        """Lists of places for each question, and all places, each once: parameters, or addresses where there are none."""
        model, start = self.model, self.case.start
        given = [model.normalise(a, start) for a in self.case.examine]
        frozen = lambda a: (tuple(a[0]), tuple(a[1]))
        if self.chart is None:
            given = [([], [k]) for k, p in enumerate(model.states[start][1]) if p[0] == start] + given
        asked = list(dict.fromkeys(frozen(a) for a in given))
        for item in further:
            addr = address(item)
            need(model.normalise(addr, start) == addr and frozen(addr) not in asked, "further")
            asked.append(frozen(addr))
        if self.chart is None:
            return [[a] for a in asked], asked
        vertices = self.chart.vertices()
        single = [self.chart.locate(model, start, (list(a), list(b))) for a, b in asked]
        return [vertices, "dense"] + [[x] for x in single], list(dict.fromkeys(vertices + single))

    def plane(self, root, view, place, value, rules=("plane", "line", "space", "product")):
        """The verdict on a point; `place` is its parameter, or its address where there are no parameters."""
        model = self.model
        items, rule, tangent, branches = fields(value, "addresses", "rule", "tangent", "branches")
        addresses = [address(a) for a in items]
        all_ = self.chart.addresses(model, root, place) if self.chart else [tuple(map(list, place))]
        need(addresses == all_ and addresses and rule in rules, "plane")
        images = [apply(view, model.point(root, a)) for a in addresses]
        need(all(x == images[0] for x in images), "plane")
        if rule == "product":
            need(self.product is not None and tangent is None and root == self.case.start, "product")
            on_v = mul(view, transpose(model.basis[root], model.case.dims[root]))
            need(len(echelon(on_v)[1]) == len(model.basis[root]), "product")
            return self.product.verdict(addresses[0], branches)
        need(self.contracts and len(branches) == len(addresses), "plane")
        parts = [b and Part(Germ(model, root, view, a), b) for a, b in zip(addresses, branches)]
        contained = [v for p in parts if p is not None for v in p.contained]
        if rule == "space":
            need(tangent is None and independent(contained, 3), "space")
            return "refuted"
        need(all(p is not None for p in parts), "plane")
        most = 2 if rule == "plane" else 1
        if tangent is None:
            need(len(parts) == 1 and parts[0].dimension <= most, "plane")
            need(rule == "line" or parts[0].dimension == 2, "plane")
        else:
            rows = [vector(v, len(view)) for v in tangent]
            need(len(rows) == 2 if rule == "plane" else len(rows) <= 1, "plane")
            need(echelon(rows)[0] == rows, "plane")
            need(all(len(echelon(rows + [v])[1]) == len(rows) for p in parts for v in p.rational), "plane")
        if rule == "line":
            return "refuted"
        need(independent(contained, 2), "plane")
        return "proved"

    def dense(self, planes):
        model = self.model
        need(self.chart is not None and len(planes) == len(model.reachable), "dense")
        for e, plane in zip(model.reachable, planes):
            need(isinstance(plane, dict) and plane.get("addresses"), "dense")
            at = self.chart.locate(model, e, address(plane["addresses"][0]))
            need(min(self.chart.margins(at)) > 0, "dense")
            need(self.plane(e, model.own_view(e), at, plane, ("plane", "product")) == "proved", "dense")
            for piece in model.states[e][1]:
                rows, width = model.on_visible(e, piece)
                need(len(echelon(rows)[1]) == width, "dense")

    def everywhere(self, value):
        if value is None:
            return None
        need(self.chart is not None, "every")
        by = value.get("by") if isinstance(value, dict) else None
        need(by in ("point", "product"), "every: by derivative and by cones are not covered here")
        if by == "point":
            _, verdict, k = fields(value, "by", "verdict", "point")
            need(verdict == "refuted" == self.found[index(k, len(self.found))], "every")
            return verdict
        _, verdict, curves = fields(value, "by", "verdict", "curves")
        need(self.product is not None and len(curves) == 2, "every")
        start = self.case.start
        on_v = mul(self.case.view, transpose(self.model.basis[start], self.case.dims[start]))
        need(len(echelon(on_v)[1]) == len(self.model.basis[start]), "every")
        found = [c and f.turns(c) for c, f in zip(curves, (self.product.first, self.product.second))]
        if verdict == "proved":
            need(found == ["proved", "proved"], "every")
        else:
            need(verdict == "refuted" and "refuted" in found, "every")
        return verdict


def check(case_text, certificate_text):
    return Planes(case_text, check_curves.read(certificate_text))


if __name__ == "__main__":
    sys.exit(check_curves.main(sys.argv[1:], check, __doc__))
