# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""The noise curve, drawn with matplotlib, which is imported only when it is used. Every number in it is of C++."""

import functools
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

#: Codes of the warnings of a non-linear response.
NONLINEARITY_CODES = {"response-not-straight", "variance-not-affine"}

#: Colours of the page, distinguishable without colour vision; markers and dashes differ, too.
BEFORE, AFTER, LINE = "#b85c00", "#0072b2", "#00795a"


def new_axes(data: Mapping[str, Any]) -> "tuple[Axes, Axes | None]":
    """Returns the axes of the noise curve and, below, the axes of the residuals, if any, in a new figure, which a
    notebook or plt.show() shows."""
    if not data["residual"]:
        return _new_figure().subplots(), None
    curve, residuals = _new_figure(figsize=(6.4, 6)).subplots(2, sharex=True, height_ratios=[3, 1])
    return curve, residuals


def new_grid() -> "tuple[Figure, Sequence[Axes]]":
    """Returns a new figure with axes for four channels."""
    figure = _new_figure(figsize=(9.6, 7.2))
    return figure, list(figure.subplots(2, 2).flat)


def _new_figure(**options: Any) -> "Figure":
    """Returns a figure of matplotlib.pyplot. Notebooks show this figure at the end of the cell. They do not show it a
    second time if it is the value of the last line of the cell."""
    import matplotlib.pyplot as plt

    figure: Figure = plt.figure(layout="constrained", **options)
    vars(figure)["_ipython_display_"] = functools.partial(_display_once, figure)
    return figure


def _display_once(figure: "Figure") -> None:
    """Closes a figure that IPython is about to show, where it would be shown again at the end of the cell. By
    NotImplementedError, IPython shows it as it does others."""
    import matplotlib
    import matplotlib.pyplot as plt

    if "inline" in matplotlib.get_backend().lower():
        plt.close(figure)
    raise NotImplementedError


def draw(report: Mapping[str, Any], data: Mapping[str, Any], axes: "Axes", residuals: "Axes | None") -> "Figure":
    """Draws variance and corrected variance against mean, the line and its 95 % band. A point is a mean over pixels.

    Where there is no gain, the line is dashed: indicative, no measurement. Where the response is non-linear, the legend
    gives the deviation of the variance from its line.
    """
    before = [float("nan") if value is None else value for value in data["variance"]]
    axes.plot(data["mean"], before, "o", color=BEFORE, markersize=4, markerfacecolor="none", label="as it is")
    axes.plot(
        data["mean"], data["corrected_variance"], "o", color=AFTER, markersize=4, label="without flicker and motion"
    )
    if data["line_mean"]:
        style, label = ("--", "line, indicative: no gain") if data["is_indicative"] else ("-", "line")
        axes.plot(data["line_mean"], data["line_variance"], style, color=LINE, linewidth=1.8, label=label)
    if data["band_low"]:
        ends = data["line_mean"], data["band_low"], data["band_high"]
        axes.fill_between(*ends, color=LINE, alpha=0.22, linewidth=0, label="its 95 % band")
    axes.set_ylabel("variance [DN$^2$]")
    axes.legend(title=_nonlinearity(report))
    if residuals is not None:
        _draw_residuals(data, residuals)
    (axes if residuals is None else residuals).set_xlabel("mean [DN]")
    figure: Figure = axes.figure.figure  # the whole one, also of axes in a subfigure
    return figure


def _draw_residuals(data: Mapping[str, Any], axes: "Axes") -> None:
    axes.axhspan(-2, 2, color=LINE, alpha=0.22, linewidth=0)
    axes.axhline(0, color="0.4", linewidth=1)
    axes.plot(data["residual_mean"], data["residual"], "o", color=AFTER, markersize=3)
    axes.set_ylabel("residual\n[standard errors]")


def _nonlinearity(report: Mapping[str, Any]) -> str | None:
    """Returns text on the deviation of the variance from its line, if a warning names it."""
    nonlinearity = report["fit"].get("nonlinearity")
    codes = {warning["code"] for warning in report["warnings"]}
    if not nonlinearity or codes.isdisjoint(NONLINEARITY_CODES):
        return None
    return f"the response is non-linear: variance off its line by up to {100 * nonlinearity:.2g} %"
