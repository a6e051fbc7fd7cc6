import pathlib
import pickle
from fractions import Fraction as F

import pytest

import secant


@pytest.fixture(scope="module")
def three_point():
    return secant.region("ternary-four-point", {"mu": (0, "1/6")}, order=2)


def test_the_answers_of_the_paper(three_point):
    # Hassan, Ivrissimtzis, Dodgson and Sabin: C² for 1/15 < mu < 1/9.
    second = three_point[2]
    assert second.at("1/15") == "refuted" == second.at(F(1, 9)) and second.at("1/11") == "proved"
    assert (F(1, 15), F(1, 9)) in second.proved
    assert three_point.range == (0, F(1, 6)) and three_point.parameter == "mu" and len(three_point) == 3
    for outside in ("1/5", -1):
        with pytest.raises(secant.InputError, match="outside"):
            second.at(outside)
    for wrong in ("sqrt(2)", 0.1, None):
        with pytest.raises(secant.InputError):
            second.at(wrong)


def test_every_value_is_in_one_part(three_point):
    for order in three_point:
        for k in range(61):
            assert sum(F(k, 360) in part for part in order.parts) == 1, (order.label, k)


def test_members_agree(three_point):
    for mu in (F(1, 20), F(1, 11), F(1, 8)):
        found = secant.regularity(f"ternary-four-point mu={mu}")
        holds = found.smoothness is not None and found.smoothness >= 2
        assert (three_point[2].at(mu) == "proved") == holds


def test_it_travels_and_is_checked(three_point, tmp_path):
    again = pickle.loads(pickle.dumps(three_point))
    assert again.to_dict() == three_point.to_dict() and again.verdict == three_point.verdict
    assert again.certificate.check() and again.svg == three_point.svg
    assert "<svg" in again._repr_html_() and "C^2" in str(again)
    again.report(tmp_path / "r.md")
    assert "1/15" in (tmp_path / "r.md").read_text()
    with pytest.raises(secant.InputError):
        again.report(tmp_path / "r.doc")


def test_irrational_ends():
    found = secant.region("four-point w=3/20..1/4", order=1)
    (low, high), = found[1].proved
    assert low == F(3, 20) and isinstance(high, secant.Algebraic) and abs(float(high) - 0.192729249264812) < 1e-14
    assert found[1].at(F("0.1927292492648")) == "proved" and found[1].at(F("0.1927292492649")) == "refuted"
    assert high.minimal_polynomial == (F(-1, 32), F(1, 8), 0, 1)


def test_masks_of_all_kinds(tmp_path):
    sympy = pytest.importorskip("sympy")
    w = sympy.Symbol("w")
    text = ["-w", 0, "1/2+w", 1, "1/2+w", 0, "-w"]
    symbols = [-w, 0, sympy.Rational(1, 2) + w, 1, sympy.Rational(1, 2) + w, 0, -w]
    limits = {"w": ("1/32", "1/16")}
    path = tmp_path / "fälle.toml"
    case = {"name": "four", "parameters": {"w": "1/32..1/16"}, "scheme": {"mask": text}}
    path.write_text('name = "four"\n[parameters]\nw = "1/32..1/16"\n[scheme]\nname = "four-point"\nw = "w"\n')
    found = [secant.region(x, y, order=0) for x, y in [(text, limits), (symbols, limits), (case, None), (path, None), (str(path), None)]]
    assert all(f[0].at("1/20") == "proved" and len(f) == 1 for f in found)
    assert all(f.mask == found[0].mask for f in found)


@pytest.mark.parametrize("x, parameters", [
    ("four-point", None), ("four-pont", {"w": (0, 1)}), ("four-point", {"w": (1, 0)}), ("four-point", {"w": (0, 1, 2)}),
    ("four-point", {"w": (0.1, 0.2)}), ("four-point", {"v": (0, 1)}), (["w", 1], {"w": (0, 1)}), ([], {"w": (0, 1)}), ({}, {}),
    ("koch", {"w": (0, 1)}), ("", {}), ("/no/such/file.toml", {}), ("four-point", {"w w": (0, 1)}), (["1/2", 1, "1/2"], None),
])
def test_wrong_questions(x, parameters):
    with pytest.raises(secant.InputError) as caught:
        secant.region(x, parameters)
    assert caught.value.help
    with pytest.raises(secant.InputError):
        secant.region("four-point w=0..1/16", width=0)


FAMILIES = pathlib.Path(__file__).parents[2] / "tests" / "families"


def test_curves(tmp_path):
    found = secant.region(FAMILIES / "corner-cutting.toml", {"a": ("1/5", "2/5")})
    assert [t.claim for t in found] == list(found._by_key) and found.mask is None and found.orders == ()
    g1 = found["g1"]
    # With b = 1/4 the curve is G¹ up to 3/8.
    assert g1.at("3/8") == g1.at("1/4") == "proved" and g1.at("19/50") == "refuted"
    assert F(3, 8) in {end for run in g1.proved for end in run}
    again = pickle.loads(pickle.dumps(found))
    assert again["g1"].at("3/8") == "proved" and again.certificate.check() and "g1" in again._repr_html_()
    with pytest.raises(KeyError, match="g1"):
        found["c1"]
    with pytest.raises(secant.InputError, match="valences"):
        secant.region(FAMILIES / "corner-cutting.toml", {"a": ("1/5", "2/5")}, valences=[5])


def test_vertices():
    found = secant.region(FAMILIES / "loop-beta.toml", valences=[6])
    assert len(found) == 1 and found[6].valence == 6 and "valence 6" in repr(found)
    assert found[6].at("1/16") == "proved"
    with pytest.raises(secant.SecantError):
        found.certificate
