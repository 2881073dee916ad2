# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests SensorNoiseSums: sums of parts of the frames, merged in any order, give the same bits as one sum."""

import pickle

import itk
import numpy as np
import pytest
from itk_sensornoise import SensorNoiseSums


def runs_of(frames: int, count: int) -> list[list[int]]:
    return [list(map(int, part)) for part in np.array_split(np.arange(frames), count)]


def in_turn(frames: int, count: int) -> list[list[int]]:
    return [list(range(first, frames, count)) for first in range(count)]


def measure_in_parts(stack, parts, order=1, **settings):
    """Returns a driver after all passes. Each part of the frames is added to a pickled copy of the driver, as in
    another process. The driver merges the sums of the copies."""
    driver = SensorNoiseSums(stack.shape, stack.dtype, **settings)
    while not driver.is_done:
        sent = []
        for part in parts:
            process = pickle.loads(pickle.dumps(driver))
            for number in part[::order]:
                process.add(stack[number : number + 1], number)
            sent.append(process.to_bytes())
        for sums in sent[::order]:
            assert driver.merge(sums)
        driver.end_pass()
    return driver


@pytest.mark.parametrize("count", range(1, 8))
@pytest.mark.parametrize("cut", [runs_of, in_turn])
def test_parts_of_integers_give_the_bits_of_the_whole(grey_values, count, cut):
    stack = grey_values.astype(np.uint16)
    expected = itk.estimate_sensor_noise(stack, maps=True)
    report = measure_in_parts(stack, cut(len(stack), count), bayer="none").report(maps=True)
    assert report.to_json() == expected.to_json() and str(report) == str(expected)
    for name, values in expected.maps.items():
        np.testing.assert_array_equal(report.maps[name], values)


@pytest.mark.parametrize("method", ["refined", "published"])
def test_frames_unlike_the_others_are_left_out_by_all(grey_values, method):
    stack = grey_values.astype(np.uint16)
    stack[4], stack[30] = 0, 60  # frames without noise
    expected = itk.estimate_sensor_noise(stack, method=method, bayer="none")
    sums = measure_in_parts(stack, in_turn(len(stack), 3), bayer="none", method=method)
    report = sums.report()
    assert report == expected and sums.passes_ended == 4
    assert report["frames_left_out"] == [{"frame": t, "reason": "no-noise"} for t in (4, 30)]
    assert report["warnings"][0]["code"] == "frames-left-out" and report["flicker"][4] is None
    others = itk.estimate_sensor_noise(np.delete(stack, [4, 30], axis=0), method=method, bayer="none")
    assert report["gain"] == others["gain"] and others["frames_left_out"] == []


@pytest.mark.parametrize("method", ["refined", "published"])
def test_each_pixel_type(stack, method):
    expected = itk.estimate_sensor_noise(stack, method=method, bayer="none")
    parts = in_turn(len(stack), 3)
    report = measure_in_parts(stack, parts, bayer="none", method=method).report()
    if stack.dtype.kind == "f":
        # The sums are in another order: the last digits of a double differ. They also decide which pixels of equal mean
        # "published" takes into its sets. These frames have many pixels of equal mean, so the result varies by chance,
        # far below the error of the gain of some per cent.
        rounding = 1e-9 if method == "refined" else 1e-4
        assert report["gain"]["value"] == pytest.approx(expected["gain"]["value"], rel=rounding)
        assert measure_in_parts(stack, parts, bayer="none", method=method).report() == report
    else:
        assert report == expected
        assert measure_in_parts(stack, parts, -1, bayer="none", method=method).report() == expected


def test_settings_are_those_of_the_function(burst, dark):
    mask = burst[0] > np.median(burst[0]) / 2
    settings = {"roi": (8, 4, 100, 80), "mask": mask, "dark": dark, "clip": (0, 4095), "bit_depth": 12, "threads": 1}
    expected = itk.estimate_sensor_noise(burst, maps=True, **settings)
    sums = measure_in_parts(burst, runs_of(60, 2), first_frame=burst[0], **settings)
    assert sums.report() == expected
    assert set(sums.report(maps=True).maps) == set(expected.maps)
    part = itk.estimate_sensor_noise(burst, frame_range=(10, 50))
    assert measure_in_parts(burst[10:50], runs_of(40, 2), first_frame=burst[0], frame_range=(10, 50)).report() == part


@pytest.mark.parametrize("bayer", ["auto", "GRBG", "file"])
def test_mosaics(bayer):
    stack = itk.simulate_sensor_noise(frames=30, size=(128, 96), bayer="GRBG", seed=4)[0]
    frames, settings = stack, {"bayer": bayer, "first_frame": stack[0]}
    if bayer == "file":
        frames = itk.image_view_from_array(stack)
        frames["SensorNoise.BayerPattern"] = "GRBG"
        settings = {"metadata": {"SensorNoise.BayerPattern": "GRBG"}}
    expected = itk.estimate_sensor_noise(frames, bayer="GRBG" if bayer == "GRBG" else "auto")
    report = measure_in_parts(stack, in_turn(30, 2), **settings).report()
    assert report == expected and "channels" in report


def test_sums_that_come_twice_are_ignored_and_overlaps_refused(grey_values):
    sums = SensorNoiseSums(grey_values.shape, grey_values.dtype, bayer="none")
    other = SensorNoiseSums(grey_values.shape, grey_values.dtype, bayer="none")
    sums.add(grey_values[:10])
    other.add(grey_values[30:], 30)
    assert sums.merge(other) and not sums.merge(other) and not sums.merge(other.to_bytes())
    np.testing.assert_array_equal(sums.frames, [*range(10), *range(30, 40)])
    before = sums.to_bytes()
    other.add(grey_values[9:11], 9)
    with pytest.raises(ValueError, match="both hold frame 9"):
        sums.merge(other)
    with pytest.raises(ValueError, match="frame 8 was added before"):
        sums.add(grey_values[7:9], 7 + 1)
    assert sums.to_bytes() == before
    with pytest.raises(
        ValueError, match=r"^frames 10, 11, 12, 13, 14, ... \(20 in all\) are missing in pass 1; expected"
    ):
        sums.end_pass()
    sums.add(grey_values[10:29], 10)
    with pytest.raises(ValueError, match="^frame 29 is missing in pass 1; expected all 40"):
        sums.end_pass()


def test_a_run_goes_on_from_a_pickle_and_from_bytes(grey_values):
    sums = SensorNoiseSums(grey_values.shape, grey_values.dtype, bayer="none")
    sums.add(grey_values)
    sums.end_pass()
    sums.add(grey_values[:25])
    kept = pickle.dumps(sums)
    text = sums.to_bytes()
    again = pickle.loads(kept)
    assert repr(again) == "<SensorNoiseSums: pass 2, 25 of 40 frames of 96 x 64 pixels>"
    again.forget()
    assert not len(again.frames)
    again.from_bytes(text)
    again.add(grey_values[25:], 25)
    again.end_pass()
    again.add(grey_values)
    again.end_pass()
    done = pickle.loads(pickle.dumps(again))
    assert done.report() == again.report() == itk.estimate_sensor_noise(grey_values)
    assert "all passes ended" in repr(done)
    with pytest.raises(ValueError, match="all passes have ended"):
        done.to_bytes()
    sums.drop_history()
    with pytest.raises(ValueError, match="cannot be pickled"):
        pickle.dumps(sums)


def test_equal_frames_in_two_hands(grey_values):
    stack = grey_values.copy()
    stack[30] = stack[4]
    expected = itk.estimate_sensor_noise(stack)
    one, two = (SensorNoiseSums(grey_values.shape, grey_values.dtype, bayer="none") for _ in range(2))
    one.add(stack[:20])
    two.add(stack[20:], 20)
    with pytest.raises(ValueError, match="frame 30 equals frame 4, and each was counted by another process"):
        one.merge(two)
    assert (one.fingerprints[4] == two.fingerprints[10]).all()
    assert (one.fingerprints[5] != two.fingerprints[10]).all()
    two.forget()
    two.leave(np.arange(40)[None] == 30)
    two.add(stack[20:], 20)
    one.merge(two)
    for passes_ended in range(3):
        assert one.passes_ended == passes_ended
        if passes_ended:
            one.add(stack)
        one.end_pass()
    assert one.report() == expected


def test_little_is_sent_of_few_frames(grey_values):
    """Pass 1 sends 20 bytes per pixel, and some bytes for each added frame, not for all frames. Pass 2 is similar."""
    sums = SensorNoiseSums((4000, 64, 96), "uint8", bayer="none")
    sums.add(grey_values[:5], 100)
    assert len(sums.to_bytes()) < 20 * 64 * 96 + 5 * 2600 + 4000 * 1.1
    full = SensorNoiseSums(grey_values.shape, grey_values.dtype, bayer="none")
    full.add(grey_values)
    full.end_pass()
    full.add(grey_values[7:8], 7)
    of_one = len(full.to_bytes())
    full.add(grey_values[:7])
    full.add(grey_values[8:], 8)
    assert 10 * of_one < len(full.to_bytes())


def test_files_and_lazy_frames(grey_values, tmp_path):
    names = [tmp_path / f"{number:02}.mha" for number in range(40)]
    for name, frame in zip(names, grey_values, strict=True):
        itk.imwrite(itk.image_view_from_array(frame), str(name))
    np.save(tmp_path / "a.npy", grey_values)
    lazy = np.load(tmp_path / "a.npy", mmap_mode="r")
    sums = SensorNoiseSums(grey_values.shape, grey_values.dtype, bayer="none", roi=(4, 2, 80, 50))
    while not sums.is_done:
        sums.add(names[:7])
        sums.add(lazy, 7, frame_range=(7, 30))
        sums.add(names, 30, frame_range=(30, 40))
        sums.end_pass()
    assert sums.report() == itk.estimate_sensor_noise(grey_values, roi=(4, 2, 80, 50))


def test_wrong_use_is_refused(grey_values):
    def refused(pattern, *given, **settings):
        with pytest.raises(ValueError, match=pattern):
            SensorNoiseSums(*given, **settings)

    refused(r"shape is \(40, 64\); expected \(t, y, x\)", (40, 64), "uint8")
    refused("dtype is int64; expected uint8", (40, 64, 96), "int64")
    refused("frames; expected at least 5", (4, 64, 96), "uint8", bayer="none")
    refused("expected at most 4194304", ((1 << 22) + 1, 3, 3), "uint8", bayer="none")
    refused('the Bayer pattern is "auto" and the stack\'s metadata do not have it', grey_values.shape, "uint8")
    refused("method is 'x'", grey_values.shape, "uint8", method="x")
    sums = SensorNoiseSums(grey_values.shape, grey_values.dtype, bayer="none")
    for frames, first, pattern in [
        (grey_values, 1, "the number of frames is 40; expected a whole number from 1 to 39"),
        (grey_values, 40, "first is 40"),
        (grey_values[:, 1:], 0, "frames has 96 x 63 pixels of type uint8; expected 96 x 64 of uint8"),
        (grey_values.astype(float), 0, "of type float64; expected 96 x 64 of uint8"),
    ]:
        with pytest.raises(ValueError, match=pattern):
            sums.add(frames, first)
    with pytest.raises(ValueError, match="0 passes have ended; expected all"):
        sums.report()
    with pytest.raises(ValueError, match="do not begin as sums do"):
        sums.merge(b"no sums")
    whole = sums.to_bytes()
    for part in (whole[:-1], whole[: len(whole) // 2]):
        with pytest.raises(ValueError, match="incomplete"):
            sums.merge(part)
    with pytest.raises(ValueError, match="damaged"):
        sums.merge(whole[:-1] + bytes([whole[-1] ^ 1]))
    with pytest.raises(ValueError, match=r"of module 0.0.0, expected version .* of module"):
        sums.merge(whole[:16] + b"0.0.0".ljust(32, b"\0") + whole[48:])
    other = SensorNoiseSums((40, 64, 95), grey_values.dtype, bayer="none")
    with pytest.raises(ValueError, match="expected 6144"):
        sums.merge(other)
