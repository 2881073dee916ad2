# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Makes mostly dark scenes: a small illuminated part on a background of little or no signal, without motion."""

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
    scaled,
    smooth,
    texture,
)

BITS = 12
PRNU, DSNU_DN = 0.007, 1.0  # fixed-pattern noise: PRNU [1], DSNU [DN]


def disc(random, area):
    """Returns a textured disc of this relative area that darkens towards its limb: a planet [1]."""
    y, x = np.indices(SHAPE)
    radius = np.sqrt(area * SHAPE[0] * SHAPE[1] / np.pi)
    distance = np.hypot(y - SHAPE[0] / 2, x - SHAPE[1] / 2) / radius
    limb = np.sqrt(np.clip(1 - distance**2, 0, 1))
    return smooth(limb * (0.6 + 0.4 * texture(random)), 1.0)


def displays(random, area):
    """Returns four displays of different brightness, with dark lines of text [1]."""
    image = np.zeros(SHAPE)
    height, width = (int(size * np.sqrt(area / 4)) for size in SHAPE)
    for top in (0.2, 0.6):
        for left in (0.2, 0.6):
            row, column = int(top * SHAPE[0]), int(left * SHAPE[1])
            screen = np.full((height, width), random.uniform(0.3, 1.0))
            screen[::6, ::2] *= random.uniform(0.1, 0.9, screen[::6, ::2].shape)
            image[row : row + height, column : column + width] = screen
    return smooth(image, 1.0)


def bands(random, area):
    """Returns bright bands of a gel, with smooth profiles across its lanes [1]."""
    image = np.zeros(SHAPE)
    y = np.arange(SHAPE[0])
    for lane in range(6):
        columns = slice(15 + 36 * lane, 40 + 36 * lane)
        for centre in random.uniform(20, SHAPE[0] - 20, 5):
            profile = np.exp(-0.5 * ((y - centre) / (6 * area / 0.1)) ** 2)
            image[:, columns] += random.uniform(0.1, 1.0) * profile[:, None]
    return smooth(image, 1.0)


def square_and_wedge(random, area):
    """Returns one bright square, and a grey wedge of 2 % of the frame [1]."""
    image = np.zeros(SHAPE)
    side = int(np.sqrt(area * SHAPE[0] * SHAPE[1]))
    image[30 : 30 + side, 40 : 40 + side] = 1.0
    image[180:190, 30:130] = np.linspace(0, 1, 100)
    return smooth(image, 1.0)


def stars(random, count):
    """Returns stars of very different brightness."""
    image = np.zeros(SHAPE)
    image[random.integers(0, SHAPE[0], count), random.integers(0, SHAPE[1], count)] = random.pareto(1.2, count)
    return np.minimum(smooth(image, 2.0), np.quantile(image, 0.998))


def dark_scene(random, scene, floor, electrons=ELECTRONS, flicker=0.01):
    """Returns a burst of a scene on a background of this fraction of the maximum, with fixed-pattern noise."""
    illuminated = electrons * scaled(np.maximum(scene, 0.0), floor, 1.0) * (1 + PRNU * random.normal(size=SHAPE))
    offset = OFFSET[BITS] + DSNU_DN * random.normal(size=SHAPE)
    factors = illumination(random, FRAMES, flicker)
    frames = expose(random, np.maximum(0.0, illuminated), factors, offset=offset)
    return Burst(digitise(frames, BITS), offset=OFFSET[BITS] if flicker else None, read_noise=READ_NOISE)


def line(name, scene, strength, floor, **options):
    return Situation(
        f"dark-scenes/{name}", lambda random, _electrons: dark_scene(random, scene(random, strength), floor, **options)
    )


SITUATIONS = (
    *(
        line(f"{name}-{area:.0%}-floor-{floor:.0%}", scene, area, floor)
        for name, scene in (("planet", disc), ("displays", displays), ("bands", bands), ("square", square_and_wedge))
        for area in (0.04, 0.12, 0.3)
        for floor in (0.0, 0.05)
    ),
    *(line(f"stars-{count}", stars, count, 0.0) for count in (100, 1000)),
    line("planet-12%-steady", disc, 0.12, 0.0, flicker=0.0),
    line("planet-12%-faint", disc, 0.12, 0.02, electrons=800.0),
)
