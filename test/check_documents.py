#!/usr/bin/env python3
# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Runs the commands that README.md shows and compares their output with the printed one, line for line.

    check_readme_outputs.py --bin build/bin [--readme README.md] [--write]

The commands run in an empty folder, in the order of the README. These blocks have commands:

- `console`: each line that begins with `$ ` is a command, continued after a backslash; the lines below it are its
  standard output, then its standard error. A lone `…` stands for any number of lines, `…` within a line for any text.
- `sh`: every line that calls a program of build/bin is a command, whose output is not shown.
- A comment `<!-- $ command -->` is a command that readers do not see. The block without a language below it has lines
  of the last command's output, in their order.

A command that fails, by any exit code but 0 and 3 (no gain), fails the test. Commands that need files of the reader
are listed in NOT_RUN. --write puts the outputs of the programs into the README instead; a shortened block keeps which
lines it shows. Exit code 1 if an output differs.
"""

import argparse
import difflib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parent.parent
GAP = "…"

# Commands on files that the reader holds. NOT_RUN_COUNT is changed together with a reason in the commit.
NOT_RUN_COUNT = 21
NOT_RUN = (
    "build/bin/estimate-sensor-noise --json report.json --maps maps/ frames/*.tif",
    "build/bin/estimate-sensor-noise --plot report.html frames/*.tif",
    "build/bin/estimate-sensor-noise --compare day1.json day2.json --plot days.html",
    "build/bin/estimate-sensor-noise frames/*.tif --dark dark/*.tif",
    "build/bin/estimate-sensor-noise frames/*.tif --offset 100,0.5",
    "build/bin/estimate-sensor-noise recording.ser",
    "build/bin/estimate-sensor-noise IMG_*.CR2",
    "build/bin/estimate-sensor-noise recording.cihx",
    "build/bin/estimate-sensor-noise frames/",
    "build/bin/estimate-sensor-noise 'frames/*.tif' --dark 'darks/*.tif'",
    "build/bin/estimate-sensor-noise part_1.tif part_2.tif",
    "build/bin/estimate-sensor-noise hyperstack.ome.tif --channel 0 --plane 2",
    "build/bin/estimate-sensor-noise --raw 640x480:uint16le dump.raw",
    "build/bin/estimate-sensor-noise --raw 400x200:uint16le:0:0:800 spool/",
    "build/bin/estimate-sensor-noise --raw 4056x3040:SBGGR12P:0:6112 frames/*.raw",
    "build/bin/estimate-sensor-noise --json report.json burst/*.tif",
    "build/bin/denoise-with-noise-model --report report.json frame.tif clean.tif",
    "build/bin/denoise-with-noise-model --report report.json --output-folder clean/ other/*.tif",
    "build/bin/denoise-with-noise-model --report report.json --denoiser itk --pixel-type float stack.mha clean.mha",
    "build/bin/stabilise-mats report.json burst/*.png",
    "build/bin/stabilise-mats report.json --video burst/frame_000.png",
)


class Scratch:
    """The folder in which the commands run: build/bin is the built programs, examples/ the scripts."""

    def __init__(self, folder: pathlib.Path, programs: pathlib.Path) -> None:
        self.folder = folder
        (folder / "build").mkdir()
        (folder / "build" / "bin").symlink_to(programs.resolve())
        shutil.copytree(SOURCE / "examples", folder / "examples", ignore=shutil.ignore_patterns("__pycache__"))
        self.runs = 0
        self.variables = ""

    def run(self, command: str) -> list[str]:
        if re.match(r"\w+=", command):
            self.variables += command + "\n"
            return []
        environment = {**os.environ, "LC_ALL": "C.UTF-8", "SENSORNOISE_BUILT": "1", "COLUMNS": "120"}
        done = subprocess.run(
            ["bash", "-c", self.variables + command], cwd=self.folder, env=environment, capture_output=True, check=False
        )
        self.runs += 1
        lines = (done.stdout + done.stderr).decode().splitlines()
        if done.returncode not in (0, 3):
            sys.exit(f"exit code {done.returncode} of: {command}\n" + "\n".join(lines))
        return lines


def is_alike(shown: str, printed: str) -> bool:
    """Whether a line of the README is the printed one, but for what `…` stands for."""
    return re.fullmatch(".+".join(map(re.escape, shown.split(GAP))), printed) is not None


def differences(shown: list[str], printed: list[str]) -> list[str]:
    """Lines of the README that the program does not print there, and lines it prints that the README lacks."""
    found, at, may_skip = [], 0, False
    for line in shown:
        if line == GAP:
            may_skip = True
            continue
        place = next((i for i in range(at, len(printed)) if is_alike(line, printed[i])), None) if may_skip else at
        if place is None or place >= len(printed):
            found.append(f"README: {line}")
        elif is_alike(line, printed[place]):
            at, may_skip = place + 1, False
        else:
            found += [f"README:  {line}", f"printed: {printed[place]}"]
            at, may_skip = place + 1, False
    if not may_skip:
        found += [f"printed: {line}" for line in printed[at:]]
    return found


def likeness(line: str, printed: str) -> tuple[float, float]:
    """How alike two lines are: first with their digits left out, then as they are."""
    pairs = ((re.sub(r"\d", "", line), re.sub(r"\d", "", printed)), (line, printed))
    words, whole = (difflib.SequenceMatcher(None, *pair).ratio() for pair in pairs)
    return words, whole


def rewritten(shown: list[str], printed: list[str]) -> list[str]:
    """The printed lines, those of a shortened block only, with its `…`."""
    if GAP not in shown:
        marked = {line for line in shown if GAP in line}
        return [next((line for line in marked if is_alike(line, text)), text) for text in printed]
    result, at = [], 0
    for line in shown:
        if line == GAP:
            result.append(line)
        elif at < len(printed):
            at = max(range(at, len(printed)), key=lambda place: likeness(line, printed[place])) + 1
            result.append(line if is_alike(line, printed[at - 1]) else printed[at - 1])
    return result


def commands_of(lines: list[str]) -> list[str]:
    """The commands of an `sh` block that call a program of build/bin, without comments, in one line each."""
    text = re.sub(r"\\\n\s*", "", "\n".join(lines))
    return [
        re.sub(r"\s+#.*", "", line) for line in text.splitlines() if "build/bin/" in line or re.match(r"\w+=", line)
    ]


def console_runs(lines: list[str]) -> list[tuple[list[str], list[str]]]:
    """Each command of a `console` block, as it stands there, with the lines below it."""
    runs: list[tuple[list[str], list[str]]] = []
    for line in lines:
        if line.startswith("$ ") or (runs and not runs[-1][1] and runs[-1][0][-1].endswith("\\")):
            if line.startswith("$ "):
                runs.append(([line], []))
            else:
                runs[-1][0].append(line)
        elif runs:
            runs[-1][1].append(line)
        else:
            sys.exit(f"a console block begins with a command, not with: {line}")
    return runs


class Readme:
    """Goes through the README, block by block."""

    def __init__(self, scratch: Scratch) -> None:
        self.scratch = scratch
        self.left_out: list[str] = []
        self.failures: list[str] = []
        self.compared = 0

    def compare(self, command: str, shown: list[str], printed: list[str]) -> list[str]:
        self.compared += 1
        if found := differences(shown, printed):
            self.failures += [f"$ {command}", *found]
        return rewritten(shown, printed)

    def console(self, lines: list[str]) -> list[str]:
        result = []
        for command_lines, shown in console_runs(lines):
            command = "\n".join(command_lines)[2:]
            result += command_lines + self.compare(command, shown, self.scratch.run(command))
        return result

    def shell(self, lines: list[str]) -> None:
        for command in commands_of(lines):
            if command in NOT_RUN:
                self.left_out.append(command)
            else:
                self.scratch.run(command)

    def read(self, text: str) -> str:
        """The text with the outputs of the programs."""
        result: list[str] = []
        hidden: tuple[str, list[str]] | None = None
        lines = iter(text.splitlines())
        for line in lines:
            result.append(line)
            if comment := re.fullmatch(r"<!-- \$ (.*) -->", line):
                hidden = (comment[1], self.scratch.run(comment[1]))
            elif line.startswith("```"):
                block = []
                for inner in lines:
                    if inner == "```":
                        break
                    block.append(inner)
                if line == "```console":
                    block = self.console(block)
                elif line == "```sh":
                    self.shell(block)
                elif line == "```" and hidden:
                    shown = [part for shown_line in block for part in (GAP, shown_line)] + [GAP]
                    block = [part for part in self.compare(hidden[0], shown, hidden[1]) if part != GAP]
                    hidden = None
                result += [*block, "```"]
        return "\n".join(result) + "\n"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=pathlib.Path, required=True, help="folder of the built programs")
    parser.add_argument("--readme", type=pathlib.Path, default=SOURCE / "README.md")
    parser.add_argument("--write", action="store_true", help="write the outputs into the README")
    options = parser.parse_args()

    text = options.readme.read_text(encoding="utf-8")
    with tempfile.TemporaryDirectory() as folder:
        readme = Readme(Scratch(pathlib.Path(folder), options.bin))
        new = readme.read(text)
    if options.write:
        options.readme.write_text(new, encoding="utf-8")
    else:
        print("\n".join(readme.failures), end="\n" if readme.failures else "")
    stale = [command for command in NOT_RUN if command not in readme.left_out]
    for command in stale:
        print(f"the README no longer has this command of NOT_RUN: {command}")
    if len(NOT_RUN) != NOT_RUN_COUNT:
        print(f"{len(NOT_RUN)} commands are not run; expected {NOT_RUN_COUNT}")
    print(
        f"{readme.scratch.runs} commands were run, {readme.compared} outputs compared, {len(readme.left_out)} not run"
    )
    is_good = (options.write or not readme.failures) and not stale and len(NOT_RUN) == NOT_RUN_COUNT
    return 0 if is_good and readme.compared > 0 else 1


if __name__ == "__main__":
    sys.exit(main())
