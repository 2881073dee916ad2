# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Makes bursts with borders that are not part of the scene: optical-black columns and rows, masked regions, test rows.

The true values are for the pixels of the scene.
"""

import numpy as np
from situations import FRAMES, GAIN, OFFSET, READ_NOISE, SCENES, Burst, Situation, digitise, expose, illumination

BITS = 12


def bordered(random, electrons, cover):
    """Returns a burst with a border. cover(expected, offset, noise) changes these images (y, x) in place."""
    expected = electrons.copy()
    offset = np.full(expected.shape, OFFSET[BITS])
    noise = np.full(expected.shape, READ_NOISE)
    cover(expected, offset, noise)
    frames = expose(random, expected, illumination(random, FRAMES), GAIN, offset, noise)
    return Burst(digitise(frames, BITS), offset=OFFSET[BITS], read_noise=READ_NOISE, unlike_frames=())


def black_columns(columns, below):
    """Covers optical-black columns at the left. They are `below` DN below the pixels without signal."""

    def cover(expected, offset, _noise):
        expected[:, :columns] = 0
        offset[:, :columns] -= below

    return cover


def black_frame(columns, rows, below):
    """Covers masked regions at both sides, at the top and at the bottom."""

    def cover(expected, offset, _noise):
        masked = np.ones(expected.shape, bool)
        masked[rows:-rows, columns:-columns] = False
        expected[masked] = 0
        offset[masked] -= below

    return cover


def test_rows(rows, level):
    """Makes rows at the bottom that hold a test level with its own noise, and no signal."""

    def cover(expected, offset, noise):
        expected[-rows:] = 0
        offset[-rows:] = level
        noise[-rows:] = 2 * READ_NOISE

    return cover


KINDS = {
    "black-columns-8": black_columns(8, 5.0),
    "black-columns-24": black_columns(24, 5.0),
    "black-columns-16-above": black_columns(16, -5.0),
    "black-frame-12": black_frame(12, 8, 5.0),
    "test-rows-2": test_rows(2, 600.0),
    "test-rows-8": test_rows(8, 600.0),
}

SITUATIONS = tuple(
    Situation(
        f"borders/{name}",
        lambda random, electrons, cover=cover: bordered(random, electrons, cover),
        scenes=tuple(SCENES),
    )
    for name, cover in KINDS.items()
)
