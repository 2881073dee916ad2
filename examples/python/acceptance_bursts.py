# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Makes the bursts of acceptance_lines.LINES, replaces frames in them, and tests the reports of the estimator."""

import json
import tempfile
from pathlib import Path

import numpy as np
from acceptance_bound import gain_bound
from acceptance_emva import system_gain
from acceptance_lines import CAMERA, expected_of, simulator_options, stream_of
from acceptance_programs import ProgramError, run
from acceptance_stacks import evaluate
from frame_stacks import read_frames, write_frames

DIP_DEPTH = 0.12  # decrease of the illumination in the middle of a dip [1]
# Standard deviation of the Gaussian dip, in units of the frame width. It is so wide that the dip resembles flicker.
DIP_RADIUS = 0.6
ROUNDING_VARIANCE = 1 / 12  # variance of rounding to whole digital numbers [DN^2]
OTHER_GAIN = 1.5  # gain of a frame with another gain, over the gain of the burst [1]
# Electrons of a frame whose shot noise is below the rounding; it gives the mean of the pixels of a burst.
NOISELESS_ELECTRONS = 1e9
COMPARED_QUANTITIES = ("gain", "offset", "read_noise")


class Camera:
    """Camera, scene and noise of a burst, which make the frames that replace others."""

    def __init__(self, programs, line, scene, bits, truth, folder, seed):
        self.programs, self.line, self.scene, self.bits = programs, line, scene, bits
        self.offset, self.read_noise, self.gain = truth["offset"], truth["read_noise"], truth["gain"]
        self.folder, self.seed = folder, seed
        self.random = np.random.default_rng(seed)

    def simulate(self, scene, **others):
        """Returns one frame of the camera, with other options of the simulator."""
        name = self.folder / "other.mha"
        options = simulator_options(self.line, scene, self.bits, frames=1, **others)
        run([self.programs.simulator, "--output", name, *options, "--seed", self.seed])
        return read_frames(name)[0][0]

    def expose(self, electrons, shape, gain=None):
        """Returns a frame with these expected electrons, with the gain of the camera or a given gain [DN/e-]."""
        levels = self.offset + (gain or self.gain) * self.random.poisson(electrons, shape)
        levels = levels + self.random.normal(0.0, self.read_noise, shape)
        return np.clip(np.rint(levels), 0, self.highest)

    @property
    def highest(self):
        return 2**self.bits - 1


def other_scene(camera, _shape):
    return camera.simulate("texture" if camera.scene == "target" else "target")


def mean_electrons(camera):
    """Returns the expected electrons of the pixels, without flicker and vibration [e-]."""
    static = {"flicker_sd": 0, "vibration_sd": "0,0", "read_noise": 0, "bit_depth": 0}
    gain = CAMERA["gain"] * CAMERA["electrons"] / NOISELESS_ELECTRONS
    mean = camera.simulate(camera.scene, gain=gain, electrons=NOISELESS_ELECTRONS, **static)
    return np.maximum(0.0, mean.astype(float) - camera.offset) / camera.gain


def dip(camera, shape):
    """Returns a frame with a smooth dip of the illumination, like an object out of focus before its source."""
    y, x = np.indices(shape)
    squared = (x - shape[1] / 2) ** 2 + (y - shape[0] / 2) ** 2
    illumination = 1 - DIP_DEPTH * np.exp(-squared / (2 * (DIP_RADIUS * shape[1]) ** 2))
    return camera.expose(mean_electrons(camera) * illumination, shape)


def another_gain(camera, shape):
    """Returns a frame with another gain, as from a camera with automatic gain."""
    return camera.expose(mean_electrons(camera), shape, gain=OTHER_GAIN * camera.gain)


REPLACEMENTS = {
    "zeros": lambda _camera, shape: np.zeros(shape),
    "saturated": lambda camera, shape: np.full(shape, camera.highest),
    "dark": lambda camera, shape: camera.expose(0.0, shape),
    "other scene": other_scene,
    "dip": dip,
    "another gain": another_gain,
}


def simulate(programs, line, scene, bits, seed, folder):
    """Makes a burst. Returns its file, its truth, the bound of its gain [DN/e-], and the gain of an exposure series by
    EMVA 1288 [DN/e-]. The latter is None for other bursts."""
    name, truth_name, factors_name = (folder / file for file in ("burst.mha", "truth.json", "factors.txt"))
    illumination = line.illumination
    if line.factors:
        factors_name.write_text("\n".join(map(str, line.factors)) + "\n")
        illumination = factors_name
    options = [*simulator_options(line, scene, bits), "--illumination", illumination, "--seed", seed]
    run([programs.simulator, "--output", name, "--truth", truth_name, *options])
    truth = json.loads(truth_name.read_text())
    frames, header = read_frames(name)
    variance = truth["read_noise"] ** 2 + ROUNDING_VARIANCE
    bound = gain_bound(
        np.maximum(0.0, frames.mean(axis=0) - truth["offset"]),
        truth["gain"],
        variance,
        1 + np.array(truth["flicker"]),
        2**bits - 1 - truth["offset"],
    )
    emva = None
    if line.frames_per_level:
        emva = system_gain(frames, line.frames_per_level, line.factors[0] == 0, 2**bits - 1)
    if line.replaced:
        camera = Camera(programs, line, scene, bits, truth, folder, seed)
        for place, kind in line.replaced:
            frames[place] = REPLACEMENTS[kind](camera, frames.shape[1:])
        write_frames(name, frames, header)
    return name, truth, bound, emva


def truth_of(record):
    """Returns the true values of the compared quantities."""
    return {"gain": record["gain"], "offset": record["offset"], "read_noise": record["realised_read_noise"]}


def estimate(programs, name, stack, options):
    """Runs the estimator on a stack. Returns its report, and how the program ended.

    name: name of the line, for errors."""
    done = run([programs.estimator, stack, "--json", "-", "--quiet", "--threads", 1, *options], allowed=None)
    try:
        return json.loads(done.output), done
    except json.JSONDecodeError:
        # There is no report: nothing could be estimated, or a signal ended the program.
        if done.code not in (2, 3):
            raise ProgramError(f"{name}: {programs.estimator} ended with exit code {done.code}") from None
        return {"warnings": []}, done


def measure(programs, line, scene, bits, number):
    """Makes a burst, estimates its noise, and tests the report."""
    seed = stream_of(f"{line.name} {scene} {bits}", number)
    with tempfile.TemporaryDirectory(prefix="acceptance-") as folder:
        name, record, bound, emva = simulate(programs, line, scene, bits, seed, Path(folder))
        report, done = estimate(programs, line.name, name, line.estimator)
    expected = expected_of(line, scene)
    truth = truth_of(record)
    found = {quantity: report.get(quantity, {}) for quantity in COMPARED_QUANTITIES}
    loud = [warning["code"] for warning in report["warnings"] if warning["severity"] != "note"]
    stack = evaluate(found, truth, record["gain"] * record["electrons"], loud, expected)
    relative = None if bound is None or bound > truth["gain"] else bound / truth["gain"]
    emva_error = None if emva is None else emva / truth["gain"] - 1
    further = {"exit": done.code, "seconds": done.seconds, "bound": relative, "emva_error": emva_error}
    return [stack | {"setting": "", **further}]
