"""For which values of a parameter a scheme converges and is smooth, a curve has tangents, or a vertex is C¹."""

from __future__ import annotations

import html
import itertools
import json
import os
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any

from . import _secant
from ._answers import Effort, text_of
from ._cases import source
from ._errors import InputError
from ._numbers import Algebraic, Exact, number, value, written
from ._results import Certificate, Found, Number, Verdict, write_report


@dataclass(frozen=True)
class RegionPart:
    """A value of the parameter, or an open interval of values, with one answer.

    Attributes
    ----------
    low, high : Fraction or Algebraic
        The ends; the same for a single value.
    verdict : Verdict
        What holds for all of these values.
    reason : str
        What it rests on, or why it is open.
    statement : str or None
        The statement that was applied (``secant explain``).
    """

    low: Number
    high: Number
    verdict: Verdict
    reason: str
    statement: str | None

    @property
    def is_point(self) -> bool:
        """Whether it is a single value."""
        return self.low is self.high

    def __contains__(self, x: Any) -> bool:
        q = _rational(x)
        low, high = _compare(q, self.low), _compare(q, self.high)
        return low == 0 if self.is_point else low > 0 > high

    def __repr__(self) -> str:
        ends = f"{_shown(self.low)}" if self.is_point else f"({_shown(self.low)}, {_shown(self.high)})"
        return f"<{ends}: {self.verdict}>"

    @classmethod
    def _of(cls, d: dict[str, Any]) -> RegionPart:
        if "point" in d:
            low = high = _end(d["point"])
        else:
            low, high = map(_end, d.get("interval") or d["gap"])
        return cls(low, high, Verdict(d["verdict"]), d["because"], d.get("statement"))


def _end(d: Any) -> Number:
    return Fraction(d) if isinstance(d, str) else value(d["polynomial"], d["index"], ("0", "1"))


def _shown(x: Number) -> str:
    return str(x) if isinstance(x, Fraction) else f"{float(x):.9g}…"


def _rational(x: Any) -> Fraction:
    q = number(x, None, "the value")
    try:
        return Fraction(q)
    except ValueError:
        raise InputError(
            f"the value {q!r} is not rational", code="secant::python::number", help='give a Fraction, or a text such as "1/16"'
        ) from None


def _compare(x: Fraction, end: Number) -> int:
    """The sign of `x - end`, exactly: an irrational end differs from every fraction."""
    if isinstance(end, Fraction):
        return (x > end) - (x < end)
    bits = 64
    while True:
        low, high = end.enclosure(bits)[0]
        if x < low or x > high:
            return 1 if x > high else -1
        bits *= 2
        if bits > 100_000:
            raise InputError(f"{x} is too close to an end to be compared", code="secant::python::number", help="take another value")


@dataclass(frozen=True)
class RegionTable:
    """The answers to one claim.

    Attributes
    ----------
    statement : str
        What is claimed of a value.
    parts : tuple of RegionPart
        The range from below, each value in one part.
    """

    statement: str
    parts: tuple[RegionPart, ...]

    @property
    def label(self) -> str:
        """A short name of the claim."""
        return self.statement

    def at(self, x: Any) -> Verdict:
        """The answer for one rational value of the parameter.

        Raises
        ------
        InputError
            If it lies outside the range.
        """
        for part in self.parts:
            if x in part:
                return part.verdict
        raise InputError(f"{x} is outside the range", code="secant::python::number", help="ask with a larger range")

    def _where(self, verdict: Verdict) -> tuple[tuple[Number, Number], ...]:
        runs = [list(run) for found, run in itertools.groupby(self.parts, key=lambda part: part.verdict) if found is verdict]
        return tuple((run[0].low, run[-1].high) for run in runs)

    @property
    def proved(self) -> tuple[tuple[Number, Number], ...]:
        """The ends of the intervals where it holds, twice the same for a single value; whether an end belongs to it, `parts` say."""
        return self._where(Verdict.PROVED)

    @property
    def refuted(self) -> tuple[tuple[Number, Number], ...]:
        """The ends of the intervals where it fails, as of `proved`."""
        return self._where(Verdict.REFUTED)


@dataclass(frozen=True)
class RegionOrder(RegionTable):
    """The answers for one order of smoothness of a mask: 0 for convergence, k for C^k."""

    order: int

    @property
    def label(self) -> str:
        """``converges`` or ``C^k``."""
        return "converges" if self.order == 0 else f"C^{self.order}"


@dataclass(frozen=True)
class RegionClaim(RegionTable):
    """The answers to one claim about a curve: ``contraction``, ``tangent-at-ends``, ``dense-joints`` or ``g1``."""

    claim: str

    @property
    def label(self) -> str:
        """The claim."""
        return self.claim


@dataclass(frozen=True)
class RegionValence(RegionTable):
    """The answers for the vertices of one valence: whether the surface is C¹ there."""

    valence: int

    @property
    def label(self) -> str:
        """``valence n``."""
        return f"valence {self.valence}"


def _tables(data: dict[str, Any]) -> Iterator[tuple[int | str, RegionTable]]:
    """The tables, each with its key."""
    for k in ("orders", "claims", "valences"):
        for t in data.get(k, ()):
            parts = tuple(map(RegionPart._of, t["table"]))
            if k == "orders":
                yield t["order"], RegionOrder(t["statement"], parts, t["order"])
            elif k == "claims":
                yield t["claim"], RegionClaim(t["statement"], parts, t["claim"])
            else:
                yield t["valence"], RegionValence(t["statement"], parts, t["valence"])


class Regions(Found):
    """For which values of a parameter claims hold, a sequence of tables.

    Of a mask these are :class:`RegionOrder`, with the order as key (``found[1]``); of a curve :class:`RegionClaim`, with the
    claim (``found["g1"]``); of the vertices of a mesh :class:`RegionValence`, with the valence (``found[5]``).

    It can be pickled, as :class:`Certified`.
    """

    _findings: _secant.RegionFindings | None

    def __init__(
        self, data: dict[str, Any], verdict: str, asked: tuple[Any, ...], findings: _secant.RegionFindings | None = None
    ) -> None:
        self._data, self._verdict, self._asked, self._findings = data, verdict, asked, findings

    @property
    def name(self) -> str:
        """The name of the case."""
        return str(self._data["case"])

    @property
    def parameter(self) -> str:
        """The name of the parameter."""
        return str(self._data["parameter"])

    @property
    def range(self) -> tuple[Fraction, Fraction]:
        """The range that was asked about, with its ends."""
        low, high = self._data["range"]
        return Fraction(low), Fraction(high)

    @property
    def mask(self) -> tuple[str, ...] | None:
        """The coefficients of a mask, polynomials in the parameter."""
        mask = self._data.get("mask")
        return None if mask is None else tuple(mask)

    @property
    def verdict(self) -> Verdict:
        """Proved where every claim holds on the whole range, refuted where some value refutes one."""
        return Verdict(self._verdict)

    @cached_property
    def _by_key(self) -> dict[int | str, RegionTable]:
        return dict(_tables(self._data))

    @property
    def tables(self) -> tuple[RegionTable, ...]:
        """The tables."""
        return tuple(self._by_key.values())

    @property
    def orders(self) -> tuple[RegionOrder, ...]:
        """The orders of a mask, from convergence up."""
        return tuple(t for t in self.tables if isinstance(t, RegionOrder))

    def __len__(self) -> int:
        return len(self.tables)

    def __iter__(self) -> Iterator[RegionTable]:
        return iter(self.tables)

    def __getitem__(self, key: int | str) -> RegionTable:
        try:
            return self._by_key[key]
        except KeyError:
            keys = ", ".join(map(repr, self._by_key))
            raise KeyError(f"there is no table {key!r}; the tables are {keys}") from None

    def _native(self) -> _secant.RegionFindings:
        if self._findings is None:
            self._findings = _secant.region(*self._asked)[0]
        return self._findings

    @property
    def certificate(self) -> Certificate:
        """The certificate, which the independent checker accepted, and the family that it is about."""
        certificate = Certificate._of(self._native().certificate())
        assert certificate is not None
        return certificate

    @property
    def svg(self) -> str:
        """A bar for each table, coloured by verdict.

        Raises
        ------
        InputError
            Where there is nothing to draw.
        """
        svg = self._native().svg()
        if svg is None:
            raise InputError("there is nothing to draw", code="secant::region", help="the range is a single value")
        return svg

    def report(self, path: str | os.PathLike[str] | None = None, *, format: str = "html") -> str:
        """The tables with their statements as text (see :meth:`Certified.report`)."""
        return write_report(self._native().report, path, format)

    def __str__(self) -> str:
        return self._native().summary()

    def __repr__(self) -> str:
        low, high = self.range
        return f"<Regions of {self.name}: {self.parameter} from {low} to {high}: {', '.join(t.label for t in self)}>"

    def _repr_html_(self) -> str:
        rows = "".join(
            f"<tr><td>{html.escape(o.label)}</td>"
            f"<td style='text-align:left'>{html.escape(p.__repr__()[1:-1])}</td>"
            f"<td style='text-align:left'>{html.escape(p.reason)}</td></tr>"
            for o in self
            for p in o.parts
        )
        head = f"<p><b>{html.escape(self.name)}</b>, {html.escape(self.parameter)}</p>"
        return f"{head}{self._picture(40)}<table>{rows}</table>"


def _setting(name: str, x: Any, exact: Exact | None) -> str:
    if isinstance(x, str):
        return f"{name}={x}"
    if isinstance(x, (tuple, list)):
        if len(x) != 2:
            raise InputError(
                f"the range of {name} has {len(x)} ends", code="secant::usage::parameter", help='write ("-1/2", "1/2")'
            )
        return f"{name}={'..'.join(written(number(end, exact, name)) for end in x)}"
    return f"{name}={written(number(x, exact, name))}"


def _coefficient(c: Any, exact: Exact | None, where: str) -> str:
    if type(c).__module__.split(".")[0] == "sympy" and getattr(c, "free_symbols", None):
        return str(c).replace("**", "^")
    return written(number(c, exact, where))


def region(
    x: Any,
    parameters: Mapping[str, Any] | None = None,
    *,
    order: int | None = None,
    valences: str | Iterable[int] | None = None,
    width: Any = None,
    hulls: int | None = None,
    effort: Effort = "normal",
    seconds: float | None = None,
    exact: Exact | None = None,
    arity: int = 2,
    name: str = "mask",
) -> Regions:
    """For which values of a parameter claims hold: open intervals and single values, with exact ends.

    Of masks convergence and C^k; of curves of one state contraction, tangents at ends and joints, and G¹; of the vertices of
    a mesh C¹.

    Parameters
    ----------
    x : str, path, dict or list
        The name of a scheme (``"four-point"``, also with its range: ``"four-point w=-1/2..1/2"``); a case with ``[parameters]``
        and a mask, maps, operators or ``[vertex]`` (docs/case-format.md), as path, text or dict; or a mask whose coefficients are expressions in the parameters:
        texts such as ``"1/2+w"``, or of SymPy.
    parameters : mapping
        A range with its ends for the parameter that is left free, values for the others: ``{"w": ("-1/2", "1/2")}``.
    order : int, optional
        The highest order of smoothness of masks that is asked about; without it all that the sum rules allow.
    valences : str or sequence of int, optional
        The valences at vertices of a mesh, such as ``"3..12"``, in the place of those of the case.
    width : number, optional
        Gaps that are narrower are left; ``"1e-6"`` without it.
    hulls : int, optional
        How many hulls may be tried for each order.
    effort : {"quick", "normal", "hard"}
        How much work is spent: what is undetermined may be decided with more, no answer changes.
    seconds : float, optional
        Search for about this long instead; without it the answer is always the same.
    exact : {"decimal", "binary"}, optional
        How floats are made exact; without it they are refused.
    arity : int
        Of a mask that is given as a list.
    name : str
        What a mask that is given as a list is called.

    Returns
    -------
    Regions

    Raises
    ------
    InputError
        If it is no family with one parameter that is left free. (In the plane of two, `secant region CASE` answers.)

    Examples
    --------
    >>> import secant
    >>> found = secant.region("ternary-three-point", {"b": ("0", "1/2")}, order=1)
    >>> found[1].at("1/4").value
    'proved'
    """
    if seconds is not None and not 0 < seconds < float("inf"):
        raise InputError(f"seconds={seconds} is no positive number", code="secant::region", help="as in seconds=60")
    set = [_setting(key, v, exact) for key, v in (parameters or {}).items()]
    at = valences if valences is None or isinstance(valences, str) else ",".join(str(int(n)) for n in valences)
    if width is not None:
        width = written(number(width, exact, "the width"))
    if isinstance(x, str) and "\n" not in x and not os.path.isfile(x):
        scheme, *ranges = x.split() or [x]
        asked: tuple[Any, ...] = (scheme, None, [*ranges, *set], order, at, width, hulls, effort, seconds)
    elif isinstance(x, (str, os.PathLike, Mapping)):
        given = source(x, exact=exact, name=name)
        asked = (given.name, text_of(given), set, order, at, width, hulls, effort, seconds)
    else:
        mask = [_coefficient(c, exact, f"coefficient {k} of the mask") for k, c in enumerate(x)]
        limits = dict(text.split("=", 1) for text in set)
        case = {"name": name, "parameters": limits, "scheme": {"mask": mask, "arity": arity}}
        asked = (name, text_of(source(case)), [], order, at, width, hulls, effort, seconds)
    findings, data, verdict = _secant.region(*asked)
    return Regions(json.loads(data), verdict, asked, findings)


__all__ = ["RegionClaim", "RegionOrder", "RegionPart", "RegionTable", "RegionValence", "Regions", "region"]
