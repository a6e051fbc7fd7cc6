"""Spectra and Jordan forms of matrices."""

from __future__ import annotations

import html
import json
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any

from . import _secant
from ._cases import Convention, source
from ._errors import InputError
from ._numbers import Algebraic, Exact, decimal_interval, entry_text, matrix, value
from ._results import Certificate, Number, _sympy


@dataclass(frozen=True)
class Eigenvalue:
    """An eigenvalue with its Jordan blocks.

    Attributes
    ----------
    value : Fraction or Algebraic
        The eigenvalue.
    multiplicity : int
        Its algebraic multiplicity.
    blocks : tuple of int
        The sizes of its Jordan blocks, descending.
    modulus : pair of Fraction
        Exact bounds of its absolute value.
    """

    value: Number
    multiplicity: int
    blocks: tuple[int, ...]
    modulus: tuple[Fraction, Fraction]


class Spectrum:
    """The exact spectrum of a square matrix: eigenvalues, Jordan blocks, chains, classes of equal modulus."""

    def __init__(self, name: str, data: dict[str, Any], certificate: Certificate | None) -> None:
        self.name, self._data, self.certificate = name, data, certificate

    @property
    def size(self) -> int:
        """The number of rows."""
        return int(self._data["size"])

    @property
    def factors(self) -> list[dict[str, Any]]:
        """The irreducible factors of the characteristic polynomial with roots and chains, as data."""
        factors: list[dict[str, Any]] = self._data["factors"]
        return factors

    def _value(self, factor: int, root: int) -> Number:
        f = self.factors[factor]
        return value(_minimal(f), f["roots"][root]["index"], ("0", "1"))

    def _eigenvalue(self, factor: int, root: int) -> Eigenvalue:
        f = self.factors[factor]
        modulus = decimal_interval(f["roots"][root]["modulus"])
        return Eigenvalue(self._value(factor, root), f["multiplicity"], tuple(f["blocks"]), modulus)

    @cached_property
    def classes(self) -> tuple[tuple[Eigenvalue, ...], ...]:
        """The eigenvalues by absolute value, the largest first; exact ties share a class."""
        return tuple(
            tuple(self._eigenvalue(m["factor"], m["root"]) for m in members)
            for members in self._data["modulus_classes"]
        )

    @property
    def eigenvalues(self) -> tuple[Eigenvalue, ...]:
        """All eigenvalues, the largest absolute value first."""
        return tuple(e for members in self.classes for e in members)

    @property
    def blocks(self) -> tuple[tuple[Number, int], ...]:
        """The Jordan blocks: each eigenvalue with the size of each of its blocks."""
        return tuple((e.value, size) for e in self.eigenvalues for size in e.blocks)

    def _chains(self, side: str) -> tuple[tuple[Number, tuple[tuple[Number, ...], ...]], ...]:
        found = []
        for members in self._data["modulus_classes"]:
            for m in members:
                f = self.factors[m["factor"]]
                polynomial, index = _generator(f, m["root"])
                for chain in f[side]:
                    vectors = tuple(tuple(value(polynomial, index, e) for e in vector) for vector in chain)
                    found.append((self._value(m["factor"], m["root"]), vectors))
        return tuple(found)

    @cached_property
    def chains(self) -> tuple[tuple[Number, tuple[tuple[Number, ...], ...]], ...]:
        """The Jordan chains: an eigenvalue ``λ`` and vectors with ``A v₁ = λ v₁``, ``A vⱼ₊₁ = λ vⱼ₊₁ + vⱼ``."""
        return self._chains("right")

    @cached_property
    def left_chains(self) -> tuple[tuple[Number, tuple[tuple[Number, ...], ...]], ...]:
        """The same for row vectors on the left of the matrix."""
        return self._chains("left")

    @property
    def is_rational(self) -> bool:
        """Whether the matrix is rational."""
        return "field" not in self._data

    def jordan_form(self) -> JordanForm:
        """The Jordan form with the matrix of its chains."""
        return JordanForm(self)

    def to_dict(self) -> dict[str, Any]:
        """The spectrum as data: what ``secant spectrum --json`` prints."""
        copy: dict[str, Any] = json.loads(json.dumps(self._data))
        return copy

    def __repr__(self) -> str:
        shown = ", ".join(f"{_short(v)} ({n})" for v, n in self.blocks[:6])
        return f"<Spectrum of {self.name}: {shown}{', …' if len(self.blocks) > 6 else ''}>"

    def _repr_html_(self) -> str:
        rows = "".join(
            f"<tr><td>{html.escape(_short(e.value))}</td><td>{float(e.modulus[0]):.10g}</td><td>{e.multiplicity}</td>"
            f"<td>{', '.join(map(str, e.blocks))}</td></tr>"
            for e in self.eigenvalues
        )
        head = "<tr><th>eigenvalue</th><th>modulus</th><th>multiplicity</th><th>blocks</th></tr>"
        return f"<p><b>{html.escape(self.name)}</b>, {self.size} × {self.size}</p><table>{head}{rows}</table>"


def _short(x: Number) -> str:
    return str(x) if isinstance(x, Fraction) else f"{complex(x):.6g}" if not x.is_real else f"{float(x):.6g}"


def _minimal(factor: dict[str, Any]) -> list[str]:
    found: list[str] = factor.get("minimal_polynomial", factor["polynomial"])
    return found


def _generator(factor: dict[str, Any], root: int) -> tuple[list[str], int]:
    """The polynomial and the root in which the chains of an eigenvalue are written."""
    if "theta" in factor:
        return factor["theta"]["polynomial"], factor["theta"]["indices"][root]
    return factor["polynomial"], factor["roots"][root]["index"]


Rows = list[list[Number]]


class JordanForm:
    """``A P = P J`` with ``J`` of Jordan blocks: exact, over the fields of the eigenvalues.

    Attributes
    ----------
    P, J : list of rows
        Entries are Fraction or Algebraic.
    """

    def __init__(self, spectrum: Spectrum) -> None:
        self.spectrum = spectrum

    @cached_property
    def P(self) -> Rows:
        """The chains as columns, each from its eigenvector on."""
        columns = [v for _, chain in self.spectrum.chains for v in chain]
        return [[column[i] for column in columns] for i in range(self.spectrum.size)]

    @cached_property
    def J(self) -> Rows:
        """The Jordan blocks, with ones above the diagonal."""
        n = self.spectrum.size
        rows: Rows = [[Fraction(0)] * n for _ in range(n)]
        at = 0
        for eigenvalue, size in ((e, len(chain)) for e, chain in self.spectrum.chains):
            for k in range(size):
                rows[at + k][at + k] = eigenvalue
                if k:
                    rows[at + k - 1][at + k] = Fraction(1)
            at += size
        return rows

    def sympy(self) -> tuple[Any, Any]:
        """``P`` and ``J`` as matrices of SymPy, in the form of ``sympy.Matrix.jordan_form``."""
        import sympy

        return tuple(sympy.Matrix([[_sympy(x) for x in row] for row in m]) for m in (self.P, self.J))

    @cached_property
    def rational(self) -> tuple[list[list[Fraction]], list[list[Fraction]]]:
        """``P`` and ``J`` over the rationals, of a rational matrix.

        A factor of degree ``d`` and a chain of length ``b`` give a block of size ``d b``: the companion matrix of the factor
        in place of the eigenvalue, the identity in place of the ones. The columns are the coefficients of the vectors of the
        chain as polynomials in the eigenvalue.

        Raises
        ------
        InputError
            If the matrix has irrational entries.
        """
        if not self.spectrum.is_rational:
            raise InputError(
                "the matrix is over a number field", code="secant::python::field", help="use P and J, or sympy()"
            )
        n = self.spectrum.size
        columns: list[list[Fraction]] = []
        j = [[Fraction(0)] * n for _ in range(n)]
        for f in self.spectrum.factors:
            polynomial = [Fraction(c) for c in f["polynomial"]]
            d = len(polynomial) - 1
            for chain in f["right"]:
                for k, vector in enumerate(chain):
                    at = len(columns)
                    for power in range(d):
                        columns.append([Fraction(e[power]) if power < len(e) else Fraction(0) for e in vector])
                        j[at + d - 1][at + power] -= polynomial[power]
                        if power:
                            j[at + power - 1][at + power] += 1
                        if k:
                            j[at - d + power][at + power] += 1
        return [[column[i] for column in columns] for i in range(n)], j

    def flint(self) -> tuple[Any, Any]:
        """The matrices of :attr:`rational` as ``flint.fmpq_mat``."""
        import flint

        def entries(m: list[list[Fraction]]) -> Any:
            return flint.fmpq_mat([[flint.fmpq(x.numerator, x.denominator) for x in row] for row in m])

        return entries(self.rational[0]), entries(self.rational[1])

    def __iter__(self) -> Any:
        return iter((self.P, self.J))


def _is_matrix(x: Any) -> bool:
    if hasattr(x, "ndim") or hasattr(x, "tolist"):
        return True
    return isinstance(x, Sequence) and not isinstance(x, (str, bytes)) and not _nested(x)


def _nested(x: Sequence[Any]) -> bool:
    """Whether it is a list of matrices."""
    return bool(x) and isinstance(x[0], (list, tuple)) and bool(x[0]) and isinstance(x[0][0], (list, tuple))


def spectra(x: Any, *, exact: Exact | None = None, convention: Convention | None = None) -> list[Spectrum]:
    """The spectra of a matrix, or of the operators of a case that map a state into itself.

    Parameters
    ----------
    x : matrix or case
        As for :func:`spectrum`, or as for :func:`secant.certify`.
    exact : {"decimal", "binary"}, optional
        How floats are made exact; without it they are refused.
    convention : {"columns", "rows"}, optional
        For lists of matrices.

    Returns
    -------
    list of Spectrum
    """
    if _is_matrix(x):
        rows = matrix(x, exact)
        texts = [[entry_text(c, f"entry ({i}, {j})") for j, c in enumerate(row)] for i, row in enumerate(rows)]
        name, text, case = "matrix", "[" + ",".join("[" + ",".join(row) + "]" for row in texts) + "]", False
    else:
        from ._answers import text_of

        given = source(x, exact=exact, convention=convention)
        name, text, case = given.name, text_of(given), given.path is None or given.path.endswith(".toml")
    data, certificate = _secant.spectra(name, text, case)
    whole = Certificate._of(certificate)
    return [Spectrum(s["name"], s["spectrum"], whole) for s in json.loads(data)]


def spectrum(x: Any, *, exact: Exact | None = None) -> Spectrum:
    """The exact spectrum of a square matrix.

    Parameters
    ----------
    x : list of rows, 2-d NumPy array, SymPy or python-flint matrix, or path
        A matrix with exact real entries: int, Fraction, strings such as ``"3/4"`` and ``"(1+sqrt(5))/4"``, SymPy numbers; a
        file with a matrix; or a case with one operator.
    exact : {"decimal", "binary"}, optional
        How floats are made exact; without it they are refused.

    Returns
    -------
    Spectrum

    Raises
    ------
    InputError
        For everything that is wrong with the matrix, with the entry that is meant.

    Examples
    --------
    >>> import secant
    >>> secant.spectrum([["1/2", 1], [0, "1/2"]]).blocks
    ((Fraction(1, 2), 2),)
    """
    found = spectra(x, exact=exact)
    if len(found) != 1:
        raise InputError(
            f"the case has {len(found)} operators that map a state into itself",
            code="secant::python::spectra",
            help="secant.spectra(x) gives the list of their spectra",
        )
    return found[0]


def jordan_form(x: Any, *, exact: Exact | None = None) -> JordanForm:
    """The Jordan form of a square matrix, ``A P = P J``, exactly.

    Parameters
    ----------
    x, exact
        As for :func:`spectrum`.

    Returns
    -------
    JordanForm
        With ``P`` and ``J``; ``P, J = secant.jordan_form(x)`` works, too, and ``.sympy()``, ``.flint()`` and ``.rational``.

    Examples
    --------
    >>> import secant
    >>> P, J = secant.jordan_form([[3, 1], [-1, 1]])
    >>> J
    [[Fraction(2, 1), Fraction(1, 1)], [Fraction(0, 1), Fraction(2, 1)]]
    """
    return spectrum(x, exact=exact).jordan_form()


__all__ = ["Algebraic", "Eigenvalue", "JordanForm", "Spectrum", "jordan_form", "spectra", "spectrum"]
