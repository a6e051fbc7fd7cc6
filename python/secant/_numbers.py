"""Exact numbers: what is read as one, and algebraic numbers as results."""

from __future__ import annotations

import math
import numbers
import re
from collections.abc import Sequence
from decimal import Decimal
from fractions import Fraction
from typing import Any, Literal

from . import _secant
from ._errors import InputError

Exact = Literal["decimal", "binary"]
"""How floats are made exact: as the shortest decimal that they print, or as the dyadic fraction that they are."""

_HELP = (
    'write exact="decimal" (0.1 is 1/10) or exact="binary" (0.1 is 3602879701896397/36028797018963968), '
    'or give int, Fraction or strings such as "1/10"'
)


def _refuse(message: str, help: str) -> InputError:
    return InputError(message, code="secant::python::number", help=help)


def _of_float(x: Any, exact: Exact | None, where: str) -> Fraction:
    if not math.isfinite(x):
        raise _refuse(f"{where} is {x}, which is no number", "every entry is a finite exact number")
    if exact is None:
        raise _refuse(f"{where} is the float {x}: secant does not guess which exact number is meant", _HELP)
    if exact == "decimal":
        return Fraction(str(x))
    if exact == "binary":
        return Fraction(*x.as_integer_ratio())
    raise _refuse(f"exact is {exact!r}", _HELP)


def _of_sympy(x: Any, exact: Exact | None, where: str) -> Fraction | str:
    if not hasattr(x, "is_number"):
        raise _refuse(f"{where} is of type {type(x).__name__}, which is no number", "entries are exact numbers")
    if x.is_Rational:
        return Fraction(int(x.p), int(x.q))
    if x.is_Float:
        return _of_float(float(x), exact, where)
    if not x.is_number or x.is_real is not True:
        raise _refuse(f"{where} is {x}, which is no real number", "substitute numbers for symbols; entries are real")
    if x.atoms(*_floats(x)):
        raise _refuse(f"{where} is {x}, which has floats in it", "use sympy.nsimplify, or sympy.Rational")
    if any(type(part).__name__ == "ComplexRootOf" for part in x.args) or type(x).__name__ == "ComplexRootOf":
        return _of_root(x, where)
    return str(x).replace("**", "^")


def _floats(x: Any) -> tuple[Any, ...]:
    import sympy

    return (sympy.Float,)


def _of_root(x: Any, where: str) -> str:
    import sympy

    if not isinstance(x, sympy.CRootOf):
        raise _refuse(f"{where} is {x}, an expression in roots", "write the entry as one root, or in radicals")
    interval = x._get_interval()
    low, high = sympy.Rational(interval.a), sympy.Rational(interval.b)
    polynomial = str(x.expr).replace("**", "^").replace(str(x.poly.gen), "x").replace(" ", "")
    return f"root({polynomial}, {low}, {high})"


def number(x: Any, exact: Exact | None = None, where: str = "the number") -> Fraction | str:
    """An exact number: a fraction, or the text of one (also of a radical, such as ``"sqrt(5)"``).

    Parameters
    ----------
    x : int, Fraction, Decimal, str, NumPy or SymPy number, Algebraic
        The number. A text is read by the library, which says what is wrong with it.
    exact : {"decimal", "binary"}, optional
        How floats are made exact; without it they are refused.
    where : str
        What the number is called in messages.

    Raises
    ------
    InputError
        For floats without `exact`, NaN and infinities, complex numbers, booleans, and everything else.
    """
    if isinstance(x, str):
        return x.strip()
    if isinstance(x, Fraction):
        return x
    kind = type(x)
    if isinstance(x, bool) or kind.__name__ in ("bool_", "bool"):
        raise _refuse(f"{where} is {x}, a truth value", "write 0 or 1")
    if isinstance(x, numbers.Integral):
        return Fraction(int(x))
    if isinstance(x, Algebraic):
        return x.expression
    if isinstance(x, Decimal):
        if not x.is_finite():
            raise _refuse(f"{where} is {x}, which is no number", "every entry is a finite exact number")
        return Fraction(x)
    module = kind.__module__.split(".")[0]
    if module == "sympy":
        return _of_sympy(x, exact, where)
    if module == "flint" and hasattr(x, "p") and hasattr(x, "q"):
        return Fraction(int(x.p), int(x.q))
    if module == "flint" and kind.__name__ == "fmpz":
        return Fraction(int(x))
    if isinstance(x, numbers.Rational):
        return Fraction(int(x.numerator), int(x.denominator))
    if getattr(x, "ndim", None) == 0 and hasattr(x, "item"):
        if kind.__name__ == "ndarray":
            return number(x[()], exact, where)
        if isinstance(x, numbers.Real) or hasattr(x, "as_integer_ratio"):
            return _of_float(x, exact, where)
    if isinstance(x, float):
        return _of_float(x, exact, where)
    raise _refuse(
        f"{where} is of type {kind.__module__}.{kind.__qualname__}, which is no exact real number",
        'give int, Fraction, Decimal, strings such as "3/4", SymPy or NumPy integers',
    )


def written(x: Fraction | str) -> str:
    """The text of an exact number."""
    return x if isinstance(x, str) else str(x)


_APART = re.compile(r"[0-9A-Za-z_.)] +[0-9A-Za-z_.(]")
_PLAIN = re.compile(r"[0-9A-Za-z+\-*/^().,_ ]+")


def entry_text(x: Fraction | str, where: str) -> str:
    """The text of an exact number as an entry of a literal in brackets, which it cannot leave."""
    text = written(x)
    depth = 0
    for c in text:
        depth += {"(": 1, ")": -1}.get(c, 0)
        if depth < 0 or (c == "," and depth == 0):
            break
    else:
        # Blanks separate entries in some forms of a matrix: between two words or numbers they are refused, elsewhere left out.
        if _PLAIN.fullmatch(text) and depth == 0 and not _APART.search(text):
            return text.replace(" ", "")
    raise _refuse(f"{where} is {text!r}, which is no number", 'write "3/4", "0.25" or "(1+sqrt(5))/4"')


def matrix(m: Any, exact: Exact | None = None, where: str = "the matrix") -> list[list[Fraction | str]]:
    """A matrix as rows of exact numbers.

    Parameters
    ----------
    m : list of rows, 2-d NumPy array, SymPy or python-flint matrix
        The matrix.
    exact, where
        As in :func:`number`.

    Raises
    ------
    InputError
        For wrong shapes, and as :func:`number`.
    """
    rows = _listed(m, where)
    out: list[list[Fraction | str]] = []
    for i, row in enumerate(rows):
        if not isinstance(row, (list, tuple)):
            raise InputError(
                f"{where} is no list of rows: row {i} is of type {type(row).__name__}",
                code="secant::python::shape",
                help="write [[1, 0], [0, 1]], or give an array of two dimensions",
            )
        out.append([number(x, exact, f"entry ({i}, {j}) of {where}") for j, x in enumerate(row)])
    widths = {len(row) for row in out}
    if not out or widths == {0} or len(widths) != 1:
        raise InputError(
            f"{where} has rows of {sorted(widths)} entries" if out else f"{where} has no rows",
            code="secant::python::shape",
            help="all rows have the same number of entries, one at least",
        )
    return out


def _listed(m: Any, where: str) -> Sequence[Any]:
    ndim = getattr(m, "ndim", None)
    if ndim is not None and ndim != 2:
        raise InputError(
            f"{where} is an array of {ndim} dimensions and shape {m.shape}",
            code="secant::python::shape",
            help="a matrix is an array of two dimensions",
        )
    if ndim == 2 and hasattr(m, "dtype"):
        # `tolist` would make Python floats of narrower ones, which print other decimals.
        return [list(row) for row in m]
    if hasattr(m, "tolist"):
        listed: Sequence[Any] = m.tolist()
        return listed
    if hasattr(m, "table"):
        return [list(row) for row in m.table()]
    if isinstance(m, (list, tuple)):
        return [list(row) if getattr(row, "ndim", None) == 1 else row for row in m]
    raise InputError(
        f"{where} is of type {type(m).__name__}",
        code="secant::python::shape",
        help="write a list of rows, or give a NumPy or SymPy matrix",
    )


def decimal_interval(pair: Sequence[str]) -> tuple[Fraction, Fraction]:
    """The ends of an interval that is written in decimals or fractions."""
    low, high = pair
    return Fraction(low), Fraction(high)


class Algebraic:
    """An algebraic number: a polynomial in a root of an irreducible polynomial.

    Two numbers are equal if they have the same minimal polynomial and are the same root of it.

    Examples
    --------
    >>> import secant
    >>> x = secant.spectrum([[1, 1], [1, 0]]).eigenvalues[0].value
    >>> float(x)
    1.618033988749895
    >>> x.minimal_polynomial
    (Fraction(-1, 1), Fraction(-1, 1), Fraction(1, 1))
    """

    __slots__ = ("_polynomial", "_index", "_element", "_own")

    def __init__(self, polynomial: Sequence[str], index: int, element: Sequence[str]) -> None:
        self._polynomial, self._index, self._element = tuple(polynomial), index, tuple(element)
        self._own: tuple[tuple[Fraction, ...], int] | None = None

    def _located(self) -> tuple[tuple[Fraction, ...], int]:
        if self._own is None:
            coefficients, index = _secant.locate(list(self._polynomial), self._index, list(self._element))
            self._own = tuple(Fraction(c) for c in coefficients), index
        return self._own

    @property
    def minimal_polynomial(self) -> tuple[Fraction, ...]:
        """The monic minimal polynomial over the rationals, the constant coefficient first."""
        return self._located()[0]

    @property
    def index(self) -> int:
        """Which root of its minimal polynomial it is: the real ones first, ascending."""
        return self._located()[1]

    @property
    def generator(self) -> Algebraic:
        """The root in which it is written."""
        return Algebraic(self._polynomial, self._index, ("0", "1"))

    @property
    def coefficients(self) -> tuple[Fraction, ...]:
        """Its coefficients as a polynomial in :attr:`generator`, the constant one first."""
        return tuple(Fraction(c) for c in self._element)

    def enclosure(self, bits: int = 64) -> tuple[tuple[Fraction, Fraction], tuple[Fraction, Fraction]]:
        """Exact ends of intervals around the real and the imaginary part, about ``2**-bits`` wide."""
        re, im = _secant.enclosure(list(self._polynomial), self._index, list(self._element), bits)
        return decimal_interval(re), decimal_interval(im)

    @property
    def is_real(self) -> bool:
        """Whether it is real."""
        low, high = self.enclosure()[1]
        return (low == 0 and high == 0) or self._real_by_index()

    def _real_by_index(self) -> bool:
        polynomial, index = self._located()
        low, high = Algebraic([str(c) for c in polynomial], index, ("0", "1")).enclosure()[1]
        return low == 0 and high == 0

    def _rounded(self, part: int) -> float:
        for bits in (64, 128, 256, 1024, 4096):
            low, high = self.enclosure(bits)[part]
            if float(low) == float(high):
                return float(low)
        return float((low + high) / 2)

    def __float__(self) -> float:
        if not self.is_real:
            raise TypeError(f"{self!r} is not real: use complex()")
        return self._rounded(0)

    def __complex__(self) -> complex:
        return complex(self._rounded(0), 0.0 if self.is_real else self._rounded(1))

    @property
    def expression(self) -> str:
        """The number as secant reads it: ``root(polynomial, low, high)``.

        Raises
        ------
        InputError
            If it is not real.
        """
        if not self.is_real:
            raise _refuse(f"{self!r} is not real", "entries are real numbers")
        own = Algebraic([str(c) for c in self.minimal_polynomial], self.index, ("0", "1"))
        low, high = own.enclosure(64)[0]
        return f"root({polynomial_text(self.minimal_polynomial)}, {low}, {high})"

    def sympy(self) -> Any:
        """The number in SymPy: a polynomial in a root (radicals where the root has degree 2)."""
        import sympy

        x = sympy.Symbol("x")
        rational = [sympy.Rational(f.numerator, f.denominator) for f in map(Fraction, self._polynomial)]
        root = _sympy_root(sympy.Poly(rational[::-1], x), self.generator)
        element = [sympy.Rational(c.numerator, c.denominator) for c in self.coefficients]
        return sympy.expand(sum((c * root**k for k, c in enumerate(element)), sympy.Integer(0)))

    def __eq__(self, other: object) -> bool:
        if isinstance(other, Algebraic):
            return self._located() == other._located()
        return NotImplemented

    def __hash__(self) -> int:
        return hash(self._located())

    def __repr__(self) -> str:
        re, im = self._rounded(0), self._rounded(1)
        value = f"{re:.6g}" if self.is_real else f"{re:.6g}{im:+.6g}j"
        return f"<root {self.index} of {polynomial_text(self.minimal_polynomial)}: {value}>"

    def __reduce__(self) -> tuple[Any, ...]:
        return Algebraic, (self._polynomial, self._index, self._element)


def _sympy_root(polynomial: Any, number: Algebraic) -> Any:
    """The root of SymPy that lies where the number does."""
    import sympy

    (re_low, re_high), (im_low, im_high) = number.enclosure(128)
    near = []
    for k in range(polynomial.degree()):
        value = sympy.CRootOf(polynomial, k, radicals=False).evalf(50)
        re, im = (Fraction(str(part)) for part in value.as_real_imag())
        near.append((abs(re - (re_low + re_high) / 2) + abs(im - (im_low + im_high) / 2), k))
    near.sort()
    if len(near) > 1 and near[0][0] * 1000 > near[1][0]:
        raise ArithmeticError("the roots are too close together")
    return sympy.rootof(polynomial, near[0][1], radicals=polynomial.degree() <= 2)


def polynomial_text(coefficients: Sequence[Fraction]) -> str:
    """A polynomial in ``x`` as secant reads it."""
    out = ""
    for k, c in reversed(list(enumerate(coefficients))):
        if c == 0:
            continue
        sign = "-" if c < 0 else "+" if out else ""
        size = "" if abs(c) == 1 and k > 0 else str(abs(c)) + ("*" if k else "")
        out += sign + size + ("" if k == 0 else "x" if k == 1 else f"x^{k}")
    return out or "0"


def value(polynomial: Sequence[str], index: int, element: Sequence[str]) -> Fraction | Algebraic:
    """The element at the root, as a fraction where it is one."""
    if len(element) <= 1:
        return Fraction(element[0]) if element else Fraction(0)
    if len(polynomial) == 2:
        root, power, total = -Fraction(polynomial[0]) / Fraction(polynomial[1]), Fraction(1), Fraction(0)
        for c in element:
            total, power = total + Fraction(c) * power, power * root
        return total
    return Algebraic(polynomial, index, element)
