# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Computes the Cramér-Rao bound of the gain from a burst whose illumination changes.

In a frame with the illumination factor a, a pixel with the mean signal q [DN] has the mean mu + a q and the variance g
a q + s, with s = sigma^2 + step^2 / 12. The noise is taken as Gaussian. The parameters g, s, mu, all signals and all
factors are unknown; the factors have the mean 1. Vibration is taken as known, so the bound is slightly too low.
"""

import numpy as np

SIGNAL_BINS = 256  # bins with equal numbers of pixels; twice as many change the bound by less than 0.2 %
CLIP_DISTANCE = 6.0  # samples nearer to a clip level are not used [standard deviations of the noise]
# Smallest eigenvalue of the information matrix, relative to the largest, after scaling to a unit diagonal [1]. Smaller
# values are rounding errors of double precision.
SMALLEST_EIGENVALUE = 1e-12
SMALLEST_PART = 1e-6  # fraction of the gain in eigenvectors without information, above which it is not identifiable


def information_of(signal, gain, variance, factors, highest):
    """Returns the Fisher information on (g, s, mu, factors) from one pixel whose own signal is unknown."""
    size = len(factors) + 3
    noise = gain * factors * signal + variance
    usable = factors * signal + CLIP_DISTANCE * np.sqrt(noise) < highest
    by_mean = np.zeros((size + 1, len(factors)))  # derivatives of the mean of each frame; last row: by the signal
    by_variance = np.zeros_like(by_mean)
    frames = np.arange(len(factors))
    by_variance[0] = factors * signal
    by_variance[1] = 1.0
    by_mean[2] = 1.0
    by_mean[3 + frames, frames] = signal
    by_variance[3 + frames, frames] = gain * signal
    by_mean[-1] = factors
    by_variance[-1] = gain * factors
    weights = usable / noise
    full = (by_mean * weights) @ by_mean.T + 0.5 * (by_variance * (weights / noise)) @ by_variance.T
    if full[-1, -1] <= 0:
        return np.zeros((size, size))
    return full[:-1, :-1] - np.outer(full[:-1, -1], full[-1, :-1]) / full[-1, -1]


def gain_bound(signals, gain, variance, factors, highest=np.inf):
    """Returns the smallest standard error of an unbiased estimate of the gain [DN/e-]; None: it is not identifiable.

    signals: mean signal of each pixel, without the offset [DN]; variance: s [DN^2]; factors: illumination factor of
    each frame, with the mean 1; highest: clip level less the offset [DN]."""
    factors = np.maximum(0.0, factors)  # strong normal flicker gives factors below 0, which mean no illumination
    ordered = np.sort(np.ravel(signals))
    bins = [part for part in np.array_split(ordered, min(SIGNAL_BINS, len(ordered))) if len(part)]
    total = sum(len(part) * information_of(part.mean(), gain, variance, factors, highest) for part in bins)
    # The mean of the factors is fixed: only their changes about it are free parameters.
    frames = len(factors)
    free = np.linalg.svd(np.ones((1, frames)))[2][1:].T
    basis = np.block([[np.eye(3), np.zeros((3, frames - 1))], [np.zeros((frames, 3)), free]])
    matrix = basis.T @ total @ basis
    scale = 1 / np.sqrt(np.maximum(np.diag(matrix), np.finfo(float).tiny))
    values, vectors = np.linalg.eigh(matrix * np.outer(scale, scale))
    known = values > SMALLEST_EIGENVALUE * values.max()
    if (vectors[0, ~known] ** 2).sum() > SMALLEST_PART:
        return None
    return float(scale[0] * np.sqrt((vectors[0, known] ** 2 / values[known]).sum()))
