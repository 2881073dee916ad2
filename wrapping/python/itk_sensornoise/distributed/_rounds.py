# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""estimate_sensor_noise() on the workers of Dask: a round for each pass over the frames."""

import logging
import time
import uuid
from dataclasses import dataclass
from typing import Any

import numpy as np

from .. import _options
from .._channels import ChannelReports
from .._report import Report
from .._settings import Settings
from .._sums import SensorNoiseSums, names_of
from .._types import Frames
from . import _worker
from ._dask import require_distributed
from ._parts import Parts, parts_of

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
    **settings: Any,
) -> Report | ChannelReports:
    """Measures as itk.estimate_sensor_noise(), on the workers of a Dask cluster: for frames that lie on several
    machines, or are more than one can read in time. Below some 10 GB one machine is faster.

    The workers go over the frames in three rounds. A task reads its frames where they lie and returns the sums over
    them; tasks merge these, eight at a time, on the workers; the driver gets the merged sums alone, never a frame, and
    makes the report. After each round every worker fetches the merged sums, from each other: after the first 20 bytes a
    pixel (floating point: 32), after the second 16 kB a frame, after the third nothing. With 4 megapixels and 400
    frames these are 84 MB and 7 MB. They also are what tasks return, and in the third round 8 bytes a pixel and series
    (4 to 20); "published" has less. A worker process needs, beside what Dask keeps, 56 bytes a pixel and 8 for each
    series, 20 kB a frame, twice the sums, and 64 MiB or a task's block of dask's array; it works on one task at a
    time, with as many threads as it has.

    With integer pixels the report has the bits of one process, whatever is read by whom. With floating point it is
    equal to rounding, and has the same bits for the same `frames_per_task`, in whatever order tasks end. The sums of a
    worker that ends are made again. Where equal frames lie in different tasks, the first round is gone through again.

    Parameters
    ----------
    frames
        A dask array (t, y, x), which is computed block by block, three times, where its blocks lie; a list of file
        names, or the name of one stack, which all workers must be able to read; or what has shape, dtype and slices
        along time and can be pickled. What is handed over by value, as a NumPy array, goes to every task.
    client
        A dask.distributed.Client. Default: the current one.
    frames_per_task
        Frames that a task reads. Default: two tasks a worker, of 8 frames or more; of a dask array at most 512 MiB.
    dark, raw
        As itk.estimate_sensor_noise() has them. Every worker reads the dark frames.
    maps
        True: arrays of what is known of every pixel, as itk.estimate_sensor_noise(maps=True).
    settings
        method, offset, bayer, bit_depth, clip, step, level_range, rolling_shutter, shutter_axis, level, quantiles, roi,
        mask, frame_range and threads (of a worker; default: those that Dask gave it): as itk.estimate_sensor_noise().
        For bayer="auto" the driver looks at the first frame.

    Raises
    ------
    ImportError
        Dask's `distributed` is not installed.
    ValueError
        Wrong use; no client; a frame that no task brought, by its number.
    RuntimeError
        What ITK threw; workers that ended again and again over one task, mostly for want of memory. What reading frames
        raises on a worker is raised as it is.
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
    if not isinstance(maps, bool):
        raise _options.refuse("maps", maps, "True or False")
    checked = Settings(**settings)
    checked.check(dark)
    if frames_per_task is not None:
        frames_per_task = _options.integer("frames_per_task", frames_per_task, 1, 1 << 24)
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
        while sums.passes_ended < 3:
            run.go_round()
    except distributed.KilledWorker as error:
        raise RuntimeError(
            f"workers ended again and again over a task of pass {sums.passes_ended + 1}: {error}. Mostly it is memory: "
            f"a worker needs up to {220 * parts.shape[1] * parts.shape[2] >> 20} MiB for frames of this size, and "
            "twice the sums"
        ) from error
    return sums.report(maps=maps)


@dataclass
class _Run:
    """One measurement. `sums`: the driver's own; `ended`: futures of the merged sums of the passes behind."""

    client: Any
    parts: Parts
    sums: SensorNoiseSums
    spans: list[tuple[int, int]]
    name: str
    start: Any
    ended: list[Any]

    @classmethod
    def of(cls, client: Any, parts: Parts, sums: SensorNoiseSums, frames_per_task: int | None) -> "_Run":
        spans = parts.runs(parts.per_task(len(client.ncores()) or 1, frames_per_task))
        name = f"sensor-noise-{uuid.uuid4().hex[:12]}"
        # A task, not data: if the worker that has it ends, another makes it again.
        start = client.submit(_worker.same, sums._given, key=f"{name}-start")
        return cls(client, parts, sums, spans, name, start, [])

    def go_round(self) -> None:
        """A pass: filled, merged, and ended here. Raises ValueError where a frame is missing."""
        began = time.monotonic()
        number = self.sums.passes_ended + 1
        looks, merged = self._submit(f"{self.name}-{number}", None)
        seen = self.client.gather(looks)
        self._require_all(seen)
        flags = _counted_elsewhere(seen, self.parts.shape[0]) if number == 1 else None
        if flags is not None:
            del merged
            _LOG.info("pass 1 again: %d frames equal one of another task", np.count_nonzero(flags.any(axis=0)))
            looks, merged = self._submit(f"{self.name}-{number}-again", flags)
        part = merged.result()
        self.sums.merge(part.sums)
        self.sums.end_pass()
        self.ended.append(merged)
        took = time.monotonic() - began
        _LOG.info("pass %d: %d tasks, merged sums of %d bytes, %.2f s", number, len(seen), part.sums.nbytes, took)

    def _submit(self, key: str, flags: np.ndarray | None) -> tuple[list[Any], Any]:
        """Futures of what the driver is told of each part, and of the merged sums."""
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
