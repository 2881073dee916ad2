# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""The widget that measures the noise of a camera from the burst in a layer."""

from typing import TYPE_CHECKING, Any

from itk_sensornoise import ChannelReports, Report, estimate_sensor_noise
from qtpy.QtWidgets import QComboBox, QDoubleSpinBox, QLineEdit

from ._layers import REPORT, add_maps, frames_of, plain
from ._panel import Panel
from ._report_view import ReportView

if TYPE_CHECKING:
    from napari.viewer import Viewer

_METHODS = {
    "refined (a burst)": "refined",
    "published (a burst)": "published",
    "single image": "single-image",
}
_PATTERNS = {
    "found in the frames": "auto",
    "none (monochrome)": "none",
    **{name: name for name in ("RGGB", "GRBG", "GBRG", "BGGR")},
}
# The excess noise factor is 2 for an EMCCD camera, and up to 4 for an intensified camera.
_GREATEST_EXCESS_NOISE = 10.0


class MeasureNoise(Panel):
    """Measures the selected layer (t, y, x) in the background. Adds the maps as layers and shows the report."""

    def __init__(self, napari_viewer: "Viewer") -> None:
        super().__init__(napari_viewer, "Measure")
        self.layer = self.layer_list("burst (t, y, x)")
        self.dark = self.layer_list("dark frames", "none")
        self.method = self._choices("method", _METHODS)
        self.bayer = self._choices("colour filters", _PATTERNS)
        self.offset = QLineEdit()
        self.offset.setPlaceholderText("not known")
        self.offset.setToolTip("Dark offset in DN, if it is known. Dark frames are the better way.")
        self.form.addRow("dark offset [DN]", self.offset)
        self.excess_noise = QDoubleSpinBox()
        self.excess_noise.setRange(1.0, _GREATEST_EXCESS_NOISE)
        self.excess_noise.setSingleStep(0.1)
        self.excess_noise.setToolTip("1 for most cameras, 2 for an EMCCD camera.")
        self.form.addRow("excess noise factor", self.excess_noise)
        self.view = ReportView(self.attempt)
        self.column.addWidget(self.view)
        self.layers_changed()
        self.follow(napari_viewer.layers.selection.events.active, callback=self.layers_changed)

    def _choices(self, label: str, choices: dict[str, str]) -> QComboBox:
        box = QComboBox()
        for words, value in choices.items():
            box.addItem(words, value)
        self.form.addRow(label, box)
        return box

    def layers_changed(self, event: Any = None) -> None:
        """Chooses the layer that is selected in the viewer."""
        active = plain(self.viewer.layers.selection.active)
        if active is not self.dark.currentData():
            self.choose(self.layer, active)

    def run(self) -> None:
        """Measures the chosen layer in the background."""
        self.attempt(self._start)

    def _start(self) -> None:
        layer = self.layer.currentData()
        if layer is None:
            raise ValueError("There is no image layer. Open a burst of raw frames first.")
        method = self.method.currentData()
        frames = frames_of(layer, is_frame_allowed=method == "single-image")
        options: dict[str, Any] = dict(
            method=method,
            bayer=self.bayer.currentData(),
            offset=_number(self.offset.text()),
            excess_noise_factor=self.excess_noise.value(),
            maps=method != "single-image",
        )
        if self.dark.currentData() is not None:
            options["dark"] = frames_of(self.dark.currentData())
        self.start(
            lambda: estimate_sensor_noise(frames, progress=self.advance, **options),
            lambda report: self._show(layer, report),
        )

    def _show(self, layer: Any, report: Report | ChannelReports) -> None:
        """Keeps the report with its layer, shows it, and adds the maps."""
        self.view.show_report(report)
        layer.metadata = {**layer.metadata, REPORT: report}
        if layer in self.viewer.layers:
            add_maps(self.viewer, layer, report.maps)
            self.viewer.layers.selection.active = layer


def _number(text: str) -> float | None:
    """Returns the number that was typed; None for no text. Raises ValueError for other text."""
    if not text.strip():
        return None
    try:
        return float(text.replace(",", "."))
    except ValueError:
        raise ValueError(f"The dark offset is '{text}'. Expected: a number in DN, or nothing.") from None
