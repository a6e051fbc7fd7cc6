"""First derivation: exact eigen-analysis (SymPy) of every point of every case, sections 3 to 9 of the theory.

The ring condition alone uses floating enclosures (balls in the 1-norm). Usage: python3 exact.py [name ...] > exact.txt
"""
import sys
from dataclasses import dataclass, field
from fractions import Fraction

import mpmath
import numpy as np
import sympy as sp

import casefile
from linear import apply, kernel, matmul, rank, rref, solve, transpose
from model import (Balls, NotUnique, adjacency_errors, edge_ends, end_address, joint_branches, moving, normalise, operator,
                   orientation, path, point, reachable, relevant_spaces, spectral_refutation, words)

mpmath.mp.dps = 50
PRECISION = {'digits': 50}
X = sp.Symbol("x")


@dataclass
class Side:
    """What is known about one side of a point: a line (with rays), 'plane', 'unknown', or 'point' (no germ)."""
    status: str
    why: str = ""
    rays: list = field(default_factory=list)  # vectors, exact where rational
    direction: list = None
    poly: str = ""


def poly_text(f):
    out = ""
    for (k,), c in sp.Poly(f, X).monic().terms():
        power = {0: "", 1: "x"}.get(k, f"x^{k}")
        body = power if abs(c) == 1 and power else f"{abs(c)} {power}".strip()
        out += (" - " if c < 0 else " + ") * bool(out) + ("-" if c < 0 and not out else "") + body
    return out


def power(m, k):
    out = [[Fraction(int(i == j)) for j in range(len(m))] for i in range(len(m))]
    for _ in range(k):
        out = matmul(out, m)
    return out


def poly_at(f, m):
    n = len(m)
    out = [[Fraction(0)] * n for _ in range(n)]
    for c in sp.Poly(f, X).all_coeffs():
        out = matmul(out, m)
        c = Fraction(int(c.p), int(c.q))
        out = [[v + (c if i == j else 0) for j, v in enumerate(r)] for i, r in enumerate(out)]
    return out


def set_precision(case):
    """50 digits, or many more where the case itself has long numbers."""
    longest = max(len(str(x)) for st in case.states.values() for p in st.pieces for r in p.op for x in r)
    PRECISION["digits"] = 50 if longest < 20 else 200 if longest < 100 else 1200
    mpmath.mp.dps = PRECISION["digits"]


def tiny():
    return mpmath.mpf(10) ** -(PRECISION["digits"] * 6 // 10)


class Branch:
    """The germ at u w^omega seen through G = P T_u, in the quotient of section 9."""

    def __init__(self, case, spaces, balls, prefix, cycle, control=True):
        self.case, self.balls = case, balls
        u, e = operator(case, case.start, prefix)
        self.state = e
        g = matmul(case.control, u) if control and case.control else u
        self.cycle, self.prefix = cycle, prefix
        m, _ = operator(case, e, cycle)
        self.q = point(case, e, [], cycle)
        basis = spaces[e]
        self.r = r = len(basis)
        self.void = r == 0
        if self.void:
            return
        bt = transpose(basis)
        lin = solve(bt, matmul(m, bt))
        coords = solve(matmul(basis, bt), basis)  # (B^T B)^-1 B^T
        gb = matmul(g, bt)
        null = kernel(gb, r)
        while True:  # largest invariant subspace of the kernel
            if not null:
                break
            nt = transpose(null)
            img = [apply(lin, v) for v in null]
            ann = kernel(null, r)  # functionals vanishing on null
            keep = kernel([[sum(a * b for a, b in zip(f, v)) for v in img] for f in ann], len(null)) if ann else None
            if keep is None or len(keep) == len(null):
                break
            null = [apply(nt, k) for k in keep]
        self.killed = len(null)
        quo = kernel(null, r) if null else [[Fraction(int(i == j)) for j in range(r)] for i in range(r)]
        # quo: rows = coordinates of the quotient
        if not quo:
            self.void, self.dim = True, 0
            return
        self.f = matmul(quo, coords)
        sec = solve(quo, [[Fraction(int(i == j)) for j in range(len(quo))] for i in range(len(quo))])
        self.l = matmul(matmul(quo, lin), sec)
        self.g = matmul(gb, sec)
        self.dim = len(quo)

    def spectrum(self):
        m = sp.Matrix([[sp.Rational(v.numerator, v.denominator) for v in r] for r in self.l])
        chi = m.charpoly(X).as_expr()
        out = []
        for f, mult in sp.factor_list(chi, X)[1]:
            pf = sp.Poly(f, X)
            ker, prev, k = [], 0, 0
            while True:
                k += 1
                d = self.dim - rank(power(poly_at(f, self.l), k))
                if d == prev:
                    break
                ker.append(d)
                prev = d
            steps = [a - b for a, b in zip(ker, [0] + ker[:-1])]
            deg = pf.degree()
            steps = [s // deg for s in steps]
            longest, count = len(steps), steps[-1]
            roots = [mpmath.mpc(*[mpmath.mpf(str(t)) for t in sp.N(z, PRECISION['digits']).as_real_imag()]) for z in pf.nroots(n=PRECISION['digits'], maxsteps=500)]
            for z in roots:
                if abs(z.imag) < tiny():
                    z = mpmath.mpc(z.real, 0)
                out.append((abs(z), z, f, mult, longest, count))
        out.sort(key=lambda t: -t[0])
        return out, chi

    def enclose(self, rows, prefix_states, depth=400, most=40000):
        """Branch and bound: signs of the single functional, or 'no zero' for several rows, on a ring part."""
        hull, ops = self.balls.hull, self.balls.ops
        q = np.array([float(x) for x in self.q])
        signs, todo, steps = set(), [(m, s, 0) for m, s in prefix_states], 0
        if len(rows) == 1 and self.case.edge:  # both signs at points far from zero settle it
            for m, s in prefix_states:
                values = (rows @ m @ self.samples(s)).ravel() - (rows @ q)[0]
                signs |= {int(np.sign(v)) for v in values if abs(v) > 1e-6 * np.abs(values).max()}
            if {1, -1} <= signs:
                return signs
        scale = np.abs(rows).sum(axis=1) + 1e-300
        while todo:
            m, s, d = todo.pop()
            steps += 1
            t = rows @ m
            ext = t @ hull[s] - (rows @ q)[:, None]
            lo, hi = ext.min(axis=1), ext.max(axis=1)
            ok = (lo > 1e-13 * scale) | (hi < -1e-13 * scale)
            if ok.any():
                signs.add((1 if lo[0] > 0 else -1) if len(rows) == 1 else 1)
            elif d >= depth or steps > most:
                signs.add(None)
                if steps > most:
                    break
            else:
                todo += [(m @ op, t2, d + 1) for op, t2 in ops[s]]
            if len(rows) == 1 and {1, -1} <= signs:
                break
        return signs

    def samples(self, s):
        """Points of A_s at random words, as columns."""
        rng = np.random.default_rng(1)
        pts = {e: self.balls.centre[e].reshape(-1, 1) for e in self.case.states}
        for _ in range(9):
            new = {}
            for e in pts:
                all_ = np.hstack([op @ pts[t] for op, t in self.balls.ops[e]])
                new[e] = all_[:, rng.permutation(all_.shape[1])[:600]]
            pts = new
        return pts[s]

    def ring(self):
        """The parts before and after, as (matrix, state) lists."""
        parts = {-1: [], 1: []}
        s, sign = self.state, 1
        m = np.eye(self.case.states[s].dim)
        for w in self.cycle:
            st = self.case.states[s]
            for j, p in enumerate(st.pieces):
                if j == w:
                    continue
                if st.kind != "edge" and p.target == st.pieces[w].target and p.op == st.pieces[w].op:
                    continue
                side = sign * (1 if j > w else -1) if st.kind == "edge" else 1
                op = self.balls.ops[s][j][0]
                parts[side].append((m @ op, p.target))
            m = m @ self.balls.ops[s][w][0]
            sign = -sign if st.pieces[w].reversed else sign
            s = st.pieces[w].target
        return parts

    def analyse(self):
        """{side: Side} in the order of the start state."""
        eps_u = orientation(self.case, self.case.start, self.prefix)
        eps = orientation(self.case, self.state, self.cycle)
        curve = self.case.states[self.state].kind == "edge"
        if self.void:
            return {s: Side("point", "no germ: constant") for s in (-1, 1)}
        parts = self.ring()
        present = [s for s in (-1, 1) if parts[s]]
        flip = lambda s: s * eps_u
        spec, chi = self.spectrum()
        rho = spec[0][0]
        eig = " ".join(mpmath.nstr(z, 6) + (f"[{b}]" if b > 1 else "") for _, z, _, _, b, _ in spec)
        shown = str(sp.factor(chi))
        text = f"chi = {shown if len(shown) < 400 else '(long)'}; eigenvalues {eig}" + (f"; killed {self.killed}" if self.killed else "")

        def same(kind, why, **kw):
            return {flip(s): Side(kind, f"{text}; {why}", **kw) for s in present}

        if rho < tiny():
            return same("unknown", "nilpotent")
        top = [t for t in spec if abs(t[0] - rho) < tiny()]
        ell = max(t[4] for t in top)
        longest = [t for t in top if t[4] == ell]
        dim_u = sum(t[5] for t in longest)
        full = rank(self.g) == self.dim
        if dim_u >= 2:
            if full or len(longest) == sum(1 for t in longest if t[1].imag == 0 and t[2] == longest[0][2]) \
                    and sp.Poly(longest[0][2], X).degree() == 1:
                return same("plane", f"corollary: dim U = {dim_u}")
            if rank(self.g) < 2:
                return same("unknown", f"dim U = {dim_u}, G of rank 1")
            # numeric rank of G U
            u = self.leading_span(longest, ell)
            gu = np.array([[float(x) for x in r] for r in self.g]) @ u
            sv = np.linalg.svd(gu)[1]
            if (sv > 1e-9 * sv[0]).sum() >= 2:
                return same("plane", f"corollary: dim GU >= 2")
            return same("unknown", f"dim U = {dim_u} but dim GU = 1")
        _, lam, f, mult, _, _ = longest[0]
        lam = lam.real
        v, row = self.leading(f, mult, lam, ell, chi)
        info = dict(direction=self.image(v, lam), poly=poly_text(f))
        self.row = row
        if info["direction"] is None:
            return same("unknown", "G kills the dominant direction", poly=poly_text(f))
        g = self.covector(row)
        big = max(abs(x) for x in g)
        rows = np.array([[float(x / big) for x in g]])
        sg = {s: self.enclose(rows, parts[s]) for s in present}
        isolated = self.isolated([x for s in present for x in parts[s]])
        allsigns = set().union(*sg.values())
        clean = None not in allsigns and (not curve or all(len(x) == 1 for x in sg.values()))
        mixed = curve and any({1, -1} <= x for x in sg.values())
        what = f"lambda = {mpmath.nstr(lam, 8)}, block {ell}; signs " + str(
            {("left", "right")[flip(s) > 0] if curve else "all": sorted(map(str, sg[s])) for s in present})
        if not clean:
            if not mixed and self.dim > 1 and isolated and full and ell == 1 and (wit := self.witness()):
                return same("plane", what + f"; null component at the ring point {wit} (Theorem 4)", poly=poly_text(f))
            if self.dim == 1:
                return same("line", what + "; dimension 1 trivially, rays not decided", **info)
            if mixed and isolated and full and (ell == 1 or (ell == 2 and len(top) == 1 and top[0][3] == 2)):
                return same("plane", what + "; null component in the ring (sign change), isolated", poly=poly_text(f))
            return same("unknown", what + f"; ring condition fails or is open, isolated: {isolated}; D* contains the line",
                        direction=info["direction"])
        d = info["direction"]
        neg = [-x for x in d]
        out = {}
        if not curve:
            signs = {a for x in sg.values() for a in x}
            if lam < 0 or len(signs) == 2:
                rays = [d, neg]
            else:
                rays = [d] if 1 in signs else [neg]
            return {1: Side("line", f"{text}; {what}", rays, **info)}
        pick = lambda s: d if s > 0 else neg
        sig = {s: next(iter(sg[s])) for s in present}
        if len(present) == 1:
            s = present[0]
            out[s] = [pick(sig[s])] if lam > 0 else [d, neg]
        elif eps > 0:
            for s in (-1, 1):
                out[s] = [pick(sig[s])] if lam > 0 else [d, neg]
        else:
            eq = sig[1] == sig[-1]
            one = eq if lam > 0 else not eq
            for s in (-1, 1):
                out[s] = [pick(sig[s])] if one else [d, neg]
        return {flip(s): Side("line", f"{text}; {what}", out[s], **info) for s in present}

    def witness(self):
        """A ring point, given by a short address, where the dominant functional vanishes exactly."""
        g = self.covector(self.row)
        if not isinstance(g[0], Fraction) or len(self.cycle) > 1:
            return None
        n = len(self.case.states[self.state].pieces)
        for w in words(self.case, self.state, 3):
            if w[0][0] == self.cycle[0]:
                continue
            for tail in (0, n - 1):
                a = normalise(self.case, self.state, list(w[0]), [tail])
                x = point(self.case, self.state, *a)
                if sum(c * (u - v) for c, u, v in zip(g, x, self.q)) == 0:
                    return casefile.show_address(*a)
        return None

    def isolated(self, parts):
        """0 is not in the image of the ring under the functionals of the nonzero eigenvalues (floating enclosures)."""
        red, _ = rref(power(self.l, self.dim))
        rows = np.array([[float(x) for x in r] for r in matmul(red, self.f)])
        return None not in self.enclose_any(rows, parts)

    def enclose_any(self, rows, parts):
        if len(rows) == 1:
            rows = np.vstack([rows, rows])
        return self.enclose(rows, parts)

    def leading_span(self, longest, ell):
        n, cols = self.dim, []
        for _, z, f, mult, _, _ in longest:
            lm = np.array([[complex(float(x)) for x in r] for r in self.l]) - complex(z) * np.eye(n)
            p = np.linalg.matrix_power(lm, ell - 1)
            ns = np.linalg.svd(np.linalg.matrix_power(lm, ell))
            null = ns[2].conj().T[:, ns[1] < 1e-9 * max(ns[1][0], 1)]
            im = p @ null
            cols += [im.real, im.imag]
        return np.hstack(cols)

    def leading(self, f, mult, lam, ell, chi):
        """(v, row): u(x) = v row(x), exact when lambda is rational."""
        if sp.Poly(f, X).degree() == 1:
            r = sp.solve(f, X)[0]
            fr = Fraction(int(r.p), int(r.q))
            h = sp.quo(sp.Poly(chi, X), sp.Poly((X - r) ** mult, X)).as_expr()
            m = matmul(power(poly_at(X - r, self.l), ell - 1), poly_at(h, self.l))
            h0 = sp.sympify(h).subs(X, r)
            c = Fraction(int(h0.p), int(h0.q)) * fr ** (ell - 1)
            m = [[x / c for x in row] for row in m]
        else:
            n = self.dim
            a = mpmath.matrix([[mpmath.mpf(x.numerator) / x.denominator for x in r] for r in self.l])
            m = mpmath.eye(n)
            c = lam ** (ell - 1)
            for _ in range(ell - 1):
                m = m * (a - lam * mpmath.eye(n))
            for _, z, _, _, _, _ in self.full_spectrum(chi):
                if abs(z - lam) < tiny():
                    continue
                m = m * (a - z * mpmath.eye(n))
                c = c * (lam - z)
            m = [[(m[i, j] / c).real for j in range(n)] for i in range(n)]
        big = max(range(len(m)), key=lambda i: max(abs(x) for x in m[i]))
        row = m[big]
        j = max(range(len(row)), key=lambda j: abs(row[j]))
        v = [m[i][j] / row[j] for i in range(len(m))]
        return v, row

    def full_spectrum(self, chi):
        out = []
        for f, mult in sp.factor_list(chi, X)[1]:
            for z in sp.Poly(f, X).nroots(n=PRECISION['digits'], maxsteps=500):
                re, im = sp.N(z, PRECISION['digits']).as_real_imag()
                out += [(0, mpmath.mpc(mpmath.mpf(str(re)), mpmath.mpf(str(im))), f, mult, 0, 0)] * mult
        return out

    def image(self, v, lam):
        if isinstance(v[0], Fraction):
            d = apply(self.g, v)
            return d if any(d) else None
        d = [sum(mpmath.mpf(a.numerator) / a.denominator * b for a, b in zip(r, v)) for r in self.g]
        return d if max(abs(x) for x in d) > tiny() else None

    def covector(self, row):
        if isinstance(row[0], Fraction):
            return matmul([row], self.f)[0]
        cols = list(zip(*self.f))
        return [sum(r * (mpmath.mpf(x.numerator) / x.denominator) for r, x in zip(row, c)) for c in cols]


def parallel(a, b):
    """+1 same ray, -1 opposite, 0 different lines."""
    if isinstance(a[0], Fraction) and isinstance(b[0], Fraction):
        if rank([list(a), list(b)]) > 1:
            return 0
        return 1 if sum(x * y for x, y in zip(a, b)) > 0 else -1
    af = [mpmath.mpf(x.numerator) / x.denominator if isinstance(x, Fraction) else x for x in a]
    bf = [mpmath.mpf(x.numerator) / x.denominator if isinstance(x, Fraction) else x for x in b]
    na, nb = mpmath.sqrt(sum(x * x for x in af)), mpmath.sqrt(sum(x * x for x in bf))
    for s in (1, -1):
        if max(abs(x / na - s * y / nb) for x, y in zip(af, bf)) < tiny() * 1000:
            return s
    return 0


def judge(left, right):
    """(verdict, kind) of a point from its sides; an absent side is None."""
    sides = [s for s in (left, right) if s is not None]
    if any(s.status == "plane" for s in sides):
        return "refuted", "none"
    if len(sides) == 2 and any(s.status == "unknown" for s in sides) and all(s.direction for s in sides) \
            and parallel(left.direction, right.direction) == 0:
        return "refuted", "none"  # the lower bounds of the two sides already span a plane
    if any(s.status == "point" for s in sides) or any(s.status == "unknown" for s in sides):
        return "undetermined", None
    if len(sides) == 2 and parallel(left.direction, right.direction) == 0:
        if len(left.rays) == len(right.rays) == 1:
            return "refuted", "corner"
        return "refuted", "none" if left.rays and right.rays else None
    if any(not s.rays for s in sides):
        return "proved", None
    if any(len(s.rays) == 2 for s in sides):
        return "proved", "oscillating"
    if len(sides) == 1:
        return "proved", "half-tangent"
    return "proved", "cusp" if parallel(left.rays[0], right.rays[0]) > 0 else "regular"


def other_branch(case, spaces, prefix, cycle):
    """The second branch of the parameter of an address that ends in an end address, else None."""
    for k in range(len(prefix) + len(cycle), 0, -1):
        letters = (prefix + cycle * 4)[: k - 1]
        e = path(case, case.start, letters)[-1]
        for left, right in joint_branches(case, spaces, e):
            for me, it in ((left, right), (right, left)):
                if normalise(case, case.start, letters + me[0], me[1]) == (prefix, cycle):
                    return normalise(case, case.start, letters + it[0], it[1])
    return None


def points(case, spaces):
    """(label, [branches]) of every examined point."""
    if not case.edge:
        out = [(f"fixed point of map {i}", [normalise(case, case.start, [], [i])])
               for i, p in enumerate(case.states[case.start].pieces)]
    else:
        out = [("left end", [end_address(case, spaces, case.start, 0)]),
               ("right end", [end_address(case, spaces, case.start, 1)])]
        for e in reachable(case):
            if case.states[e].kind != "edge":
                continue
            word = word_to(case, e)
            for k, (a, b) in enumerate(joint_branches(case, spaces, e)):
                out.append((f"joint {k + 1} of {e}", [normalise(case, case.start, word + a[0], a[1]),
                                                      normalise(case, case.start, word + b[0], b[1])]))
    for text in case.examine:
        me = normalise(case, case.start, *casefile.parse_address(text))
        it = other_branch(case, spaces, *me) if case.edge else None
        out.append((f"examined {text}", [me] + ([it] if it else [])))
    return out


def word_to(case, e):
    seen, order = {case.start: []}, [case.start]
    for s in order:
        for i, p in enumerate(case.states[s].pieces):
            if p.target not in seen:
                seen[p.target] = seen[s] + [i]
                order.append(p.target)
    return seen[e]


def certify(case):
    try:
        return derive(case)
    except NotUnique:
        return None, ("error", "secant::shape::contraction", "an operator has several fixed points"), None


def derive(case):
    """Everything: list of (label, branches, left, right, verdict, kind) and the top verdict with its reason."""
    if case.edge and (bad := adjacency_errors(case)):
        return None, ("error", "secant::shape::adjacency", "; ".join(bad)), None
    set_precision(case)
    balls = Balls(case)
    if balls.length is None:
        bad = spectral_refutation(case)
        return None, ("error", "secant::shape::contraction", str(bad)), balls
    spaces = relevant_spaces(case)
    if len(case.states) == 1 and len(spaces[case.start]) == 2 and balls.tau > 0.6:
        balls.sharpen(case.start, spaces[case.start], Branch(case, spaces, balls, *normalise(case, case.start, [], [0])).samples(case.start))
    rows = []
    for label, branches in points(case, spaces):
        sides = {}
        for b in branches:
            for s, side in Branch(case, spaces, balls, *b).analyse().items():
                sides[s] = side
        left, right = sides.get(-1), sides.get(1)
        if not case.edge:
            left, right = None, sides.get(1)
            if right and right.status == "point" or right is None:
                rows.append((label, branches, left, right, "undetermined", None))
                continue
            verdict, kind = judge(None, right)
            if kind == "oscillating" or kind == "half-tangent":
                kind = kind if len(right.rays) == 1 else "oscillating"
            rows.append((label, branches, left, right, verdict, kind))
            continue
        rows.append((label, branches, left, right, *judge(left, right)))
    injective, why = True, []
    for e in reachable(case):
        for i, p in enumerate(case.states[e].pieces):
            v = spaces[p.target]
            if v and rank([apply(p.op, x) for x in v]) < len(v):
                injective = False
                why.append(f"piece {i} of {e} is not injective on V")
    if case.control and case.edge:
        v = spaces[case.start]
        img = [apply(case.control, x) for x in v]
        if v and rank(img) < len(v):
            injective = False
            why.append("the control points are not injective on V")
    if any(r[4] == "refuted" for r in rows):
        top = ("refuted", "")
    elif all(r[4] == "proved" for r in rows) and (injective or not case.edge):
        top = ("proved", "")
    else:
        top = ("undetermined", "; ".join(why) or "some point is undetermined")
    return rows, top + (f"dim V = {len(spaces[case.start])}",), balls


def show(d):
    if d is None:
        return "-"
    if isinstance(d[0], Fraction):
        parts = [str(x) for x in primitive(d)]
        return "(" + ", ".join(x if len(x) < 60 else x[:8] + f"... {len(x)} digits" for x in parts) + ")"
    big = max(abs(x) for x in d)
    return "~(" + ", ".join(mpmath.nstr(x / big, 12) for x in d) + ")"


def primitive(d):
    """The same ray with coprime integers."""
    from math import gcd, lcm
    k = lcm(*[x.denominator for x in d])
    v = [int(x * k) for x in d]
    g = gcd(*v)
    return [Fraction(x // g) for x in v]


def compare(case, rows, top):
    """Differences between [expect] and this derivation."""
    diff = []
    exp = case.expect
    if "error" in exp:
        return [] if top[0] == "error" and top[1] == exp["error"] else [f"expected error {exp['error']}, found {top[:2]}"]
    if top[0] == "error":
        return [f"unexpected {top}"]
    if "verdict" in exp and exp["verdict"] != top[0]:
        diff.append(f"verdict: file {exp['verdict']}, derived {top[0]} ({top[1]})")
    for p in exp.get("point", []):
        a = casefile.parse_address(p["address"])
        row = next((r for r in rows if a in [tuple(map(list, b)) for b in r[1]]), None)
        if row is None:
            diff.append(f"{p['address']}: not an examined point")
            continue
        _, _, left, right, verdict, kind = row
        if p.get("verdict", verdict) != verdict or p.get("kind", kind) != kind:
            diff.append(f"{p['address']}: file {p.get('verdict')} {p.get('kind')}, derived {verdict} {kind}")
        sides = [s for s in (left, right) if s]
        for key, side in (("left", left), ("right", right)):
            if key in p:
                want = [[casefile.number(x) for x in r] for r in p[key]]
                have = side.rays if side else []
                if len(want) != len(have) or not all(any(parallel(w, h) > 0 for h in have) for w in want):
                    diff.append(f"{p['address']}: {key} rays differ")
        if "tangent" in p:
            t = [casefile.number(x) for x in p["tangent"]]
            if not all(s.direction and parallel(t, s.direction) for s in sides):
                diff.append(f"{p['address']}: tangent differs")
        if "eigenvalue" in p and p["eigenvalue"] not in [s.poly for s in sides]:
            diff.append(f"{p['address']}: eigenvalue {p['eigenvalue']} not in {[s.poly for s in sides]}")
    return diff


def report(case, out=sys.stdout):
    rows, top, balls = certify(case)
    print(f"== {case.path.parent.name}/{case.name}: {top[0]}" + (f" ({top[1]})" if top[1] else ""), file=out)
    if rows is None:
        print(f"   {top[2]}", file=out)
    else:
        print(f"   {top[2]}; contraction: {balls.words} words of length up to {balls.length}, tau <= {balls.tau:.4f}", file=out)
        for label, branches, left, right, verdict, kind in rows:
            names = " | ".join(casefile.show_address(*b) for b in branches)
            print(f"   {label} {names}: {verdict} {kind or ''}", file=out)
            for name, s in (("left", left), ("right", right)):
                if s:
                    rays = " ".join(show(r) for r in s.rays)
                    print(f"      {name}: {s.status} {rays or show(s.direction)} [{s.why}]", file=out)
    return rows, top


def main():
    wanted, bad = set(sys.argv[1:]), 0
    for f in casefile.all_cases():
        if wanted and f.stem not in wanted:
            continue
        try:
            case = casefile.load(f)
        except (casefile.Bad, ValueError) as err:
            code = getattr(err, "code", "unreadable")
            print(f"== {f.parent.name}/{f.stem}: refused, {code} ({str(err)[:80]})")
            if code != "secant::case::empty" and f'error = "{code}"' not in f.read_text():
                bad += 1
                print("   DIFFERS")
            continue
        rows, top = report(case)
        for d in compare(case, rows, top):
            bad += 1
            print(f"   DIFFERS {d}")
    print(f"{bad} differences")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
