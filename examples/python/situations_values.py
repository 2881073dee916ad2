# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Dark frames that do not belong to the burst, stuck pixels beyond the saturation level, and types of pixels."""

import numpy as np
from situations import (
    ELECTRONS,
    FRAMES,
    GAIN,
    OFFSET,
    READ_NOISE,
    SCENES,
    SHAPE,
    Burst,
    Situation,
    digitise,
    expose,
    illumination,
)

DARK_FRAMES = 30


def dark_frames(random, offset=OFFSET[12], read_noise=READ_NOISE):
    """Frames of a closed shutter, of another camera setting where offset or read noise differ [DN]."""
    return digitise(expose(random, np.zeros(SHAPE), np.ones(DARK_FRAMES), offset=offset, read_noise=read_noise))


def with_dark(random, electrons, dark):
    """A burst with these dark frames. What it measures of its own is true; the offset of others is not."""
    frames = expose(random, electrons, illumination(random))
    return Burst(digitise(frames), offset=OFFSET[12], read_noise=READ_NOISE, dark=dark)


def black_level_moved(random, electrons, by):
    return with_dark(random, electrons, dark_frames(random, offset=OFFSET[12] + by))


def other_gain(random, electrons, ratio):
    return with_dark(random, electrons, dark_frames(random, read_noise=ratio * READ_NOISE))


def bright_as_dark(random, electrons, share):
    """Frames of the same scene with less light, given as dark frames."""
    frames = expose(random, share * electrons, illumination(random, DARK_FRAMES))
    return with_dark(random, electrons, digitise(frames))


def saturated(random, electrons, top, stuck):
    """A scene whose brightest fifth saturates at a level below that of the converter, and stuck pixels."""
    frames = np.minimum(expose(random, 1.5 * electrons, illumination(random)), top)
    for _ in range(stuck):
        frames[:, random.integers(SHAPE[0]), random.integers(SHAPE[1])] = 4095
    return Burst(
        digitise(frames), offset=OFFSET[12], read_noise=READ_NOISE, signal_range=min(1.5 * GAIN * ELECTRONS, top)
    )


def of_type(random, electrons, dtype, offset):
    """The same values in another type. An offset below 0 needs a type with a sign."""
    frames = np.rint(expose(random, electrons, illumination(random, FRAMES), offset=offset))
    return Burst(frames.astype(dtype), offset=offset, read_noise=READ_NOISE)


def line(name, make, *given):
    return Situation(name, lambda random, electrons: make(random, electrons, *given), scenes=tuple(SCENES))


SITUATIONS = (
    *(line(f"dark-frames/black-level{by:+d}", black_level_moved, by) for by in (-8, 4, 8, 20)),
    *(line(f"dark-frames/noise-x{ratio}", other_gain, ratio) for ratio in (0.5, 1.5, 3)),
    *(line(f"dark-frames/bright-{share:.0%}", bright_as_dark, share) for share in (0.1, 0.5)),
    *(line(f"stuck/{stuck}-beyond-{top}", saturated, top, stuck) for top in (2500, 3400) for stuck in (1, 12)),
    *(
        line(f"type/{dtype}{offset:+d}", of_type, dtype, offset)
        for dtype in ("int16", "float32", "float64")
        for offset in (-20, 100)
    ),
)
