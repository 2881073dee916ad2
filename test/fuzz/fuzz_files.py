# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Damages files in every way that mutations.py knows, and requires that the tools do not crash, hang or accept them.

    fuzz_files.py --bin FOLDER              the tools estimate-sensor-noise and simulate-sensor-noise
    fuzz_files.py --python INTERPRETER      itk.estimate_sensor_noise() instead, in a process of its own

A damaged file may lead to one of these:

- exit code 2 (wrong input) with one line on standard error;
- exit code 3 (nothing to estimate) with a line for each reason;
- the result of the undamaged file;
- another result, if the changed bytes are pixels that no checksum protects;
- another result, if the changed header still agrees with the size of the file.

Anything else is a finding. It is printed with the number that repeats it: `--first N --count 1 --seed S --keep FOLDER`
leaves its files in FOLDER. Exit code 1 if there are findings.
"""

import argparse
import collections
import concurrent.futures
import itertools
import os
import subprocess
import sys
import tempfile
import time
from random import Random

from frame_files import all_cases
from frame_parts import HEIGHT, WIDTH, Case
from known import known_cases, misplaced
from mutations import misplace, mutate
from targets import Answer, PythonTarget, ToolTarget

FRAMES = 8
ROLES = ["frames"] * 12 + ["mask", "dark", "reference"]
# Messages that must not be the only ones, or that show internals.
NO_SENTENCES = [
    "bad_alloc",
    "max_size",
    "filesystem error",
    "basic_string",
    "itk::ERROR",
    "SWIG",
    "Traceback",
    ".cxx",
    ".hxx",
]


def undamaged_frames(tools: str) -> list[bytes]:
    with tempfile.TemporaryDirectory() as folder:
        stack = os.path.join(folder, "s.mha")
        command = [
            os.path.join(tools, "simulate-sensor-noise"),
            "--size",
            f"{WIDTH}x{HEIGHT}",
            "--reference",
            "texture",
        ]
        command += ["--frames", str(FRAMES), "--output", stack]
        subprocess.run(command, check=True, capture_output=True)
        with open(stack, "rb") as file:
            pixels = file.read().split(b"LOCAL\n", 1)[1]
    size = 2 * WIDTH * HEIGHT
    return [pixels[k : k + size] for k in range(0, len(pixels), size)]


def write(case: Case, folder: str) -> None:
    os.makedirs(folder)
    for file in case.files:
        with open(os.path.join(folder, file.name), "wb") as out:
            out.write(file.data)


def damage(case: Case, folder: str, random: Random) -> tuple[str, str]:
    """Damages a file of the case. Returns the damage, and the kind of the bytes that changed: "header", "raw",
    "checked" or "size"."""
    file = random.choice(case.files)
    path = os.path.join(folder, file.name)
    if random.random() < 0.04:
        return misplace(path, random), "size"
    how, data = mutate(file.data, random)
    with open(path, "wb") as out:
        out.write(data)
    if len(data) != len(file.data):
        return how, "size"
    changed = {k for k in range(len(data)) if data[k] != file.data[k]}
    kinds = set()
    for kind, ranges in (("raw", file.raw), ("checked", file.checked)):
        inside = {k for k in changed if any(first <= k < last for first, last in ranges)}
        changed -= inside
        kinds |= {kind} if inside else set()
    if changed:
        return how, "header"
    return how, "checked" if kinds == {"checked"} else "raw" if kinds else "nothing"


def verdict_of(answer: Answer, expected: str, touched: str) -> str:
    """Returns the class of an answer. Classes in capitals are findings."""
    if answer.hung:
        return "HANG"
    if answer.crashed:
        return "CRASH"
    if answer.code == 0 and answer.text == expected:
        return "as undamaged"
    if answer.code in (2, 3):
        lines = [line for line in answer.error.splitlines() if not line.startswith(("warning: ", "note: "))]
        too_many = answer.code == 2 and len(lines) > 1
        if not lines or too_many or any(word in line for line in lines for word in NO_SENTENCES):
            return "NO SENTENCE"
        if answer.code == 2:
            return "refused"
    if touched in ("checked", "nothing"):
        return "BELIEVED"
    if touched == "raw" and answer.samples != FRAMES * WIDTH * HEIGHT:
        return "FEWER SAMPLES"
    return "other result" if touched != "size" or answer.samples == FRAMES * WIDTH * HEIGHT else "other size"


class Fuzzer:
    def __init__(self, target: ToolTarget | PythonTarget, cases: list[Case], seed: int) -> None:
        self.target = target
        self.cases = cases
        self.seed = seed
        self.expected: dict[tuple[str, str], str] = {}

    def prepare(self, folder: str, pool: concurrent.futures.Executor) -> None:
        """Stores the answers to the undamaged files. A format that is refused whole has an empty answer."""
        for case in self.cases:
            write(case, os.path.join(folder, case.name))

        def expect(asked: tuple[Case, str]) -> None:
            case, role = asked
            answer = self.target.ask(os.path.join(folder, case.name), case, role, os.path.join(folder, "mha"))
            self.expected[case.name, role] = answer.text if answer.code == 0 else ""

        list(pool.map(expect, itertools.product(self.cases, sorted(set(ROLES)))))

    def run(self, number: int, folder: str, good: str) -> tuple[str, str, str, str]:
        """Returns class, format, description and error text of input `number`."""
        random = Random(f"{self.seed}:{number}")
        case = random.choice(self.cases)
        role = random.choice(ROLES)
        place = os.path.join(folder, str(number))
        write(case, place)
        how, touched = damage(case, place, random)
        answer = self.target.ask(place, case, role, good)
        found = verdict_of(answer, self.expected[case.name, role], touched)
        return found, case.name, f"{case.name}, {how}, {touched} changed, as {role}", answer.error.strip()[-300:]


def ask_known(
    target: ToolTarget | PythonTarget, frames: list[bytes], folder: str, pool: concurrent.futures.Executor
) -> list[str]:
    """Returns the damaged files of known.py that are not refused, in any role."""
    good = os.path.join(folder, "mha")
    files = []
    for number, (what, case) in enumerate(known_cases(frames)):
        place = os.path.join(folder, f"known {number}")
        write(case, place)
        files.append((what, case, place))
    for what, path in misplaced(os.path.join(folder, "misplaced")):
        files.append((what, Case(what, [], [os.path.basename(path)]), os.path.dirname(path)))

    def ask(asked: tuple[tuple[str, Case, str], str]) -> str | None:
        (what, case, place), role = asked
        answer = target.ask(place, case, role, good)
        found = verdict_of(answer, "", "checked")
        return None if found == "refused" else f"{found}: {what}, as {role}: {answer.error.strip()[-300:]}"

    return [line for line in pool.map(ask, itertools.product(files, sorted(set(ROLES)))) if line]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", required=True, help="folder of the tools, which make the undamaged frames, too")
    parser.add_argument("--python", help="interpreter with the wheel installed")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--seconds", type=float, default=1e9, help="stop after so long")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--formats", default="", help="only those whose name begins so")
    parser.add_argument("--keep", help="folder for the files of findings")
    parser.add_argument("--verbose", action="store_true", help="print every input")
    options = parser.parse_args()

    table: collections.Counter[tuple[str, str]] = collections.Counter()
    findings = 0
    start = time.monotonic()
    target = PythonTarget(options.python, options.jobs) if options.python else ToolTarget(options.bin)
    frames = undamaged_frames(options.bin)
    cases = [case for case in all_cases(frames) if case.name.startswith(tuple(options.formats.split(",")))]
    fuzzer = Fuzzer(target, cases, options.seed)
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        good = os.path.join(folder, "good")
        fuzzer.prepare(good, pool)
        failed = ask_known(target, frames, good, pool)
        for line in failed:
            print(line, flush=True)
        findings += len(failed)

        def one(number: int) -> tuple[int, tuple[str, str, str, str]] | None:
            if time.monotonic() - start > options.seconds:
                return None
            return number, fuzzer.run(number, options.keep or folder, os.path.join(good, "mha"))

        for done in pool.map(one, range(options.first, options.first + options.count)):
            if done is None:
                continue
            number, (found, name, what, error) = done
            table[name, found] += 1
            findings += found.isupper()
            if found.isupper() or options.verbose:
                print(f"{found}: number {number}: {what}: {error}", flush=True)
            if not options.keep:
                subprocess.run(["rm", "-rf", os.path.join(folder, str(number))], check=False)
    classes = sorted({found for _, found in table})
    print(f"{'format':<20}" + "".join(f"{found:>15}" for found in classes))
    for case in [*fuzzer.cases, Case("all", [], [])]:
        counts = [
            sum(n for (name, f), n in table.items() if f == found and case.name in (name, "all")) for found in classes
        ]
        print(f"{case.name:<20}" + "".join(f"{count:>15}" for count in counts))
    print(f"inputs: {sum(table.values())}, findings: {findings}, seed {options.seed}, {time.monotonic() - start:.0f} s")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
