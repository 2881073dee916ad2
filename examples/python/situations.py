# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Makes bursts with NumPy, with an independent camera model: lines of measure_acceptance.py.

A situation is a function that makes a burst with known true values. Each module situations_*.py has the situations of
one kind in SITUATIONS. situations_all.py lists the modules.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from acceptance_lines import MEASURED

SHAPE = (200, 240)  # rows and columns [pixels]
FRAMES = 60
GAIN, READ_NOISE = 0.5, 3.0  # [DN/e-], [DN]
OFFSET = {12: 100.0, 16: 4000.0}  # dark offset by the bits of the converter [DN]
ELECTRONS = 5000.0  # expected electrons of the brightest pixel [e-]
FLICKER = 0.01  # standard deviation of the illumination factor [1]
DARKEST = 0.02  # signal of the darkest pixel of a scene over the signal of the brightest pixel [1]


class Burst(NamedTuple):
    """Burst and its true values. A quantity that the situation does not define is None, and is not compared."""

    frames: np.ndarray  # (t, y, x), in the pixel type that the estimator gets
    gain: float | None = GAIN  # [DN/e-]
    offset: float | None = None  # [DN]
    read_noise: float | None = None  # without quantization noise [DN]
    linearity_error: float | None = None  # linearity error by the exposures in options [%]
    unlike_frames: tuple[int, ...] | None = None  # frames to be left out; None: not compared
    signal_range: float = GAIN * ELECTRONS  # brightest signal less the offset [DN]
    dark: np.ndarray | None = None  # dark frames (t, y, x)
    options: tuple[str, ...] = ()  # further options of estimate-sensor-noise


class Situation(NamedTuple):
    """Line of the table.

    make gets the random generator and the expected electrons of the scene (y, x), from 0 to ELECTRONS. They are None
    for a situation without a scene of SCENES."""

    name: str  # kind/strength, such as dark/planet-4%
    make: Callable[[np.random.Generator, np.ndarray | None], Burst]
    expected: str = MEASURED
    scenes: tuple[str, ...] = ()  # names in SCENES; none: the situation makes its scene


def situations_of(prefix, kinds):
    """Returns the lines of kinds: functions make(random, electrons, strength) by their names, with their strengths."""
    return tuple(
        Situation(
            f"{prefix}/{kind}-{strength:g}",
            lambda random, electrons, make=make, strength=strength: make(random, electrons, strength),
            scenes=tuple(SCENES),
        )
        for kind, (make, strengths) in kinds.items()
        for strength in strengths
    )


def smooth(image, radius):
    """Returns the image with a periodic Gaussian blur of this standard deviation [pixels]."""
    y, x = (np.fft.fftfreq(size) for size in image.shape)
    transfer = np.exp(-2 * (np.pi * radius) ** 2 * (y[:, None] ** 2 + x[None, :] ** 2))
    return np.fft.ifft2(np.fft.fft2(image) * transfer).real


def scaled(image, lowest=DARKEST, highest=1.0):
    """Returns the image, scaled linearly to these limits."""
    low, high = image.min(), image.max()
    return lowest + (highest - lowest) * (image - low) / (high - low)


def texture(random, shape=SHAPE):
    """Returns a texture with structure of all sizes from 1.5 to 40 pixels [1]."""
    return scaled(sum(scaled(smooth(random.normal(size=shape), radius)) for radius in (1.5, 4.0, 12.0, 40.0)))


def patches(random, shape=SHAPE):
    """Returns a chart of uniform tiles, 20 pixels wide, with soft edges [1]."""
    levels = random.uniform(size=(-(-shape[0] // 20), -(-shape[1] // 20)))
    return scaled(smooth(np.kron(levels, np.ones((20, 20)))[: shape[0], : shape[1]], 1.0))


def ramp(_random, shape=SHAPE):
    """Returns a brightness that increases across the frame [1]."""
    y, x = np.indices(shape)
    return scaled(x / shape[1] + 0.3 * y / shape[0])


SCENES = {"texture": texture, "patches": patches, "ramp": ramp}


def electrons_of(scene, random, electrons=ELECTRONS):
    """Returns the expected electrons (y, x) of a scene of SCENES."""
    return electrons * SCENES[scene](random)


def illumination(random, frames=FRAMES, flicker=FLICKER):
    """Returns the illumination factors of the frames, normal with the mean 1."""
    return 1 + flicker * random.normal(size=frames)


def expose(random, electrons, factors, gain=GAIN, offset=OFFSET[12], read_noise=READ_NOISE):
    """Returns frames (t, y, x) in DN before rounding: gain x Poisson electrons + offset + normal read noise.

    electrons: expected electrons (y, x); factors: illumination factor of each frame; gain, offset and read_noise may be
    images (y, x)."""
    factors = np.asarray(factors, float)
    return read_out(random, random.poisson(factors[:, None, None] * electrons[None]), gain, offset, read_noise)


def read_out(random, charge, gain, offset, read_noise):
    """Returns frames (t, y, x) in DN before rounding, of the charge of each pixel in each frame [e-]."""
    return gain * charge + offset + read_noise * random.normal(size=charge.shape)


def digitise(frames, bits=12, dtype=np.uint16):
    """Returns the frames as whole numbers of a converter that clips at 0 and at 2^bits - 1 [DN]."""
    return np.clip(np.rint(frames), 0, 2**bits - 1).astype(dtype)


def plain(random, electrons, bits=12):
    """Returns a burst of a good camera, which the other situations vary."""
    frames = expose(random, electrons, illumination(random, FRAMES), offset=OFFSET[bits])
    return Burst(digitise(frames, bits), offset=OFFSET[bits], read_noise=READ_NOISE, unlike_frames=())


SITUATIONS = tuple(
    Situation(
        f"plain/{bits}-bits", lambda random, electrons, bits=bits: plain(random, electrons, bits), scenes=tuple(SCENES)
    )
    for bits in OFFSET
)
