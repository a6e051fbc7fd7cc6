"""Meshes: whether the limit surface of these very points is smooth, vertex by vertex."""

from __future__ import annotations

import html
import json
import os
from collections.abc import Mapping
from dataclasses import dataclass
from decimal import Context, Inexact
from fractions import Fraction
from functools import cached_property
from pathlib import Path
from typing import Any

from . import _secant
from ._errors import CertificateError, InputError
from ._numbers import Exact, number
from ._results import Certificate, Claim, Judged, Verdict, write_report

_ENDINGS = (".obj", ".off")
_LONGEST = 10_000


@dataclass(frozen=True)
class MeshVertex:
    """A vertex of a mesh, or the middle of a face that becomes an extraordinary vertex.

    Attributes
    ----------
    at : {"vertex", "face"}
        Which of the two it is.
    number, line : int
        Its number, or that of the face, and its line in the file, from 1.
    valence : int
        How many edges (or sides) meet there.
    verdict : Verdict
        Whether the surface is C¹ there, for these points.
    surrounded : bool
        Whether that is proved, and the surface is also immersed around it.
    reason : str
        What the verdict rests on.
    point, normal : tuple of float or None
        The limit point and the unit normal, rounded; None where they are not known.
    point_exact, normal_exact : tuple of str or None
        The same exactly (the normal up to its length), where they are written out.
    data : dict
        All fields of docs/json.md.
    """

    at: str
    number: int
    line: int
    valence: int
    verdict: Verdict
    surrounded: bool
    reason: str
    point: tuple[float, ...] | None
    normal: tuple[float, ...] | None
    point_exact: tuple[str, ...] | None
    normal_exact: tuple[str, ...] | None
    data: dict[str, Any]

    @classmethod
    def _of(cls, d: dict[str, Any]) -> MeshVertex:
        listed = {k: None if d[k] is None else tuple(d[k]) for k in ("point", "normal", "point_exact", "normal_exact")}
        return cls(
            d["at"], d["number"], d["line"], d["valence"], Verdict(d["smooth"]), d["surrounded"], d["reason"], **listed, data=d
        )

    def __repr__(self) -> str:
        return f"<{self.at} {self.number} (line {self.line}), valence {self.valence}: {self.verdict}>"


class CertifiedMesh(Judged):
    """What was found about a mesh. It can be pickled, as :class:`Certified`."""

    every_point = None
    _certificate: Certificate | None = None

    _findings: _secant.MeshFindings | None

    def __init__(
        self, data: dict[str, Any], asked: dict[str, Any], findings: _secant.MeshFindings | None = None
    ) -> None:
        self._data, self._asked, self._findings = data, asked, findings

    @property
    def name(self) -> str:
        """The name of the file."""
        return str(self._data["mesh"])

    @property
    def scheme(self) -> str:
        """The scheme."""
        return str(self._data["scheme"])

    @property
    def verdict(self) -> Verdict:
        """Whether the limit surface is a regular C¹ surface, immersed by its parametrisation."""
        return Verdict(self._data["regular"])

    @property
    def smooth(self) -> Verdict:
        """Whether it is C¹ at every vertex, for these points."""
        return Verdict(self._data["smooth"])

    @property
    def claims(self) -> tuple[Claim, ...]:
        """Both claims."""
        first = next((str(b["what"]) for b in self._data["patches"]["bad"]), None)
        return (
            Claim("vertices", "the surface is C¹ at every vertex, for these points", self.smooth, None, None, None),
            Claim("surface", "the limit surface of this mesh is a regular C¹ surface", self.verdict, None, None, first),
        )

    @cached_property
    def vertices(self) -> tuple[MeshVertex, ...]:
        """Every vertex that a face has, then the middles of faces that become extraordinary."""
        return tuple(map(MeshVertex._of, self._data["vertices"]))

    @property
    def bad(self) -> tuple[MeshVertex, ...]:
        """The vertices at which the surface is not proved to be C¹ and immersed around."""
        return tuple(v for v in self.vertices if not v.surrounded)

    @property
    def patches(self) -> dict[str, Any]:
        """How many patches were tested and proved regular, and which were not (docs/json.md)."""
        return dict(self._data["patches"])

    @property
    def closed(self) -> bool:
        """Whether the mesh has no border."""
        return bool(self._data["closed"])

    @property
    def checked(self) -> bool:
        """False: meshes have no certificates yet, so that nothing is proved twice."""
        return False

    @property
    def certificate(self) -> Certificate:
        """Meshes have none yet.

        Raises
        ------
        CertificateError
            Always.
        """
        raise CertificateError("meshes have no certificates", code="secant::certificate::none", help="see docs/certificate.md")

    def _native(self) -> _secant.MeshFindings:
        if self._findings is None:
            self._findings = _secant.mesh(self._asked)[0]
        return self._findings

    def report(self, path: str | os.PathLike[str] | None = None, *, format: str = "html") -> str:
        """The results with every limit point as text (see :meth:`Certified.report`)."""
        return write_report(self._native().report, path, format)

    @property
    def svg(self) -> str:
        """The mesh: proved vertices are green, refuted ones red, undetermined ones violet.

        Raises
        ------
        InputError
            If it has more than 20000 faces, or no extent.
        """
        svg = self._native().svg()
        if svg is None:
            raise InputError("the mesh cannot be drawn", code="secant::picture", help="it has too many faces, or no extent")
        return svg

    def ply(self, path: str | os.PathLike[str]) -> None:
        """Writes the mesh as PLY, its vertices coloured by verdict."""
        Path(path).write_text(self._native().ply(), encoding="utf-8")

    def __str__(self) -> str:
        return self._native().summary()

    def __repr__(self) -> str:
        return f"<secant: {self.name} by {self.scheme} {self.verdict}, {len(self.vertices)} vertices, {len(self.bad)} not proved>"

    def _repr_html_(self) -> str:
        bad = "".join(f"<li>{html.escape(repr(v)[1:-1])}: {html.escape(v.reason)}</li>" for v in self.bad[:20])
        claims = f"<table>{self._rows()}</table>"
        return f"<p><b>{html.escape(self.name)}</b> by {self.scheme}</p>{claims}<ul>{bad}</ul>{self._picture(32)}"


def is_mesh(x: Any) -> bool:
    """Whether it is the path of a mesh, or points with faces."""
    if isinstance(x, Mapping):
        return set(x) >= {"points", "faces"}
    return isinstance(x, (str, os.PathLike)) and os.fsdecode(os.fspath(x)).lower().endswith(_ENDINGS)


def asked_mesh(x: Any, scheme: str | None, exact: Exact | None, options: Mapping[str, Any]) -> dict[str, Any]:
    """What the extension module is asked about a mesh."""
    for option in ("at", "valences", "require"):
        if options.get(option):
            raise InputError(f"{option} does not go with a mesh", code="secant::usage", help="every vertex is looked at")
    question: dict[str, Any] = {"path": None, "text": None, "name": "mesh.obj", "scheme": scheme or ""}
    question.update(effort=options.get("effort", "normal"), cells=options.get("cells"), words=options.get("words"))
    if isinstance(x, Mapping):
        question["text"] = _written(x, exact)
    else:
        path = os.fsdecode(os.fspath(x))
        question.update(path=path, name=path.encode("utf-8", "replace").decode())
    return question


def travelling(question: dict[str, Any]) -> dict[str, Any]:
    """The same question with the text of the file in it."""
    if question["text"] is not None:
        return question
    try:
        text = Path(question["path"]).read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(
            f"{question['name']} cannot be read: {error}", code="secant::mesh::unreadable", help="give an OBJ or OFF file"
        ) from None
    return {**question, "text": text, "path": None}


def answer_mesh(question: dict[str, Any]) -> CertifiedMesh:
    """Asks, and keeps the text of the mesh."""
    findings, data = _secant.mesh(question)
    return CertifiedMesh(json.loads(data), travelling(question), findings)


def _written(mesh: Mapping[str, Any], exact: Exact | None) -> str:
    points = [[_decimal(c, exact, f"coordinate {j} of point {i}") for j, c in enumerate(p)] for i, p in enumerate(mesh["points"])]
    lines = ["v " + " ".join(p) for p in points]
    for k, face in enumerate(mesh["faces"]):
        corners = [number(c, None, f"corner {j} of face {k}") for j, c in enumerate(face)]
        if not all(isinstance(c, Fraction) and c.denominator == 1 and 0 <= c < len(points) for c in corners):
            raise InputError(
                f"face {k} is {list(face)!r}", code="secant::mesh::face", help="a face is a list of numbers of points, from 0"
            )
        lines.append("f " + " ".join(str(Fraction(c) + 1) for c in corners))
    return "\n".join(lines) + "\n"


def _decimal(x: Any, exact: Exact | None, where: str) -> str:
    """An exact decimal, which is what meshes hold."""
    q = number(x, exact, where)
    try:
        q = Fraction(q)
        context = Context(prec=_LONGEST, traps=[Inexact])
        return format(context.divide(q.numerator, q.denominator), "f")
    except (ValueError, Inexact):
        raise InputError(
            f"{where} is {q}, which is no finite decimal", code="secant::python::number", help="coordinates of a mesh are decimals"
        ) from None


__all__ = ["CertifiedMesh", "MeshVertex"]
