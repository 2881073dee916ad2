# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""The reports of a mosaic's channels."""

import html
import json
from collections.abc import Mapping
from typing import Any

import numpy as np

from ._maps import Maps
from ._pictures import PagedRecord, Pictures, pack
from ._report import Report
from ._types import ItkObject

CHANNELS = ("R", "G1", "G2", "B")


class ChannelReports(PagedRecord):
    """What was measured of the four planes of a Bayer mosaic: one record with a report for each.

        reports["bayer"]                    {"pattern": "RGGB", "source": "given", "file" or "levels"}
        reports["joint"]["offset"]          of all channels together; reports["joint"] is None where there is none
        reports["joint_vibration"]["sd_x"]  of all channels together [pixel of a plane]; None as joint
        reports["channels"]                 four records, in the order R, G1, G2, B
        reports.channel("G1")               one of them, a Report; its vibration is in pixels of the plane
        reports["warnings"]                 of all together; each channel has its own, too
        reports.maps["mean"]                arrays (y, x) of the mosaic, where they were asked for by maps=True
        reports.to_html("report.html")      one page of all channels
        reports.figure_data["G1"]["mean"]   the numbers of a channel's figures, as Report.figure_data

    print() shows a line a channel, what all have together and the warnings. It is a dict that cannot be changed, as
    Report.
    """

    def __init__(
        self,
        text: str,
        table: str = "",
        tables: Mapping[str, str] | None = None,
        maps: Mapping[str, np.ndarray] | None = None,
        page: bytes | None = None,
        pictures: Mapping[str, Pictures] | None = None,
    ) -> None:
        """`text`: the record as JSON, as C++ writes it. `table`: the same for people. `page`: of all channels, packed.
        `tables`, `pictures`: of each channel."""
        super().__init__(text, page)
        self._table = table
        self._tables = dict(tables or {})
        self._maps = Maps(maps or {})
        self._pictures = dict(pictures or {})

    @classmethod
    def of(cls, estimator: ItkObject, maps: Mapping[str, np.ndarray] | None = None) -> "ChannelReports":
        """The reports of an ITK estimator that is up to date."""
        tables = {name: estimator.GetChannelReportAsText(name) for name in CHANNELS}
        page, pictures = pack(estimator.GetReportAsHtml()), Pictures.of_channels(estimator)
        return cls(estimator.GetReportAsJson(), estimator.GetReportAsText(), tables, maps, page, pictures)

    def channel(self, name: str) -> Report:
        """The report of one channel: "R", "G1", "G2" or "B"."""
        if name not in CHANNELS:
            raise ValueError(f"channel is {name!r}; expected 'R', 'G1', 'G2' or 'B'")
        record = self["channels"][CHANNELS.index(name)]
        return Report(json.dumps(record) + "\n", self._tables.get(name, ""), pictures=self._pictures.get(name))

    @property
    def figure_data(self) -> dict[str, dict[str, Any]]:
        """The numbers of the figures of each channel, by its name: those of Report.figure_data."""
        return {name: self.channel(name).figure_data for name in CHANNELS}

    @property
    def maps(self) -> Maps:
        """What is known of every pixel of the mosaic, as Report.maps."""
        return self._maps

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (
            self._text,
            self._table,
            self._tables,
            dict(self._maps),
            self._page,
            self._pictures,
        )

    def __str__(self) -> str:
        return self._table.rstrip("\n")

    def __repr__(self) -> str:
        first = self["channels"][0]
        return (
            f"<ChannelReports: {first['frames']} frames, a {self['bayer']['pattern']} mosaic with planes of "
            f"{first['width']} x {first['height']} pixels>"
        )

    def _repr_html_(self) -> str:
        """The table with its warnings, and the noise curve of every channel that has one."""
        curves = [(name, self.channel(name)._curve_element(320)) for name in CHANNELS]
        figures = [
            f'<figure style="display:inline-block;margin:0.5em"><figcaption>{name}</figcaption>{curve}</figure>'
            for name, curve in curves
            if curve
        ]
        return f"<pre>{html.escape(str(self))}</pre>{''.join(figures)}"


def report_of(estimator: ItkObject, maps: Mapping[str, np.ndarray] | None = None) -> Report | ChannelReports:
    """What an ITK estimator that is up to date has measured."""
    if estimator.HasChannelReports():
        return ChannelReports.of(estimator, maps)
    return Report.of(estimator, maps)
