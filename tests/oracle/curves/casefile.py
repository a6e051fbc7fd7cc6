"""Reads and validates the case files (version 1) with tomllib. Every number is read exactly."""
import tomllib
from dataclasses import dataclass, field
from fractions import Fraction
from pathlib import Path

CASES = Path(__file__).resolve().parents[3] / "cases"
KINDS = {"half-tangent", "regular", "cusp", "oscillating", "corner", "none"}
VERDICTS = {"proved", "refuted", "undetermined"}


class Bad(Exception):
    """A file that must be refused; `code` is the expected diagnostic."""

    def __init__(self, code, text):
        super().__init__(f"{code}: {text}")
        self.code = code


@dataclass
class Piece:
    target: str
    op: list
    reversed: bool = False


@dataclass
class State:
    name: str
    kind: str
    dim: int
    pieces: list
    left: tuple = None
    right: tuple = None


@dataclass
class Case:
    path: Path
    name: str
    states: dict
    start: str
    control: list
    kind: str
    examine: list = field(default_factory=list)
    expect: dict = field(default_factory=dict)

    @property
    def edge(self):
        return self.states[self.start].kind == "edge"


class Exact(str):
    """The source text of a bare decimal."""


def number(x):
    try:
        if isinstance(x, bool):
            raise ValueError
        return Fraction(x)
    except (ValueError, ZeroDivisionError, TypeError):
        raise Bad("secant::case::number", f"{x!r}") from None


def matrix(rows, convention, shape=None):
    m = [[number(x) for x in r] for r in rows]
    if not m or any(len(r) != len(m[0]) for r in m):
        raise Bad("secant::case::size", "ragged matrix")
    if convention == "rows":
        m = [list(r) for r in zip(*m)]
    if shape and (len(m), len(m[0])) != shape:
        raise Bad("secant::case::size", f"{len(m)}x{len(m[0])}, expected {shape}")
    for j, col in enumerate(zip(*m)):
        if sum(col) != 1:
            raise Bad("secant::case::sum", f"column {j} sums to {sum(col)}")
    return m


def affine_operator(linear, shift):
    d = len(shift)
    if len(linear) != d or any(len(r) != d for r in linear):
        raise Bad("secant::case::size", "linear part and shift differ")
    images = [shift] + [[s + linear[i][k] for i, s in enumerate(shift)] for k in range(d)]
    return [list(r) for r in zip(*[[1 - sum(p)] + p for p in images])]


def load(path):
    text = Path(path).read_text()
    data = tomllib.loads(text, parse_float=Exact)
    if not data:
        raise Bad("secant::case::empty", "empty file")
    kind = data.get("kind", "curve")
    cell = "edge" if kind == "curve" else "set"
    control = None
    if "map" in data:
        states = {}
        pieces, d = [], len(data["map"][0]["shift"])
        for m in data["map"]:
            shift = [number(x) for x in m["shift"]]
            if len(shift) != d:
                raise Bad("secant::case::size", "shift")
            linear = [[number(x) for x in r] for r in m["linear"]]
            pieces.append(Piece("A", affine_operator(linear, shift), m.get("reversed", False)))
        states["A"] = State("A", cell, d + 1, pieces)
        start = "A"
        control = [[Fraction(int(i + 1 == j)) for j in range(d + 1)] for i in range(d)]
    elif "pieces" in data:
        conv = data["convention"]
        rev = data.get("reversed", [])
        n = len(data["pieces"][0])
        pieces = [Piece("A", matrix(m, conv, (n, n)), i in rev) for i, m in enumerate(data["pieces"])]
        states = {"A": State("A", cell, n, pieces)}
        start = "A"
    else:
        conv, start = data["convention"], data["start"]
        dims = {s["name"]: s["dimension"] for s in data["state"]}
        for s in data["state"]:
            if not s["piece"]:
                raise Bad("secant::case::no-piece", f"state {s['name']}")
            if any(p["to"] not in dims for p in s["piece"]):
                raise Bad("secant::case::unknown-state", f"state {s['name']}")
        states = {}
        for s in data["state"]:
            n = s["dimension"]
            pieces = [Piece(p["to"], matrix(p["matrix"], conv, (n, dims[p["to"]])), p.get("reversed", False))
                      for p in s.get("piece", [])]
            if not pieces:
                raise Bad("secant::case::empty", f"state {s['name']} has no piece")
            st = State(s["name"], s.get("kind", "edge"), n, pieces)
            for side in ("left", "right"):
                if side in s:
                    b = s[side]
                    setattr(st, side, (b["vertex"], matrix(b["matrix"], conv, (n, dims[b["vertex"]]))))
            states[s["name"]] = st
    if "control" in data:
        pts = [[number(x) for x in p] for p in data["control"]]
        if len(pts) != states[start].dim or any(len(p) != len(pts[0]) for p in pts):
            raise Bad("secant::case::size", "control points")
        control = [list(r) for r in zip(*pts)]
    expect = data.get("expect", {})
    for key in ("name", "title", "source"):
        if not data.get(key):
            raise Bad("format", f"{key} is missing")
    if data["name"] != Path(path).stem:
        raise Bad("format", "the name is not the file stem")
    if "error" not in expect and "verdict" in expect and expect["verdict"] not in VERDICTS:
        raise Bad("format", "verdict")
    for p in expect.get("point", []):
        extra = set(p) - {"address", "kind", "verdict", "tangent", "left", "right", "eigenvalue"}
        if extra or p.get("kind", "none") not in KINDS or p.get("verdict", "proved") not in VERDICTS:
            raise Bad("format", f"point {p}")
    examine = [e["address"] for e in data.get("examine", [])]
    return Case(Path(path), data["name"], states, start, control, kind, examine, expect)


def all_cases():
    """Cases of curves and sets with operators written out: faces, unknown entries and `[scheme]` are not read here."""
    def plain(path):
        keys = {line.split()[0] for line in path.read_text().splitlines() if line.strip()}
        return path.parent.name not in ("faces", "solve") and not {"[scheme]", "layout"} & keys

    return [f for f in sorted(CASES.glob("*/*.toml")) if plain(f)]


def parse_address(text):
    head, _, tail = text.strip().rstrip(")").partition("(")

    def word(w):
        if "," in text:
            return [int(x) for x in w.split(",") if x.strip()]
        return [int(x) for x in w]

    return word(head), word(tail)


def show_address(prefix, cycle):
    if any(i > 9 for i in prefix + cycle):
        p, c = ",".join(map(str, prefix)), ",".join(map(str, cycle))
        return f"{p}{',' if p else ''}({c}{',' if len(prefix) + len(cycle) == 1 else ''})"
    return "".join(map(str, prefix)) + "(" + "".join(map(str, cycle)) + ")"


def main():
    """Validates every file; refused files must be refused with the code they name, unless only the geometry is wrong."""
    good = refused = 0
    for f in all_cases():
        try:
            case = load(f)
            good += 1
            assert case.expect or f.parent.name == "refused", f
        except Bad as err:
            refused += 1
            assert f.parent.name == "refused", (f, err)
            assert err.code == "secant::case::empty" or f'error = "{err.code}"' in f.read_text(), (f, err)
    print(f"{good} files read, {refused} refused as they should be")


if __name__ == "__main__":
    main()
