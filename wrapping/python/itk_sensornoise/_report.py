# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""The report of an estimate: a mapping that prints, draws and travels."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from ._catalogue import quantity_list
from ._html import figure, table_of_text
from ._maps import Maps
from ._pictures import PagedRecord, Pictures
from ._quantity import Quantity, member
from ._read import record_of, text_of
from ._types import FileName, ItkObject

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


class QuantityAttributes:
    """Quantities of the first level of a report as attributes, and all quantities by their paths."""

    def quantity(self, path: str) -> Quantity:
        """Returns the quantity at a path of quantity_list(), for example "vibration.sd_x".

        Raises KeyError for another path, and where the report has nothing of it.
        """
        found = member(self, path)  # type: ignore[arg-type]  # a Report is a mapping
        if path not in {entry["path"] for entry in quantity_list()} or found is None:
            raise KeyError(f"{path!r} is no quantity of the report; itk_sensornoise.quantity_list() names them")
        return Quantity.of(found)

    @property
    def gain(self) -> Quantity:
        """System gain g [DN/e-]."""
        return self.quantity("gain")

    @property
    def offset(self) -> Quantity:
        """Dark offset mu [DN]."""
        return self.quantity("offset")

    @property
    def read_noise(self) -> Quantity:
        """Read noise sigma [DN], rms over all pixels, without quantization noise."""
        return self.quantity("read_noise")

    @property
    def read_noise_median(self) -> Quantity:
        """Read noise of the median pixel [DN], which only dark frames determine."""
        return self.quantity("read_noise_median")

    @property
    def read_noise_electrons(self) -> Quantity:
        """Read noise over gain [e-]."""
        return self.quantity("read_noise_electrons")

    @property
    def intercept(self) -> Quantity:
        """Intercept of the photon transfer line, sigma^2 - g mu, without quantization noise [DN^2]."""
        return self.quantity("intercept")

    @property
    def variance_slope(self) -> Quantity:
        """Slope of a pixel's variance against its level, in the frames as they are, for a denoiser [DN/e-]."""
        return self.quantity("variance_slope")

    @property
    def total_intercept(self) -> Quantity:
        """Intercept of a pixel's variance, in the frames as they are, for a denoiser [DN^2]."""
        return self.quantity("total_intercept")

    @property
    def flicker_sd(self) -> Quantity:
        """Standard deviation of the illumination factor [1]."""
        return self.quantity("flicker_sd")


class Report(QuantityAttributes, PagedRecord):
    """Results of one stack: the record "itk-sensornoise-report/1", the same names as in its JSON.

        report.gain.value, report.gain.standard_error, report.gain.interval95, report.gain.status
        report["gain"]["value"]       the same, by the names of the JSON
        report["warnings"]
        report.maps["mean"]           arrays (y, x), where estimate_sensor_noise() was asked for them by maps=True
        report.to_html("report.html") one page with tables, figures and maps, to look at and to file
        report.figure_data["mean"]    the numbers of its figures

    A value that is not identified is None. print() shows the table of `estimate-sensor-noise` and the warnings, a
    notebook also the noise curve, plot() draws that with matplotlib. It is a dict: json.dumps() writes it, and it
    equals any dict with the same content (maps and pictures are not part of that). It cannot be changed, which would be
    a TypeError: to_dict() gives a copy that can, and that is no report. It can be pickled, with its maps and pictures;
    from_json() reads its JSON again.

    See Also
    --------
    estimate_sensor_noise : Measures it.
    ChannelReports : The reports of a mosaic's channels.
    compare : Several reports side by side.
    """

    def __init__(
        self,
        text: str,
        table: str = "",
        maps: Mapping[str, np.ndarray] | None = None,
        pictures: Pictures | None = None,
    ) -> None:
        """`text`: the record as JSON, as C++ writes it. `table`: its table as text. `maps`: arrays by name."""
        super().__init__(text, None if pictures is None else pictures.page)
        self._table = table
        self._maps = Maps(maps or {})
        self._pictures = pictures

    @classmethod
    def of(cls, estimator: ItkObject, maps: Mapping[str, np.ndarray] | None = None) -> "Report":
        """Returns the report of an ITK estimator that is up to date."""
        return cls(estimator.GetReportAsJson(), estimator.GetReportAsText(), maps, Pictures.of(estimator))

    @classmethod
    def from_json(cls, source: str | FileName) -> "Report":
        """Reads a report that was written as JSON: by to_json(), json.dump() or `estimate-sensor-noise --json`.

        The table, plot(), quantities() and compare() say the same as before. The maps are not in the JSON: asking for
        one is a KeyError, and the page has none.

        Parameters
        ----------
        source : str or os.PathLike
            The JSON text, or the name of its file.

        Returns
        -------
        Report

        Raises
        ------
        TypeError
            The source is neither.
        ValueError
            The file cannot be read, or holds no whole report of one channel.

        Examples
        --------
        >>> with open("report.json", "w") as file:
        ...     json.dump(report, file)
        >>> itk_sensornoise.Report.from_json("report.json") == report
        True

        See Also
        --------
        ChannelReports.from_json : Reads the reports of a mosaic.
        """
        text, name = text_of(source)
        if "channels" in record_of(text, name):
            raise ValueError(f"{name} has the channels of a mosaic; expected one report: ChannelReports.from_json()")
        return cls(text)

    @property
    def maps(self) -> "Maps":
        """Maps of every pixel, arrays (y, x) by the names of the files that `--maps` writes; empty unless
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
            lags                                 dicts as in noise_correlation

        A list is empty where there is nothing of it. `is_indicative`, a bool: there is a line, but no gain.
        `residual_spread`, a number: largest factor on the scatter of residuals by the noise correlation of neighbours
        [1].
        """
        if self._pictures is not None:
            return self._pictures.figure_data()
        from ._figure_data import figure_data_of

        return figure_data_of(self)

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self._text, self._table, dict(self._maps), self._pictures)

    def __str__(self) -> str:
        if not self._table:
            from ._report_text import text_of_report

            return text_of_report(self).rstrip("\n")
        return self._table.rstrip("\n")

    def __repr__(self) -> str:
        gain = self["gain"]
        found = gain["status"] if gain["value"] is None else f"{gain['value']:.5g} {gain['unit']}"
        return f"<Report: {self['frames']} frames of {self['width']} x {self['height']} pixels, gain {found}>"

    def quantities(self) -> list[dict[str, Any]]:
        """Returns every quantity as a row: `path`, `label` and `meaning` of quantity_list(), then `value`,
        `standard_error`, `interval95`, `status`, `unit`, `bracket` of the report. A quantity that was not looked at, as
        the correlation of the noise by the published method, has no row.

        Examples
        --------
        >>> pandas.DataFrame(report.quantities())
        """
        rows = []
        for entry in quantity_list():
            found = member(self, entry["path"])
            if found is not None:
                rows.append({**entry, **found})
        return rows

    def plot(self, ax: "Axes | None" = None) -> "Figure":
        """Draws the noise curve of the camera, as Figure 4 of the paper: the temporal variance, as it is and without
        flicker and motion, against the mean, and the line through the latter with its 95 % band. Where the gain is not
        identified, the line is dashed and indicative; where the response is not linear, the legend says how much.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Axes to draw into. Default: the axes of a new figure of matplotlib.pyplot, which has the residuals below.

        Returns
        -------
        matplotlib.figure.Figure
            The figure; its `axes` are all of its axes. A new one is shown by plt.show() in a program and at the end of
            its cell in a notebook, once, also where the call is the last line of the cell.

        Raises
        ------
        ImportError
            matplotlib is not installed.
        ValueError
            Nothing was measured.

        Examples
        --------
        >>> report.plot().savefig("curve.png")
        """
        from ._figure import draw, new_axes

        data = self.figure_data
        if not data["mean"]:
            raise ValueError("the report has no noise curve: no pixel was used; its warnings say why")
        return draw(self, data, *(new_axes(data) if ax is None else (ax, None)))

    def _repr_html_(self) -> str:
        """Returns the table with its warnings and, if any, the noise curve."""
        return self._notebook_html()

    def _notebook_html(self) -> str:
        return table_of_text(str(self)) + figure(self._curve_element(480))

    def _curve_element(self, width: int) -> str:
        """Returns the noise curve as an HTML element; "" without a curve."""
        data = self.figure_data
        if not data["mean"]:
            return ""
        if self._pictures is not None:
            return self._pictures.curve_element(width)
        from ._svg import Plot, Points

        known = [(x, y) for x, y in zip(data["mean"], data["variance"], strict=True) if y is not None]
        before = Points([x for x, _ in known], [y for _, y in known], "before")
        after = Points(data["mean"], data["corrected_variance"])
        lines = [(data["line_mean"], data["line_variance"])] if data["line_mean"] else []
        curve = Plot("mean [DN]", "variance [DN²]", [before, after], lines, data["is_indicative"])
        return curve.element("noise curve", width)
