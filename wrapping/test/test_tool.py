# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests that numbers equal the numbers of the tools bit for bit, and the noise correlation to seven digits."""

import json
import pickle
import zlib

import itk
import numpy as np
import pytest


@pytest.fixture(scope="module")
def stack_file(burst, tmp_path_factory):
    name = tmp_path_factory.mktemp("tool") / "burst.mha"
    itk.imwrite(itk.image_view_from_array(burst), str(name))
    return name


@pytest.fixture(scope="module")
def mask(burst):
    mask = np.ones(burst.shape[1:], np.uint8)
    mask[20:50, 10:90] = 0
    return mask


def numbers(value):
    """Returns all numbers of a record, in order."""
    if isinstance(value, dict):
        return [number for member in value.values() for number in numbers(member)]
    if isinstance(value, list):
        return [number for member in value for number in numbers(member)]
    return [value] if isinstance(value, float) else []


def without_numbers(value):
    """Returns a record with 0.0 in place of every number with a fraction."""
    if isinstance(value, dict):
        return {key: without_numbers(member) for key, member in value.items()}
    if isinstance(value, list):
        return [without_numbers(member) for member in value]
    return 0.0 if isinstance(value, float) else value


def assert_same(found, expected):
    """Compares two reports. The wheel has ITK's Eigen and the tools the system's, which add 4-byte numbers in another
    order: the noise correlation differs by 1e-6 of itself, and what is weighted by it in the last bits."""
    found, expected = json.loads(found), json.loads(expected)
    shared, shared_expected = found.pop("noise_correlation"), expected.pop("noise_correlation")
    assert without_numbers(found) == without_numbers(expected)
    assert numbers(found) == pytest.approx(numbers(expected), rel=1e-12, abs=1e-15)
    assert (shared or {}).get("kind") == (shared_expected or {}).get("kind")
    assert numbers(shared) == pytest.approx(numbers(shared_expected), rel=1e-6, abs=1e-9)


ALL_FLAGS = (
    "--bit-depth 12 --clip 0,4000 --step 1 --level-range 400,3000 --rolling-shutter off --offset 100,0.5 "
    "--roi 4,3,110,90 --frames 2:58"
)
# Parameters, and the same options as flags.
OPTIONS = {
    "defaults": ({}, []),
    "published": ({"method": "published"}, ["--method", "published"]),
    "offset": ({"offset": 100}, ["--offset", "100"]),
    "offset with error": ({"offset": (99.5, 0.25)}, ["--offset", "99.5,0.25"]),
    "shutter off": ({"rolling_shutter": "off"}, ["--rolling-shutter", "off"]),
    "shutter width": (
        {"method": "published", "rolling_shutter": 12},
        ["--method", "published", "--rolling-shutter", "12"],
    ),
    "roi": ({"roi": (10, 5, 100, 80)}, ["--roi", "10,5,100,80"]),
    "frames": ({"frame_range": (7, 41)}, ["--frames", "7:41"]),
    "codes": (
        {"bit_depth": 14, "clip": (90, 3000), "step": 1},
        ["--bit-depth", "14", "--clip", "90,3000", "--step", "1"],
    ),
    "level range": ({"level_range": (500, 2500.5)}, ["--level-range", "500,2500.5"]),
    "exposures": (
        {"exposures": [1, 2, 3.5] * 20, "frame_range": (3, 60)},
        ["--exposures", ",".join(["1,2,3.5"] * 20), "--frames", "3:60"],
    ),
    "one thread": ({"threads": 1}, ["--threads", "1"]),
    "all of them": (
        {
            "bit_depth": 12,
            "clip": (0, 4000),
            "step": 1,
            "level_range": (400, 3000),
            "rolling_shutter": "off",
            "offset": (100, 0.5),
            "roi": (4, 3, 110, 90),
            "frame_range": (2, 58),
        },
        ALL_FLAGS.split(),
    ),
}
# Entries of these options in `settings`.
SETTINGS = {
    "defaults": {"rolling_shutter": "auto"},
    "offset": {"rolling_shutter": "auto", "offset": 100, "offset_standard_error": 0, "dark_frames": 0},
    "roi": {"rolling_shutter": "auto", "roi_x": 10, "roi_y": 5, "roi_width": 100, "roi_height": 80},
    "frames": {"rolling_shutter": "auto", "frame_range_first": 7, "frame_range_end": 41},
    "codes": {
        "rolling_shutter": "auto",
        "bit_depth": 14,
        "clip_low": 90,
        "clip_high": 3000,
        "quantisation_step": 1,
    },
    "level range": {"rolling_shutter": "auto", "level_range_low": 500, "level_range_high": 2500.5},
    "exposures": {
        "rolling_shutter": "auto",
        "exposures": [1, 2, 3.5] * 19,
        "frame_range_first": 3,
        "frame_range_end": 60,
    },
    "one thread": {"rolling_shutter": "auto"},
    "all of them": {
        "rolling_shutter": "off",
        "level_range_low": 400,
        "level_range_high": 3000,
        "offset": 100,
        "offset_standard_error": 0.5,
        "dark_frames": 0,
        "bit_depth": 12,
        "clip_low": 0,
        "clip_high": 4000,
        "quantisation_step": 1,
        "roi_x": 4,
        "roi_y": 3,
        "roi_width": 110,
        "roi_height": 90,
        "frame_range_first": 2,
        "frame_range_end": 58,
    },
}


@pytest.mark.parametrize("case", OPTIONS)
def test_json_is_the_tool_s(tool, burst, stack_file, case):
    parameters, flags = OPTIONS[case]
    expected = tool("estimate-sensor-noise", stack_file, "--quiet", "--json", "-", *flags)
    assert_same(itk.estimate_sensor_noise(burst, **parameters).to_json(), expected)
    assert_same(itk.estimate_sensor_noise(stack_file, **parameters).to_json(), expected)


@pytest.mark.parametrize("case", SETTINGS)
def test_settings_hold_what_was_given(tool, burst, stack_file, case):
    parameters, flags = OPTIONS[case]
    here = itk.estimate_sensor_noise(list(burst), **parameters)["settings"]
    there = json.loads(tool("estimate-sensor-noise", stack_file, "--quiet", "--json", "-", *flags))["settings"]
    assert here == there == SETTINGS[case]


def test_settings_of_files_in_a_list_are_the_tool_s(tool, burst, tmp_path):
    names = [tmp_path / f"{number:03}.tif" for number in range(len(burst))]
    for name, frame in zip(names, burst, strict=True):
        itk.imwrite(itk.image_from_array(frame), str(name))
    there = tool("estimate-sensor-noise", *names, "--quiet", "--json", "-", *OPTIONS["frames"][1])
    here = itk.estimate_sensor_noise(names, **OPTIONS["frames"][0])
    assert here["settings"] == json.loads(there)["settings"] == SETTINGS["frames"]


@pytest.mark.parametrize("roi", [None, (10, 5, 100, 80)])
def test_settings_hold_the_mask_s_checksum(burst, mask, roi):
    x, y, width, height = roi or (0, 0, 128, 96)
    part = mask[y : y + height, x : x + width]
    expected = zlib.crc32(f"{width}x{height}:".encode() + (part != 0).tobytes())
    assert itk.estimate_sensor_noise(burst, mask=mask, roi=roi)["settings"]["mask_crc32"] == f"{expected:08x}"


@pytest.mark.parametrize("roi", [None, (10, 5, 100, 80)])
def test_mask_is_the_tool_s(tool, burst, stack_file, mask, tmp_path, roi):
    mask_file = tmp_path / "mask.png"
    itk.imwrite(itk.image_view_from_array(mask), str(mask_file))
    flags = [] if roi is None else ["--roi", ",".join(map(str, roi))]
    expected = tool("estimate-sensor-noise", stack_file, "--quiet", "--json", "-", "--mask", mask_file, *flags)
    assert_same(itk.estimate_sensor_noise(burst, mask=mask, roi=roi).to_json(), expected)
    assert_same(itk.estimate_sensor_noise(burst, mask=mask_file, roi=roi).to_json(), expected)
    assert_same(itk.estimate_sensor_noise(burst, mask=mask * 7.0, roi=roi).to_json(), expected)


@pytest.mark.parametrize("roi", [None, (10, 5, 100, 80)])
def test_dark_frames_are_the_tool_s(tool, burst, dark, stack_file, tmp_path, roi):
    names = [tmp_path / f"{number:03}.tif" for number in range(len(dark))]
    for name, frame in zip(names, dark, strict=True):
        itk.imwrite(itk.image_from_array(frame), str(name))
    flags = [] if roi is None else ["--roi", ",".join(map(str, roi))]
    expected = tool("estimate-sensor-noise", stack_file, "--quiet", "--json", "-", *flags, "--dark", *names)
    assert_same(itk.estimate_sensor_noise(burst, dark=dark, roi=roi).to_json(), expected)
    assert_same(itk.estimate_sensor_noise(burst, dark=names, roi=roi).to_json(), expected)
    assert_same(itk.estimate_sensor_noise(stack_file, dark=list(dark), roi=roi).to_json(), expected)


@pytest.mark.parametrize("has_dark", [False, True])
def test_maps_are_the_tool_s(tool, burst, dark, stack_file, tmp_path, has_dark):
    dark_file = tmp_path / "dark.mha"
    itk.imwrite(itk.image_view_from_array(dark), str(dark_file))
    flags = ["--dark", dark_file] if has_dark else []
    tool("estimate-sensor-noise", stack_file, "--quiet", "--maps", tmp_path / "tool", *flags)
    itk.estimate_sensor_noise(burst, dark=dark if has_dark else None, maps=tmp_path / "here")
    names = sorted(path.name for path in (tmp_path / "tool").iterdir())
    assert len(names) == (10 if has_dark else 4)
    report = itk.estimate_sensor_noise(burst, dark=dark if has_dark else None, maps=True)
    assert sorted(f"{name}.mha" for name in report.maps) == names
    assert sorted(path.name for path in (tmp_path / "here").iterdir()) == names
    for name in names:
        expected, found = (itk.array_from_image(itk.imread(str(tmp_path / by / name))) for by in ("tool", "here"))
        np.testing.assert_array_equal(found, expected)
        np.testing.assert_array_equal(report.maps[name.removesuffix(".mha")], expected)
    if has_dark:
        low, high = (itk.imread(str(tmp_path / "here" / f"pixel_offset_{end}.mha")) for end in ("low", "high"))
        covered = (np.asarray(low) < 100) & (np.asarray(high) > 100)
        assert covered.mean() == pytest.approx(0.95, abs=0.01)


def test_maps_in_memory_stay_with_the_report(burst):
    report = itk.estimate_sensor_noise(burst, maps=True)
    assert report.maps["mean"].flags.owndata and report.maps["pixel_use"].dtype == np.uint8
    assert (report.maps["pixel_use"] == 0).sum() == report["pixels"]["used"]
    other = pickle.loads(pickle.dumps(report))
    assert list(other.maps) == list(report.maps)
    np.testing.assert_array_equal(other.maps["variance"], report.maps["variance"])
    with pytest.raises(KeyError, match=r"'moon' is not among the maps .mean, variance, corrected_variance, pixel_use"):
        report.maps["moon"]
    without = itk.estimate_sensor_noise(burst, maps=False)
    assert without == report and not without.maps
    with pytest.raises(KeyError, match="maps=True"):
        without.maps["mean"]


def test_maps_that_cannot_be_written_are_refused(burst, tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(ValueError, match="maps is .*that folder cannot be made"):
        itk.estimate_sensor_noise(burst, maps=tmp_path / "file" / "maps")
    with pytest.raises(ValueError, match="maps is 7; expected True or the name of a folder"):
        itk.estimate_sensor_noise(burst, maps=7)


def test_table_is_the_tool_s(tool, burst, stack_file):
    assert str(itk.estimate_sensor_noise(burst)) + "\n" == tool("estimate-sensor-noise", stack_file)


def test_every_pixel_type(tool, stack, tmp_path):
    name = tmp_path / "stack.mha"
    itk.imwrite(itk.image_view_from_array(stack), str(name))
    expected = tool("estimate-sensor-noise", name, "--quiet", "--json", "-")
    assert_same(itk.estimate_sensor_noise(stack).to_json(), expected)


@pytest.mark.parametrize("extension", ["png", "tif", "mha"])
def test_list_of_files(tool, burst, tmp_path, extension):
    names = [tmp_path / f"{number:03}.{extension}" for number in range(len(burst))]
    for name, frame in zip(names, burst, strict=True):
        itk.imwrite(itk.image_from_array(frame), str(name))
    expected = tool("estimate-sensor-noise", *names, "--quiet", "--json", "-", "--frames", "3:50")
    assert_same(itk.estimate_sensor_noise(names, frame_range=(3, 50)).to_json(), expected)
    assert_same(itk.estimate_sensor_noise(list(burst), frame_range=(3, 50)).to_json(), expected)


def test_simulated_stack_is_the_tool_s(tool, tmp_path):
    name = tmp_path / "stack.mha"
    flags = ["--camera", "C", "--condition", "2", "--frames", "9", "--size", "64x48", "--seed", "4", "--offset", "70"]
    tool("simulate-sensor-noise", "--output", name, *flags)
    stack, truth = itk.simulate_sensor_noise("C", 2, 9, (64, 48), seed=4, offset=70)
    np.testing.assert_array_equal(stack, itk.array_from_image(itk.imread(str(name))))
    assert truth["camera"] is None and truth["condition"] == 2
