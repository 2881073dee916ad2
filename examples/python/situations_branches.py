# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Makes bursts of pixels with two amplifiers: dual-gain sCMOS and HDR sensors, which amplify bright samples less.

The true gain is the mean over the pixels. True offset and read noise are for the amplifier of the dark levels.
"""

import numpy as np
from situations import GAIN, OFFSET, SCENES, Burst, Situation, digitise, illumination

BITS = 12
DARK_NOISE = 1.5  # read noise of the amplifier of the dark levels [DN]
BRIGHT_NOISE = 12.0  # read noise of the amplifier of the bright levels [DN]


def branches(random, electrons, mismatch, switch, bright_noise=BRIGHT_NOISE):
    """Returns a burst in which samples above a level come from the second amplifier, whose signal deviates.

    mismatch: relative deviation of its signal; switch: fraction of the pixels below the level."""
    factors = illumination(random)
    signal = GAIN * random.poisson(factors[:, None, None] * electrons[None])
    level = GAIN * np.quantile(electrons, switch)
    is_bright = signal > level
    noise = np.where(is_bright, bright_noise, DARK_NOISE) * random.normal(size=signal.shape)
    frames = OFFSET[BITS] + np.where(is_bright, (1 + mismatch) * signal, signal) + noise
    gain = GAIN * (1 + mismatch * (GAIN * electrons > level).mean())
    return Burst(digitise(frames, BITS), gain=gain, offset=OFFSET[BITS], read_noise=DARK_NOISE, unlike_frames=())


KINDS = {  # mismatch, fraction of the pixels below the step, read noise of the second amplifier
    "0.5%-at-30%": (0.005, 0.3),
    "2%-at-30%": (0.02, 0.3),
    "2%-at-15%": (0.02, 0.15),
    "1%-at-60%": (0.01, 0.6),
    "1%-at-30%-weak": (0.01, 0.3, 5.0),
}

SITUATIONS = tuple(
    Situation(
        f"branches/{name}",
        lambda random, electrons, values=values: branches(random, electrons, *values),
        scenes=tuple(SCENES),
    )
    for name, values in KINDS.items()
)
