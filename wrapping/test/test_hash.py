# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests the SHA-256 of the measured data: the tool's hash of files, and the hash of arrays for other sources."""

import hashlib
import json
import os

import itk
import numpy as np
import pytest


class Lazy:
    """Frames that are not an array."""

    def __init__(self, frames, wrong=None):
        self.frames, self.shape, self.dtype, self.wrong = frames, frames.shape, frames.dtype, wrong

    def __getitem__(self, times):
        if self.wrong:
            raise self.wrong
        return self.frames[times]


@pytest.fixture
def folder(burst, tmp_path):
    """Writes the burst to files of several kinds, and dark frames. Returns their folder."""
    itk.imwrite(itk.image_view_from_array(burst), str(tmp_path / "stack.mhd"))
    burst[:12].tofile(tmp_path / "dark.bin")
    for number, frame in enumerate(burst):
        itk.imwrite(itk.image_view_from_array(np.ascontiguousarray(frame)), str(tmp_path / f"f{number:02}.png"))
        frame.tofile(tmp_path / f"f{number:02}.bin")
    return tmp_path


def of_files(*names):
    content = b"".join(name.read_bytes() for name in names)
    return {"of": "files", "sha256": hashlib.sha256(content).hexdigest(), "files": len(names), "bytes": len(content)}


def of_pixels(array):
    content = array.astype(array.dtype.newbyteorder("<")).tobytes()
    return {"of": "pixels", "sha256": hashlib.sha256(content).hexdigest(), "files": 0, "bytes": len(content)}


def hash_of(frames, **parameters):
    return itk.estimate_sensor_noise(frames, hash=True, **parameters)["input"]


RAW = {"raw": "128x96:uint16le"}


def test_files_have_the_hash_of_the_tool(tool, folder):
    frames, dumps = sorted(folder.glob("f*.png")), sorted(folder.glob("f*.bin"))
    header = [folder / "stack.mhd"]
    cases = [
        (header, {}, of_files(*header, folder / "stack.raw")),
        (frames, {"frame_range": (3, 40), "roi": (8, 8, 100, 80)}, of_files(*frames[3:40])),
        (dumps, RAW | {"frame_range": (3, 40)}, of_files(*dumps[3:40])),
        (dumps, RAW | {"dark": dumps[:12]}, of_files(*dumps) | {"dark": of_files(*dumps[:12])}),
        (header, {"bayer": "RGGB"}, of_files(*header, folder / "stack.raw")),
    ]
    for names, parameters, expected in cases:
        options = []
        for name, value in parameters.items():
            joined = (
                (":" if name == "frame_range" else ",").join(map(str, value)) if isinstance(value, tuple) else value
            )
            options += ["--frames" if name == "frame_range" else f"--{name}", *(value if name == "dark" else [joined])]
        found = hash_of(names, **parameters)
        assert found == expected
        tool("estimate-sensor-noise", *names, *options, "--quiet", "--hash", "--json", folder / "r.json")
        assert json.loads((folder / "r.json").read_text())["input"] == found


def test_whatever_holds_the_pixels_they_have_one_hash(burst, monkeypatch):
    monkeypatch.setattr("itk_sensornoise._frames._PIECE_BYTES", 7 * burst[0].nbytes)  # makes the last piece shorter
    expected = of_pixels(burst)
    for frames in (
        burst,
        burst.astype(">u2"),
        np.asfortranarray(burst),
        list(burst),
        Lazy(burst),
        [Lazy(frame) for frame in burst],
        itk.image_view_from_array(burst),
    ):
        assert hash_of(frames) == expected
    assert hash_of(burst, frame_range=(5, 20), roi=(8, 8, 64, 64)) == expected
    assert hash_of(list(burst), frame_range=(5, 20)) == of_pixels(burst[5:20])
    assert hash_of(burst, dark=Lazy(burst[:9])) == expected | {"dark": of_pixels(burst[:9])}


def test_a_hash_changes_no_number_and_is_shown(burst):
    plain, report = itk.estimate_sensor_noise(burst).to_dict(), itk.estimate_sensor_noise(burst, hash=True)
    assert "input" not in plain and report.to_dict() == plain | {"input": report["input"]}
    digest = of_pixels(burst)["sha256"]
    assert f"\nframes: pixels, {burst.nbytes} bytes, SHA-256 {digest}\n" in str(report)
    assert f"<code>{digest}</code>" in report.to_html()
    assert "hash of pixels is" in report.to_html() and "sha256sum" not in report.to_html()


def test_files_that_change_meanwhile_are_refused(folder, monkeypatch):
    from itk_sensornoise import _hash

    def later(*arguments):
        original(*arguments)
        os.utime(folder / "stack.raw", (0, 0))

    original = _hash.FramesHash._add_file
    monkeypatch.setattr(_hash.FramesHash, "_add_file", later)
    with pytest.raises((ValueError, RuntimeError), match="stack.raw has changed since it was opened"):
        hash_of(folder / "stack.mhd")
    # The reader misses some changes: rawpy does not look for them, and a change may follow the last reading.
    monkeypatch.setattr(_hash.FramesHash, "_add_file", original)
    hashed = _hash.FramesHash(itk_stack(folder / "stack.mhd"))
    hashed.require_unchanged()
    os.utime(folder / "stack.raw", (1, 1))
    with pytest.raises(ValueError, match="stack.raw: has changed since its hash was computed"):
        hashed.require_unchanged()


def itk_stack(name):
    from itk_sensornoise._frames import open_frames

    return open_frames(name)


def test_what_a_reader_raises_is_raised(burst):
    with pytest.raises(KeyError, match="away"):
        hash_of(Lazy(burst, KeyError("away")))


@pytest.mark.parametrize("given", [1, "sha256", None])
def test_other_values_are_refused(burst, given):
    with pytest.raises(ValueError, match="^hash is .*; expected True or False"):
        itk.estimate_sensor_noise(burst, hash=given)
