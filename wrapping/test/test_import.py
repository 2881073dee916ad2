# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests `import itk` in any order, repeatedly, without delay and without output."""

import importlib
from pathlib import Path

import itk
import pytest

NAMES = [
    "denoise_with_noise_model",
    "estimate_sensor_noise",
    "noise_correlation_estimator",
    "noise_regression_estimator",
    "sensor_noise_estimator",
    "sensor_noise_frame_list_source",
    "simulate_sensor_noise",
    "vibration_covariance_estimator",
]
OURS = f"assert all(getattr(itk, name).__module__.startswith('itk_sensornoise') for name in {NAMES})\n"
USE = {
    # The cast filter is threaded, and selects TBB for all filters after it.
    "wheel": "itk.cast_image_filter(np.ones((9, 9), np.float32), ttype=(itk.Image[itk.F, 2], itk.Image[itk.D, 2]))\n",
    "function": "stack, _ = itk.simulate_sensor_noise(frames=8, size=(64, 48)); itk.estimate_sensor_noise(stack)\n",
    "class": "itk.SensorNoiseSceneSource.New(width=64, height=48).Update()\n",
    "filter": "itk.temporal_statistics_image_filter(np.ones((6, 5, 4), np.uint16))\n",
    "module": "itk.SensorNoise.NoiseRegressionEstimator\n",
    "source": "itk.SensorNoiseFrameListSource[itk.Image[itk.US, 3]].New()\n",
    "template": "itk.FlickerCorrectionImageFilter\n",
}


@pytest.mark.parametrize(
    "package, first, second",
    [
        ("itk", "wheel", "function"),
        ("itk", "wheel", "class"),
        ("itk", "function", "wheel"),
        ("itk", "filter", "wheel"),
        ("itk", "module", "template"),
        ("itk", "source", "wheel"),
        ("itk", "template", "module"),
        ("itk_sensornoise", "function", "filter"),
        ("itk_sensornoise", "module", "class"),
    ],
)
def test_any_order_of_first_use_without_a_warning(fresh, package, first, second):
    code = f"import {package}, itk, numpy as np\n{OURS}{USE[first]}{OURS}{USE[second]}{OURS}print('done')"
    assert fresh(code) == "done\n"


def test_import_loads_neither_our_library_nor_what_draws(fresh):
    code = (
        "import itk, sys\n"
        "print([name for name in sys.modules if name.split('.')[0] in ('matplotlib', 'tqdm', 'PIL')"
        " or 'SensorNoisePython' in name])"
    )
    assert fresh(code) == "[]\n"


def test_import_costs_a_small_part_of_that_of_itk(fresh):
    """The package adds less than a quarter to the time of `import itk` in the same process. Found: 8 %."""
    code = (
        "import sys, time\n"
        "start = time.perf_counter()\n"
        "import itk\n"
        "of_itk = time.perf_counter() - start\n"
        "for name in [name for name in sys.modules if name.startswith('itk_sensornoise')]:\n"
        "    del sys.modules[name]\n"
        "start = time.perf_counter()\n"
        "import itk_sensornoise._install\n"
        "itk_sensornoise._install.install()\n"
        "print((time.perf_counter() - start) / of_itk)"
    )
    assert min(float(fresh(code)) for _ in range(3)) < 0.25


def test_reload_keeps_our_functions(burst):
    before = itk.estimate_sensor_noise(burst)
    again = importlib.reload(itk)
    assert again is itk
    assert again.estimate_sensor_noise(burst) == before
    assert again.sensor_noise_estimator.__module__.startswith("itk_sensornoise")


def test_help_shows_every_parameter():
    for name in NAMES:
        function = getattr(itk, name)
        assert len(function.__doc__) > 200
        hints = set(function.__annotations__) - {"return", "parameters"}
        assert hints and all(hint in function.__doc__ for hint in hints)


def test_library_names_no_folder_of_the_machine_that_built_it():
    library = next(Path(itk.__file__).parent.glob("_SensorNoisePython*.so"))
    texts = [piece.rsplit(b"\n", 1)[-1] for piece in library.read_bytes().split(b"\0")]
    places = [text for text in texts if text.endswith((b".hxx", b".cxx", b".h"))]
    assert any(b"itkSensorNoiseFrameListSource.cxx" in place for place in places)
    assert [place for place in places if place.startswith(b"/")] == []
