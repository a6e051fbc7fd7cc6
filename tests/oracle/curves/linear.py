"""Small exact linear algebra over Q: matrices are lists of rows of Fractions."""
from fractions import Fraction


def matmul(a, b):
    cols = list(zip(*b))
    return [[sum((x * y for x, y in zip(row, col)), Fraction(0)) for col in cols] for row in a]


def apply(a, x):
    return [sum((u * v for u, v in zip(row, x)), Fraction(0)) for row in a]


def identity(n):
    return [[Fraction(int(i == j)) for j in range(n)] for i in range(n)]


def transpose(a):
    return [list(r) for r in zip(*a)]


def rref(rows):
    rows, pivots, r = [list(x) for x in rows], [], 0
    width = len(rows[0]) if rows else 0
    for c in range(width):
        p = next((i for i in range(r, len(rows)) if rows[i][c] != 0), None)
        if p is None:
            continue
        rows[r], rows[p] = rows[p], rows[r]
        d = rows[r][c]
        rows[r] = [x / d for x in rows[r]]
        for i in range(len(rows)):
            if i != r and rows[i][c] != 0:
                f = rows[i][c]
                rows[i] = [x - f * y for x, y in zip(rows[i], rows[r])]
        pivots.append(c)
        r += 1
    return rows[:r], pivots


def rank(rows):
    return len(rref(rows)[1]) if rows else 0


def kernel(a, width):
    """Basis (list of vectors) of the kernel of the matrix `a` with `width` columns."""
    if not a:
        return [list(r) for r in identity(width)]
    red, piv = rref(a)
    out = []
    for f in (c for c in range(width) if c not in piv):
        v = [Fraction(0)] * width
        v[f] = Fraction(1)
        for row, p in zip(red, piv):
            v[p] = -row[f]
        out.append(v)
    return out


def solve(a, b):
    """A solution X of a X = b (columns of b), or None."""
    n = len(a[0])
    red, piv = rref([list(r) + list(s) for r, s in zip(a, b)])
    if any(p >= n for p in piv):
        return None
    x = [[Fraction(0)] * len(b[0]) for _ in range(n)]
    for row, p in zip(red, piv):
        x[p] = row[n:]
    return x
