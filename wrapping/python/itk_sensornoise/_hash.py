# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""The SHA-256 of frames, by which a report is known to be of them."""

import hashlib
import os
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from ._frames import Stack

_FILE_PIECE = 1 << 20


class FramesHash:
    """Hash of the files of a stack, or of its pixels if the stack is not in files."""

    def __init__(self, stack: Stack) -> None:
        """Reads the whole stack once. Raises ValueError for a file that cannot be read, and the errors of the reader of
        lazy frames."""
        self.files = len(stack.files)
        self.bytes = 0
        self._names = stack.files
        self._states = _states(self._names)
        self._digest = hashlib.sha256()
        if self._names:
            for name in self._names:
                self._add_file(name)
        else:
            self._add_pixels(stack)

    def set(self, setter: Callable[[str, int, int], None]) -> None:
        """Calls a method of an estimator with the hash."""
        setter(self._digest.hexdigest(), self.files, self.bytes)

    def is_in(self, record: Mapping[str, Any]) -> bool:
        """Returns whether `input` of a report, or its `dark`, is this hash."""
        of = "files" if self.files else "pixels"
        found = {"of": of, "sha256": self._digest.hexdigest(), "files": self.files, "bytes": self.bytes}
        return all(record.get(name) == value for name, value in found.items())

    def require_unchanged(self) -> None:
        """Raises ValueError if a file has changed since it was hashed. Frames in memory are not tested."""
        for name, before, now in zip(self._names, self._states, _states(self._names), strict=True):
            if now != before:
                raise ValueError(
                    f"{name}: has changed since its hash was computed; expected a file that stays as it is"
                )

    def _add_file(self, name: str) -> None:
        try:
            with open(name, "rb") as file:
                while piece := file.read(_FILE_PIECE):
                    self._add(piece)
        except OSError as error:
            raise ValueError(f"{name}: cannot be read for its hash ({error.strerror})") from error

    def _add_pixels(self, stack: Stack) -> None:
        for pixels in stack.pieces():
            self._add(np.ascontiguousarray(pixels, pixels.dtype.newbyteorder("<")).data.cast("B"))
        for error in stack.failed:
            raise error

    def _add(self, piece: bytes | memoryview) -> None:
        self._digest.update(piece)
        self.bytes += len(piece)


def _states(names: Sequence[str]) -> list[tuple[int, ...]]:
    """Returns the states of files, which change when a file is written or replaced. A missing file has none."""
    states: list[tuple[int, ...]] = []
    for name in names:
        try:
            found = os.stat(name)
            states.append((found.st_dev, found.st_ino, found.st_size, found.st_mtime_ns))
        except OSError:
            states.append(())
    return states
