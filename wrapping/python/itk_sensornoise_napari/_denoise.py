# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""The widget that stabilises and denoises layers by a measured noise model."""

import importlib.util
from typing import TYPE_CHECKING, Any

from itk_sensornoise import Report
from qtpy.QtWidgets import QCheckBox, QComboBox, QDoubleSpinBox, QFileDialog, QPushButton

from ._actions import ACTIONS, DENOISERS, action_of
from ._layers import REPORT, images, pixels_of, place_of, report_of
from ._panel import Panel, index_of

if TYPE_CHECKING:
    from napari.viewer import Viewer

# The limits of denoise_with_noise_model().
_LEAST_STRENGTH, _GREATEST_STRENGTH = 0.1, 10.0


class StabiliseDenoise(Panel):
    """Applies the generalized Anscombe transform, its inverse, or a denoiser between both, with the noise model of a
    measured layer or of a stored report."""

    def __init__(self, napari_viewer: "Viewer") -> None:
        super().__init__(napari_viewer, "Apply")
        self._stored: dict[str, Report] = {}
        self.layer = self.layer_list("image")
        self.model = QComboBox()
        self.form.addRow("noise model", self.model)
        self.open_button = QPushButton("Open report (JSON)…")
        self.open_button.clicked.connect(lambda: self.attempt(self._ask_for_report))
        self.form.addRow("", self.open_button)
        self.action = QComboBox()
        for words in ACTIONS:
            self.action.addItem(words)
        self.form.addRow("action", self.action)
        self.denoiser = QComboBox()
        for name, (words, module) in DENOISERS.items():
            if importlib.util.find_spec(module) is not None:
                self.denoiser.addItem(words, name)
        self.form.addRow("denoiser", self.denoiser)
        self.strength = QDoubleSpinBox()
        self.strength.setRange(_LEAST_STRENGTH, _GREATEST_STRENGTH)
        self.strength.setSingleStep(0.1)
        self.strength.setValue(1.0)
        self.strength.setToolTip("Relative to the best strength for the measured noise.")
        self.form.addRow("strength", self.strength)
        self.one_frame = QCheckBox("only the frame that is shown")
        self.form.addRow("", self.one_frame)
        self.column.addStretch()
        self.action.currentIndexChanged.connect(self._show_options)
        self.layer.currentIndexChanged.connect(self._choose_model)
        self._show_options()
        self.layers_changed()

    def _show_options(self, *_: Any) -> None:
        """Enables the settings that the action needs."""
        is_denoising = self.action.currentText() == "denoise"
        self.denoiser.setEnabled(is_denoising)
        self.strength.setEnabled(is_denoising)

    def layers_changed(self) -> None:
        """Lists the noise models, reports of measured layers and stored reports. The choice is kept."""
        chosen = self.model.currentData()
        self.model.clear()
        for layer in reversed(images(self.viewer.layers)):
            report = report_of(layer)
            if report is not None and index_of(self.model, report) < 0:
                self.model.addItem(layer.name, report)
        for name, report in self._stored.items():
            self.model.addItem(name, report)
        self.choose(self.model, chosen)

    def _choose_model(self, *_: Any) -> None:
        """Chooses the model of the image itself, if it has one."""
        layer = self.layer.currentData()
        if layer is not None:
            self.choose(self.model, report_of(layer))

    def _ask_for_report(self) -> None:
        path, _ = QFileDialog.getOpenFileName(self, "Open report", "", "JSON (*.json)")
        if path:
            self.open_report(path)

    def open_report(self, path: str) -> None:
        """Reads a stored report and chooses it. Raises ValueError if the file is no report of one channel."""
        report = Report.from_json(path)
        self._stored[path] = report
        self.layers_changed()
        self.choose(self.model, report)

    def run(self) -> None:
        """Applies the action to the chosen layer in the background."""
        self.attempt(self._start)

    def _start(self) -> None:
        layer = self.layer.currentData()
        if layer is None:
            raise ValueError("There is no image layer. Open an image first.")
        self.layers_changed()
        report = self.model.currentData()
        if report is None:
            raise ValueError("There is no noise model. Measure a layer first, or open a stored report.")
        pixels = pixels_of(layer)
        if self.one_frame.isChecked() and pixels.ndim > 2:
            shown = layer.world_to_data(self.viewer.dims.point[-layer.ndim :])[: pixels.ndim - 2]
            pixels = pixels[tuple(min(max(round(at), 0), pixels.shape[axis] - 1) for axis, at in enumerate(shown))]
        action = self.action.currentText()
        work = action_of(action, pixels, report, self.denoiser.currentData(), self.strength.value(), self.advance)
        self.start(work, lambda result: self._show(layer, report, action, result))

    def _show(self, layer: Any, report: Report, action: str, result: Any) -> None:
        """Adds the result as a layer, which keeps the noise model."""
        levels = {"contrast_limits": layer.contrast_limits} if action == "denoise" else {}
        self.progress.setValue(100)
        self.viewer.add_image(
            result,
            name=f"{layer.name}: {ACTIONS[action]}",
            colormap=layer.colormap.name,
            metadata={REPORT: report},
            **levels,
            **place_of(layer, result.ndim),
        )
