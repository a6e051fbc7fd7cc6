"""Every point of a curve by polynomial arcs (Theorem 6″) and by components (Theorem 13): what check_curves.py does not need
otherwise, by section 8 of docs/certificate.md."""
from collections import namedtuple
from fractions import Fraction as Q

from check_curves import (
    Branch, Cones, Frames, Top, apply, check_point, echelon, fields, i_sign, index, mul, need, place_of, power, transpose, trim,
    vector, weighted, word,
)

# ---- polynomials -----------------------------------------------------------------------------------------------------


def at(p, x):
    value = Q(0)
    for c in reversed(p):
        value = value * x + c
    return value


def along(p, a, b):
    """p(a + b t)"""
    out = []
    for c in reversed(p):
        out = trim([x * a + y * b for x, y in zip(out + [Q(0)], [Q(0)] + out)] or [Q(0)])
        out = trim([c + (out[0] if out else 0)] + out[1:])
    return out


def slope(p):
    return [k * c for k, c in enumerate(p)][1:]


def divided(a, b):
    """Quotient and remainder."""
    a, q = list(a), [Q(0)] * max(len(a) - len(b) + 1, 0)
    while len(a) >= len(b):
        k = len(a) - len(b)
        q[k] = a[-1] / b[-1]
        a = trim([x - q[k] * b[j - k] if j >= k else x for j, x in enumerate(a)][:-1])
    return q, a


def common(a, b):
    while b:
        a, b = b, divided(a, b)[1]
    return [x / a[-1] for x in a]


def roots_between(f, lo, hi):
    """The number of roots of a square-free polynomial strictly between two numbers (Sturm)."""
    chain = [f, slope(f)]
    while len(chain[-1]) > 1:
        chain.append([-x for x in divided(chain[-2], chain[-1])[1]])

    def changes(x):
        values = [v for v in (at(g, x) for g in chain if g) if v]
        return sum(u * v < 0 for u, v in zip(values, values[1:]))

    return changes(lo) - changes(hi) - (1 if at(f, hi) == 0 else 0)


def square_free(g):
    """Square-free polynomials whose k-th power is the part of multiplicity k (Yun)."""
    parts, c = [], common(g, slope(g))
    w, y = divided(g, c)[0], divided(slope(g), c)[0]
    while len(w) > 1:
        z = trim([a - b for a, b in zip(y + [Q(0)] * len(w), slope(w) + [Q(0)] * (len(y) + 1))])
        part = common(w, z) if z else [x / w[-1] for x in w]
        parts.append(part)
        w, y = divided(w, part)[0], divided(z, part)[0]
    return parts


# ---- arcs ------------------------------------------------------------------------------------------------------------

def arcs(model, degree, items):
    """Whether the curve is G1."""
    need(all(model.states[e][0] == "edge" for e in model.reachable), "arc")
    width = index(degree, 33) + 1
    need(len(items) == len(model.reachable), "arc")
    found = {}
    for e, item in zip(model.reachable, items):
        if item is not None:
            found[e] = [trim(vector(row, width)) for row in item]
            total = weighted([Q(1)] * len(item), found[e])
            need(len(item) == model.case.dims[e] and total == [Q(1)], "arc")
    for e, own in found.items():
        pieces = model.states[e][1]
        for i, (target, op, backwards) in enumerate(pieces):
            need(target in found, "arc")
            a, b = (Q(i + 1, len(pieces)), Q(-1, len(pieces))) if backwards else (Q(i, len(pieces)), Q(1, len(pieces)))
            need([along(p, a, b) for p in own] == [weighted(row, found[target]) for row in op], "arc")
    chain = []

    def collect(view, e, backwards, path):
        if e in found:
            seen = [weighted(row, found[e]) for row in view]
            seen = [along(p, Q(1), Q(-1)) for p in seen] if backwards else seen
            need(any(any(slope(p)) for p in seen) and len(chain) < 256, "arc")
            chain.append(seen)
            return
        need(e not in path, "arc")
        for target, op, turned in reversed(model.states[e][1]) if backwards else model.states[e][1]:
            collect(mul(view, op), target, backwards != turned, path + [e])

    collect(model.case.view, model.case.start, False, [])
    smooth, ends = True, []
    for arc in chain:
        g = []
        for p in arc:
            g = common(g, trim(slope(p))) if g or trim(slope(p)) else []
        smooth &= all(roots_between(f, Q(0), Q(1)) == 0 for f in square_free(g)[::2] if len(f) > 1)
        # The direction h of p' = g h, with the sign of g just inside.
        h = [divided(trim(slope(p)), g)[0] for p in arc]
        side = []
        for t, inward in ((Q(0), 1), (Q(1), -1)):
            sign = next(1 if c > 0 else -1 for c in along(g, t, Q(inward)) if c)
            side.append([sign * at(p, t) for p in h])
        ends.append(side)
    for (_, a), (b, _) in zip(ends, ends[1:]):
        parallel = len(echelon([a, b])[1]) == 1
        smooth &= parallel and sum(x * y for x, y in zip(a, b)) > 0
    return "proved" if smooth else "refuted"


# ---- components ------------------------------------------------------------------------------------------------------

class Parts:
    def __init__(self, model):
        need(all(model.states[e][0] == "edge" for e in model.reachable), "components")
        self.model, self.done, self.rays, self.frames = model, set(), {}, Frames(model, False)

    def check(self, parts, seen):
        model, start = self.model, self.model.case.start
        for part in parts:
            kind = part.get("part") if isinstance(part, dict) else None
            need(kind in ("cones", "loop", "transient"), "format")
            getattr(self, kind)(part)
        need(start in self.done, "components")
        if seen is None:
            on_v = mul(model.case.view, transpose(model.basis[start], model.case.dims[start]))
            need(len(echelon(on_v)[1]) == len(model.basis[start]), "components")
            return
        cones, maps, code = fields(seen, "cones", "maps", "code")
        found = self.cones_of(model.reachable, cones, maps)
        words, open_, leaves = [fields(item, "word", "functional") for item in code], [[]], 0
        while open_:
            letters = open_.pop()
            op, end = model.product(start, letters)
            own = [h for w, h in words if word(w) == letters]
            if own:
                leaves += 1
                images = [apply(mul(model.case.view, op), ray) for ray in found.rays[end]]
                h = vector(own[0], len(model.case.view))
                need(images and all(sum(x * y for x, y in zip(h, image)) > 0 for image in images), "frames")
            else:
                need(any(len(w) > len(letters) and w[:len(letters)] == letters for w, _ in words), "frames")
                open_ += [letters + [k] for k in range(len(model.states[end][1]))]
        need(leaves == len(words), "frames")

    def cones_of(self, states, cones, maps):
        need(len(cones) == len(maps) == len(states), "cone")
        found = Cones(self.model, [], set())
        found.states = list(states)
        found.rays = {e: found.cone(e, c) for e, c in zip(states, cones)}
        found.maps = {e: found.images(e, m) for e, m in zip(states, maps)}
        return found

    def new(self, e):
        e = index(e, len(self.model.states))
        need(e in self.model.reachable and e not in self.done, "components")
        return e

    def point(self, e, value):
        return check_point(self.model, e, self.model.reading(e), value)

    def joints(self, states, items):
        wanted = [(e, pair) for e in self.model.reachable if e in states for pair in self.model.joints(e)]
        need(len(items) == len(wanted) > 0, "components")
        for item, (e, (left, right)) in zip(items, wanted):
            point = self.point(e, item)
            need(point.place == {"at": "joint", "path": [], "left": left, "right": right}, "components")
            need((point.verdict, point.kind) == ("proved", "regular"), "components")

    def cones(self, part):
        _, e, cones, maps, window, slow, joints = fields(part, "part", "state", "cones", "maps", "window", "slow", "joints")
        e = self.new(e)
        ahead = self.frames.below(e)
        need(e in ahead, "components")
        states = [f for f in self.model.reachable if f in ahead]
        found = self.cones_of(states, cones, maps)
        need(0 < index(window, 9), "slow")
        cycles = found.idle_cycles(window)
        need(len(slow) == len(cycles), "slow")
        for item, (f, letters) in zip(slow, cycles):
            found.pulls(item, f, letters)
        self.joints(states, joints)
        self.done |= set(states)
        self.rays.update(found.rays)

    def loop(self, part):
        _, e, k, top, functional, joints, fixed = fields(part, "part", "state", "letter", "top", "functional", "joints", "fixed")
        model, e = self.model, self.new(e)
        pieces = model.states[e][1]
        k = index(k, len(pieces))
        need(pieces[k][0] == e and not pieces[k][2] and len(pieces) > 1, "components")
        linear = model.linear(pieces[k][1], e, e)
        need(isinstance(top, dict) and top.get("top") == "real", "leading")
        branch = Branch(namedtuple("Germ", "linear n")(linear, len(linear)))
        row = branch.leading_row(Top(top, linear), functional)
        need(branch.eigenvalue_sign > 0, "components")
        falls, signs = power(linear, len(linear)), set()
        for target, op, backwards in pieces[:k] + pieces[k + 1:]:
            need(target in self.rays and target != e and e not in self.frames.below(target), "components")
            inner = model.linear(op, e, target)
            need(len(echelon(mul(falls, inner))[1]) == len(model.basis[target]), "components")
            for ray in self.rays[target]:
                image = [(-x if backwards else x) for x in apply(op, ray)]
                signs.add(i_sign(branch.field.value(weighted([image[p] for p in model.pivots[e]], row))))
        need(signs in ({1}, {-1}), "components")
        self.joints([e], joints)
        point = self.point(e, fixed)
        need(point.place == place_of(model, ([], [k]), e) and point.verdict == "proved", "components")
        need(point.kind in ("regular", "half-tangent"), "components")
        self.done.add(e)

    def transient(self, part):
        _, e, joints = fields(part, "part", "state", "joints")
        model, e = self.model, self.new(e)
        need(e not in self.frames.below(e), "components")
        for target, op, _ in model.states[e][1]:
            basis = model.basis[target]
            need(target in self.done and basis, "components")
            need(len(echelon([apply(op, v) for v in basis])[1]) == len(basis), "components")
        self.joints([e], joints)
        self.done.add(e)
