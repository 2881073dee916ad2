#!/usr/bin/env python3
# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Runs clang-tidy over every source of a compile_commands.json: test/check-style.sh.

Most of clang-tidy's time goes into the headers of ITK and Eigen. So the sources of one folder and target are read
together, in one file that includes them, as the library is built. Sources without a finding are remembered in CACHE,
keyed by all that clang-tidy reads, and are not checked again.
"""

import argparse
import concurrent.futures
import hashlib
import json
import os
import pathlib
import shlex
import subprocess
import sys
import time

# Flags of the compiler that determine the meaning of a source.
KEPT = ("-D", "-I", "-std=")
# Warnings that cmake/Warnings.cmake asks of Clang, and -Wpedantic without extra semicolons, which ITK 5.4 demands.
WARNINGS = (
    *("-Wall", "-Wextra", "-Wpedantic", "-Wno-extra-semi", "-Wshadow", "-Wconversion", "-Wno-sign-conversion"),
    *("-Wold-style-cast", "-Wcast-qual", "-Wnon-virtual-dtor", "-Woverloaded-virtual"),
    *("-Wformat-nonliteral", "-Wctad-maybe-unsupported"),
)

# Debian's ITK 5.2 says so to every compiler but GCC, and can be read all the same.
OTHER_COMPILER = "error: Unsupported compiler [clang-diagnostic-error]"


def read_groups(commands, root):
    """Returns the sources by folder and target, with the flags of each group."""
    groups = {}
    for entry in json.loads(commands.read_text()):
        source = pathlib.Path(entry["file"])
        if not source.is_relative_to(root) or source.is_relative_to(commands.parent):
            continue  # written by CMake
        words = shlex.split(entry["command"])
        flags = [word for word in words if word.startswith(KEPT)]
        for place, word in enumerate(words):
            if word == "-isystem":
                flags += words[place : place + 2]
        target = next(part for part in pathlib.Path(words[words.index("-o") + 1]).parts if part.endswith(".dir"))
        name = "-".join([target.removesuffix(".dir"), *source.relative_to(root).parent.parts])
        groups.setdefault(name, (flags, []))[1].append(source)
    return groups


def fingerprint(configuration, flags, source, root):
    """Returns a key of all that clang-tidy reads: the preprocessed source, independent of the place of the checkout."""
    command = ["c++", "-E", "-P", "-C", *flags, str(source)]
    text = subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout
    read = repr((flags, WARNINGS)).encode() + text
    return hashlib.sha256(configuration + read.replace(os.fsencode(root), b"")).hexdigest()


def check(name, group, arguments, configuration):
    """Returns whether clang-tidy finds nothing, and its output."""
    flags, sources = group
    together = arguments.work / f"{name}.cxx"
    together.write_text("".join(f'#include "{source}"\n' for source in sorted(sources)))
    known = arguments.cache / fingerprint(configuration, flags, together, arguments.root)
    if known.exists():
        known.touch()
        return True, ""
    start = time.monotonic()
    found = subprocess.run(
        [
            "clang-tidy",
            "--quiet",
            f"--header-filter=^{arguments.root}/(module|filters|examples)/",
            str(together),
            "--",
            *flags,
            *WARNINGS,
        ],
        check=False,
        capture_output=True,
        text=True,
    )
    lines = found.stdout.splitlines()
    errors = [line for line in lines if ": error: " in line and not line.endswith(OTHER_COMPILER)]
    if not errors and not any(": warning: " in line for line in lines) and found.returncode in (0, 1):
        known.touch()
        return True, f"clang-tidy {name}: {time.monotonic() - start:.0f} s"
    return False, found.stdout + found.stderr


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("commands", type=pathlib.Path, help="compile_commands.json of a build without unity files")
    parser.add_argument("--cache", type=pathlib.Path, required=True, help="folder for what had no finding")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    arguments = parser.parse_args()
    arguments.root = pathlib.Path(__file__).resolve().parent.parent
    arguments.work = arguments.commands.resolve().parent / "tidy"
    arguments.work.mkdir(exist_ok=True)
    arguments.cache.mkdir(parents=True, exist_ok=True)

    version = subprocess.run(["clang-tidy", "--version"], check=True, stdout=subprocess.PIPE).stdout
    configuration = version + (arguments.root / ".clang-tidy").read_bytes()
    groups = read_groups(arguments.commands.resolve(), arguments.root)
    is_good = True
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        # The largest first: none is left to run alone at the end.
        names = sorted(groups, key=lambda name: -sum(source.stat().st_size for source in groups[name][1]))
        for is_clean, text in pool.map(lambda name: check(name, groups[name], arguments, configuration), names):
            is_good = is_good and is_clean
            if text:
                print(text, flush=True)
    return 0 if is_good else 1


if __name__ == "__main__":
    sys.exit(main())
