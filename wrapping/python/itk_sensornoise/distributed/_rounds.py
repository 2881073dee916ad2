# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""estimate_sensor_noise() on the workers of Dask: a round for each pass over the frames."""

import contextlib
import logging
import time
import uuid
from dataclasses import dataclass, field, fields
from typing import Any

import numpy as np

from .. import _options
from .._channels import ChannelReports
from .._errors import InvalidTypeError
from .._progress import Bar, bar_of
from .._report import Report
from .._settings import Settings
from .._sums import SensorNoiseSums, names_of
from .._types import Frames, Progress
from . import _worker
from ._dask import require_distributed
from ._memory import need_of_worker, require_memory
from ._parts import Parts, parts_of
from ._watch import Watch, results_of

_LOG = logging.getLogger(__name__)
_FAN = 8  # sums that a task merges


def estimate_sensor_noise(
    frames: Frames,
    client: Any = None,
    *,
    frames_per_task: int | None = None,
    dark: Frames | None = None,
    raw: str | None = None,
    maps: bool = False,
    progress: Progress = False,
    **settings: Any,
) -> Report | ChannelReports:
    """Measures as itk.estimate_sensor_noise(), on the workers of a Dask cluster: for frames that lie on several
    machines, or are more than one can read in time. Below some 10 GB one machine is faster.

    The workers go over the frames in three rounds. A task reads its frames where they lie and returns the sums over
    them; tasks merge these, eight at a time, on the workers; the driver gets the merged sums alone, never a frame, and
    makes the report. After each round every worker fetches the merged sums, from each other: after the first 20 bytes a
    pixel (floating point: 32), after the second 16 kB a frame, after the third nothing. With 4 megapixels and 400
    frames these are 84 MB and 7 MB. They also are what tasks return, and in the third round 8 bytes a pixel and series
    (4 to 20); "published" has less. A worker process needs at least 400 MiB, 120 bytes a pixel (floating point: 220),
    20 kB a frame of the whole, and 64 MiB or a task's block of dask's array, and in the third round up to six times the
    sums that a task returns there. It works on one task at a time, with as many threads as it has.

    With integer pixels the report has the bits of one process, whatever is read by whom. With floating point it is
    equal to rounding, and has the same bits for the same `frames_per_task`, in whatever order tasks end. The sums of a
    worker that ends are made again. Where equal frames lie in different tasks, or frames are unlike the others, the
    first round is gone through again.

    Parameters
    ----------
    frames
        A dask array (t, y, x), a list of file names, the name of one stack, or an object with shape, dtype and slices
        along time that can be pickled. Blocks of a dask array are computed three times, where they lie. All workers
        must be able to read the files. An object that is passed by value, as a NumPy array, goes to every task.
    client
        A dask.distributed.Client. Default: the current one.
    frames_per_task
        Frames that a task reads. Default: two tasks a worker, of 8 frames or more; of a dask array at most 512 MiB.
    dark, raw
        As itk.estimate_sensor_noise() has them. Every worker reads the dark frames.
    maps
        True: arrays of what is known of every pixel, as itk.estimate_sensor_noise(maps=True).
    progress
        As estimate_sensor_noise() of one machine has it.
    settings
        method, offset, bayer, bit_depth, clip, step, level_range, exposures, excess_noise_factor, rolling_shutter,
        shutter_axis, level, quantiles, roi, mask, frame_range and threads (of a worker; default: those that Dask gave
        it): as itk.estimate_sensor_noise(). For bayer="auto" the driver looks at the first frame. There is no `hash`:
        of all frames, one after the other, it is no work for several.

    Raises
    ------
    ImportError
        Dask's `distributed` is not installed.
    TypeError
        A wrong type, or an unknown keyword.
    ValueError
        A wrong value; no client; a frame that no task brought, by its number.
    RuntimeError
        An error of ITK; a worker whose memory_limit is below its need; workers that ended again and again over one
        task, or that Dask paused so that no task goes on for 30 s. A scheduler that went away or was restarted.
        Exceptions of reading frames on a worker are raised unchanged.
    """
    distributed = require_distributed()
    if client is None:
        try:
            client = distributed.default_client()
        except ValueError:
            raise ValueError(
                "there is no client of Dask; expected one, dask.distributed.Client(); on one machine "
                "itk.estimate_sensor_noise() needs none"
            ) from None
    maps = _options.true_or_false("maps", maps)
    _require_settings(settings)
    checked = Settings(**settings)
    checked.check(dark)
    if frames_per_task is not None:
        frames_per_task = _options.integer("frames_per_task", frames_per_task, 1, 1 << 22)
    parts = parts_of(frames, raw, checked.span)
    is_open = checked.bayer == "auto" and "SensorNoise.BayerPattern" not in parts.metadata
    sums = SensorNoiseSums(
        parts.shape,
        parts.dtype,
        first_frame=parts.first_frame(raw) if is_open else None,
        dark=dark,
        raw=raw,
        metadata=parts.metadata,
        **settings,
    )
    sums.drop_history()
    run = _Run.of(client, parts, sums, frames_per_task)
    try:
        run.bar = bar_of(progress)
        while not sums.is_done:
            run.go_round()
    except distributed.KilledWorker as error:
        raise RuntimeError(
            f"workers ended again and again over a task of pass {sums.passes_ended + 1}: {error}. Mostly it is memory: "
            f"a worker needs at least {run.need >> 20} MiB, and more for many components of illumination and motion"
        ) from error
    finally:
        run.close()
    return sums.report(maps=maps)


def _require_settings(settings: dict[str, Any]) -> None:
    known = [each.name for each in fields(Settings)]
    for name in settings:
        if name not in known:
            raise InvalidTypeError(f"{name} is no setting of a cluster; expected some of {', '.join(known)}")


@dataclass
class _Run:
    """One measurement. `sums`: sums of the driver; `need`: memory of a worker [bytes]; `ended`: futures of the merged
    sums of the passes that have ended; `asked`: futures of the current pass."""

    client: Any
    parts: Parts
    sums: SensorNoiseSums
    spans: list[tuple[int, int]]
    need: int  # at least
    name: str
    start: Any
    watch: Watch
    ended: list[Any] = field(default_factory=list)
    asked: list[Any] = field(default_factory=list)
    bar: Bar | None = None

    @classmethod
    def of(cls, client: Any, parts: Parts, sums: SensorNoiseSums, frames_per_task: int | None) -> "_Run":
        watch = Watch(client, "measure again, with a client of the new one")
        watch.require_scheduler()
        count = parts.per_task(len(client.ncores()) or 1, frames_per_task)
        width, height, _ = sums._prepared.size
        need = need_of_worker(width * height, parts.shape[0], parts.dtype, parts.block_bytes(count))
        name = f"sensor-noise-{uuid.uuid4().hex[:12]}"
        # A task, not data: if the worker that has it ends, another makes it again.
        start = client.submit(_worker.same, sums._given, key=f"{name}-start")
        return cls(client, parts, sums, parts.runs(count), need, name, start, watch)

    def go_round(self) -> None:
        """Fills and merges the sums of a pass, and ends the pass. Raises ValueError if a frame is missing, RuntimeError
        if workers have too little memory or tasks never end."""
        began = time.monotonic()
        number = self.sums.passes_ended + 1
        frames, height, width = self.parts.shape
        require_memory(self.watch.workers(), self.need, f"{frames} frames of {width} x {height} pixels")
        looks, merged = self._submit(f"{self.name}-{number}", None)
        seen = results_of(self.client, looks, self.watch, self._report_progress)
        self._require_all(seen)
        flags = _counted_elsewhere(seen, self.parts.shape[0]) if number == 1 else None
        if flags is not None:
            del merged
            self.asked = []
            _LOG.info("pass 1 again: %d frames equal one of another task", np.count_nonzero(flags.any(axis=0)))
            looks, merged = self._submit(f"{self.name}-{number}-again", flags)
        part = results_of(self.client, [merged], self.watch)[0]
        self.sums.merge(part.sums)
        self.sums.end_pass()
        self.ended.append(merged)
        self._report_progress(0)
        took = time.monotonic() - began
        _LOG.info("pass %d: %d tasks, merged sums of %d bytes, %.2f s", number, len(seen), part.sums.nbytes, took)

    def close(self) -> None:
        """Asks for no more, also where a traceback keeps the futures, and lets workers forget the run."""
        if self.bar is not None:
            self.bar.close()
        for future in (self.start, *self.ended, *self.asked):
            future.release()
        if self.client.status != "running":
            return
        with contextlib.suppress(OSError):  # the scheduler goes away just now
            self.client.run(_worker.forget, self.name, wait=False, on_error="ignore")

    def _report_progress(self, done: int) -> None:
        """Reports the progress when so many tasks of the pass have read their frames. Merging takes the rest of the
        time."""
        if self.bar is not None:
            passes = self.sums.passes_ended + 0.9 * done / len(self.spans)
            percent = 100 if self.sums.is_done else min(99, int(100 * passes / 3))  # there may be more
            self.bar.update(max(percent - int(self.bar.n), 0))

    def _submit(self, key: str, flags: np.ndarray | None) -> tuple[list[Any], Any]:
        """Returns futures of the summary of each part, and of the merged sums."""
        level = self._fill(key, flags)
        looks = [self.client.submit(_worker.look, part, key=f"{key}-look-{n}") for n, part in enumerate(level)]
        depth = 0
        while len(level) > 1:
            # Always the same neighbours: whichever comes first, the bits are the same.
            groups = [level[at : at + _FAN] for at in range(0, len(level), _FAN)]
            level = [
                group[0] if len(group) == 1 else self._merge(f"{key}-merge-{depth}-{n}", group)
                for n, group in enumerate(groups)
            ]
            depth += 1
        self.asked = [*looks, level[0]]
        return looks, level[0]

    def _merge(self, key: str, group: list[Any]) -> Any:
        # Sums are in memory until they are merged: that goes before new frames.
        return self.client.submit(_worker.merge, self.name, self.start, self.ended, group, key=key, priority=10)

    def _fill(self, key: str, flags: np.ndarray | None) -> list[Any]:
        given, ranges = self.parts.split(self.spans), self.parts.ranges(self.spans)
        numbered = list(enumerate(zip(given, self.spans, ranges, strict=True)))
        if self.parts.kind != "dask":
            return [
                self.client.submit(
                    _worker.fill,
                    self.name,
                    self.start,
                    self.ended,
                    frames,
                    span,
                    wanted,
                    flags,
                    key=f"{key}-fill-{n}",
                )
                for n, (frames, span, wanted) in numbered
            ]
        from dask import delayed

        fill = delayed(_worker.fill, pure=False)
        return self.client.compute(  # type: ignore[no-any-return]
            [
                fill(self.name, self.start, self.ended, frames, span, wanted, flags, dask_key_name=f"{key}-fill-{n}")
                for n, (frames, span, wanted) in numbered
            ]
        )

    def _require_all(self, seen: list[_worker.Part]) -> None:
        here = np.zeros(self.parts.shape[0], bool)
        for part in seen:
            here[part.frames] = True
        missing = np.flatnonzero(~here)
        if missing.size:
            raise ValueError(f"{names_of(missing)} missing in pass {self.sums.passes_ended + 1}: no task brought it")


def _counted_elsewhere(seen: list[_worker.Part], frames: int) -> np.ndarray | None:
    """Flags (planes, t) of frames that equal one of an earlier task, which is the one to count it; None: there are
    none."""
    planes = seen[0].fingerprints.shape[1]  # type: ignore[union-attr]  # pass 1
    flags = np.zeros((planes, frames), np.uint8)
    for plane in range(planes):
        task_of: dict[bytes, int] = {}
        for number, part in enumerate(seen):
            for t, fingerprint in zip(part.frames, part.fingerprints[:, plane], strict=True):  # type: ignore[index]
                flags[plane, t] = task_of.setdefault(bytes(fingerprint), number) != number
    return flags if flags.any() else None
