"""Words, addresses, end points, parameters, relevant spaces of a case (theory, sections 1 to 3)."""
from fractions import Fraction
from itertools import product

import numpy as np

from linear import apply, identity, kernel, matmul, rank, rref, solve, transpose


class NotUnique(Exception):
    """An operator with more than one fixed point: the system does not contract."""


def path(case, start, word):
    states = [start]
    for i in word:
        states.append(case.states[states[-1]].pieces[i].target)
    return states


def operator(case, start, word):
    m, s = identity(case.states[start].dim), start
    for i in word:
        p = case.states[s].pieces[i]
        m, s = matmul(m, p.op), p.target
    return m, s


def orientation(case, start, word):
    sign, s = 1, start
    for i in word:
        p = case.states[s].pieces[i]
        sign, s = (-sign if p.reversed else sign), p.target
    return sign


def fixed(m):
    n = len(m)
    k = kernel([[m[i][j] - (i == j) for j in range(n)] for i in range(n)], n)
    if len(k) != 1:
        raise NotUnique
    return [x / sum(k[0]) for x in k[0]]


def point(case, start, prefix, cycle):
    u, e = operator(case, start, prefix)
    m, f = operator(case, e, cycle)
    assert e == f
    return apply(u, fixed(m))


def normalise(case, start, prefix, cycle):
    """Shortest cycle that is a loop of the automaton, shortest prefix."""
    letters, s, seen = [], start, []
    while True:
        k = len(letters)
        if k >= len(prefix):
            key = (s, (k - len(prefix)) % len(cycle))
            if key in seen:
                at = len(prefix) + seen.index(key)
                break
            seen.append(key)
        i = prefix[k] if k < len(prefix) else cycle[(k - len(prefix)) % len(cycle)]
        letters.append(i)
        s = case.states[s].pieces[i].target
    states = path(case, start, letters)
    head, loop = letters[:at], letters[at:]
    pairs = list(zip(loop, states[at:]))
    period = next(p for p in range(1, len(loop) + 1)
                  if len(loop) % p == 0 and pairs == pairs[:p] * (len(loop) // p))
    pairs = pairs[:period]
    while head and (head[-1], states[len(head) - 1]) == pairs[-1]:
        head.pop()
        pairs = [pairs[-1]] + pairs[:-1]
    return head, [x for x, _ in pairs]


def relevant_spaces(case):
    """Bases (lists of vectors) of V_e = span(A_e - A_e), by closure."""
    anchors = {}
    for e in case.states:
        # the value of the address 0,0,0,...
        anchors[e] = point(case, e, *normalise(case, e, [], [0]))
    gens = {e: [] for e in case.states}

    def add(e, v):
        if any(v) and rank(gens[e] + [v]) > len(gens[e]):
            gens[e], _ = rref(gens[e] + [v])
            return True
        return False

    changed = True
    while changed:
        changed = False
        for e, st in case.states.items():
            for p in st.pieces:
                d = [x - y for x, y in zip(apply(p.op, anchors[p.target]), anchors[e])]
                changed |= add(e, d)
                for v in list(gens[p.target]):
                    changed |= add(e, apply(p.op, v))
    return gens


def moving(case, spaces, e):
    """Letters of e whose piece is more than a point."""
    return [i for i, p in enumerate(case.states[e].pieces) if any(any(apply(p.op, v)) for v in spaces[p.target])]


def end_address(case, spaces, e, side):
    """Normalised address of the start (side 0) or end (side 1) germ of the edge e; single points are skipped."""
    letters, seen, s = [], [], e
    while (s, side) not in seen:
        seen.append((s, side))
        idx = moving(case, spaces, s)
        i = (idx[0] if side == 0 else idx[-1]) if idx else (0 if side == 0 else len(case.states[s].pieces) - 1)
        letters.append(i)
        p = case.states[s].pieces[i]
        s, side = p.target, side ^ int(p.reversed)
    at = seen.index((s, side))
    return normalise(case, e, letters[:at], letters[at:])


def joint_branches(case, spaces, e):
    """For each first-level joint of e: (left branch, right branch), normalised addresses from e."""
    idx = moving(case, spaces, e)
    out = []
    for i, j in zip(idx, idx[1:]):
        pi, pj = case.states[e].pieces[i], case.states[e].pieces[j]
        u, w = end_address(case, spaces, pi.target, 0 if pi.reversed else 1)
        left = normalise(case, e, [i] + u, w)
        u, w = end_address(case, spaces, pj.target, 1 if pj.reversed else 0)
        right = normalise(case, e, [j] + u, w)
        out.append((left, right))
    return out


def edge_ends(case, e):
    """The end points of an edge state, by the plain end addresses."""
    none = {s: [] for s in case.states}
    return [point(case, e, *end_address(case, none, e, side)) for side in (0, 1)]


def adjacency_errors(case):
    bad = []
    for e in reachable(case):
        st = case.states[e]
        if st.kind != "edge":
            continue
        ends = []
        for p in st.pieces:
            a, b = edge_ends(case, p.target)
            a, b = apply(p.op, a), apply(p.op, b)
            ends.append((b, a) if p.reversed else (a, b))
        for i in range(len(ends) - 1):
            if ends[i][1] != ends[i + 1][0]:
                bad.append(f"state {e}: piece {i} ends elsewhere than piece {i + 1} begins")
        for side, name in ((0, "left"), (1, "right")):
            b = getattr(st, name)
            if b:
                v, m = b
                vp = fixed(case.states[v].pieces[0].op)
                if apply(m, vp) != edge_ends(case, e)[side]:
                    bad.append(f"state {e}: {name} boundary")
    return bad


def reachable(case):
    order = [case.start]
    for e in order:
        for p in case.states[e].pieces:
            if p.target not in order:
                order.append(p.target)
    return order


def parameter(case, e, prefix, cycle):
    """The parameter in [0,1] of an eventually periodic address (each piece has an equal share)."""
    def linear_part(s, word):
        a, b = Fraction(1), Fraction(0)  # t = a t' + b
        for i in word:
            p, n = case.states[s].pieces[i], len(case.states[s].pieces)
            if p.reversed:
                a, b = -a / n, b + a * Fraction(i + 1, n)
            else:
                a, b = a / n, b + a * Fraction(i, n)
            s = p.target
        return a, b, s
    a, b, s = linear_part(e, prefix)
    c, d, _ = linear_part(s, cycle)
    return a * d / (1 - c) + b


def words(case, e, length):
    out = [((), e)]
    for _ in range(length):
        out = [(w + (i,), p.target) for w, s in out for i, p in enumerate(case.states[s].pieces)]
    return out


def tau(m):
    cols = np.array(m).T
    return max(0.5 * np.abs(a - b).sum() for a in cols for b in cols)


class Balls:
    """1-norm balls B(c_e, r_e) that hold the attractors (floating point, for the oracle only)."""

    def __init__(self, case):
        self.case = case
        self.ops = {e: [(np.array([[float(x) for x in r] for r in p.op]), p.target) for p in st.pieces]
                    for e, st in case.states.items()}
        self.centre = {e: np.array([float(x) for x in point(case, e, *normalise(case, e, [], [0]))])
                       for e in case.states}
        self.length = self.tau = None
        for bound in (0.5, 0.8, 0.98):
            if self.cover(case, bound):
                break

    def cover(self, case, bound, deepest=160, most=4000):
        """A complete prefix code of words with tau < bound, and the radius that follows."""
        longest, worst, radius, code = 0, 0.0, 0.0, 0
        todo = [(np.eye(case.states[e].dim), e, e, 0) for e in case.states]
        while todo:
            m, s, e, k = todo.pop()
            if k and (t := tau(m)) < bound:
                code += 1
                longest, worst = max(longest, k), max(worst, t)
                radius = max(radius, np.abs(m @ self.centre[s] - self.centre[e]).sum() / (1 - t))
            elif k >= deepest or code > most:
                return False
            else:
                todo += [(m @ op, t, e, k + 1) for op, t in self.ops[s]]
        self.length, self.tau, self.words = longest, worst, code
        self.radius = radius * 1.000001 + 1e-12
        self.hull = {}
        for e in case.states:
            n, c = case.states[e].dim, self.centre[e]
            cols = [c + self.radius / 2 * (np.eye(n)[i] - np.eye(n)[j]) for i in range(n) for j in range(n) if i != j]
            self.hull[e] = np.array(cols or [c]).T
        return True

    def sharpen(self, e, basis, samples):
        """One state, plane V: a ball in the norm of the polygon of conv(A - A), taken from samples, in place of the
        1-norm. Any symmetric polygon gives a valid norm; this one makes the maps contract at once."""
        b = np.array([[float(x) for x in v] for v in basis]).T
        coords = np.linalg.pinv(b)
        pts = coords @ (samples - self.centre[e][:, None])
        ang = np.pi * np.arange(24) / 24
        normals = np.stack([np.cos(ang), np.sin(ang)])
        ext = normals.T @ pts
        width = ext.max(axis=1) - ext.min(axis=1)
        normals = np.hstack([normals, -normals]) / np.hstack([width, width])
        verts = np.array([np.linalg.solve(normals[:, [k, (k + 1) % 48]].T, [1, 1]) for k in range(48)]).T
        norm = lambda x: (normals.T @ x).max()
        radius, todo, code = 0.0, [(np.eye(len(samples)), 0)], 0
        while todo:
            m, k = todo.pop()
            t = norm(coords @ m @ b @ verts)
            if k and t < 0.7:
                code += 1
                radius = max(radius, norm(coords @ (m @ self.centre[e] - self.centre[e])) / (1 - t))
            elif k > 200 or code > 2000:
                radius = 1.1  # slow contraction: the sampled hull with a margin of a tenth (not rigorous)
                break
            else:
                todo += [(m @ op, k + 1) for op, _ in self.ops[e]]
        self.hull[e] = self.centre[e][:, None] + b @ verts * radius * 1.000001


def spectral_refutation(case, longest=8):
    """A cycle word whose linear part expands (spectral radius >= 1 on zero sums), if one is found."""
    for k in range(1, longest + 1):
        for e in case.states:
            for w in product(*[range(max(len(s.pieces) for s in case.states.values()))] * k):
                try:
                    states = path(case, e, w)
                except IndexError:
                    continue
                if states[-1] != e:
                    continue
                m = np.array([[float(x) for x in r] for r in operator(case, e, w)[0]])
                n = len(m)
                basis = np.vstack([np.eye(n - 1), -np.ones((1, n - 1))]) if n > 1 else np.zeros((1, 0))
                lin = np.linalg.lstsq(basis, m @ basis, rcond=None)[0] if n > 1 else np.zeros((0, 0))
                if lin.size and max(abs(np.linalg.eigvals(lin))) >= 1 - 1e-12:
                    return e, w, round(float(max(abs(np.linalg.eigvals(lin)))), 9)
    return None
