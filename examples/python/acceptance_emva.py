# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Computes the system gain K of an exposure series with the photon transfer of EMVA Standard 1288.

Each exposure level has two or more frames. Its mean mu and its temporal variance v are means over all pixels. The
photon transfer equation v - v_dark = K (mu - mu_dark) is fitted by unweighted least squares, up to 70 % of saturation
(Release 3.1, section 6, equations 9, 28 and 29). Release 4 Linear also subtracts the difference between the mean levels
of the two frames, which the flicker of the illumination causes.

The standard uses flat fields, dark frames and two frames per level. Three extensions compare the estimator with it on
other series. A level with more frames has the mean variance of all pairs of its frames. A series without dark frames is
fitted by a line with an intercept. On a scene, pixels that clip in any frame are left out. On a scene, flicker
contributes a part of the variance: its mean square times the variance of the signal over the pixels. Vibration of the
camera is not subtracted.
"""

import numpy as np

FITTED_RANGE = 0.7  # fraction of the saturation level less the dark level [1]


def level_statistics(frames):
    """Returns the mean [DN] and the temporal variance [DN^2] of the frames (t, pixels) of one level.

    The variance of two frames is mean((y_0 - y_1)^2) / 2 - (mu_0 - mu_1)^2 / 2. The variance of more frames is the mean
    of this value over all pairs. This is the mean variance of the pixels less the variance of the means of the frames.
    """
    frames = np.asarray(frames, float)
    means = frames.mean(axis=1)
    return means.mean(), frames.var(axis=0, ddof=1).mean() - means.var(ddof=1)


def fit_photon_transfer(means, variances, has_dark):
    """Returns the system gain K [DN/e-]: the slope of the variances over the means of the levels, in ascending order.
    Returns None if fewer than two levels are in the fitted range.

    has_dark: the first level is dark, and the line goes through it. Otherwise the line has an intercept, and the first
    level replaces the dark level in the fitted range. Saturation is the level of the largest variance."""
    signals, excess = means - means[0], variances - variances[0]
    fitted = signals <= FITTED_RANGE * signals[np.argmax(variances)]
    if np.count_nonzero(fitted) < 2:
        return None
    x, y = signals[fitted], excess[fitted]
    if not has_dark:
        x, y = x - x.mean(), y - y.mean()
    return float((x * y).sum() / (x * x).sum())


def system_gain(frames, per_level, has_dark, highest):
    """Returns the system gain K [DN/e-] of an exposure series; None: too few levels are fitted, or all pixels clip.

    frames: (t, y, x), level after level from the darkest to the brightest; per_level: frames of each level; highest:
    highest digital number [DN]."""
    pixels = frames.reshape(len(frames), -1)
    pixels = pixels[:, ((pixels > 0) & (pixels < highest)).all(axis=0)]
    if not pixels.size:
        return None
    levels = pixels.reshape(-1, per_level, pixels.shape[1])
    means, variances = np.array([level_statistics(level) for level in levels]).T
    return fit_photon_transfer(means, variances, has_dark)
