# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests that any object with a shape, a dtype and slices along time is read a few frames at a time."""

import os
import signal

import itk
import itk_sensornoise as sn
import numpy as np
import pytest

# Peak memory of one process in the kernel: ru_maxrss of a child includes the peak of its parent.
PEAK = """
import sys, itk, numpy as np
def peak():
    with open("/proc/self/status") as status:
        return next(int(line.split()[1]) for line in status if line.startswith("VmHWM")) / 1024
"""


class Sliced:
    """Lazy frames with the minimum of attributes. `asked` has the slices that were read."""

    def __init__(self, frames, wrong=None):
        self.frames, self.wrong, self.asked = frames, wrong, []
        self.shape, self.dtype = frames.shape, frames.dtype

    def __getitem__(self, times):
        self.asked.append((times.start, times.stop))
        return self.frames[times] if self.wrong is None else self.wrong(self.frames[times])


@pytest.fixture(scope="module")
def expected(burst):
    return itk.estimate_sensor_noise(burst)


def of_memmap(burst, folder):
    np.save(folder / "a.npy", burst)
    return np.load(folder / "a.npy", mmap_mode="r")


def of_private_memmap(burst, folder):
    """Returns a copy-on-write memmap. Its changes are only in memory, and must be measured."""
    np.save(folder / "a.npy", np.zeros_like(burst))
    frames = np.load(folder / "a.npy", mmap_mode="c")
    frames[...] = burst
    return frames


def of_big_endian_memmap(burst, folder):
    np.save(folder / "a.npy", burst.astype(">u2"))
    return np.load(folder / "a.npy", mmap_mode="r+")


def of_time_last_memmap(burst, folder):
    np.save(folder / "a.npy", np.ascontiguousarray(np.moveaxis(burst, 0, 2)))
    return np.moveaxis(np.load(folder / "a.npy", mmap_mode="r"), 2, 0)


def of_h5py(burst, folder, **parameters):
    h5py = pytest.importorskip("h5py")
    h5py.File(folder / "a.h5", "w").create_dataset("frames", data=burst, **parameters).file.close()
    return h5py.File(folder / "a.h5")["frames"]


def of_zarr(burst, folder, **parameters):
    zarr = pytest.importorskip("zarr")
    frames = zarr.open_array(
        str(folder / "a.zarr"), mode="w", shape=burst.shape, chunks=(7, 50, 60), dtype=burst.dtype, **parameters
    )
    frames[...] = burst
    return zarr.open_array(str(folder / "a.zarr"), mode="r")


def of_shards(burst, folder):
    zarr = pytest.importorskip("zarr", "3")
    name = str(folder / "a.zarr")
    frames = zarr.create_array(name, shape=burst.shape, chunks=(5, 96, 128), shards=(20, 96, 128), dtype=burst.dtype)
    frames[...] = burst
    return frames


def of_dask(burst, folder):
    return pytest.importorskip("dask.array").from_array(burst, chunks=(7, 50, 60))


def of_xarray(burst, folder):
    data = pytest.importorskip("dask.array").from_array(np.moveaxis(burst, 0, 2), chunks=(50, 60, 7))
    return pytest.importorskip("xarray").DataArray(data, dims=("y", "x", "time"))


def of_fits(burst, folder):
    fits = pytest.importorskip("astropy.io.fits")
    fits.PrimaryHDU(burst).writeto(folder / "a.fits")
    return fits.open(folder / "a.fits", memmap=False)[0].section


def of_tiff(burst, folder):
    tifffile, zarr = pytest.importorskip("tifffile"), pytest.importorskip("zarr")
    tifffile.imwrite(folder / "a.tif", burst, photometric="minisblack")
    return zarr.open_array(tifffile.TiffFile(folder / "a.tif").aszarr(), mode="r")


LAZY = {
    "least": lambda burst, folder: Sliced(burst),
    "memmap": of_memmap,
    "private memmap": of_private_memmap,
    "big-endian memmap": of_big_endian_memmap,
    "memmap, time last": of_time_last_memmap,
    "part of a memmap": lambda burst, folder: of_memmap(np.repeat(burst, 2, 0), folder)[::2],
    "h5py": of_h5py,
    "h5py chunks": lambda burst, folder: of_h5py(burst, folder, chunks=(7, 50, 60), compression="gzip"),
    "zarr 2": lambda burst, folder: of_zarr(burst, folder, zarr_format=2),
    "zarr 3": lambda burst, folder: of_zarr(burst, folder, zarr_format=3),
    "zarr shards": of_shards,
    "dask": of_dask,
    "xarray": of_xarray,
    "FITS": of_fits,
    "TIFF as zarr": of_tiff,
    "list of dask": lambda burst, folder: list(of_dask(burst, folder)),
    "list of sliced": lambda burst, folder: list(of_dask(burst, folder).persist()),
}


@pytest.mark.parametrize("kind", LAZY)
def test_lazy_frames_give_the_bits_of_the_array(burst, expected, tmp_path, kind):
    assert itk.estimate_sensor_noise(LAZY[kind](burst, tmp_path)).to_json() == expected.to_json()


def test_lazy_frames_of_each_pixel_type(stack):
    assert itk.estimate_sensor_noise(Sliced(stack)) == itk.estimate_sensor_noise(stack)


@pytest.mark.parametrize("piece", [1, 7, 33])
def test_any_pieces_and_chunks_give_the_same_bits(burst, expected, monkeypatch, piece):
    monkeypatch.setattr("itk_sensornoise._lazy._PIECE_BYTES", piece * burst[0].nbytes)
    frames = Sliced(burst)
    assert itk.estimate_sensor_noise(frames) == expected
    assert max(end - first for first, end in frames.asked) == piece


def test_what_is_stored_together_is_read_once(burst):
    frames = Sliced(burst)
    frames.chunks = (25, 96, 128)
    itk.estimate_sensor_noise(frames)
    assert frames.asked == [(0, 60)]  # one chunk of ITK: all three passes use it
    frames.chunks = ((350, 50), (96,), (128,))
    itk.estimate_sensor_noise(frames)


def test_options_hold_for_lazy_frames(burst, dark):
    parameters = {"roi": (8, 4, 100, 80), "frame_range": (3, 50), "mask": burst[0] > 0, "maps": True}
    found = itk.estimate_sensor_noise(Sliced(burst), dark=Sliced(dark), **parameters)
    expected = itk.estimate_sensor_noise(burst, dark=dark, **parameters)
    assert found == expected
    np.testing.assert_array_equal(found.maps["pixel_read_noise"], expected.maps["pixel_read_noise"])


def test_all_that_takes_frames_takes_lazy_ones(burst, expected):
    frames = Sliced(burst)
    assert itk.noise_correlation_estimator(frames) == itk.noise_correlation_estimator(burst)
    assert itk.check_noise_model(frames, expected) == itk.check_noise_model(burst, expected)
    assert itk.sensor_noise_estimator(frames) == expected
    for found, of_array in zip(*map(itk.temporal_statistics_image_filter, (frames, burst)), strict=True):
        np.testing.assert_array_equal(found, of_array)


def masked_dask(burst, folder):
    array = pytest.importorskip("dask.array")
    return array.ma.masked_greater(array.from_array(burst, chunks=(7, 50, 60)), 3000)


MASKED = {
    "dask": masked_dask,
    "list of dask": lambda burst, folder: list(masked_dask(burst, folder)),
    "memmap": lambda burst, folder: np.ma.masked_greater(of_memmap(burst, folder), 3000),
}


@pytest.mark.parametrize("kind", MASKED)
def test_masked_pixels_of_lazy_frames_are_refused(burst, tmp_path, kind):
    frames = MASKED[kind](burst, tmp_path)
    name = r"frames\[0\]" if kind.startswith("list") else "frames"
    with pytest.raises(
        TypeError, match=f"^{name} is a masked array, expected a plain one: give its data, and a mask by"
    ):
        itk.estimate_sensor_noise(frames)
    name = name.replace("frames", "stack")
    with pytest.raises(TypeError, match=f"^{name} is a masked array, expected a plain one: fill in the masked pixels"):
        itk.temporal_statistics_image_filter(frames)
    if kind == "dask":
        with pytest.raises(TypeError, match="^dark is a masked array, expected a plain one"):
            itk.estimate_sensor_noise(burst, dark=frames)
        with pytest.raises(TypeError, match="^first_frame is a masked array, expected a plain one"):
            sn.SensorNoiseSums(burst.shape, burst.dtype, first_frame=frames[0])


def test_a_mask_of_dask_that_masks_nothing_is_ignored(burst, expected):
    array = pytest.importorskip("dask.array")
    frames = array.ma.masked_array(array.from_array(burst, chunks=(7, 50, 60)), mask=False)
    assert itk.estimate_sensor_noise(frames) == expected


def refused(frames, **parameters):
    with pytest.raises(ValueError) as error:
        itk.estimate_sensor_noise(frames, **parameters)
    assert "\n" not in str(error.value)
    return str(error.value)


def test_other_shapes_and_types_are_refused_before_a_frame_is_read(burst):
    frames = Sliced(burst[None])
    assert refused(frames).startswith("frames has 4 dimensions, shape (1, 60, 96, 128); expected 3, the axes (t, y, x)")
    assert not frames.asked
    assert refused(Sliced(burst.astype(np.int64))).startswith("frames has dtype int64; expected uint8")
    assert refused(Sliced(burst[:0])).startswith("frames has shape (0, 96, 128), which holds no pixel")
    assert refused(burst, dark=Sliced(burst[0])).startswith("dark has 2 dimensions")


@pytest.mark.parametrize("wrong", [lambda part: part[1:], lambda part: part.astype(np.int32), lambda part: part[0]])
def test_frames_that_are_not_as_they_said_are_refused(burst, wrong):
    assert refused(Sliced(burst, wrong)).startswith("frames[0:60] has shape ")


@pytest.mark.parametrize("parameters", [{}, {"roi": (1, 2, 50, 60)}])
def test_what_a_reader_raises_is_raised(burst, capfd, parameters):
    class CannotRead(Exception):
        pass

    def wrong(part):
        raise CannotRead("the disk is gone")

    for _ in range(2):
        with pytest.raises(CannotRead, match="the disk is gone"):
            itk.estimate_sensor_noise(Sliced(burst, wrong), **parameters)
        with pytest.raises(CannotRead):
            itk.estimate_sensor_noise(burst, dark=Sliced(burst, wrong), **parameters)
        with pytest.raises(CannotRead):
            itk.temporal_statistics_image_filter(Sliced(burst, wrong))
    assert capfd.readouterr() == ("", "")


def test_ctrl_c_while_a_reader_reads(burst):
    def interrupt(part):
        os.kill(os.getpid(), signal.SIGINT)
        return part

    before = signal.signal(signal.SIGINT, signal.default_int_handler)  # a background job ignores SIGINT
    try:
        with pytest.raises(KeyboardInterrupt):
            itk.estimate_sensor_noise(Sliced(burst, interrupt))
    finally:
        signal.signal(signal.SIGINT, before)


AXES = [("t", "y", "x"), ("x", "y", "frame"), ("Row", "TIME", "Column"), ("y", "x", "anything"), ("z", "y", "x")]


@pytest.mark.parametrize("dims", AXES)
def test_names_of_axes_are_honoured(burst, expected, dims):
    xarray = pytest.importorskip("xarray")
    order = [next((k for k, known in enumerate("tyx") if known == dim.lower()[0]), 0) for dim in dims]
    order = [1 if dim == "Row" else 2 if dim == "Column" else axis for dim, axis in zip(dims, order, strict=True)]
    assert itk.estimate_sensor_noise(xarray.DataArray(burst.transpose(order), dims=dims)) == expected


def test_axes_of_one_element_are_left_out_and_unclear_ones_refused(burst, expected):
    xarray = pytest.importorskip("xarray")
    five = xarray.DataArray(burst[:, None, None], dims=("t", "c", "z", "y", "x"))
    assert itk.estimate_sensor_noise(five) == expected
    assert itk.estimate_sensor_noise(xarray.DataArray(burst)) == expected  # dim_0, dim_1, dim_2
    text = refused(xarray.DataArray(burst, dims=("y", "rows", "x")))
    assert text.startswith("frames has the axes ('y', 'rows', 'x'), which do not show which axis is time; expected")


@pytest.mark.parametrize("zarr_format", [2, 3])
@pytest.mark.parametrize("wrap", ["plain", "dask", "xarray"])
def test_missing_chunks_of_zarr_are_an_error(burst, tmp_path, zarr_format, wrap):
    frames = of_zarr(burst, tmp_path, zarr_format=zarr_format)
    chunk = tmp_path / "a.zarr" / ("3.0.0" if zarr_format == 2 else "c/3/0/0")
    chunk.unlink()
    if wrap == "dask":
        frames = pytest.importorskip("dask.array").from_zarr(frames)[2:]
    if wrap == "xarray":
        frames = pytest.importorskip("xarray").DataArray(pytest.importorskip("dask.array").from_zarr(frames))
    text = refused(frames)
    assert text.startswith("frames: 1 of the 54 chunks of the Zarr array were never written, and would be read as fill")
    assert refused(burst, dark=frames).startswith("dark: 1 of the 54 chunks")


def test_chunks_of_hdf5_that_were_never_written_are_an_error(burst, tmp_path):
    h5py = pytest.importorskip("h5py")
    with h5py.File(tmp_path / "a.h5", "w") as file:
        frames = file.create_dataset("chunks", shape=burst.shape, dtype="u2", chunks=(10, 96, 128))
        frames[:30] = burst[:30]
        assert refused(frames).startswith("frames: 3 of the 6 chunks of the HDF5 dataset were never written")
        none = file.create_dataset("none", shape=burst.shape, dtype="u2")
        assert refused(none).startswith("frames: the HDF5 dataset was never written")
        layout = h5py.VirtualLayout(shape=burst.shape, dtype="u2")
        layout[:] = h5py.VirtualSource("gone.h5", "frames", shape=burst.shape)
        virtual = file.create_virtual_dataset("virtual", layout)
        assert refused(virtual) == "frames: gone.h5, a part of the virtual dataset, is missing"
    assert refused(frames) == "frames is a dataset of a closed HDF5 file; expected an open one"


MAKE = {
    "memmap": """
frames = np.lib.format.open_memmap(name, "w+", "u2", (count, 512, 512))
for first in range(0, count, 50): frames[first:first + 50] = part
frames.flush()
""",
    "h5py": """
import h5py
frames = h5py.File(name, "w").create_dataset("x", (count, 512, 512), "u2", chunks=(10, 512, 512))
for first in range(0, count, 50): frames[first:first + 50] = part
frames.file.close()
""",
    "zarr": """
import zarr
frames = zarr.open_array(name, mode="w", shape=(count, 512, 512), dtype="u2", chunks=(10, 512, 512))
for first in range(0, count, 50): frames[first:first + 50] = part
""",
}
OPEN = {
    "memmap": "np.load(name, mmap_mode='r')",
    "h5py": "__import__('h5py').File(name)['x']",
    "zarr": "__import__('zarr').open_array(name, mode='r')",
    "dask": "__import__('dask.array').array.from_zarr(name)",
}


@pytest.mark.parametrize("kind", OPEN)
def test_memory_stays_flat(fresh, tmp_path, kind):
    """Frames that are added take a fraction of their size. ITK requests up to 64 frames at a time, and readers keep
    memory that they freed: 56 MiB was seen with Zarr. Whole frames in memory would take all of their size, or more."""
    pytest.importorskip({"memmap": "numpy", "dask": "dask.array"}.get(kind, kind))
    stored = "zarr" if kind == "dask" else kind
    pytest.importorskip({"memmap": "numpy"}.get(stored, stored))
    make = PEAK + (
        "name, count = sys.argv[1], int(sys.argv[2])\n"
        "part = np.random.default_rng(1).integers(100, 1000, (50, 512, 512), dtype=np.uint16)\n"
    )
    code = PEAK + f"name = sys.argv[1]\nitk.estimate_sensor_noise({OPEN[kind]}, rolling_shutter='off'); print(peak())"
    counts, peaks = (100, 700), []
    for count in counts:
        name = tmp_path / f"{count}.npy"
        fresh(make + MAKE[stored], name, count)
        peaks.append(float(fresh(code, name)))
    added = (counts[1] - counts[0]) * 512 * 512 * 2 / 2**20  # [MiB]
    assert peaks[1] - peaks[0] < 0.4 * added, (peaks, added)
