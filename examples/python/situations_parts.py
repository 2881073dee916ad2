# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Makes bursts of sensors with unlike parts: amplifiers, stitched blocks, two cameras, mosaics given as mono.

The true gain is the mean over the pixels.
"""

import numpy as np
from acceptance_lines import MAY_REFUSE, MEASURED
from situations import (
    FRAMES,
    GAIN,
    OFFSET,
    READ_NOISE,
    SHAPE,
    Burst,
    Situation,
    digitise,
    expose,
    illumination,
    situations_of,
)

BITS = 16  # twice the usual gain does not saturate


def burst(random, electrons, relative, offset=0.0):
    """Returns a burst of a sensor whose gain is GAIN times the image relative; offset: deviation of the offset [DN]."""
    relative = relative / relative.mean()
    frames = expose(
        random,
        electrons,
        illumination(random, FRAMES),
        gain=GAIN * relative,
        offset=OFFSET[BITS] + offset,
        read_noise=READ_NOISE * relative,
    )
    return Burst(digitise(frames, BITS), gain=GAIN)


def blocks(values, shape=SHAPE):
    """Returns the values (rows, columns) as an image, each over a block of the frame."""
    y, x = np.indices(shape)
    values = np.asarray(values, float)
    return values[y * values.shape[0] // shape[0], x * values.shape[1] // shape[1]]


def phases(values, shape=SHAPE):
    """Returns the values (rows, columns) as an image, repeated over the frame."""
    values = np.asarray(values, float)
    y, x = np.indices(shape)
    return values[y % values.shape[0], x % values.shape[1]]


def quadrants(random, electrons, strength):
    """Returns a burst with four amplifiers of different gains and offsets."""
    relative = 1 + strength * np.array([[-5, 4], [1, -2]]) / 100
    return burst(random, electrons, blocks(relative), blocks([[0, 3], [-2, 1]]))


def stitched(random, electrons, rms):
    """Returns a burst of 4 x 4 stitched blocks whose gains differ by this standard deviation [1]."""
    return burst(random, electrons, blocks(1 + rms * random.normal(size=(4, 4))))


def stereo(random, electrons, difference):
    """Returns a burst of two cameras side by side."""
    return burst(random, electrons, blocks([[1, 1 + difference]]))


def balanced(random, electrons, strength):
    """Returns a white-balanced mosaic of a grey scene: equal levels that are amplified by unlike factors."""
    factors = 1 + strength * np.array([[0.5, 0.0], [0.0, 0.9]])
    return burst(random, electrons / phases(factors), phases(factors))


def autofocus(random, electrons, factor):
    """Returns a burst in which one pixel of each 4 x 4 pixels has another gain."""
    factors = np.ones((4, 4))
    factors[1, 2] = factor
    return burst(random, electrons, phases(factors))


def vignetting(random, electrons, fall):
    """Returns a burst with corrected vignetting: the corners lose this fraction of the signal, and the frames are
    divided by it."""
    y, x = np.indices(SHAPE)
    square = ((x / SHAPE[1] - 0.5) ** 2 + (y / SHAPE[0] - 0.5) ** 2) / 0.5
    transmission = 1 - fall * square
    return burst(random, electrons * transmission, 1 / transmission)


def flat_halves(random, difference, has_dark):
    """Returns a flat field of a sensor whose halves have amplifiers of unlike gains, with dark frames or without."""
    halves = blocks([[1 - difference / 2, 1 + difference / 2]])
    flat = burst(random, np.full(SHAPE, 4000.0), halves)
    dark = burst(random, np.zeros(SHAPE), halves)
    return flat._replace(dark=dark.frames, signal_range=4000.0 * GAIN) if has_dark else flat


KINDS = {
    "quadrants": (quadrants, (1.0, 2.0)),
    "stitched": (stitched, (0.02, 0.04)),
    "stereo": (stereo, (0.1, 0.25)),
    "balanced": (balanced, (0.5, 1.0)),
    "autofocus": (autofocus, (1.3, 2.0)),
    "vignetting": (vignetting, (0.3, 0.5)),
}

SITUATIONS = situations_of("parts", KINDS) + tuple(
    Situation(
        f"parts/flat-halves-{difference:g}{'-dark' if has_dark else ''}",
        lambda random, _electrons, d=difference, h=has_dark: flat_halves(random, d, h),
        MEASURED if has_dark else MAY_REFUSE,
    )
    for difference in (0.01, 0.03)
    for has_dark in (False, True)
)
