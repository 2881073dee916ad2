# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Several reports side by side."""

import json
import math
import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias, overload

from ._catalogue import quantity_list
from ._channels import CHANNELS, ChannelReports
from ._errors import InvalidTypeError
from ._html import page, table
from ._names import is_name
from ._pictures import write_page
from ._quantity import Quantity
from ._read import record_of, text_of
from ._report import Report
from ._rounding import with_signs
from ._types import FileName

Comparable: TypeAlias = Report | ChannelReports | FileName

# A difference from the first report is marked above this number of standard errors, which chance exceeds once in 370
# differences: ChanceErrors of page/Comparison.h.
_CHANCE_ERRORS = 3.0


@dataclass(frozen=True)
class Row:
    """One quantity of all reports.

    Attributes
    ----------
    path, label, unit : str
        Path, label and unit as in quantity_list().
    quantities : tuple of Quantity or None
        One for each report; None for a report without this quantity.
    differences : tuple of float or None
        The difference from the first report of the same channel, in units of their combined standard error, which takes
        the reports as independent [1]; None for the first, and where a value or an error is missing.
    """

    path: str
    label: str
    unit: str
    quantities: tuple[Quantity | None, ...]
    differences: tuple[float | None, ...]


class Comparison:
    """A table of several reports: quantities as rows, reports as columns. compare() makes it.

    print() and notebooks show each value with its error and, behind it, its difference from the first report in units
    of their combined standard error; differences of more than 3 are marked with "!".

    Attributes
    ----------
    labels : tuple of str
        The names of the reports.
    rows : tuple of Row
        The quantities that any of the reports has.
    """

    def __init__(self, labels: Sequence[str], reports: Sequence[Report]) -> None:
        """`labels`: one for each of the `reports`, each of one channel."""
        self.labels = tuple(labels)
        channels = [str(report.get("channel")) for report in reports]
        firsts = [channels.index(channel) for channel in channels]
        rows = []
        for entry in quantity_list():
            found = tuple(_quantity_of(report, entry["path"]) for report in reports)
            if any(quantity is not None and str(quantity) != "not-identifiable" for quantity in found):
                differences = tuple(_difference(found, first, number) for number, first in enumerate(firsts))
                rows.append(Row(entry["path"], entry["label"], entry["unit"], found, differences))
        self.rows = tuple(rows)

    def __str__(self) -> str:
        cells = [self._head(), *self._cells()]
        widths = [max(map(len, column)) + 2 for column in zip(*cells, strict=True)]
        return "\n".join("".join(map(str.ljust, row, widths)).rstrip() for row in cells)

    def __repr__(self) -> str:
        return f"<Comparison: {len(self.rows)} quantities of {', '.join(self.labels)}>"

    def _repr_html_(self) -> str:
        return table(self._head(), self._cells())

    def _head(self) -> list[str]:
        return ["quantity", "unit", *self.labels]

    def _cells(self) -> list[list[str]]:
        return [
            [with_signs(row.label), with_signs(row.unit), *map(_cell, row.quantities, row.differences)]
            for row in self.rows
        ]

    @overload
    def to_html(self, path: FileName, *, title: str | None = None) -> None: ...

    @overload
    def to_html(self, path: None = None, *, title: str | None = None) -> str: ...

    def to_html(self, path: FileName | None = None, *, title: str | None = None) -> str | None:
        """Makes a page with the table. Arguments and errors are the same as in Report.to_html()."""
        return write_page(page("Comparison of noise reports", self._repr_html_()), path, title)

    def to_rows(self) -> list[dict[str, Any]]:
        """Returns one dict for each quantity of each report, for pandas.DataFrame(): `path`, `label`, `unit`, `report`,
        `value`, `standard_error`, `status`, `difference`."""
        return [
            {
                "path": row.path,
                "label": row.label,
                "unit": row.unit,
                "report": name,
                "value": quantity.value,
                "standard_error": quantity.standard_error,
                "status": quantity.status,
                "difference": difference,
            }
            for row in self.rows
            for name, quantity, difference in zip(self.labels, row.quantities, row.differences, strict=True)
            if quantity is not None
        ]


def compare(
    reports: Mapping[str, Comparable] | Iterable[Comparable], labels: Sequence[str] | None = None
) -> Comparison:
    """Puts several reports side by side: quantities as rows, reports as columns.

    Parameters
    ----------
    reports : iterable, or mapping of names to them
        Two or more of Report, ChannelReports, or the names of their JSON files. The channels of a mosaic are columns
        each, and are compared with the same channel of the first mosaic.
    labels : sequence of str, optional
        Names of the columns. Default: the keys of a mapping, the names of files, else "report 1", "report 2" and so on.

    Returns
    -------
    Comparison

    Raises
    ------
    TypeError
        The reports, or the labels, are of another type.
    ValueError
        There are fewer than two reports, other labels than reports, or a file that holds no report.

    Examples
    --------
    >>> print(itk_sensornoise.compare({"May": report, "June": "june.json"}))

    See Also
    --------
    itk_sensornoise.distributed.find_steps : Steps in a series of many reports.
    """
    expected = "reports, names of their JSON files, or a mapping of names to them"
    if is_name(reports) or isinstance(reports, (Report, ChannelReports)) or not isinstance(reports, Iterable):
        raise InvalidTypeError(f"reports is of type {type(reports).__name__}; expected a list of {expected}")
    if isinstance(reports, Mapping):
        names: list[str | None] = list(reports)
        given = list(reports.values())
    else:
        given = list(reports)
        names = [os.path.basename(os.fsdecode(each)) if is_name(each) else None for each in given]
    if len(given) < 2:
        raise ValueError(f"reports has {len(given)} report; expected 2 or more")
    if labels is not None:
        if isinstance(labels, str) or not all(isinstance(label, str) for label in labels):
            raise InvalidTypeError(f"labels is {labels!r}; expected one str for each report")
        if len(labels) != len(given):
            raise ValueError(f"labels has {len(labels)} names for {len(given)} reports; expected one for each")
        names = list(labels)
    found, columns = [], []
    for number, (name, each) in enumerate(zip(names, given, strict=True), 1):
        for suffix, report in _reports_of(each, number):
            found.append(report)
            columns.append(f"{name or f'report {number}'}{suffix}")
    return Comparison(columns, found)


def _reports_of(given: Any, number: int) -> list[tuple[str, Report]]:
    """Returns a report, or the reports of the channels of a mosaic, each with the suffix of its label."""
    if is_name(given):
        text, name = text_of(given)
        given = ChannelReports(text) if "channels" in record_of(text, name) else Report(text)
    elif isinstance(given, dict) and not isinstance(given, (Report, ChannelReports)):
        text, name = text_of(json.dumps(given))[0], f"report {number}"
        given = ChannelReports(text) if "channels" in record_of(text, name) else Report(text)
    if isinstance(given, ChannelReports):
        return [(f" {channel}", given.channel(channel)) for channel in CHANNELS]
    if isinstance(given, Report):
        return [("", given)]
    raise InvalidTypeError(
        f"report {number} is of type {type(given).__name__}; expected a report or the name of its file"
    )


def _quantity_of(report: Report, path: str) -> Quantity | None:
    try:
        return report.quantity(path)
    except KeyError:
        return None


def _difference(quantities: Sequence[Quantity | None], first: int, number: int) -> float | None:
    """Returns the difference from the first report, over the combined standard error [1]."""
    before, now = quantities[first], quantities[number]
    if first == number or before is None or now is None or before.value is None or now.value is None:
        return None
    if before.standard_error is None or now.standard_error is None:
        return None
    error = math.hypot(before.standard_error, now.standard_error)
    return (now.value - before.value) / error if error > 0 else None


def _cell(quantity: Quantity | None, difference: float | None) -> str:
    if quantity is None:
        return "-"
    unit = "" if quantity.unit == "1" else f" {with_signs(quantity.unit)}"
    text = str(quantity).removesuffix(unit)
    if difference is None:
        return text
    return f"{text} ({difference:+.1f}{' !' if abs(difference) > _CHANCE_ERRORS else ''})"
