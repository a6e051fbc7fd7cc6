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

    factor, levels, rings = 2, LEVELS, 3

    def grow(self, size):
        return 2 * size - 1

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


class Smooth(Primal):
    """Schemes that are no splines: more rings, and `grow` tells how many a step leaves."""

    rings = 6

    def canonical(self, i, j):
        turn = 0
        while not (i > 0 and j >= 0):
            if (i, j) == (0, 0):
                return 0, 0, 0
            if i == 0 and j > 0:
                i, j, turn = j, 0, turn + 1
            elif j < 0 <= i:
                i, j, turn = (-j, i + j, turn - 1) if self.triangles else (-j, i, turn - 1)
            else:
                i, j, turn = (i + j, -i, turn + 1) if self.triangles else (j, -i, turn + 1)
        return i, j, turn

    def get(self, net, i, j):
        i, j, turn = self.canonical(i, j)
        return 0 if (i, j) == (0, 0) else net[i, j] * self.w**turn


AROUND = [(1, 0), (0, 1), (-1, 1), (-1, 0), (0, -1), (1, -1)]


class Butterfly(Smooth):
    def __init__(self, n, k=1, modified=False, tension=1 / 16):
        super().__init__(cmath.exp(2j * math.pi * k / n), True)
        self.modified = modified and n != 6
        self.tension = tension

    def grow(self, size):
        return 2 * size - 3

    def new(self, net, i, j):
        if self.modified and (i, j) == (1, 0):
            return net[1, 0] / 2
        a = (i // 2, j // 2)
        if i % 2 == 0 and j % 2 == 0:
            return self.get(net, *a)
        # The direction of the edge: (1,0), (0,1), or (-1,1) from the point to the right.
        d = 0 if j % 2 == 0 else 1 if i % 2 == 0 else 2
        if d == 2:
            a = (a[0] + 1, a[1])
        at = lambda *moves: self.get(net, a[0] + sum(AROUND[m % 6][0] for m in moves), a[1] + sum(AROUND[m % 6][1] for m in moves))
        w = self.tension
        near = at() + at(d)
        side = at(d + 1) + at(d - 1)
        far = at(d + 2) + at(d, d + 1) + at(d - 2) + at(d, d - 1)
        return near / 2 + 2 * w * side - w * far


class Sqrt3(Smooth):
    """Two steps; places are those after both, in which old points have coordinates that are multiples of 3."""

    factor, levels = 3, 3

    def __init__(self, n, k=1):
        super().__init__(cmath.exp(2j * math.pi * k / n), True)

    def grow(self, size):
        return 3 * size - 6

    def between(self, net, i, j):
        i, j, turn = self.canonical(i, j)
        if (i, j) == (0, 0):
            return 0
        g = lambda a, b: self.get(net, a // 3, b // 3)
        if i % 3 == 0 and j % 3 == 0:
            value = 2 / 3 * g(i, j) + sum(g(i + 3 * a, j + 3 * b) for a, b in AROUND) / 18
        else:
            corner = (i - i % 3, j - j % 3)
            own = [(3, 0), (0, 3), (0, 0)] if i % 3 == 1 else [(3, 0), (0, 3), (3, 3)]
            value = sum(g(corner[0] + a, corner[1] + b) for a, b in own) / 3
        return value * self.w**turn

    def new(self, net, i, j):
        g = lambda a, b: self.between(net, a, b)
        if (i - j) % 3 == 0:
            return 2 / 3 * g(i, j) + sum(g(i + a, j + b) for a, b in [(1, 1), (-1, 2), (-2, 1), (-1, -1), (1, -2), (2, -1)]) / 18
        near = [(i + a, j + b) for a, b in AROUND if (i + a - j - b) % 3 == 0]
        return sum(g(*p) for p in near) / 3


class FourEight(Smooth):
    """Two steps; after the first, points have coordinates of even sum."""

    def __init__(self, n, k=1):
        super().__init__(cmath.exp(2j * math.pi * k / n), False)

    def grow(self, size):
        return 2 * size - 3

    def between(self, net, i, j):
        i, j, turn = self.canonical(i, j)
        if (i, j) == (0, 0):
            return 0
        g = lambda a, b: self.get(net, a // 2, b // 2)
        if i % 2 == 0:
            value = g(i, j) / 2 + (g(i + 2, j) + g(i - 2, j) + g(i, j + 2) + g(i, j - 2)) / 8
        else:
            value = (g(i + 1, j + 1) + g(i - 1, j + 1) + g(i + 1, j - 1) + g(i - 1, j - 1)) / 4
        return value * self.w**turn

    def new(self, net, i, j):
        g = lambda a, b: self.between(net, a, b)
        if (i + j) % 2 == 0:
            return g(i, j) / 2 + (g(i + 1, j + 1) + g(i - 1, j + 1) + g(i + 1, j - 1) + g(i - 1, j - 1)) / 8
        return (g(i + 1, j) + g(i - 1, j) + g(i, j + 1) + g(i, j - 1)) / 4


class Dual:
    """Cells [i, i+1] x [j, j+1], i, j >= 0; `central` is the transform of the weights in the central face."""

    triangles = False
    factor, levels, rings = 2, LEVELS, 3
    grow = Primal.grow

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
    "butterfly": lambda n: Butterfly(n, 1 if n < 8 else 2 if n < 14 else 3),
    "butterfly-modified": lambda n: Butterfly(n, modified=True),
    "sqrt3": Sqrt3,
    "four-eight": FourEight,
}


FROM_3 = [*range(3, 13), 20, 31]
VALENCES = {name: FROM_3 for name in SCHEMES if name not in ("doo-sabin-frequency", "midedge", "butterfly")}
VALENCES["butterfly"] = [*range(4, 17)]


def eigenvector(scheme):
    net = {p: complex(p[0] + 0.5) + complex(p[1]) * scheme.w for p in scheme.places(scheme.rings)}
    value = 0
    for _ in range(400):
        fresh = {p: scheme.new(net, *p) for p in scheme.places(scheme.rings)}
        place = (0, 0) if (0, 0) in net else (1, 0)
        value = fresh[place] / net[place]
        net = {p: v / fresh[place] for p, v in fresh.items()}
    return value.real, net


def sample(scheme):
    value, net = eigenvector(scheme)
    size = scheme.rings
    for _ in range(scheme.levels):
        size = scheme.grow(size)
        net = {p: scheme.new(net, *p) for p in scheme.places(size)}
    low = scheme.factor**scheme.levels
    high = scheme.factor * low
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
        for n in VALENCES.get(name, [*range(5, 13), 20, 31]):
            value, low, high, angle = sample(make(n))
            print(name, n, f"{value:.12f} {low:.6f} {high:.6f} {angle * n / (2 * math.pi):.6f}")
    print("# weights with a given transform in the central face, and the butterfly scheme with tensions 1/20 and 1/100: not read by the tests")
    for n, value in [(3, 0.8), (3, 0.9), (4, 0.9), (4, 0.95)]:
        found, low, high, angle = sample(Dual(n, lambda n, k: value, QUAD))
        print("# doo-sabin", n, f"{found:.12f} {low:.6f} {high:.6f} {angle * n / (2 * math.pi):.6f}")
    for tension, valences in [(20, range(3, 10)), (100, range(3, 6))]:
        for n in valences:
            found, low, high, angle = sample(Butterfly(n, modified=True, tension=1 / tension))
            print(f"# butterfly-tension-1/{tension}", n, f"{found:.12f} {low:.6f} {high:.6f} {angle * n / (2 * math.pi):.6f}")


main()
