"""Strategies of Hypothesis for property tests: stochastic matrices, masks with sum rules, matrices with a known Jordan form.

Needs the package hypothesis. All entries are of type :class:`fractions.Fraction`.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from hypothesis import strategies as st

Matrix = list[list[Fraction]]


def fractions(largest: int = 12) -> st.SearchStrategy[Fraction]:
    """Small fractions: numerators and denominators up to `largest`."""
    return st.builds(Fraction, st.integers(-largest, largest), st.integers(1, largest))


@st.composite
def stochastic_matrices(draw: Any, size: int | None = None, largest: int = 12) -> Matrix:
    """Column-stochastic matrices: entries that are not negative, columns that sum to 1.

    Parameters
    ----------
    size : int, optional
        The number of rows; from 1 to 5 where it is not given.
    largest : int
        The largest weight of an entry before its column is divided by its sum.
    """
    n = draw(st.integers(1, 5)) if size is None else size
    column = st.lists(st.integers(0, largest), min_size=n, max_size=n).filter(any)
    columns = [draw(column) for _ in range(n)]
    return [[Fraction(c[i], sum(c)) for c in columns] for i in range(n)]


@st.composite
def masks(draw: Any, arity: int = 2, length: int | None = None) -> list[Fraction]:
    """Masks that satisfy the first sum rule: the coefficients of each class modulo the arity sum to 1.

    Parameters
    ----------
    arity : int
        The arity.
    length : int, optional
        The number of coefficients, at least the arity; where it is not given up to four times as many.
    """
    n = draw(st.integers(arity + 1, 4 * arity)) if length is None else length
    mask = [draw(fractions()) for _ in range(n)]
    for k in range(arity):
        mask[k] += 1 - sum(mask[k::arity])
    return mask


@st.composite
def jordan_matrices(draw: Any, most: int = 5) -> tuple[Matrix, dict[Fraction, list[int]]]:
    """Matrices ``S J S⁻¹`` with the Jordan blocks that they have: each eigenvalue with the sizes of its blocks, descending.

    Parameters
    ----------
    most : int
        The largest size of the matrix.
    """
    left = draw(st.integers(1, most))
    blocks: dict[Fraction, list[int]] = {}
    while left > 0:
        size = draw(st.integers(1, left))
        blocks.setdefault(draw(fractions(6)), []).append(size)
        left -= size
    n = sum(map(sum, blocks.values()))
    matrix = [[Fraction(0)] * n for _ in range(n)]
    at = 0
    for eigenvalue, sizes in blocks.items():
        sizes.sort(reverse=True)
        for size in sizes:
            for k in range(at, at + size):
                matrix[k][k] = eigenvalue
                if k > at:
                    matrix[k - 1][k] = Fraction(1)
            at += size
    # Conjugated by elementary matrices, so that the similarity is exact.
    if n > 1:
        for _ in range(draw(st.integers(0, 2 * n))):
            i, j = draw(st.permutations(range(n)))[:2]
            c = draw(st.integers(-2, 2))
            matrix[i] = [x + c * y for x, y in zip(matrix[i], matrix[j], strict=True)]
            for row in matrix:
                row[j] -= c * row[i]
    return matrix, blocks


__all__ = ["fractions", "jordan_matrices", "masks", "stochastic_matrices"]
