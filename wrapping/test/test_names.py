# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests that a pattern, a folder and a generator give the same result as the list of their names."""

import sys
from pathlib import Path

import itk
import numpy as np
import pytest


@pytest.fixture
def folder(burst, tmp_path):
    """Writes frames whose alphabetical order is wrong: frame_10 before frame_2. Returns their folder."""
    for number, frame in enumerate(burst[:12]):
        itk.imwrite(itk.image_from_array(frame), str(tmp_path / f"frame_{number}.png"))
    return tmp_path


@pytest.fixture(scope="module")
def expected(burst):
    return itk.estimate_sensor_noise(burst[:12])


MEANT = {
    "pattern": lambda folder: f"{folder}/frame_*.png",
    "pathlib": lambda folder: folder / "frame_?*.png",
    "deep pattern": lambda folder: f"{folder}/**/frame_*.png",
    "folder": str,
    "folder of pathlib": lambda folder: folder,
    "folder with /": lambda folder: f"{folder}/",
    "glob": lambda folder: folder.glob("*.png"),
    "iterdir": lambda folder: folder.iterdir(),
    "generator": lambda folder: (str(folder / f"frame_{number}.png") for number in range(12)),
    "set": lambda folder: set(folder.glob("*.png")),
}


@pytest.mark.parametrize("make", MEANT)
def test_what_means_a_list_is_the_list_in_natural_order(folder, expected, make):
    assert itk.estimate_sensor_noise(MEANT[make](folder)) == expected  # the flicker shows the order of the frames


def test_a_list_keeps_its_order(folder, expected):
    names = [folder / f"frame_{number}.png" for number in reversed(range(12))]
    assert itk.estimate_sensor_noise(names)["flicker"] == pytest.approx(expected["flicker"][::-1], abs=1e-9)


def test_all_that_reads_names_takes_a_pattern(folder, burst, expected):
    pattern = f"{folder}/*.png"
    np.testing.assert_array_equal(itk.sensor_noise_frame_list_source(pattern), burst[:12])
    assert itk.estimate_sensor_noise(pattern, frame_range=(3, 10)) == itk.estimate_sensor_noise(
        burst[:12], frame_range=(3, 10)
    )
    dark = itk.estimate_sensor_noise(burst, dark=folder)
    assert dark["settings"]["dark_frames"] == 12


def test_a_file_whose_name_is_a_pattern_is_that_file(folder, expected, burst):
    name = folder / "a[0]*.mha"
    itk.imwrite(itk.image_from_array(burst[:12]), str(name))
    assert itk.estimate_sensor_noise(name) == expected


def refused(frames, kind=ValueError):
    with pytest.raises(kind) as error:
        itk.estimate_sensor_noise(frames)
    assert "\n" not in str(error.value)
    return str(error.value)


def test_what_means_no_list_is_refused(folder, tmp_path):
    each = "expected the frames, one file each"
    assert refused(f"{folder}/*.tif") == f"{folder}/*.tif: no file matches this pattern; {each}"
    for name in ("notes.txt", "README", ".hidden"):
        (folder / name).touch()
    kinds = "(1 without an ending, 12 .png, 1 .txt)"
    assert refused(folder) == (
        f"{folder}: is a folder of files of several kinds {kinds}; expected one kind, or a pattern as '{folder}/*.png'"
    )
    (tmp_path / "empty").mkdir()
    assert refused(tmp_path / "empty") == f"{tmp_path}/empty: is a folder without files; {each}"
    assert refused(iter(())) == "frames is an empty tuple_iterator; expected file names"
    assert refused([folder]).startswith(f"{folder}: is a folder")  # a folder within a list is rejected


OTHERS = {
    "a.h5": "h5py.File(",
    "a.HDF5": "h5py.File(",
    "a.zarr": "zarr.open_array(",
    "a.fits.gz": "astropy.io.fits.open(",
    "a.nc": "xarray.open_dataset(",
    "a.mp4": "cv2.VideoCapture",
}


@pytest.mark.parametrize("name", OTHERS)
def test_formats_of_other_packages_are_refused_with_a_way_to_open_them(tmp_path, name):
    path = tmp_path / name
    path.mkdir() if name.endswith("zarr") else path.write_bytes(b"something")
    text = refused(path)
    assert text.startswith(f"{path}: ") and OTHERS[name] in text and "expected" in text
    assert refused([path, path]) == text
    assert refused(tmp_path / f"no-{name}").startswith(f"{tmp_path}/no-{name}: does not exist")


def test_maps_are_not_written_over_what_a_pattern_means(tmp_path, burst):
    for number, frame in enumerate(burst[:6]):
        itk.imwrite(itk.image_from_array(frame), str(tmp_path / ("mean.mha" if number == 0 else f"z{number}.mha")))
    with pytest.raises(ValueError, match="is the same file as"):
        itk.estimate_sensor_noise(str(tmp_path / "*.mha"), maps=tmp_path)


def test_raw_files_without_rawpy_are_refused_with_a_way_to_read_them(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "rawpy", None)
    (tmp_path / "a.dng").write_bytes(b"something")
    text = refused([tmp_path / "a.dng"] * 6, ImportError)
    assert text == f"{tmp_path}/a.dng: raw files of cameras are read by rawpy: pip install itk-sensornoise[raw]"
    assert refused(Path("no-such.nef")) == "no-such.nef: does not exist"
