# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Estimates gain, intercept and offset of a burst by one likelihood of the variances of its pixels.

The model of study_likelihood.py. Pixel p has the mean square s_p over its f degrees of freedom, which follows a Gamma
distribution about

    v_p + h,   v_p = b + a x_p + delta d_p + c_xx (D_x m)^2 + 2 c_xy D_x m D_y m + c_yy (D_y m)^2 + c_q q_p^2

with the level x, the deviation d of the level from its expectation by the neighbours (fixed-pattern noise), the
gradient of the mean (motion), and the signal q (illumination that is left). The excess variance of the pixel is h, 0 or
larger: its own read noise, a defect, or an object that moves. The distribution of h over a grid is estimated (Laird
1978), separately for static tiles and for others. No pixel is rejected, and no tail is trimmed. Both delta and the c
are 0 unless they are significant. The value of delta is -a where the levels differ by offsets, and a where they differ
by gains.
"""

from typing import NamedTuple

import numpy as np
from likelihood_pixels import inner, measured_pixels, neighbours_mean, root_bins, temporal_components
from scipy.special import logsumexp

TILE = 8  # side of a tile, whose pixels are static or not together, and which are the clusters of the errors [pixel]
ROUNDS = 2  # rounds of regression of the frames and fit of the variances: the weights of each are from the other
STEPS, STEPS_OF_ALL = 40, 5  # most steps of expectation and maximization; of the first ones all tiles are static
GRID = 4.0  # ratio of neighbouring excesses [1]
KEPT_Z = 2.0  # a term of the variance stays if it is this many standard errors from 0
DEFECTIVE = 63.0  # excess variance from which a pixel is defective, over the variance in the dark: 8^2 - 1 [1]
ROUNDING_VARIANCE = 1 / 12  # variance of rounding to whole digital numbers [DN^2]
SETTLED = 0.02  # largest last step of the coefficients, in their standard errors [1]
FEWEST = 1e-4  # smallest fraction of the pixels at an excess whose error counts [1]
FIRST_BINS, FIRST_PIXELS = 16, 50  # bins of the first line, of equal width of the root of the level, and their pixels
FIRST_TERMS = ("constant", "level")
TERMS = ("pattern", "illumination", "xx", "xy", "yy")  # further terms of the variance, if they are significant


class Estimates(NamedTuple):
    """Values and standard errors of gain [DN/e-], intercept [DN^2] and offset [DN], and the terms of the variance."""

    gain: tuple[float, float]
    intercept: tuple[float, float]
    offset: tuple[float, float]
    terms: tuple[str, ...]


class State(NamedTuple):
    """Values that maximise the likelihood: coefficients, and the excess variance in static tiles and in others."""

    names: tuple[str, ...]  # terms of the variance
    theta: np.ndarray  # their coefficients
    grid: np.ndarray  # excess variance [DN^2]
    weights: np.ndarray  # fraction of the pixels at each of them (class of tiles, grid)
    fraction: np.ndarray  # fraction of the tiles of each class
    member: np.ndarray | None = None  # probability of each pixel's tile to be of each class (pixels, class)


class Fit(NamedTuple):
    """Gain and intercept with their errors, terms of the variance, and each pixel's probability to be static."""

    gain: tuple[float, float]
    intercept: tuple[float, float]
    terms: tuple[str, ...]
    static: np.ndarray


def first_state(pixels):
    """Returns a line through the medians of bins of the level, and few pixels with an excess."""
    level = pixels.columns["level"]
    bins = root_bins(level, FIRST_BINS)
    members = [bins == k for k in range(FIRST_BINS)]
    middle = [(np.median(level[one]), np.median(pixels.square[one])) for one in members if one.sum() >= FIRST_PIXELS]
    x, y = np.array(middle).T
    slope, constant = np.polyfit(x, y, 1, w=1 / np.maximum(y, pixels.floor)) if len(x) > 1 else (0.0, y[0])
    grid = excesses_of(pixels, max(constant + slope * x[0], pixels.floor))
    none = grid == 0
    weights = np.stack([0.98 * none + 0.02 / len(grid), 0.3 * none + 0.7 / len(grid)])
    return State(FIRST_TERMS, np.array([constant, slope]), grid, weights, np.array([0.9, 0.1]))


def excesses_of(pixels, dark):
    """Returns the grid of the excess variance: 0, and powers of GRID from the variance in the dark on."""
    return np.append(0.0, dark * GRID ** np.arange(0, 2 + np.log(max(1, pixels.square.max() / dark)) / np.log(GRID)))


def relative_likelihoods(pixels, state):
    """Returns variance and likelihood of each pixel at each excess (pixels, grid), relative to its most likely one."""
    base = np.maximum(pixels.matrix(state.names) @ state.theta, pixels.floor)
    variance = base[:, None] + state.grid
    likelihood = -0.5 * pixels.dof[:, None] * (np.log(variance) + pixels.square[:, None] / variance)
    highest = likelihood.max(axis=1)
    return variance, np.exp(likelihood - highest[:, None]), highest


def expectation(pixels, state, is_one_class):
    """Returns the state with the weights of the next step, and score and information of each pixel's variance."""
    variance, likelihood, highest = relative_likelihoods(pixels, state)
    of_class = likelihood @ state.weights.T
    with np.errstate(divide="ignore"):
        total = np.log(of_class) + highest[:, None]
    tiles = np.log(state.fraction) + np.stack([np.bincount(pixels.tile, one, pixels.tiles) for one in total.T], axis=1)
    tiles = np.exp(tiles - logsumexp(tiles, axis=1)[:, None])
    if is_one_class:
        tiles[:] = (1.0, 0.0)
    member = tiles[pixels.tile]
    ratio = member / np.maximum(of_class, 1e-300)
    weights = state.weights * (ratio.T @ likelihood) + 1e-9 if not is_one_class else state.weights
    posterior = likelihood * (ratio @ state.weights)
    scale = posterior * (pixels.dof[:, None] / 2) / variance**2
    information = scale.sum(axis=1)
    score = (scale * (pixels.square[:, None] - variance)).sum(axis=1)
    filled = np.bincount(pixels.tile, minlength=pixels.tiles) > 0
    return (
        state._replace(
            weights=weights / weights.sum(axis=1)[:, None],
            fraction=state.fraction if is_one_class else tiles[filled].mean(axis=0).clip(1e-6),
            member=member,
        ),
        score,
        information,
    )


def maximise(pixels, state):
    """Maximises the likelihood by expectation and maximization, from a state on."""
    columns, is_first = pixels.matrix(state.names), state.member is None
    for number in range(STEPS):
        is_start = state.member is None or (number < STEPS_OF_ALL and is_first)
        state, score, information = expectation(pixels, state, is_start)
        hessian = columns.T @ (information[:, None] * columns)
        step = solve(hessian, columns.T @ score)
        state = state._replace(theta=state.theta + step)
        if not is_start and step @ hessian @ step < SETTLED**2:
            break
    return state, score, information


def solve(matrix, vector):
    """Solves scaled normal equations; directions that the data do not determine stay as they are."""
    scale = np.sqrt(np.maximum(np.diag(matrix), 1e-300))
    return np.linalg.pinv(matrix / np.outer(scale, scale), rcond=1e-12, hermitian=True) @ (vector / scale) / scale


def score_tests(pixels, state, score, information, terms):
    """Returns how many standard errors the score of each further term is from 0, with the tiles as clusters."""
    columns = pixels.matrix(state.names)
    weighted = information[:, None] * columns
    found = {}
    for name in terms:
        column = pixels.columns[name]
        rest = column - columns @ solve(columns.T @ weighted, weighted.T @ column)
        sums = np.bincount(pixels.tile, rest * score, pixels.tiles)
        found[name] = sums.sum() / max(np.sqrt((sums**2).sum()), 1e-300)
    return {name: abs(z) if name in ("pattern", "xy") else z for name, z in found.items()}


def fit_of(pixels, state):
    """Returns the fit with errors: observed information, and the scores of tiles as clusters (sandwich)."""
    columns, grid = pixels.matrix(state.names), state.grid
    static = int(state.member.sum(axis=0).argmax())
    member, weights = state.member[:, static], state.weights[static]
    variance, likelihood, _ = relative_likelihoods(pixels, state)
    relative = likelihood / (likelihood @ weights)[:, None]
    u = pixels.dof[:, None] / 2 * (pixels.square[:, None] - variance) / variance**2
    slope = pixels.dof[:, None] / 2 * (variance - 2 * pixels.square[:, None]) / variance**3
    posterior = relative * weights
    mean_u = (posterior * u).sum(axis=1)
    curvature = (posterior * (slope + u**2)).sum(axis=1) - mean_u**2
    active = np.flatnonzero(weights[1:] > FEWEST) + 1
    e = relative[:, active] - relative[:, :1]
    mixed = columns.T @ (
        member[:, None] * (relative[:, active] * u[:, active] - relative[:, :1] * u[:, :1] - mean_u[:, None] * e)
    )
    information = -np.block(
        [[columns.T @ ((member * curvature)[:, None] * columns), mixed], [mixed.T, -(e.T @ (member[:, None] * e))]]
    )
    scores = member[:, None] * np.hstack([mean_u[:, None] * columns, e])
    sums = np.stack([np.bincount(pixels.tile, one, pixels.tiles) for one in scores.T])
    scale = np.sqrt(np.abs(np.diag(information)))
    inverse = np.linalg.pinv(information / np.outer(scale, scale), rcond=1e-8, hermitian=True) / np.outer(scale, scale)
    covariance = inverse @ (sums @ sums.T) @ inverse
    small = grid < DEFECTIVE * grid[1]
    to_intercept = np.concatenate([np.arange(len(state.names)) == 0, np.where(small[active], grid[active], 0.0)])
    intercept = state.theta[0] + (weights * grid)[small].sum() - ROUNDING_VARIANCE
    return Fit(
        (state.theta[1], np.sqrt(max(covariance[1, 1], 0))),
        (intercept, np.sqrt(max(to_intercept @ covariance @ to_intercept, 0))),
        state.names[len(FIRST_TERMS) :],
        member * posterior[:, small].sum(axis=1),
    )


def chosen_state(pixels, terms, state):
    """Adds one term after the other to the variance while it is KEPT_Z from 0: the pattern first, as it can move the
    slope most, then the most significant one."""
    while True:
        state, score, information = maximise(pixels, state)
        tests = score_tests(pixels, state, score, information, [one for one in terms if one not in state.names])
        if tests.get("pattern", 0) >= KEPT_Z:
            tests = {"pattern": tests["pattern"]}
        best = max(tests, key=tests.get, default=None)
        if best is None or tests[best] < KEPT_Z:
            return state
        state = state._replace(names=(*state.names, best), theta=np.append(state.theta, 0.0))


def estimate(frames, motion="projected", highest=65535):
    """Estimates gain, intercept and offset of frames (t, y, x).

    motion: "projected" removes the motion and local illumination that the frames have in common from each pixel;
    "variance" removes the flicker alone, and leaves motion and illumination to terms of the variance."""
    frames = np.asarray(frames, float)
    mean = frames.mean(axis=0)
    noise = np.sqrt(inner(frames.var(axis=0, ddof=1)))
    used = (noise > 0) & (inner(frames.max(axis=0)) < highest) & (inner(frames.min(axis=0)) > 0)
    rows, across = np.indices(mean.shape)
    tile = inner(rows // TILE * (mean.shape[1] // TILE + 1) + across // TILE)
    weight = used / np.maximum(np.median(noise) ** 2, neighbours_mean(mean) - inner(mean).min())
    gain_over_noise, state = 0.0, None
    for _ in range(ROUNDS):
        offset, basis = temporal_components(frames, mean, weight, tile, motion == "projected")
        pixels = measured_pixels(frames, mean, basis, offset[0], gain_over_noise, tile, used)
        state = chosen_state(pixels, TERMS, state or first_state(pixels))
        fit = fit_of(pixels, state)
        gain, intercept = fit.gain[0], fit.intercept[0]
        variance = np.maximum(gain * neighbours_mean(mean) + intercept, pixels.floor)
        weight = np.zeros_like(variance)
        weight[used] = fit.static / variance[used]
        gain_over_noise = max(gain, 0) / max(intercept + gain * offset[0], pixels.floor)
    return Estimates(fit.gain, fit.intercept, offset, fit.terms)
