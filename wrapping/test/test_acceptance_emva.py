# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests EMVA 1288's photon transfer of exposure series with closed forms and a simulated flat field."""

import itertools
from pathlib import Path

import numpy as np
import pytest

EXAMPLES = Path(__file__).resolve().parents[2] / "examples" / "python"
GAIN, OFFSET, READ_NOISE = 0.5, 100.0, 3.0


@pytest.fixture(autouse=True)
def examples(monkeypatch):
    monkeypatch.syspath_prepend(str(EXAMPLES))


def variance_of_difference(first, second):
    """Returns equation 29 of EMVA 1288, release 3.1, less the change of the mean level [DN^2]."""
    return 0.5 * ((first - second) ** 2).mean() - 0.5 * (first.mean() - second.mean()) ** 2


@pytest.mark.parametrize("count", [2, 3, 10])
def test_the_variance_of_a_level_is_the_mean_over_all_pairs_of_frames(count):
    from acceptance_emva import level_statistics

    frames = np.random.default_rng(1).normal(500, 20, (count, 300)) + np.arange(count)[:, None]
    mean, variance = level_statistics(frames)
    assert mean == pytest.approx(frames.mean())
    pairs = itertools.combinations(frames, 2)
    assert variance == pytest.approx(np.mean([variance_of_difference(*pair) for pair in pairs]))


@pytest.mark.parametrize("has_dark", [True, False])
def test_the_slope_is_that_of_the_levels_up_to_70_percent_of_saturation(has_dark):
    from acceptance_emva import fit_photon_transfer

    signals = np.array([0.0, 200.0, 400.0, 700.0, 900.0, 1000.0, 1050.0])
    variances = GAIN * signals + READ_NOISE**2
    variances[4] += 30  # this level and the brighter ones are above 70 % of the level of the largest variance
    variances[6] = 10  # saturated
    assert fit_photon_transfer(OFFSET + signals, variances, has_dark) == pytest.approx(GAIN)


def test_only_a_series_with_dark_frames_has_a_line_through_its_first_level():
    from acceptance_emva import fit_photon_transfer

    signals = np.array([0.0, 400.0, 600.0, 1000.0])
    variances = np.array([9.0, 209.0, 319.0, 509.0])
    dark = (400 * 200 + 600 * 310) / (400**2 + 600**2)
    assert fit_photon_transfer(OFFSET + signals, variances, True) == pytest.approx(dark)
    assert fit_photon_transfer(OFFSET + signals, variances, False) == pytest.approx(
        np.polyfit(signals[:3], variances[:3], 1)[0]
    )


def test_a_line_needs_two_levels():
    from acceptance_emva import fit_photon_transfer

    assert fit_photon_transfer(np.array([100.0, 900.0]), np.array([9.0, 409.0]), True) is None


def series(has_dark, pixels, highest):
    """Returns an exposure series of 8 levels of 4 frames, with flicker and pixels of unequal brightness [DN]."""
    random = np.random.default_rng(2)
    factors = np.repeat(np.linspace(0.0 if has_dark else 0.05, 1.0, 8), 4) * random.normal(1, 0.002, 32)
    electrons = factors[:, None, None] * np.linspace(200, 2000, pixels)[None, None, :]
    frames = OFFSET + GAIN * random.poisson(electrons) + random.normal(0, READ_NOISE, electrons.shape)
    return np.clip(np.rint(frames), 0, highest)


@pytest.mark.parametrize("has_dark", [True, False])
@pytest.mark.parametrize("highest", [4095, 900])  # at 900 DN, pixels with more than 1,500 electrons clip
def test_the_gain_of_a_simulated_series_is_found(has_dark, highest):
    """The standard deviation of the error of K over seeds is at most 0.8 %: the limit of 4 % is 5 times as large."""
    from acceptance_emva import system_gain

    frames = series(has_dark, 20_000, highest)
    assert (frames == highest).any() == (highest == 900)
    assert system_gain(frames, 4, has_dark, highest) == pytest.approx(GAIN, rel=0.04)


def test_a_series_whose_pixels_all_clip_has_no_gain():
    from acceptance_emva import system_gain

    assert system_gain(np.full((4, 2, 2), 4095), 2, True, 4095) is None


def test_the_lines_have_the_levels_of_their_names():
    from acceptance_lines import LINES

    lines = {line.name: line for line in LINES if line.frames_per_level}
    for name, line in lines.items():
        levels, each = (int(number) for number in name.split("/")[1].split("-")[0].split("x"))
        assert line.frames == len(line.factors) == levels * each and line.frames_per_level == each
        assert line.factors[0] == (0.05 if "no-dark" in name else 0) and line.factors[-1] == 1
        assert len(set(line.factors)) == levels
    assert {"exposures/5x2", "exposures/12x10-no-dark", "exposures/8x5-640x512"} < set(lines)
