"""Second derivation: dense sampling of secants in exact rationals, without any eigenvalue.

At a point with address u w^omega the attractor of the last state is sampled at all short words (values of eventually
periodic addresses, exact). The samples are carried into the cell u w^m, and the secants to the point are taken there,
also exactly; only the final direction is rounded. The side of a sample is that of its exact parameter. The output is, per
side and m, the spread of the secants (half the opening of the narrowest double cone found that holds them) and the
largest angle to the rays that the file claims. Usage: python3 sampled.py [name ...] > sampled.txt
"""
import sys
from fractions import Fraction
from math import lcm

import mpmath
import numpy as np

import casefile
from exact import points
from linear import apply, matmul, solve, transpose
from model import adjacency_errors, end_address, normalise, operator, parameter, path, point, relevant_spaces, words


# Cases whose secants turn only after astronomically many turns: the exponents m = 2^k at which they are looked at,
# by repeated squaring in floating point with 2000 digits.
FAR = {"digits-400-smooth": 1345, "digits-400-corner": 1345, "near-tie-above": 110, "near-tie-below": 110}


def integers(vectors):
    """Integer multiples (one common factor) of rational vectors."""
    k = lcm(*[x.denominator for v in vectors for x in v])
    return [[int(x * k) for x in v] for v in vectors]


def unit(v):
    """The direction of an integer vector, rounded only at the end."""
    shift = max(abs(x).bit_length() for x in v) - 900
    f = np.array([float(x >> shift if shift > 0 else x) for x in v])
    f = f / np.abs(f).max()
    return f / np.linalg.norm(f)


def degrees(dirs, ray):
    """Angles between unit vectors, accurate also where small."""
    minus, plus = np.linalg.norm(dirs - ray, axis=1), np.linalg.norm(dirs + ray, axis=1)
    return np.degrees(2 * np.arctan2(minus, plus))


def short(x):
    return "0" if x < 1e-9 else f"{x:.3g}"


def power(m, k):
    out = None
    while k:
        if k & 1:
            out = m if out is None else imul(out, m)
        m = imul(m, m) if k > 1 else m
        k >>= 1
    return out


def imul(a, b):
    cols = list(zip(*b))
    return [[sum(x * y for x, y in zip(r, c)) for c in cols] for r in a]


def samples(case, e, most=260):
    """Sorted (parameter, point): the seeds of every state carried by all words of two lengths."""
    level = {}
    for s, st in case.states.items():
        level[s] = {}
        if st.kind == "vertex":
            continue
        for tail in ([0], [len(st.pieces) - 1], [0, 1], [0, 0, 1], [1, 0]):
            try:
                head, cyc = normalise(case, s, [], tail)
            except IndexError:
                continue
            level[s][parameter(case, s, head, cyc)] = point(case, s, head, cyc)
    length = 1
    while len(words(case, e, length + 1)) <= most:
        length += 1
    out = {}
    for n in range(1, length + 1):
        step = {}
        for s, st in case.states.items():
            step[s] = {}
            for i, p in enumerate(st.pieces):
                for t, x in level[p.target].items():
                    t = (i + 1 - t) / len(st.pieces) if p.reversed else (i + t) / len(st.pieces)
                    step[s][t] = apply(p.op, x)
        level = step
        if n in (length // 2, length):
            out.update(level[e])
    return sorted(out.items())


def spread(dirs):
    """Half-opening in degrees of a narrow double cone that holds the directions: axis by principal direction."""
    if len(dirs) == 0:
        return float("nan")
    axis = np.linalg.svd(dirs, full_matrices=False)[2][0]
    best = 90.0
    for a in [axis] + [dirs[i] for i in np.linspace(0, len(dirs) - 1, 12).astype(int)]:
        c = degrees(dirs, a)
        best = min(best, float(np.minimum(c, 180 - c).max()))
    return best


def angle(dirs, rays):
    """Largest angle of a direction to the nearest claimed ray, and of a ray to the nearest direction."""
    a = np.stack([degrees(dirs, r) for r in rays])
    return float(a.min(axis=0).max()), float(a.min(axis=1).max())


def between(case, e, gm, q, tcyc):
    """Secants met in a cell whose two ends are seen in opposite directions, by bisection over its cells."""
    found = []

    def secant(a):
        x = point(case, e, *a)
        v = [sum(r * (c - d) for r, c, d in zip(row, x, q)) for row in gm]
        return v

    def ends(word):
        """Directions at the two ends of a cell, or None where the cell holds the point itself."""
        s = path(case, e, word)[-1]
        at = [normalise(case, e, list(word) + h, c) for h, c in (end_address(case, none, s, side) for side in (0, 1))]
        ts = [parameter(case, e, *a) for a in at]
        if min(ts) <= tcyc <= max(ts):
            return None
        ab = [secant(a) for a in at]
        return [unit(integers([v])[0]) for v in ab] if all(map(any, ab)) else None

    none = {s: [] for s in case.states}
    length = 1
    while len(words(case, e, length + 1)) <= 130:
        length += 1
    word = None
    for w, _ in words(case, e, length):
        d = ends(w)
        if d and d[0] @ d[1] < 0:
            word = list(w)
            break
    while word is not None and len(word) < 700:
        down = [(i, ends(word + [i])) for i in range(len(case.states[path(case, e, word)[-1]].pieces))]
        found += [x for _, d in down if d for x in d]
        if any(abs(x @ found[0]) < 0.9 for x in found):
            break
        word = next((word + [i] for i, d in down if d and d[0] @ d[1] < 0), None)
    return found


def secants(case, prefix, cycle, ms):
    """{m: {side: unit secants}} from one branch."""
    u, e = operator(case, case.start, prefix)
    g = matmul(case.control, u) if case.control else u
    q = point(case, e, [], cycle)
    mat, _ = operator(case, e, cycle)
    cloud = samples(case, e, 60 if len(g[0]) > 4 else 130)
    diffs = integers([[a - b for a, b in zip(x, q)] for _, x in cloud])
    mi, gi = integers(mat), integers(g)
    curve = case.states[e].kind == "edge"
    tcyc = parameter(case, e, [], cycle) if curve else None
    out = {}
    sign_u, sign_w = 1, 1
    s = case.start
    for i in prefix:
        p = case.states[s].pieces[i]
        sign_u, s = (-sign_u if p.reversed else sign_u), p.target
    for i in cycle:
        p = case.states[s].pieces[i]
        sign_w, s = (-sign_w if p.reversed else sign_w), p.target
    for m in ms:
        gm = imul(gi, power(mi, m))
        sides = {-1: [], 1: []}
        for (t, _), d in zip(cloud, diffs):
            v = [sum(a * b for a, b in zip(r, d)) for r in gm]
            if not any(v):
                continue
            side = 1
            if curve:
                if t == tcyc:
                    continue
                side = (1 if t > tcyc else -1) * sign_u * sign_w ** m
            sides[side].append(unit(v))
        for side, dirs in sides.items():
            if curve and len(dirs) > 1 and m <= 65 and spread(np.array(dirs)) < 30:
                a = np.array(dirs)
                if (a @ a[0] < 0).any():
                    extra = between(case, e, [[Fraction(x) for x in r] for r in gm], q, tcyc)
                    dirs += extra
        out[m] = {k: np.array(v) for k, v in sides.items() if v}
    return out


def far(case, prefix, cycle, k, spaces):
    """Unit secants {side: ...} in the cell u w^(2^k), for unreversed curves."""
    mpmath.mp.dps = 2000
    big = lambda x: mpmath.mpf(x.numerator) / x.denominator
    u, e = operator(case, case.start, prefix)
    g = matmul(case.control, u) if case.control else u
    mat, _ = operator(case, e, cycle)
    bt = transpose(spaces[e])
    lin = mpmath.matrix([[big(x) for x in r] for r in solve(bt, matmul(mat, bt))])
    gb = mpmath.matrix([[big(x) for x in r] for r in matmul(g, bt)])
    for _ in range(k):
        lin = lin * lin
        lin = lin / max(abs(x) for x in lin)
    q, out = point(case, e, [], cycle), {-1: [], 1: []}
    for t, x in samples(case, e, 30):
        c = solve(bt, [[a - b] for a, b in zip(x, q)])
        v = gb * (lin * mpmath.matrix([big(r[0]) for r in c]))
        top = max(abs(a) for a in v)
        if top:
            d = np.array([float(a / top) for a in v])
            out[1 if t > parameter(case, e, [], cycle) else -1].append(d / np.linalg.norm(d))
    return {s: np.array(d) for s, d in out.items() if d}


def claims(case, branches):
    for p in case.expect.get("point", []):
        if casefile.parse_address(p["address"]) in [tuple(map(list, b)) for b in branches]:
            return p
    return {}


def as_rays(rows):
    exact = [[casefile.number(x) for x in r] for r in rows]
    a = np.array([[float(x / max(map(abs, r))) for x in r] for r in exact])
    return a / np.linalg.norm(a, axis=1, keepdims=True)


def main():
    wanted, bad = set(sys.argv[1:]), 0
    for f in casefile.all_cases():
        if wanted and f.stem not in wanted:
            continue
        try:
            case = casefile.load(f)
        except (casefile.Bad, ValueError):
            continue
        if "error" in case.expect or (case.edge and adjacency_errors(case)):
            continue
        print(f"== {f.parent.name}/{f.stem}", flush=True)
        spaces = relevant_spaces(case)
        for label, branches in points(case, spaces):
            claim = claims(case, branches)
            names = " | ".join(casefile.show_address(*b) for b in branches)
            print(f"   {label} {names}: claimed {claim.get('verdict', '-')} {claim.get('kind', '')}")
            ms = (8, 9, 64, 65, 512, 513) if f.stem not in FAR else ("far",)
            table = {}
            for b in branches:
                found = secants(case, *b, ms) if f.stem not in FAR else {"far": far(case, *b, FAR[f.stem], spaces)}
                for m, sides in found.items():
                    for side, d in sides.items():
                        table.setdefault(side, {}).setdefault(m, []).append(d)
            lines, worst, wide = {}, 0.0, 0.0
            for side in sorted(table):
                name = "left" if side < 0 else "right"
                if not case.edge:
                    name = "all"
                parts = []
                for m in ms:
                    d = np.vstack(table[side][m])
                    opening = spread(d)
                    text = f"{m}: {short(opening)}"
                    wide = max(wide, opening) if m in (64, 65) else wide
                    if m == ms[-1]:
                        lines[side] = (d, opening)
                    if name in claim:
                        to, back = angle(d, as_rays(claim[name]))
                        text += f"/{short(to)}/{short(back)}"
                        if m in ms[-2:]:
                            worst = max(worst, to)
                            if len(claim[name]) == 1:
                                worst = max(worst, back)
                    elif "tangent" in claim:
                        t = as_rays([claim["tangent"]])
                        to, _ = angle(d, np.vstack([t, -t]))
                        text += f"/{short(to)}"
                        if m in ms[-2:]:
                            worst = max(worst, to)
                    parts.append(text)
                mean = lines[side][0].mean(axis=0)
                print(f"      {name:5} spread/angles by m: " + "  ".join(parts) + "   mean ("
                      + ", ".join(f"{x:.6f}" for x in mean) + ")")
            every = np.vstack([d for d, _ in lines.values()]) if lines else np.zeros((0, 1))
            total, single = spread(every), max((s for _, s in lines.values()), default=0)
            print(f"      together {short(total)} degrees")
            slow = 2.0
            verdict, kind, problem = claim.get("verdict"), claim.get("kind"), ""
            if not lines:
                problem = "" if verdict != "proved" else "no germ"
            elif verdict == "proved" and (total > slow or worst > slow):
                problem = "claimed proved, but the secants do not close in"
            elif verdict == "refuted" and kind == "corner" and (single > slow or worst > slow):
                problem = "claimed corner, but a side does not close in"
            elif verdict == "refuted" and kind == "none" and max(total, wide) < 5:
                problem = "claimed none, but the secants close in"
            elif kind in ("regular", "cusp") and verdict == "proved" and len(lines) == 2:
                dot = float(lines[-1][0].mean(axis=0) @ lines[1][0].mean(axis=0))
                if (dot > 0) != (kind == "cusp"):
                    problem = f"kind {kind} but the rays have product {dot:.3f}"
            if problem:
                bad += 1
                print(f"      DIFFERS {problem}")
    print(f"{bad} differences")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
