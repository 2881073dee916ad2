# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""The members that the report of a monochrome sensor and the reports of a mosaic have in common."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Protocol, overload, runtime_checkable

from ._types import FileName

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from ._export import NoiseExport
    from ._maps import Maps


@runtime_checkable
class NoiseReport(Protocol):
    """A measurement that estimate_sensor_noise() returns: a Report, or the ChannelReports of a mosaic.

    Examples
    --------
    >>> def file(report: itk_sensornoise.NoiseReport) -> None:
    ...     report.to_html("report.html")
    ...     pandas.DataFrame(report.quantities()).to_csv("report.csv")
    """

    @property
    def maps(self) -> "Maps": ...

    @property
    def figure_data(self) -> Mapping[str, Any]: ...

    def quantities(self) -> list[dict[str, Any]]: ...

    def plot(self) -> "Figure": ...

    @overload
    def to_html(self, path: FileName, *, title: str | None = None) -> None: ...

    @overload
    def to_html(self, path: None = None, *, title: str | None = None) -> str: ...

    def to_html(self, path: FileName | None = None, *, title: str | None = None) -> str | None: ...

    def export(
        self,
        format: str,
        output: FileName | None = None,
        *,
        channel: str = "",
        black: float | None = None,
        white: float | None = None,
        analogue_gain: float = 1.0,
        into: FileName | None = None,
    ) -> "NoiseExport": ...

    def to_json(self) -> str: ...

    def to_dict(self) -> dict[str, Any]: ...
