# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Shows a report and saves it."""

import re
from collections.abc import Callable
from typing import Any

from itk_sensornoise import ChannelReports, Report
from qtpy.QtWidgets import QFileDialog, QHBoxLayout, QPushButton, QTextBrowser, QVBoxLayout, QWidget

# The table fits into a dock of napari of the usual width.
_FONT_PIXELS = 10
# Qt draws a part of SVG only, and the noise curve wrongly: the page shows it.
_FIGURE = re.compile("<figure.*?</figure>", re.DOTALL)


class ReportView(QWidget):
    """The table and the warnings of a report, with buttons that save its page and its record."""

    def __init__(self, attempt: Callable[[Callable[[], Any]], None]) -> None:
        """`attempt`: calls a function and shows the sentence of its error."""
        super().__init__()
        self.report: Report | ChannelReports | None = None
        self.text = QTextBrowser()
        self.text.setStyleSheet(f"font-size: {_FONT_PIXELS}px")
        self.page_button, self.json_button = QPushButton("Save page…"), QPushButton("Save JSON…")
        self.page_button.clicked.connect(
            lambda: attempt(lambda: self._ask("Save page", "report.html", "Page (*.html)", self.save_page))
        )
        self.json_button.clicked.connect(
            lambda: attempt(lambda: self._ask("Save JSON", "report.json", "JSON (*.json)", self.save_json))
        )
        column, buttons = QVBoxLayout(self), QHBoxLayout()
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(self.text)
        buttons.addWidget(self.page_button)
        buttons.addWidget(self.json_button)
        column.addLayout(buttons)
        self.show_report(None)

    def show_report(self, report: Report | ChannelReports | None) -> None:
        """Shows a report; None: there is none."""
        self.report = report
        self.text.setHtml("" if report is None else _FIGURE.sub("", report._repr_html_()))
        self.page_button.setEnabled(report is not None)
        self.json_button.setEnabled(report is not None)

    def save_page(self, path: str) -> None:
        """Writes the page of the report. Raises ValueError or OSError where that is not possible."""
        self._measured().to_html(path)

    def save_json(self, path: str) -> None:
        """Writes the record of the report. Raises OSError if that is not possible."""
        with open(path, "w", encoding="utf-8") as file:
            file.write(self._measured().to_json())

    def _measured(self) -> Report | ChannelReports:
        if self.report is None:
            raise ValueError("There is no report yet. Measure a layer first.")
        return self.report

    def _ask(self, title: str, name: str, kind: str, save: Callable[[str], None]) -> None:
        """Asks for the name of a file, and saves there."""
        path, _ = QFileDialog.getSaveFileName(self, title, name, kind)
        if path:
            save(path)
