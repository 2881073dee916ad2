# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Makes bursts with dark frames of another camera setting, stuck pixels beyond saturation, full wells that differ from
pixel to pixel, and other pixel types."""

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
    """Returns dark frames. They are of another camera setting if offset or read noise deviates [DN]."""
    return digitise(expose(random, np.zeros(SHAPE), np.ones(DARK_FRAMES), offset=offset, read_noise=read_noise))


def with_dark(random, electrons, dark):
    """Returns a burst with these dark frames. Its own offset is the true one, even if the dark frames have another."""
    frames = expose(random, electrons, illumination(random))
    return Burst(digitise(frames), offset=OFFSET[12], read_noise=READ_NOISE, dark=dark)


def black_level_moved(random, electrons, by):
    return with_dark(random, electrons, dark_frames(random, offset=OFFSET[12] + by))


def other_gain(random, electrons, ratio):
    return with_dark(random, electrons, dark_frames(random, read_noise=ratio * READ_NOISE))


def bright_as_dark(random, electrons, fraction):
    """Returns a burst with frames of the same scene at less illumination, which are given as dark frames."""
    frames = expose(random, fraction * electrons, illumination(random, DARK_FRAMES))
    return with_dark(random, electrons, digitise(frames))


def leaking(random, electrons, mean):
    """Returns a burst whose dark frames hold charge, by dark current, glow or light: none on the left, and twice the
    mean charge [e-] on the right."""
    charge = 2 * mean * np.indices(SHAPE)[1] / SHAPE[1]
    return with_dark(random, electrons, digitise(expose(random, charge, np.ones(DARK_FRAMES))))


def settling(random, electrons, beginning):
    """Returns a burst whose dark frames begin with a black level that is off by this [DN], and settles in 8 frames."""
    levels = OFFSET[12] + beginning * np.exp(-np.arange(DARK_FRAMES) / 8)[:, None, None]
    return with_dark(random, electrons, dark_frames(random, offset=levels))


def saturated(random, electrons, top, stuck):
    """Returns a scene whose brightest fifth saturates below the highest level of the converter, with stuck pixels."""
    frames = np.minimum(expose(random, 1.5 * electrons, illumination(random)), top)
    for _ in range(stuck):
        frames[:, random.integers(SHAPE[0]), random.integers(SHAPE[1])] = 4095
    return Burst(
        digitise(frames), offset=OFFSET[12], read_noise=READ_NOISE, signal_range=min(1.5 * GAIN * ELECTRONS, top)
    )


def full_wells(random, electrons, spread):
    """Returns a scene whose brightest fifth fills the wells of its pixels, which differ by this fraction (rms)."""
    full = np.quantile(electrons, 0.8) * (1 + spread * random.normal(size=SHAPE))
    collected = np.minimum(random.poisson(illumination(random)[:, None, None] * electrons), np.rint(full))
    frames = GAIN * collected + OFFSET[12] + READ_NOISE * random.normal(size=collected.shape)
    return Burst(
        digitise(frames),
        offset=OFFSET[12],
        read_noise=READ_NOISE,
        signal_range=GAIN * np.quantile(electrons, 0.8),
    )


def of_type(random, electrons, dtype, offset):
    """Returns the same burst in another pixel type. An offset below 0 needs a signed type."""
    frames = np.rint(expose(random, electrons, illumination(random, FRAMES), offset=offset))
    return Burst(frames.astype(dtype), offset=offset, read_noise=READ_NOISE)


def line(name, make, *given):
    return Situation(name, lambda random, electrons: make(random, electrons, *given), scenes=tuple(SCENES))


SITUATIONS = (
    *(line(f"dark-frames/black-level{by:+d}", black_level_moved, by) for by in (-8, 4, 8, 20)),
    *(line(f"dark-frames/noise-x{ratio}", other_gain, ratio) for ratio in (0.5, 1.5, 3)),
    *(line(f"dark-frames/bright-{fraction:.0%}", bright_as_dark, fraction) for fraction in (0.1, 0.5)),
    *(line(f"dark-frames/leak-{mean}", leaking, mean) for mean in (1, 4)),
    *(line(f"dark-frames/settling-{beginning}", settling, beginning) for beginning in (2, 8)),
    *(line(f"full-wells/{100 * spread:g}%", full_wells, spread) for spread in (0.003, 0.01, 0.03)),
    *(line(f"stuck/{stuck}-beyond-{top}", saturated, top, stuck) for top in (2500, 3400) for stuck in (1, 12)),
    *(
        line(f"type/{dtype}{offset:+d}", of_type, dtype, offset)
        for dtype in ("int16", "float32", "float64")
        for offset in (-20, 100)
    ),
)
