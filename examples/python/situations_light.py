# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Makes illuminations that change differently from place to place, and scenes that are not static.

They are spots that bleach, cells that flash one by one, light-emitting diodes that pulse in bands of a few states,
rain, caustics, steady light beside illumination that flickers, and frames with skipped blocks. Lamps settle together
with the optics.
"""

import numpy as np
from situations import FRAMES, GAIN, OFFSET, READ_NOISE, SHAPE, Burst, digitise, illumination, situations_of, smooth

BITS = 12


def changing(random, expected):
    """Returns a burst of the expected electrons (t, y, x)."""
    signal = GAIN * random.poisson(expected)
    frames = signal + OFFSET[BITS] + READ_NOISE * random.normal(size=signal.shape)
    return Burst(digitise(frames, BITS), offset=OFFSET[BITS], read_noise=READ_NOISE)


def calcium(random, electrons, amplitude):
    """Returns a burst in which cells of 8 pixels cover a quarter of the area. Each cell has transients that decay over
    8 frames."""
    expected = illumination(random)[:, None, None] * electrons[None]
    y, x = np.indices(SHAPE)
    kernel = np.exp(-np.arange(FRAMES) / 8.0)
    for _ in range(int(0.25 * SHAPE[0] * SHAPE[1] / (np.pi * 4.0**2))):
        cy, cx = random.uniform(0, SHAPE[0]), random.uniform(0, SHAPE[1])
        cell = (y - cy) ** 2 + (x - cx) ** 2 < 4.0**2
        trace = np.convolve(random.random(FRAMES) < 0.05, kernel)[:FRAMES]
        expected[:, cell] *= (1 + amplitude * trace)[:, None]
    return changing(random, np.minimum(expected, 7000.0))


def bands(random, electrons, depth):
    """Returns a burst under light-emitting diodes with three states, whose bands move at random under a rolling
    shutter."""
    rows = np.arange(SHAPE[0])
    factors = []
    for _ in range(FRAMES):
        states = random.integers(0, 3, size=SHAPE[0] // 12 + 2)
        factors.append(1 + depth * (states[(rows + random.integers(0, 12)) // 12] - 1))
    return changing(random, np.array(factors)[:, :, None] * electrons[None])


def rain(random, electrons, drops):
    """Returns a burst with streaks of rain, which brighten other pixels in every frame."""
    expected = illumination(random)[:, None, None] * electrons[None]
    for t in range(FRAMES):
        streaks = np.zeros(SHAPE)
        for _ in range(drops):
            cy, cx, length = random.integers(0, SHAPE[0]), random.integers(0, SHAPE[1]), random.integers(8, 24)
            streaks[cy : cy + length, cx : cx + 2] = random.uniform(0.05, 0.3)
        expected[t] *= 1 + smooth(streaks, 0.7)
    return changing(random, np.minimum(expected, 7000.0))


def caustics(random, electrons, rms):
    """Returns a burst under moving water: a pattern of 6 pixels that is independent in every frame, with this relative
    rms."""
    expected = illumination(random)[:, None, None] * electrons[None]
    for t in range(FRAMES):
        pattern = smooth(random.normal(size=SHAPE), 3.0)
        expected[t] *= 1 + rms * pattern / pattern.std()
    return changing(random, expected)


def skipped(random, electrons, fraction):
    """Returns a burst of a video coder that repeats this fraction of the 8 x 8 blocks of the previous frame."""
    burst = changing(random, illumination(random)[:, None, None] * electrons[None])
    frames = burst.frames.copy()
    for t in range(1, FRAMES):
        skip = np.kron(random.random((SHAPE[0] // 8, SHAPE[1] // 8)) < fraction, np.ones((8, 8), bool))
        frames[t][skip] = frames[t - 1][skip]
    return burst._replace(frames=frames)


def bleached(random, electrons, fraction):
    """Returns a burst under a spot of excitation light, which bleaches its middle by this fraction. The rate follows
    the illumination, so that bright areas lose more than dark ones."""
    y, x = np.indices(SHAPE)
    spot = np.exp(-3 * ((y / SHAPE[0] - 0.5) ** 2 + (x / SHAPE[1] - 0.5) ** 2))
    time = np.linspace(0, 1, FRAMES)[:, None, None]
    flicker = illumination(random, flicker=0.003)[:, None, None]
    return changing(random, flicker * np.exp(-fraction * spot * time) * spot * electrons)


def uneven(random, electrons, difference):
    """Returns a burst whose flicker differs by this fraction, relative to its mean, between the left and the right."""
    x = np.arange(SHAPE[1]) / SHAPE[1] - 0.5
    flicker = illumination(random, flicker=0.03)[:, None, None] - 1
    return changing(random, (1 + flicker * (1 + difference * x)) * electrons)


def spot(random, electrons, strength):
    """Returns a burst with a second light source, a spot of 10 to 40 % of the width, whose illumination fluctuates by
    this fraction (rms)."""
    y, x = np.indices(SHAPE)
    radius = random.uniform(0.1, 0.4) * SHAPE[1]
    centre = random.random(2) * SHAPE
    profile = np.exp(-((y - centre[0]) ** 2 + (x - centre[1]) ** 2) / radius**2)
    series = strength * random.normal(size=(FRAMES, 1, 1))
    return changing(random, illumination(random)[:, None, None] * (1 + series * profile) * electrons)


def settling(random, electrons, widening):
    """Returns a burst whose lamp and optics settle together: while the illumination falls by 3 %, a blur of 0.8 pixels
    rms loses what widened it by this length [pixels]."""
    settled = np.exp(-np.arange(FRAMES) / 10.0)
    factors = illumination(random, flicker=0.001) * (1 + 0.03 * settled)
    radii = np.sqrt(0.8**2 + ((0.8 + widening) ** 2 - 0.8**2) * settled)
    return changing(random, np.array([f * smooth(electrons, r) for f, r in zip(factors, radii, strict=True)]))


def steady(random, electrons, strength):
    """Returns a burst under a light source that flickers, and a spot of another one that is steady, as bright as this
    fraction of the brightest pixel."""
    y, x = np.indices(SHAPE) / np.reshape(SHAPE, (2, 1, 1))
    spot = strength * electrons.max() * np.exp(-((x - 0.6) ** 2 + (y - 0.5) ** 2) / 0.08)
    expected = illumination(random)[:, None, None] * electrons[None] + spot
    return changing(random, np.minimum(expected, 7000.0))._replace(offset=None)


def swaying(random, electrons, shift):
    """Returns a burst under a steady light source, whose right half sways by this shift along both axes (rms) [pixels],
    as near objects do in front of a camera that sways."""
    y, x = (np.fft.fftfreq(size) for size in SHAPE)
    transform = np.fft.fft2(electrons)
    right = smooth((np.indices(SHAPE)[1] > SHAPE[1] / 2).astype(float), 2.0)
    expected = []
    for dy, dx in shift * random.normal(size=(FRAMES, 2)):
        shifted = np.fft.ifft2(transform * np.exp(-2j * np.pi * (y[:, None] * dy + x[None, :] * dx))).real
        expected.append(np.maximum(electrons * (1 - right) + shifted * right, 0))
    return changing(random, np.array(expected))


KINDS = {
    "steady-spot": (steady, (0.1, 0.4)),
    "half-sways": (swaying, (0.03, 0.1)),
    "settling-optics": (settling, (0.05, 0.2)),
    "bleached-spot": (bleached, (0.03, 0.1)),
    "uneven-flicker": (uneven, (0.1, 0.3)),
    "spot": (spot, (0.01, 0.04)),
    "calcium": (calcium, (0.1, 0.3)),
    "led-bands": (bands, (0.003, 0.01)),
    "caustics": (caustics, (0.002, 0.01)),
    "rain": (rain, (50, 200)),
    "skipped-blocks": (skipped, (0.5, 0.8)),
}

SITUATIONS = situations_of("light", KINDS)
