import os
import signal
import subprocess
import sys
import time
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from fractions import Fraction as F

import pytest

import secant

# Corner cutting, a few milliseconds each.
CASE = """
name = "cut"
convention = "columns"
pieces = [
  [["?v", "?w", 0], ["?w", "?v", "?v"], [0, 0, "?w"]],
  [["?w", 0, 0], ["?v", "?v", "?w"], [0, "?w", "?v"]],
]
"""


def cut(w):
    """The case as a function of its parameter."""
    return CASE.replace("?w", str(w)).replace("?v", str(1 - w))


VALUES = [F(k, 100) for k in range(10, 50)]


@pytest.fixture(scope="module")
def expected():
    return [secant.certify(cut(w)).verdict.value for w in VALUES]


def verdicts(table):
    return list(table["verdict"]) if hasattr(table, "columns") else [row["verdict"] for row in table]


def test_in_this_process(expected):
    table = secant.sweep(cut, {"w": VALUES}, workers=0)
    assert verdicts(table) == expected and list(table["w"]) == VALUES and all(table["checked"])


@pytest.mark.parametrize("pool", [lambda: ThreadPoolExecutor(2), lambda: ProcessPoolExecutor(2)])
def test_executors(pool, expected):
    with pool() as executor:
        assert verdicts(secant.sweep(cut, {"w": iter(VALUES)}, executor=executor, chunk=3)) == expected


def test_what_is_swept():
    function = secant.sweep(lambda a, b: [F(a, 4), F(b, 4), F(b, 4), F(a, 4)], {"a": [1, 2], "b": [3, 2]}, workers=0)
    assert list(zip(function["a"], function["b"])) == [(1, 3), (1, 2), (2, 3), (2, 2)]
    assert [isinstance(e, str) for e in function["error"]] == [False, True, True, False]
    product = secant.sweep(CASE, {"v": [F(3, 4), F(2, 3)], "w": [F(1, 4)]}, workers=0)
    assert verdicts(product)[0] == "proved" and "sum" in product["error"][1]
    text = 'name = "four-point"\n[scheme]\nname = "four-point"\n'
    assert verdicts(secant.sweep(text, {"w": ["1/16"]}, workers=0)) == ["proved"]
    masks = secant.sweep([["1/4", "3/4", "3/4", "1/4"], "1,1", [0.5, 0.5]], workers=0)
    assert not isinstance(masks["error"][0], str) and "float" in masks["error"][2]
    for wrong in (lambda: secant.sweep("four-point", workers=0), lambda: secant.sweep("four-point", {}, workers=0),
                  lambda: secant.sweep({"name": "a", "pieces": []}, {"w": [1]}, workers=0)):
        with pytest.raises(secant.InputError):
            wrong()
    with pytest.raises(TypeError):
        secant.sweep(cut, {"w": VALUES}, workers=0, nonsense=1)


def test_files(cases):
    paths = sorted((cases / "classical").glob("*.toml"))
    rows = list(secant.iter_sweep(paths, workers=2))
    assert [row.index for row in rows] == list(range(len(paths)))
    assert [row.verdict for row in rows] == [secant.certify(p).verdict for p in paths]
    assert all(row.result.certificate.check() for row in rows if row.result.checked)


def test_it_is_resumed(tmp_path, expected, monkeypatch):
    first = list(secant.iter_sweep(cut, {"w": VALUES[:15]}, workers=0, folder=tmp_path))
    assert not any(row.kept for row in first)
    table = secant.sweep(cut, {"w": VALUES}, workers=2, folder=tmp_path)
    assert verdicts(table) == expected and list(table["kept"]) == [k < 15 for k in range(len(VALUES))]
    assert len(list(secant.Folder(tmp_path).results(recheck=True))) == len(VALUES)
    again = secant.sweep(cut, {"w": VALUES}, workers=0, folder=tmp_path)
    assert all(again["kept"]) and list(again["certificate"]) == list(table["certificate"])
    other = secant.sweep(cut, {"w": VALUES[:2]}, workers=0, folder=tmp_path, effort="quick")
    assert not any(other["kept"])


def test_a_folder_is_not_believed(tmp_path, expected):
    secant.sweep(cut, {"w": VALUES[:3]}, workers=0, folder=tmp_path)
    (path,) = tmp_path.glob("*.jsonl")
    lines = path.read_text().splitlines(keepends=True)
    forged = lines[0].replace('"verdict": "proved"', '"verdict": "refuted"')
    assert forged != lines[0]
    # A forged line, a whole one, and one that a dying process left half-written.
    path.write_text(forged + lines[1] + lines[2][: len(lines[2]) // 2])
    table = secant.sweep(cut, {"w": VALUES[:3]}, workers=0, folder=tmp_path)
    assert list(table["kept"]) == [False, True, False] and verdicts(table) == expected[:3]


def test_own_workers_are_replaced(tmp_path, expected):
    from secant import _sweep

    found, killed = [], False
    pools = []
    original = _sweep._Own.__init__

    def remember(self, workers):
        original(self, workers)
        pools.append(self)

    _sweep._Own.__init__ = remember
    try:
        for row in secant.iter_sweep(cut, {"w": VALUES}, workers=2, folder=tmp_path, chunk=2):
            found.append(row)
            if len(found) == 3:
                os.kill(next(iter(pools[0].pool._processes)), signal.SIGKILL)
                killed = True
    finally:
        _sweep._Own.__init__ = original
    assert killed and [row.verdict for row in found] == expected
    assert [row.index for row in found] == list(range(len(VALUES)))


def test_a_strange_pool_that_breaks_says_so(tmp_path):
    with ProcessPoolExecutor(1) as pool:
        rows = secant.iter_sweep(cut, {"w": VALUES}, executor=pool, chunk=1, folder=tmp_path)
        next(rows)
        os.kill(next(iter(pool._processes)), signal.SIGKILL)
        with pytest.raises(BrokenProcessPool):
            list(rows)
    assert any(secant.sweep(cut, {"w": VALUES}, workers=0, folder=tmp_path)["kept"])


DASK = """
import os, signal, sys, threading, time
from fractions import Fraction as F
import secant
from dask.distributed import Client, LocalCluster

def cut(w):
    v = 1 - w
    pieces = [[[v, w, 0], [w, v, v], [0, 0, w]], [[w, 0, 0], [v, v, w], [0, w, v]]]
    return {"name": "cut", "convention": "columns", "pieces": pieces}

if __name__ == "__main__":
    folder = sys.argv[1]
    values = [F(k, 1000) for k in range(50, 450)]
    with LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as cluster, Client(cluster) as client:
        pids = list(client.run(os.getpid).values())
        found, before = [], None
        for row in secant.iter_sweep(cut, {"w": values}, executor=client.get_executor(), folder=folder, chunk=5):
            found.append(row)
            if len(found) == 40:
                os.kill(pids[0], signal.SIGKILL)
        assert [row.index for row in found] == list(range(400)), "order"
        assert not any(row.error for row in found)
        after = list(client.run(os.getpid).values())
        assert pids[0] not in after
    alone = list(secant.iter_sweep(cut, {"w": values}, workers=0, folder=folder))
    assert all(row.kept for row in alone), "finished results are lost"
    assert [row.verdict for row in alone] == [row.verdict for row in found]
    print("all there", len(found))
"""


def test_dask_with_a_worker_killed(tmp_path):
    pytest.importorskip("distributed")
    script = tmp_path / "cluster.py"
    script.write_text(DASK)
    done = subprocess.run(
        [sys.executable, script, tmp_path / "kept"], capture_output=True, text=True, timeout=240, cwd=tmp_path
    )
    assert done.returncode == 0 and "all there 400" in done.stdout, done.stderr[-4000:]


def test_order_with_an_executor_that_answers_late(expected):
    class Late(ThreadPoolExecutor):
        def submit(self, f, *args):
            def slow():
                time.sleep(0.02 * (hash(str(args)) % 3))
                return f(*args)

            return super().submit(slow)

    with Late(4) as pool:
        rows = list(secant.iter_sweep(cut, {"w": VALUES}, executor=pool, chunk=1))
    assert [r.parameters["w"] for r in rows] == VALUES and [r.verdict for r in rows] == expected
