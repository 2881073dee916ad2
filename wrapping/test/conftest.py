# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Fixtures of the tests: small stacks with known content, the command-line tools, fresh interpreters."""

import os
import subprocess
import sys
from pathlib import Path

import itk
import numpy as np
import pytest
from browser import BrowserError, chromium, started
from many_bursts import NAMES

PIXEL_TYPES = ["uint8", "uint16", "int16", "float32", "float64"]
ITK_TYPES = {"uint8": itk.UC, "uint16": itk.US, "int16": itk.SS, "float32": itk.F, "float64": itk.D}


# Dask's LocalCluster looks for a lost worker 15 s after its loss, and closes it for good if it is not there at that
# moment. On a slow machine this happens to a worker that is killed repeatedly.
os.environ.setdefault("DASK_DISTRIBUTED__DEPLOY__LOST_WORKER_TIMEOUT", "1h")

# Every module that SWIG makes warns of SWIG's types. As an error this warning ends the interpreter.
SWIG_WARNING = "ignore:builtin type:DeprecationWarning"


def pytest_configure(config) -> None:
    config.addinivalue_line("filterwarnings", SWIG_WARNING)


def pytest_addoption(parser) -> None:
    parser.addoption("--screenshots", type=Path, help="folder for pictures of pages, made in a browser")


@pytest.fixture(scope="session")
def screenshots(request) -> Path | None:
    """Returns the folder for pictures of pages; None: no pictures are wanted."""
    folder = request.config.getoption("--screenshots")
    if folder is not None:
        folder.mkdir(parents=True, exist_ok=True)
    return folder


@pytest.fixture(params=PIXEL_TYPES)
def pixel(request) -> str:
    """Returns each pixel type of the filters."""
    return request.param


@pytest.fixture(scope="session")
def grey_values() -> np.ndarray:
    """Returns a stack (40, 64, 96) whose grey values fit every pixel type [DN]."""
    stack, _ = itk.simulate_sensor_noise(
        frames=40, size=(96, 64), dtype="uint8", gain=0.07, offset=12, read_noise=1.2, seed=3
    )
    return stack


@pytest.fixture
def stack(grey_values, pixel) -> np.ndarray:
    """Returns the same grey values in each pixel type."""
    return grey_values.astype(pixel)


@pytest.fixture(scope="session")
def burst() -> np.ndarray:
    """Returns a stack (60, 96, 128) of camera B in condition 3."""
    return itk.simulate_sensor_noise(frames=60, size=(128, 96), seed=5)[0]


@pytest.fixture(scope="session")
def bursts() -> dict[str, np.ndarray]:
    """Returns three small bursts for estimate_many()."""
    return {name: itk.simulate_sensor_noise(frames=30, size=(96, 64), seed=n)[0] for n, name in enumerate(NAMES)}


@pytest.fixture(scope="session")
def reports(bursts):
    """Returns the report of each burst of `bursts`, measured alone."""
    return {name: itk.estimate_sensor_noise(frames) for name, frames in bursts.items()}


@pytest.fixture
def burst_files(bursts, tmp_path) -> list[str]:
    """Writes `bursts` to files. Returns the file names."""
    names = [os.fspath(tmp_path / f"{name}.mha") for name in bursts]
    for name, frames in zip(names, bursts.values(), strict=True):
        itk.imwrite(itk.image_view_from_array(frames), name)
    return names


@pytest.fixture(scope="session")
def dark() -> np.ndarray:
    """Returns dark frames (12, 96, 128) of the camera of `burst`: mu = 100 DN, sigma = 8 DN."""
    return itk.simulate_sensor_noise(frames=12, size=(128, 96), electrons=1e-9, seed=6)[0]


@pytest.fixture(scope="session")
def tool():
    """Returns a function that runs a command-line tool of the same checkout and returns the text that it prints. The
    tools are in SENSORNOISE_BIN, else in build/bin."""
    root = Path(__file__).resolve().parents[2]
    folder = Path(os.environ.get("SENSORNOISE_BIN", root / "build" / "bin"))
    if not (folder / "estimate-sensor-noise").exists():
        pytest.skip(f"no estimate-sensor-noise in {folder}; set SENSORNOISE_BIN")

    def run(name: str, *arguments) -> str:
        command = [str(folder / name), *map(str, arguments)]
        return subprocess.run(command, check=True, capture_output=True, text=True).stdout

    return run


@pytest.fixture(scope="session")
def fresh():
    """Returns a function that runs code in a new interpreter, where every warning is an error, and returns what it
    prints."""

    def run(code: str, *arguments) -> str:
        command = [sys.executable, "-W", "error", "-W", SWIG_WARNING, "-c", code, *map(str, arguments)]
        result = subprocess.run(command, capture_output=True, text=True, check=False)
        assert result.returncode == 0, result.stderr
        assert result.stderr == ""
        return result.stdout

    return run


@pytest.fixture(scope="session")
def chrome(tmp_path_factory):
    """Yields a browser for pages, without a window."""
    program = chromium()
    if program is None:
        pytest.skip("no Chromium on this system (Debian: apt-get install chromium): pages were not looked at")
    try:
        with started(program, tmp_path_factory.mktemp("browser") / "profile") as browser:
            yield browser
    except BrowserError as error:
        pytest.fail(str(error))
