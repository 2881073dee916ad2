# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests the program that measures speed: its fit, and its programs with few pixels."""

import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

EXAMPLES = Path(__file__).resolve().parents[2] / "examples" / "python"


def test_a_cost_of_frames_is_split_into_what_is_fixed_and_what_a_sample_costs(monkeypatch):
    monkeypatch.syspath_prepend(str(EXAMPLES))
    from measure_speed import line_through

    frames = np.array([50, 100, 200, 400])
    np.testing.assert_allclose(line_through(frames, 3.5 * (frames + 40)), (3.5, 40))


@pytest.mark.skipif("SENSORNOISE_BIN" not in os.environ, reason="SENSORNOISE_BIN names no folder of the tools")
def test_the_programs_say_their_gains():
    options = ["--bin", os.environ["SENSORNOISE_BIN"], "--parts", "programs", "--rounds", "1", "--size", "96x96"]
    command = [sys.executable, str(EXAMPLES / "measure_speed.py"), *options]
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stderr
    rows = [re.split(r"  +", line) for line in result.stdout.splitlines()[3:]]
    gains = {row[0]: float(row[-1]) for row in rows}
    assert gains["estimate, refined"] == pytest.approx(1, abs=0.03)
    assert gains["tool, refined, 100 TIFFs"] == pytest.approx(gains["estimate, refined"], abs=2e-4)
    assert gains["NumPy mean + var"] > 2  # it contains the flicker
    assert gains["temporal statistics"] == pytest.approx(gains["NumPy mean + var"], abs=2e-4)
