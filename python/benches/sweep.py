"""A large sweep on a local Dask cluster of two workers, one of them killed: `python sweep.py COUNT FOLDER`.

Prints the overhead for each case, the memory of all processes on the way, and whether the kept results are whole.
"""

import os
import signal
import sys
import time
from fractions import Fraction

import psutil
from dask.distributed import Client, LocalCluster

import secant


def segment(w):
    """A segment with unequal parts: one of the cheapest cases there are, so that all that is not proving weighs the most."""
    v = 1 - w
    return {"name": "segment", "convention": "columns", "pieces": [[[1, v], [0, w]], [[v, 0], [w, 1]]]}


def values(count):
    """Different divisions, from a generator."""
    return (Fraction(1, 4) + Fraction(k, 2 * count) for k in range(count))


def megabytes():
    """The memory of this process and of those that it has started, such as are no helpers."""
    own = psutil.Process()
    found = []
    for process in [own, *own.children(recursive=True)]:
        try:
            found.append(process.memory_info().rss / 2**20)
        except psutil.NoSuchProcess:
            continue
    return " ".join(f"{x:.0f}" for x in found if x > 30)


def main(count, folder):
    alone = time.process_time()
    sample = [secant.certify(segment(w)) for w in values(200)]
    alone = (time.process_time() - alone) / len(sample)
    print(f"certify, one process: {1000 * alone:.2f} ms of processor time for each case", flush=True)
    cluster = LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None)
    with cluster, Client(cluster) as client:
        pids = list(client.run(os.getpid).values())
        started, work, kinds = time.perf_counter(), 0.0, {}
        for k, row in enumerate(secant.iter_sweep(segment, {"w": values(count)}, executor=client.get_executor(), folder=folder)):
            assert row.index == k and row.error is None, row
            work += row.seconds
            kinds[row.verdict.value] = kinds.get(row.verdict.value, 0) + 1
            if k == count // 3:
                os.kill(pids[0], signal.SIGKILL)
                print("killed a worker", flush=True)
            if k % max(1, count // 10) == count // 20:
                print(f"{k + 1:7} rows, {time.perf_counter() - started:6.1f} s; MB of the main process and the workers: {megabytes()}", flush=True)
        wall = time.perf_counter() - started
    print(f"{count} cases {kinds}: {wall:.1f} s, of which the cases take {work:.1f} s on the workers; {1000 * wall / count:.2f} ms for each case")
    size = sum(f.stat().st_size for f in secant.Folder(folder).path.glob("*.jsonl"))
    found = len(secant.Folder(folder).places())
    print(f"{found} results are kept in {size / 2**20:.0f} MB")
    assert found == count


if __name__ == "__main__":
    main(int(sys.argv[1]), sys.argv[2])
