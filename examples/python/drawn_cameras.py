# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Draws cameras, settings and scenes at random: situations_drawn.py varies their bursts."""

from typing import NamedTuple

import numpy as np
from situations import FLICKER, Burst, digitise, read_out, scaled, smooth

SHAPE = (240, 320)  # rows and columns [pixels]
BITS = 16
DARKEST = 0.03  # signal of the darkest pixel of a scene over the signal of the brightest pixel [1]
LARGEST_SIGNAL_DN = 50000.0  # below the saturation level, with any offset and any noise


class Camera(NamedTuple):
    """Camera with its settings, in front of a static scene."""

    frames: int
    gain: float  # [DN/e-]
    offset: float  # [DN]
    read_noise: float  # [DN]
    flicker: float  # standard deviation of the illumination factor [1]
    electrons: np.ndarray  # expected electrons (y, x) at the mean illumination [e-]

    @property
    def signal_range(self):
        """Brightest signal less the offset [DN]."""
        return self.gain * self.electrons.max()


def logarithmic(random, low, high):
    """Returns a number whose logarithm is uniform between these limits."""
    return np.exp(random.uniform(np.log(low), np.log(high)))


def beads(random):
    """Returns many small sources of very different brightness [1]."""
    image = np.zeros(SHAPE)
    image[random.integers(0, SHAPE[0], 900), random.integers(0, SHAPE[1], 900)] = random.pareto(1.5, 900)
    image = smooth(image, random.uniform(1.5, 3.0))
    return np.minimum(image, np.quantile(image, 0.995))


def chart(random):
    """Returns a chart of 24 uniform fields [1]."""
    return smooth(np.kron(random.uniform(size=(4, 6)), np.ones((60, 54)))[:, : SHAPE[1]], 1.0)


def shading(_random):
    """Returns a gradient with faint stripes [1]."""
    y, x = np.indices(SHAPE)
    return 0.6 * x / SHAPE[1] + 0.4 * y / SHAPE[0] + 0.02 * np.sin(x / 9)


def photograph(random):
    """Returns structure of all sizes from 2 to 30 pixels, most of it large [1]."""
    return sum(radius**1.2 * scaled(smooth(random.normal(size=SHAPE), radius)) for radius in (2.0, 5.0, 12.0, 30.0))


def cells(random):
    """Returns discs of different brightness on a uniform ground [1]."""
    y, x = np.indices(SHAPE)
    image = np.full(SHAPE, 0.15)
    for _ in range(60):
        distance = np.hypot(y - random.uniform(0, SHAPE[0]), x - random.uniform(0, SHAPE[1]))
        image += random.uniform(0.2, 1.0) * (distance < random.uniform(5, 14))
    return smooth(image, 1.5)


def page(random):
    """Returns dark strokes of 3 x 5 pixels on white paper [1]."""
    rows, columns = SHAPE[0] // 8, SHAPE[1] // 5
    stroke = np.pad(np.ones((5, 3)), ((0, 3), (0, 2)))
    return smooth(1 - 0.85 * np.kron(random.random((rows, columns)) < 0.45, stroke), 0.8)


SCENES = (beads, chart, shading, photograph, cells, page)


def draw(random):
    """Returns a camera with its scene. Numbers of electrons, gains and noises are as in cameras for 12 to 16 bits, from
    few photons to a full well."""
    gain = logarithmic(random, 0.08, 5.0)
    brightest = min(random.choice([400.0, 1500.0, 6000.0, 12000.0]), LARGEST_SIGNAL_DN / gain)
    return Camera(
        frames=int(random.choice([14, 20, 30, 50])),
        gain=gain,
        offset=random.uniform(60.0, 600.0),
        read_noise=gain * logarithmic(random, 1.2, 10.0),
        flicker=FLICKER * random.choice([0.0, 0.3, 1.0, 3.0]),
        electrons=brightest * scaled(SCENES[random.integers(len(SCENES))](random), DARKEST),
    )


def factors_of(random, camera, frames=None):
    """Returns the illumination factors of the frames, with the mean 1."""
    factors = 1 + camera.flicker * random.normal(size=frames or camera.frames)
    return factors / factors.mean()


def exposed(random, camera, rates=None, **changed):
    """Returns frames (t, y, x) in DN before rounding.

    rates: expected electrons (t, y, x); by default the scene under the camera's flicker. changed: gain, offset and
    read_noise of this burst, each a number or an array that broadcasts with the frames."""
    values = {"gain": camera.gain, "offset": camera.offset, "read_noise": camera.read_noise} | changed
    if rates is None:
        rates = factors_of(random, camera)[:, None, None] * camera.electrons
    return read_out(random, random.poisson(np.maximum(rates, 0.0)), **values)


def burst(camera, frames, **truth):
    """Returns the frames as a converter reads them, with the true values of the camera where no others are given."""
    values = {"gain": camera.gain, "offset": camera.offset, "read_noise": camera.read_noise}
    return Burst(digitise(frames, BITS), signal_range=camera.signal_range, **(values | truth))
