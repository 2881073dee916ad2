# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Names of files: the list that a pattern, a folder or a generator means, and names that another package opens."""

import glob
import os
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Set
from pathlib import Path
from typing import Any, TypeGuard

from ._errors import InvalidTypeError
from ._types import FileName

_PATTERN = re.compile(r"[*?\[]")

# Endings of files that other packages open lazily, and how; {} is the file's name.
_LIBRARIES = {
    (".h5", ".hdf5", ".hdf", ".he5"): ("HDF5", "h5py.File({})['name of the dataset']"),
    (".zarr",): ("Zarr", "zarr.open_array({})"),
    (".fits.gz", ".fits.fz"): ("FITS", "astropy.io.fits.open({}, memmap=False)[0].section"),
    (".nc", ".nc4"): ("NetCDF", "xarray.open_dataset({})['name of the variable']"),
    (".npz",): ("NumPy's", "numpy.load({})['name of the array']"),
}
_VIDEOS = (".avi", ".mp4", ".mov", ".mkv", ".m4v", ".wmv", ".mpg", ".mpeg", ".webm")


def is_name(value: object) -> TypeGuard[FileName]:
    return isinstance(value, (str, os.PathLike))


def natural_key(name: FileName) -> list[tuple[bool, int, str]]:
    """Returns the sort key of a name, with runs of digits as numbers: frame_2 comes before frame_10."""
    parts = re.split(r"(\d+)", os.fsdecode(name))
    numbers = [(False, int(part), part) if number % 2 else (True, 0, part) for number, part in enumerate(parts)]
    return [*numbers, (True, 0, os.fsdecode(name))]


def expand(frames: Any, name: str = "frames") -> Any:
    """Returns the list of names for a pattern, a folder, a set or a generator of names; any other value unchanged.

    A pattern (frames/*.png), a folder, a set and a generator have no order of their own: their names are sorted by
    natural_key(). A list keeps its order. Raises ValueError, with the `name` of the parameter, for a pattern that no
    file matches, a folder that does not hold files of one kind, and a generator of anything but names."""
    if is_name(frames):
        text = os.fsdecode(frames)
        if os.path.isdir(text) and not text.rstrip(os.sep).lower().endswith(".zarr"):
            return _of_folder(Path(text))
        if _PATTERN.search(text) and not os.path.lexists(text):
            return _of_pattern(text)
        return frames
    if isinstance(frames, (Iterator, Set)):
        return _of_iterator(frames, name)
    return frames


def refuse_other_formats(names: Iterable[FileName]) -> None:
    """Raises ValueError for a name whose format another package opens. The message shows how to open the file."""
    for given in names:
        name = os.fsdecode(given)
        ending = name.rstrip(os.sep).lower()
        if not os.path.exists(name):
            continue  # said by the one who opens it
        for endings, (kind, opened) in _LIBRARIES.items():
            if ending.endswith(endings):
                raise ValueError(
                    f"{name}: a file of {kind} format is opened by its own package; expected its array. A few "
                    f"frames are read at a time: itk.estimate_sensor_noise({opened.format(repr(name))})"
                )
        if ending.endswith(_VIDEOS):
            raise ValueError(
                f"{name}: a video, whose frames are seldom raw; expected raw frames. examples/python/lazy.py shows how "
                "one is read by cv2.VideoCapture"
            )


def _of_pattern(pattern: str) -> list[str]:
    names = [name for name in glob.glob(pattern, recursive=True) if not os.path.isdir(name)]
    if not names:
        raise ValueError(f"{pattern}: no file matches this pattern; expected the frames, one file each")
    return sorted(names, key=natural_key)


def _of_folder(folder: Path) -> list[str]:
    """Returns all files of a folder that are not hidden, if they have one format."""
    files = [path for path in folder.iterdir() if path.is_file() and not path.name.startswith(".")]
    endings = Counter(path.suffix.lower() for path in files)
    if not files:
        raise ValueError(f"{folder}: is a folder without files; expected the frames, one file each")
    if len(endings) > 1:
        found = ", ".join(f"{count} {ending or 'without an ending'}" for ending, count in sorted(endings.items()))
        pattern = str(folder / f"*{endings.most_common(1)[0][0]}")
        raise ValueError(
            f"{folder}: is a folder of files of several kinds ({found}); expected one kind, or a pattern as {pattern!r}"
        )
    return sorted(map(str, files), key=natural_key)


def _of_iterator(frames: Iterable[Any], name: str) -> list[FileName]:
    names: list[FileName] = []
    for number, item in enumerate(frames):
        if not is_name(item):
            raise InvalidTypeError(
                f"{name} is of type {type(frames).__name__}, and item {number} of it of type {type(item).__name__}; "
                "expected file names: frames are read several times over, which arrays from a generator cannot be. "
                "A list can, or an object with shape, dtype and slices along time"
            )
        names.append(item)
    if not names:
        raise ValueError(f"{name} is an empty {type(frames).__name__}; expected file names")
    return sorted(names, key=natural_key)
