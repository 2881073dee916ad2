# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""The reports of a mosaic's channels."""

import html
import json
from collections.abc import Mapping
from typing import Any

import numpy as np

from ._maps import Maps
from ._record import Record
from ._report import Report
from ._types import ItkObject

CHANNELS = ("R", "G1", "G2", "B")


class ChannelReports(Record):
    """What was measured of the four planes of a Bayer mosaic: one record with a report for each.

        reports["bayer"]                    {"pattern": "RGGB", "source": "given", "file" or "levels"}
        reports["joint"]["offset"]          of all channels together; reports["joint"] is None where there is none
        reports["channels"]                 four records, in the order R, G1, G2, B
        reports.channel("G1")               one of them, a Report; its vibration is in pixels of the plane
        reports["warnings"]                 of all together; each channel has its own, too
        reports.maps["mean"]                arrays (y, x) of the mosaic, where they were asked for by maps=True

    print() shows a line a channel, the joint offset and the warnings. It is a dict that cannot be changed, as Report.
    """

    def __init__(
        self,
        text: str,
        table: str = "",
        tables: Mapping[str, str] | None = None,
        maps: Mapping[str, np.ndarray] | None = None,
    ) -> None:
        """`text`: the record as JSON, as C++ writes it. `table`: the same for people; `tables`: of each channel."""
        super().__init__(text)
        self._table = table
        self._tables = dict(tables or {})
        self._maps = Maps(maps or {})

    @classmethod
    def of(cls, estimator: ItkObject, maps: Mapping[str, np.ndarray] | None = None) -> "ChannelReports":
        """The reports of an ITK estimator that is up to date."""
        tables = {name: estimator.GetChannelReportAsText(name) for name in CHANNELS}
        return cls(estimator.GetReportAsJson(), estimator.GetReportAsText(), tables, maps)

    def channel(self, name: str) -> Report:
        """The report of one channel: "R", "G1", "G2" or "B"."""
        if name not in CHANNELS:
            raise ValueError(f"channel is {name!r}; expected 'R', 'G1', 'G2' or 'B'")
        record = self["channels"][CHANNELS.index(name)]
        return Report(json.dumps(record) + "\n", self._tables.get(name, ""))

    @property
    def maps(self) -> Maps:
        """What is known of every pixel of the mosaic, as Report.maps."""
        return self._maps

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self._text, self._table, self._tables, dict(self._maps))

    def __str__(self) -> str:
        return self._table.rstrip("\n")

    def __repr__(self) -> str:
        first = self["channels"][0]
        return (
            f"<ChannelReports: {first['frames']} frames, a {self['bayer']['pattern']} mosaic with planes of "
            f"{first['width']} x {first['height']} pixels>"
        )

    def _repr_html_(self) -> str:
        return f"<pre>{html.escape(str(self))}</pre>"


def report_of(estimator: ItkObject, maps: Mapping[str, np.ndarray] | None = None) -> Report | ChannelReports:
    """What an ITK estimator that is up to date has measured."""
    if estimator.HasChannelReports():
        return ChannelReports.of(estimator, maps)
    return Report.of(estimator, maps)
