# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Reports as rows of a table, whose columns are named with their units."""

import os
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypedDict

from .._catalogue import quantity_list
from .._channels import CHANNELS

if TYPE_CHECKING:
    import pandas as pd

Row = dict[str, Any]


class Entry(TypedDict):
    """Result of one source."""

    name: str
    settings: dict[str, Any]  # that change a number, as JSON has them
    reason: str | None  # why there is no report
    report: dict[str, Any] | None  # the record of a Report or of ChannelReports


# Columns of a report that are no quantities.
_COUNTS = ("frames", "frames_distinct", "width", "height")
_TEXTS = ("name", "channel", "status", "reason", "method", "warnings")
_UNITS = {
    "DN/e-": "DN_per_e",
    "DN": "DN",
    "e-": "e",
    "DN^2": "DN2",
    "pixel": "pixel",
    "pixel^2": "pixel2",
    "%": "percent",
    "DN/unit": "DN_per_exposure",
    "1": "",
}


def column(path: str, unit: str, part: str = "") -> str:
    """Returns the name of a column, for example "vibration_sd_x_error_pixel": the path of the quantity without its
    unit, "error", and the unit."""
    name = _UNITS[unit]
    stem = path.replace(".", "_").removesuffix(f"_{name.lower()}")
    return "_".join(filter(None, (stem, part, name)))


def columns() -> dict[str, type]:
    """Returns all columns in their order, with their type: str, int or float; each may be empty, None."""
    kinds: dict[str, type] = {**dict.fromkeys(_TEXTS[:-1], str), **dict.fromkeys(_COUNTS, int)}
    for quantity in quantity_list():
        path, unit = quantity["path"], quantity["unit"]
        kinds |= {column(path, unit): float, column(path, unit, "error"): float, column(path, "1", "status"): str}
    return {**kinds, _TEXTS[-1]: str}


def rows_of(entry: Entry) -> list[Row]:
    """Returns the rows of a source: one, or one for each channel of a mosaic."""
    empty = {**dict.fromkeys(columns()), "name": entry["name"]}
    report = entry["report"]
    if report is None:
        return [{**empty, "status": "error", "reason": entry["reason"]}]
    channels = report.get("channels")
    if channels is None:
        return [{**empty, **_row(report, "mono")}]
    return [{**empty, **_row(each, name)} for name, each in zip(CHANNELS, channels, strict=True)]


def _row(report: dict[str, Any], channel: str) -> Row:
    row: Row = {"channel": channel, "status": "measured", "method": report["method"]}
    row |= {name: report[name] for name in _COUNTS}
    for quantity in quantity_list():
        path, unit = quantity["path"], quantity["unit"]
        found: Any = report
        for name in path.split("."):
            found = found and found[name]
        if found is not None:
            row[column(path, unit)] = found["value"]
            row[column(path, unit, "error")] = found["standard_error"]
            row[column(path, "1", "status")] = found["status"]
    row["warnings"] = " ".join(warning["code"] for warning in report["warnings"])
    return row


def as_table(rows: Sequence[Row]) -> "pd.DataFrame | list[Row]":
    """Returns a DataFrame if pandas is installed, else the unchanged rows."""
    try:
        import pandas as pd
    except ImportError:
        return list(rows)
    types = {str: "object", int: "Int64", float: "float64"}
    values = {name: [row[name] for row in rows] for name in columns()}
    return pd.DataFrame(
        {name: pd.Series(values[name], dtype=types[kind]) for name, kind in columns().items()}  # type: ignore[arg-type]
    )


def require_parquet() -> None:
    """Raises ImportError, with what to install, where there is nothing that writes Parquet."""
    try:
        import pyarrow.parquet  # noqa: F401 - asked for before anything is measured
    except ImportError as error:
        raise ImportError(
            "Parquet is written by PyArrow, which is not installed; expected it (pip install pyarrow), or an output "
            "that ends in .jsonl"
        ) from error


def write_parquet(rows: Sequence[Row], name: Path) -> None:
    """Writes the table to a file, which gets its name when it is complete."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    types = {str: pa.string(), int: pa.int64(), float: pa.float64()}
    schema = pa.schema([(name, types[kind]) for name, kind in columns().items()])
    unfinished = name.with_name(f"{name.name}.part")
    pq.write_table(pa.Table.from_pylist(list(rows), schema=schema), unfinished)
    os.replace(unfinished, name)
