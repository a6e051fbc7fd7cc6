"""The questions: certify, jsr, regularity, solve, check."""

from __future__ import annotations

import html
import json
import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Literal, overload

from . import _secant
from ._cases import Convention, Source, is_named, is_wavelet, source, wavelet_filter
from ._errors import InputError
from ._meshes import CertifiedMesh, answer_mesh, asked_mesh, is_mesh
from ._numbers import Exact, decimal_interval, matrix, number, written
from ._results import Certificate, Certified, Checked

Effort = Literal["quick", "normal", "hard"]


def text_of(given: Source) -> str:
    """The text of a case that is given as one, or as a file."""
    if given.text is not None:
        return given.text
    if given.path is not None:
        return _secant.case_text(given.path)
    raise InputError(
        f"{given.name!r} is no file", code="secant::python::case", help="give a path, the text of a case, or a dict"
    )


def asked(given: Source, options: Mapping[str, Any]) -> dict[str, Any]:
    """What the extension module is asked; `options` are those of :func:`certify`."""
    at = options.get("at", ())
    valences = options.get("valences")
    if isinstance(valences, range):
        valences = ",".join(map(str, valences))
    return {
        "name": given.name,
        "text": given.text,
        "path": given.path,
        "addresses": [at] if isinstance(at, str) else list(at),
        "valences": None if valences is None else str(valences),
        "check": options.get("check", True),
        "effort": options.get("effort", "normal"),
        "cells": options.get("cells"),
        "words": options.get("words"),
        "require": options.get("require"),
    }


def answer(question: dict[str, Any]) -> Certified:
    """Asks, and keeps the text of the case, from which the same question can be asked elsewhere."""
    findings, data, text, certificate = _secant.certify(question)
    kept = {**question, "text": text, "path": None}
    return Certified(json.loads(data), kept, Certificate._of(certificate), findings)


@overload
def certify(x: Any, *, scheme: str, exact: Exact | None = None, effort: Effort = "normal") -> CertifiedMesh: ...


@overload
def certify(
    x: Any,
    *,
    at: str | Iterable[str] = (),
    valences: int | str | range | None = None,
    exact: Exact | None = None,
    convention: Convention | None = None,
    arity: int = 2,
    check: bool = True,
    effort: Effort = "normal",
    cells: int | None = None,
    words: int | None = None,
    require: str | None = None,
    name: str = "case",
) -> Certified: ...


def certify(
    x: Any,
    *,
    scheme: str | None = None,
    at: str | Iterable[str] = (),
    valences: int | str | range | None = None,
    exact: Exact | None = None,
    convention: Convention | None = None,
    arity: int = 2,
    check: bool = True,
    effort: Effort = "normal",
    cells: int | None = None,
    words: int | None = None,
    require: str | None = None,
    name: str = "case",
) -> Certified | CertifiedMesh:
    """Proves or refutes tangents of a shape at its end points, its joints and a dense set, or C¹ at vertices of a mesh.

    Parameters
    ----------
    x : path, str, dict, list, array or pywt.Wavelet
        The case: a path; the text of a case (docs/case-format.md), which has more than one line; the name of a scheme with
        parameters (``"four-point w=1/16"``), a mask (``"1/4,3/4,3/4,1/4"``) or a symbol (``"(1+z)^3/4"``); a mapping with the
        keys of a case; a list or array of the numbers of a mask; a list of matrices, with `convention`. With `scheme` a mesh:
        the path of an OBJ or OFF file, or ``{"points": …, "faces": …}`` with faces as numbers of points from 0.
    scheme : {"catmull-clark", "loop", "loop-warren"}, optional
        For a mesh: the scheme of its limit surface.
    at : str or list of str, optional
        Further points to be examined: letters, and the repeated ones in brackets, as in ``"0(1)"``.
    valences : int, str or range, optional
        For a rule on meshes: ``5``, ``"3..32"``, ``"all"``.
    exact : {"decimal", "binary"}, optional
        How floats are made exact; without it they are refused.
    convention : {"columns", "rows"}, optional
        For lists of matrices: operators on columns of barycentric coordinates, or subdivision matrices on rows.
    arity : int
        Of masks that are given as lists.
    check : bool
        Whether the independent checker proves the verdict again.
    effort : {"quick", "normal", "hard"}
        How long the search goes on: what is undetermined may be decided with more, no answer changes.
    cells, words : int, optional
        Two limits of the search by themselves.
    require : str, optional
        What decides the verdict, as ``secant certify --require`` says it: ``"g1"``, ``"ends,joints,c2"``, …
    name : str
        The name of a case that has none.

    Returns
    -------
    Certified or CertifiedMesh

    Raises
    ------
    InputError
        If the case is wrong: with file, line and a way to mend it.
    InternalError
        If secant fails; there is no verdict then.

    Examples
    --------
    >>> import secant
    >>> result = secant.certify(["1/4", "3/4", "3/4", "1/4"])
    >>> result.verdict
    <Verdict.PROVED: 'proved'>
    >>> result.points[0].address
    '(0)'
    """
    options: dict[str, Any] = {"at": at, "valences": valences, "check": check, "effort": effort, "cells": cells, "words": words}
    options["require"] = require
    if scheme is not None or is_mesh(x):
        if not is_mesh(x):
            raise InputError("scheme goes with a mesh", code="secant::usage::scheme", help="give an .obj or .off file")
        return answer_mesh(asked_mesh(x, scheme, exact, options))
    given = source(x, exact=exact, convention=convention, arity=arity, name=name)
    return answer(asked(given, options))


@dataclass(frozen=True)
class JointRadius:
    """Bounds of a joint spectral radius.

    Attributes
    ----------
    lower, upper : Fraction or None
        Bounds, rounded outwards; None where there is none.
    exact : bool
        Whether the radius is attained by a word: the root of `polynomial` of largest modulus to the power ``1/len(word)``.
    rational : Fraction or None
        The radius, where it is rational.
    word : tuple of int or None
        The word of the lower bound.
    growth : str
        ``"bounded"``, ``"marginal"`` or ``"undecided"``: of the products divided by the powers of the radius.
    certificate : Certificate or None
        The certificate of the bounds.
    data : dict
        What ``secant jsr --json`` prints.
    """

    lower: Fraction | None
    upper: Fraction | None
    exact: bool
    rational: Fraction | None
    word: tuple[int, ...] | None
    growth: str
    certificate: Certificate | None
    data: dict[str, Any]

    def __repr__(self) -> str:
        bounds = ", ".join("?" if x is None else f"{float(x):.15g}" for x in (self.lower, self.upper))
        return f"<JointRadius [{bounds}]{', exact' if self.exact else ''}>"

    def _repr_html_(self) -> str:
        word = "" if self.word is None else f", word {''.join(map(str, self.word)) if max(self.word) < 10 else self.word}"
        return f"<p>{html.escape(repr(self)[1:-1])}{word}, growth {html.escape(self.growth)}</p>"


def jsr(
    matrices: Any,
    *,
    exact: Exact | None = None,
    seconds: float | None = None,
    longest: int | None = None,
    width: float | None = None,
    name: str = "matrices",
) -> JointRadius:
    """Bounds the joint spectral radius of matrices.

    Parameters
    ----------
    matrices : list of matrices, 3-d array, path or str
        The matrices, or a file or text of them (docs/radius.md).
    exact : {"decimal", "binary"}, optional
        How floats are made exact; without it they are refused.
    seconds : float, optional
        Search for about this long; without it a fixed amount of work is spent, so that the answer is always the same.
    longest : int, optional
        The longest word of the search, from 1 to 200.
    width : float, optional
        Stop when the bounds are this close, relatively.
    name : str
        What the certificate calls them.

    Returns
    -------
    JointRadius

    Examples
    --------
    >>> import secant
    >>> secant.jsr([[[1, 1], [0, 1]], [[1, 0], [1, 1]]]).exact
    True
    """
    if longest is not None and not 1 <= longest <= 200:
        raise InputError(f"longest={longest} is not from 1 to 200", code="secant::jsr")
    if width is not None and not 0 <= width < 1:
        raise InputError(f"width={width} is not from 0 to 1", code="secant::jsr")
    if seconds is not None and not 0 < seconds < float("inf"):
        raise InputError(f"seconds={seconds} is no positive number", code="secant::jsr")
    if isinstance(matrices, (str, os.PathLike)):
        given = source(matrices, name=name)
        label, text = given.name, text_of(given)
    else:
        if isinstance(matrices, Mapping) or not hasattr(matrices, "__iter__"):
            raise InputError("matrices are a list", code="secant::python::shape", help="give [A, B], or a file")
        rows = [matrix(m, exact, f"matrix {k}") for k, m in enumerate(matrices)]
        listed = json.dumps([[[written(c) for c in row] for row in m] for m in rows])
        label, text = name, f"name = {json.dumps(name)}\nmatrices = {listed}\n"
    data, certificate = _secant.jsr(label, text, seconds, longest, width)
    d = json.loads(data)
    bound = {k: None if d[k] is None else Fraction(d[k]) for k in ("lower", "upper", "rational")}
    word = None if d["word"] is None else tuple(d["word"]["letters"])
    return JointRadius(
        **bound, exact=d["exact"], word=word, growth=d["growth"], certificate=Certificate._of(certificate), data=d
    )


@dataclass(frozen=True)
class Regularity:
    """The smoothness of a mask, a filter or a curve.

    Attributes
    ----------
    kind : str
        ``"mask"``, ``"filter"`` or ``"curve"``.
    exponent : pair of Fraction or None
        Bounds of the Hölder exponent, rounded outwards.
    smoothness : int or None
        The curve is proved to be C^k for this k; None where that is not decided. Of filters that are known by enclosures, see
        ``data``.
    converges : bool or None
        Of masks: whether the scheme converges.
    decided : bool
        Whether anything is decided.
    data : dict
        All fields of ``secant regularity --json`` (docs/json.md).
    """

    kind: str
    exponent: tuple[Fraction, Fraction] | None
    smoothness: int | None
    converges: bool | None
    decided: bool
    data: dict[str, Any]

    def __str__(self) -> str:
        return str(self.data["summary"])

    def __repr__(self) -> str:
        shown = "?" if self.exponent is None else f"[{float(self.exponent[0]):.12g}, {float(self.exponent[1]):.12g}]"
        return f"<Regularity of a {self.kind}: exponent {shown}>"

    def _repr_html_(self) -> str:
        return f"<pre>{html.escape(str(self))}</pre>"


def regularity(
    x: Any, *, exact: Exact | None = None, convention: Convention | None = None, arity: int = 2
) -> Regularity:
    """The smoothness of a subdivision scheme, a scaling function or a curve, from a joint spectral radius.

    Parameters
    ----------
    x : str, path, dict, list, array or pywt.Wavelet
        A mask as text or list, a symbol, the name of a scheme with parameters or of a wavelet (``"db3"``), or a case as for
        :func:`certify`. An object of PyWavelets stands for the scaling function of the reconstruction, with its exact filter
        where secant knows it; any other filter is a list of floats, which needs `exact`.
    exact : {"decimal", "binary"}, optional
        How floats are made exact; without it they are refused.
    convention : {"columns", "rows"}, optional
        For lists of matrices.
    arity : int
        Of masks and symbols.

    Returns
    -------
    Regularity

    Examples
    --------
    >>> import secant
    >>> secant.regularity(["1/4", "3/4", "3/4", "1/4"]).exponent
    (Fraction(2, 1), Fraction(2, 1))
    """
    name, text, parameters = _regular(x, exact, convention, arity)
    data, decided = _secant.regularity(name, text, parameters, arity)
    d = json.loads(data)
    exponent = decimal_interval(d["exponent"]) if d.get("exponent") else None
    return Regularity(d["kind"], exponent, d.get("smoothness"), d.get("converges"), decided, d)


def _regular(
    x: Any, exact: Exact | None, convention: Convention | None, arity: int
) -> tuple[str, str | None, list[str]]:
    """What the extension module is asked: a name, the text of a case, and parameters."""
    if isinstance(x, str) and "\n" not in x:
        words = x.split()
        if words and all("=" in w for w in words[1:]) and not os.path.exists(x):
            return words[0], None, words[1:]
        return x, None, []
    if is_wavelet(x):
        if is_named(x) and (_secant.wavelet_mask(x.name) or x.name.startswith("db")):
            return x.name, None, []
        # In the decimals that are printed, a filter with irrational sum is understood as one that is known so closely.
        floats = wavelet_filter(x, exact)
        decimals = [f"{c:.17f}" for c in x.rec_lo] if exact == "decimal" else floats
        return ", ".join(decimals), None, []
    if not isinstance(x, (Mapping, str, os.PathLike)) and _flat(x):
        mask = [written(number(c, exact, f"coefficient {k} of the mask")) for k, c in enumerate(x)]
        return ", ".join(mask), None, []
    given = source(x, exact=exact, convention=convention, arity=arity)
    return given.name, text_of(given), []


def _flat(x: Any) -> bool:
    if hasattr(x, "ndim"):
        return bool(x.ndim == 1)
    return isinstance(x, (list, tuple)) and not any(isinstance(c, (list, tuple)) or hasattr(c, "tolist") for c in x[:1])


@dataclass(frozen=True)
class Solution:
    """What the identities of a case say about its unknown entries.

    Attributes
    ----------
    solutions : {"one", "family", "none"}
        How many solutions there are.
    operators : dict
        The solved operators by name, as rows of texts: numbers, or affine expressions in the parameters.
    parameters : tuple of str
        The free parameters of a family.
    conflict : tuple of str
        Identities that contradict each other, where there is no solution.
    case : str or None
        The case with the solution (of a family, the member that was asked for), to be certified.
    certificate : Certificate or None
        The certificate of the solutions.
    data : dict
        What ``secant solve --json`` prints.
    """

    solutions: str
    operators: dict[str, list[list[str]]]
    parameters: tuple[str, ...]
    conflict: tuple[str, ...]
    case: str | None
    certificate: Certificate | None
    data: dict[str, Any]

    def __str__(self) -> str:
        return str(self.data["summary"])

    def __repr__(self) -> str:
        return f"<Solution: {self.solutions}, {self.data['unknowns']} unknowns>"

    def _repr_html_(self) -> str:
        return f"<pre>{html.escape(str(self))}</pre>"


def solve(x: Any, *, set: Mapping[str, Any] | None = None, exact: Exact | None = None) -> Solution:
    """Solves the identities of a case for its unknown entries (``"?"``), exactly.

    Parameters
    ----------
    x : path, str or dict
        A case with unknown entries.
    set : mapping, optional
        Values of free parameters in the case that is written; the others are 0.
    exact : {"decimal", "binary"}, optional
        How floats are made exact; without it they are refused.

    Returns
    -------
    Solution
    """
    given = source(x, exact=exact)
    settings = [f"{k}={written(number(v, exact, k))}" for k, v in (set or {}).items()]
    data, case, certificate = _secant.solve(given.name, text_of(given), settings)
    d = json.loads(data)
    return Solution(
        solutions=d["solutions"],
        operators={o["operator"]: o["matrix"] for o in d.get("operators", ())},
        parameters=tuple(p["name"] for p in d.get("parameters", ())),
        conflict=tuple(d.get("conflict", ())),
        case=case,
        certificate=Certificate._of(certificate),
        data=d,
    )


def check(case: Any, certificate: Any = None) -> Checked:
    """Has a certificate proved again by the independent checker, which shares no code with secant.

    Parameters
    ----------
    case : path, str, dict or Certificate
        The case that the certificate is about, as the checker reads it; or the certificate of a result alone.
    certificate : path, str or Certificate
        The certificate.

    Returns
    -------
    Checked
        True in conditions where the certificate is accepted.

    Examples
    --------
    >>> import secant
    >>> bool(secant.check(secant.certify("four-point").certificate))
    True
    """
    if isinstance(case, Certificate) and certificate is None:
        return case.check()
    if certificate is None:
        raise InputError("no certificate is given", code="secant::python::certificate", help="check(case, certificate)")
    about = case.case if isinstance(case, Certificate) else text_of(source(case))
    if isinstance(certificate, Certificate):
        text = certificate.text
    elif isinstance(certificate, str) and certificate.lstrip().startswith("{"):
        text = certificate
    else:
        with open(certificate, encoding="utf-8") as file:
            text = file.read()
    return Checked._of(_secant.check(about, text))


__all__ = [
    "JointRadius",
    "Regularity",
    "Solution",
    "certify",
    "check",
    "jsr",
    "regularity",
    "solve",
]
