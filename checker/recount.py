#!/usr/bin/env python3
"""Counts what secant-check proves again of the cases of the repository, and the lines of the checker (docs/certificate.md, 14):

    python3 checker/recount.py target/debug/secant target/debug/secant-check
"""

import json
import os
import pathlib
import re
import resource
import subprocess
import sys
import tempfile
from collections import Counter

ROOT = pathlib.Path(__file__).resolve().parent.parent
KINDS = {
    "what all rules use": ["base"],
    "claims": ["claim.rs"],
    "curves and sets": ["curve"],
    "schemes of curves": ["curve/scheme", "curve/scheme.rs"],
    "surfaces": ["surface.rs", "surface"],
    "vertices": ["vertex.rs", "vertex"],
    "radii": ["jsr.rs"],
    "orders": ["regularity.rs"],
    "lattices and borders": ["lattice"],
    "regions": ["region"],
    "spectra": ["spectrum.rs", "literal.rs"],
    "unknown entries": ["solve.rs"],
    "reading and the program": ["reader.rs", "lib.rs", "main.rs"],
}


def code_lines(path):
    """Lines that are no test, no comment and not blank."""
    text = re.split(r"^#\[cfg\(test\)\]$", path.read_text(), flags=re.M)[0]
    return sum(1 for line in text.splitlines() if line.strip() and not line.strip().startswith("//"))


def lines():
    """Lines by kind; a file counts for the longest name that it is under."""
    source = ROOT / "checker" / "src"
    names = [(name, kind) for kind, under in KINDS.items() for name in under]
    counts = Counter()
    for path in source.rglob("*.rs"):
        own = path.relative_to(source).as_posix()
        fitting = [(len(name), kind) for name, kind in names if own == name or own.startswith(name + "/")]
        counts[max(fitting)[1] if fitting else "other"] += code_lines(path)
    return counts


def run(command):
    """The exit code, the output, what was said besides, and the seconds of processor time."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, capture_output=True, text=True, cwd=ROOT, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    spent = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return done.returncode, done.stdout, done.stderr, spent


def main(secant, checker):
    cases = sorted((ROOT / "cases").rglob("*.toml"))
    outcome, reasons, claims = Counter(), [], Counter()
    proving = checking = size = 0
    with tempfile.TemporaryDirectory() as folder:
        for case in cases:
            name = case.relative_to(ROOT).as_posix()
            certificate = pathlib.Path(folder) / "proof.json"
            expanded = certificate.with_suffix(".case.toml")
            for old in (certificate, expanded):
                old.unlink(missing_ok=True)
            about = "solve" if case.parent.name == "solve" else "certify"
            unchecked = ["--no-check"] if about == "certify" else []
            code, _, said, spent = run([secant, about, name, *unchecked, "-q", "--certificate", str(certificate)])
            if not certificate.exists():
                known = "secant::certificate::none" in said
                outcome["no certificate" if known else "no verdict"] += 1
                if known:
                    reasons.append((name, " ".join(said.replace("│", " ").split())[:160]))
                continue
            if code == 3:
                outcome["undetermined"] += 1
            proving, size = proving + spent, size + certificate.stat().st_size
            code, said, _, spent = run([checker, name, str(certificate)])
            how = "as it is written"
            if code == 2 and expanded.exists():
                code, said, _, spent = run([checker, str(expanded), str(certificate)])
                how = "expanded"
            checking += spent
            outcome[f"accepted, {how}" if code == 0 else "not accepted"] += 1
            if code != 0:
                reasons.append((name, said.strip()[:160]))
            if about == "certify":
                count(secant, name, claims, reasons)
    report(len(cases), outcome, reasons, claims, (proving, checking, size))
    return 1 if outcome["not accepted"] else 0


def count(secant, name, claims, reasons):
    """The claims that are decided, and whether all of a case are proved again."""
    _, text, _, _ = run([secant, "certify", name, "--json"])
    found = json.loads(text)
    listed = found.get("claims") or []
    decided = sum(1 for claim in listed if claim["verdict"] != "undetermined")
    again = found["certificate"]
    claims["decided claims"] += decided
    if again["checked"]:
        claims["decided claims of cases of which all is proved again"] += decided
        claims["cases of which all is proved again"] += 1
    elif decided:
        claims["cases of which a part is proved again"] += 1
        reasons.append((name, again["why"]))


def report(total, outcome, reasons, claims, figures):
    proving, checking, size = figures
    print(f"{total} cases")
    for counted in (outcome, claims):
        for what, number in sorted(counted.items()):
            print(f"  {number:5}  {what}")
    print(f"  proving {proving:.1f} s, checking {checking:.1f} s of processor time; certificates {size / 1e6:.1f} MB")
    for name, why in reasons:
        print(f"  {name}: {why}")
    counts = lines()
    print(f"{sum(counts.values())} lines of the checker")
    for kind, number in sorted(counts.items(), key=lambda item: -item[1]):
        print(f"  {number:5}  {kind}")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    sys.exit(main(*(os.path.abspath(program) for program in sys.argv[1:])))
