# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""The report of an estimate: a mapping that prints, draws and travels."""

import html
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from ._catalogue import quantity_list
from ._maps import Maps
from ._pictures import PagedRecord, Pictures
from ._types import ItkObject

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


class Report(PagedRecord):
    """All that was measured from one stack: the record "itk-sensornoise-report/1", the same names as in its JSON.

        report["gain"]["value"], report["gain"]["unit"], report["gain"]["status"]
        report["warnings"]
        report.maps["mean"]           arrays (y, x), where estimate_sensor_noise() was asked for them by maps=True
        report.to_html("report.html") one page with tables, figures and maps, to look at and to file
        report.figure_data["mean"]    the numbers of its figures

    A value that is not identified is None. print() shows the table of `estimate-sensor-noise` and the warnings, a
    notebook also the noise curve, plot() draws that with matplotlib. It is a dict: json.dumps() writes it, and it
    equals any dict with the same content (maps and pictures are not part of that). It cannot be changed, which would be
    a TypeError: to_dict() gives a copy that can, and that is no report. It can be pickled, with its maps and pictures.
    """

    def __init__(
        self,
        text: str,
        table: str = "",
        maps: Mapping[str, np.ndarray] | None = None,
        pictures: Pictures | None = None,
    ) -> None:
        """`text`: the record as JSON, as C++ writes it. `table`: the same for people. `maps`: arrays by name."""
        super().__init__(text, None if pictures is None else pictures.page)
        self._table = table
        self._maps = Maps(maps or {})
        self._pictures = pictures

    @classmethod
    def of(cls, estimator: ItkObject, maps: Mapping[str, np.ndarray] | None = None) -> "Report":
        """The report of an ITK estimator that is up to date."""
        return cls(estimator.GetReportAsJson(), estimator.GetReportAsText(), maps, Pictures.of(estimator))

    @property
    def maps(self) -> "Maps":
        """What is known of every pixel, arrays (y, x) by the names of the files that `--maps` writes; empty unless
        estimate_sensor_noise() was called with maps=True."""
        return self._maps

    @property
    def figure_data(self) -> dict[str, Any]:
        """The numbers of the figures, a list each, as C++ draws them and plot() does; None for what is not known.

            mean, variance, corrected_variance   points of the noise curve, bins of levels [DN, DN^2, DN^2]
            residual_mean, residual              corrected variance less the line, over the point's standard error [1]
            line_mean, line_variance             the line from the darkest to the brightest level [DN, DN^2]
            band_low, band_high                  ends of its 95 % interval at line_mean [DN^2]
            flicker, motion_x, motion_y          of every frame [1, pixel, pixel]
            lags                                 what neighbours and frames share: dicts as in noise_correlation

        A list is empty where there is nothing of it. `is_indicative`, a bool: there is a line, but no gain.
        `residual_spread`, a number: how much further residuals scatter at most, as neighbours share their noise [1].
        """
        if self._pictures is None:
            raise ValueError("the report was made of its text alone and has no figures; expected one of an estimator")
        return self._pictures.figure_data()

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self._text, self._table, dict(self._maps), self._pictures)

    def __str__(self) -> str:
        return self._table.rstrip("\n")

    def __repr__(self) -> str:
        gain = self["gain"]
        found = gain["status"] if gain["value"] is None else f"{gain['value']:.5g} {gain['unit']}"
        return f"<Report: {self['frames']} frames of {self['width']} x {self['height']} pixels, gain {found}>"

    def quantities(self) -> list[dict[str, Any]]:
        """Every quantity as a row: `path`, `label` and `meaning` of quantity_list(), then what the report has of it:
        `value`, `standard_error`, `interval95`, `status`, `unit`, `bracket`. For a table: pandas.DataFrame() of it.
        What was not looked at, as the noise's correlation by the published method, has no row."""
        rows = []
        for entry in quantity_list():
            found: Any = self
            for name in entry["path"].split("."):
                found = found[name] if found is not None else None
            if found is not None:
                rows.append({**entry, **found})
        return rows

    def plot(self, ax: "Axes | None" = None) -> "Figure":
        """Draws the temporal variance, as it is and without flicker and motion, against the mean, and the line through
        the latter with its 95 % band, as the paper's Figure 4: the noise curve of the camera. Where the gain is not
        identified, the line is dashed and indicative; where the response bends, the legend says how much.

        ax: matplotlib's axes to draw into; default: those of a new figure of matplotlib.pyplot, which has the residuals
        below. Returns their figure, whose `axes` are all of its axes. Raises ImportError if matplotlib is not
        installed, ValueError if nothing was measured.
        """
        from ._figure import draw, new_axes

        data = self.figure_data
        if not data["mean"]:
            raise ValueError("the report has no noise curve: no pixel was used; its warnings say why")
        return draw(self, data, *(new_axes(data) if ax is None else (ax, None)))

    def _repr_html_(self) -> str:
        """The table with its warnings and, where there is one, the noise curve."""
        return f"<pre>{html.escape(str(self))}</pre>{self._curve_element(480)}"

    def _curve_element(self, width: int) -> str:
        """The noise curve as an HTML element; "" where there is none."""
        if self._pictures is None or not self.figure_data["mean"]:
            return ""
        return self._pictures.curve_element(width)
