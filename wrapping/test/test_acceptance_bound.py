# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests the Cramér-Rao bound of the gain with closed forms."""

import math
from pathlib import Path

import numpy as np
import pytest

EXAMPLES = Path(__file__).resolve().parents[2] / "examples" / "python"


@pytest.fixture(autouse=True)
def examples(monkeypatch):
    monkeypatch.syspath_prepend(str(EXAMPLES))


def test_the_bound_is_that_of_sample_variances():
    """With many electrons and little change of the illumination, the mean of a pixel contains no information about its
    variance. Sample variances of T frames have the relative variance 2 / T, and the line through them has the error of
    weighted least squares. A change of the illumination by 2 % adds its square, 4e-4."""
    from acceptance_bound import gain_bound

    gain, variance, frames = 0.5, 9.0, 100
    signals = np.linspace(200.0, 2500.0, 64)
    factors = 1 + 0.02 * (-1.0) ** np.arange(frames)
    weights = frames / 2 / (gain * signals + variance) ** 2
    normal = np.array(
        [[(weights * signals**2).sum(), (weights * signals).sum()], [(weights * signals).sum(), weights.sum()]]
    )
    expected = math.sqrt(np.linalg.inv(normal)[0, 0])
    assert gain_bound(signals, gain, variance, factors) == pytest.approx(expected, rel=1e-3)
    more = gain_bound(np.tile(signals, 4), gain, variance, factors)
    assert more == pytest.approx(expected / 2, rel=1e-3)


def test_a_steady_flat_field_has_no_bound():
    from acceptance_bound import gain_bound

    assert gain_bound(np.full(100, 500.0), 0.5, 9.0, np.ones(20)) is None
