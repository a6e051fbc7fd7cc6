#!/usr/bin/env python3
"""Characteristic maps by dense sampling, without the program: numpy-free complex arithmetic in one Fourier block.

A net holds the values of sector 0 by lattice place; the value in sector s is w^s times that of sector 0. The rules are those
of the textbooks, written for lattice places. The eigenvector comes from power iteration, the ring from four more steps of
subdivision; printed are the eigenvalue, the smallest and largest Jacobian determinant relative to the mean size of the ring
(from differences of neighbouring points), and the winding number of the outer boundary.

    python3 tests/oracle/characteristic.py > tests/oracle/characteristic.txt
"""
import cmath
import math

LEVELS = 4


class Primal:
    """Places (i, j), i > 0 and j >= 0, and the centre."""

    def __init__(self, w, triangles):
        self.w, self.triangles = w, triangles

    def get(self, net, i, j):
        turn = 0
        while True:
            if (i, j) == (0, 0):
                return 0
            if i > 0 and j >= 0:
                return net[i, j] * self.w**turn
            if i == 0 and j > 0:
                i, j, turn = j, 0, turn + 1
            elif j < 0 <= i:
                i, j, turn = (-j, i + j, turn - 1) if self.triangles else (-j, i, turn - 1)
            elif i < 0 <= j:
                i, j, turn = (i + j, -i, turn + 1) if self.triangles else (j, -i, turn + 1)
            else:
                raise KeyError

    def places(self, size):
        for i in range(1, size + 1):
            for j in range(size + 1):
                if not self.triangles or i + j <= size:
                    yield i, j


class CatmullClark(Primal):
    def __init__(self, n, k=1):
        super().__init__(cmath.exp(2j * math.pi * k / n), False)

    def new(self, net, i, j):
        g = lambda a, b: self.get(net, a, b)
        a, b = i // 2, j // 2
        if i % 2 and j % 2:
            return (g(a, b) + g(a + 1, b) + g(a, b + 1) + g(a + 1, b + 1)) / 4
        if i % 2:
            return (6 * (g(a, b) + g(a + 1, b)) + g(a, b + 1) + g(a + 1, b + 1) + g(a, b - 1) + g(a + 1, b - 1)) / 16
        if j % 2:
            return (6 * (g(a, b) + g(a, b + 1)) + g(a + 1, b) + g(a + 1, b + 1) + g(a - 1, b) + g(a - 1, b + 1)) / 16
        edges = g(a + 1, b) + g(a - 1, b) + g(a, b + 1) + g(a, b - 1)
        corners = g(a + 1, b + 1) + g(a - 1, b + 1) + g(a + 1, b - 1) + g(a - 1, b - 1)
        return (36 * g(a, b) + 6 * edges + corners) / 64


class Loop(Primal):
    def __init__(self, n, k=1):
        super().__init__(cmath.exp(2j * math.pi * k / n), True)

    def new(self, net, i, j):
        g = lambda a, b: self.get(net, a, b)
        a, b = i // 2, j // 2
        if i % 2 and j % 2:
            return (3 * (g(a + 1, b) + g(a, b + 1)) + g(a, b) + g(a + 1, b + 1)) / 8
        if i % 2:
            return (3 * (g(a, b) + g(a + 1, b)) + g(a, b + 1) + g(a + 1, b - 1)) / 8
        if j % 2:
            return (3 * (g(a, b) + g(a, b + 1)) + g(a + 1, b) + g(a - 1, b + 1)) / 8
        ring = g(a + 1, b) + g(a, b + 1) + g(a - 1, b + 1) + g(a - 1, b) + g(a, b - 1) + g(a + 1, b - 1)
        return (10 * g(a, b) + ring) / 16


class Dual:
    """Cells [i, i+1] x [j, j+1], i, j >= 0; `central` is the transform of the weights in the central face."""

    triangles = False

    def __init__(self, n, central, weights, k=1):
        self.w = cmath.exp(2j * math.pi * k / n)
        self.central, self.weights = central(n, k), weights

    def get(self, net, i, j):
        turn = 0
        while not (i >= 0 and j >= 0):
            i, j, turn = (-1 - j, i, turn - 1) if j < 0 else (j, -1 - i, turn + 1)
        return net[i, j] * self.w**turn

    def places(self, size):
        return ((i, j) for i in range(size) for j in range(size))

    def new(self, net, i, j):
        if (i, j) == (0, 0):
            return self.central * net[0, 0]
        # The new cell (i, j) is the corner, towards its lattice point of even coordinates, of an old cell ... seen from the
        # face around the lattice point that is the nearest even corner.
        a, b = (i + 1) // 2, (j + 1) // 2
        x, y = (0 if i % 2 == 0 else -1), (0 if j % 2 == 0 else -1)
        own, side, across, other = (a + x, b + y), (a - 1 - x, b + y), (a - 1 - x, b - 1 - y), (a + x, b - 1 - y)
        p, q, r, q2 = self.weights
        g = lambda c: self.get(net, *c)
        return p * g(own) + q * g(side) + r * g(across) + q2 * g(other)


def original(n, k):
    return 1 if k % n == 0 else 0.5 if k % n in (1, n - 1) else 0.25


def frequency2(n, k):
    return 1 if k % n == 0 else 0.5 if k % n in (2, n - 2) else 0.25


def catmull_clark(n, k):
    return 0.5 + math.cos(2 * math.pi * k / n) / 4


def midedge(n, k):
    return (1 + math.cos(2 * math.pi * k / n)) / 2


QUAD = (9 / 16, 3 / 16, 1 / 16, 3 / 16)
SCHEMES = {
    "catmull-clark": CatmullClark,
    "loop": Loop,
    "doo-sabin": lambda n: Dual(n, original, QUAD),
    "doo-sabin-catmull-clark": lambda n: Dual(n, catmull_clark, QUAD),
    "doo-sabin-frequency": lambda n: Dual(n, frequency2, QUAD, 2),
    "midedge": lambda n: Dual(n, midedge, (1 / 2, 1 / 4, 0, 1 / 4)),
}


def eigenvector(scheme):
    net = {p: complex(p[0] + 0.5) + complex(p[1]) * scheme.w for p in scheme.places(3)}
    value = 0
    for _ in range(400):
        fresh = {p: scheme.new(net, *p) for p in scheme.places(3)}
        place = (0, 0) if (0, 0) in net else (1, 0)
        value = fresh[place] / net[place]
        net = {p: v / fresh[place] for p, v in fresh.items()}
    return value.real, net


def sample(scheme):
    value, net = eigenvector(scheme)
    size = 3
    for _ in range(LEVELS):
        size = 2 * size - 1
        net = {p: scheme.new(net, *p) for p in scheme.places(size)}
    low, high = 2**LEVELS, 2 ** (LEVELS + 1)
    dets, boundary = [], []
    for i, j in scheme.places(high):
        radius = i + j if scheme.triangles else max(i, j)
        if low <= radius < high:
            o, u, v = (scheme.get(net, *p) for p in ((i, j), (i + 1, j), (i, j + 1)))
            dets.append(((u - o).conjugate() * (v - o)).imag)
    corner = (0, 0) if (0, 0) in net else (1, 0)
    top = high - 1 if corner == (0, 0) else high
    if scheme.triangles:
        boundary = [(top - j, j) for j in range(top)]
    else:
        boundary = [(top, j) for j in range(top)] + [(i, top) for i in range(top, -1, -1)]
    path = [scheme.get(net, *p) for p in boundary]
    path.append(path[0] * scheme.w)
    angle = sum(cmath.phase(b / a) for a, b in zip(path, path[1:]))
    scale = abs(path[0]) ** 2 / high**2
    return value, min(dets) / scale, max(dets) / scale, angle


def main():
    print("# scheme valence eigenvalue min-Jacobian max-Jacobian winding")
    for name, make in SCHEMES.items():
        for n in [*range(3 if name in ("catmull-clark", "loop", "doo-sabin", "doo-sabin-catmull-clark") else 5, 13), 20, 31]:
            value, low, high, angle = sample(make(n))
            print(name, n, f"{value:.12f} {low:.6f} {high:.6f} {angle * n / (2 * math.pi):.6f}")


main()
