# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Makes bursts of random cameras in front of random scenes, each with one defect of random strength.

The other situations_*.py have one camera. Here gain, noise, number of electrons, number of frames, flicker and scene
differ from burst to burst, as they do between users.
"""

import numpy as np
from acceptance_lines import MAY_REFUSE, MEASURED, MUST_REFUSE
from drawn_cameras import SHAPE, burst, draw, exposed, factors_of, logarithmic
from situations import Situation
from situations_good import shifted
from situations_shared import AROUND, gaussian, interpolated, mixed_in_time, neighbours

Y, X = np.indices(SHAPE)


def one_half(random):
    """Returns a mask (y, x) of the left or of the upper half of the frame."""
    return 2 * X // SHAPE[1] == 0 if random.random() < 0.5 else 2 * Y // SHAPE[0] == 0


def plain(random, camera):
    """Returns a burst without a defect."""
    return burst(camera, exposed(random, camera))


def column_amplifiers(random, camera):
    """Returns a burst of a sensor whose groups of columns have gains that differ by 1 to 6 % rms."""
    columns = random.choice([1, 2, 8, 32])
    relative = 1 + random.choice([0.01, 0.03, 0.06]) * random.normal(size=SHAPE[1] // columns + 1)
    gains = camera.gain * relative[np.arange(SHAPE[1]) // columns]
    return burst(camera, exposed(random, camera, gain=gains), gain=gains.mean())


def two_amplifiers(random, camera):
    """Returns a burst of a sensor whose even and odd rows have gains that differ by 3 to 30 %."""
    gains = camera.gain * (1 + random.choice([0.03, 0.1, 0.3]) * (Y % 2 - 0.5))
    return burst(camera, exposed(random, camera, gain=gains), gain=gains.mean())


def half_noisier(random, camera):
    """Returns a burst of a sensor whose one half has 1.3 to 3 times the read noise of the other half."""
    half = one_half(random)
    read_noise = camera.read_noise * np.where(half, logarithmic(random, 1.3, 3.0), 1.0)
    return burst(camera, exposed(random, camera, read_noise=read_noise), read_noise=np.sqrt(np.mean(read_noise**2)))


def flat_halves(random, camera):
    """Returns a flat field of a sensor whose halves have gains that differ by 0.5 to 6 %, without dark frames."""
    half = one_half(random)
    gains = camera.gain * (1 + logarithmic(random, 0.005, 0.06) * (half - 0.5))
    rates = factors_of(random, camera)[:, None, None] * np.full(SHAPE, camera.electrons.max())
    return burst(camera, exposed(random, camera, rates, gain=gains), gain=gains.mean(), offset=None, read_noise=None)


def steady_light(random, camera):
    """Returns a burst with a spot of light that does not flicker, of 3 to 50 % of the brightest pixel. The offset is
    not compared: it includes light that is the same everywhere."""
    strength = logarithmic(random, 0.03, 0.5)
    x, y = random.uniform(0.2, 0.8, 2)
    spot = np.exp(-((X / SHAPE[1] - x) ** 2 + (Y / SHAPE[0] - y) ** 2) / 0.15)
    light = factors_of(random, camera)[:, None, None] * camera.electrons + strength * camera.electrons.max() * spot
    return burst(camera, exposed(random, camera, light / (1 + strength)), offset=None)


def offset_drifts(random, camera):
    """Returns a burst whose offset drifts slowly, by 0.3 to 4 read noises."""
    size = random.choice([0.3, 1.0, 4.0]) * camera.read_noise
    drift = size * np.sin(np.arange(camera.frames) * random.uniform(0.1, 2.0))
    return burst(camera, exposed(random, camera) + drift[:, None, None], offset=camera.offset + drift.mean())


def gain_changes(random, camera):
    """Returns a burst whose gain becomes 10 to 100 % larger, while the exposure becomes as much shorter. The
    larger part of the frames has the true gain."""
    ratio = 1 + random.choice([0.1, 0.5, 1.0])
    share = random.choice([random.uniform(0.2, 0.4), random.uniform(0.6, 0.8)])
    later = np.arange(camera.frames) >= int(camera.frames * share)
    unlike = later if later.sum() < camera.frames / 2 else ~later
    relative = np.where(unlike, ratio if unlike[-1] else 1 / ratio, 1.0)[:, None, None]
    frames = exposed(random, camera, camera.electrons / relative, gain=camera.gain * relative)
    return burst(camera, frames, offset=None, read_noise=None)._replace(unlike_frames=tuple(np.flatnonzero(unlike)))


def unlit(random, camera):
    """Returns a burst in which 10 to 75 % of the frames have no illumination, or 2 %."""
    factors = factors_of(random, camera)
    dark = random.permutation(camera.frames)[: int(camera.frames * random.choice([0.1, 0.25, 0.5, 0.75]))]
    factors[dark] = random.choice([0.0, 0.02])
    return burst(camera, exposed(random, camera, factors[:, None, None] * camera.electrons))


def other_frame_rate(random, camera):
    """Returns frames of another frame rate, each interpolated between two recorded frames."""
    places = random.choice([0.5, 0.8, 5 / 6, 0.9, 0.96]) * np.arange(camera.frames)
    rates = factors_of(random, camera, int(places[-1]) + 2)[:, None, None] * camera.electrons
    return burst(camera, interpolated(exposed(random, camera, rates), places))


def blurred(random, camera):
    """Returns frames that a Gaussian of 0.35 to 1.3 pixels smooths after the read-out."""
    radius = random.uniform(0.35, 1.3)
    return burst(camera, gaussian(exposed(random, camera), radius))


def crosstalk(random, camera):
    """Returns frames of a sensor where 2 to 8 % of the charge reaches the four neighbours before the read noise."""
    part = random.choice([0.02, 0.08])
    charge = exposed(random, camera, offset=0.0, read_noise=0.0)
    frames = (1 - part) * charge + part * neighbours(charge, [(1, 0), (-1, 0), (0, 1), (0, -1)])
    return burst(camera, frames + camera.offset + camera.read_noise * random.normal(size=frames.shape))


def median_filtered(random, camera):
    """Returns frames after a median filter of 3 x 3 pixels."""
    frames = exposed(random, camera)
    shifted_frames = [np.roll(frames, shift, axis=(1, 2)) for shift in ((0, 0), *AROUND)]
    return burst(camera, np.median(shifted_frames, axis=0))


def averaged_in_time(random, camera):
    """Returns frames of recursive noise reduction, in which the frame before has a weight of 5 to 40 %."""
    kept, settling = random.choice([0.05, 0.1, 0.2, 0.4]), 30
    factors = factors_of(random, camera, camera.frames + settling)
    frames = exposed(random, camera, factors[:, None, None] * camera.electrons)
    return burst(camera, mixed_in_time(frames, 1 - kept)[settling:])


def waves(random, camera):
    """Returns a burst under illumination whose waves of 0.5 to 6 % cross the frame."""
    depth = random.choice([0.005, 0.02, 0.06])
    along_x, along_y, per_frame = random.uniform((0.005, 0.005, 0.3), (0.1, 0.1, 3.0))
    phase = along_x * X + along_y * Y + per_frame * np.arange(camera.frames)[:, None, None]
    return burst(camera, exposed(random, camera, (1 + depth * np.sin(phase)) * camera.electrons))


def pulsed_rows(random, camera):
    """Returns a burst under a pulsed lamp and a rolling shutter: sharp bands of 1 to 20 %."""
    depth, period = random.choice([0.01, 0.05, 0.2]), random.uniform(20.0, 200.0)
    phase = random.uniform(0, 2 * np.pi, (camera.frames, 1, 1))
    bands = 1 + depth * np.sign(np.sin(2 * np.pi * Y / period + phase))
    return burst(camera, exposed(random, camera, bands * camera.electrons))


def transients(random, camera):
    """Returns a burst with 5 to 80 spots that flash by 5 to 50 % and decay over four frames."""
    factors = np.ones((camera.frames, *SHAPE))
    for _ in range(random.choice([5, 30, 80])):
        width = random.uniform(4.0, 12.0)
        spot = np.exp(-((Y - random.uniform(0, SHAPE[0])) ** 2 + (X - random.uniform(0, SHAPE[1])) ** 2) / 2 / width**2)
        age = np.arange(camera.frames) - random.integers(camera.frames)
        flash = np.where(age >= 0, np.exp(-np.maximum(age, 0) / 4.0), 0.0)
        factors += random.uniform(0.05, 0.5) * flash[:, None, None] * spot
    return burst(camera, exposed(random, camera, factors * camera.electrons), offset=None)


def vibrating(random, camera):
    """Returns a burst that vibrates along both axes by 0.05 to 0.6 pixels rms."""
    rms = random.choice([0.05, 0.2, 0.6])
    factors = factors_of(random, camera)
    rates = [factor * shifted(camera.electrons, *(rms * random.normal(size=2))) for factor in factors]
    return burst(camera, exposed(random, camera, np.array(rates)))


def noisy_pixels(random, camera):
    """Returns a burst in which 0.1 to 4 % of the pixels jump at random by 3 to 10 read noises."""
    count = int(np.prod(SHAPE) * random.choice([0.001, 0.01, 0.04]))
    frames = exposed(random, camera)
    pixels = random.integers(0, SHAPE[0], count), random.integers(0, SHAPE[1], count)
    jumps = random.random((camera.frames, count)) < random.choice([0.1, 0.5])
    frames[:, pixels[0], pixels[1]] += random.choice([3.0, 10.0]) * camera.read_noise * jumps
    return burst(camera, frames)


def row_noise(random, camera):
    """Returns a burst whose rows have a common noise of 0.3 to 2 read noises."""
    noise = random.normal(size=(camera.frames, SHAPE[0], 1))
    frames = exposed(random, camera) + random.choice([0.3, 1.0, 2.0]) * camera.read_noise * noise
    return burst(camera, frames, read_noise=None)


def pickup(random, camera):
    """Returns a burst with interference of one frequency, 0.3 to 2 read noises large."""
    along_y, along_x = 2 * np.pi * random.uniform(0.02, 0.45, size=2)
    phase = random.uniform(0, 2 * np.pi, (camera.frames, 1, 1))
    stripes = np.sin(along_y * Y + along_x * X + phase)
    frames = exposed(random, camera) + random.choice([0.3, 1.0, 2.0]) * camera.read_noise * stripes
    return burst(camera, frames, read_noise=None)


def two_ranges(random, camera):
    """Returns a burst of pixels that are read through an amplifier of 2 to 8 times the read noise from 15 to 60 % of
    the brightest signal on."""
    charge = exposed(random, camera, gain=1.0, offset=0.0, read_noise=0.0)
    is_high = charge > random.uniform(0.15, 0.6) * camera.electrons.max()
    gains = camera.gain * np.where(is_high, 1 + random.choice([0.0, 0.01, 0.02]), 1.0)
    noise = camera.read_noise * np.where(is_high, random.choice([2.0, 4.0, 8.0]), 1.0)
    return burst(camera, gains * charge + camera.offset + noise * random.normal(size=charge.shape))


def stuck_pixels(random, camera):
    """Returns a burst that saturates, with three pixels stuck above the saturation level."""
    frames = exposed(random, camera)
    level = np.quantile(frames, random.uniform(0.85, 0.99))
    frames = np.minimum(frames, level)
    frames[:, random.integers(0, SHAPE[0], 3), random.integers(0, SHAPE[1], 3)] = level + logarithmic(random, 50, 3000)
    return burst(camera, frames)


def dark_frames(random, camera):
    """Returns a burst with dark frames of the same camera."""
    return burst(camera, exposed(random, camera))._replace(dark=dark_of(random, camera))


def other_dark_frames(random, camera):
    """Returns a burst with dark frames whose offset differs by 4 to 20 read noises."""
    moved = random.choice([-1, 1]) * random.choice([4.0, 20.0]) * camera.read_noise
    dark = dark_of(random, camera, offset=camera.offset + moved)
    return burst(camera, exposed(random, camera))._replace(dark=dark)


def dark_of(random, camera, **changed):
    frames = exposed(random, camera, np.zeros((16, *SHAPE)), **changed)
    return burst(camera, frames).frames


KINDS = {
    MEASURED: (
        plain,
        column_amplifiers,
        two_amplifiers,
        half_noisier,
        steady_light,
        offset_drifts,
        unlit,
        crosstalk,
        waves,
        pulsed_rows,
        vibrating,
        noisy_pixels,
        row_noise,
        pickup,
        stuck_pixels,
        dark_frames,
        other_dark_frames,
    ),
    MAY_REFUSE: (flat_halves, blurred, averaged_in_time, gain_changes, transients, two_ranges),
    MUST_REFUSE: (other_frame_rate, median_filtered),
}

SITUATIONS = tuple(
    Situation(
        f"drawn/{kind.__name__.replace('_', '-')}",
        lambda random, _electrons, kind=kind: kind(random, draw(random)),
        expected,
    )
    for expected, kinds in KINDS.items()
    for kind in kinds
)
