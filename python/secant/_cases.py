"""What a question is about: files, texts, mappings, masks, lists of matrices, wavelets."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

from . import _secant
from ._errors import InputError
from ._numbers import Exact, matrix, number, written
from ._toml import written as toml

Convention = Literal["columns", "rows"]


@dataclass(frozen=True)
class Source:
    """A case: a text, or a file that is still to be read, or what stands for one (a scheme, a mask, a symbol)."""

    name: str
    text: str | None = None
    path: str | None = None


def source(
    x: Any,
    *,
    exact: Exact | None = None,
    convention: Convention | None = None,
    arity: int = 2,
    name: str = "case",
) -> Source:
    """The case that `x` is or stands for (see :func:`secant.certify`)."""
    if isinstance(x, Source):
        return x
    if isinstance(x, str):
        if "\n" in x:
            _unicode(x)
            return Source(name, text=x)
        return Source(_shown(x), path=x) if os.path.isfile(x) else Source(_unicode(x))
    if isinstance(x, os.PathLike):
        path = os.fsdecode(os.fspath(x))
        return Source(_shown(path), path=path)
    if isinstance(x, Mapping):
        case = dict(x)
        case.setdefault("name", name)
        return Source(str(case["name"]), text=toml(case, exact))
    if is_wavelet(x):
        return Source(str(x.name), text=toml(_wavelet_case(x, exact)))
    return Source(name, text=toml(_case(x, exact, convention, arity, name)))


def _shown(path: str) -> str:
    """A path as it is shown: names of files need not be Unicode."""
    return path.encode("utf-8", "replace").decode()


def _unicode(text: str) -> str:
    try:
        text.encode()
    except UnicodeEncodeError:
        raise InputError("the text is not Unicode", code="secant::case::encoding", help="a case is UTF-8") from None
    return text


def _case(x: Any, exact: Exact | None, convention: Convention | None, arity: int, name: str) -> dict[str, Any]:
    depth = _depth(x)
    if depth == 1:
        mask = [written(number(c, exact, f"coefficient {k} of the mask")) for k, c in enumerate(x)]
        if not mask:
            raise InputError("the mask is empty", code="secant::python::shape", help="give its coefficients")
        return {"name": name, "scheme": {"mask": mask, "arity": arity}}
    if depth == 3:
        if convention not in ("columns", "rows"):
            raise InputError(
                "a list of matrices needs a convention",
                code="secant::python::convention",
                help='convention="columns" for operators on columns of barycentric coordinates (columns sum to 1), '
                'convention="rows" for subdivision matrices on rows of control points (rows sum to 1)',
            )
        pieces = [matrix(m, exact, f"matrix {k}") for k, m in enumerate(x)]
        rows = [[[written(c) for c in row] for row in m] for m in pieces]
        return {"name": name, "convention": convention, "pieces": rows}
    shape = f"an array of shape {x.shape}" if hasattr(x, "shape") else f"of type {type(x).__name__}"
    raise InputError(
        f"the case is {shape}",
        code="secant::python::case",
        help="give a path, the text of a case, a dict, a mask (a list of numbers) or a list of at least one matrix; "
        "of a single matrix there is secant.spectrum",
    )


def _depth(x: Any) -> int:
    if hasattr(x, "ndim"):
        return int(x.ndim)
    if hasattr(x, "tolist") and hasattr(x, "rows"):
        return 2
    if isinstance(x, Sequence) and not isinstance(x, (str, bytes)):
        return 1 + _depth(x[0]) if x else 1
    return 2 if type(x).__name__ in ("fmpq_mat", "fmpz_mat") else 0


def is_wavelet(x: Any) -> bool:
    """Whether it is an object of PyWavelets."""
    return type(x).__module__.startswith("pywt") and hasattr(x, "rec_lo")


def is_named(x: Any) -> bool:
    """Whether a wavelet has the filter that its name says: a filter bank of one's own can have any name."""
    import pywt

    try:
        same: bool = x.rec_lo == pywt.Wavelet(x.name).rec_lo
    except (ValueError, TypeError):
        return False
    return same


def wavelet_filter(x: Any, exact: Exact | None) -> list[str]:
    """The scaling filter of the reconstruction, in exact numbers; floats only where `exact` says how."""
    return [written(number(float(c), exact, f"coefficient {k} of {x.name}")) for k, c in enumerate(x.rec_lo)]


def _wavelet_case(x: Any, exact: Exact | None) -> dict[str, Any]:
    mask = _secant.wavelet_mask(x.name) if is_named(x) else None
    name = "".join(c if c.isalnum() or c in "-_." else "-" for c in x.name) or "wavelet"
    if mask is None:
        scheme = {"filter": wavelet_filter(x, exact), "normalisation": "one"}
        return {"name": name, "scheme": scheme}
    return {"name": name, "scheme": {"mask": mask}}
