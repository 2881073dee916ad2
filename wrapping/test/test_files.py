# ==========================================================================
#
#   Copyright the ITKSensorNoise contributors
#
#   Licensed under the Apache License, Version 2.0 (the "License");
#   you may not use this file except in compliance with the License.
#   You may obtain a copy of the License at
#
#          https://www.apache.org/licenses/LICENSE-2.0.txt
#
#   Unless required by applicable law or agreed to in writing, software
#   distributed under the License is distributed on an "AS IS" BASIS,
#   WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
#   See the License for the specific language governing permissions and
#   limitations under the License.
#
# ==========================================================================*/
"""Frames from files: read a few at a time, and refused by name before a pixel is read."""

import itk
import numpy as np
import pytest

# What the kernel counts for one process alone: ru_maxrss of a child holds its parent's peak.
PEAK = """
def peak():
    with open("/proc/self/status") as status:
        return next(int(line.split()[1]) for line in status if line.startswith("VmHWM")) / 1024
"""


def write(folder, frames, extension="mha"):
    names = [folder / f"{number:03}.{extension}" for number in range(len(frames))]
    for name, frame in zip(names, frames):
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


def refused(names, first_words):
    with pytest.raises(ValueError) as error:
        itk.estimate_sensor_noise(names)
    assert str(error.value).splitlines()[0].startswith(first_words)


def test_other_size_is_refused_by_name(names, burst):
    itk.imwrite(itk.image_from_array(burst[0, :, 3:].copy()), str(names[3]))
    refused(names, f"{names[3]}: has 125 x 96 pixels, but {names[0]} has 128 x 96 pixels; expected one size for all")


def test_other_type_is_refused_by_name(names, burst):
    itk.imwrite(itk.image_from_array(burst[0].astype(np.uint8)), str(names[2]))
    refused(names, f"{names[2]}: has pixels of type uint8, but {names[0]} has uint16; expected one type for all")


def test_type_that_would_be_cut_is_refused_by_name(names, burst):
    itk.imwrite(itk.image_from_array(burst[0].astype(np.uint32) * 70000), str(names[0]))
    refused(names, f"{names[0]}: has pixels of type unsigned int; expected uint8, uint16")


def test_colour_is_refused_by_name(tmp_path):
    colour = itk.image_from_array(np.zeros((8, 9, 3), np.uint8), is_vector=True)
    itk.imwrite(colour, str(tmp_path / "colour.png"))
    refused([tmp_path / "colour.png"] * 6, f"{tmp_path}/colour.png: has 3 components a pixel; expected 1 grey value")


def test_missing_file_is_refused_by_name(names):
    names[4].unlink()
    refused(names, f"{names[4]}: does not exist; expected an image file")


def test_folder_empty_file_and_other_file_are_refused_by_name(tmp_path):
    refused([tmp_path], f"{tmp_path}: is a folder; expected an image file")
    empty = tmp_path / "empty.tif"
    empty.touch()
    refused(empty, f"{empty}: has 0 bytes; expected an image file")
    text = tmp_path / "notes.txt"
    text.write_text("not an image")
    refused(text, f"{text}: not an image of a format that ITK reads; expected TIFF")


def test_stack_among_frames_is_refused_by_name(names, burst):
    itk.imwrite(itk.image_view_from_array(burst[:7]), str(names[1]))
    refused(names, f"{names[1]}: holds 7 frames, and 6 files were given; expected one stack alone, or one frame a file")


def test_lines_are_refused(tmp_path):
    refused(write(tmp_path, np.ones((6, 1, 9), np.uint8)), f"{tmp_path}/000.mha: has 9 x 1 pixels; expected at least")


def test_truncated_pixels_are_what_itk_throws(names):
    names[5].write_bytes(names[5].read_bytes()[:-1000])
    with pytest.raises(RuntimeError) as error:
        itk.estimate_sensor_noise(names)
    assert "005.mha" in str(error.value).splitlines()[0]


def test_memory_stays_flat_for_a_list_of_files(fresh, tmp_path):
    """512 x 512 x 2 bytes: 400 frames are 200 MiB, 100 are 50. One chunk has at most 64 MiB."""
    frames = np.random.default_rng(1).integers(100, 1000, (20, 512, 512), dtype=np.uint16)
    files = write(tmp_path, frames)
    code = PEAK + (
        "import itk, sys\n"
        "itk.estimate_sensor_noise(sys.argv[2:] * int(sys.argv[1]), rolling_shutter='off')\n"
        "print(peak())"
    )
    few, many = (float(fresh(code, repeats, *files)) for repeats in (5, 20))
    # 14 MiB more for the chunk, and as much again for what the allocator does not give back.
    assert many - few < 28


@pytest.mark.parametrize("make", ["stack", "list(stack)", "itk.image_view_from_array(stack)"])
def test_array_in_memory_is_not_copied(fresh, make):
    """A stack of 200 MiB; the memory of the estimate is taken by a first one; of a list, two chunks of up to 64 MiB."""
    code = PEAK + (
        "import itk, numpy as np\n"
        "itk.estimate_sensor_noise(np.random.default_rng(1).integers(9, 90, (6, 512, 512), dtype=np.uint16))\n"
        "stack = np.random.default_rng(1).integers(100, 1000, (400, 512, 512), dtype=np.uint16)\n"
        f"before = peak(); itk.estimate_sensor_noise({make}, rolling_shutter='off'); print(peak() - before)"
    )
    assert float(fresh(code)) < (150 if make.startswith("list") else 30)
