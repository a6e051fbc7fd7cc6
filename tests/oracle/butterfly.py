#!/usr/bin/env python3
"""The norms of the difference scheme of the butterfly scheme with tension 1/16, used in src/vertex/butterfly.rs.

    python3 tests/oracle/butterfly.py
    # one step 7/8, two steps 31/64
"""
from collections import defaultdict
from fractions import Fraction as F

AROUND = [(1, 0), (0, 1), (-1, 1), (-1, 0), (0, -1), (1, -1)]


def plus(a, b):
    return (a[0] + b[0], a[1] + b[1])


def mask():
    a = defaultdict(F)
    a[0, 0] = F(1)
    for k in range(3):
        turn = lambda s: AROUND[(k + s) % 6]
        o, e = (0, 0), AROUND[k]
        stencil = [(o, 8), (e, 8), (turn(1), 2), (turn(5), 2), (turn(2), -1), (plus(e, turn(1)), -1), (turn(4), -1), (plus(e, turn(5)), -1)]
        for q, weight in stencil:
            a[e[0] - 2 * q[0], e[1] - 2 * q[1]] += F(weight, 16)
    return a


def quotient(a):
    """a / (1 + z) in the first direction."""
    b = defaultdict(F)
    for i in range(-8, 9):
        for j in range(-8, 9):
            b[i, j] = a.get((i, j), F(0)) - b.get((i - 1, j), F(0))
    assert all(b[8, j] == 0 for j in range(-8, 9)), "divisible"
    return {p: c for p, c in b.items() if c}


def norm(b, modulus):
    sums = defaultdict(F)
    for p, c in b.items():
        sums[p[0] % modulus, p[1] % modulus] += abs(c)
    return max(sums.values())


b = quotient(mask())
twice = defaultdict(F)
for q, c in b.items():
    for p, d in b.items():
        twice[p[0] + 2 * q[0], p[1] + 2 * q[1]] += c * d
assert (norm(b, 2), norm(twice, 4)) == (F(7, 8), F(31, 64))
print("one step", norm(b, 2), "two steps", norm(twice, 4))
