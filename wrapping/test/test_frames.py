# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests that invalid stacks and parameters are rejected: the first line says what was found and what was expected."""

import itk
import numpy as np
import pytest

STACK = np.arange(6 * 8 * 9, dtype=np.uint16).reshape(6, 8, 9)

WRONG_FRAMES = {
    "rank 2": (
        STACK[0],
        "frames has 2 dimensions, shape (8, 9); expected 3, the axes (t, y, x). For one frame, use "
        'method="single-image"',
    ),
    "rank 4": (STACK[None], "frames has 4 dimensions, shape (1, 6, 8, 9); expected 3, the axes (t, y, x)"),
    "RGB": (np.zeros((6, 8, 9, 3), np.uint8), "expected 3, the axes (t, y, x); of a colour image, give one channel"),
    "RGB frames": ([np.zeros((8, 9, 3), np.uint8)] * 6, "frames[0] has 3 dimensions"),
    "int64": (STACK.astype(np.int64), "frames has dtype int64; expected uint8, uint16, int16, float32 or float64"),
    "uint32": (STACK.astype(">u4"), "frames has dtype uint32; expected uint8"),
    "float16": (STACK.astype(np.float16), "frames has dtype float16; expected uint8"),
    "bool": (STACK > 3, "frames has dtype bool; expected uint8"),
    "complex": (STACK.astype(complex), "frames has dtype complex128; expected uint8"),
    "objects": (STACK.astype(object), "frames has dtype object; expected uint8"),
    "masked": (np.ma.masked_less(STACK, 3), "frames is a masked array, expected a plain one"),
    "T = 0": (STACK[:0], "frames has shape (0, 8, 9), which holds no pixel; expected at least 1"),
    "empty list": ([], "frames is an empty list; expected at least 5 frames"),
    "generator": (
        (frame for frame in STACK),
        "frames is of type generator, and item 0 of it of type ndarray; expected file names",
    ),
    "number": (3, "frames is of type int; expected an array"),
    "None": (None, "frames is of type NoneType; expected an array"),
    "no file": ("no-such.mha", "no-such.mha: does not exist"),
    "no files": (["no-such.tif"] * 6, "no-such.tif: does not exist"),
    "names and arrays": ([STACK[0], "a.tif"], "frames holds 1 file names and 1 others; expected one kind"),
    "lists of numbers": (STACK.tolist(), "frames[0] has dtype int64; expected uint8"),
    "ragged": ([STACK[0], STACK[0, :5]], "frames[1] has shape (5, 9) and dtype uint16, but frames[0] has (8, 9)"),
    "mixed": ([STACK[0], STACK[0].astype("u1")], "frames[1] has shape (8, 9) and dtype uint8, but frames[0] has"),
    "2-D image": (itk.image_from_array(STACK[0]), "expected an itk.Image of 3 dimensions of uint8"),
    "unsigned image": (itk.image_from_array(STACK.astype("u4")), "expected an itk.Image of 3 dimensions of uint8"),
}


@pytest.mark.parametrize("case", WRONG_FRAMES)
def test_what_is_no_stack_is_refused(case):
    frames, expected = WRONG_FRAMES[case]
    with pytest.raises(ValueError) as error:
        itk.estimate_sensor_noise(frames)
    assert expected in str(error.value).splitlines()[0]


@pytest.mark.parametrize("count", [1, 4])
@pytest.mark.parametrize("make", [np.asarray, list])
def test_too_few_frames_are_a_wrong_value(count, make):
    with pytest.raises(ValueError) as error:
        itk.estimate_sensor_noise(make(STACK[:count]))
    frames = "1 frame" if count == 1 else f"{count} frames"
    assert str(error.value).startswith(f"the stack has {frames}; expected at least 5. Give all frames of the burst")
    assert str(error.value).endswith('or measure each frame by itself with method="single-image"')
    assert error.value.__cause__ is None and error.value.__suppress_context__


WRONG_PARAMETERS = {
    "method": ("best", "method is 'best'; expected 'refined' or 'published'"),
    "offset": ((1, 2, 3), "offset is (1, 2, 3); expected a finite number or (number, standard error) [DN]"),
    "dark": (STACK[:, 1:], "dark has 9 x 7 pixels of type uint16; expected 9 x 8 pixels of type uint16, as the frames"),
    "bit_depth": (17, "bit_depth is 17; expected a whole number from 1 to 16"),
    "clip": ((1, 2, 3), "clip is (1, 2, 3); expected (low, high)"),
    "step": (0, "step is 0; expected a number above 0"),
    "rolling_shutter": ("fixed", "rolling_shutter is 'fixed'; expected 'auto', 'off' or a number of rows above 0"),
    "shutter_axis": (1, "shutter_axis is 1; expected 'y' or 'x'"),
    "level": ("low", "level is 'low'; expected a finite number"),
    "quantiles": (0.5, "quantiles is 0.5; expected (dark, bright)"),
    "roi": ((0, 0, 10, 8), "roi is (0, 0, 10, 8); expected (x, y, width, height) inside 9 x 8 pixels"),
    "frame_range": ((0, 7), "frame_range ends at 7, but there are 6 frames"),
    "mask": (np.ones((9, 8)), "mask has shape (9, 8); expected (8, 9), the shape of a frame"),
    "threads": (0, "threads is 0; expected a whole number from 1 to 1024"),
}


@pytest.mark.parametrize("name", WRONG_PARAMETERS)
def test_what_is_no_parameter_is_refused(name):
    value, expected = WRONG_PARAMETERS[name]
    with pytest.raises(ValueError) as error:
        itk.estimate_sensor_noise(STACK, **{name: value})
    assert str(error.value).splitlines()[0].startswith(expected)


def test_parameter_out_of_range_is_a_wrong_value():
    with pytest.raises(ValueError, match="^the clip levels are 5.* and 3.*; expected low < high$"):
        itk.estimate_sensor_noise(STACK, clip=(5, 3))


def test_unknown_parameter_of_the_functional_style_is_refused():
    with pytest.raises(TypeError, match="^sharpness is not a parameter"):
        itk.sensor_noise_estimator(STACK, sharpness=1)


def test_all_nan_is_a_report_that_says_so():
    report = itk.estimate_sensor_noise(np.full((8, 16, 17), np.nan, np.float32))
    assert report["gain"]["status"] == "failed" and report["gain"]["value"] is None
    assert report["pixels"]["not_finite"] == 16 * 17
    assert report["warnings"]


@pytest.mark.parametrize(
    "parameters, expected",
    [
        ({"camera": "Z"}, "camera is 'Z'; expected 'A' or 'B' or 'C'"),
        ({"condition": 4}, "condition is 4; expected a whole number from 1 to 3"),
        ({"frames": 0}, "frames is 0; expected a whole number from 1 to"),
        ({"size": (64,)}, "size is (64,); expected (width, height)"),
        ({"reference": "moon"}, "reference is 'moon'; expected 'target' or 'bars' or 'texture' or 'flat'"),
        ({"reference": np.ones((2, 3, 4))}, "reference has 3 dimensions"),
        ({"reference": np.ones((20, 30)), "size": (9, 9)}, "size is (9, 9), but a reference that is an array"),
        ({"dtype": "int64"}, "dtype is int64; expected uint8"),
        ({"dtype": "moon"}, "dtype is 'moon'; expected uint8"),
        ({"gain": 0}, "the simulation is not possible: the gain is 0; expected a number above 0, at most 1e9"),
    ],
)
def test_wrong_simulation_is_refused(parameters, expected):
    with pytest.raises(ValueError) as error:
        itk.simulate_sensor_noise(**{"frames": 5, **parameters})
    assert str(error.value).splitlines()[0].startswith(expected)


def test_simulation_of_an_array_has_its_size_and_is_reproducible():
    reference = np.linspace(0, 7, 30 * 40).reshape(30, 40)
    first, truth = itk.simulate_sensor_noise(frames=3, reference=reference, seed=2)
    again, _ = itk.simulate_sensor_noise(frames=3, reference=reference, seed=2)
    other, _ = itk.simulate_sensor_noise(frames=3, reference=reference, seed=3)
    assert first.shape == (3, 30, 40) and truth["reference"] == "array"
    assert first.flags.owndata
    np.testing.assert_array_equal(first, again)
    assert (first != other).any()


def test_simulation_in_chunks_is_the_same(monkeypatch):
    whole, _ = itk.simulate_sensor_noise(frames=10, size=(40, 32))
    monkeypatch.setattr("itk_sensornoise._simulate._CHUNK_BYTES", 3 * 40 * 32 * 2)
    np.testing.assert_array_equal(itk.simulate_sensor_noise(frames=10, size=(40, 32))[0], whole)
