# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests that frames from OpenCV are measured without changes."""

import itk
import numpy as np
import pytest

cv2 = pytest.importorskip("cv2")


def frames_of(video):
    """Returns the frames of a cv2.VideoCapture."""
    assert video.isOpened()
    frames = []
    while (found := video.read())[0]:
        frames.append(found[1])
    return np.stack(frames)


@pytest.mark.parametrize("name", ["frame_%03d.png", "frame_000.png"])
def test_video_of_images_measures_as_their_array(tmp_path, name):
    """The test uses the back end for images. Other back ends may convert frames to colour or to 8 bits."""
    stack, _ = itk.simulate_sensor_noise(frames=20, size=(64, 48), flicker_sd=0.1, seed=1)
    for index, frame in enumerate(stack):
        assert cv2.imwrite(str(tmp_path / f"frame_{index:03d}.png"), frame)
    found = frames_of(cv2.VideoCapture(str(tmp_path / name), cv2.CAP_IMAGES))
    assert found.dtype == np.uint16 and np.array_equal(found, stack)
    assert itk.estimate_sensor_noise(found) == itk.estimate_sensor_noise(stack)
