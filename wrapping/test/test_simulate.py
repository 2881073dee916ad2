# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests simulated sensors with flaws: each parameter gives the same bits as the option of the tool."""

import json

import itk
import numpy as np
import pytest

# Each parameter with the option of the tool.
FLAWS = {
    "prnu": (0.02, "0.02"),
    "dsnu": (3, "3"),
    "hot_pixels": ((0.05, 8), "0.05,8"),
    "gain_pattern": (0.02, "0.02"),
    "column_gain_pattern": (0.02, "0.02"),
    "column_efficiency_pattern": (0.02, "0.02"),
    "column_offset_pattern": (3, "3"),
    "bayer": ("GRBG", "GRBG"),
    "brighter_fatter": (1e-5, "1e-5"),
    "coupling": (0.02, "0.02"),
    "read_noise_spread": (0.3, "0.3"),
    "read_noise_tail": ((0.1, 1.5), "0.1,1.5"),
    "response": (("shoulder", -0.04), "shoulder,-0.04"),
    "row_noise": (4, "4"),
    "column_noise": (4, "4"),
    "banding": ((5, 20), "5,20"),
    "dark": (True, None),
    "defect_correction": (2, "2"),
    "temporal_filter": (0.5, "0.5"),
    "median": (1, "1"),
    "smoothing": (0.6, "0.6"),
    "binning": (2, "2"),
    "resampling": ((0.5, -0.25), "0.5,-0.25"),
    "block_quality": (90, "90"),
    "companding": (8, "8"),
    "repeat": (2, "2"),
    "optical_blur": (1.5, "1.5"),
    "illumination": ("sine:0.1:3", "sine:0.1:3"),
}
# Parameters that modify another parameter, together with it.
MANNERS = {
    "binning_interpolation": ("linear", {"binning": 2}),
    "transmission": ((0.3, 0.9, 0.5), {"bayer": "BGGR"}),
    "resampling_interpolation": ("cubic", {"resampling": (0.5, -0.25)}),
    "repeat_period": (2, {"repeat": 2}),
}
SMALL = {"frames": 4, "size": (64, 48), "seed": 4}
FLAGS = ["--frames", "4", "--size", "64x48", "--seed", "4"]


@pytest.fixture(scope="module")
def plain():
    return itk.simulate_sensor_noise(**SMALL)[0]


@pytest.mark.parametrize("name", FLAWS)
def test_flaw_is_the_tool_s(tool, plain, tmp_path, name):
    value, text = FLAWS[name]
    file, truth_file = tmp_path / "stack.mha", tmp_path / "truth.json"
    flags = [*FLAGS, "--" + name.replace("_", "-")]
    tool("simulate-sensor-noise", "--output", file, "--truth", truth_file, *flags, *([] if text is None else [text]))
    stack, truth = itk.simulate_sensor_noise(**SMALL, **{name: value})
    np.testing.assert_array_equal(stack, itk.array_from_image(itk.imread(str(file))))
    assert truth == json.loads(truth_file.read_text())
    assert not np.array_equal(stack, plain)


@pytest.mark.parametrize("name", MANNERS)
def test_manner_of_a_flaw_is_the_tool_s(tool, tmp_path, name):
    value, flaw = MANNERS[name]
    file, truth_file = tmp_path / "stack.mha", tmp_path / "truth.json"
    text = ",".join(map(str, value)) if isinstance(value, tuple) else value
    flags = [*FLAGS, "--" + name.replace("_", "-"), text]
    for other, number in flaw.items():
        flags += ["--" + other, ",".join(map(str, number)) if isinstance(number, tuple) else number]
    tool("simulate-sensor-noise", "--output", file, "--truth", truth_file, *flags)
    stack, truth = itk.simulate_sensor_noise(**SMALL, **flaw, **{name: value})
    np.testing.assert_array_equal(stack, itk.array_from_image(itk.imread(str(file))))
    assert truth == json.loads(truth_file.read_text())
    assert not np.array_equal(stack, itk.simulate_sensor_noise(**SMALL, **flaw)[0])


def test_dark_frames_are_of_the_same_sensor():
    sensor = {"size": (64, 48), "frames": 50, "dsnu": 40, "read_noise_spread": 0.3, "dtype": "float64"}
    dark, _ = itk.simulate_sensor_noise(**sensor, dark=True)
    unlit, _ = itk.simulate_sensor_noise(**sensor, electrons=1e-9)
    # The offsets have a standard deviation of 40 DN, and the means of 50 frames one of 8 / sqrt(50) = 1.1 DN.
    assert np.corrcoef(dark.mean(0).ravel(), unlit.mean(0).ravel())[0, 1] > 0.99
    noise = (dark - dark.mean(0)).ravel() @ (unlit - unlit.mean(0)).ravel()
    assert abs(noise) < 5 * 8**2 * 1.3 * np.sqrt(dark.size)  # the factor 1.3 is above E[sigma^4] / median^4


def test_illumination_factors_are_those_of_a_file(tool, tmp_path):
    factors = [0.0, 0.5, 1.0, 0.25]
    file, text = tmp_path / "stack.mha", tmp_path / "factors.csv"
    text.write_text("0\n0.5, 1\n.25\n")
    tool("simulate-sensor-noise", "--output", file, "--illumination", text, *FLAGS)
    stack, truth = itk.simulate_sensor_noise(**SMALL, illumination=factors, flicker_sd=None)
    np.testing.assert_array_equal(stack, itk.array_from_image(itk.imread(str(file))))
    assert truth["illumination"] == "factors" and truth["condition"] is None
    np.testing.assert_allclose(1 + np.array(truth["gamma"]), factors, rtol=0.25)  # the factors include a flicker of 5 %
    named, _ = itk.simulate_sensor_noise(**SMALL, illumination="ramp:0")
    as_numbers, _ = itk.simulate_sensor_noise(**SMALL, illumination=np.array([0, 1 / 3, 2 / 3, 1]))
    np.testing.assert_array_equal(named, as_numbers)


def test_repeated_frames_are_equal():
    stack, truth = itk.simulate_sensor_noise(**SMALL, repeat=2)
    np.testing.assert_array_equal(stack[0], stack[1])
    assert truth["flaws"]["repeat_count"] == 2
    assert truth["gamma"][0] == truth["gamma"][1] != truth["gamma"][2]


WRONG = {
    "pair": ({"banding": 3}, "banding is 3; expected (amplitude, period), two numbers"),
    "shape": ({"response": ("bent", 0.1)}, "expected 'straight' or 'quadratic' or 'wave'"),
    "response": ({"response": "wave"}, "response is 'wave'; expected (shape, size), a name and a number"),
    "not finite": ({"smoothing": float("nan")}, "smoothing is nan; expected a finite number"),
    "range": ({"coupling": 0.5}, "the coupling of charge is 0.5; expected 0 to 0.2"),
    "bits": ({"companding": 1}, "the number of bits of the companding is 1; expected 0 or 2 to 16"),
    "quality": ({"block_quality": 101}, "block_quality is 101; expected a whole number from 0 to 100"),
    "manner": ({"resampling_interpolation": "nearest"}, "expected 'linear' or 'cubic'"),
    "illumination": ({"illumination": "strobe"}, 'the illumination is "strobe"; expected steady, pulses'),
    "factors": ({"illumination": [1, 2]}, "expected a shape's name, or one factor for each of the 4 frames"),
    "repeat": ({"repeat": 0}, "repeat is 0; expected a whole number from 1"),
}


@pytest.mark.parametrize("case", WRONG)
def test_wrong_use_says_what_was_expected(case):
    parameters, message = WRONG[case]
    with pytest.raises(ValueError) as error:
        itk.simulate_sensor_noise(**SMALL, **parameters)
    assert message in str(error.value)
