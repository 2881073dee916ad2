# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Makes bursts with frames unlike the others, and exposure series of a camera with a non-linear response."""

from functools import partial

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
    electrons_of,
    expose,
    illumination,
)

BITS = 12
HIGHEST = 2**BITS - 1  # highest digital number [DN]
OTHER_GAIN, OTHER_OFFSET_DN = 1.5, 40.0  # frames read differently: factor of the gain [1], increase of the offset [DN]
DIP_DEPTH, DIP_RADIUS = 0.12, 0.3  # decrease of the illumination [1], standard deviation over the frame width [1]
SHADOW = 0.6  # illumination factor in a shadow that covers a quarter of the frame [1]


def another_scene(random, electrons):
    """Returns another texture, as after a movement of a shutter or a filter wheel."""
    return expose(random, electrons_of("patches", random), [1.0])[0]


def dip(random, electrons):
    """Returns a frame with an illumination of another shape: a smooth dip in the middle."""
    y, x = np.indices(electrons.shape)
    squared = (x - electrons.shape[1] / 2) ** 2 + (y - electrons.shape[0] / 2) ** 2
    factor = 1 - DIP_DEPTH * np.exp(-squared / (2 * (DIP_RADIUS * electrons.shape[1]) ** 2))
    return expose(random, electrons * factor, [1.0])[0]


def shadow(random, electrons):
    """Returns a frame with a sharp shadow over a quarter of it."""
    factor = np.ones(electrons.shape)
    factor[: electrons.shape[0] // 2, : electrons.shape[1] // 2] = SHADOW
    return expose(random, electrons * factor, [1.0])[0]


def another_camera(random, electrons, **settings):
    """Returns a frame of the scene from a camera with other settings."""
    return expose(random, electrons, [1.0], **settings)[0]


UNLIKE = {
    "zeros": lambda _random, electrons: np.zeros(electrons.shape),
    "saturated": lambda _random, electrons: np.full(electrons.shape, float(HIGHEST)),
    "another-scene": another_scene,
    "dip": dip,
    "shadow": shadow,
    "another-offset": partial(another_camera, offset=OFFSET[BITS] + OTHER_OFFSET_DN),
    "another-gain": partial(another_camera, gain=OTHER_GAIN * GAIN),
}


def with_unlike(random, electrons, kind, count):
    """Returns a burst in which `count` frames at random places are of a kind of UNLIKE."""
    frames = expose(random, electrons, illumination(random))
    places = sorted(int(place) for place in random.choice(FRAMES, count, replace=False))
    for place in places:
        frames[place] = UNLIKE[kind](random, electrons)
    return Burst(digitise(frames, BITS), offset=OFFSET[BITS], read_noise=READ_NOISE, unlike_frames=tuple(places))


def linearity_error(levels, exposures, dark, saturation):
    """Returns EMVA 1288's linearity error [%] (Release 4.0 Linear, equations 62 and 63) of levels without noise."""
    signal = levels - dark
    used = (signal >= 0.05 * (saturation - dark)) & (signal <= 0.95 * (saturation - dark))
    design = np.stack([np.ones(used.sum()), exposures[used]], axis=1) / signal[used, None]
    line = np.linalg.lstsq(design, levels[used] / signal[used], rcond=None)[0]
    fitted = line[0] + line[1] * exposures[used]
    return 100 * np.mean(np.abs((levels[used] - fitted) / (fitted - dark)))


def exposure_series(random, curvature, has_dark):
    """Returns eight exposures of five frames of a flat field. The signal is compressed by `bend` [1] at saturation."""
    full = (HIGHEST - OFFSET[BITS]) / GAIN
    steps = np.linspace(0.0 if has_dark else 0.08, 0.88, 8)
    exposures = np.repeat(steps, 5)
    electrons = full * (1 + 0.007 * random.normal(size=SHAPE))
    factors = exposures * (1 + 0.002 * random.normal(size=exposures.size) * (exposures > 0))
    collected = random.poisson(np.maximum(0.0, factors[:, None, None] * electrons))
    signal = GAIN * collected * (1 - curvature * collected / full)
    frames = signal + OFFSET[BITS] + READ_NOISE * random.normal(size=collected.shape)
    mean = OFFSET[BITS] + GAIN * full * exposures * (1 - curvature * exposures)
    error = linearity_error(mean, exposures, OFFSET[BITS], HIGHEST)
    return Burst(
        digitise(frames, BITS),
        offset=OFFSET[BITS] if has_dark else None,
        read_noise=READ_NOISE if has_dark else None,
        linearity_error=error,
        signal_range=GAIN * ELECTRONS,
        options=("--exposures", ",".join(f"{exposure:.6g}" for exposure in exposures)),
    )


SITUATIONS = (
    *(
        Situation(
            f"frames/{kind}-{count}",
            lambda random, electrons, kind=kind, count=count: with_unlike(random, electrons, kind, count),
            scenes=tuple(SCENES),
        )
        for kind in UNLIKE
        for count in (1, 3)
    ),
    *(
        Situation(
            f"linearity/bend-{100 * curvature:g}%{'' if has_dark else '-no-dark'}",
            lambda random, _electrons, curvature=curvature, has_dark=has_dark: exposure_series(
                random, curvature, has_dark
            ),
        )
        for curvature in (0.0, 0.01, 0.04)
        for has_dark in (True, False)
    ),
)
