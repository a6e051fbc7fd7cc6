"""What goes wrong, as exceptions with a code, a place and a way to mend it."""

from __future__ import annotations

from typing import Any


class SecantError(Exception):
    """Something that secant refuses or cannot do.

    Attributes
    ----------
    message : str
        What is wrong, in one sentence.
    code : str
        A stable code, such as ``"secant::case::sum"``.
    file : str or None
        The file, or the name under which the input is shown.
    line, column : int or None
        The place in it, both from 1.
    help : str or None
        How to mend it.
    """

    def __init__(
        self,
        message: str,
        *,
        code: str = "secant::python",
        file: str | None = None,
        line: int | None = None,
        column: int | None = None,
        help: str | None = None,
    ) -> None:
        super().__init__(message)
        self.message, self.code, self.file = message, code, file
        self.line, self.column, self.help = line, column, help

    def __str__(self) -> str:
        place = ""
        if self.file is not None:
            place = self.file if self.line is None else f"{self.file}:{self.line}:{self.column}"
            place += ": "
        mend = f"\n  help: {self.help}" if self.help else ""
        return f"{place}{self.message} [{self.code}]{mend}"

    def to_dict(self) -> dict[str, Any]:
        """The error as data, as in the JSON report of a refused case (docs/json.md)."""
        return {
            "code": self.code,
            "message": self.message,
            "file": self.file,
            "line": self.line,
            "column": self.column,
            "help": self.help,
        }

    def __reduce__(self) -> tuple[Any, ...]:
        fields = {k: v for k, v in self.to_dict().items() if k != "message"}
        return _restored, (type(self), self.message, fields)


class InputError(SecantError, ValueError):
    """The input is wrong."""


class InternalError(SecantError, RuntimeError):
    """A mistake in secant itself: there is no result. Please report it with the case."""


class CertificateError(SecantError):
    """There is no certificate, or the checker does not accept it."""


def _restored(kind: type[SecantError], message: str, fields: dict[str, Any]) -> SecantError:
    return kind(message, **fields)


def made(
    code: str,
    message: str,
    file: str | None,
    line: int | None,
    column: int | None,
    help: str | None,
    internal: bool,
) -> SecantError:
    """The exception of a problem of the library."""
    kind: type[SecantError] = InputError
    if internal:
        kind = InternalError
    elif code.startswith("secant::certificate"):
        kind = CertificateError
    elif code == "secant::stopped":
        kind = SecantError
    return kind(message, code=code, file=file, line=line, column=column, help=help)


def of_dict(data: dict[str, Any]) -> SecantError:
    """The exception that :meth:`SecantError.to_dict` describes."""
    internal = data["code"] == "secant::internal"
    fields = (data["code"], data["message"], data["file"], data["line"], data["column"], data["help"])
    return made(*fields, internal)
