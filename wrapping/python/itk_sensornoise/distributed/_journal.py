# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Journal of the results so far: a file of JSON lines that outlives the process that writes it."""

import contextlib
import fcntl
import hashlib
import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np

from .._errors import InvalidTypeError
from ._table import Entry, Row, rows_of

# Settings with which the same numbers come.
_SAME_NUMBERS = ("memory_limit", "threads")


def settings_record(settings: Mapping[str, Any], defaults: Mapping[str, Any]) -> dict[str, Any]:
    """Returns the settings as JSON, to compare two calls; arrays are replaced by their SHA-256. Settings that change no
    number, or equal `defaults`, are left out. Raises ValueError for values that JSON cannot hold."""
    given = {name: _as_json(name, value) for name, value in sorted(settings.items()) if name not in _SAME_NUMBERS}
    return {name: value for name, value in given.items() if value != _as_json(name, defaults[name])}


def _as_json(name: str, value: Any) -> Any:
    if isinstance(value, np.ndarray):
        digest = hashlib.sha256(np.ascontiguousarray(value).tobytes()).hexdigest()
        return {"sha256": digest, "shape": list(value.shape), "dtype": value.dtype.name}
    if isinstance(value, (list, tuple)):
        return [_as_json(name, item) for item in value]
    if isinstance(value, slice):
        return [_as_json(name, part) for part in (value.start, value.stop, value.step)]
    if isinstance(value, os.PathLike):
        return os.fsdecode(value)
    if isinstance(value, np.generic):
        return value.item()
    if value is None or isinstance(value, (str, bool, int, float)):
        return value
    raise InvalidTypeError(
        f"{name} is of type {type(value).__name__}, which the output cannot distinguish; "
        "expected names of files or a NumPy array"
    )


class Journal:
    """Entries of sources, each a line of the file as soon as it is added; a context, in which the file is open.

    A line that has no end was being written when its process was killed: it is dropped. One process writes at a time.
    """

    def __init__(self, name: Path) -> None:
        """Reads the entries of the file, or makes the file. Raises ValueError if a line is no entry, or another process
        writes to the file."""
        self._name = name
        self._settings: dict[str, dict[str, Any]] = {}  # settings of the sources that have a report
        self._rows: dict[str, list[Row]] = {}
        with contextlib.ExitStack() as opened:
            self._file: BinaryIO = opened.enter_context(_open(name))
            try:
                fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except OSError as error:
                raise ValueError(f"{name}: is being written by another run; expected an output of its own") from error
            self._read()
            self._opened = opened.pop_all()

    def __enter__(self) -> "Journal":
        return self

    def __exit__(self, *_error: object) -> None:
        self._opened.close()

    def rows(self, name: str, settings: dict[str, Any]) -> list[Row] | None:
        """Returns the rows of a source that has a report, else None. Raises ValueError if the report has other
        settings."""
        before = self._settings.get(name)
        if before is None:
            return None
        if before != settings:
            raise ValueError(
                f"{self._name}: {name} was measured with the settings {before}, and now they are {settings}; expected "
                "the same ones, or another output"
            )
        return self._rows[name]

    def all_rows(self) -> list[Row]:
        """Returns the rows of all sources in the file."""
        return [row for rows in self._rows.values() for row in rows]

    def add(self, entry: Entry) -> None:
        """Writes an entry behind the others."""
        self._file.write(json.dumps(entry, allow_nan=False).encode() + b"\n")
        self._file.flush()
        self._keep(entry)

    def _keep(self, entry: Entry) -> None:
        if entry["report"] is not None:
            self._settings[entry["name"]] = entry["settings"]
        self._rows[entry["name"]] = rows_of(entry)

    def _read(self) -> None:
        end = 0
        for number, line in enumerate(self._file, 1):
            if not line.endswith(b"\n"):
                break
            entry = _entry(line)
            if entry is None:
                raise ValueError(f"{self._name}: line {number} is no row of estimate_many(); expected its JSON lines")
            self._keep(entry)
            end += len(line)
        self._file.truncate(end)
        self._file.seek(end)


def _open(name: Path) -> BinaryIO:
    try:
        return open(os.open(name, os.O_RDWR | os.O_CREAT, 0o666), "r+b")
    except OSError as error:
        raise ValueError(f"{name}: cannot be written ({error.strerror})") from error


def _entry(line: bytes) -> Entry | None:
    try:
        entry = json.loads(line)
    except ValueError:
        return None
    return entry if isinstance(entry, dict) and entry.keys() == Entry.__annotations__.keys() else None
