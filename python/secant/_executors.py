"""Executors of frameworks that have none of their own with the interface of ``concurrent.futures``."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Executor, Future
from typing import Any


class RayExecutor(Executor):
    """Tasks of Ray as an executor, for :func:`secant.sweep`.

    A task whose worker dies is started again by Ray.

    Parameters
    ----------
    **options
        Those of ``ray.remote``, such as ``num_cpus`` or ``max_retries``.

    Examples
    --------
    >>> import secant
    >>> executor = secant.RayExecutor(num_cpus=1)  # doctest: +SKIP
    >>> table = secant.sweep("four-point", {"w": ["1/16"]}, executor=executor)  # doctest: +SKIP
    """

    def __init__(self, **options: Any) -> None:
        import ray

        if not ray.is_initialized():
            ray.init()
        self._options = options
        self._tasks: dict[Callable[..., Any], Any] = {}

    @property
    def max_workers(self) -> int:
        """The processors of the cluster."""
        import ray

        return max(1, int(ray.cluster_resources().get("CPU", 1)))

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Starts a task."""
        import ray

        if fn not in self._tasks:
            self._tasks[fn] = ray.remote(**self._options)(fn) if self._options else ray.remote(fn)
        future: Future[Any] = self._tasks[fn].remote(*args, **kwargs).future()
        return future


__all__ = ["RayExecutor"]
