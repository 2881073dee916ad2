# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Files of frames, their parts, and the size of the frames, which programs may change before they make files."""

from dataclasses import dataclass, field

WIDTH = 48  # pixels
HEIGHT = 32  # pixels


@dataclass
class File:
    """A file with the places of its pixels: `raw` where no checksum detects a change, `checked` where a checksum does.
    All other bytes are header."""

    name: str
    data: bytes
    raw: list[tuple[int, int]] = field(default_factory=list)
    checked: list[tuple[int, int]] = field(default_factory=list)


@dataclass
class Case:
    """Files, and the files among them that the tool is given, in time order. `raw` is the layout of frames without a
    header."""

    name: str
    files: list[File]
    frames: list[str]
    raw: str = ""


def whole(name: str, data: bytes) -> File:
    return File(name, data, raw=[(0, len(data))])


def parts_of(name: str, *parts: tuple[str, bytes]) -> File:
    """Makes a file of parts, each "header", "raw" or "checked"."""
    made = File(name, b"")
    for kind, data in parts:
        if kind != "header":
            getattr(made, kind).append((len(made.data), len(made.data) + len(data)))
        made.data += data
    return made
