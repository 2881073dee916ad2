# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Defines a measured quantity, with attributes that a type checker and an editor know."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal, TypeAlias

from ._rounding import rounded_quantity, with_signs


def member(record: Mapping[str, Any], path: str) -> Any:
    """Returns the member at a path, for example "vibration.sd_x"; None if there is none."""
    found: Any = record
    for name in path.split("."):
        found = found.get(name) if found is not None else None
    return found


Status: TypeAlias = Literal["identified", "not-identifiable", "upper-limit", "failed"]


@dataclass(frozen=True, slots=True)
class Quantity:
    """A quantity of a report.

    Attributes
    ----------
    value : float or None
        The value, in `unit`; None where the quantity is not identified.
    standard_error : float or None
        Standard error of the value, in `unit`; None where it is not known.
    interval95 : tuple of float or None, or None
        Ends of the 95 % interval, in `unit`; an end that is None is open.
    status : {"identified", "not-identifiable", "upper-limit", "failed"}
        Whether the quantity has a value, an upper limit, or neither.
    unit : str
        The unit, for example "DN/e-"; "1" of a pure number.
    limits : tuple of float or None, or None
        Limits that the data set without an assumption about their noise; `bracket` in the record.

    Examples
    --------
    >>> report.gain.value, report.gain.unit
    (5.000230729100737, 'DN/e-')
    >>> print(report.gain)
    5.0002 ± 0.0026 DN/e⁻
    """

    value: float | None
    standard_error: float | None
    interval95: tuple[float | None, float | None] | None
    status: Status
    unit: str
    limits: tuple[float | None, float | None] | None = None

    @classmethod
    def of(cls, record: Mapping[str, Any]) -> "Quantity":
        """Returns the quantity in a member of the record of a report."""
        interval95, limits = (
            None if pair is None else tuple(pair) for pair in (record["interval95"], record["bracket"])
        )
        return cls(record["value"], record["standard_error"], interval95, record["status"], record["unit"], limits)

    def __str__(self) -> str:
        """Returns the value with its error and unit as in the table of the report, else the limit, or the status."""
        pair = None if self.interval95 is None else list(self.interval95)
        limits = None if self.limits is None else list(self.limits)
        record = {"value": self.value, "standard_error": self.standard_error, "status": self.status}
        rounded = rounded_quantity({**record, "interval95": pair, "bracket": limits})
        if rounded.value == "-":
            return self.status
        return str(rounded) if self.unit == "1" else f"{rounded} {with_signs(self.unit)}"
