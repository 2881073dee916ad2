# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Makes bursts with correlated noise: filters before and after the read-out, noise reduction in time, image lag, other
frame rates, replaced pixels, enlarged and demosaiced frames.

A filter whose weights sum to 1 keeps the total covariance over lags. The true values are the values before the filter.
Enlarged frames have fewer samples than pixels, and do not determine the gain.
"""

import numpy as np
from acceptance_lines import MAY_REFUSE, MUST_REFUSE
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
    smooth,
)

BITS = 16  # fine steps: the quantization noise is not filtered


def gaussian(frames, radius):
    """Returns the frames with a periodic Gaussian blur of this standard deviation [pixels]."""
    return np.stack([smooth(frame, radius) for frame in frames])


def filtered(random, electrons, radius, after):
    """Returns frames that are blurred between two parts of the read noise. `after` is the variance of the later part
    over the variance of both [1]."""
    before = np.sqrt(1 - after) * READ_NOISE
    frames = expose(random, electrons, illumination(random), offset=OFFSET[BITS], read_noise=before)
    frames = gaussian(frames, radius) + np.sqrt(after) * READ_NOISE * random.normal(size=frames.shape)
    return Burst(digitise(frames, BITS), offset=OFFSET[BITS], read_noise=READ_NOISE)


def intensified(random, electrons, counts, radius):
    """Returns frames in which each event releases a Poisson number of quanta with the mean `counts`, spread by a
    Gaussian. The total covariance over lags gives the gain of an event."""
    factors = illumination(random)
    events = random.poisson(factors[:, None, None] * electrons / counts)
    expected = np.maximum(gaussian(counts * events, radius), 0)
    frames = GAIN * random.poisson(expected) + OFFSET[BITS] + READ_NOISE * random.normal(size=events.shape)
    return Burst(digitise(frames, BITS), gain=GAIN * (1 + counts), offset=OFFSET[BITS], read_noise=READ_NOISE)


def nearest(distance):
    return np.where((distance > -0.5) & (distance <= 0.5), 1.0, 0.0)


def tent(distance):
    return np.maximum(0, 1 - np.abs(distance))


def cubic(distance):
    """Returns the kernel of Keys 1981 with a = -1/2."""
    d = np.abs(distance)
    return np.where(d < 1, 1.5 * d**3 - 2.5 * d**2 + 1, np.where(d < 2, -0.5 * d**3 + 2.5 * d**2 - 4 * d + 2, 0.0))


KERNELS = {"nearest": nearest, "bilinear": tent, "cubic": cubic}


def weights_of(kernel, size, ratio, aligned):
    """Returns the matrix (pixels, samples) that enlarges one axis to `size` pixels."""
    pixels = np.arange(size)
    places = pixels / ratio if aligned else (pixels + 0.5) / ratio - 0.5
    weights = KERNELS[kernel](places[:, None] - np.arange(-2, np.ceil(size / ratio) + 2)[None])
    return weights / weights.sum(axis=1, keepdims=True)


def enlarged(random, scene, kernel, ratios, aligned=False):
    """Returns frames with fewer pixels, enlarged by `ratios` (y, x)."""
    y, x = (weights_of(kernel, size, ratio, aligned) for size, ratio in zip(SHAPE, ratios, strict=True))
    electrons = ELECTRONS * SCENES[scene](random, (y.shape[1], x.shape[1]))
    frames = expose(random, electrons, illumination(random, FRAMES), offset=OFFSET[BITS])
    return Burst(digitise(y @ frames @ x.T, BITS))


def neighbours(frames, offsets):
    return sum(np.roll(frames, offset, axis=(1, 2)) for offset in offsets) / len(offsets)


def demosaiced(random, electrons, channel):
    """Returns one channel of a Bayer mosaic. Its missing pixels are the mean of the nearest pixels of that channel."""
    frames = expose(random, electrons, illumination(random), offset=OFFSET[BITS])
    y, x = np.indices(SHAPE)
    cross = neighbours(frames, [(0, 1), (0, -1), (1, 0), (-1, 0)])
    if channel == "green":
        return Burst(digitise(np.where((x + y) % 2, frames, cross), BITS))
    along = neighbours(frames, [(0, 1), (0, -1)]), neighbours(frames, [(1, 0), (-1, 0)])
    corners = neighbours(frames, [(a, b) for a in (1, -1) for b in (1, -1)])
    odd = np.where(x % 2, corners, along[1])
    return Burst(digitise(np.where(y % 2, odd, np.where(x % 2, along[0], frames)), BITS))


def line(name, make, *given, expected="measured"):
    return Situation(
        name, lambda random, electrons: make(random, electrons, *given), expected=expected, scenes=tuple(SCENES)
    )


def of_samples(kernel, ratios, aligned=False):
    """Returns the lines of an enlargement, one for each scene, which has fewer samples than the frame has pixels."""
    size = "x".join(f"{ratio:g}" for ratio in ratios)
    return [
        Situation(
            f"enlarged/{kernel}-{size}{'-aligned' if aligned else ''}-{scene}",
            lambda random, _electrons, scene=scene: enlarged(random, scene, kernel, ratios, aligned),
            expected=MUST_REFUSE,
        )
        for scene in SCENES
    ]


def mixed_in_time(frames, weight):
    """Returns the frames, each with this weight in its mean with the mixed frame before."""
    for t in range(1, len(frames)):
        frames[t] = weight * frames[t] + (1 - weight) * frames[t - 1]
    return frames


def recursive(random, electrons, weight, count):
    """Returns `count` frames of noise reduction in time: each is a mean of a new frame, which has this weight, and the
    frame before. The filter has settled."""
    settling = 40
    factors = illumination(random, frames=count + settling)
    frames = expose(random, electrons, factors, offset=OFFSET[BITS])
    frames = mixed_in_time(frames, weight)
    return Burst(digitise(frames[settling:], BITS), offset=OFFSET[BITS], read_noise=READ_NOISE)


def reduced_where_alike(random, electrons, weight, limit):
    """Returns frames of noise reduction in time that mixes only where frames differ little: each pixel is a mean of its
    new value, which has this weight, and the value before, if both differ by less than `limit` standard deviations. The
    filter has settled."""
    settling = 12
    factors = illumination(random, frames=FRAMES + settling)
    frames = expose(random, electrons, factors, offset=OFFSET[BITS])
    noise = np.sqrt(GAIN**2 * electrons + READ_NOISE**2)
    for t in range(1, len(frames)):
        step = frames[t] - frames[t - 1]
        frames[t] -= np.where(np.abs(step) < limit * noise, (1 - weight) * step, 0.0)
    return Burst(digitise(frames[settling:], BITS), offset=OFFSET[BITS], read_noise=READ_NOISE)


def lagging(random, electrons, weight):
    """Returns frames of a sensor with image lag: this fraction of the charge of each frame is left to the next one."""
    settling = 12
    factors = illumination(random, frames=FRAMES + settling)
    charge = random.poisson(factors[:, None, None] * electrons[None]).astype(float)
    charge = mixed_in_time(charge, 1 - weight)[settling:]
    frames = GAIN * charge + OFFSET[BITS] + READ_NOISE * random.normal(size=charge.shape)
    return Burst(digitise(frames, BITS), offset=OFFSET[BITS], read_noise=READ_NOISE)


def interpolated(frames, places):
    """Returns frames at these places between the given ones: numbers of frames, which need not be whole."""
    before = places.astype(int)
    weight = (places - before)[:, None, None]
    return (1 - weight) * frames[before] + weight * frames[before + 1]


def converted(random, electrons, ratio):
    """Returns frames of another frame rate, each interpolated between two recorded frames. `ratio` is the number of
    recorded frames per returned frame."""
    places = ratio * np.arange(FRAMES)
    frames = expose(random, electrons, illumination(random, frames=int(places[-1]) + 2), offset=OFFSET[BITS])
    return Burst(digitise(interpolated(frames, places), BITS))


def deinterlaced(random, electrons):
    """Returns frames in which rows of alternating parity are the means of the rows above and below."""
    frames = expose(random, electrons, illumination(random), offset=OFFSET[BITS])
    means = neighbours(frames, [(1, 0), (-1, 0)])
    t, y, _ = np.indices(frames.shape, sparse=True)
    return Burst(digitise(np.where((t + y) % 2 == 0, frames, means), BITS))


AROUND = tuple((y, x) for y in (-1, 0, 1) for x in (-1, 0, 1) if (y, x) != (0, 0))
BESIDE = ((0, -1), (0, 1))
ABOVE = ((1, 0),)


def replaced(random, electrons, fraction, neighbours=AROUND):
    """Returns frames in which this fraction of the pixels, at random places, has the mean of these neighbours (y, x).

    Cameras correct defective pixels, and pixels of the autofocus, in this way."""
    frames = expose(random, electrons, illumination(random), offset=OFFSET[BITS])
    places = random.random(SHAPE) < fraction
    means = sum(np.roll(frames, shift, axis=(1, 2)) for shift in neighbours) / len(neighbours)
    return Burst(digitise(np.where(places, means, frames), BITS), offset=OFFSET[BITS], read_noise=READ_NOISE)


def cleaned(random, electrons, sigmas, count, both):
    """Returns `count` frames without cosmic rays: values further than this number of standard deviations above, or on
    both sides of, the median of their pixel over time were replaced by the median."""
    frames = expose(random, electrons, illumination(random, frames=count), offset=OFFSET[BITS])
    median = np.median(frames, axis=0)
    noise = np.sqrt(GAIN * np.clip(median - OFFSET[BITS], 0, None) + READ_NOISE**2)
    distance = frames - median
    outlying = (np.abs(distance) if both else distance) > sigmas * noise
    return Burst(digitise(np.where(outlying, median, frames), BITS), offset=OFFSET[BITS], read_noise=READ_NOISE)


SITUATIONS = (
    *(
        line(f"recursive/weight-{weight:g}-frames-{count}", recursive, weight, count, expected=MAY_REFUSE)
        for weight, count in ((0.3, 24), (0.3, 80), (0.6, 24))
    ),
    *(
        line(f"recursive/weight-{weight:g}-below-{limit:g}", reduced_where_alike, weight, limit, expected=MUST_REFUSE)
        for weight in (0.4, 0.7)
        for limit in (2, 3)
    ),
    *(line(f"image-lag/{100 * weight:g}%", lagging, weight) for weight in (0.003, 0.008, 0.02)),
    *(line(f"converted/rate-{ratio:g}", converted, ratio, expected=MUST_REFUSE) for ratio in (0.5, 0.8)),
    line("converted/deinterlaced", deinterlaced, expected=MUST_REFUSE),
    *(line(f"replaced/{100 * fraction:g}%", replaced, fraction) for fraction in (0.005, 0.01, 0.03)),
    *(line(f"replaced/pairs-{100 * fraction:g}%", replaced, fraction, BESIDE) for fraction in (0.01, 0.03)),
    *(line(f"replaced/copies-{100 * fraction:g}%", replaced, fraction, ABOVE) for fraction in (0.01, 0.03)),
    *(
        line(f"cleaned/{name}-frames-{count}", cleaned, 3, count, name == "both", expected=MUST_REFUSE)
        for name in ("both", "above")
        for count in (12, 20, 60)
    ),
    *(line(f"filtered/after-read-out-{radius}", filtered, radius, 0.0) for radius in (0.5, 0.8, 1.2)),
    *(line(f"filtered/before-read-out-{radius}", filtered, radius, 1.0) for radius in (0.5, 0.8, 1.2)),
    line("filtered/between-0.8", filtered, 0.8, 0.5),
    *(line(f"events/{counts}-counts", intensified, counts, 0.8, expected=MAY_REFUSE) for counts in (3, 10)),
    *of_samples("bilinear", (2, 2)),
    *of_samples("bilinear", (2, 2), aligned=True),
    *of_samples("bilinear", (1, 2)),
    *of_samples("bilinear", (3, 3)),
    *of_samples("bilinear", (1.5, 1.5)),
    *of_samples("bilinear", (1.37, 1.37)),
    *of_samples("bilinear", (2.5, 2.5)),
    *of_samples("cubic", (2, 2)),
    *of_samples("nearest", (2, 2)),
    *(line(f"demosaiced/{channel}", demosaiced, channel, expected=MUST_REFUSE) for channel in ("green", "red")),
)
