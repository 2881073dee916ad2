# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Removes flicker, motion and local illumination from the pixels of a burst, for one_likelihood.py."""

from typing import NamedTuple

import numpy as np

COMPONENT_Z = 4.0  # a temporal component is projected out if its energy exceeds noise by so many standard deviations
NOISE_EDGE = 1.25  # smallest eigenvalue of a component of local illumination, over the largest of noise [1]
LOWEST = 0.05  # smallest variance of the model, over the median of the pixels [1]
NEIGHBOUR_BINS = 64  # bins of the neighbours' levels
DIAGONAL = [(step * y, step * x) for step in (1, 2) for y in (-1, 1) for x in (-1, 1)]


class Pixels(NamedTuple):
    """Input of the likelihood for each pixel: mean square, degrees of freedom, level and columns of the variance."""

    square: np.ndarray  # mean square that the temporal components leave [DN^2]
    dof: np.ndarray
    columns: dict[str, np.ndarray]
    tile: np.ndarray  # number of the tile
    tiles: int
    floor: float  # smallest variance of the model [DN^2]

    def matrix(self, names):
        return np.column_stack([self.columns[name] for name in names])


def inner(image):
    """Returns the pixels that have two neighbours on each side, as a vector (or as vectors, of frames)."""
    cut = image[..., 2:-2, 2:-2]
    return cut.reshape(*cut.shape[:-2], -1)


def neighbours_mean(image):
    """Returns the mean of the eight diagonal neighbours, one and two steps away, of the inner pixels."""
    return inner(sum(np.roll(image, step, axis=(0, 1)) for step in DIAGONAL) / len(DIAGONAL))


def derivatives(mean):
    """Returns the central differences of first and second order of the inner pixels, as columns (pixels, 5)."""
    y, x = np.gradient(mean)
    yy, yx = np.gradient(y)
    return np.stack([inner(one) for one in (x, y, np.gradient(x)[1], yx, yy)], axis=1)


def centred(series):
    return series - series.mean(axis=0)


def orthonormal(series):
    """Returns an orthonormal basis of the series (frames, n), without the constant."""
    q, r = np.linalg.qr(centred(series))
    kept = np.abs(np.diag(r)) > 1e-6 * np.linalg.norm(centred(series), axis=0).max()
    return q[:, kept]


def offset_line(gram, products):
    """Returns offset, its standard error, and flicker by the regression of the frames on constant and level.

    gram: (2, 2); products: (2, frames). The offset is about the centre of the level; estimator.md, 3.3."""
    half = np.linalg.cholesky(gram)
    white = np.linalg.solve(half, products)
    values, vectors = np.linalg.eigh(white @ white.T)
    direction = np.linalg.solve(half.T, vectors[:, 1])  # proportional to (-m, 1)
    v = direction / direction[1]
    power, frames = v @ gram @ v, products.shape[1]
    flicker = v @ products / power
    phi = max(1.0, values[0] / (frames - 2))
    energy = flicker @ flicker - phi * (frames - 1) / power
    level = gram[0, 0] - (gram @ v)[0] ** 2 / power
    variance = phi / (energy * level) if energy > 0 else np.inf
    return -v[0], np.sqrt(variance), flicker


def temporal_components(frames, mean, weight, tile, motion):
    """Returns the offset with its error, and the basis (frames, n) of flicker, motion and local illumination."""
    level = inner(mean)
    centre = np.average(level, weights=weight)
    columns = np.column_stack([np.ones_like(level), level - centre, derivatives(mean)])
    differences = inner(frames) - level
    gram = columns.T @ (weight[:, None] * columns)
    products = columns.T @ (weight * differences).T
    first, rest = slice(0, 2), slice(2, None)
    partial = np.linalg.solve(gram[rest, rest], gram[rest, first]).T
    offset, error, flicker = offset_line(
        gram[first, first] - partial @ gram[rest, first], products[first] - partial @ products[rest]
    )
    series = [flicker]
    if motion:
        coefficients = np.linalg.solve(gram, products)
        x, y = coefficients[2], coefficients[3]
        energy = coefficients**2 / np.diag(np.linalg.inv(gram))[:, None]
        count = len(frames) - 1
        moves = energy.sum(axis=1) > count + COMPONENT_Z * np.sqrt(2 * count)
        series += [x, y] if moves[2:4].any() else []
        series += [x * x, x * y, y * y] if moves[4:].any() else []
    basis = orthonormal(np.stack(series, axis=1))
    if motion:
        basis = with_local_illumination(basis, differences, weight * (level - centre - offset), weight, level, tile)
    return (offset + centre, error), basis


def with_local_illumination(basis, differences, product, weight, level, tile):
    """Adds the series that the tiles' illumination factors have in common beyond noise (Marchenko and Pastur 1967)."""
    signal = np.divide(product, weight, out=np.zeros_like(product), where=weight > 0)
    count = tile.max() + 1
    power = np.bincount(tile, product * signal, count)
    scores = np.stack([np.bincount(tile, product * one, count) for one in differences])
    bright = power > np.median(power) / 4
    scores = scores[:, bright] / np.sqrt(power[bright])
    scores = centred(scores - basis @ (basis.T @ scores))
    scores /= np.maximum(1, np.sqrt((scores**2).mean(axis=0) / np.median((scores**2).mean(axis=0))))
    values, vectors = np.linalg.eigh(scores @ scores.T)
    free, tiles = len(differences) - 1 - basis.shape[1], scores.shape[1]
    noise = np.median(values[-free:]) / tiles
    edge = noise * (np.sqrt(tiles) + np.sqrt(free)) ** 2 * NOISE_EDGE
    local = vectors[:, values > edge][:, -(free // 6) :]
    return orthonormal(np.hstack([basis, local])) if local.size else basis


def root_bins(level, count):
    """Returns the bin of each level. Bins have equal widths of the root of the level, that is, of the shot noise."""
    root = np.sqrt(np.maximum(level - np.quantile(level, 0.001), 0))
    return np.floor(root / max(root.max(), 1e-9) * (count - 1e-9)).astype(int)


def expected_levels(level, neighbours, used):
    """Returns the expectation of the levels from the levels of the neighbours, through the means of bins."""
    bins = root_bins(neighbours[used], NEIGHBOUR_BINS)
    count = np.bincount(bins)
    x, y = (np.bincount(bins, one[used])[count > 0] / count[count > 0] for one in (neighbours, level))
    return np.interp(neighbours, x, y)


def measured_pixels(frames, mean, basis, offset, gain_over_noise, tile, used):
    """Returns what the basis leaves of each pixel.

    The level of a pixel is the mean over the frames of its levels, weighted by what the basis leaves of each frame, as
    the mean square is: then its expectation is a line of this level under any illumination."""
    differences = inner(frames) - inner(mean)
    coordinates = basis.T @ differences
    leverage = (basis**2).sum(axis=1) + 1 / len(frames)
    free = len(frames) - 1 - basis.shape[1]
    square = ((differences**2).sum(axis=0) - (coordinates**2).sum(axis=0)) / free
    level_image = mean.copy()
    moved = ((1 - leverage) @ basis) @ coordinates / free
    level_image[2:-2, 2:-2] += moved.reshape(level_image[2:-2, 2:-2].shape)
    level, neighbours = inner(level_image), neighbours_mean(level_image)
    expected = expected_levels(level, neighbours, used)
    x, y = derivatives(mean)[:, :2].T
    # Frames of unequal noise: 2 tr(PDPD) for D = diag(1 + shot fraction x flicker), estimator.md, 3.5.
    signal = np.maximum(expected - offset, 0)
    flicker = np.clip(coordinates / np.maximum(signal, 1), -1, None) if len(coordinates) else coordinates
    factors = basis @ np.median(flicker, axis=1) if len(coordinates) else np.zeros(len(frames))
    shot = gain_over_noise * signal / (1 + gain_over_noise * signal)
    first = (1 - leverage) @ factors
    projection = np.eye(len(frames)) - 1 / len(frames) - basis @ basis.T
    second = factors @ (projection**2) @ factors
    dof = free**2 / (free + 2 * first * shot + second * shot**2)
    columns = {
        "constant": np.ones_like(level),
        "level": level,
        "pattern": level - expected,
        "xx": x * x,
        "xy": 2 * x * y,
        "yy": y * y,
        "illumination": signal**2,
    }
    return Pixels(
        square[used],
        np.maximum(dof, 1)[used],
        {name: column[used] for name, column in columns.items()},
        tile[used],
        tile.max() + 1,
        LOWEST * np.median(square[used]),
    )
