# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Makes bursts whose frames have several gains or dark offsets, or are interpolated between their neighbours."""

import numpy as np
from acceptance_lines import MAY_REFUSE, MEASURED, MUST_REFUSE
from situations import (
    FRAMES,
    GAIN,
    OFFSET,
    READ_NOISE,
    SCENES,
    Burst,
    Situation,
    digitise,
    expose,
    illumination,
)

BITS = 16  # frames with four times the gain do not saturate
HALF = np.arange(FRAMES) >= FRAMES // 2
EVERY_SECOND = np.arange(FRAMES) % 2 == 1
WEIGHTS = {"even": (0.5, 0.5), "uneven": (0.3, 0.7)}  # weights of the frames before and after an interpolated frame
CLEAR_STEP_DN = 10.0  # step of the dark offset [DN]
GROUP = FRAMES // 2  # frames with another dark offset that are too many to be left out


def some(random, count):
    """Returns a mask of `count` frames at random places."""
    chosen = np.zeros(FRAMES, bool)
    chosen[random.choice(FRAMES, count, replace=False)] = True
    return chosen


def with_gains(random, electrons, other, gain, exposure, is_named=False):
    """Returns a burst in which the frames `other` have multiples of the gain and the exposure. The true gain is the
    mean over the frames that count. A single frame of another level contains the whole flicker and leaves no residual,
    so it need not be named."""
    factors = illumination(random) * np.where(other, exposure, 1.0)
    frames = expose(random, electrons, factors, gain=GAIN * np.where(other, gain, 1.0)[:, None, None], offset=0.0)
    frames += OFFSET[BITS]
    places = tuple(int(place) for place in np.flatnonzero(other))
    return Burst(
        digitise(frames, BITS),
        gain=GAIN if is_named else GAIN * np.where(other, gain, 1.0).mean(),
        read_noise=READ_NOISE if is_named else None,
        unlike_frames=places if is_named and not (len(places) == 1 and exposure == 1) else None,
    )


def interpolated(random, electrons, every, weights):
    """Returns a burst in which one of every so many frames is a weighted mean of its neighbours."""
    frames = expose(random, electrons, illumination(random), offset=OFFSET[BITS])
    places = tuple(range(1, FRAMES - 1, every))
    for place in places:
        frames[place] = weights[0] * frames[place - 1] + weights[1] * frames[place + 1]
    few = len(places) <= FRAMES // 5
    return Burst(digitise(frames, BITS), read_noise=READ_NOISE if few else None, unlike_frames=places if few else None)


def with_offsets(random, electrons, other, offset):
    """Returns a burst in which the dark offset of the frames `other` is increased [DN]. They need not be named if they
    are many, or if the step is within the noise of a scene without dark places."""
    shift = offset * other
    few = other.sum() <= FRAMES // 5
    is_named = few and offset >= CLEAR_STEP_DN
    frames = expose(random, electrons, illumination(random), offset=OFFSET[BITS] + shift[:, None, None])
    return Burst(
        digitise(frames, BITS),
        offset=OFFSET[BITS] + (0.0 if few else shift.mean()),
        read_noise=READ_NOISE,
        unlike_frames=tuple(int(place) for place in np.flatnonzero(other)) if is_named else None,
    )


def situation(name, make, expected=MEASURED, scenes=tuple(SCENES)):
    return Situation(name, make, expected, scenes)


SITUATIONS = (
    *(
        situation(f"gains/auto-exposure-{k:g}", lambda r, e, k=k: with_gains(r, e, HALF, k, 1 / k), MUST_REFUSE)
        for k in (1.5, 2.0)
    ),
    *(
        situation(f"gains/hdr-{k:g}", lambda r, e, k=k: with_gains(r, e, EVERY_SECOND, k, k**-2), MUST_REFUSE)
        for k in (2.0, 4.0)
    ),
    *(
        situation(
            f"gains/{count}-frames-{k:g}-equal-level",
            lambda r, e, k=k, count=count: with_gains(r, e, some(r, count), k, 1 / k, True),
        )
        for count in (1, 3, 12)
        for k in (1.5, 4.0)
    ),
    *(
        situation(
            f"gains/{count}-frames-{k:g}-equal-exposure",
            lambda r, e, k=k, count=count: with_gains(r, e, some(r, count), k, 1.0, True),
        )
        for count in (1, 3)
        for k in (1.5, 4.0)
    ),
    *(
        situation(
            f"gains/step-{k:g}%",
            lambda r, e, k=k: with_gains(r, e, HALF, 1 + k / 100, 1.0),
            MAY_REFUSE if k > 10 else MEASURED,
        )
        for k in (2.0, 5.0, 20.0)
    ),
    *(
        situation(f"gains/alternating-{k:g}%", lambda r, e, k=k: with_gains(r, e, EVERY_SECOND, 1 + k / 100, 1.0))
        for k in (2.0, 5.0)
    ),
    *(
        situation(
            f"gains/interpolated-{every}-{name}",
            lambda r, e, every=every, weights=weights: interpolated(r, e, every, weights),
            MAY_REFUSE if every == 2 else MEASURED,
        )
        for every in (2, 5)
        for name, weights in WEIGHTS.items()
    ),
    *(
        situation(
            f"offsets/{count}-frames-{offset:g}",
            lambda r, e, count=count, offset=offset: with_offsets(r, e, some(r, count), offset),
            scenes=("texture", "patches"),  # on a ramp, motion changes all levels equally, like an offset
        )
        for count in (1, 3, 8, GROUP)
        for offset in (5.0, 15.0, 40.0)
    ),
)
