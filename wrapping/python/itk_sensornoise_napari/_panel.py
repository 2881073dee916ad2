# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Base of both widgets: lists of layers, work in a background thread, and sentences in place of tracebacks."""

import threading
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from napari.qt.threading import thread_worker
from qtpy.QtCore import Qt, Signal
from qtpy.QtWidgets import QComboBox, QFormLayout, QHBoxLayout, QLabel, QProgressBar, QPushButton, QVBoxLayout, QWidget

from ._layers import images, plain


class Stopped(Exception):
    """The user stopped the work."""


@dataclass(frozen=True)
class Outcome:
    """Result of a call in a background thread, or the sentence of its error."""

    value: Any = None
    error: str | None = None


def sentence_of(error: BaseException) -> str:
    """Returns the sentence of an error for the user."""
    if isinstance(error, Stopped):
        return "Stopped."
    text = " ".join(str(error).split())
    if isinstance(error, (ValueError, TypeError, MemoryError, ImportError, OSError, RuntimeError)) and text:
        return text[0].upper() + text[1:]
    return f"The pixels of the layer cannot be read: {type(error).__name__}: {text}"


def outcome_of(work: Callable[[], Any]) -> Outcome:
    """Calls a function; napari would show a traceback of what it raises."""
    try:
        return Outcome(work())
    except Exception as error:  # noqa: BLE001 - readers of lazy layers raise what they like
        return Outcome(error=sentence_of(error))


def index_of(box: QComboBox, value: Any) -> int:
    """Returns the index of the entry that has this value; -1: there is none."""
    return next((index for index in range(box.count()) if box.itemData(index) is value), -1)


class Panel(QWidget):
    """A form with a button that starts work in the background, a button that stops it, and a line of text below."""

    progressed = Signal(int)

    def __init__(self, viewer: Any, action: str) -> None:
        """`action`: the words of the button."""
        super().__init__()
        self.viewer = viewer
        self.form = QFormLayout()
        self.run_button, self.stop_button = QPushButton(action), QPushButton("Stop")
        self.stop_button.setEnabled(False)
        self.progress = QProgressBar()
        self.progress.setRange(0, 100)
        self.status = QLabel()
        self.status.setWordWrap(True)
        self.status.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.column = QVBoxLayout(self)
        self.column.addLayout(self.form)
        buttons = QHBoxLayout()
        buttons.addWidget(self.run_button)
        buttons.addWidget(self.stop_button)
        self.column.addLayout(buttons)
        self.column.addWidget(self.progress)
        self.column.addWidget(self.status)

        self._lists: list[tuple[QComboBox, str | None]] = []
        self._stop = threading.Event()
        self._done: Callable[[Any], None] | None = None
        self.run_button.clicked.connect(lambda: self.run())
        self.stop_button.clicked.connect(lambda: self._stop.set())
        self.progressed.connect(self.progress.setValue)
        layers = viewer.layers.events
        self.follow(layers.inserted, layers.removed, layers.reordered, layers.renamed, callback=self._list_layers)

    def follow(self, *events: Any, callback: Callable[..., None]) -> None:
        """Calls a method of this widget on events of napari, as long as the widget exists."""
        for event in events:
            event.connect(callback)
        self.destroyed.connect(lambda: (self._stop.set(), [event.disconnect(callback) for event in events]))

    def run(self) -> None:
        """Starts the action of the button."""
        raise NotImplementedError

    def layer_list(self, label: str, none: str | None = None) -> QComboBox:
        """Adds a list of the image layers to the form. `none`: the words for no layer, if there may be none."""
        box = QComboBox()
        self.form.addRow(label, box)
        self._lists.append((box, none))
        self._fill(box, none)
        return box

    def _fill(self, box: QComboBox, none: str | None) -> None:
        """Lists the layers anew. The choice is kept."""
        chosen = box.currentData()
        box.blockSignals(True)
        box.clear()
        if none is not None:
            box.addItem(none, None)
        for layer in images(self.viewer.layers):
            box.addItem(layer.name, layer)
        self.choose(box, chosen)
        box.blockSignals(False)

    def _list_layers(self, event: Any = None) -> None:
        for box, none in self._lists:
            self._fill(box, none)
        self.layers_changed()

    def layers_changed(self) -> None:
        """Is called when layers came or went."""

    def choose(self, box: QComboBox, value: Any) -> None:
        """Chooses the entry of a list that has this value, if there is one."""
        index = index_of(box, plain(value))
        if index >= 0:
            box.setCurrentIndex(index)

    @property
    def is_busy(self) -> bool:
        """Returns whether work goes on in the background."""
        return self._done is not None

    def say(self, text: str) -> None:
        """Shows a sentence below the buttons."""
        self.status.setText(text)

    def start(self, work: Callable[[], Any], done: Callable[[Any], None]) -> None:
        """Calls work() in a background thread, and done() with its result in the thread of the window."""
        if self.is_busy:
            return
        self._stop.clear()
        self._done = done
        self.say("")
        self.progress.setValue(0)
        self.run_button.setEnabled(False)
        self.stop_button.setEnabled(True)
        worker = thread_worker(outcome_of, start_thread=False)(work)
        worker.returned.connect(self._finish)
        worker.start()

    def advance(self, fraction: float) -> None:
        """Notes the fraction of the work that is done, in the background thread. Raises Stopped if the user stopped
        the work."""
        if self._stop.is_set():
            raise Stopped
        self.progressed.emit(round(100 * fraction))

    def _finish(self, outcome: Outcome) -> None:
        done, self._done = self._done, None
        self.run_button.setEnabled(True)
        self.stop_button.setEnabled(False)
        if outcome.error is not None:
            self.progress.setValue(0)
            self.say(outcome.error)
        elif done is not None:
            self.attempt(lambda: done(outcome.value))

    def attempt(self, work: Callable[[], Any]) -> None:
        """Calls a function in the thread of the window, and shows the sentence of its error."""
        outcome = outcome_of(work)
        if outcome.error is not None:
            self.say(outcome.error)
