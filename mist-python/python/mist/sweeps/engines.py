"""Engines of sweeps: this process, processes, executors, Dask, Ray."""

from __future__ import annotations

import multiprocessing
from collections.abc import Iterator
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, ProcessPoolExecutor, wait
from typing import Any

import numpy as np

from ..errors import MistError
from .chunk import compute

Span = tuple[int, int]

#: Chunks that wait in an engine per worker: enough to keep it busy, few enough to stop soon.
WAITING = 2


def results(
    engine: Any, text: str, spans: list[Span], retries: int, threads: int
) -> Iterator[tuple[Span, np.ndarray]]:
    """The chunks in the order in which they are finished."""
    if engine is None:
        return ((span, compute(text, *span, threads)) for span in spans)
    if isinstance(engine, int):
        return _processes(engine, text, spans, retries, threads)
    if engine == "ray" or getattr(engine, "__name__", "") == "ray":
        return _ray(text, spans, retries, threads)
    if hasattr(engine, "scheduler_info"):
        return _dask(engine, text, spans, retries, threads)
    if hasattr(engine, "submit"):
        return _executor(engine, text, spans, threads)
    raise TypeError(
        f"a {type(engine).__name__} is not an engine: give None, a number of processes, an executor, "
        "a client of Dask or 'ray'"
    )


def _executor(executor: Any, text: str, spans: list[Span], threads: int, workers: int = 4):
    """Chunks of an executor of :mod:`concurrent.futures`."""
    left = list(reversed(spans))
    running: dict[Any, Span] = {}
    try:
        while left or running:
            while left and len(running) < WAITING * workers:
                span = left.pop()
                running[executor.submit(compute, text, *span, threads)] = span
            for future in wait(running, return_when=FIRST_COMPLETED).done:
                yield running.pop(future), future.result()
    finally:
        for future in running:
            future.cancel()


def _processes(count: int, text: str, spans: list[Span], retries: int, threads: int):
    """Chunks of spawned processes; a lost process begins its chunks again."""
    context = multiprocessing.get_context("spawn")
    left = list(spans)
    for attempt in range(retries + 1):
        with ProcessPoolExecutor(count, mp_context=context) as executor:
            try:
                for span, values in _executor(executor, text, left.copy(), threads, count):
                    left.remove(span)
                    yield span, values
                return
            except BrokenExecutor:
                if attempt == retries:
                    raise


def _dask(client: Any, text: str, spans: list[Span], retries: int, threads: int):
    """Chunks of a Dask cluster; it runs the chunks of lost workers again."""
    from distributed import CancelledError, KilledWorker, as_completed

    workers = max(1, len(client.scheduler_info()["workers"]))
    left = list(reversed(spans))
    running = {}
    tries = dict.fromkeys(spans, 0)
    queue = as_completed()

    def submit(span: Span) -> None:
        tries[span] += 1
        key = f"mist-{hash(text):x}-{span[0]}-{span[1]}-{tries[span]}"
        future = client.submit(compute, text, *span, threads, retries=retries, key=key)
        running[future.key] = span
        queue.add(future)

    while left and len(running) < WAITING * workers:
        submit(left.pop())
    for future in queue:
        span = running.pop(future.key)
        try:
            values = future.result()
        except (CancelledError, KilledWorker):
            # The worker was lost with the finished values.
            if tries[span] > retries:
                raise
            submit(span)
            continue
        yield span, values
        if left:
            submit(left.pop())


def _ray(text: str, spans: list[Span], retries: int, threads: int):
    """Chunks of Ray; it runs the chunks of lost workers again, not those that mist refuses."""
    import ray

    if not ray.is_initialized():
        ray.init(include_dashboard=False, log_to_driver=False)
    task = ray.remote(num_cpus=threads, max_retries=retries)(compute)
    held = ray.put(text)
    running = {task.remote(held, *span, threads): span for span in spans}
    while running:
        (done,), _ = ray.wait(list(running), num_returns=1)
        try:
            values = ray.get(done)
        except ray.exceptions.RayTaskError as error:
            cause = error.cause
            raise cause if isinstance(cause, MistError) else error
        yield running.pop(done), values
