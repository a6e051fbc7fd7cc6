"""Writes spectrum.txt: what FLINT (python-flint) finds for the matrices of benches/matrices.

One line for each matrix: its name, then for every irreducible factor `degree:multiplicity:block sizes:coefficients`
(primitive integers, constant first), then `classes` and the number of different eigenvalues in each class of equal
modulus, the largest modulus first. Block sizes come from the ranks of f(A)^k, moduli from 300-bit roots.
"""
import sys
from pathlib import Path
from flint import fmpq, fmpq_mat, fmpz_poly, ctx, acb, arb

here = Path(__file__).parent
ctx.prec = 600


def read(name):
    tokens = (here / "../../benches/matrices" / f"{name}.txt").read_text().split()
    n = int(tokens[0])
    def q(t):
        p, _, d = t.partition("/")
        return fmpq(int(p), int(d or 1))
    return n, fmpq_mat(n, n, [q(t) for t in tokens[1:]])


def at(f, a, n):
    value = fmpq_mat(n, n)
    one = fmpq_mat(n, n, [int(i == j) for i in range(n) for j in range(n)])
    for c in reversed(f.coeffs()):
        value = value * a + one * fmpq(c)
    return value


def blocks(f, m, a, n):
    d = f.degree()
    if m == 1:
        return [1]
    value = at(f, a, n)
    power, nullities = value, [0]
    while nullities[-1] < d * m:
        nullities.append(n - power.rank())
        power = power * value
    at_least = [(nullities[k + 1] - nullities[k]) // d for k in range(len(nullities) - 1)] + [0]
    sizes = []
    for k in range(len(at_least) - 1, 0, -1):
        sizes += [k] * (at_least[k - 1] - at_least[k])
    return sizes


def main():
    for name in sys.argv[1:]:
        n, a = read(name)
        chi = a.charpoly()
        numerator = chi.numer()
        _, factors = numerator.factor()
        out, moduli = [name], []
        keyed = []
        for f, m in factors:
            if f.leading_coefficient() < 0:
                f = -f
            keyed.append((f.degree(), [fmpq(c, f.leading_coefficient()) for c in f.coeffs()], f, m))
        keyed.sort(key=lambda t: (t[0], [float(c.p) / float(c.q) for c in t[1]]))
        for d, _, f, m in keyed:
            sizes = ",".join(map(str, blocks(f, m, a, n)))
            out.append(f"{d}:{m}:{sizes}:" + ",".join(str(c) for c in f.coeffs()))
            for root, _ in f.complex_roots():
                moduli.append(acb(root).abs_lower() if root != 0 else arb(0))
        moduli.sort(key=lambda x: -float(x))
        exact = sorted(moduli, key=lambda x: x.mid(), reverse=True) if False else moduli
        classes, last = [], None
        for x in exact:
            if last is not None and abs(x - last) < arb(2) ** -200:
                classes[-1] += 1
            else:
                classes.append(1)
            last = x
        out.append("classes " + ",".join(map(str, classes)))
        print(" ".join(out), flush=True)


main()
