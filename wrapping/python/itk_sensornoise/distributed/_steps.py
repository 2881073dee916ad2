# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Finds steps in a quantity that was measured repeatedly, and distinguishes them from chance by the errors of the
reports."""

from itertools import pairwise
from statistics import NormalDist
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from .._options import number, refuse


class Step(NamedTuple):
    """Change of a quantity between one measurement and the next."""

    at: int  # first measurement after the step, counted from 0
    change: float  # mean between this step and the next, minus mean between the last step and this [unit of the values]
    standard_error: float  # standard error of the change [unit of the values]

    @property
    def z(self) -> float:
        """The change in standard errors [1]."""
        return self.change / self.standard_error


def find_steps(values: ArrayLike, standard_errors: ArrayLike, false_alarms: float = 0.001) -> list[Step]:
    """Finds where a quantity of one camera changed, from its reports in order of time.

    At each place between two measurements the weighted mean before it is compared with the weighted mean after it, the
    weights being 1 / standard error^2. The place where they differ by the most standard errors is a step if these are
    more than chance allows. The measurements before and after it are then tested in the same way.

    Parameters
    ----------
    values, standard_errors
        One number of each measurement, for example the columns gain_DN_per_e and gain_error_DN_per_e of the table of
        estimate_many(), for one camera. Values that are not finite are left out: the burst had no result. Errors have
        to be above 0.
    false_alarms
        Highest fraction of places without a step where a step is found: 0 to 1, exclusive [1]. Default: one in 1,000,
        which means |z| > 3.29. Divide it by the number of quantities of a camera that are tested together.

    Returns
    -------
    list of Step
        The steps in order of time; `at` counts the measurements that were left out, too.

    Raises
    ------
    ValueError
        A value is wrong. The message has the value that was found, and the values that were expected.

    The rate holds if the errors are right and the reports are independent. A slow drift is taken for one step or more.
    """
    measured, errors = (np.asarray(given, dtype=float) for given in (values, standard_errors))
    if measured.ndim != 1 or measured.shape != errors.shape:
        raise ValueError(
            f"values has shape {measured.shape} and standard_errors {errors.shape}; expected one list of numbers each, "
            "of the same length"
        )
    expected = "a number above 0 and below 1"
    rate = number("false_alarms", false_alarms, expected, above=0.0)
    if rate >= 1:
        raise refuse("false_alarms", false_alarms, expected)
    determined = np.flatnonzero(np.isfinite(measured) & np.isfinite(errors))
    if (errors[determined] <= 0).any():
        raise ValueError(f"standard_errors has {errors[determined].min():g} as its least; expected numbers above 0")
    threshold = NormalDist().inv_cdf(1 - rate / 2)
    values, weights = measured[determined], errors[determined] ** -2.0
    steps = _places(values, weights, threshold)
    parts = pairwise(pairwise([0, *steps, len(values)]))
    return [
        Step(int(determined[at]), *_difference(values[first:end], weights[first:end], at - first))
        for (first, at), (_, end) in parts
    ]


def _difference(values: np.ndarray, weights: np.ndarray, at: int) -> tuple[float, float]:
    """Returns the change of the weighted mean at a place, and its standard error."""
    before, after = weights[:at].sum(), weights[at:].sum()
    centred = weights * (values - values[0])
    return float(centred[at:].sum() / after - centred[:at].sum() / before), float(np.sqrt(1 / before + 1 / after))


def _places(values: np.ndarray, weights: np.ndarray, threshold: float) -> list[int]:
    """Returns the places of steps: the place of the largest difference, then the places in both parts."""
    scores = [
        abs(change / error) for change, error in (_difference(values, weights, at) for at in range(1, len(values)))
    ]
    if not scores or max(scores) <= threshold:
        return []
    at = 1 + int(np.argmax(scores))
    behind = _places(values[at:], weights[at:], threshold)
    return [*_places(values[:at], weights[:at], threshold), at, *(at + place for place in behind)]
