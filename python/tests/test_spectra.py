from fractions import Fraction as F

import pytest

import secant

sympy = pytest.importorskip("sympy")

MATRICES = [
    [[3, 1], [-1, 1]],
    [[0, -1], [1, 0]],
    [[0, 0, 1], [1, 0, 1], [0, 1, 0]],
    [["1/2", 1, 0, 0], [0, "1/2", 0, 0], [0, 0, "1/2", 0], [1, 0, 0, 3]],
    [[0, 0, 0, -1], [1, 0, 0, 0], [0, 1, 0, -2], [0, 0, 1, 0]],
    [[1, 1, 1], [0, 1, 0], [0, 0, 2]],
]


@pytest.mark.parametrize("m", MATRICES)
def test_jordan_forms(m):
    a = sympy.Matrix([[sympy.Rational(str(x)) for x in row] for row in m])
    form = secant.jordan_form(m)
    p, j = form.sympy()
    assert p.shape == a.shape and j.is_upper
    # To many digits; the rational form below is compared exactly.
    close = a.evalf(40) * p.evalf(40) - p.evalf(40) * j.evalf(40)
    assert all(abs(complex(x.evalf(40))) < 1e-30 for x in close) and abs(complex(p.evalf(40).det().evalf(40))) > 1e-6
    expected = sorted(len(b) for b in _blocks(a.jordan_form()[1]))
    assert sorted(size for _, size in form.spectrum.blocks) == expected


def _blocks(j):
    blocks, n = [[0]], j.shape[0]
    for k in range(1, n):
        if j[k - 1, k] == 1:
            blocks[-1].append(k)
        else:
            blocks.append([k])
    return blocks


@pytest.mark.parametrize("m", MATRICES)
def test_rational_forms(m):
    flint = pytest.importorskip("flint")
    a = flint.fmpq_mat([[flint.fmpq(F(x).numerator, F(x).denominator) for x in row] for row in m])
    p, j = secant.jordan_form(m).flint()
    assert a * p == p * j and p.det() != 0


def test_over_a_field():
    found = secant.spectrum([["sqrt(2)", 1, 0], [0, "sqrt(2)", 0], [0, 1, "1/2"]])
    p, j = found.jordan_form().sympy()
    a = sympy.Matrix([[sympy.sqrt(2), 1, 0], [0, sympy.sqrt(2), 0], [0, 1, sympy.Rational(1, 2)]])
    assert all(sympy.simplify(x) == 0 for x in a * p - p * j) and sympy.simplify(p.det()) != 0
    with pytest.raises(secant.InputError, match="field"):
        found.jordan_form().rational


def test_left_chains():
    found = secant.spectrum([[3, 1], [-1, 1]])
    (value, (v, w)), a = found.left_chains[0], sympy.Matrix([[3, 1], [-1, 1]])
    row = sympy.Matrix([[sympy.Rational(x.numerator, x.denominator) for x in v]])
    assert value == 2 and row * a == 2 * row and len(w) == 2


def test_algebraic_numbers():
    golden, other = (e.value for e in secant.spectrum([[1, 1], [1, 0]]).eigenvalues)
    assert float(golden) == (1 + 5**0.5) / 2 and golden != other and golden == golden.generator
    assert golden.minimal_polynomial == (-1, -1, 1) and golden.is_real and hash(golden) != hash(other)
    low, high = golden.enclosure(200)[0]
    assert low < high and high - low < F(1, 2**190) and low**2 - low - 1 < 0 < high**2 - high - 1
    i = next(e.value for e in secant.spectrum([[0, -1], [1, 0]]).eigenvalues)
    assert abs(complex(i)) == 1 and not i.is_real and i.sympy() ** 2 == -1
    with pytest.raises(TypeError):
        float(i)
    import pickle

    assert pickle.loads(pickle.dumps(golden)) == golden
    with pytest.raises(secant.InputError):
        secant.Algebraic(["1", "0", "-1", "0"], 0, ["0", "1"]).minimal_polynomial
    with pytest.raises(secant.InputError):
        secant.Algebraic(["-2", "0", "1"], 7, ["0", "1"]).minimal_polynomial


def test_notebooks_show_the_results(cases):
    shown = secant.spectrum([[1, 1], [1, 0]])._repr_html_()
    assert shown.count("<tr>") == 3 and "1.61803" in shown
    assert "0" in secant.jsr([[[1, 1], [0, 1]], [[1, 0], [1, 1]]])._repr_html_()
    assert "exponent" in secant.regularity("four-point")._repr_html_()
    assert "<pre>" in secant.solve(cases / "solve" / "chaikin.toml")._repr_html_()


def test_classes():
    found = secant.spectrum([[0, 1, 0], [0, 0, 1], [1, 0, 0]])
    assert [len(c) for c in found.classes] == [3] and found.certificate.check()
    assert found.eigenvalues[0].modulus[0] <= 1 <= found.eigenvalues[0].modulus[1]


def test_operators_of_a_case(cases):
    path = cases / "thesis" / "half-tangent.toml"
    assert len(secant.spectra(path)) == 2
    with pytest.raises(secant.InputError, match="2 operators"):
        secant.spectrum(path)
    assert secant.spectra(path)[0].certificate.check()


def test_radii(tmp_path):
    found = secant.jsr([[[1, 1], [0, 1]], [[1, 0], [1, 1]]])
    assert found.exact and found.word == (0, 1) and found.lower <= F("1.6180339887498948485") <= found.upper
    assert found.certificate.check() and found.growth == "bounded"
    assert secant.jsr([[[F(1, 2)]], [[F(1, 3)]]]).rational == F(1, 2)
    path = tmp_path / "pair.toml"
    path.write_text("matrices = [[[1, 1], [0, 1]], [[1, 0], [1, 1]]]\n")
    assert secant.jsr(path).data["word"] == found.data["word"]
    for bad in ({"longest": 0}, {"width": 2}, {"seconds": -1}):
        with pytest.raises(secant.InputError):
            secant.jsr([[[1]]], **bad)
    for bad in ([], [[[1, 2]]], [[[1]], [[1, 0], [0, 1]]], 5, {}):
        with pytest.raises(secant.InputError):
            secant.jsr(bad)


def test_regularity(cases):
    assert secant.regularity("four-point w=1/16").exponent == (2, 2)
    assert secant.regularity("1/4,3/4,3/4,1/4").smoothness == 1
    assert secant.regularity(cases / "classical" / "takagi.toml").kind == "curve"
    assert secant.regularity({"name": "q", "scheme": {"mask": ["1/2", 1, "1/2"]}}).exponent == (1, 1)
    with pytest.raises(secant.InputError):
        secant.regularity("no-such-scheme")


def test_strategies():
    hypothesis = pytest.importorskip("hypothesis")
    from secant import strategies

    @hypothesis.settings(max_examples=40, deadline=None)
    @hypothesis.given(strategies.jordan_matrices())
    def blocks_are_found(planted):
        matrix, blocks = planted
        assert {e.value: list(e.blocks) for e in secant.spectrum(matrix).eigenvalues} == blocks

    @hypothesis.settings(max_examples=40, deadline=None)
    @hypothesis.given(strategies.stochastic_matrices())
    def one_is_the_largest(matrix):
        found = secant.spectrum(matrix)
        assert any(e.value == 1 and set(e.blocks) == {1} for e in found.classes[0])
        assert all(e.modulus[0] <= 1 for e in found.eigenvalues)

    @hypothesis.settings(max_examples=40, deadline=None)
    @hypothesis.given(strategies.masks())
    def sum_rules_are_counted(mask):
        assert secant.regularity(mask).data["sum_rules"] >= 1

    blocks_are_found()
    one_is_the_largest()
    sum_rules_are_counted()
