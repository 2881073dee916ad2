# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Small figures as SVG, for notebooks: points with their errors, and lines, in the colours of the page."""

import base64
import html
import math
from collections.abc import Sequence
from dataclasses import dataclass, field

_WIDTH, _HEIGHT = 480, 300
_LEFT, _RIGHT, _TOP, _BOTTOM = 76, 14, 14, 50
_STYLE = (
    "text{fill:#1b1f24;font:13px system-ui,sans-serif}.paper{fill:#fff}.frame{fill:none;stroke:#57606a}"
    ".before{fill:none;stroke:#b85c00}.after{fill:#0072b2;stroke:#0072b2}.third{fill:none;stroke:#00795a;stroke-width:1.8}"
    ".zero{stroke:#57606a}.dashed{stroke-dasharray:7 5}"
    "@media(prefers-color-scheme:dark){text{fill:#e6edf3}.paper{fill:#0d1117}.frame,.zero{stroke:#a3adb8}"
    ".before{stroke:#f58a4b}.after{fill:#58a6ff;stroke:#58a6ff}.third{stroke:#2fc79a}}"
)


@dataclass
class Points:
    """Points of a figure; `errors` are their standard errors, `style` is "before" or "after"."""

    x: Sequence[float]
    y: Sequence[float]
    style: str = "after"
    errors: Sequence[float | None] = ()


@dataclass
class Plot:
    """A figure. `lines` are pairs of x and y, dashed if `is_dashed`; `level` is a horizontal line."""

    x_label: str
    y_label: str
    points: list[Points]
    lines: list[tuple[Sequence[float], Sequence[float]]] = field(default_factory=list)
    is_dashed: bool = False
    level: float | None = None

    def element(self, name: str, width: int = _WIDTH) -> str:
        """Returns the figure as an HTML element, an image with its own style."""
        source = base64.b64encode(self.text(name).encode()).decode()
        return f'<img alt="{html.escape(name)}" width="{width}" src="data:image/svg+xml;base64,{source}">'

    def text(self, name: str) -> str:
        """Returns the figure as the text of an SVG file."""
        xs, ys = self._numbers()
        x_axis, y_axis = _Axis(xs, _LEFT, _WIDTH - _RIGHT), _Axis(ys, _HEIGHT - _BOTTOM, _TOP)
        parts = [
            f'<svg viewBox="0 0 {_WIDTH} {_HEIGHT}" role="img" xmlns="http://www.w3.org/2000/svg" width="{_WIDTH}">',
            f"<title>{html.escape(name)}</title><style>{_STYLE}</style>",
            f'<rect class="paper" width="{_WIDTH}" height="{_HEIGHT}"/>',
            f'<rect class="frame" x="{_LEFT}" y="{_TOP}" width="{_WIDTH - _LEFT - _RIGHT}" '
            f'height="{_HEIGHT - _TOP - _BOTTOM}"/>',
        ]
        for tick in x_axis.ticks():
            parts.append(_label(x_axis.at(tick), _HEIGHT - _BOTTOM + 18, f"{tick:g}", "middle"))
        for tick in y_axis.ticks():
            parts.append(_label(_LEFT - 6, y_axis.at(tick) + 4, f"{tick:g}", "end"))
        parts.append(_label((_LEFT + _WIDTH - _RIGHT) / 2, _HEIGHT - 10, self.x_label, "middle"))
        parts.append(
            f'<text transform="translate(16 {(_TOP + _HEIGHT - _BOTTOM) / 2:.1f}) rotate(-90)" text-anchor="middle">'
            f"{html.escape(self.y_label)}</text>"
        )
        if self.level is not None:
            at = y_axis.at(self.level)
            parts.append(f'<path class="zero" d="M{_LEFT} {at:.1f}H{_WIDTH - _RIGHT}"/>')
        for x, y in self.lines:
            places = "L".join(f"{x_axis.at(a):.1f} {y_axis.at(b):.1f}" for a, b in zip(x, y, strict=True))
            parts.append(f'<path class="third{" dashed" if self.is_dashed else ""}" d="M{places}"/>')
        for points in self.points:
            parts += _drawn(points, x_axis, y_axis)
        return "".join([*parts, "</svg>"])

    def _numbers(self) -> tuple[list[float], list[float]]:
        """Returns all values that the axes have to contain."""
        xs: list[float] = []
        ys: list[float] = [] if self.level is None else [self.level]
        for points in self.points:
            xs += points.x
            ys += points.y
            ys += [y + sign * (e or 0.0) for y, e in zip(points.y, points.errors, strict=False) for sign in (-1, 1)]
        for x, y in self.lines:
            xs += x
            ys += y
        return xs, ys


class _Axis:
    """Numbers along an axis, and where they lie [pixel]."""

    def __init__(self, numbers: Sequence[float], start: float, end: float) -> None:
        low, high = min(numbers), max(numbers)
        margin = 0.05 * (high - low) or 0.5 * abs(high) or 1.0
        self._low, self._high = low - margin, high + margin
        self._start, self._end = start, end

    def at(self, number: float) -> float:
        return self._start + (number - self._low) / (self._high - self._low) * (self._end - self._start)

    def ticks(self) -> list[float]:
        """Returns four to nine round numbers."""
        power = 10.0 ** math.floor(math.log10((self._high - self._low) / 4))
        step = next(factor * power for factor in (5.0, 2.0, 1.0) if (self._high - self._low) / (factor * power) >= 4)
        first = math.ceil(self._low / step)
        last = math.floor(self._high / step)
        return [round(number * step, 12) for number in range(first, last + 1)]


def _label(x: float, y: float, text: str, anchor: str) -> str:
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}">{html.escape(text)}</text>'


def _drawn(points: Points, x_axis: _Axis, y_axis: _Axis) -> list[str]:
    parts = []
    errors = [*points.errors, *[None] * (len(points.x) - len(points.errors))]
    for x, y, error in zip(points.x, points.y, errors, strict=True):
        if error is not None:
            ends = f"M{x_axis.at(x):.1f} {y_axis.at(y - error):.1f}V{y_axis.at(y + error):.1f}"
            parts.append(f'<path class="{points.style}" d="{ends}"/>')
        parts.append(f'<circle class="{points.style}" cx="{x_axis.at(x):.1f}" cy="{y_axis.at(y):.1f}" r="3"/>')
    return parts
