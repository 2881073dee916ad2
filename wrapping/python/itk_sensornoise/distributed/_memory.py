# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""The memory that tasks need, and that Dask lets its workers have."""

from collections.abc import Collection
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from .._sums import CHUNK_BYTES, LEAST_FRAMES

if TYPE_CHECKING:
    import distributed

_MIB = 1 << 20
# Least memory of the process of a worker, measured: documentation/distributed.md. The temporal components of the third
# round need more, and their number is not known before.
_PROCESS_BYTES = 400 * _MIB  # Python, ITK and Dask before the first task [bytes]
_BYTES_PER_PIXEL = {"u": 120, "i": 120, "f": 220}  # sums and what is made of them, by the kind of pixels [bytes]
_BYTES_PER_FRAME = 20_000  # bytes for each frame of the whole stack


class WorkerState(NamedTuple):
    """State of a worker, as the scheduler knows it."""

    address: str
    limit: int  # memory_limit of the worker [bytes]; 0: none
    memory: int  # memory of the process [bytes]
    is_paused: bool  # begins no task, as its memory is near the limit
    is_busy: bool  # a task runs, or data is on its way to one


def worker_states(client: "distributed.Client") -> list[WorkerState]:
    """Returns the states of all workers. Raises OSError if the scheduler does not answer."""
    try:
        known = client.scheduler_info(n_workers=-1)
    except TypeError:  # older than 2025.7, which returns all workers
        known = client.scheduler_info()
    return [_state_of(address, worker) for address, worker in known.get("workers", {}).items()]


def _state_of(address: str, worker: dict[str, Any]) -> WorkerState:
    metrics = worker.get("metrics", {})
    counts = metrics.get("task_counts", {})
    busy = any(counts.get(state, 0) for state in ("executing", "long-running", "flight"))
    paused = worker.get("status") == "paused"
    return WorkerState(address, int(worker.get("memory_limit") or 0), int(metrics.get("memory", 0)), paused, busy)


def need_of_worker(pixels: int, frames: int, dtype: str, block_bytes: int) -> int:
    """Returns the least memory of the process of a worker for estimate_sensor_noise() [bytes]. `pixels`: measured
    pixels of a frame; `frames`: number of all frames; `block_bytes`: argument of a task, 0 if the task reads."""
    of_sums = _BYTES_PER_PIXEL[np.dtype(dtype).kind] * pixels + _BYTES_PER_FRAME * frames
    chunk = max(CHUNK_BYTES, LEAST_FRAMES * pixels * np.dtype(dtype).itemsize)
    return _PROCESS_BYTES + of_sums + max(block_bytes, chunk)


def require_memory(workers: Collection[WorkerState], need: int, of: str) -> None:
    """Raises RuntimeError if a worker would be ended before it has the memory that it needs for a measurement `of`
    something."""
    usable = _fraction("terminate")
    small = [worker for worker in workers if worker.limit and worker.limit * usable < need]
    if small:
        least = min(small, key=lambda worker: worker.limit)
        raise RuntimeError(
            f"{_counted(len(small), len(workers))} too little memory for {of}: {least.address} has a memory_limit of "
            f"{_text(least.limit)} (Dask lets it use {usable:.0%}), and needs at least {_text(need)}; expected "
            f"a memory_limit of {_text(need / usable)} or more (with fewer workers of a machine), or a smaller roi"
        )


def stuck_sentence(workers: Collection[WorkerState], seconds: float) -> str:
    """Returns a sentence that explains why no task runs while workers are paused."""
    paused = [worker for worker in workers if worker.is_paused]
    fullest = max(paused, key=lambda worker: worker.memory)
    return (
        f"Dask paused {len(paused)} of {len(workers)} workers, as their memory is near its limit, and no task ended or "
        f"ran for {seconds:.0f} s: {fullest.address} has {_text(fullest.memory)} of {_text(fullest.limit)}; expected "
        "workers with a larger memory_limit, or without what else they hold (client.restart())"
    )


def memory_of_task(frames: object) -> int | None:
    """Returns the memory that a task of this worker may use for a burst, besides the frames [bytes]; None without a
    limit or a worker. Raises ValueError if no memory is left."""
    from distributed import get_worker

    try:
        worker = get_worker()
    except ValueError:
        return None
    limit = getattr(worker.memory_manager, "memory_limit", None)
    if not limit:
        return None
    usable = _fraction("pause") * int(limit)
    held = int(frames.nbytes) if isinstance(frames, np.ndarray) else 0
    left = (usable - _PROCESS_BYTES) / max(1, worker.state.nthreads) - held
    if left < 1:
        raise ValueError(
            f"the worker has a memory_limit of {_text(int(limit))}, and Dask lets it use {_text(usable)}: too "
            f"little beside {_text(_PROCESS_BYTES)} of Python and ITK and {_text(held)} of frames"
        )
    return int(left)


def _fraction(name: str) -> float:
    """Returns the fraction of memory_limit at which Dask acts on a worker; 1 if never. The fraction is read from the
    configuration of this process."""
    import dask

    return float(dask.config.get(f"distributed.worker.memory.{name}", None) or 1.0)


def _counted(some: int, all_of_them: int) -> str:
    return "the worker has" if all_of_them == 1 else f"{some} of {all_of_them} workers have"


def _text(size: float) -> str:
    return f"{size / _MIB:,.0f} MiB"
