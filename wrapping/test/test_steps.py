# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests steps in a series of measurements with closed forms and with random numbers."""

import math

import numpy as np
import pytest
from itk_sensornoise.distributed import Step, find_steps


def test_change_and_error_are_those_of_weighted_means():
    (step,) = find_steps([1.0, 2.0, 11.0, 14.0], [1.0, 1.0, 1.0, math.sqrt(0.5)])
    assert step.at == 2
    assert step.change == pytest.approx((11 + 2 * 14) / 3 - 1.5, rel=1e-12)
    assert step.standard_error == pytest.approx(math.sqrt(1 / 2 + 1 / 3), rel=1e-12)
    assert step.z == step.change / step.standard_error


def test_threshold_is_that_of_the_normal_distribution():
    # |z| of a change of 1 between two measurements of errors e is 1 / (e sqrt(2)). Chance exceeds 2.5758 once in 100.
    just = 1 / (math.sqrt(2) * 2.5758293)
    assert find_steps([0, 1], [just * 0.9999] * 2, 0.01) and not find_steps([0, 1], [just * 1.0001] * 2, 0.01)


def test_several_steps_in_order_of_time():
    values = np.repeat([5.0, 6.0, 3.0], 4)
    assert [(step.at, round(step.change, 9)) for step in find_steps(values, np.full(12, 0.01))] == [(4, 1.0), (8, -3.0)]


def test_scale_and_level_change_nothing():
    random = np.random.default_rng(3)
    values, errors = random.standard_normal(40) + np.repeat([0, 2], 20), random.uniform(0.5, 1.5, 40)
    steps = find_steps(values, errors)
    assert steps
    for found, step in zip(find_steps(1e6 + 2 * values, 2 * errors), steps, strict=True):
        assert found.at == step.at
        assert found == pytest.approx((step.at, 2 * step.change, 2 * step.standard_error), rel=1e-8)


def test_what_was_not_measured_is_left_out():
    nan = math.nan
    assert find_steps([1, nan, 1, nan, 2, 2], [0.1, 0.1, 0.1, nan, 0.1, 0.1])[0].at == 4
    assert find_steps([1, 1, 2, 2], [0.1, 0.1, nan, 0.1]) == [Step(3, 1.0, pytest.approx(0.1 * math.sqrt(1.5)))]
    assert find_steps([], []) == find_steps([1], [1]) == find_steps([nan] * 3, [1] * 3) == []


def test_false_alarms_are_no_more_than_allowed():
    random, places = np.random.default_rng(5), 0
    found = 0
    for _ in range(1000):
        errors = random.uniform(0.5, 2, 12)
        found += len(find_steps(errors * random.standard_normal(12), errors, 0.02))
        places += 11
    # 220 are allowed. A simulation of another million places finds a fraction of 0.60 of these, as neighbouring places
    # are correlated.
    assert 220 * 0.4 < found < 220 * 0.8


@pytest.mark.parametrize(
    ("given", "said"),
    [
        (([1, 2], [1]), r"values has shape \(2,\) and standard_errors \(1,\)"),
        (([[1, 2]], [[1, 1]]), "expected one list of numbers each"),
        (([1, 2], [1, 0]), "standard_errors has 0 as its least; expected numbers above 0"),
        (([1, 2], [1, 1], 0), "false_alarms is 0; expected a number above 0 and below 1"),
        (([1, 2], [1, 1], 1), "false_alarms is 1; expected"),
    ],
)
def test_wrong_use_is_refused(given, said):
    with pytest.raises(ValueError, match=said):
        find_steps(*given)
