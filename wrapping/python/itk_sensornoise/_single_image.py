# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""The single-image method in ITK's functional style: frames in, a report out."""

from typing import Any

from ._channels import ChannelReports, report_of
from ._errors import itk_errors
from ._estimators import mask_of_frames, set_parameters
from ._frames import frame_image, open_frames
from ._progress import at_work
from ._report import Report
from ._types import Frame, Frames
from ._update import update


def as_frames(frames: Frames | Frame) -> Frames:
    """Opens frames. A single frame may be an array (y, x)."""
    if hasattr(frames, "__array__") and getattr(frames, "ndim", 3) == 2:
        return frames[None]  # type: ignore[index]  # an array
    return frames


def single_image_noise_estimator(
    stack: Frames | Frame, *, mask: Frame | None = None, **parameters: Any
) -> Report | ChannelReports:
    """Measures gain and intercept of the noise of a single image, from its even areas.

    Offset and read noise are not identifiable from a single image. With a burst of a static scene,
    estimate_sensor_noise() gives both, and smaller errors. After Foi et al., IEEE Trans. Image Process. 17(10), 2008;
    documentation/method/single-image.md describes the method, its accuracy and its limits.

    Parameters
    ----------
    stack : frames or array_like (y, x)
        One frame, or several as `frames` of estimate_sensor_noise(): each is measured, and one line is fitted to all.
    mask : array_like (y, x) or itk.Image, optional
        Pixels of value 0 are left out. Default: all pixels count.
    **parameters
        The parameters of itk.SingleImageNoiseEstimator in snake case, for example `bayer_pattern="RGGB"` or
        `bit_depth=12`.

    Returns
    -------
    Report or ChannelReports
        ChannelReports of a mosaic; else a Report. The record has the member `single_image`.

    Raises
    ------
    TypeError
        A wrong type, or an unknown keyword.
    ValueError
        A wrong value; says what was found and what was expected.

    See Also
    --------
    estimate_sensor_noise : The same by method="single-image", with regions, hashes and files without a header; and by
        other methods gain, offset, read noise, flicker and motion of a burst.

    Examples
    --------
    >>> report = itk.single_image_noise_estimator(frame, bit_depth=12)
    >>> report.gain, report["single_image"]
    """
    import itk

    opened = open_frames(as_frames(stack))
    estimator = opened.estimator(itk.SingleImageNoiseEstimator)
    set_parameters(estimator, parameters, "single_image_noise_estimator")
    if mask is not None:
        mask_array = mask_of_frames(mask, opened)
        estimator.SetMask(frame_image(mask_array, opened.image))
    with at_work(estimator, False, opened), itk_errors():
        update(estimator)
    return report_of(estimator)
