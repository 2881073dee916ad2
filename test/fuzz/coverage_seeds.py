# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Writes the inputs that FrameFileFuzzer.cxx begins with: coverage_seeds.py FOLDER.

FOLDER/<format>/ has the sound files of frame_files.py and the damaged ones of known.py, with eight frames of 8 x 4
pixels: small files are tried more often a second. Prints the names of the formats, one a line.
"""

import pathlib
import sys
from random import Random

import frame_files
import frame_parts

# Before known.py takes them over. FrameFileFuzzer.cxx has the same numbers.
frame_parts.WIDTH = 8
frame_parts.HEIGHT = 4

from known import known_cases  # noqa: E402 - see above

FRAMES = 8

# The formats as FrameFile.cxx calls them, by the first word of a case's name. Frames without a header and formats
# that are refused unread have no target.
FORMATS = {
    "dng": "camera raw",
    "tiff": "TIFF",
    "bigtiff": "TIFF",
    "png": "PNG",
    "mha": "MetaImage",
    "mhd": "MetaImage",
    "nrrd": "NRRD",
    "nhdr": "NRRD",
    "ser": "SER",
    "mraw": "MRAW",
    "fits": "FITS",
    "npy": "NPY",
    "pgm": "PGM",
}

# Sound headers that frame_files.py leaves out, from which libFuzzer reaches the code that reads them: the case, the
# text that is replaced in its first file, and the new text. In FITS, it has the same length.
VARIANTS = [
    ("nrrd", b"endian:", b"spacings: 1 2 nan\nkinds: domain domain time\nendian:"),
    (
        "nrrd",
        b"endian:",
        b"space: right-anterior-superior\nspace directions: (1,0,0) (0,1,0) (0,0,2)\nspace origin: (1,2,3)\nendian:",
    ),
    ("fits", b"BSCALE  =                    1", b"BSCALE  =                  2.5"),
    ("fits 32", b"BITPIX  =                   32", b"BITPIX  =                  -32"),
]


def varied(cases: list[frame_parts.Case]) -> list[frame_parts.Case]:
    by_name = {case.name: case for case in cases}
    made = []
    for name, old, new in VARIANTS:
        first, *rest = by_name[name].files
        assert old in first.data, (name, old)
        file = frame_parts.File(first.name, first.data.replace(old, new, 1))
        made.append(frame_parts.Case(name, [file, *rest], by_name[name].frames))
    return made


def inputs_of(case: frame_parts.Case) -> list[bytes]:
    """Returns the files of a case as one input, or each file as one input if the frames have separate files."""

    def part(file: frame_parts.File) -> bytes:
        return b"%%FILE%%" + file.name.encode() + b"\n" + file.data

    if len(case.frames) > 1:
        return [part(file) for file in case.files]
    return [b"".join(map(part, case.files))]


def main() -> None:
    folder = pathlib.Path(sys.argv[1])
    random = Random(1)
    pixels = frame_parts.WIDTH * frame_parts.HEIGHT
    # Values of eleven bits, because the packed formats hold at most 12.
    frames = [b"".join(random.randrange(2048).to_bytes(2, "little") for _ in range(pixels)) for _ in range(FRAMES)]
    sound = frame_files.all_cases(frames)
    cases = sound + varied(sound) + [case for _, case in known_cases(frames)]
    for number, case in enumerate(cases):
        name = FORMATS.get(case.name.split()[0])
        if name is None:
            continue
        (folder / name).mkdir(parents=True, exist_ok=True)
        for part, data in enumerate(inputs_of(case)):
            (folder / name / f"{number:03}-{part}").write_bytes(data)
    print("\n".join(dict.fromkeys(FORMATS.values())))


if __name__ == "__main__":
    main()
