"""Spectra of matrices over real number fields, by SymPy: writes field.txt.

Each line: name; the matrix as `n` and its entries; for every irreducible factor over the field
`degree over K:exponent:block sizes:minimal polynomial of its roots over Q (integers, constant first)`.

The characteristic polynomial, its factors and the ranks of h(A)^k are computed over K = QQ<a>; nothing is numerical.
"""
import random
import sys
from sympy import Poly, QQ, Rational, cbrt, cos, factor_list, lcm, minimal_polynomial, pi, resultant, sqrt, symbols
from sympy.polys.matrices import DomainMatrix

x, y = symbols("x y")
random.seed(20)


def norm_minpoly(h, K, f):
    """The minimal polynomial over Q of the roots of h (a list of elements of K, leading first)."""
    poly = 0
    for c in h:
        inner = sum(QQ.to_sympy(q) * y**k for k, q in enumerate(reversed(K.convert(c).to_list())))
        poly = poly * x + inner
    norm = Poly(resultant(f.as_expr().subs(f.gen, y), poly, y), x)
    factors = factor_list(norm.as_expr(), x)[1]
    assert len(factors) == 1, factors
    p = Poly(factors[0][0], x)
    p = p.clear_denoms()[1].primitive()[1]
    c = [int(k) for k in reversed(p.all_coeffs())]
    return [-k for k in c] if c[-1] < 0 else c


def spectrum(entries, generator, n):
    K = QQ.algebraic_field(generator)
    f = Poly(minimal_polynomial(K.ext.as_expr(), x), x)
    A = DomainMatrix([[K.from_sympy(e) for e in row] for row in entries], (n, n), K)
    chi = Poly.from_list(A.charpoly(), x, domain=K)
    out = []
    for h, m in chi.factor_list()[1]:
        coefficients = h.monic().rep.to_list()
        hA = DomainMatrix.zeros((n, n), K)
        one = DomainMatrix.eye(n, K)
        for c in coefficients:
            hA = hA * A + one * c
        e = h.degree()
        ranks, power = [n], one
        while len(ranks) < 2 or ranks[-1] != ranks[-2]:
            power = power * hA
            ranks.append(power.rank())
        counts = [(a - b) // e for a, b in zip(ranks, ranks[1:])]  # blocks of size >= k
        sizes = [sum(1 for c in counts if c > i) for i in range(counts[0])]
        mp = norm_minpoly(coefficients, K, f)
        out.append(f"{e}:{m}:{','.join(map(str, sizes))}:{','.join(map(str, mp))}")
    return sorted(out)


def text(e):
    return str(e).replace(" ", "").replace("**", "^")


def random_matrix(g, n, deg):
    r = lambda: Rational(random.randint(-3, 3), random.choice([1, 1, 2, 3]))
    return [[sum((r() * g**k for k in range(deg)), Rational(0)) if random.random() < 0.7 else Rational(0) for _ in range(n)] for _ in range(n)]


def loop(n):
    c = cos(2 * pi / n)
    beta = (Rational(5, 8) - (Rational(3, 8) + c / 4) ** 2) / n
    rows = [[1 - n * beta] + [beta] * n]
    for i in range(n):
        row = [Rational(3, 8)] + [Rational(0)] * n
        row[1 + i] += Rational(3, 8)
        row[1 + (i + 1) % n] += Rational(1, 8)
        row[1 + (i - 1) % n] += Rational(1, 8)
        rows.append(row)
    return rows


def doo_sabin(n):
    w = [(3 + 2 * cos(2 * pi * j / n)) / (4 * n) + (Rational(1, 4) if j == 0 else 0) for j in range(n)]
    return [[w[(j - i) % n] for j in range(n)] for i in range(n)]


def planted(g):
    J = [[g, 1, 0, 0, 0], [0, g, 0, 0, 0], [0, 0, g, 0, 0], [0, 0, 0, -g, 1], [0, 0, 0, 0, -g]]
    from sympy import Matrix
    P = Matrix(5, 5, lambda i, j: 1 if i == j else (random.randint(-1, 1) * (1 + g) if j > i else 0))
    M = (P * Matrix(J) * P.inv()).applyfunc(lambda e: e.expand().simplify())
    return M.tolist()


s3 = sqrt(3)
db2 = [(1 + s3) / 4, (3 + s3) / 4, (3 - s3) / 4, (1 - s3) / 4]
cases = [
    ("quadratic-random-4", sqrt(5), random_matrix(sqrt(5), 4, 2)),
    ("quadratic-random-5", sqrt(3), random_matrix(sqrt(3), 5, 2)),
    ("cubic-random-3", cbrt(2), random_matrix(cbrt(2), 3, 3)),
    ("planted", sqrt(2), planted(sqrt(2))),
    ("biquadratic", sqrt(2) + s3, [[sqrt(2), 1, 0, s3], [0, s3, 1, 0], [1, 0, 0, sqrt(6)], [0, 0, 1, 0]]),
    ("swap", sqrt(5), [[0, 0, sqrt(5), 0], [0, 0, 0, 1], [1, 0, 0, 0], [0, sqrt(5), 0, 0]]),
    ("loop-5", sqrt(5), loop(5)),
    ("loop-7", cos(2 * pi / 7), loop(7)),
    ("loop-8", sqrt(2), loop(8)),
    ("doo-sabin-5", sqrt(5), doo_sabin(5)),
    ("doo-sabin-7", cos(2 * pi / 7), doo_sabin(7)),
    ("db2-0", s3, [[db2[2 * i - j] if 0 <= 2 * i - j < 4 else 0 for j in range(3)] for i in range(3)]),
    ("db2-1", s3, [[db2[2 * i - j + 1] if 0 <= 2 * i - j + 1 < 4 else 0 for j in range(3)] for i in range(3)]),
]
with open(sys.argv[1] if len(sys.argv) > 1 else "field.txt", "w") as out:
    for name, g, m in cases:
        n = len(m)
        from sympy import sympify
        m = [[sympify(e) for e in row] for row in m]
        if name in ("loop-5", "doo-sabin-5", "loop-8"):
            m = [[sympify(e).subs({cos(2 * pi / 5): (sqrt(5) - 1) / 4}).simplify() for e in row] for row in m]
        if "-7" in name:
            # every cosine in powers of the first one
            c = cos(2 * pi / 7)
            powers = {cos(4 * pi / 7): 2 * c**2 - 1, cos(6 * pi / 7): 4 * c**3 - 3 * c, cos(8 * pi / 7): 4 * c**3 - 3 * c,
                      -cos(3 * pi / 7): 2 * c**2 - 1, cos(3 * pi / 7): 1 - 2 * c**2, cos(pi / 7): 3 * c - 4 * c**3}
            m = [[e.subs(powers).expand() for e in row] for row in m]
        line = spectrum(m, g, n)
        print(f"{name}; {n} {' '.join(text(e) for row in m for e in row)}; {' '.join(line)}", file=out)
        print(name, line, file=sys.stderr, flush=True)
