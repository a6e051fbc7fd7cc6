"""A case as TOML text, a value on each line, so that diagnostics name the line that they mean."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

from ._errors import InputError
from ._numbers import Exact, number


def _string(text: str) -> str:
    # Strings of JSON are strings of TOML, apart from one control character and lone surrogates.
    try:
        text.encode()
    except UnicodeEncodeError:
        raise InputError(f"{text!r} is no text", code="secant::python::text", help="use Unicode") from None
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def _is_list(x: Any) -> bool:
    return isinstance(x, Sequence) and not isinstance(x, (str, bytes))


def _rows(x: Any) -> Any:
    if type(x).__module__.split(".")[0] in ("sympy", "flint") and hasattr(x, "tolist"):
        return x.tolist()
    if getattr(x, "ndim", 0) > 0 and hasattr(x, "dtype"):
        return list(x)
    return x


def _value(x: Any, exact: Exact | None, where: str) -> str:
    x = _rows(x)
    if isinstance(x, str):
        return _string(x)
    if isinstance(x, bool):
        return "true" if x else "false"
    if isinstance(x, Mapping):
        inner = ", ".join(f"{_key(k)} = {_value(v, exact, f'{where}.{k}')}" for k, v in x.items())
        return "{" + inner + "}"
    if _is_list(x):
        return "[" + ", ".join(_value(item, exact, f"{where}[{i}]") for i, item in enumerate(x)) + "]"
    exactly = number(x, exact, where)
    if isinstance(exactly, Fraction) and exactly.denominator == 1 and abs(exactly.numerator) < 2**63:
        return str(exactly)
    return _string(str(exactly))


def _key(key: Any) -> str:
    if not isinstance(key, str):
        raise InputError(f"{key!r} is no key", code="secant::python::key", help="keys of a case are texts")
    return key if key.isascii() and key.replace("_", "a").replace("-", "a").isalnum() else _string(key)


def _lines(key: str, x: Any, exact: Exact | None) -> str:
    x = _rows(x)
    if _is_list(x) and x and all(_is_list(_rows(item)) for item in x):
        inner = "".join(f"  {_value(item, exact, f'{key}[{i}]')},\n" for i, item in enumerate(x))
        return f"{_key(key)} = [\n{inner}]\n"
    return f"{_key(key)} = {_value(x, exact, key)}\n"


def _is_tables(x: Any) -> bool:
    return _is_list(x) and bool(x) and all(isinstance(item, Mapping) for item in x)


def _table(path: str, table: Mapping[str, Any], exact: Exact | None) -> str:
    tables = {k for k, v in table.items() if isinstance(v, Mapping) and not path or _is_tables(v)}
    out = "".join(_lines(k, v, exact) for k, v in table.items() if k not in tables)
    for key in (k for k in table if k in tables):
        inner, name = table[key], f"{path}{_key(key)}"
        if isinstance(inner, Mapping):
            out += f"\n[{name}]\n" + _table(f"{name}.", inner, exact)
        else:
            for item in inner:
                out += f"\n[[{name}]]\n" + _table(f"{name}.", item, exact)
    return out


def written(case: Mapping[str, Any], exact: Exact | None = None) -> str:
    """The text of a case that is given as a mapping; numbers may be of any exact kind."""
    return _table("", case, exact)
