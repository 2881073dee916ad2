# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""The report of an estimate: a mapping that prints, draws and travels."""

import html
import json
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


class Report(Mapping[str, Any]):
    """All that was measured from one stack: the record "itk-sensornoise-report/1", the same names as in its JSON.

        report["gain"]["value"], report["gain"]["unit"], report["gain"]["status"]
        report["warnings"]

    A value that is not identified is None. print() shows the table of `estimate-sensor-noise` and the warnings, a
    notebook also the noise curve, plot() draws that. Equal to any mapping with the same content; can be pickled.
    """

    def __init__(self, text: str, table: str = "") -> None:
        """`text`: the record as JSON, as C++ writes it. `table`: the same for people."""
        self._text = text
        self._table = table
        self._record: dict[str, Any] = json.loads(text)

    @classmethod
    def of(cls, estimator: Any) -> "Report":
        """The report of an ITK estimator that is up to date."""
        return cls(estimator.GetReportAsJson(), estimator.GetReportAsText())

    def __getitem__(self, name: str) -> Any:
        return self._record[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._record)

    def __len__(self) -> int:
        return len(self._record)

    __hash__ = None  # type: ignore[assignment]  # what it holds can be changed

    def __reduce__(self) -> tuple[Any, ...]:
        return Report, (self._text, self._table)

    def __str__(self) -> str:
        return self._table.rstrip("\n")

    def __repr__(self) -> str:
        gain = self["gain"]
        found = gain["status"] if gain["value"] is None else f"{gain['value']:.5g} {gain['unit']}"
        return f"<Report: {self['frames']} frames of {self['width']} x {self['height']} pixels, gain {found}>"

    def to_json(self) -> str:
        """The record as C++ writes it: the same bytes as `estimate-sensor-noise --json`."""
        return self._text

    def plot(self, axes: "Axes | None" = None) -> "Figure":
        """Draws the temporal variance, as it is and corrected for flicker, against the mean, and the line through the
        corrected one, as the paper's Figure 4: the noise curve of the camera. Where the gain is not identified, the
        line is dashed and indicative; where the response bends, the legend says how much.

        axes: where to draw; default: a new figure of matplotlib.pyplot. Returns the figure. Raises ImportError if
        matplotlib is not installed, ValueError if nothing was measured.
        """
        from ._figure import draw, new_axes

        return draw(self, new_axes() if axes is None else axes)

    def _repr_html_(self) -> str:
        """The table with its warnings and, where matplotlib is installed, the noise curve as an image of its own."""
        picture = ""
        if self["scatter"]["mean"]:
            try:
                from ._figure import as_svg

                picture = as_svg(self)
            except ImportError:
                pass
        return f"<pre>{html.escape(str(self))}</pre>{picture}"
