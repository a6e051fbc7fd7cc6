#!/usr/bin/env python3
"""Times secant's exact spectra (with chains) beside FLINT's and PARI's characteristic polynomial and its factors, in one run.

    python3 -m venv venv && venv/bin/pip install python-flint cypari
    cargo build --release -p secant-exact --features parallel --example spectrum
    venv/bin/python benches/peers.py [--seed 1] [--only skew]

The factors and multiplicities of every row must be the same; the script stops with an error where they are not. FLINT and
PARI give no chains and no classes of equal modulus, so that the ratio says what the whole answer costs in units of its
first step. Matrices over number fields are compared with PARI alone.
"""
import argparse
import os
import pathlib
import random
import re
import subprocess
import sys
import tempfile
import time

import cypari
import flint

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = pathlib.Path(os.environ.get("SPECTRUM", ROOT / "target/release/examples/spectrum"))
PARI = cypari.pari
PARI.allocatemem(1 << 30, 1 << 30, silent=True)


PRIMITIVE = PARI("f -> my(g = f / content(f)); if (pollead(g) < 0, -g, g)")


def primitive(text):
    """One text for all multiples of a polynomial over Q."""
    return str(PRIMITIVE(PARI(re.sub(r"(\d)x", r"\1*x", str(text)))))


def square(n, entry):
    return [[entry(i, j) for j in range(n)] for i in range(n)]


def skew(rng, n):
    a = square(n, lambda i, j: rng.randint(-9, 9))
    return square(n, lambda i, j: (i > j) * a[i][j] - (i < j) * a[j][i])


def cyclic(rng, n):
    return square(n, lambda i, j: rng.randint(0, 9) if (i * 4 // n + 1) % 4 == j * 4 // n else 0)


def companion(_, n):
    last = {0: -3, n // 2: 5}
    return square(n, lambda i, j: last.get(i, 0) if j == n - 1 else int(i == j + 1))


def circulant(_, n):
    return square(n, lambda i, j: (j - i) % n + 1)


def far(rng, n):
    return square(n, lambda i, j: rng.randint(-9, 9) + (10**100 if i == j else 0))


def kronecker(rng, n):
    a, b = (square(n, lambda i, j: rng.randint(-5, 5)) for _ in range(2))
    return square(n * n, lambda i, j: a[i // n][j // n] * b[i % n][j % n])


def kronecker_sum(rng, n):
    a, b = (square(n, lambda i, j: rng.randint(-5, 5)) for _ in range(2))
    return square(n * n, lambda i, j: (i % n == j % n) * a[i // n][j // n] + (i // n == j // n) * b[i % n][j % n])


def golden(rng, n):
    return square(n, lambda i, j: (rng.randint(-9, 9), rng.randint(-9, 9)))


def heptagon(rng, n):
    return square(n, lambda i, j: tuple(rng.randint(-3, 3) for _ in range(3)))


KINDS = [
    ("skew-symmetric", skew, (6, 8, 10, 30)),
    ("4-cyclic", cyclic, (12,)),
    ("x^n - 5x^(n/2) + 3", companion, (8, 16, 24, 60)),
    ("circulant(1..n)", circulant, (16, 17, 25)),
    ("10^100 + small", far, (4, 11)),
    ("Kronecker product", kronecker, (3, 4)),
    ("Kronecker sum", kronecker_sum, (3, 4)),
]
FILES = ["stoch_040", "stoch_080", "stoch_160", "jordan_64", "cyc3_48", "cc1_32"]
FIELDS = [
    ("Q(sqrt 5)", golden, (10, 20), "y^2-5", ["", "*sqrt(5)"]),
    ("Q(cos 2π/7)", heptagon, (10,), "y^3+y^2-2*y-1", ["", "*(2*cos(2*pi/7))", "*(2*cos(2*pi/7))^2"]),
]


def best(work, times=3):
    found, least = None, None
    for _ in range(times):
        start = time.perf_counter()
        found = work()
        took = time.perf_counter() - start
        least = took if least is None else min(least, took)
    return found, least * 1e3


def ours(rows):
    """The factors as (multiplicity, integer coefficients), and the least of three times in milliseconds."""
    with tempfile.NamedTemporaryFile("w", suffix=".txt") as file:
        file.write(f"{len(rows)}\n" + "\n".join(" ".join(map(str, row)) for row in rows) + "\n")
        file.flush()
        runs = [subprocess.run([PROGRAM, file.name], capture_output=True, text=True, check=True) for _ in range(3)]
    factors = set()
    for line in runs[0].stdout.splitlines():
        if not line.startswith("classes"):
            head, poly = line.split("] ", 1)
            factors.add((int(head.split()[1]), primitive(poly)))
    return factors, min(float(r.stderr.rsplit(": ", 1)[1].split(" ms")[0]) for r in runs)


def fractions(rows):
    return flint.fmpq_mat([[flint.fmpq(*map(int, str(x).split("/"))) for x in row] for row in rows])


def by_flint(matrix):
    _, factors = matrix.charpoly().factor()
    return factors


def row(name, n, time_ours, time_flint, time_pari):
    def cell(t):
        return "–" if t is None else f"{t:.2f} ms ({time_ours / t:.1f})"

    print(f"| {name} | {n} | {time_ours:.1f} ms | {cell(time_flint)} | {cell(time_pari)} |", flush=True)


def rational(name, rows):
    factors, time_ours = ours(rows)
    matrix = fractions(rows)
    theirs, time_flint = best(lambda: by_flint(matrix))
    seen = {(e, primitive(f)) for f, e in theirs}
    if factors != seen:
        sys.exit(f"{name}: {factors ^ seen}")
    text = "[" + ";".join(",".join(map(str, row)) for row in rows) + "]"
    pari_matrix = PARI(text)
    _, time_pari = best(lambda: PARI.factor(PARI.charpoly(pari_matrix)))
    row(name, len(rows), time_ours, time_flint, time_pari)


def over_field(name, rows, poly, names):
    def text(x, symbols):
        return "+".join(f"({c}){s}" for c, s in zip(x, symbols))

    factors, time_ours = ours([[text(x, names) for x in line] for line in rows])
    symbols = ["", "*y", "*y^2"]
    entries = ";".join(",".join(f"Mod({text(x, symbols)},{poly})" for x in line) for line in rows)
    matrix, field = PARI(f"[{entries}]"), PARI(f"nfinit({poly})")
    found, time_pari = best(lambda: PARI.nffactor(field, PARI.charpoly(matrix)), 1)
    # The minimal polynomials over Q of the roots: norms of the factors.
    norm = PARI(f"f -> factor(polresultant(lift(f), {poly}, y))[1, 1]")
    seen = {(int(e), primitive(norm(f))) for f, e in zip(found[0], found[1])}
    if factors != seen:
        sys.exit(f"{name}: {factors} {seen}")
    row(name, len(rows), time_ours, None, time_pari)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", default="", help="rows whose name contains this")
    options = parser.parse_args()
    rng = random.Random(options.seed)
    print("| matrix | n | secant | FLINT (secant / FLINT) | PARI (secant / PARI) |\n|---|---|---|---|---|")
    for name, kind, sizes in KINDS:
        for n in sizes:
            rows = kind(rng, n)
            if options.only in name:
                rational(name, rows)
    for name in filter(lambda name: options.only in name, FILES):
        words = (ROOT / f"benches/matrices/{name}.txt").read_text().split()
        n = int(words[0])
        rational(name, [words[1 + i * n : 1 + (i + 1) * n] for i in range(n)])
    for name, kind, sizes, poly, names in FIELDS:
        for n in sizes:
            rows = kind(rng, n)
            if options.only in name:
                over_field(name, rows, poly, names)


main()
