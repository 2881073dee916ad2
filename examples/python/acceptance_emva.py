# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""The system gain K of an exposure series, by the photon transfer of EMVA Standard 1288.

Each exposure level has two or more frames. Its mean mu and its temporal variance v are means over all pixels. The
photon transfer equation v - v_dark = K (mu - mu_dark) is fitted by least squares, unweighted, up to 70 % of saturation
(Release 3.1, section 6, equations 9, 28 and 29). Release 4 Linear also subtracts the change of the mean level between
the two frames, which flicker of the lamp makes.

The standard has flat fields, dark frames and two frames a level. Three extensions compare the estimator with it on
other series: a level of more frames has the mean variance of all its pairs; a series without dark frames has a line
with an intercept; on a scene, pixels that clip in any frame are left out. On a scene, flicker leaves a part of the
variance: its mean square times the variance of the signal over the pixels. Vibration of the camera is not subtracted.
"""

import numpy as np

FITTED_RANGE = 0.7  # of the saturation level, less the dark level [1]


def level_statistics(frames):
    """Mean [DN] and temporal variance [DN^2] of the frames (t, pixels) of one level.

    The variance of two frames is mean((y_0 - y_1)^2) / 2 - (mu_0 - mu_1)^2 / 2. That of more frames is the mean of this
    over all pairs, which is the mean variance of the pixels less the variance of the frames' means."""
    frames = np.asarray(frames, float)
    means = frames.mean(axis=1)
    return means.mean(), frames.var(axis=0, ddof=1).mean() - means.var(ddof=1)


def fit_photon_transfer(means, variances, has_dark):
    """System gain K [DN/e-]: the slope of the variances over the means of the levels, which are in ascending order.
    None: fewer than two levels are in the fitted range.

    has_dark: the first level is dark, and the line goes through it. Otherwise the line has an intercept, and the first
    level stands for the dark level in the fitted range. Saturation is the level of the greatest variance."""
    signals, excess = means - means[0], variances - variances[0]
    fitted = signals <= FITTED_RANGE * signals[np.argmax(variances)]
    if np.count_nonzero(fitted) < 2:
        return None
    x, y = signals[fitted], excess[fitted]
    if not has_dark:
        x, y = x - x.mean(), y - y.mean()
    return float((x * y).sum() / (x * x).sum())


def system_gain(frames, per_level, has_dark, highest):
    """System gain K [DN/e-] of an exposure series; None: too few levels are in the fitted range, or all pixels clip.

    frames: (t, y, x), level after level from the darkest to the brightest, per_level of each; highest: highest digital
    number [DN]."""
    pixels = frames.reshape(len(frames), -1)
    pixels = pixels[:, ((pixels > 0) & (pixels < highest)).all(axis=0)]
    if not pixels.size:
        return None
    levels = pixels.reshape(-1, per_level, pixels.shape[1])
    means, variances = np.array([level_statistics(level) for level in levels]).T
    return fit_photon_transfer(means, variances, has_dark)
