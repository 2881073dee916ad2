# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests frames in files: they are read a few at a time, and rejected by name before a pixel is read."""

import itk
import numpy as np
import pytest

# Peak memory of one process in the kernel: ru_maxrss of a child includes the peak of its parent.
PEAK = """
def peak():
    with open("/proc/self/status") as status:
        return next(int(line.split()[1]) for line in status if line.startswith("VmHWM")) / 1024
"""


def write(folder, frames, extension="mha"):
    names = [folder / f"{number:03}.{extension}" for number in range(len(frames))]
    for name, frame in zip(names, frames, strict=True):
        itk.imwrite(itk.image_from_array(frame), str(name))
    return names


@pytest.mark.parametrize("extension", ["mha", "tif", "png", "nrrd"])
def test_files_give_the_report_of_the_array(burst, tmp_path, extension):
    expected = itk.estimate_sensor_noise(burst)
    assert itk.estimate_sensor_noise(write(tmp_path, burst, extension)) == expected


@pytest.mark.parametrize("extension", ["mha", "nrrd", "tif"])
@pytest.mark.parametrize("make", [str, lambda name: name, lambda name: [str(name)]])
def test_one_stack_file(burst, tmp_path, extension, make):
    name = tmp_path / f"stack.{extension}"
    itk.imwrite(itk.image_view_from_array(burst), str(name))
    assert itk.estimate_sensor_noise(make(name)) == itk.estimate_sensor_noise(burst)


@pytest.fixture
def names(burst, tmp_path):
    return write(tmp_path, burst[:6])


def message_of(kind, function, *arguments, **parameters):
    """Returns the message of an error: one sentence without a source location and without the text of SWIG."""
    with pytest.raises(kind) as error:
        function(*arguments, **parameters)
    text = str(error.value)
    assert "\n" not in text and ".hxx" not in text and ".cxx" not in text and "in method" not in text
    return text


def refused(names, first_words):
    text = message_of(ValueError, itk.estimate_sensor_noise, names)
    assert text.startswith(first_words), text


def test_other_size_is_refused_by_name(names, burst):
    itk.imwrite(itk.image_from_array(burst[0, :, 3:].copy()), str(names[3]))
    refused(names, f"{names[3]}: 125 x 96 pixels, but {names[0]} has 128 x 96; all frames must have the same size")


def test_other_type_is_refused_by_name(names, burst):
    itk.imwrite(itk.image_from_array(burst[0].astype(np.uint8)), str(names[2]))
    refused(names, f"{names[2]}: component type unsigned char, but {names[0]} has unsigned short; all frames must")


def test_wider_type_of_the_first_file_cuts_no_other(names, burst):
    itk.imwrite(itk.image_from_array(burst[0].astype(np.uint32) * 70000), str(names[0]))
    refused(names, f"{names[1]}: component type unsigned short, but {names[0]} has ")


def test_colour_is_refused_by_name(tmp_path):
    colour = itk.image_from_array(np.zeros((8, 9, 3), np.uint8), is_vector=True)
    itk.imwrite(colour, str(tmp_path / "colour.png"))
    refused([tmp_path / "colour.png"] * 6, f"{tmp_path}/colour.png: ")


def test_missing_file_is_refused_by_name(names):
    names[4].unlink()
    refused(names, f"{names[4]}: does not exist")


def test_folder_empty_file_and_other_file_are_refused_by_name(tmp_path):
    refused([tmp_path], f"{tmp_path}: is a folder")
    empty = tmp_path / "empty.tif"
    empty.touch()
    refused(empty, f"{empty}: has 0 bytes")
    text = tmp_path / "notes.txt"
    text.write_text("not an image")
    refused(text, f"{text}: ")


def test_stack_among_frames_is_refused_by_name(names, burst):
    itk.imwrite(itk.image_view_from_array(burst[:7]), str(names[1]))
    refused(names, f"{names[1]}: has 7 frames, but {names[0]} has one; expected stacks alone, or one frame a file")


def test_lines_are_refused_as_those_of_an_array(tmp_path):
    lines = np.ones((6, 1, 9), np.uint8)
    expected = message_of(ValueError, itk.estimate_sensor_noise, lines)
    assert message_of(ValueError, itk.estimate_sensor_noise, write(tmp_path, lines)) == expected


def test_a_file_that_is_there_twice_is_warned_of(names):
    with pytest.warns(UserWarning, match=f"{names[2]}: is given twice, the second time as {names[2]}; expected each"):
        itk.estimate_sensor_noise([*names, names[2]])


def test_truncated_pixels_are_refused_by_name(names):
    names[5].write_bytes(names[5].read_bytes()[:-1000])
    refused(names, f"{names[5]}: ")


def test_name_that_is_not_utf8_is_refused(names):
    refused([*names, b"caf\xe9.mha".decode(errors="surrogateescape")], "'caf\\udce9.mha': a name that is not UTF-8")


def test_wrong_parameter_is_described(burst):
    text = message_of(ValueError, itk.sensor_noise_estimator, burst, bit_depth="many")
    assert text == "bit_depth is 'many'; expected a whole number, 0 or more"


@pytest.mark.parametrize("extension", ["mha", "tif", "png", "nrrd"])
def test_every_format_is_found_in_a_fresh_interpreter_without_a_word(fresh, burst, tmp_path, extension):
    code = "import itk, sys; print(itk.estimate_sensor_noise(sys.argv[1:])['frames'])"
    assert fresh(code, *write(tmp_path, burst[:6], extension)) == "6\n"


def test_unknown_tags_of_a_tiff_print_nothing(names, burst, capfd, tmp_path):
    file = write(tmp_path, burst[:1], "tif")[0]
    data = bytearray(file.read_bytes())
    start = int.from_bytes(data[4:8], "little")
    # The last entry, with any tag, gets an unknown tag: libtiff warns of it.
    count = int.from_bytes(data[start : start + 2], "little")
    entry = bytes(data[start + 2 : start + 2 + 12 * count]) + b"\xf0\xff\x03\x00\x01\x00\x00\x00\x07\x00\x00\x00"
    end = len(data)
    data[4:8] = end.to_bytes(4, "little")
    data += (count + 1).to_bytes(2, "little") + entry + b"\0\0\0\0"
    file.write_bytes(data)
    np.testing.assert_array_equal(itk.sensor_noise_frame_list_source(file), burst[:1])
    assert capfd.readouterr() == ("", "")


def test_source_in_functional_style_keeps_the_type(stack, tmp_path):
    names = write(tmp_path, stack)
    image = itk.sensor_noise_frame_list_source(names)
    np.testing.assert_array_equal(image, stack)
    assert itk.array_view_from_image(image).dtype == stack.dtype
    np.testing.assert_array_equal(itk.sensor_noise_frame_list_source(str(names[2])), stack[2:3])
    np.testing.assert_array_equal(itk.sensor_noise_frame_list_source(names, ttype=type(image)), stack)


def test_source_converts_nothing(names):
    text = message_of(ValueError, itk.sensor_noise_frame_list_source, names, ttype=itk.Image[itk.F, 3])
    assert text.startswith(f"{names[0]}: component type unsigned short, but the source's is float")


def test_source_is_asked_for_the_type_before_it_is_chosen(names):
    asked = itk.SensorNoiseFrameListSource[itk.Image[itk.UC, 3]]
    assert asked.ReadComponentType([str(name) for name in names]) == itk.CommonEnums.IOComponent_USHORT
    with pytest.raises(RuntimeError, match="no-such.tif"):
        asked.ReadComponentType(["no-such.tif"])


@pytest.fixture
def source(names):
    return itk.SensorNoiseFrameListSource[itk.Image[itk.US, 3]].New(file_names=[str(name) for name in names])


def test_source_streams(source, burst):
    monitor = itk.PipelineMonitorImageFilter.New(source.GetOutput())
    statistics = itk.TemporalStatisticsImageFilter.New(monitor.GetOutput(), number_of_stream_divisions=3)
    statistics.Update()
    assert monitor.VerifyAllInputCanStream(3)
    np.testing.assert_allclose(statistics.GetMean(), burst[:6].mean(axis=0))


def test_file_that_changes_is_refused_and_the_next_update_is_right(source, names, burst):
    source.UpdateOutputInformation()
    names[3].write_bytes(names[0].read_bytes())
    text = str(pytest.raises(RuntimeError, source.Update).value)
    assert f"{names[3]}: " in text and "changed" in text
    source.Update()
    np.testing.assert_array_equal(itk.array_from_image(source.GetOutput())[3], burst[0])


def test_mask_is_read_by_the_same_function(burst, names, tmp_path):
    mask = tmp_path / "mask.tif"
    itk.imwrite(itk.image_from_array(np.ones(burst[0].shape, np.float32)), str(mask))
    assert itk.estimate_sensor_noise(burst, mask=mask) == itk.estimate_sensor_noise(burst, mask=np.ones(burst[0].shape))
    mask.write_bytes(mask.read_bytes()[:-9])
    text = message_of(ValueError, itk.estimate_sensor_noise, burst, mask=mask)
    assert text.startswith(f"the mask {mask}: ")
    itk.imwrite(itk.image_view_from_array(burst[:3]), str(mask))
    text = message_of(ValueError, itk.estimate_sensor_noise, burst, mask=mask)
    assert text == f"the mask {mask}: has 3 frames; expected one image"


def test_dark_frames_are_read_by_the_same_function(burst, dark, tmp_path):
    names = write(tmp_path, dark)
    assert itk.estimate_sensor_noise(burst, dark=names) == itk.estimate_sensor_noise(burst, dark=dark)
    names[7].write_bytes(names[7].read_bytes()[:-1])
    assert message_of(ValueError, itk.estimate_sensor_noise, burst, dark=names).startswith(f"{names[7]}: ")


def test_memory_stays_flat_for_a_list_of_files(fresh, tmp_path):
    """Frames of 512 x 512 x 2 bytes: 400 frames have 200 MiB, 100 frames 50 MiB. One chunk has at most 32 MiB."""
    frames = np.random.default_rng(1).integers(100, 1000, (20, 512, 512), dtype=np.uint16)
    files = write(tmp_path, frames)
    code = PEAK + (
        "import itk, sys, warnings\n"
        "warnings.simplefilter('ignore')\n"  # the same files are listed several times
        "itk.estimate_sensor_noise(sys.argv[2:] * int(sys.argv[1]), rolling_shutter='off')\n"
        "print(peak())"
    )
    few, many = (float(fresh(code, repeats, *files)) for repeats in (5, 20))
    # 14 MiB more for the chunk, and as much again for memory that the allocator does not return.
    assert many - few < 28


@pytest.mark.parametrize("make", ["stack", "list(stack)", "itk.image_view_from_array(stack)"])
def test_array_in_memory_is_not_copied(fresh, make):
    """The stack has 200 MiB. A first estimate takes the memory that estimates need. A list has two chunks of up to 32
    MiB."""
    code = PEAK + (
        "import itk, numpy as np\n"
        "itk.estimate_sensor_noise(np.random.default_rng(1).integers(9, 90, (6, 512, 512), dtype=np.uint16))\n"
        "stack = np.random.default_rng(1).integers(100, 1000, (400, 512, 512), dtype=np.uint16)\n"
        f"before = peak(); itk.estimate_sensor_noise({make}, rolling_shutter='off'); print(peak() - before)"
    )
    assert float(fresh(code)) < (150 if make.startswith("list") else 30)


@pytest.mark.parametrize("chunks", ["auto", (200, 128, 128)])
def test_slices_of_arrays_by_dask_are_read_in_small_pieces(fresh, chunks):
    """A chunk of ITK has 32 MiB, a piece 8 MiB; dask concatenates copies of the pieces. All 200 frames have 100 MiB."""
    pytest.importorskip("dask.array")
    code = PEAK + (
        "import itk, pathlib, numpy as np, dask.array\n"
        "first = np.random.default_rng(1).integers(9, 90, (6, 512, 512), dtype=np.uint16)\n"
        "itk.estimate_sensor_noise(first, rolling_shutter='off', threads=1)\n"
        "stack = np.random.default_rng(1).integers(100, 1000, (200, 512, 512), dtype=np.uint16)\n"
        f"frames = dask.array.from_array(stack, chunks={chunks!r})\n"
        "del stack; pathlib.Path('/proc/self/clear_refs').write_text('5')\n"  # resets the peak
        "before = peak(); itk.estimate_sensor_noise(frames, rolling_shutter='off', threads=1); print(peak() - before)"
    )
    assert float(fresh(code)) < 100
