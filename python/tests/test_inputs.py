import math
import pickle
import signal
import subprocess
import sys
import threading
import time
from decimal import Decimal
from fractions import Fraction as F

import pytest

import secant

np = pytest.importorskip("numpy")
sympy = pytest.importorskip("sympy")
HALF = [[0.5, 0.5], [0.5, 0.5]]


@pytest.mark.parametrize("ask", [
    lambda: secant.spectrum(np.array(HALF)), lambda: secant.spectrum(HALF), lambda: secant.jsr([HALF]),
    lambda: secant.certify([0.25, 0.75, 0.75, 0.25]), lambda: secant.regularity(np.array([0.25, 0.75, 0.75, 0.25])),
    lambda: secant.certify({"scheme": {"mask": [0.25, 0.75, 0.75, 0.25]}}),
])
def test_floats_are_refused_unless_it_is_said_how(ask):
    with pytest.raises(secant.InputError, match="float") as caught:
        ask()
    assert 'exact="decimal"' in caught.value.help and isinstance(caught.value, ValueError)


def test_floats_are_made_exact():
    tenths = np.array([[0.1, 0.0], [0.0, 1.0]])
    assert secant.spectrum(tenths, exact="decimal").eigenvalues[1].value == F(1, 10)
    assert secant.spectrum(tenths, exact="binary").eigenvalues[1].value == F(0.1)
    assert secant.spectrum(tenths.astype(np.float32), exact="decimal").eigenvalues[1].value == F(1, 10)
    assert secant.certify([0.25, 0.75, 0.75, 0.25], exact="decimal").proved
    with pytest.raises(secant.InputError, match="exact is"):
        secant.spectrum(tenths, exact="roughly")


@pytest.mark.parametrize("bad", [math.nan, math.inf, np.nan, 1j, np.complex128(1), None, object(), b"1", True, np.True_,
                                 Decimal("NaN"), sympy.I, sympy.Symbol("x"), sympy.oo, "", "nan", "1/0", "1 2", "1]", "x",
                                 "1, 2", "1\n2", "2;", "__import__", "é", "\x00", [], {}])
def test_what_is_no_number(bad):
    for exact in (None, "decimal"):
        with pytest.raises(secant.InputError):
            secant.spectrum([[bad, 0], [0, 1]], exact=exact)
        with pytest.raises(secant.InputError):
            secant.jsr([[[bad, 0], [0, 1]]], exact=exact)
        with pytest.raises(secant.InputError):
            secant.certify([bad, 1, 1, bad], exact=exact)


@pytest.mark.parametrize("bad", [[], [[]], [[], []], [[1, 2]], [[1], [1, 2]], np.array(1), np.array([1, 2]), np.zeros((0, 0)),
                                 np.zeros((2, 2, 2), int), sympy.zeros(2, 3), 7, None, [1, 2], np.zeros((2, 3), int)])
def test_wrong_shapes(bad):
    with pytest.raises(secant.SecantError):
        secant.spectrum(bad)


@pytest.mark.parametrize("bad", [[], {}, None, 3, np.array(3), np.zeros((2, 2), int), "", " ", "no such scheme", "\n", "x = 1\n",
                                 b"four-point", {"name": 3}, {1: 2}, {"name": "a", "pieces": 5}, object(), "\x00", "\ud800\n",
                                 [[[1]]], {"scheme": {"name": "four-point", "w": "?"}}])
def test_wrong_cases(bad):
    with pytest.raises(secant.SecantError):
        secant.certify(bad)


def test_numbers_of_all_kinds():
    flint = pytest.importorskip("flint")
    expected = secant.spectrum([["1/2", 1], [0, 3]]).blocks
    for m in [[[F(1, 2), 1], [0, 3]], [[Decimal("0.5"), 1], [0, 3]], sympy.Matrix([[sympy.Rational(1, 2), 1], [0, 3]]),
              np.array([[F(1, 2), 1], [0, 3]], dtype=object), [[np.int64(1) * F(1, 2), np.int8(1)], [0, np.uint64(3)]],
              flint.fmpq_mat([[flint.fmpq(1, 2), 1], [0, 3]]), ((F(1, 2), 1), (0, 3)), [np.array([F(1, 2), 1]), [0, 3]],
              sympy.ImmutableMatrix([[sympy.Rational(1, 2), 1], [0, 3]])]:
        assert secant.spectrum(m).blocks == expected
    huge = 10**3000 + 1
    assert secant.spectrum([[huge]]).eigenvalues[0].value == huge
    assert secant.spectrum(np.array([[2**63 - 1, 0], [0, -(2**63)]])).eigenvalues[0].value == -(2**63)
    with pytest.raises(secant.SecantError):
        secant.certify({"name": "long", "scheme": {"mask": ["1" * 20000, 1]}})


def test_paths(tmp_path):
    path = tmp_path / "fälle 中文" / "a'b.toml"
    path.parent.mkdir()
    path.write_text('name = "a"\ntitle = "ü\\u0001"\n[scheme]\nmask = ["1/4", "3/4", "3/4", "1/4"]\n', encoding="utf-8")
    assert secant.certify(path).proved and secant.certify(str(path)).proved
    path.write_text('name = "a"\n\n[scheme]\nmask = ["1/4", "3/4", "3/4", "1/3"]\n')
    with pytest.raises(secant.InputError) as caught:
        secant.certify(path)
    error = caught.value
    assert error.line == 4 and error.file == str(path) and error.help and str(path) in str(error)
    copy = pickle.loads(pickle.dumps(error))
    assert type(copy) is secant.InputError and copy.to_dict() == error.to_dict()
    for missing in (tmp_path / "none.toml", tmp_path):
        with pytest.raises(secant.InputError):
            secant.certify(missing)
    (tmp_path / "latin.toml").write_bytes(b"name = \"\xff\"\n")
    with pytest.raises(secant.InputError):
        secant.certify(tmp_path / "latin.toml")


def test_wavelets():
    pywt = pytest.importorskip("pywt")
    low, high = secant.regularity(pywt.Wavelet("db2")).exponent
    assert low <= F("0.5500156865235") <= high
    spline = secant.regularity(pywt.Wavelet("bior2.2"))
    assert spline.exponent == (1, 1) and spline.data["mask"] == ["1/2", "1", "1/2"]
    assert secant.certify(pywt.Wavelet("bior2.2")).verdict == "refuted" or secant.certify(pywt.Wavelet("bior3.1")).proved
    with pytest.raises(secant.InputError, match="float"):
        secant.regularity(pywt.Wavelet("sym5"))
    assert secant.regularity(pywt.Wavelet("sym5"), exact="decimal").decided
    bank = pywt.Wavelet("db3").filter_bank
    disguised = pywt.Wavelet("db2", filter_bank=bank)
    with pytest.raises(secant.InputError, match="float"):
        secant.regularity(disguised)


def test_radicals_of_sympy():
    m = sympy.Matrix([[(1 + sympy.sqrt(5)) / 4, sympy.Rational(1, 4)], [0, sympy.Rational(1, 2)]])
    values = {e.value for e in secant.spectrum(m).eigenvalues}
    assert F(1, 2) in values and len(values) == 2
    golden = next(v for v in values if isinstance(v, secant.Algebraic))
    assert sympy.simplify(golden.sympy() - m[0, 0]) == 0
    assert golden == secant.spectrum([["(1 + sqrt(5))/4"]]).eigenvalues[0].value
    assert secant.spectrum([[golden, 0], [0, 1]]).eigenvalues[1].value == golden
    with pytest.raises(secant.InputError):
        secant.spectrum([["1 2"], ["3 4"]])
    cosine = sympy.Matrix([[sympy.cos(2 * sympy.pi / 7)]])
    assert float(secant.spectrum(cosine).eigenvalues[0].value) == pytest.approx(math.cos(2 * math.pi / 7))


SLOW = """
import secant, time
print("ready", flush=True)
started = time.time()
try:
    secant.certify({"name": "long", "vertex": {"mesh": "sqrt3", "valence": "3..250"}})
except KeyboardInterrupt:
    print("interrupted", flush=True)
    time.sleep(3)
    before = time.process_time()
    time.sleep(1)
    assert time.process_time() - before < 0.5, "the work goes on"
    print(time.time() - started < 60, secant.spectrum([[1, 1], [1, 0]]).size)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="signals")
def test_ctrl_c():
    child = subprocess.Popen([sys.executable, "-c", SLOW], stdout=subprocess.PIPE, text=True)
    assert child.stdout.readline() == "ready\n"
    time.sleep(1.5)
    child.send_signal(signal.SIGINT)
    out, _ = child.communicate(timeout=60)
    assert out.startswith("interrupted") and out.endswith("True 2\n") and child.returncode == 0


def test_other_threads_go_on():
    counted, done = [0], threading.Event()

    def count():
        while not done.is_set():
            counted[0] += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    started = time.perf_counter()
    n = 60
    secant.spectrum([[F((i * j * 7 + i) % 11, 1 + (i + j) % 7) for j in range(n)] for i in range(n)])
    elapsed = time.perf_counter() - started
    done.set()
    thread.join()
    assert counted[0] > 50 * elapsed


def test_threads_agree():
    from concurrent.futures import ThreadPoolExecutor

    with ThreadPoolExecutor(8) as pool:
        found = list(pool.map(lambda w: secant.certify([f"1/{w}", f"{w - 1}/{w}", f"{w - 1}/{w}", f"1/{w}"]).to_dict(), [3, 4, 5] * 8))
    assert all(found[k] == found[k % 3] for k in range(24))
