"""Results: what was proved, refuted or left open, with its evidence."""

from __future__ import annotations

import enum
import html
import json
import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from pathlib import Path
from typing import Any

from . import _secant
from ._errors import CertificateError, InputError
from ._numbers import Algebraic, decimal_interval, value

Number = Fraction | Algebraic


class Verdict(str, enum.Enum):
    """The three answers."""

    PROVED = "proved"
    REFUTED = "refuted"
    UNDETERMINED = "undetermined"

    def __str__(self) -> str:
        return self.value

    def __bool__(self) -> bool:
        raise TypeError('a verdict is no truth value: compare it, as in verdict == "proved"')


@dataclass(frozen=True)
class Claim:
    """Something that is claimed.

    Attributes
    ----------
    kind : str
        A stable word, such as ``"dense-joints"`` (docs/json.md).
    text : str
        The claim in words.
    verdict : Verdict
        Whether it holds.
    theorem : str or None
        The statement that it is an instance of (``secant explain``).
    address, reason : str or None
        The address that it is about; why it is not proved.
    """

    kind: str
    text: str
    verdict: Verdict
    theorem: str | None
    address: str | None
    reason: str | None


@dataclass(frozen=True)
class Certificate:
    """A certificate with the text of the case that it is about.

    Attributes
    ----------
    case : str
        The text that a checker reads: the case, or its expanded form.
    text : str
        The certificate (docs/certificate.md).
    digest, case_digest : str
        Their SHA-256 digests.
    checked : bool
        Whether the independent checker accepted it when it was made.
    """

    case: str
    text: str
    digest: str
    case_digest: str
    checked: bool

    @classmethod
    def _of(cls, data: str | None) -> Certificate | None:
        return None if data is None else cls(**json.loads(data))

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the certificate to `path`, and the case that it is about beside it (``.case.toml``)."""
        target = Path(path)
        target.with_suffix(".case.toml").write_text(self.case, encoding="utf-8")
        target.write_text(self.text, encoding="utf-8")

    def check(self) -> Checked:
        """Has it proved again by the independent checker."""
        return Checked._of(_secant.check(self.case, self.text))


@dataclass(frozen=True)
class Checked:
    """What the independent checker says.

    Attributes
    ----------
    accepted : bool
        Whether the certificate proves what it says.
    verdict : Verdict or None
        The verdict that it proves; None where it is rejected.
    claims, points : tuple of str
        What was proved or refuted, in the words of the checker, and what that rests on.
    reason : str or None
        Why it is rejected: the rule, the place and the premise.
    """

    accepted: bool
    case: str | None
    verdict: Verdict | None
    claims: tuple[str, ...]
    points: tuple[str, ...]
    reason: str | None

    def __bool__(self) -> bool:
        return self.accepted

    @classmethod
    def _of(cls, data: str) -> Checked:
        d = json.loads(data)
        if d["accepted"]:
            return cls(True, d["case"], Verdict(d["verdict"]), tuple(d["claims"]), tuple(d["points"]), None)
        word = "unreadable" if d["unreadable"] else "rejected"
        return cls(False, None, None, (), (), f"{word}: {d['rule']}, {d['place'] or '-'}, {d['why']}")


class Direction(Sequence[Number]):
    """A direction with exact coordinates; it counts up to a factor (of a ray: a positive one)."""

    def __init__(self, data: dict[str, Any]) -> None:
        self._data = data

    @cached_property
    def _numbers(self) -> tuple[Number, ...]:
        root = self._data["lambda"]
        if root is None:
            return tuple(_number(x) for x in self._data["exact"])
        return tuple(value(root["coefficients"], root["index"], e) for e in self._data["coordinates"])

    def __len__(self) -> int:
        return len(self._data["exact"])

    def __getitem__(self, index: Any) -> Any:
        return self._numbers[index]

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> Any:
        import numpy as np

        texts = any(isinstance(x, str) for x in self._numbers)
        numbers = self._data["decimal"] if texts else self._numbers
        return np.array([float(x) for x in numbers], dtype=dtype or float)

    def sympy(self) -> Any:
        """The direction as a column of SymPy."""
        import sympy

        return sympy.Matrix([_sympy(x) for x in self._numbers])

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Sequence) and self._numbers == tuple(other)

    def __hash__(self) -> int:
        return hash(self._numbers)

    def __repr__(self) -> str:
        return "(" + ", ".join(self._data["exact"]) + ")"


def _sympy(x: Number) -> Any:
    import sympy

    return sympy.Rational(x.numerator, x.denominator) if isinstance(x, Fraction) else x.sympy()


def _root(data: dict[str, Any] | None) -> Number | None:
    if data is None:
        return None
    return value(data["coefficients"], data["index"], ("0", "1"))


def _direction(data: dict[str, Any] | None) -> Direction | None:
    return None if data is None else Direction(data)


def _number(text: str) -> Any:
    """A rational number; of a case over a number field the text of the element, such as ``1/2-1/2*sqrt(3)``."""
    try:
        return Fraction(text)
    except ValueError:
        return text


def _vector(data: list[str] | None) -> tuple[Any, ...] | None:
    return None if data is None else tuple(_number(x) for x in data)


@dataclass(frozen=True)
class Point:
    """A point that was examined.

    Attributes
    ----------
    address : str
        The address of its first branch, such as ``"0(1)"``; `addresses` has those of all branches.
    verdict : Verdict
        Whether there is a tangent line (of a surface: a tangent plane).
    kind : str
        ``"regular"``, ``"cusp"``, ``"corner"``, ``"half-tangent"``, … (docs/json.md).
    position : tuple of Fraction
        Barycentric coordinates; where they are irrational, in a case over a number field, texts such as ``1/2-1/2*sqrt(3)``.
    image : tuple of Fraction or None
        The point under the control points.
    tangent : Direction or None
        The direction of the tangent line, where there is one and it is known.
    left, right : tuple of Direction
        The rays of the two half-tangents.
    plane : tuple of Direction
        Vectors that span the tangent plane at a point of a surface.
    eigenvalue : Fraction or Algebraic or None
        The dominant eigenvalue.
    theorem, reason : str or None
        The statement that was applied; why the verdict is not proved.
    data : dict
        All fields of docs/json.md.
    """

    address: str
    addresses: tuple[str, ...]
    verdict: Verdict
    kind: str
    position: tuple[Any, ...]
    image: tuple[Any, ...] | None
    tangent: Direction | None
    left: tuple[Direction, ...]
    right: tuple[Direction, ...]
    plane: tuple[Direction, ...]
    eigenvalue: Number | None
    theorem: str | None
    reason: str | None
    data: dict[str, Any]

    @classmethod
    def _of(cls, p: dict[str, Any]) -> Point:
        rays = p.get("rays") or {"left": [], "right": []}
        return cls(
            address=p["address"],
            addresses=tuple(p["addresses"]),
            verdict=Verdict(p["verdict"]),
            kind=p["kind"],
            position=_vector(p["position"]) or (),
            image=_vector(p["image"]),
            tangent=_direction(p.get("tangent")),
            left=tuple(map(Direction, rays["left"])),
            right=tuple(map(Direction, rays["right"])),
            plane=tuple(map(Direction, p.get("plane") or ())),
            eigenvalue=_root(p.get("eigenvalue")),
            theorem=p.get("theorem"),
            reason=p.get("reason"),
            data=p,
        )

    def __repr__(self) -> str:
        tangent = f", tangent {self.tangent!r}" if self.tangent is not None else ""
        return f"<Point {self.address}: {self.verdict}, {self.kind}{tangent}>"


_FORMATS = {".html": "html", ".htm": "html", ".tex": "latex", ".md": "markdown"}


def write_report(make: Callable[[str], str], path: str | os.PathLike[str] | None, format: str) -> str:
    """A report in the format that the ending of `path` says, written there; or as text."""
    if path is not None:
        ending = Path(path).suffix.lower()
        if ending not in _FORMATS:
            raise InputError(
                f"no format is known for {os.fspath(path)}", code="secant::usage::report", help=".html, .tex, .md"
            )
        format = _FORMATS[ending]
    elif format not in _FORMATS.values():
        raise InputError(f"no format {format!r}", code="secant::usage::report", help="html, latex or markdown")
    text = make(format)
    if path is not None:
        Path(path).write_text(text, encoding="utf-8")
    return text


class Found:
    """What all results share: data that travels, and findings that are made again from it."""

    _data: dict[str, Any]
    _findings: Any

    def __getstate__(self) -> dict[str, Any]:
        return {key: kept for key, kept in vars(self).items() if key.startswith("_")} | {"_findings": None}

    def to_dict(self) -> dict[str, Any]:
        """What the program prints with ``--json`` (docs/json.md)."""
        copy: dict[str, Any] = json.loads(json.dumps(self._data))
        return copy

    @property
    def svg(self) -> str:
        """The picture."""
        raise NotImplementedError

    def _picture(self, width: int) -> str:
        """The picture for a notebook; empty where there is none."""
        try:
            return f"<div style='max-width:{width}em'>{self.svg}</div>"
        except InputError:
            return ""


class Judged(Found):
    """Results with one verdict, of some claims."""

    @property
    def name(self) -> str:
        """The name."""
        raise NotImplementedError

    @property
    def verdict(self) -> Verdict:
        """The verdict on all claims together."""
        raise NotImplementedError

    @property
    def claims(self) -> tuple[Claim, ...]:
        """Everything that is claimed."""
        raise NotImplementedError

    @property
    def proved(self) -> bool:
        """Whether every claim is proved."""
        return self.verdict is Verdict.PROVED

    def __bool__(self) -> bool:
        raise TypeError("a result is no truth value: look at .verdict, or at .proved")

    def plot(self, ax: Any = None) -> Any:
        """Draws the picture of :attr:`svg` into Matplotlib axes, in the coordinates of the picture.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            The axes; those of a new figure where none are given.

        Returns
        -------
        matplotlib.axes.Axes
        """
        from ._plot import draw

        return draw(self.svg, f"{self.name}: {self.verdict}", ax)

    def _rows(self) -> str:
        """The claims as rows of a table for a notebook."""
        return "".join(
            f"<tr><td><b>{c.verdict}</b></td><td style='text-align:left'>{html.escape(c.text)}"
            + (f" — {html.escape(c.reason)}" if c.reason else "")
            + "</td></tr>"
            for c in self.claims
        )


class Certified(Judged):
    """What was found about a case: the verdict, the claims, the points, and their evidence.

    It can be pickled: what travels is the data and the text of the case, from which reports and pictures are made again.
    """

    _findings: _secant.Findings | None

    def __init__(
        self,
        data: dict[str, Any],
        asked: dict[str, Any],
        certificate: Certificate | None,
        findings: _secant.Findings | None = None,
    ) -> None:
        self._data, self._asked, self._certificate, self._findings = data, asked, certificate, findings

    @property
    def name(self) -> str:
        """The name of the case."""
        return str(self._data["case"])

    @property
    def title(self) -> str:
        """One line for people."""
        return str(self._data["title"])

    @property
    def verdict(self) -> Verdict:
        """The verdict on all claims together."""
        return Verdict(self._data["verdict"])

    @cached_property
    def claims(self) -> tuple[Claim, ...]:
        """Everything that is claimed."""
        return tuple(
            Claim(c["kind"], c["claim"], Verdict(c["verdict"]), c.get("theorem"), c.get("address"), c["reason"])
            for c in self._data["claims"]
        )

    @cached_property
    def points(self) -> tuple[Point, ...]:
        """The points that were examined; none for the vertices of a mesh."""
        return tuple(Point._of(p) for p in self._data.get("points", ()))

    @property
    def every_point(self) -> dict[str, Any] | None:
        """Of a curve, whether it is G¹ at every point (docs/json.md)."""
        return self._data.get("every_point")

    @property
    def valences(self) -> tuple[dict[str, Any], ...]:
        """At the vertices of a mesh: what holds at each valence (docs/json.md)."""
        return tuple(self._data.get("valences", ()))

    @property
    def checked(self) -> bool:
        """Whether the independent checker accepted a certificate of this verdict."""
        return bool(self._data["certificate"]["checked"])

    @property
    def certificate(self) -> Certificate:
        """The certificate.

        Raises
        ------
        CertificateError
            Where there is none: nothing is decided, or the format has no rule for some evidence.
        """
        if self._certificate is None:
            why = self._data["certificate"]["why"] or "nothing is decided"
            raise CertificateError(why, code="secant::certificate::none", help="see docs/certificate.md, section 13")
        return self._certificate

    @property
    def case(self) -> str:
        """The text of the case."""
        return str(self._asked["text"])

    def _native(self) -> _secant.Findings:
        if self._findings is None:
            self._findings = _secant.certify({**self._asked, "check": False})[0]
        return self._findings

    def report(self, path: str | os.PathLike[str] | None = None, *, level: str = "proof", format: str = "html") -> str:
        """The proof as text, written to `path` where one is given.

        Parameters
        ----------
        path : path-like, optional
            A file; its ending says the format: ``.html``, ``.tex`` or ``.md``.
        level : {"summary", "proof", "full"}
            The first page, the whole proof, or the whole proof with nothing folded.
        format : {"html", "latex", "markdown"}
            The format where no file is given.
        """
        return write_report(lambda format: self._native().report(format, level), path, format)

    @property
    def svg(self) -> str:
        """The picture: the shape with its tangents, or the characteristic maps of vertices."""
        return self._native().svg(False)

    @property
    def png(self) -> bytes:
        """The picture of :attr:`svg` as PNG, of shapes."""
        return self._native().png()

    @property
    def cones(self) -> str:
        """The picture of the cones of Theorem 6 along a curve."""
        return self._native().svg(True)

    def __str__(self) -> str:
        return self._native().summary(False)

    def __repr__(self) -> str:
        checked = ", proved again by the checker" if self.checked else ""
        return f"<secant: {self.name} {self.verdict}{checked}>"

    def _repr_html_(self) -> str:
        return f"<p><b>{html.escape(self.name)}</b>: {self.verdict}</p><table>{self._rows()}</table>{self._picture(32)}"


__all__ = [
    "Certificate",
    "Certified",
    "Checked",
    "Claim",
    "Direction",
    "Found",
    "Judged",
    "Number",
    "Point",
    "Verdict",
    "decimal_interval",
    "write_report",
]
