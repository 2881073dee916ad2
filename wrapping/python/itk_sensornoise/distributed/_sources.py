# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Sources of estimate_many(), with their names."""

import os
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any, TypeAlias

from .._errors import InvalidTypeError
from .._names import is_name
from .._types import Frames


@dataclass(frozen=True)
class Burst:
    """Frames with dark frames of their own, or None.

    `stored` is a report with the hashes of the frames that it was made of. It is the result where they are the same."""

    frames: Frames | Callable[[], Frames]
    dark: Frames | None
    stored: dict[str, Any] | None = None


# Frames as estimate_sensor_noise() takes them, or a function without arguments that returns them. The function is
# called where the frames are measured.
Source: TypeAlias = Frames | Callable[[], Frames] | Burst
Sources: TypeAlias = Mapping[str, Source] | Iterable[tuple[str, Source] | Source]

_EXPECTED = "a mapping of names to frames, or an iterable of file names, lists of these, or pairs (name, frames)"


def named(sources: Sources, needs_names: bool) -> Iterator[tuple[str, Source]]:
    """Returns each source with its name: as given, or the name of its file, or of its first and last file; other frames
    are "source 0" and so on. Raises ValueError for the latter where it `needs_names`, and for a name twice."""
    if is_name(sources) or hasattr(sources, "shape") or not isinstance(sources, Iterable):
        raise InvalidTypeError(
            f"sources is of type {type(sources).__name__}; expected {_EXPECTED}; of one source: [source]"
        )
    known = set()
    for number, item in enumerate(sources.items() if isinstance(sources, Mapping) else sources):
        is_pair = isinstance(item, tuple) and len(item) == 2 and not isinstance(item[0], os.PathLike)
        name, frames = item if is_pair else (_name_of(item), item)
        if name is None and needs_names:
            raise ValueError(
                f"source {number} is of type {type(frames).__name__} and has no name, by which the run could go on; "
                "expected (name, frames)"
            )
        if name is None:
            name = f"source {number}"
        if not isinstance(name, str):
            raise InvalidTypeError(f"source {number} has the name {name!r}; expected a str")
        if name in known:
            raise ValueError(f"source {number} has the name {name!r}, as another one has; expected names that differ")
        known.add(name)
        yield name, frames


def _name_of(frames: object) -> str | None:
    if is_name(frames):
        return os.fsdecode(frames)
    if isinstance(frames, (list, tuple)) and frames and all(map(is_name, frames)):
        return f"{os.fsdecode(frames[0])} to {os.fsdecode(frames[-1])}"
    return None
