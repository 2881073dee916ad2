# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Makes bursts with dark frames whose pixels have noise in common: of rows, of columns, and of stripes. Interlaced flat
fields have such a variance by their illumination, which their dark frames lack."""

import numpy as np
from situations import (
    ELECTRONS,
    FRAMES,
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
from situations_good import interlaced

DARK_FRAMES = 20


def rows(random, frames):
    """Returns normal noise that the pixels of a row have in common [1]."""
    return random.normal(size=(frames, SHAPE[0], 1))


def columns(random, frames):
    """Returns normal noise that the pixels of a column have in common [1]."""
    return random.normal(size=(frames, 1, SHAPE[1]))


def stripes(random, frames):
    """Returns diagonal stripes with a random phase in each frame [1]."""
    y, x = np.indices(SHAPE)
    phase = random.uniform(0, 2 * np.pi, frames)
    return np.sqrt(2) * np.sin(2 * np.pi * (0.173 * x + 0.091 * y)[None] + phase[:, None, None])


def bars(random, frames):
    """Returns horizontal bars, 23 rows wide, with a random phase in each frame [1]."""
    phase = random.uniform(0, 2 * np.pi, frames)
    return np.sqrt(2) * np.sin(2 * np.pi * np.arange(SHAPE[0])[None, :, None] / 23 + phase[:, None, None])


def dark_frames(random):
    return expose(random, np.zeros(SHAPE), np.ones(DARK_FRAMES))


def with_common_noise(common):
    """Returns a function that makes bursts and dark frames with this common noise.

    Its argument `strength` is the rms of that noise over the read noise [1]."""

    def make(random, electrons, strength):
        frames = expose(random, electrons, illumination(random)) + strength * READ_NOISE * common(random, FRAMES)
        dark = dark_frames(random) + strength * READ_NOISE * common(random, DARK_FRAMES)
        return Burst(digitise(frames), offset=OFFSET[12], read_noise=READ_NOISE, dark=digitise(dark))

    return make


def interlaced_flat(random, flicker, level):
    """Returns interlaced frames of a flat field and dark frames. level: mean signal over ELECTRONS [1]."""
    burst = interlaced(random, np.full(SHAPE, level * ELECTRONS), flicker)
    return burst._replace(dark=digitise(dark_frames(random)))


SITUATIONS = (
    *situations_of(
        "structured", {make.__name__: (with_common_noise(make), (0.3, 1.0)) for make in (rows, columns, stripes, bars)}
    ),
    *(
        Situation(
            f"structured/interlaced-flat-{flicker:.1%}-{level:g}",
            lambda random, _electrons, flicker=flicker, level=level: interlaced_flat(random, flicker, level),
        )
        for flicker in (0.005, 0.02)
        for level in (0.2, 0.9)
    ),
)
