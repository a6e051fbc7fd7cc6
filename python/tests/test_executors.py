"""Executors of clusters, where their packages are installed (`pip install secant[clusters]`)."""

import importlib.util
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

COMMON = """
import os, sys
from fractions import Fraction as F
import secant

def cut(w):
    v = 1 - w
    pieces = [[[v, w, 0], [w, v, v], [0, 0, w]], [[w, 0, 0], [v, v, w], [0, w, v]]]
    return {"name": "cut", "convention": "columns", "pieces": pieces}

values = [F(k, 1000) for k in range(100, 220)]

def swept(executor):
    rows = list(secant.iter_sweep(cut, {"w": values}, executor=executor, folder=sys.argv[1], chunk=5))
    assert [row.index for row in rows] == list(range(len(values))) and not any(row.error for row in rows)
    alone = list(secant.iter_sweep(cut, {"w": values}, workers=0, folder=sys.argv[1]))
    assert all(row.kept for row in alone) and [r.verdict for r in alone] == [r.verdict for r in rows]
    print("all there", len(rows), flush=True)
"""

RAY = COMMON + """
import ray
if __name__ == "__main__":
    ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False)
    executor = secant.RayExecutor(num_cpus=1)
    assert executor.max_workers == 2
    try:
        swept(executor)
    finally:
        ray.shutdown()
"""

MPI = COMMON + """
from mpi4py.futures import MPIPoolExecutor
if __name__ == "__main__":
    with MPIPoolExecutor(max_workers=2) as executor:
        swept(executor)
"""


def ran(tmp_path, script, *command):
    path = tmp_path / "script.py"
    path.write_text(script)
    environment = {**os.environ, "RAY_USAGE_STATS_ENABLED": "0"}
    done = subprocess.run(
        [*command, path, tmp_path / "kept"], capture_output=True, text=True, timeout=240, cwd=tmp_path, env=environment
    )
    assert done.returncode == 0 and "all there 120" in done.stdout, done.stderr[-4000:] + done.stdout[-2000:]


@pytest.mark.skipif(not importlib.util.find_spec("ray"), reason="Ray is not installed")
def test_ray(tmp_path):
    ran(tmp_path, RAY, sys.executable)


@pytest.mark.skipif(not importlib.util.find_spec("mpi4py"), reason="mpi4py is not installed")
def test_mpi(tmp_path):
    beside = Path(sys.executable).parent / "mpiexec"
    launcher = str(beside) if beside.exists() else shutil.which("mpiexec")
    if launcher is None:
        pytest.skip("there is no mpiexec")
    ran(tmp_path, MPI, launcher, "-n", "3", sys.executable, "-m", "mpi4py.futures")
