# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Records that were written as JSON, read again."""

import json
import os
from collections.abc import Mapping
from typing import Any

from ._errors import InvalidTypeError
from ._names import is_name
from ._types import FileName

SCHEMA = "itk-sensornoise-report/1"
# Members that the table and the figures of a report need.
_MEMBERS = (
    *("method", "frames", "frames_distinct", "frames_left_out", "width", "height", "bit_depth", "quantisation_step"),
    *("clip_low", "clip_high", "pixels", "gain", "offset", "read_noise", "variance_slope", "total_intercept"),
    *("flicker", "motion", "scatter", "fit", "linearity", "warnings"),
)
_EXPECTED = "the JSON of a {}, or the name of its file"


def text_of(source: str | FileName, kind: str = "report") -> tuple[str, str]:
    """Returns the JSON text of a `kind` of record, which is given as text or as a file, and its name for errors. Raises
    TypeError for any other type, ValueError for a file that cannot be read."""
    expected = _EXPECTED.format(kind)
    if isinstance(source, str) and source.lstrip().startswith("{"):
        return source, "the text"
    if not is_name(source):
        raise InvalidTypeError(f"the {kind} is of type {type(source).__name__}; expected {expected}")
    name = os.fsdecode(source)
    try:
        with open(name, encoding="utf-8") as file:
            return file.read(), name
    except OSError as error:
        raise ValueError(f"{name} cannot be read ({error.strerror}); expected {expected}") from None
    except UnicodeDecodeError:
        raise ValueError(f"{name} is not UTF-8; expected {expected}") from None


def record_of(text: str, name: str) -> dict[str, Any]:
    """Returns the record in a text. Raises ValueError if the text is no report."""
    try:
        record = json.loads(text)
    except ValueError as error:
        raise ValueError(f"{name} is no JSON ({error}); expected {_EXPECTED.format('report')}") from None
    if not isinstance(record, dict) or record.get("schema") != SCHEMA:
        found = f"the schema {record['schema']!r}" if isinstance(record, dict) and "schema" in record else "no schema"
        raise ValueError(f'{name} has {found}; expected "{SCHEMA}", a report of estimate_sensor_noise()')
    channels = record.get("channels", [record])
    if not isinstance(channels, list) or not all(isinstance(channel, Mapping) for channel in channels):
        raise ValueError(f"{name} has channels that are no reports; expected the JSON as it was written")
    for channel in channels:
        missing = [member for member in _MEMBERS if member not in channel]
        if missing:
            raise ValueError(f"{name} lacks {', '.join(missing)}; expected the whole JSON of a report")
    return record
