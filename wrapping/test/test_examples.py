# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests the example programs as a user runs them."""

import json
import re
import subprocess
import sys
from pathlib import Path

import itk
import numpy as np
import pytest

EXAMPLES = Path(__file__).resolve().parents[2] / "examples" / "python"


def run(program, *arguments):
    command = [sys.executable, str(EXAMPLES / program), *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


@pytest.fixture(scope="module")
def few(tmp_path_factory):
    """Writes a stack of so few frames that the report has a warning. Returns its file name."""
    name = tmp_path_factory.mktemp("few") / "few.mha"
    itk.imwrite(itk.image_view_from_array(itk.simulate_sensor_noise(frames=8, size=(96, 64))[0]), str(name))
    return name


def test_estimate_prints_each_warning_once(few, tmp_path):
    result = run("estimate.py", few, "--json", tmp_path / "report.json")
    report = json.loads((tmp_path / "report.json").read_text())
    assert report["warnings"]
    for warning in report["warnings"]:
        assert (result.stdout + result.stderr).count(warning["message"]) == 1


def test_estimate_writes_the_page(few, tmp_path):
    assert run("estimate.py", few, "--plot", tmp_path / "report.html").returncode == 0
    assert (tmp_path / "report.html").read_text(encoding="utf-8") == itk.estimate_sensor_noise(few).to_html()


def test_estimate_ends_with_what_it_says(few, tmp_path):
    assert run("estimate.py", few).returncode == 0
    result = run("estimate.py", tmp_path / "no-such.mha")
    assert result.returncode == 2 and "does not exist" in result.stderr and result.stdout == ""


def test_lazy_frames_are_read_by_other_packages(tmp_path):
    cv2 = pytest.importorskip("cv2")
    stack = itk.simulate_sensor_noise(frames=20, size=(96, 64), dtype="uint8", gain=0.07)[0]
    names = [tmp_path / f"{number:02}.png" for number in range(20)]
    for name, frame in zip(names, stack, strict=True):
        cv2.imwrite(str(name), frame)
    np.save(tmp_path / "a.npy", stack)
    expected = f"{itk.estimate_sensor_noise(stack)}\n"
    assert run("lazy.py", *names).stdout == run("lazy.py", tmp_path / "a.npy").stdout == expected
    result = run("lazy.py", tmp_path / "no-such.png")
    assert result.returncode == 2 and "cannot be read" in result.stderr


def test_a_video_is_read_frame_by_frame(tmp_path):
    cv2 = pytest.importorskip("cv2")
    stack = itk.simulate_sensor_noise(frames=20, size=(96, 64), dtype="uint8", gain=0.07)[0]
    name = tmp_path / "a.avi"
    video = cv2.VideoWriter(str(name), cv2.VideoWriter_fourcc(*"FFV1"), 20, (96, 64))
    if not video.isOpened():
        pytest.skip("OpenCV has no lossless codec here")
    for frame in stack:
        video.write(np.repeat(frame[..., None], 3, axis=2))
    video.release()
    result = run("lazy.py", name)
    assert "20 frames of 96 x 64 pixels" in result.stdout, (
        result.stderr
    )  # the codec changes the grey values of the sensor


def test_held_out_frames_are_stabilised():
    result = run("measure_held_out.py", "--size", 96, "--frames", 40, "--cameras", "B", "--scenes", "target")
    assert result.returncode == 0, result.stderr
    table = [line.split() for line in result.stdout.splitlines()[-9:]]
    rows = {(quantity, method): list(map(int, counts)) for quantity, method, _, *counts in table}
    for row in [("variance", "true"), ("exact-unbiased", "true"), ("exact-unbiased", "refined")]:
        assert rows[row][0] == rows[row][2] > 0
    assert rows["algebraic", "refined"][0] < rows["algebraic", "refined"][2]
    assert rows["variance", "published"][0] < rows["variance", "refined"][0]


def test_motion_behind_a_mosaic_is_found_by_all_planes_together():
    result = run("measure_mosaic_motion.py", "--size", 128, "--frames", 40, "--seeds", 1)
    assert result.returncode == 0, result.stderr
    rows = [
        re.fullmatch(r".*: ([\d.]+) % off \(rms\), (\d+) of (\d+) intervals hold", line).groups()
        for line in result.stdout.splitlines()[-2:]
    ]
    (plane, *_), (joint, held, of) = rows
    assert float(joint) < float(plane)
    assert int(of) - int(held) <= 4  # at most 36 can miss; 5 or more occur by chance once in 30 runs


def test_several_processes_have_the_bits_of_one(tmp_path):
    stack = itk.simulate_sensor_noise(frames=20, size=(96, 64))[0]
    names = [tmp_path / f"{number:02}.tif" for number in range(20)]
    for name, frame in zip(names, stack, strict=True):
        itk.imwrite(itk.image_view_from_array(frame), str(name))
    result = run("several_processes.py", *names)
    assert result.stdout == f"{itk.estimate_sensor_noise(stack)}\n", result.stderr
    result = run("several_processes.py", tmp_path / "no-such.tif")
    assert result.returncode == 2 and "does not exist" in result.stderr


def test_steps_in_an_archive_are_evaluated(tmp_path):
    pytest.importorskip("distributed", reason="Dask's distributed is not installed")
    pytest.importorskip("pandas")
    lines = tmp_path / "archive.jsonl"
    small = ["--cameras", 4, "--sessions", 4, "--size", 128, "--frames", 30, "--workers", 1, "--output", lines]
    result = run("measure_archive.py", *small)
    assert result.returncode == 0, result.stderr
    assert "16 bursts of 30 frames of 128 x 128 pixels, 1 workers" in result.stdout
    assert "0 without a report" in result.stdout and len(lines.read_text().splitlines()) == 16
    rows = {row[0]: row for row in map(str.split, result.stdout.splitlines()[-3:])}
    assert [rows[name][5] for name in ("gain", "offset", "read_noise")] == ["1", "1", "0"]  # numbers of steps
    for row in rows.values():
        ratio, spread = float(row[2]), float(row[4])
        assert abs(ratio - 1) < 4 * spread  # the scatter agrees with the standard errors
