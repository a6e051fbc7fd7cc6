import pickle
from fractions import Fraction as F

import pytest

import secant

QUADRATIC = ["1/4", "3/4", "3/4", "1/4"]
PIECES = [[[F(3, 4), F(1, 4), 0], [F(1, 4), F(3, 4), F(3, 4)], [0, 0, F(1, 4)]],
          [[F(1, 4), 0, 0], [F(3, 4), F(3, 4), F(1, 4)], [0, F(1, 4), F(3, 4)]]]


def test_the_thesis(cases):
    result = secant.certify(cases / "thesis" / "half-tangent.toml", require="ends,joints,dense")
    assert result.verdict == "proved" and result.proved
    joint = next(p for p in result.points if p.address == "0(1)")
    assert joint.kind == "cusp" and joint.eigenvalue == F(3, 4)
    assert tuple(joint.tangent) in {(2, -3, 1), (-2, 3, -1)} and joint.position == (1, F(-1, 4), F(1, 4))
    assert joint.left[0] == joint.right[0] == (-2, 3, -1)
    assert [c.kind for c in result.claims][:2] == ["tangent-at-ends", "dense-joints"]
    with pytest.raises(secant.InputError):
        secant.certify("four-point", require="smooth")
    assert result.every_point["verdict"] == "refuted"


@pytest.mark.parametrize("x", [
    "1/4,3/4,3/4,1/4", "(1+z)^3/4", QUADRATIC, [F(1, 4), F(3, 4), F(3, 4), F(1, 4)],
    {"scheme": {"mask": QUADRATIC}}, 'name = "q"\n[scheme]\nmask = ["1/4", "3/4", "3/4", "1/4"]\n',
])
def test_every_form_of_a_mask(x):
    result = secant.certify(x)
    assert result.proved and result.every_point["verdict"] == "proved"
    assert len(result.points) == len(secant.certify("bspline degree=2").points)


def test_matrices_need_a_convention():
    with pytest.raises(secant.InputError, match="convention"):
        secant.certify(PIECES)
    assert secant.certify(PIECES, convention="columns").proved
    rows = [[list(r) for r in zip(*m)] for m in PIECES]
    assert secant.certify(rows, convention="rows").proved
    with pytest.raises(secant.InputError) as caught:
        secant.certify(PIECES, convention="rows")
    assert caught.value.code == "secant::case::sum" and caught.value.line and caught.value.help


def test_a_refutation_is_no_truth_value(cases):
    result = secant.certify(cases / "classical" / "levy.toml")
    assert result.verdict is secant.Verdict.REFUTED and not result.proved
    assert any(p.data.get("witness") for p in result.points)
    with pytest.raises(TypeError):
        bool(result)
    with pytest.raises(TypeError):
        bool(result.verdict)


def test_further_points(cases):
    result = secant.certify(cases / "thesis" / "half-tangent.toml", at=["(01)", "1(0)"])
    assert "(01)" in [p.address for p in result.points]
    with pytest.raises(secant.InputError) as caught:
        secant.certify("four-point", at="0(7)")
    assert caught.value.code == "secant::usage::address"


def test_vertices(cases):
    result = secant.certify(cases / "surfaces" / "catmull-clark.toml", valences=range(5, 8))
    assert [v["valence"] for v in result.valences] == [5, 6, 7] and result.proved and result.checked
    again = pickle.loads(pickle.dumps(result))
    assert again.svg == result.svg and "<svg" in again.svg
    assert secant.check(result.certificate)


def test_surfaces(cases):
    result = secant.certify(cases / "surfaces" / "bicubic-space.toml")
    assert result.proved and all(len(p.plane) == 2 for p in result.points)


def test_irrational_directions_are_exact(cases):
    found = 0
    for path in sorted(cases.glob("*/*.toml")):
        text = path.read_text()
        if "sqrt" not in text and "golden" not in text and "irrational" not in text:
            continue
        try:
            result = secant.certify(path)
        except secant.InputError:
            continue
        for point in result.points:
            for direction in (*point.left, *point.right):
                if any(isinstance(x, secant.Algebraic) for x in direction):
                    decimals = [float(x) for x in direction._data["decimal"]]
                    exact = [float(x) for x in direction]
                    scale = max(map(abs, exact)) / max(map(abs, decimals))
                    assert exact == pytest.approx([d * scale for d in decimals], abs=1e-4 * scale)
                    found += 1
    assert found > 0


def test_a_case_over_a_number_field(cases):
    result = secant.certify(cases / "fields" / "koch-sqrt3.toml")
    assert result.verdict == "refuted"
    assert result.certificate.check()
    texts = [x for point in result.points for x in point.position if isinstance(x, str)]
    assert texts and all("sqrt(3)" in x for x in texts)


def test_results_travel(cases):
    result = secant.certify(cases / "thesis" / "half-tangent.toml")
    again = pickle.loads(pickle.dumps(result))
    assert again.to_dict() == result.to_dict() and again.points[1].tangent == result.points[1].tangent
    assert again.report() == result.report() and again.svg == result.svg
    assert again.certificate == result.certificate and again.certificate.check()


def test_reports(tmp_path, cases):
    result = secant.certify(cases / "thesis" / "half-tangent.toml")
    for name in ("übersicht.html", "a.md", "a.tex"):
        result.report(tmp_path / name)
        assert (tmp_path / name).stat().st_size > 1000
    assert "<math" in result.report() and len(result.report(level="summary")) < len(result.report())
    with pytest.raises(secant.InputError, match="format"):
        result.report(tmp_path / "a.doc")
    assert result.png.startswith(b"\x89PNG")
    assert "<svg" in result._repr_html_() and str(result.verdict) in result._repr_html_()
    assert "Claims" in str(result) and str(result.verdict) in repr(result)


def test_a_plot(cases):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    ax = secant.certify(cases / "thesis" / "half-tangent.toml").plot()
    longest = max(ax.lines, key=lambda line: len(line.get_xdata()))
    assert len(longest.get_xdata()) > 100


def test_certificates_are_checked(tmp_path, cases):
    result = secant.certify("four-point w=1/16")
    checked = secant.check(result.certificate)
    assert checked and checked.verdict == result.verdict and checked.claims
    forged = result.certificate.text.replace('"proved"', '"refuted"', 1)
    assert not secant.check(result.certificate.case, forged)
    assert secant.check(result.certificate.case, forged).reason
    result.certificate.save(tmp_path / "c.json")
    assert secant.check(tmp_path / "c.case.toml", tmp_path / "c.json")
    unasked = secant.certify("four-point w=1/16", check=False)
    assert not unasked.checked and not unasked.certificate.checked and unasked.certificate.check()


def test_solve(cases):
    solution = secant.solve(cases / "solve" / "curve-4-2.toml")
    assert solution.solutions == "family" and solution.certificate.check()
    assert secant.solve(solution.case).solutions == "one" if "?" in solution.case else True
    one = secant.solve(cases / "solve" / "chaikin.toml")
    assert one.operators and one.case
    none = secant.solve(cases / "solve" / "junction-contradiction.toml")
    assert none.solutions == "none" and none.conflict and none.case is None
    with pytest.raises(secant.InputError):
        secant.solve(cases / "solve" / "chaikin.toml", set={"nothing": 1})
