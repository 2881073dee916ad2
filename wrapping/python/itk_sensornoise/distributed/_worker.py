# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tasks of one pass on a worker, which fill sums with a part of the frames, and merge them."""

import threading
from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from .._sums import SensorNoiseSums, names_of

# One run at a time has its state here, and one task at a time works on the state. The task itself uses threads.
_LOCK = threading.RLock()
_STATE: dict[str, SensorNoiseSums] = {}

# Dask may begin a task after its run has ended; no task waits for that many runs. Chosen empirically: half and twice
# as many differ by some kB.
_OVER: deque[str] = deque(maxlen=256)
_STATE_LOCK = threading.Lock()  # protects _STATE and _OVER; held only while they are read or changed


@dataclass
class Part:
    """Sums of a part of the frames. `frames`: numbers of the frames; `fingerprints`: their fingerprints (frames,
    planes, 16), in pass 1 only; `sums`: SensorNoiseSums.to_bytes(), None if two merged parts counted equal frames."""

    frames: np.ndarray
    fingerprints: np.ndarray | None
    sums: np.ndarray | None

    def without_sums(self) -> "Part":
        return Part(self.frames, self.fingerprints, None if self.sums is None else np.empty(0, np.uint8))


def _state(run: str, start: dict[str, Any], ended: Sequence[Part]) -> SensorNoiseSums:
    """Returns the empty sums of a run in the pass after the `ended` passes. Sums of other runs and of earlier passes
    are deleted. Raises RuntimeError if the run has ended."""
    sums = _STATE.get(run)
    if sums is None or sums.passes_ended > len(ended):
        with _STATE_LOCK:
            _require_going(run)  # else the state belongs to a run at work
            _STATE.clear()
        sums = SensorNoiseSums(**{"threads": _threads(), **start})
        sums.drop_history()
        with _STATE_LOCK:
            _require_going(run)  # it may have ended meanwhile
            _STATE[run] = sums
    sums.forget()
    try:
        for part in ended[sums.passes_ended :]:
            sums.merge(part.sums)  # type: ignore[arg-type]  # merged without a conflict
            sums.end_pass()
    except BaseException:
        _STATE.clear()  # half of a pass is none
        raise
    return sums


def _require_going(run: str) -> None:
    """Raises RuntimeError if the run is over. To be called with _STATE_LOCK."""
    if run in _OVER:
        raise RuntimeError(f"{run} is over: nobody waits for this task")


def _threads() -> int:
    """Returns the number of threads of this worker of Dask; other workers of the machine have their own."""
    from distributed import get_worker

    return max(1, int(get_worker().state.nthreads))


def fill(
    run: str,
    start: dict[str, Any],
    ended: Sequence[Part],
    frames: Any,
    span: tuple[int, int],
    frame_range: tuple[int, int] | None,
    flags: np.ndarray | None,
) -> Part:
    """Returns the sums of the frames of a span, (first, end). `frame_range` selects these frames of `frames`; `flags`
    are for SensorNoiseSums.leave(). Raises ValueError if a frame is missing."""
    with _LOCK:
        sums = _state(run, start, ended)
        if sums.passes_ended == 0 and flags is not None:
            sums.leave(flags)
        sums.add(frames, span[0], frame_range=frame_range)
        missing = np.arange(span[0] + len(sums.frames), span[1])
        if missing.size:
            raise ValueError(
                f"{names_of(missing)} missing in pass {len(ended) + 1}: the part that should hold frames {span[0]} to "
                f"{span[1] - 1} has {len(sums.frames)}"
            )
        return _part(sums)


def merge(run: str, start: dict[str, Any], ended: Sequence[Part], parts: Sequence[Part]) -> Part:
    """Returns the sums of several parts, merged in their order."""
    frames = np.concatenate([part.frames for part in parts])
    if any(part.sums is None for part in parts):
        return Part(frames, None, None)
    with _LOCK:
        sums = _state(run, start, ended)
        try:
            for part in parts:
                sums.merge(part.sums)  # type: ignore[arg-type]  # checked above
        except RuntimeError as error:
            if " equals frame " not in str(error):
                raise
            return Part(frames, None, None)  # the driver sees it, too
        return _part(sums)


async def forget(run: str) -> None:
    """Releases the memory of a run. Dask's client does not wait for this coroutine. It runs beside the tasks without
    their lock; a task at work keeps its sums."""
    with _STATE_LOCK:
        _OVER.append(run)
        _STATE.pop(run, None)


def same(value: Any) -> Any:
    """Returns the value unchanged."""
    return value


def look(part: Part) -> Part:
    """Returns the summary of a part for the driver."""
    return part.without_sums()


def _part(sums: SensorNoiseSums) -> Part:
    fingerprints = sums.fingerprints if sums.passes_ended == 0 else None
    return Part(sums.frames, fingerprints, sums._array())
