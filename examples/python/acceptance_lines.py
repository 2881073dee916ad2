# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Lists the bursts of measure_acceptance.py that no study simulates: one entry of LINES for each line of its table.

All bursts have the camera of CAMERA. Each line has each scene of SCENES and each converter of OFFSETS_DN. A line adds
its illumination, and the frames that it replaces (acceptance_bursts.py).
"""

import zlib
from typing import NamedTuple

MEASURED = "measured"  # the gain must be identified
MAY_REFUSE = "may refuse"  # the gain may be identified or not
MUST_REFUSE = "must refuse"  # the frames do not determine the gain: any identified gain is wrong

# Camera whose shot noise is far above its read noise. It vibrates as in condition 3 of the simulator.
CAMERA = {"gain": 0.5, "read-noise": 3, "electrons": 5000, "size": "240x200", "flicker-sd": 0.01}
SCENES = ("target", "texture", "flat")
OFFSETS_DN = {12: 100, 16: 4000}  # dark offset [DN] by the bits of the converter
FRAMES = 60
# Options of the exposure series, exposures/*: steady illumination, and no vibration, which EMVA's photon
# transfer takes for noise.
BENCH = ("--flicker-sd", "0.002", "--vibration-sd", "0,0")
LOWEST_LIT = 0.05  # illumination factor of the darkest level of a series without dark frames [1]
FIXED_PATTERN = ("--prnu", "0.007", "--dsnu", "2")  # PRNU [1] and DSNU [DN] in half of the exposure series


class Line(NamedTuple):
    """Line of the table: how its bursts are made, and what the estimator should report."""

    name: str
    illumination: str = "steady"  # value of simulate-sensor-noise --illumination
    expected: str = MEASURED
    expected_of_flat: str = MEASURED
    factors: tuple[float, ...] = ()  # illumination factor of each frame, instead of illumination
    replaced: tuple[tuple[int, str], ...] = ()  # frame, and kind in acceptance_bursts.REPLACEMENTS
    frames: int = FRAMES
    frames_per_level: int = 0  # frames per level of an exposure series; 0: other bursts
    simulator: tuple[str, ...] = ()  # further options of simulate-sensor-noise
    estimator: tuple[str, ...] = ()  # further options of estimate-sensor-noise


def one_frame(frames, place, factor, others):
    """Returns the illumination factors of a burst in which one frame has another factor than the others."""
    return tuple(factor if frame == place else others for frame in range(frames))


def unlike(name, *replaced, **further):
    """Returns a line with replaced frames. The rest of a flat field is steady and may not determine the gain."""
    return Line(f"unlike/{name}", expected_of_flat=MAY_REFUSE, replaced=replaced, **further)


def exposures(levels, frames_per_level, lowest, *options, suffix="", is_given=False):
    """Returns a line of exposure series with equally spaced levels from the lowest factor to 1.

    lowest: 0: the first level has dark frames; options: options of the simulator; is_given: the estimator gets the
    factors by --exposures."""
    steps = [round(lowest + (1 - lowest) * level / (levels - 1), 6) for level in range(levels)]
    factors = tuple(step for step in steps for _ in range(frames_per_level))
    return Line(
        f"exposures/{levels}x{frames_per_level}{'' if lowest == 0 else '-no-dark'}{suffix}",
        factors=factors,
        frames=levels * frames_per_level,
        frames_per_level=frames_per_level,
        simulator=(*BENCH, *options),
        estimator=("--exposures", ",".join(map(str, factors))) if is_given else (),
    )


LINES = (
    Line("illumination/steady", expected_of_flat=MAY_REFUSE),
    Line("illumination/every-4th-lit", "pulses:0:4"),
    Line("illumination/every-4th-brighter", "pulses:0.3:4"),
    Line("illumination/every-20th-lit", "pulses:0:20", MAY_REFUSE, MAY_REFUSE),  # 3 illuminated frames
    # One illuminated frame has leverage 1: its residual is 0, so no shot noise remains.
    Line("illumination/one-lit", "", MUST_REFUSE, MUST_REFUSE, factors=one_frame(20, 7, 1.0, others=0.0), frames=20),
    Line("illumination/ramp", "ramp:0"),
    Line("illumination/decay-to-10%", "decay:0.1"),
    Line("illumination/sunset-by-2", "decay:0.5"),
    Line("illumination/sine-from-0", "sine:0:7.3"),
    Line("illumination/sine-from-0.1", "sine:0.1:9"),
    Line("illumination/uniform", "uniform:0"),
    Line("illumination/exponential", "exponential"),
    Line("illumination/flicker-0.7", simulator=("--flicker-sd", "0.7")),
    Line("illumination/first-dark", expected_of_flat=MAY_REFUSE, factors=one_frame(FRAMES, 0, 0.0, others=1.0)),
    exposures(5, 2, 0.0),
    exposures(5, 2, 0.0, suffix="-given", is_given=True),
    exposures(5, 2, LOWEST_LIT),
    exposures(5, 10, 0.0, *FIXED_PATTERN),
    exposures(5, 10, LOWEST_LIT, *FIXED_PATTERN),
    exposures(8, 5, 0.0, *FIXED_PATTERN),
    exposures(8, 5, LOWEST_LIT),
    exposures(8, 5, 0.0, "--size", "640x512", suffix="-640x512"),
    exposures(12, 2, 0.0, *FIXED_PATTERN),
    exposures(12, 2, LOWEST_LIT, *FIXED_PATTERN),
    exposures(12, 2, LOWEST_LIT, *FIXED_PATTERN, suffix="-given", is_given=True),
    exposures(12, 10, 0.0),
    exposures(12, 10, LOWEST_LIT),
    unlike("zeros-first", (0, "zeros")),
    unlike("saturated-first", (0, "saturated")),
    unlike("dark-first", (0, "dark")),
    unlike("other-scene", (30, "other scene")),
    unlike("dip", (20, "dip"), expected=MAY_REFUSE, frames=40),
    # Without flicker only the dip changes the illumination. It looks like the flicker that determines the offset.
    unlike("dip-without-flicker", (20, "dip"), expected=MAY_REFUSE, frames=40, simulator=("--flicker-sd", "0")),
    unlike("another-gain", (7, "another gain"), (30, "another gain"), (44, "another gain")),
    unlike("four-kinds", (3, "zeros"), (17, "saturated"), (31, "other scene"), (44, "dip")),
)


def variants():
    """Returns the scenes and converters of each line, as (scene, bits)."""
    return [(scene, bits) for scene in SCENES for bits in OFFSETS_DN]


def expected_of(line, scene):
    return line.expected_of_flat if scene == "flat" else line.expected


def stream_of(name, number):
    """Returns the seed of the simulator for stack `number` of a named line or variant. Lines and variants have
    independent noise, but two programs that are compared have the same noise."""
    return zlib.crc32(name.encode()) * 10_000 + number


def simulator_options(line, scene, bits, **others):
    """Returns the options of simulate-sensor-noise that make the bursts of a line, without files and seed.

    others: options by name that replace the options of the line."""
    options = {**CAMERA, "reference": scene, "bit-depth": bits, "offset": OFFSETS_DN[bits], "frames": line.frames}
    words = {f"--{name}": str(value) for name, value in options.items()}
    words |= dict(zip(line.simulator[::2], line.simulator[1::2], strict=True))
    words |= {f"--{name.replace('_', '-')}": str(value) for name, value in others.items()}
    return [word for pair in words.items() for word in pair]
