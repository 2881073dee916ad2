# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Defines the settings of compare_methods.py, and simulates their frames.

Three groups: the simulations of Tables 2 and 3 of Sur & Grédiac 2015; mosaics like the mosaics of the cameras in Table
5, whose gains, offsets and read noises are the truth here; and real frames.
"""

import json
from pathlib import Path
from typing import NamedTuple

from acceptance_programs import run
from compare_frames import read_metaimage, read_npy, write_npy
from paper_tables import CAMERAS, CANON, CANON_BITS, CANON_MOTION, CANON_OFFSET, EOS_6D_FLICKER, SINGLE_IMAGE, Camera

PAPER_SIZE = 512  # [pixels]
PAPER_BITS = 12
MOSAIC_SIZE = (512, 384)  # width and height [pixels]
FRAMES = 100  # number of frames of each burst, as in the paper
# Brightest pixel behind a clear filter, in fractions of the range of the converter above the offset: the frames do not
# clip under the strongest flicker of the settings.
MOSAIC_EXPOSURE = 0.6
# Period of illumination that flickers at 100 Hz, in frame heights. The curtain of the focal-plane shutter travels over
# the frame in 4 ms (flash synchronization at 1/180 to 1/200 s).
SHUTTER_PERIOD = 2.5
# Blur of lens and low-pass filter, 0.5 pixels of a channel as in the simulations of the paper [pixels of the mosaic].
MOSAIC_BLUR = 1.0
# From these ISO speeds on the paper corrects the flicker row by row.
ROLLING_FROM = 800
CANON_SPEEDS = {"EOS 350D": (100, 200, 400, 800, 1600), "EOS 6D": (100, 400, 1600, 3200, 6400)}
# Flicker of the EOS 6D: the paper gives the last one, and below 0.01 at 1/10 s and 0.15 at 1/200 s; the others are
# the flicker of the EOS 350D at similar exposure times [1].
EOS_6D_FLICKERS = {100: 0.0088, 400: 0.0088, 1600: 0.058, 3200: 0.15, 6400: EOS_6D_FLICKER}
EOS_6D_VIBRATION = (0.04, 0.06)  # about the vibration of the EOS 350D, along x and y [pixels of the channel]
FLAT_LEVELS = 11  # exposures of the flats, from a tenth of the converter's range to a tenth above it
FLAT_SIZE = 256  # [pixels]


class Setting(NamedTuple):
    """Kind of frames to measure.

    truth: a Camera, or None where it is not known; simulated: options of simulate-sensor-noise, None for real frames;
    flats: options of the flats; bits: of the converter; source: file of real frames; note: what is known of the
    frames."""

    group: str
    name: str
    truth: Camera | None
    bits: int = PAPER_BITS
    simulated: dict | None = None
    flats: dict | None = None
    source: Path | None = None
    note: str = ""

    @property
    def scene(self):
        return self.simulated["reference"] if self.simulated else None

    @property
    def is_mosaic(self):
        return bool(self.simulated) and "bayer" in self.simulated


class Frames(NamedTuple):
    """Files of a setting.

    burst: frames of one channel; mosaic: all frames of a mosaic, or None; flats: exposure series of pairs of flats, or
    None; exposures: exposure of each of its frames; truth: record of the simulator, or None."""

    burst: Path
    mosaic: Path | None
    flats: Path | None
    exposures: tuple
    truth: dict | None


def flat_options(camera, bits):
    """Returns the options of flats of a camera under steady illumination."""
    return camera_options(camera, bits) | {
        "reference": "flat",
        "electrons": (2**bits - 1 - camera.offset) / camera.gain,
        "flicker-sd": 0,
        "vibration-sd": "0,0",
    }


def camera_options(camera, bits):
    return {"gain": camera.gain, "offset": camera.offset, "read-noise": camera.read_noise, "bit-depth": bits}


def paper_settings(size, frames):
    """Returns the settings of Tables 2 and 3."""
    for scene in SINGLE_IMAGE:
        for experiment in SINGLE_IMAGE["target"]:
            simulated = {"camera": experiment[0], "condition": experiment[1], "reference": scene}
            yield Setting(
                "paper",
                f"{experiment}/{scene}",
                CAMERAS[experiment[0]],
                simulated=simulated
                | {"size": f"{size or PAPER_SIZE}x{size or PAPER_SIZE}", "frames": frames or FRAMES},
                flats=flat_options(CAMERAS[experiment[0]], PAPER_BITS),
            )


def motion_of(body, speed):
    """Returns the vibration along x and y [pixels of the channel] and the flicker [1]."""
    return CANON_MOTION[speed] if body == "EOS 350D" else (*EOS_6D_VIBRATION, EOS_6D_FLICKERS[speed])


def mosaic_settings(size, frames):
    """Returns the settings that are like Table 5."""
    width, height = (size, size) if size else MOSAIC_SIZE
    for scene in ("target", "texture"):
        for body, speeds in CANON_SPEEDS.items():
            bits, offset = CANON_BITS[body], CANON_OFFSET[body]
            for speed in speeds:
                gain, read_noise = CANON[body][speed]
                camera = Camera(gain, offset, read_noise)
                x, y, flicker = motion_of(body, speed)
                simulated = camera_options(camera, bits) | {
                    "reference": scene,
                    "electrons": MOSAIC_EXPOSURE * (2**bits - 1 - offset) / gain,
                    "bayer": "RGGB",
                    "optical-blur": MOSAIC_BLUR,
                    "size": f"{width}x{height}",
                    "frames": frames or FRAMES,
                    "flicker-sd": flicker,
                    "vibration-sd": f"{2 * x},{2 * y}",  # a pixel of a channel is 2 pixels of the mosaic
                }
                if speed >= ROLLING_FROM:
                    simulated["rolling-shutter"] = SHUTTER_PERIOD * height
                flats = flat_options(camera, bits)
                yield Setting("mosaic", f"{body}/{scene}/ISO {speed}", camera, bits, simulated, flats)


def real_settings(folder):
    """Returns the settings of real frames in a folder."""
    yield Setting(
        "real",
        "EMCCD",
        Camera(0.2591, 587.74, 15.53),
        bits=16,
        source=folder / "emccd_50x30x180.npy",
        note="Electron-multiplying camera at gain 1, six flat levels under steady illumination. The truth is what its "
        "owners published: the gain, and offset and read noise of dark frames.",
    )
    yield Setting(
        "real",
        "SA-Z",
        None,
        bits=8,
        source=folder / "saz_75x40x640_u8.npy",
        note="High-speed camera, upper 8 of 12 bits, flickering illumination, vibrating edges. The true gain is not "
        "known.",
    )


def simulate(tools, options, output):
    """Simulates frames. Returns their stack and the record of their truth."""
    truth = output.with_suffix(".json")
    arguments = [text for name, value in options.items() for text in (f"--{name}", value)]
    run([tools / "simulate-sensor-noise", *arguments, "--output", output, "--truth", truth])
    stack = read_metaimage(output)
    output.unlink()
    return stack, json.loads(truth.read_text())


def make_flats(setting, tools, folder):
    """Simulates pairs of dark frames and of flats at exposures from 0 on, once for each camera. Returns the file and
    the exposures."""
    exposures = tuple(level for level in range(FLAT_LEVELS + 1) for _ in range(2))
    file = folder / f"flats-{setting.truth.gain}-{setting.bits}.npy"
    if not file.exists():
        factors = folder / "factors.txt"
        factors.write_text("".join(f"{exposure / (FLAT_LEVELS - 1)}\n" for exposure in exposures))
        shape = {"size": f"{FLAT_SIZE}x{FLAT_SIZE}", "frames": len(exposures), "illumination": factors}
        write_npy(file, simulate(tools, setting.flats | shape, folder / "flats.mha")[0])
    return file, exposures


def make_frames(setting, tools, folder, shared):
    """Simulates the frames of a setting, or reads them. Returns their files in a folder. The files of flats are in the
    folder `shared` of all settings."""
    if setting.source:
        return Frames(write_npy(folder / "burst.npy", read_npy(setting.source)), None, None, (), None)
    stack, truth = simulate(tools, setting.simulated, folder / "burst.mha")
    mosaic = None
    if setting.is_mosaic:
        mosaic = write_npy(folder / "mosaic.npy", stack)
        stack = stack.plane(0, 0)
    burst = write_npy(folder / "burst.npy", stack)
    return Frames(burst, mosaic, *make_flats(setting, tools, shared), truth)
