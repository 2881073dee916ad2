# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests the plugin of napari without a screen: the effects of its widgets on layers, and their messages."""

import json
import os
import threading
import time

import numpy as np
import pytest

REASON = "napari is not installed (pip install 'napari[pyqt5]'): the plugin was not tested"
os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
pytest.importorskip("napari", reason=REASON)
pytest.importorskip("qtpy", reason=REASON)

import itk_sensornoise as sn  # noqa: E402 - napari may be missing
from itk_sensornoise_napari import _panel, _samples  # noqa: E402
from itk_sensornoise_napari._denoise import StabiliseDenoise  # noqa: E402
from itk_sensornoise_napari._layers import MAP, REPORT  # noqa: E402
from itk_sensornoise_napari._measure import MeasureNoise  # noqa: E402
from napari.components import ViewerModel  # noqa: E402
from napari.layers import Image  # noqa: E402
from qtpy.QtCore import QCoreApplication, QEvent  # noqa: E402
from qtpy.QtWidgets import QApplication  # noqa: E402

SECONDS = 60  # to wait for work in the background
CALIBRATION = {"pixel_offset", "pixel_offset_low", "pixel_offset_high"}
CALIBRATION |= {"pixel_read_noise", "pixel_read_noise_low", "pixel_read_noise_high"}


@pytest.fixture(scope="module", autouse=True)
def application():
    """Yields the application of Qt."""
    yield QApplication.instance() or QApplication([])


@pytest.fixture(scope="module")
def burst() -> np.ndarray:
    """Returns a burst (t, y, x) of a sensor with dark frames: see `dark`."""
    return sn.simulate_sensor_noise(frames=40, size=(96, 64), gain=2.0, offset=100.0, flicker_sd=0.05, dsnu=3.0)[0]


@pytest.fixture(scope="module")
def dark() -> np.ndarray:
    """Returns dark frames of the sensor of `burst`."""
    return sn.simulate_sensor_noise(frames=40, size=(96, 64), gain=2.0, offset=100.0, dsnu=3.0, dark=True, seed=2)[0]


@pytest.fixture(scope="module")
def report(burst):
    """Returns the report of `burst`."""
    return sn.estimate_sensor_noise(burst, bayer="none")


@pytest.fixture
def viewer() -> ViewerModel:
    """Returns a viewer without a window."""
    return ViewerModel()


def finish(panel) -> None:
    """Waits until the work of a widget has come to its end."""
    end = time.monotonic() + SECONDS
    while panel.is_busy:
        assert time.monotonic() < end, "the work does not end"
        QApplication.processEvents()
        time.sleep(0.002)


def run(panel) -> str:
    """Presses the button of a widget, waits, and returns its message."""
    panel.run_button.click()
    finish(panel)
    return panel.status.text()


def choose(box, text: str) -> None:
    """Chooses an entry of a list by its text."""
    assert box.findText(text) >= 0, [box.itemText(index) for index in range(box.count())]
    box.setCurrentIndex(box.findText(text))


def test_measured_layer_gets_the_report_of_the_function_and_its_maps(viewer, burst, dark):
    viewer.add_image(dark, name="dark")
    viewer.add_image(burst, name="burst", scale=(1.0, 0.5, 0.25))
    panel = MeasureNoise(viewer)
    assert panel.layer.currentText() == "burst"
    choose(panel.dark, "dark")
    choose(panel.bayer, "none (monochrome)")
    assert run(panel) == ""
    expected = sn.estimate_sensor_noise(burst, dark=dark, bayer="none", maps=True)
    assert panel.view.report == expected
    assert viewer.layers["burst"].metadata[REPORT] == expected
    found = {layer.metadata[MAP][1]: layer for layer in viewer.layers if MAP in layer.metadata}
    assert set(found) == {"mean", "variance", "corrected_variance", "pixel_use"} | CALIBRATION
    for name, layer in found.items():
        np.testing.assert_array_equal(layer.data, expected.maps[name])
        assert layer.name == f"burst: {name.replace('_', ' ')}"
        np.testing.assert_allclose(layer.scale, (0.5, 0.25))
    assert [name for name, layer in found.items() if layer.visible] == ["variance"]
    assert f"{expected.gain.value:.3g}"[:3] in panel.view.text.toPlainText()
    assert panel.progress.value() == 100


def test_second_measurement_replaces_the_maps(viewer, burst):
    viewer.add_image(burst, name="burst")
    panel = MeasureNoise(viewer)
    run(panel)
    before = [layer.name for layer in viewer.layers]
    assert panel.layer.currentText() == "burst"
    choose(panel.method, "published (a burst)")
    assert run(panel) == ""
    assert sorted(layer.name for layer in viewer.layers) == sorted(before)
    assert panel.view.report["method"] == "published"


def test_known_offset_and_excess_noise_are_settings_of_the_measurement(viewer, burst):
    viewer.add_image(burst, name="burst")
    panel = MeasureNoise(viewer)
    choose(panel.bayer, "none (monochrome)")
    panel.offset.setText(" 100,5 ")
    panel.excess_noise.setValue(2.0)
    assert run(panel) == ""
    assert panel.view.report == sn.estimate_sensor_noise(burst, bayer="none", offset=100.5, excess_noise_factor=2.0)


def test_frames_of_a_lazy_layer_and_of_one_with_several_scales_are_measured(viewer, burst, report):
    dask_array = pytest.importorskip("dask.array")
    viewer.add_image(dask_array.from_array(burst, chunks=(10, 64, 96)), name="lazy")
    viewer.add_image([burst, burst[:, ::2, ::2]], name="scales", multiscale=True)
    panel = MeasureNoise(viewer)
    choose(panel.bayer, "none (monochrome)")
    for name in ("lazy", "scales"):
        choose(panel.layer, name)
        assert run(panel) == ""
        assert panel.view.report["gain"] == report["gain"]


def test_one_frame_is_measured_by_the_method_for_single_images(viewer, burst):
    viewer.add_image(burst[0], name="frame")
    panel = MeasureNoise(viewer)
    choose(panel.method, "single image")
    choose(panel.bayer, "none (monochrome)")
    assert run(panel) == ""
    assert panel.view.report == sn.estimate_sensor_noise(burst[0], method="single-image", bayer="none")
    assert len(viewer.layers) == 1


def test_page_and_record_are_saved(viewer, burst, tmp_path):
    viewer.add_image(burst, name="burst")
    panel = MeasureNoise(viewer)
    assert not panel.view.page_button.isEnabled() and not panel.view.json_button.isEnabled()
    run(panel)
    assert panel.view.page_button.isEnabled() and panel.view.json_button.isEnabled()
    panel.view.save_page(os.fspath(tmp_path / "report.html"))
    panel.view.save_json(os.fspath(tmp_path / "report.json"))
    assert (tmp_path / "report.html").read_text() == panel.view.report.to_html()
    assert json.loads((tmp_path / "report.json").read_text()) == panel.view.report
    panel.attempt(lambda: panel.view.save_page(os.fspath(tmp_path / "report.doc")))
    assert "report.doc" in panel.status.text() and ".html" in panel.status.text()


@pytest.mark.parametrize(
    "layer, expected",
    [
        (dict(data=np.zeros((2, 30, 8, 8), np.uint16)), "Layer 'it' has 4 axes (2 x 30 x 8 x 8). Expected: 3 axes"),
        (dict(data=np.zeros((8, 8), np.uint16)), "Layer 'it' has 2 axes (8 x 8). Expected: 3 axes (t, y, x). Open a"),
        (dict(data=np.zeros((9, 8, 3), np.uint8), rgb=True), "Layer 'it' has colours (RGB)."),
        (dict(data=np.zeros((30, 8, 8), np.int32)), "Frames has dtype int32; expected uint8,"),
        (dict(data=np.zeros((3, 8, 8), np.uint16)), "The stack has 3 frames; expected at least 5."),
    ],
)
def test_layer_that_cannot_be_measured_gets_a_sentence(viewer, layer, expected):
    viewer.add_image(name="it", **layer)
    panel = MeasureNoise(viewer)
    text = run(panel)
    assert expected in text
    assert "\n" not in text and "Traceback" not in text and "Error" not in text
    assert panel.run_button.isEnabled() and len(viewer.layers) == 1


def test_missing_layer_model_and_offset_get_a_sentence(viewer, burst):
    assert run(MeasureNoise(viewer)) == "There is no image layer. Open a burst of raw frames first."
    assert run(StabiliseDenoise(viewer)) == "There is no image layer. Open an image first."
    viewer.add_image(burst, name="burst")
    panel = MeasureNoise(viewer)
    panel.offset.setText("dark")
    assert run(panel) == "The dark offset is 'dark'. Expected: a number in DN, or nothing."
    assert run(StabiliseDenoise(viewer)).startswith("There is no noise model. Measure a layer first")


def test_error_of_a_reader_is_a_sentence(viewer, burst):
    class Broken:
        shape, dtype, ndim = burst.shape, burst.dtype, 3

        def __getitem__(self, key):
            raise KeyError("chunk 7")

    viewer.add_image(burst, name="burst")
    panel = MeasureNoise(viewer)
    panel.start(lambda: sn.estimate_sensor_noise(Broken(), bayer="none"), lambda _: None)
    finish(panel)
    assert panel.status.text() == "The pixels of the layer cannot be read: KeyError: 'chunk 7'"


def test_work_is_done_in_another_thread_and_stops(viewer, burst):
    viewer.add_image(np.concatenate([burst] * 4), name="burst")
    panel = MeasureNoise(viewer)
    threads = []
    notes = panel.advance

    def advance(fraction):
        threads.append(threading.current_thread())
        panel.stop_button.click()
        notes(fraction)

    panel.advance = advance
    assert run(panel) == "Stopped."
    assert threads and threading.main_thread() not in threads
    assert panel.view.report is None and len(viewer.layers) == 1
    panel.advance = notes
    assert run(panel) == "" and panel.view.report is not None


def test_second_press_of_the_button_starts_nothing(viewer):
    panel, calls = MeasureNoise(viewer), []
    gate = threading.Event()
    panel.start(lambda: gate.wait(SECONDS), calls.append)
    panel.start(lambda: 2, calls.append)
    assert panel.is_busy and not panel.run_button.isEnabled()
    gate.set()
    finish(panel)
    assert calls == [True]


@pytest.mark.parametrize("kind", [MeasureNoise, StabiliseDenoise])
def test_closed_widget_leaves_the_viewer_alone(viewer, burst, kind):
    inserted = viewer.layers.events.inserted
    before = len(inserted.callbacks)
    panel = kind(viewer)
    stop = panel._stop
    panel.deleteLater()
    QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    viewer.add_image(burst, name="burst")
    viewer.layers.clear()
    assert stop.is_set() and len(inserted.callbacks) == before


def test_stabilised_layer_has_noise_of_variance_1_and_returns_to_grey_values(viewer, burst, report):
    viewer.add_image(burst, name="burst", metadata={REPORT: report}, scale=(1, 0.5, 0.5))
    panel = StabiliseDenoise(viewer)
    choose(panel.action, "stabilise")
    assert run(panel) == ""
    stabilised = viewer.layers["burst: stabilised"]
    np.testing.assert_array_equal(stabilised.data, sn.generalized_anscombe_image_filter(burst, report))
    assert stabilised.metadata[REPORT] is report
    np.testing.assert_allclose(stabilised.scale, (1, 0.5, 0.5))
    choose(panel.layer, "burst: stabilised")
    choose(panel.action, "return to grey values")
    assert run(panel) == ""
    # The inverse is the inverse of the expectation: 1/4 electron, g/4 = 0.5 DN, above the single values.
    back = viewer.layers["burst: stabilised: grey values"].data
    assert np.median(np.abs(back - burst)) < 0.6
    choose(panel.layer, "burst")
    assert "image has dtype uint16" in run(panel).replace("Image", "image")


def test_denoised_layer_is_closer_to_the_scene(viewer):
    """Without vibration and flicker, the mean of the other frames is the scene."""
    options = dict(frames=60, size=(96, 64), gain=2.0, offset=100.0, electrons=200.0)
    burst, _ = sn.simulate_sensor_noise(flicker_sd=0.0, vibration_sd=(0.0, 0.0), **options)
    scene = burst[1:].mean(axis=0)
    viewer.add_image(burst[:3], name="burst", metadata={REPORT: sn.estimate_sensor_noise(burst, bayer="none")})
    panel = StabiliseDenoise(viewer)
    choose(panel.action, "denoise")
    assert run(panel) == ""
    clean = viewer.layers["burst: denoised"]
    assert clean.data.shape == (3, 64, 96) and clean.data.dtype == burst.dtype
    before, after = (np.sqrt(np.mean((frame - scene) ** 2)) for frame in (burst[0].astype(float), clean.data[0]))
    assert after < before / 2
    panel.one_frame.setChecked(True)
    viewer.dims.set_current_step(0, 2)
    assert run(panel) == ""
    np.testing.assert_array_equal(viewer.layers["burst: denoised [1]"].data, clean.data[2])


def test_stored_report_is_a_model(viewer, burst, report, tmp_path):
    name = tmp_path / "camera.json"
    name.write_text(report.to_json())
    viewer.add_image(burst, name="burst")
    panel = StabiliseDenoise(viewer)
    panel.open_report(os.fspath(name))
    assert panel.model.currentText() == os.fspath(name)
    choose(panel.action, "stabilise")
    assert run(panel) == ""
    np.testing.assert_array_equal(
        viewer.layers["burst: stabilised"].data, sn.generalized_anscombe_image_filter(burst, report)
    )
    name.write_text("no report")
    panel.attempt(lambda: panel.open_report(os.fspath(name)))
    assert "camera.json" in panel.status.text()


def test_image_on_another_scale_than_the_model_gets_a_sentence(viewer, burst, report):
    viewer.add_image(burst.astype(np.float32) / 65535, name="scaled")
    viewer.add_image(burst, name="burst", metadata={REPORT: report})
    panel = StabiliseDenoise(viewer)
    choose(panel.layer, "scaled")
    assert run(panel).startswith("Image is on another scale than the report")


def test_samples_are_layers_with_the_truth():
    layers = {options["name"]: Image(data, **options) for data, options, _ in _samples.flickering_burst()}
    report = sn.estimate_sensor_noise(layers["flickering burst"].data, dark=layers["dark frames"].data, bayer="none")
    truth = layers["flickering burst"].metadata["truth"]
    for name in ("gain", "offset"):
        low, high = report[name]["interval95"]
        spread = high - low
        assert low - spread < truth[name] < high + spread
    steady = Image(_samples.steady_burst()[0][0])
    assert sn.estimate_sensor_noise(steady.data, bayer="none").offset.status == "not-identifiable"


def test_manifest_names_what_exists():
    from npe2 import PluginManifest

    manifest = PluginManifest.from_distribution("itk-sensornoise")
    manifest.validate_imports()
    contributed = manifest.contributions
    assert {widget.display_name for widget in contributed.widgets} == {"Measure noise", "Stabilise / Denoise"}
    assert len(contributed.sample_data) == 2


def test_package_does_not_import_napari_or_qt(fresh):
    code = (
        "import itk_sensornoise, itk_sensornoise_napari, sys\n"
        "print([name for name in sys.modules if name.split('.')[0] in ('napari', 'qtpy', 'PyQt5', 'PyQt6', 'vispy')])"
    )
    assert fresh(code) == "[]\n"


def test_errors_of_unknown_kinds_are_sentences():
    assert _panel.sentence_of(ValueError("frames has shape (1,);\n expected 3")) == "Frames has shape (1,); expected 3"
    assert _panel.sentence_of(ZeroDivisionError()) == "The pixels of the layer cannot be read: ZeroDivisionError: "
