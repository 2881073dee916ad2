# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests errors: TypeError for types and keywords, ValueError for values, one sentence with public names."""

import pickle
import re
import traceback

import itk
import itk_sensornoise
import numpy as np
import pytest
from itk_sensornoise._errors import cause_of, itk_errors
from itk_sensornoise.distributed._task import reason_of

STACK = np.arange(6 * 8 * 9, dtype=np.uint16).reshape(6, 8, 9)
WIDE = np.full((6, 8, 9), 300, np.uint16)
FRAME = np.ones((8, 9))
# Names that only a reader of the sources knows: files, classes, addresses and C++ types.
PRIVATE = re.compile(
    r"\.[ch]xx|\bitk[A-Z]\w|\bitk::|C\+\+|\b0x[0-9a-f]|ITK ERROR|in method|ImageRegion|Settings\.|<class"
)


def estimate(**parameters):
    return lambda: itk.estimate_sensor_noise(STACK, **parameters)


MODEL = {"variance_slope": 1, "total_intercept": 1}


def functional(name, *arguments, **parameters):
    return lambda: getattr(itk, name)(*arguments, **parameters)


WRONG_VALUES = {
    "few frames": (lambda: itk.estimate_sensor_noise(STACK[:4]), "the stack has 4 frames; expected at least 5"),
    "clip": (estimate(clip=(4095, 0)), "the clip levels are 4095 and 0 DN; expected low < high"),
    "error of the offset": (estimate(offset=(100, -1)), "the offset is 100"),
    "bit_depth": (lambda: itk.estimate_sensor_noise(WIDE, bit_depth=8), "the data hold the level 300 DN, but 8 bits"),
    "memory_limit": (estimate(memory_limit=1000), "the memory limit is 0.001 MB; expected at least"),
    "bit_depth of the functional filter": (
        functional("sensor_noise_estimator", WIDE, bit_depth=8),
        "the data hold the level 300 DN, but 8 bits",
    ),
    "method": (functional("sensor_noise_estimator", STACK, method="best"), 'the method is "best"; expected refined'),
    "negative": (
        functional("sensor_noise_estimator", STACK, bit_depth=-1),
        "bit_depth is -1; expected a whole number, 0 or more",
    ),
    "mask of the functional filter": (
        functional("sensor_noise_estimator", STACK, mask=FRAME[1:]),
        "mask has shape (7, 9); expected (8, 9), the shape of a frame",
    ),
    "frames of the statistics": (functional("temporal_statistics_image_filter", STACK[:1]), "the stack has 1 frame"),
    "shapes": (functional("noise_regression_estimator", FRAME, FRAME[1:], FRAME), "the shapes are mean (8, 9)"),
    "quantiles": (estimate(method="published", quantiles=(0.9, 0.1)), "the dark and bright quantiles are 0.9 and 0.1"),
    "simulation": (lambda: itk.simulate_sensor_noise(frames=5, gain=-1), "the simulation is not possible: the gain"),
}
WRONG_TYPES = {
    "frames": (lambda: itk.estimate_sensor_noise(3), "frames is of type int; expected an array"),
    "dtype": (lambda: itk.estimate_sensor_noise(STACK.astype(int)), "frames has dtype int64; expected uint8"),
    "image": (
        lambda: itk.estimate_sensor_noise(itk.image_from_array(STACK.astype(np.uint32))),
        "frames is an itk.Image of 3 dimensions of unsigned int; expected an itk.Image of 3 dimensions of uint8",
    ),
    "text": (estimate(bit_depth="many"), "bit_depth is 'many'; expected a whole number from 1 to 16"),
    "bool": (estimate(level=True), "level is True; expected a finite number"),
    "pair": (estimate(clip=7), "clip is 7; expected (low, high)"),
    "choice": (estimate(shutter_axis=1), "shutter_axis is 1; expected 'y' or 'x'"),
    "hash": (estimate(hash=1), "hash is 1; expected True or False"),
    "raw": (estimate(raw=7), "raw is 7; expected a layout"),
    "keyword": (estimate(sharpness=1), "estimate_sensor_noise() got an unexpected keyword argument 'sharpness'"),
    "keyword of the functional filter": (
        functional("sensor_noise_estimator", STACK, bit_dept=12),
        "bit_dept is not a parameter of sensor_noise_estimator(); expected another name, perhaps bit_depth",
    ),
    "keyword of the statistics": (
        functional("temporal_statistics_image_filter", STACK, sharpness=1),
        "sharpness is not a parameter of temporal_statistics_image_filter()",
    ),
    "value of the functional filter": (
        functional("sensor_noise_estimator", STACK, bit_depth="many"),
        "bit_depth is 'many'; expected a whole number, 0 or more",
    ),
    "name of the functional filter": (
        functional("sensor_noise_estimator", STACK, method=7),
        "method is 7; expected a str",
    ),
    "keyword of the sums": (
        lambda: itk_sensornoise.SensorNoiseSums((6, 8, 9), "uint16", sharpness=1),
        "sharpness is no setting; expected some of method, offset,",
    ),
    "series": (functional("noise_correlation_estimator", STACK, series="x"), "series is of type str; expected"),
    "flag": (
        functional("noise_correlation_estimator", STACK, remove_frame_means=2),
        "remove_frame_means is 2; expected",
    ),
    "report": (lambda: itk.check_noise_model(STACK, 7), "the report is of type int; expected a report"),
    "picture": (
        functional("generalized_anscombe_image_filter", None, **MODEL),
        "image is of",
    ),
}


def raised_by(call, kind):
    """Returns the error of a call. It must have one sentence and no chained error."""
    with pytest.raises(kind) as caught:
        call()
    error = caught.value
    text = str(error)
    assert "\n" not in text and not PRIVATE.search(text), text
    shown = "".join(traceback.format_exception(error))
    assert "ITK ERROR" not in shown and "The above exception" not in shown and "During handling" not in shown
    return error


@pytest.mark.parametrize("case", WRONG_VALUES)
def test_a_wrong_value_is_a_value_error(case):
    call, expected = WRONG_VALUES[case]
    error = raised_by(call, ValueError)
    assert not isinstance(error, TypeError) and str(error).startswith(expected)


@pytest.mark.parametrize("case", WRONG_TYPES)
def test_a_wrong_type_is_a_type_error(case):
    call, expected = WRONG_TYPES[case]
    assert expected in str(raised_by(call, TypeError))


@pytest.mark.parametrize("case", ["few frames", "clip", "error of the offset", "bit_depth", "memory_limit"])
def test_what_was_a_runtime_error_still_is_one(case):
    """This compatibility lasts for one release."""
    with pytest.raises(RuntimeError):
        WRONG_VALUES[case][0]()


@pytest.mark.parametrize("case", ["frames", "dtype", "text", "keyword of the functional filter"])
def test_what_was_a_value_error_still_is_one(case):
    """This compatibility lasts for one release."""
    with pytest.raises(ValueError):
        WRONG_TYPES[case][0]()


def test_numbers_of_numpy_are_numbers():
    expected = itk.sensor_noise_estimator(STACK, bit_depth=12, level=0.5)
    assert itk.sensor_noise_estimator(STACK, bit_depth=np.int64(12), level=np.float32(0.5)) == expected
    assert itk.estimate_sensor_noise(STACK, hash=np.bool_(False), level=np.float32(0.5), bit_depth=np.uint8(12))


def test_memory_that_is_not_there_is_a_memory_error():
    with pytest.raises(MemoryError, match="^there is not enough memory$"), itk_errors():
        raise RuntimeError("itkImportImageContainer.hxx:192:\nFailed to allocate memory for image.")


def test_errors_travel_and_have_their_sentence_in_tables():
    for call, _ in (WRONG_VALUES["clip"], WRONG_TYPES["dtype"]):
        with pytest.raises(ValueError) as caught:
            call()
        again = pickle.loads(pickle.dumps(caught.value))
        assert type(again) is type(caught.value) and str(again) == str(caught.value) == reason_of(again)


@pytest.mark.parametrize(
    "place",
    [
        "/source/itkName.hxx:71:\nITK ERROR: Name(0x55f0c1): ",  # ITK 5
        "/source/itkName.hxx:71: in 'unknown':\nITK ERROR: Name(0x55f0c1): ",  # ITK 6
        "/source/itkName.hxx:71: in 'unknown':\nITK ERROR Name(94520722603808): ",  # a macro of ITK 6
    ],
)
def test_the_place_of_an_exception_is_left_out(place: str) -> None:
    sentence = "2 value(s) are NaN: 3 were expected (4): none"
    assert cause_of(RuntimeError(place + sentence)) == sentence
