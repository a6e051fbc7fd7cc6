"""Many cases on any executor: in chunks, in order, and resumed from a folder of results with their certificates."""

from __future__ import annotations

import hashlib
import itertools
import json
import os
import time
import uuid
from collections import deque
from collections.abc import Generator, Iterable, Iterator, Mapping
from concurrent.futures import Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from . import _secant
from ._answers import asked, text_of
from ._cases import Source, source
from ._errors import InputError, SecantError, of_dict
from ._meshes import CertifiedMesh, asked_mesh, is_mesh, travelling
from ._results import Certificate, Certified, Verdict

_SECONDS = 0.5
"""What a chunk should take: long beside the cost of sending it, short beside the work that is lost with a worker."""
_LARGEST = 1000


@dataclass(frozen=True)
class Row:
    """A case of a sweep with its result, or with the error that stands in place of one.

    Attributes
    ----------
    index : int
        Its number in the sweep, from 0.
    parameters : dict
        The parameters, or ``{"case": …}``.
    result : Certified, CertifiedMesh or None
        The result; None where the case is refused.
    error : SecantError or None
        Why it is refused, or how secant failed on it.
    seconds : float
        How long it took; 0 where it was kept from an earlier run.
    kept : bool
        Whether it was kept from an earlier run.
    """

    index: int
    parameters: dict[str, Any]
    result: Certified | CertifiedMesh | None
    error: SecantError | None
    seconds: float
    kept: bool

    @property
    def verdict(self) -> Verdict | None:
        """The verdict; None where the case is refused."""
        return None if self.result is None else self.result.verdict

    def to_dict(self) -> dict[str, Any]:
        """A line of a table: the parameters, the verdict, the digest of the certificate, the error."""
        result, certificate = self.result, None if self.result is None else self.result._certificate
        return {
            **self.parameters,
            "verdict": None if result is None else result.verdict.value,
            "g1": None if result is None or not result.every_point else result.every_point["verdict"],
            "checked": None if result is None else result.checked,
            "certificate": None if certificate is None else certificate.digest,
            "error": None if self.error is None else self.error.message,
            "seconds": self.seconds,
            "kept": self.kept,
        }


def _digest(*parts: Any) -> str:
    return hashlib.sha256(json.dumps(parts, ensure_ascii=False).encode()).hexdigest()


_BUILD: list[str] = []


def _build() -> str:
    """The digest of the extension module: results of another build are not taken from a folder."""
    if not _BUILD:
        _BUILD.append(hashlib.sha256(Path(_secant.__file__).read_bytes()).hexdigest())
    return _BUILD[0]


class Folder:
    """A folder of results: lines of JSON, each with the case, the report and the certificate, sealed by a digest.

    Every process appends to a file of its own, so that nothing is lost with a process but the line that it was writing.
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = Path(path)
        self.path.mkdir(parents=True, exist_ok=True)

    def places(self) -> dict[str, tuple[Path, int]]:
        """Where the result of each question stands: the file and the byte; the lines are not kept in memory."""
        found: dict[str, tuple[Path, int]] = {}
        for path in sorted(self.path.glob("*.jsonl")):
            at = 0
            with path.open("rb") as lines:
                for line in lines:
                    if line.startswith(b'{"key": "') and line.endswith(b"\n"):
                        found[line[9:73].decode("ascii", "replace")] = (path, at)
                    at += len(line)
        return found

    @staticmethod
    def read(place: tuple[Path, int], key: str, recheck: bool) -> dict[str, Any] | None:
        """The result at a place, where it is whole and, with `recheck`, the checker accepts its certificate again."""
        path, at = place
        with path.open("rb") as lines:
            lines.seek(at)
            try:
                stored = json.loads(lines.readline())
                seal, record = stored["seal"], stored["record"]
            except (ValueError, KeyError, TypeError):
                return None
        if stored["key"] != key or seal != _digest(key, _build(), record):
            return None
        if recheck and record["certificate"] is not None:
            certificate = Certificate._of(record["certificate"])
            checked = None if certificate is None else certificate.check()
            if not checked or checked.verdict is None or checked.verdict.value != record["data"]["verdict"]:
                return None
        found: dict[str, Any] = record
        return found

    def results(self, recheck: bool = False) -> Iterator[Certified | CertifiedMesh]:
        """All results that are whole, one after the other; with `recheck` those whose certificates are accepted again."""
        for key, place in self.places().items():
            record = self.read(place, key, recheck)
            if record is not None and record["error"] is None:
                result, _ = _opened(record)
                if result is not None:
                    yield result


def _key(question: dict[str, Any]) -> str:
    return _digest(_build(), question)


def _record(question: dict[str, Any]) -> dict[str, Any]:
    """The answer to a question as plain data; an error is a result like the others."""
    started = time.perf_counter()
    record: dict[str, Any] = {"question": question, "data": None, "certificate": None, "error": None}
    try:
        if "scheme" in question:
            record["data"] = json.loads(_secant.mesh(question)[1])
        else:
            _, data, text, certificate = _secant.certify(question)
            record.update(data=json.loads(data), certificate=certificate)
            record["question"] = {**question, "text": text, "path": None}
    except SecantError as error:
        record["error"] = error.to_dict()
    record["seconds"] = time.perf_counter() - started
    return record


_FILES: dict[tuple[str, int], str] = {}


def _work(questions: list[dict[str, Any]], folder: str | None) -> list[str]:
    """Answers questions on a worker; each answer is in the folder before the next question is begun."""
    done = []
    lines = None
    if folder is not None:
        # Of each process: a forked one must not write into the file of its parent.
        name = _FILES.setdefault((folder, os.getpid()), f"{uuid.uuid4().hex}.jsonl")
        lines = open(os.path.join(folder, name), "a", encoding="utf-8")
    try:
        for question in questions:
            record = _record(question)
            if lines is not None and (record["error"] is None or record["error"]["code"] != "secant::internal"):
                key = _key(question)
                stored = {"key": key, "seal": _digest(key, _build(), record), "record": record}
                lines.write(json.dumps(stored, ensure_ascii=False) + "\n")
                lines.flush()
            done.append(json.dumps(record, ensure_ascii=False))
    finally:
        if lines is not None:
            lines.close()
    return done


def _opened(record: dict[str, Any]) -> tuple[Certified | CertifiedMesh | None, SecantError | None]:
    if record["error"] is not None:
        return None, of_dict(record["error"])
    if "scheme" in record["question"]:
        return CertifiedMesh(record["data"], record["question"]), None
    return Certified(record["data"], record["question"], Certificate._of(record["certificate"])), None


# The cases of a sweep


def _filled(x: Any, values: Mapping[str, Any], used: set[str]) -> Any:
    """A case with its named unknown entries (``"?w"``) filled."""
    if isinstance(x, str) and x.startswith("?") and x[1:] in values:
        used.add(x[1:])
        return values[x[1:]]
    if isinstance(x, Mapping):
        return {k: _filled(v, values, used) for k, v in x.items()}
    if isinstance(x, (list, tuple)):
        return [_filled(v, values, used) for v in x]
    return x


def _table(case: Any) -> dict[str, Any]:
    import tomllib

    if isinstance(case, Mapping):
        return dict(case)
    given = source(case)
    if given.text is None and given.path is None:
        words = given.name.split()
        parameters = dict(w.split("=", 1) for w in words[1:] if "=" in w)
        if not words or len(parameters) != len(words) - 1 or not words[0].replace("-", "").replace("_", "").isalnum():
            raise InputError(
                f"{given.name!r} has no parameters",
                code="secant::python::sweep",
                help="name a scheme, or give a case with entries such as \"?w\", or a function of the parameters",
            )
        return {"name": words[0], "scheme": {"name": words[0], **parameters}}
    try:
        return tomllib.loads(text_of(given), parse_float=str)
    except tomllib.TOMLDecodeError as error:
        raise InputError(str(error), code="secant::case::syntax", file=given.name) from None


def _instances(case: Any, parameters: Mapping[str, Iterable[Any]] | None) -> Iterator[tuple[dict[str, Any], Any]]:
    """The parameters of each case, and the case."""
    if parameters is None:
        if isinstance(case, (str, os.PathLike, Mapping)) or not isinstance(case, Iterable):
            raise InputError(
                "a sweep without parameters is over a list of cases",
                code="secant::python::sweep",
                help='give a list of paths, masks or dicts, or parameters such as {"w": values}',
            )
        for one in case:
            yield {"case": os.fspath(one) if isinstance(one, os.PathLike) else one}, one
        return
    names = list(parameters)
    if not names:
        raise InputError("no parameter is given", code="secant::python::sweep", help='as in {"w": values}')
    table = None if callable(case) else _table(case)
    # The first parameter may be a generator of any length; the others are kept for the product.
    others = [list(parameters[name]) for name in names[1:]]
    for first in parameters[names[0]]:
        for rest in itertools.product(*others):
            values = dict(zip(names, (first, *rest), strict=True))
            yield values, case(**values) if table is None else _instance(table, values)


def _instance(table: Mapping[str, Any], values: Mapping[str, Any]) -> dict[str, Any]:
    used: set[str] = set()
    filled: dict[str, Any] = _filled(table, values, used)
    rest = {k: v for k, v in values.items() if k not in used}
    if rest:
        scheme = filled.get("scheme")
        if not isinstance(scheme, Mapping) or not ("name" in scheme or "mesh" in scheme):
            raise InputError(
                f"the case has no parameter {next(iter(rest))!r}",
                code="secant::python::sweep",
                help='write its place as an entry "?w", or name a scheme in [scheme]',
            )
        filled["scheme"] = {**scheme, **rest}
    return filled


# The sweep


def _workers(executor: Any) -> int:
    for name in ("_max_workers", "max_workers", "num_workers"):
        count = getattr(executor, name, None)
        if isinstance(count, int) and count > 0:
            return count
    client = getattr(executor, "_client", None)
    if client is not None:
        return max(1, sum(int(n) for n in client.ncores().values()))
    return os.cpu_count() or 1


class _Chunks:
    """How many cases a chunk has: as many as take half a second, by the time of those that are done."""

    def __init__(self, fixed: int | None) -> None:
        self.fixed, self.mean = fixed, None if fixed else 0.0
        self.done = 0

    def size(self) -> int:
        if self.fixed:
            return self.fixed
        if not self.done or not self.mean:
            return 1 if not self.done else _LARGEST
        return max(1, min(_LARGEST, int(_SECONDS / self.mean), 2 * self.done))

    def seen(self, seconds: float) -> None:
        if self.mean is not None:
            self.done += 1
            # Recent cases count more.
            self.mean += (seconds - self.mean) / min(self.done, 200)


Question = tuple[int, dict[str, Any], dict[str, Any] | None, SecantError | None]
Chunk = tuple[list[tuple[int, dict[str, Any], dict[str, Any]]], "Future[list[str]] | None", Row | None]


class _Own:
    """Worker processes of the sweep itself, replaced when one dies."""

    def __init__(self, workers: int) -> None:
        self._max_workers = workers
        self.pool = ProcessPoolExecutor(workers)

    def submit(self, *call: Any) -> Future[list[str]]:
        try:
            return self.pool.submit(*call)
        except BrokenProcessPool:
            self.renew()
            return self.pool.submit(*call)

    def renew(self) -> None:
        self.pool.shutdown(wait=False, cancel_futures=True)
        self.pool = ProcessPoolExecutor(self._max_workers)

    def alone(self, question: dict[str, Any], folder: str | None) -> list[str]:
        """A case on a process of its own; a process that dies with it is the result of that case."""
        with ProcessPoolExecutor(1) as pool:
            try:
                return pool.submit(_work, [question], folder).result()
            except BrokenProcessPool:
                record = {"question": question, "data": None, "certificate": None, "seconds": 0.0}
                record["error"] = SecantError(
                    "the process died on this case", code="secant::internal", help="memory may have run out"
                ).to_dict()
                return [json.dumps(record)]


def iter_sweep(
    case: Any,
    parameters: Mapping[str, Iterable[Any]] | None = None,
    *,
    executor: Any = None,
    workers: int | None = None,
    folder: str | os.PathLike[str] | None = None,
    recheck: bool = True,
    chunk: int | None = None,
    ahead: int | None = None,
    progress: bool = False,
    **options: Any,
) -> Iterator[Row]:
    """The rows of :func:`sweep`, one after the other and in order; memory does not grow with their number.

    The parameters are those of :func:`sweep`: `case`, `parameters`, `executor`, `workers`, `folder`, `recheck`, `chunk`, `ahead`,
    `progress` and the `options` of :func:`secant.certify`.

    Yields
    ------
    Row
    """
    kept = Folder(folder) if folder is not None else None
    places = kept.places() if kept is not None else {}
    own = _Own(workers or os.cpu_count() or 1) if executor is None and workers != 0 else None
    pool = own if executor is None else executor
    most = ahead or 4 * (_workers(pool) if pool is not None else 1)
    rows = _rows(_questions(case, parameters, options), places, kept, pool, own, most, _Chunks(chunk), recheck)
    try:
        yield from _shown(rows, progress)
    finally:
        rows.close()
        if own is not None:
            own.pool.shutdown(wait=True, cancel_futures=True)


def _shown(rows: Iterator[Row], progress: bool) -> Iterator[Row]:
    if not progress:
        return rows
    from tqdm.auto import tqdm

    shown: Iterator[Row] = iter(tqdm(rows, unit="case"))
    return shown


def _questions(
    case: Any, parameters: Mapping[str, Iterable[Any]] | None, options: dict[str, Any]
) -> Iterator[Question]:
    """The questions of a sweep; a case that cannot even be written down has its error instead."""
    naming = {k: options.pop(k) for k in ("exact", "convention", "arity") if k in options}
    unknown = set(options) - {"at", "valences", "check", "effort", "cells", "words", "require", "scheme"}
    if unknown:
        raise TypeError(f"unknown option {sorted(unknown)[0]!r}")
    for index, (values, one) in enumerate(_instances(case, parameters)):
        try:
            if is_mesh(one):
                mesh = asked_mesh(one, options.get("scheme"), naming.get("exact"), options)
                yield index, values, travelling(mesh), None
                continue
            given = source(one, **naming)
            if given.path is not None:
                # The text travels: workers need not see the file.
                given = Source(given.name, text=_secant.case_text(given.path))
            yield index, values, asked(given, options), None
        except SecantError as error:
            yield index, values, None, error


def _rows(
    questions: Iterator[Question],
    places: dict[str, tuple[Path, int]],
    kept: Folder | None,
    pool: Any,
    own: _Own | None,
    most: int,
    chunks: _Chunks,
    recheck: bool,
) -> Generator[Row, None, None]:
    waiting: deque[Chunk] = deque()
    batch: list[tuple[int, dict[str, Any], dict[str, Any]]] = []
    folder = None if kept is None else os.fspath(kept.path.resolve())

    def send() -> None:
        if batch:
            asks = [question for _, _, question in batch]
            waiting.append((list(batch), None if pool is None else pool.submit(_work, asks, folder), None))
            batch.clear()

    for index, values, question, error in questions:
        row = None if question is not None else Row(index, values, None, error, 0.0, False)
        if question is not None and places and (place := places.get(_key(question))):
            record = Folder.read(place, _key(question), recheck)
            row = None if record is None else Row(index, values, *_opened(record), 0.0, True)
        if row is not None:
            send()
            waiting.append(([], None, row))
        elif question is not None:
            batch.append((index, values, question))
            if len(batch) >= chunks.size():
                send()
        while len(waiting) > most:
            yield from _finished(waiting.popleft(), own, folder, chunks)
        while waiting and _ready(waiting[0]):
            yield from _finished(waiting.popleft(), own, folder, chunks)
    send()
    while waiting:
        yield from _finished(waiting.popleft(), own, folder, chunks)


def _ready(chunk: Chunk) -> bool:
    batch, future, _ = chunk
    return not batch or future is None or future.done()


def _finished(chunk: Chunk, own: _Own | None, folder: str | None, chunks: _Chunks) -> Iterator[Row]:
    batch, future, row = chunk
    if row is not None:
        yield row
        return
    for (index, values, _), text in zip(batch, _answers(batch, future, own, folder), strict=True):
        record = json.loads(text)
        chunks.seen(record["seconds"])
        yield Row(index, values, *_opened(record), record["seconds"], False)


def _answers(
    batch: list[tuple[int, dict[str, Any], dict[str, Any]]],
    future: Future[list[str]] | None,
    own: _Own | None,
    folder: str | None,
) -> Iterable[str]:
    asks = [question for _, _, question in batch]
    if future is None:
        return (text for question in asks for text in _work([question], folder))
    try:
        return future.result()
    except BrokenProcessPool:
        if own is None:
            raise
    # A process died, and with it the pool: what the folder has is taken from there, the others are asked again.
    places = Folder(folder).places() if folder is not None else {}
    found = [_found(question, places) for question in asks]
    missing = [question for question, text in zip(asks, found, strict=True) if text is None]
    again = iter(_again(missing, own, folder))
    return [next(again) if text is None else text for text in found]


def _found(question: dict[str, Any], places: dict[str, tuple[Path, int]]) -> str | None:
    place = places.get(_key(question))
    record = None if place is None else Folder.read(place, _key(question), False)
    return None if record is None else json.dumps(record)


def _again(asks: list[dict[str, Any]], own: _Own, folder: str | None) -> list[str]:
    """All in a new pool, which may have died for another chunk; if it dies again, each alone."""
    try:
        return own.submit(_work, asks, folder).result() if asks else []
    except BrokenProcessPool:
        return [text for question in asks for text in own.alone(question, folder)]


def sweep(
    case: Any,
    parameters: Mapping[str, Iterable[Any]] | None = None,
    *,
    executor: Any = None,
    workers: int | None = None,
    folder: str | os.PathLike[str] | None = None,
    recheck: bool = True,
    chunk: int | None = None,
    ahead: int | None = None,
    progress: bool = False,
    **options: Any,
) -> Any:
    """Certifies many cases, on worker processes or on any executor.

    Parameters
    ----------
    case : str, path, dict, callable, or list of cases
        With `parameters`: the name of a scheme (``"four-point"``), a case whose ``[scheme]`` takes the parameters or which has
        entries such as ``"?w"``, or a function that returns a case of any kind for the parameters as keywords. Without: a list
        (or generator) of cases as for :func:`secant.certify`.
    parameters : mapping, optional
        For each parameter its values, exact numbers; of several all combinations, the last one running fastest.
    executor : optional
        Anything with the interface of ``concurrent.futures``: the standard pools, ``dask.distributed.Client.get_executor()``,
        ``mpi4py.futures.MPIPoolExecutor``, and :class:`secant.RayExecutor`. Without it, processes of this machine, which are replaced when one dies.
    workers : int, optional
        How many processes where there is no executor; 0 for none: in this process.
    folder : path, optional
        Results and certificates are kept there, each as soon as it is found, by the workers themselves: the folder has to be
        seen by all of them. A case whose result is there, of this build of secant and with these options, is not done again.
    recheck : bool
        Whether the checker proves the certificates from the folder again.
    chunk : int, optional
        Cases that travel together; without it as many as take about half a second.
    ahead : int, optional
        Chunks that are sent before the first of them is back; four for each worker.
    progress : bool
        Show a bar (needs tqdm).
    **options
        Those of :func:`secant.certify`.

    Returns
    -------
    pandas.DataFrame or list of dict
        A line for each case, in order: the parameters, ``verdict``, ``g1``, ``checked``, ``certificate`` (its digest),
        ``error``, ``seconds`` and ``kept``. A list where pandas is not installed. :func:`iter_sweep` gives the results.

    Examples
    --------
    >>> import secant
    >>> from fractions import Fraction
    >>> table = secant.sweep("four-point", {"w": [Fraction(1, 16), Fraction(1, 10)]}, workers=0)
    >>> list(table["verdict"])
    ['proved', 'proved']
    """
    rows = iter_sweep(
        case,
        parameters,
        executor=executor,
        workers=workers,
        folder=folder,
        recheck=recheck,
        chunk=chunk,
        ahead=ahead,
        progress=progress,
        **options,
    )
    table = [row.to_dict() for row in rows]
    try:
        import pandas
    except ImportError:
        return table
    return pandas.DataFrame(table)


__all__ = ["Folder", "Row", "iter_sweep", "sweep"]
