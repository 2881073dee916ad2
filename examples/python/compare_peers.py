# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Runs programs of other authors on the frames of compare_methods.py, each in an environment of its own.

An environment is made by venv and pip in a folder that stays, so that a second run needs no network. A program that
cannot be installed has a row that says why. The processor time of a program is the time for reading the frames and for
the estimate, without the start of Python.
"""

import json
import subprocess
import sys
import venv
from functools import cache
from pathlib import Path
from typing import NamedTuple

from compare_rows import BURST, FLATS, FRAME, QUANTITIES, Estimate, Row

INSTALL_SECONDS = 300  # longest installation of a program [s]
RUN_SECONDS = 120  # longest estimate of a program [s]

# Every script begins and ends with these lines. `job` has the files and the numbers of a setting.
BEGIN = """
import json, sys, time
import numpy as np

job = json.loads(sys.argv[1])
def load(name, frames=None):
    return np.load(job[name], mmap_mode="r")[:frames].copy()
"""
END = """
found["seconds"] = time.process_time() - start
print(json.dumps({name: value if isinstance(value, str) else float(value) for name, value in found.items()}))
"""

ANSCOMBE_TRANSFORM = """
from anscombe_transform import estimate
start = time.process_time()
line = estimate.compute_conversion_gain(load("burst"))
found = {"gain": line["conversion_gain"], "intercept": -line["conversion_gain"] * line["zero_level"]}
"""

NDSAFIR = """
import ndsafir
FRAMES = 5  # it takes 1 s for a million samples
start = time.process_time()
frames = load("burst", FRAMES)
gains, offsets = ndsafir.calibrate_poisson_gaussian(frames, axes="TYX")
found = {"gain": gains[0], "intercept": offsets[0], "remark": f"first {len(frames)} frames"}
"""

EMVA1288 = """
import logging, tempfile
from pathlib import Path
from emva1288.process.data import Data1288
from emva1288.process.loader import LoadImageData
from emva1288.process.results import Results1288
logging.disable(logging.CRITICAL)
start = time.process_time()
with tempfile.TemporaryDirectory() as folder:
    levels = {}
    for index, (frame, exposure) in enumerate(zip(load("flats"), job["exposures"])):
        file = Path(folder, f"{index}.npy")
        np.save(file, frame)
        levels.setdefault(float(exposure), []).append(str(file))
    ends = {exposure: levels[exposure] for exposure in (0.0, sorted(levels)[len(levels) // 2])}
    data = LoadImageData({"temporal": {1.0: levels}, "spatial": {1.0: ends}}, fload=np.load).data
results = Results1288(Data1288(data).data)
dark = Data1288(data).data["temporal"]["u_ydark"][0]
found = {"gain": results.K, "offset": dark, "read_noise": results.sigma_d * results.K}
found["intercept"] = found["read_noise"] ** 2 - found["gain"] * dark
"""

RPI_CTT = """
from types import SimpleNamespace
from ctt.algorithms.noise import noise
SIDE = 64  # of a patch [pixels]
start = time.process_time()
flats = load("flats")[2:].astype(float)  # behind the two dark frames
black = load("flats", 2).mean()
flats = [flat for flat in flats if flat.max() < 2 ** job["bits"] - 1]
patches = [flat[:SIDE, :SIDE].ravel() for flat in flats[::2]]
chart = SimpleNamespace(name="flats", patches=[patches], patches_single=None, blacklevel_16=black, againQ8_norm=1)
slope, constant = noise(SimpleNamespace(log=""), chart)
found = {"gain": slope**2, "remark": "standard deviation = constant + slope sqrt(signal); the gain is slope squared"}
"""

SCIKIT_IMAGE = """
from skimage.restoration import estimate_sigma
start = time.process_time()
found = {"remark": f"one standard deviation for all levels: {estimate_sigma(load('burst', 1)[0].astype(float)):.3g} DN"}
"""


class Peer(NamedTuple):
    """Program of other authors: what pip installs, what it needs, its script, and whether it measures flats."""

    name: str
    packages: tuple
    needs: str
    script: str
    is_of_flats: bool = False


PEERS = (
    Peer("anscombe-transform", ("anscombe-transform==1.0.0",), BURST, ANSCOMBE_TRANSFORM),
    Peer("ndsafir", ("ndsafir==2026.1014a0",), BURST, NDSAFIR),
    Peer("emva1288", ("emva1288==1.0.2", "numpy<2"), FLATS, EMVA1288, True),  # it uses names that NumPy 2 dropped
    Peer("rpi-ctt", ("rpi-ctt==1.4.0",), "patches of a chart, black level", RPI_CTT, True),
    Peer("scikit-image", ("scikit-image==0.26.0", "PyWavelets"), FRAME, SCIKIT_IMAGE),
)


def last_line(text):
    return (text.strip().splitlines() or ["no message"])[-1]


def install(peer, folder):
    """Makes the environment of a program. Returns its Python, and None or the reason why there is none."""
    environment = Path(folder, peer.name)
    python, mark = environment / "bin" / "python", environment / "installed.txt"
    wanted = "\n".join(peer.packages)
    if mark.exists() and mark.read_text() == wanted:
        return python, None
    print(f"installing {peer.name} into {environment}", file=sys.stderr, flush=True)
    try:
        if not python.exists():
            venv.create(environment, with_pip=True)
        command = [python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", *peer.packages]
        done = subprocess.run(command, capture_output=True, text=True, timeout=INSTALL_SECONDS, check=False)
    except (OSError, subprocess.SubprocessError) as error:
        return None, f"not installed: {error}"
    if done.returncode != 0:
        return None, f"not installed: {last_line(done.stderr)}"
    mark.write_text(wanted)
    return python, None


def install_all(folder):
    """Returns the Python of each program and the reason without one, by the name of the program."""
    return {peer.name: install(peer, folder) for peer in PEERS}


@cache
def peer_row(peer, python, job):
    """Returns the row of a program that is installed. job: the files and numbers of a setting, as JSON."""
    try:
        done = subprocess.run(
            [python, "-c", BEGIN + peer.script + END, job],
            capture_output=True,
            text=True,
            timeout=RUN_SECONDS,
            check=False,
        )
    except subprocess.TimeoutExpired:
        return Row(peer.name, peer.needs, {}, None, f"stopped after {RUN_SECONDS} s")
    if done.returncode != 0:
        return Row(peer.name, peer.needs, {}, None, f"failed: {last_line(done.stderr)}")
    answer = json.loads(last_line(done.stdout))
    found = {name: Estimate(answer[name], None) for name in QUANTITIES if name in answer}
    return Row(peer.name, peer.needs, found, answer["seconds"], answer.get("remark", ""))


def rows_by_peers(installed, setting, frames):
    """Returns the rows of all programs. installed: as install_all() returns it, or None: they are not run."""
    of_burst = json.dumps({"burst": str(frames.burst)})
    of_flats = json.dumps({"flats": str(frames.flats), "exposures": frames.exposures, "bits": setting.bits})
    rows = []
    for peer in PEERS:
        python, reason = installed[peer.name] if installed else (None, "not run: --peers names no folder")
        if peer.is_of_flats and not frames.flats:
            reason = "there are no flats"
        job = of_flats if peer.is_of_flats else of_burst
        rows.append(Row(peer.name, peer.needs, {}, None, reason) if reason else peer_row(peer, python, job))
    return rows
