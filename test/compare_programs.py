# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Compares all that two builds of the tools write, bit by bit: a change of the structure changes no result.

    compare_programs.py --old OLD/bin --new NEW/bin [--only TEXT] [--jobs N] [--damaged N]

A case is one call of estimate-sensor-noise. Compared are its exit code, standard output and standard error, and the
SHA-256 of the report, the page and the maps. The old simulator makes the stacks:

    stacks       scenes, cameras and flaws of simulate-sensor-noise, by both methods and with the options of OPTIONS
    types        the same values as unsigned char, unsigned short, short, float and double
    mosaics      with a given pattern, and without one
    darks        with dark frames, of the same and of another camera
    files        every format of fuzz/frame_files.py, whole, with the damages of fuzz/known.py, and damaged by
                 fuzz/mutations.py (--damaged, default 200)

Results with 3 threads, and results with a memory limit, are also compared with the results of the same program without
them. Prints each case that differs, and how. Exit code 0: all are equal; 1: some differ.
"""

import argparse
import hashlib
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path
from random import Random

sys.path.insert(0, str(Path(__file__).parent / "fuzz"))
sys.path.insert(0, str(Path(__file__).parents[1] / "examples" / "python"))
from frame_files import all_cases
from frame_stacks import read_frames, write_stack
from fuzz_files import damage, undamaged_frames, write
from known import known_cases

SECONDS = 120  # after which a call is ended
SIZE = "120x100"
# By name: options of simulate-sensor-noise. The stacks are small, as every option below is tried with each of them.
STACKS = {
    "plain": "--reference target --frames 40",
    "texture": "--reference texture --frames 60 --vibration-sd 0.3,0.2 --flicker-sd 0.02",
    "ten-frames": "--reference texture --frames 10",
    "flat": "--reference flat --frames 40 --flicker-sd 0.02",
    "pulses": "--reference target --frames 40 --illumination pulses:0:4 --vibration-sd 0,0",
    "decay": "--reference texture --frames 40 --illumination decay:0.1",
    "rolling-shutter": "--reference texture --frames 60 --rolling-shutter 40 --flicker-sd 0.03",
    "smoothed": "--reference texture --frames 40 --smoothing 0.7",
    "temporal": "--reference texture --frames 50 --temporal-filter 0.4",
    "scmos": "--reference texture --frames 40 --electrons 300 --read-noise-spread 0.4 --read-noise-tail 0.1,1",
    "patterns": "--reference target --frames 40 --prnu 0.01 --dsnu 4 --column-offset-pattern 2 --row-noise 3",
    "bent": "--reference target --frames 40 --response quadratic,0.04",
    "companded": "--reference texture --frames 40 --companding 8",
    "clipped": "--reference target --frames 40 --clip 0,2000 --electrons 6000",
    "repeated": "--reference texture --frames 20 --repeat 2",
    "defects": "--reference texture --frames 40 --hot-pixels 0.01,10 --defect-correction 3",
}
# By name: options of estimate-sensor-noise.
OPTIONS = {
    "refined": "",
    "published": "--method published",
    "threads": "--threads 3",
    "limit": "--memory-limit 19M",
    "offset": "--offset 100,1",
    "region": "--roi 8,8,90,80",
    "some-frames": "--frames 0,9",
    "levels": "--level-range 200,2000",
    "no-local-light": "--rolling-shutter off",
}
SAME = {"threads": "refined", "limit": "refined"}  # results that are equal within one program
TYPES = ("uint8", "int16", "float32", "float64")  # beside uint16


@dataclass(frozen=True)
class Call:
    """One call: its name, the files of frames in `folder`, and options."""

    name: str
    folder: str
    frames: tuple[str, ...]
    options: tuple[str, ...] = field(default=())


def run(command: list[str], folder: str) -> subprocess.CompletedProcess[bytes]:
    return subprocess.run(command, cwd=folder, capture_output=True, timeout=SECONDS, check=False)


def simulate(tools: str, name: str, options: str) -> None:
    command = [os.path.join(tools, "simulate-sensor-noise"), "--size", SIZE, "--output", name]
    done = run([*command, *options.split()], os.path.dirname(name))
    if done.returncode != 0:
        raise RuntimeError(f"{name}: {done.stderr.decode()}")


def stack_calls(tools: str, folder: str) -> Iterator[Call]:
    for name, options in STACKS.items():
        simulate(tools, f"{folder}/{name}.mha", options)
        for option, words in OPTIONS.items():
            yield Call(f"stacks/{name}/{option}", folder, (f"{name}.mha",), tuple(words.split()))
    values = read_frames(f"{folder}/texture.mha")[0]
    for name in TYPES:
        write_stack(f"{folder}/{name}.mha", (values // 16 if name == "uint8" else values).astype(name))
        for method in ("refined", "published"):
            yield Call(f"types/{name}/{method}", folder, (f"{name}.mha",), ("--method", method))
    simulate(tools, f"{folder}/mosaic.mha", "--reference texture --frames 30 --bayer GRBG --transmission 0.6,1,0.5")
    for option, words in {"given": "--bayer GRBG", "found": "--bayer auto", "none": ""}.items():
        yield Call(f"mosaics/{option}", folder, ("mosaic.mha",), tuple(words.split()))
    simulate(tools, f"{folder}/dark.mha", "--dark --frames 30 --seed 3")
    simulate(tools, f"{folder}/other-dark.mha", "--dark --frames 30 --read-noise 30 --seed 4")
    for dark in ("dark", "other-dark"):
        for name in ("plain", "flat", "decay"):
            yield Call(f"darks/{name}/{dark}", folder, (f"{name}.mha",), ("--dark", f"{dark}.mha"))


def file_calls(tools: str, folder: str, damaged: int) -> Iterator[Call]:
    frames = undamaged_frames(tools)
    whole = all_cases(frames)
    cases = [(case.name, case) for case in whole] + known_cases(frames)
    for number, (name, case) in enumerate(cases):
        place = f"{folder}/files{number}"
        write(case, place)
        yield Call(f"files/{name}", place, tuple(case.frames), ("--raw", case.raw) if case.raw else ())
    for number in range(damaged):
        random = Random(number)
        case = random.choice(whole)
        place = f"{folder}/damaged{number}"
        write(case, place)
        how, _ = damage(case, place, random)
        yield Call(
            f"damaged/{number}: {case.name}, {how}",
            place,
            tuple(case.frames),
            ("--raw", case.raw) if case.raw else (),
        )


def outputs_of(tools: str, call: Call) -> dict[str, str]:
    """Outputs of a call by name: text, or the SHA-256 of a file."""
    with tempfile.TemporaryDirectory() as out:
        command = [os.path.join(tools, "estimate-sensor-noise"), *call.frames, "--json", f"{out}/report.json"]
        command += ["--plot", f"{out}/page.html", "--maps", f"{out}/maps", *call.options]
        try:
            done = run(command, call.folder)
        except subprocess.TimeoutExpired:
            return {"exit code": f"none after {SECONDS} s"}
        text = {"exit code": str(done.returncode)}
        for name, stream in (("standard output", done.stdout), ("standard error", done.stderr)):
            text[name] = stream.decode("utf-8", "replace").replace(out, "OUT")
        for path in sorted(Path(out).rglob("*")):
            if path.is_file():
                text[str(path.relative_to(out))] = hashlib.sha256(path.read_bytes()).hexdigest()
        return text


def differences(first: dict[str, str], second: dict[str, str]) -> list[str]:
    return sorted(name for name in first.keys() | second.keys() if first.get(name) != second.get(name))


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--old", required=True, type=Path, help="folder of the tools before the change")
    parser.add_argument("--new", required=True, type=Path, help="folder of the tools after it")
    parser.add_argument("--only", default="", help="cases whose name has this text")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--damaged", type=int, default=200, help="files that are damaged at random")
    options = parser.parse_args()
    old, new = str(options.old.resolve()), str(options.new.resolve())
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(options.jobs) as pool:
        calls = [*stack_calls(old, folder), *file_calls(old, folder, options.damaged)]
        calls = [call for call in calls if options.only in call.name]
        before = dict(zip(calls, pool.map(lambda call: outputs_of(old, call), calls), strict=True))
        after = dict(zip(calls, pool.map(lambda call: outputs_of(new, call), calls), strict=True))
        found = {call.name: differences(before[call], after[call]) for call in calls}
        by_name = {call.name: after[call] for call in calls}
        for call in calls:
            kind, _, option = call.name.rpartition("/")
            other = by_name.get(f"{kind}/{SAME.get(option)}")
            if other is not None:
                apart = [name for name in differences(after[call], other) if name.startswith("maps/")]
                found[f"{call.name} as {SAME[option]}"] = apart
    for name, parts in found.items():
        if parts:
            print(f"{name}: {', '.join(parts)}")
    unequal = sum(bool(parts) for parts in found.values())
    print(f"{len(found)} cases, {unequal} differ")
    return int(unequal > 0)


if __name__ == "__main__":
    sys.exit(main())
