# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Holds numbers of Sur & Grédiac 2015 (DOI 10.1137/140977035) with which others are compared.

Intercepts are sigma^2 - g mu. Cells that are not readable in the available text of the paper are left out.
"""

from typing import NamedTuple


class Camera(NamedTuple):
    """Camera of Table 1: gain [DN/e-], offset [DN], read noise [DN]."""

    gain: float
    offset: float
    read_noise: float

    @property
    def intercept(self):
        return self.read_noise**2 - self.gain * self.offset


CAMERAS = {"A": Camera(5.0, 200.0, 15.0), "B": Camera(1.0, 100.0, 8.0), "C": Camera(0.3, 40.0, 3.0)}

# Tables 2 and 3, rows "Foi et al.": mean and twice the standard deviation over 50 runs, of the gain [DN/e-] and of the
# intercept [DN^2]. The program of Foi et al. measured one image composed of all frames. Table 2 is for the synthetic
# target of the paper, Table 3 for its image Boat.
SINGLE_IMAGE = {
    "target": {
        "A1": ((5.04, 0.02), (-782.3, 7.6)),
        "A2": ((5.04, 0.01), (-781.1, 6.2)),
        "A3": ((5.04, 0.02), (-782.0, 6.9)),
        "B1": ((1.01, 0.00), (-36.6, 1.7)),
        "B2": ((1.01, 0.00), (-36.2, 1.7)),
        "B3": ((1.01, 0.00), (-36.3, 1.7)),
        "C1": ((0.302, 0.001), (-2.98, 0.26)),
        "C2": ((0.302, 0.001), (-2.97, 0.23)),
        "C3": ((0.302, 0.001), (-2.93, 0.34)),
    },
    "texture": {
        "C1": ((0.435, 0.022), (-27.1, 31.8)),
        "C2": ((0.558, 0.02), (-44.0, 31.7)),
        "C3": ((0.651, 0.016), (-72.0, 26.9)),
    },
}

# Table 5, rows "photon transfer method" of the two cameras: gain [DN/e-] and read noise [DN] by ISO speed, and the
# offset [DN] of a dark frame.
CANON_OFFSET = {"EOS 350D": 256.0, "EOS 6D": 2047.0}
CANON_BITS = {"EOS 350D": 12, "EOS 6D": 14}
CANON = {
    "EOS 350D": {
        100: (0.096, 2.21),
        200: (0.191, 2.38),
        400: (0.384, 2.88),
        800: (0.762, 4.07),
        1600: (1.531, 6.36),
    },
    "EOS 6D": {
        100: (0.176, 4.85),
        200: (0.361, 4.93),
        400: (0.705, 5.31),
        800: (1.372, 6.10),
        1600: (2.69, 7.91),
        3200: (5.12, 11.77),
        6400: (10.52, 19.03),
    },
}


class Published(NamedTuple):
    """Gains of Table 5 [DN/e-] by other rows: the program of Foi et al., the published method, the affine fit."""

    single_image: float
    published: float
    affine: float


# Table 5, gains of the red channel. "target": the colour checker, "texture": the cluttered scene.
CANON_GAINS = {
    ("EOS 350D", "target"): {
        100: Published(0.101, 0.087, 0.112),
        200: Published(0.188, 0.181, 0.209),
        400: Published(0.374, 0.358, 0.406),
        800: Published(0.749, 0.726, 1.079),
        1600: Published(1.492, 1.455, 3.741),
    },
    ("EOS 6D", "target"): {
        100: Published(0.724, 0.209, 0.269),
        200: Published(0.629, 0.360, 0.431),
        400: Published(1.042, 0.697, 0.876),
        800: Published(1.546, 1.29, 1.52),
        1600: Published(2.961, 2.57, 6.22),
        3200: Published(5.475, 5.11, 22.8),
        6400: Published(10.77, 10.49, 122.0),
    },
    ("EOS 350D", "texture"): {
        100: Published(0.114, 0.093, 0.132),
        200: Published(0.212, 0.182, 0.213),
        400: Published(0.391, 0.375, 0.730),
        800: Published(0.775, 0.720, 1.135),
        1600: Published(1.570, 1.503, 4.64),
    },
    ("EOS 6D", "texture"): {
        100: Published(0.244, 0.202, 0.197),
        200: Published(0.428, 0.334, 0.321),
        400: Published(0.775, 0.660, 0.643),
        800: Published(1.437, 1.270, 1.256),
        1600: Published(2.72, 2.51, 4.28),
        3200: Published(5.29, 4.96, 8.427),
        6400: Published(10.82, 10.31, 52.98),
    },
}

# Table 6, red channel of the EOS 350D before the cluttered scene: standard deviations of the vibration along x and y
# [pixels of the channel] and of the flicker [1], by ISO speed.
CANON_MOTION = {
    100: (0.047, 0.19, 0.0088),
    200: (0.043, 0.059, 0.012),
    400: (0.037, 0.049, 0.057),
    800: (0.042, 0.078, 0.058),
    1600: (0.066, 0.043, 0.17),
}
EOS_6D_FLICKER = 0.24  # standard deviation of the flicker of the EOS 6D at ISO 6400, section 4.1 [1]
