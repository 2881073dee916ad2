# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""The reports of a mosaic's channels."""

import json
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from ._catalogue import quantity_list
from ._html import figure, paragraphs, rows_of_text, table
from ._maps import Maps
from ._pictures import PagedRecord, Pictures, pack
from ._read import record_of, text_of
from ._report import Report
from ._rounding import with_signs
from ._types import FileName, ItkObject

if TYPE_CHECKING:
    from matplotlib.figure import Figure

CHANNELS = ("R", "G1", "G2", "B")


class ChannelReports(PagedRecord):
    """Reports of the four planes of a Bayer mosaic: one record with a report for each.

        reports["bayer"]                    {"pattern": "RGGB", "source": "given", "file" or "levels"}
        reports["joint"]["offset"]          of all channels together; reports["joint"] is None where there is none
        reports["joint_vibration"]["sd_x"]  of all channels together [pixel of a plane]; None as joint
        reports["channels"]                 four records, in the order R, G1, G2, B
        reports.channel("G1")               one of them, a Report; its vibration is in pixels of the plane
        reports["warnings"]                 of all together; each channel has its own, too
        reports.maps["mean"]                arrays (y, x) of the mosaic, where they were asked for by maps=True
        reports.to_html("report.html")      one page of all channels
        reports.figure_data["G1"]["mean"]   the numbers of a channel's figures, as Report.figure_data

    print() shows a line a channel, the joint quantities and the warnings. It is a dict that cannot be changed, as
    Report. It has the members of NoiseReport: quantities(), plot(), to_html().

    See Also
    --------
    estimate_sensor_noise : Measures it.
    Report : The report of one channel, or of a monochrome sensor.
    compare : Several reports side by side.
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
        """`text`: the record as JSON, as C++ writes it. `table`: its table as text. `page`: packed page of all
        channels. `tables`, `pictures`: table and figures of each channel."""
        super().__init__(text, page)
        self._table = table
        self._tables = dict(tables or {})
        self._maps = Maps(maps or {})
        self._pictures = dict(pictures or {})

    @classmethod
    def of(cls, estimator: ItkObject, maps: Mapping[str, np.ndarray] | None = None) -> "ChannelReports":
        """Returns the reports of an ITK estimator that is up to date."""
        tables = {name: estimator.GetChannelReportAsText(name) for name in CHANNELS}
        page, pictures = pack(estimator.GetReportAsHtml()), Pictures.of_channels(estimator)
        return cls(estimator.GetReportAsJson(), estimator.GetReportAsText(), tables, maps, page, pictures)

    @classmethod
    def from_json(cls, source: str | FileName) -> "ChannelReports":
        """Reads the reports of a mosaic that were written as JSON: the same as Report.from_json().

        Parameters
        ----------
        source : str or os.PathLike
            The JSON text, or the name of its file.

        Returns
        -------
        ChannelReports

        Raises
        ------
        TypeError
            The source is neither.
        ValueError
            The file cannot be read, or holds no whole reports of a mosaic.
        """
        text, name = text_of(source)
        if "channels" not in record_of(text, name):
            raise ValueError(f"{name} has one report; expected the reports of a mosaic: Report.from_json()")
        return cls(text)

    def quantities(self) -> list[dict[str, Any]]:
        """Returns a row for every quantity of every channel, as in Report.quantities(), with the `channel`."""
        return [{"channel": name, **row} for name in CHANNELS for row in self.channel(name).quantities()]

    def plot(self) -> "Figure":
        """Draws the noise curves of the four channels into one new figure of matplotlib.pyplot, as Report.plot().

        Returns
        -------
        matplotlib.figure.Figure

        Raises
        ------
        ImportError
            matplotlib is not installed.
        ValueError
            Nothing was measured in any channel.
        """
        from ._figure import draw, new_grid

        data = self.figure_data
        if not any(data[name]["mean"] for name in CHANNELS):
            raise ValueError("the reports have no noise curve: no pixel was used; their warnings say why")
        drawn, grid = new_grid()
        for axes, name in zip(grid, CHANNELS, strict=True):
            axes.set_title(name)
            if data[name]["mean"]:
                draw(self.channel(name), data[name], axes, None)
        return drawn

    def channel(self, name: str) -> Report:
        """Returns the report of one channel: "R", "G1", "G2" or "B"."""
        if name not in CHANNELS:
            raise ValueError(f"channel is {name!r}; expected 'R', 'G1', 'G2' or 'B'")
        record = self["channels"][CHANNELS.index(name)]
        return Report(json.dumps(record) + "\n", self._tables.get(name, ""), pictures=self._pictures.get(name))

    @property
    def figure_data(self) -> dict[str, dict[str, Any]]:
        """The numbers of the figures of each channel, by its name, as in Report.figure_data."""
        return {name: self.channel(name).figure_data for name in CHANNELS}

    @property
    def maps(self) -> Maps:
        """Maps of the pixels of the mosaic, as Report.maps."""
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
        if not self._table:
            from ._report_text import text_of_channels

            return text_of_channels(self).rstrip("\n")
        return self._table.rstrip("\n")

    def __repr__(self) -> str:
        first = self["channels"][0]
        return (
            f"<ChannelReports: {first['frames']} frames, a {self['bayer']['pattern']} mosaic with planes of "
            f"{first['width']} x {first['height']} pixels>"
        )

    def _repr_html_(self) -> str:
        """Returns the quantities of all channels with the warnings, and the noise curves in one figure."""
        return self._notebook_html()

    def _notebook_html(self) -> str:
        lines = str(self).split("\n")
        end = next(number for number, line in enumerate(lines) if line.startswith("B "))
        columns = {name: {row[0]: row[1:] for row in rows_of_text(str(self.channel(name)))} for name in CHANNELS}
        rows = []
        for label in (with_signs(entry["label"]) for entry in quantity_list()):
            found = [columns[name].get(label) for name in CHANNELS]
            unit = next((row[1] for row in found if row), None)
            if unit is not None:
                cells = [(row[2] if row[0] == "-" else row[0]) if row else "" for row in found]
                rows.append((label, *cells, unit))
        curves = "".join(
            f'<div style="display:inline-block;margin:0.5em"><span>{name}</span>{curve}</div>'
            for name in CHANNELS
            if (curve := self.channel(name)._curve_element(320))
        )
        head = paragraphs(lines[: lines.index("")])
        return head + table(("quantity", *CHANNELS, "unit"), rows) + paragraphs(lines[end + 1 :]) + figure(curves)


def report_of(estimator: ItkObject, maps: Mapping[str, np.ndarray] | None = None) -> Report | ChannelReports:
    """Returns the report or the reports of an ITK estimator that is up to date."""
    if not hasattr(estimator, "GetReportAsHtml"):  # the single-image method, whose page is made from its record
        kind = ChannelReports if estimator.HasChannelReports() else Report
        return kind.from_json(estimator.GetReportAsJson())
    if estimator.HasChannelReports():
        return ChannelReports.of(estimator, maps)
    return Report.of(estimator, maps)
