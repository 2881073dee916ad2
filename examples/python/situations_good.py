# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Makes bursts of good cameras that are easily rejected: pulsed illumination, interlacing, interference, haze."""

import numpy as np
from acceptance_lines import MAY_REFUSE, MEASURED
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
    scaled,
    smooth,
)

BITS = 12


def burst(frames, bits=BITS, **truth):
    """Returns the frames as a converter reads them, with the default true values."""
    return Burst(digitise(frames, bits), **({"offset": OFFSET[bits], "read_noise": READ_NOISE} | truth))


def expose_each(random, rates, **camera):
    """Returns frames of a camera, each with its own expected electrons (t, y, x)."""
    return np.concatenate([expose(random, rate, [1.0], **camera) for rate in rates])


def rolling_shutter(random, electrons, strength, period=0.37):
    """Returns frames whose rows are exposed one after the other under a lamp that is on for half of its period. They
    have sharp bands.

    strength: relative change of the illumination between the two states of a row; period: period of the lamp, over the
    time from the first row to the last."""
    rows = np.arange(SHAPE[0]) / SHAPE[0]
    phase = random.uniform(size=FRAMES)
    state = ((rows[None] / period + phase[:, None]) % 1 < 0.5) - 0.5
    factors = illumination(random)[:, None] * (1 + strength * state)
    return burst(expose_each(random, factors[:, :, None] * electrons))


def turned(random, electrons, strength):
    """Returns the frames of rolling_shutter() after a quarter turn, as from a camera that was held upright."""
    lying = rolling_shutter(random, electrons, strength)
    return lying._replace(frames=np.ascontiguousarray(lying.frames.transpose(0, 2, 1)))


def interlaced(random, electrons, flicker):
    """Returns frames of two fields: even and odd rows are exposed at different moments, with independent illumination
    factors."""
    factors = np.empty((FRAMES, SHAPE[0], 1))
    factors[:, 0::2, 0] = illumination(random, flicker=flicker)[:, None]
    factors[:, 1::2, 0] = illumination(random, flicker=flicker)[:, None]
    return burst(expose_each(random, factors * electrons))


def interference(random, electrons, strength):
    """Returns frames with diagonal stripes of one frequency and a random phase in each frame, of this rms over the read
    noise [1]."""
    y, x = np.indices(SHAPE)
    phase = random.uniform(0, 2 * np.pi, FRAMES)
    stripes = np.sin(2 * np.pi * (0.173 * x + 0.091 * y)[None] + phase[:, None, None])
    frames = expose(random, electrons, illumination(random))
    return burst(frames + np.sqrt(2) * strength * READ_NOISE * stripes)


def eight_bits(random, electrons, highest):
    """Returns a burst of a machine-vision camera with 8 bits. It has so many electrons per digital number that the
    noise of dark pixels is below half a quantization step.

    highest: electrons of the brightest pixel [e-]."""
    gain, bright = 220 / highest, highest / ELECTRONS * electrons
    frames = expose(random, bright, illumination(random), gain=gain, offset=10.0, read_noise=8 * gain)
    return Burst(digitise(frames, 8, np.uint8), gain=gain, offset=10.0, signal_range=220.0)


def shifted(image, dx, dy):
    """Returns the image, moved by dx and dy with the Fourier shift theorem [pixels]."""
    y, x = (np.fft.fftfreq(size) for size in image.shape)
    spectrum = np.fft.fft2(image) * np.exp(-2j * np.pi * (y[:, None] * dy + x[None, :] * dx))
    return np.fft.ifft2(spectrum).real


def haze(random, electrons, rms):
    """Returns a burst in heat haze. Each frame has an independent random displacement of this rms [pixels], which is
    smooth over 15 pixels (standard deviation of a Gaussian)."""
    by, bx = np.gradient(electrons)
    factors, frames = illumination(random), []
    for factor in factors:
        dx, dy = (smooth(random.normal(size=SHAPE), 15.0) for _ in range(2))
        moved = electrons + rms * (dx / dx.std() * bx + dy / dy.std() * by)
        frames.append(expose(random, np.maximum(moved, 0.0), [factor])[0])
    return burst(np.array(frames))


def fixed_pattern(random, _electrons, strength):
    """Returns a burst with a DSNU of this standard deviation over the read noise [1]; the signal is at most 15 e-."""
    offsets = OFFSET[BITS] + strength * READ_NOISE * random.normal(size=SHAPE)
    return faint(random, _electrons, offset=offsets)


def faint(random, electrons, offset=OFFSET[BITS], highest=15.0):
    gain = 2.0  # [DN/e-]
    dim = highest / ELECTRONS * electrons
    frames = expose(random, dim, illumination(random), gain=gain, offset=offset)
    return Burst(digitise(frames), gain=gain, signal_range=gain * highest)


def half_noisier(random, electrons, ratio):
    """Returns a burst in which the right half of the sensor has this multiple of the read noise of the left half."""
    read_noise = np.where(np.arange(SHAPE[1])[None] < SHAPE[1] // 2, READ_NOISE, ratio * READ_NOISE)
    return burst(expose(random, electrons, illumination(random), read_noise=read_noise), read_noise=None)


def noise_grows(random, electrons, ratio):
    """Returns a burst in which the read noise grows along a diagonal of the frame, from corner to corner by this
    factor, as with the distance from a read-out or with the temperature."""
    y, x = np.indices(SHAPE) / np.reshape(SHAPE, (2, 1, 1))
    read_noise = READ_NOISE * ratio ** ((x + y) / 2)
    return burst(expose(random, electrons, illumination(random), read_noise=read_noise), read_noise=None)


def counting(random, electrons, highest):
    """Returns a burst of a photon-counting detector: whole photons from 0 on, without offset and read noise."""
    counts = expose(random, highest / ELECTRONS * electrons, illumination(random), gain=1.0, offset=0.0, read_noise=0.0)
    return Burst(digitise(counts, 16), gain=1.0, offset=None, signal_range=highest)


def text(random, highest):
    """Returns a page of text: black strokes on white paper, at the limit of the optics."""
    page = np.ones(SHAPE)
    for top in range(8, SHAPE[0] - 12, 16):
        for left in range(8, SHAPE[1] - 10, 9):
            letter = np.ones((9, 7))
            letter[random.integers(0, 9), :] = 0.08
            letter[:, random.integers(0, 7)] = 0.08
            letter[random.integers(0, 9), random.integers(0, 4) :] = 0.08
            page[top : top + 9, left : left + 7] = np.where(random.uniform() < 0.85, letter, 1.0)
    page = scaled(smooth(page, 0.8), 0.06)
    y, x = np.indices(SHAPE)
    page *= 1 - 0.2 * ((x / SHAPE[1] - 0.5) ** 2 + (y / SHAPE[0] - 0.4) ** 2)
    return burst(expose(random, highest * page, illumination(random)), signal_range=GAIN * highest)


def flat(random, electrons, flicker):
    """Returns a flat field with dark frames, as for a photon transfer."""
    frames = expose(random, np.full(SHAPE, 0.6 * electrons.max()), illumination(random, flicker=flicker), gain=1.0)
    dark = expose(random, np.zeros(SHAPE), np.ones(20), gain=1.0)
    return burst(frames, gain=1.0, signal_range=0.6 * ELECTRONS)._replace(dark=digitise(dark, BITS))


def line(name, make, *given, expected=MEASURED):
    return Situation(
        f"good/{name}",
        lambda random, electrons: make(random, electrons, *given),
        expected,
        scenes=tuple(SCENES),
    )


SITUATIONS = (
    *(line(f"rolling-shutter-{strength:.0%}", rolling_shutter, strength) for strength in (0.03, 0.1)),
    line("rolling-shutter-10%-slow", rolling_shutter, 0.1, 1.7),
    line("rolling-shutter-10%-turned", turned, 0.1),
    *(line(f"interlaced-{flicker:.1%}", interlaced, flicker) for flicker in (0.005, 0.02)),
    *(line(f"interference-{strength:g}", interference, strength) for strength in (0.35, 1.0)),
    *(line(f"eight-bits-{highest:g}", eight_bits, highest) for highest in (5000.0, 10000.0, 20000.0)),
    *(line(f"haze-{rms:g}", haze, rms) for rms in (0.05, 0.15)),
    *(line(f"fixed-pattern-{strength:g}", fixed_pattern, strength, expected=MAY_REFUSE) for strength in (0.5, 2.0)),
    *(line(f"half-noisier-{ratio:g}", half_noisier, ratio) for ratio in (1.3, 2.0)),
    *(line(f"noise-grows-{ratio:g}", noise_grows, ratio) for ratio in (1.5, 3.0)),
    *(line(f"flat-{flicker:.0%}", flat, flicker) for flicker in (0.01, 0.02, 0.05)),
    *(line(f"counting-{highest:g}", counting, highest) for highest in (30.0, 1000.0)),
    *(
        Situation(f"good/text-{highest:g}", lambda random, _electrons, highest=highest: text(random, highest))
        for highest in (150.0, 500.0, 5000.0)
    ),
)
