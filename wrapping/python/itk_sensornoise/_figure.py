# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""The noise curve, drawn with matplotlib, which is imported only when it is used."""

import base64
import io
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

#: Codes of warnings that tell of a response that bends.
BENDS = {"response-not-straight", "variance-not-affine"}


def new_axes() -> "Axes":
    """Axes in a new figure, which a notebook or plt.show() shows."""
    import matplotlib.pyplot as plt

    axes: Axes = plt.subplots(layout="constrained")[1]
    return axes


def draw(report: Mapping[str, Any], axes: "Axes") -> "Figure":
    """Variance and corrected variance against mean, each point an average over pixels, and the line through the latter.

    The line has the total intercept: codes add their noise to the points, too. Where the gain is not identified, the
    line through all levels is dashed: indicative, no measurement. Where the response bends, the legend says how far the
    variance departs from its line.

    Raises ValueError if no pixel was used.
    """
    scatter = report["scatter"]
    mean = scatter["mean"]
    if not mean:
        raise ValueError("the report has no noise curve: no pixel was used; its warnings say why")
    for values, style, label in (
        (scatter["variance"], "C1.", "variance"),
        (scatter["corrected_variance"], "C0.", "variance, flicker corrected"),
    ):
        axes.plot(mean, [float("nan") if value is None else value for value in values], style, label=label)
    gain, intercept = report["variance_slope"]["value"], report["total_intercept"]["value"]
    indicative = report["fit"].get("line")
    if gain is not None and intercept is not None:
        _draw_line(axes, mean, gain, intercept, "k-", "")
    elif indicative is not None:
        _draw_line(axes, mean, indicative["gain"], indicative["intercept"], "k--", "indicative: ")
    axes.set_xlabel("mean [DN]")
    axes.set_ylabel("temporal variance [DN$^2$]")
    axes.legend(title=_bend(report))
    figure: Figure = axes.figure.figure  # the whole one, also of axes in a subfigure
    return figure


def _draw_line(axes: "Axes", mean: Sequence[float], gain: float, intercept: float, style: str, what: str) -> None:
    ends = [min(mean), max(mean)]
    label = f"{what}{gain:.4g} mean {'+' if intercept >= 0 else '-'} {abs(intercept):.4g}"
    axes.plot(ends, [gain * end + intercept for end in ends], style, linewidth=1, label=label)


def _bend(report: Mapping[str, Any]) -> str | None:
    """How far the variance departs from its line, where a warning tells of it."""
    bend = report["fit"].get("nonlinearity")
    codes = {warning["code"] for warning in report["warnings"]}
    if not bend or codes.isdisjoint(BENDS):
        return None
    return f"the response bends: variance off its line by up to {100 * bend:.2g} %"


def as_svg(report: Mapping[str, Any]) -> str:
    """The noise curve as an HTML element."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(6, 4), layout="constrained")
    draw(report, figure.subplots())
    buffer = io.BytesIO()
    figure.savefig(buffer, format="svg")
    return f'<img alt="noise curve" src="data:image/svg+xml;base64,{base64.b64encode(buffer.getvalue()).decode()}">'
