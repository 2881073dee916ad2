# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Actions of the widget "Stabilise / Denoise" on pixels, without a window."""

from collections.abc import Callable
from typing import Any

import numpy as np
from itk_sensornoise import (
    Report,
    denoise_with_noise_model,
    generalized_anscombe_image_filter,
    inverse_generalized_anscombe_image_filter,
)
from itk_sensornoise._denoise import named_denoiser

# The actions, and the words for the layers that they make.
ACTIONS = {"denoise": "denoised", "stabilise": "stabilised", "return to grey values": "grey values"}
# The denoisers: words, and the module without which each is not offered. napari brings scikit-image.
DENOISERS = {
    "scikit-image": ("non-local means (scikit-image)", "skimage"),
    "nlm": ("non-local means (OpenCV)", "cv2"),
    "itk": ("bilateral (ITK)", "itk.itkBilateralImageFilterPython"),
}
# scikit-image's filter strength for noise of standard deviation 1, and the sizes of its patches and of its search
# [pixels]: chosen empirically, on simulated targets with 30 to 1500 electrons in the brightest pixel and a read noise
# of 2 electrons, where they lower the root-mean-square error by a factor of 4.5 to 5.5.
_STRENGTH_H, _PATCH, _DISTANCE = 1.0, 5, 6


def action_of(
    action: str, pixels: Any, report: Report, denoiser: str, strength: float, progress: Callable[[float], None]
) -> Callable[[], np.ndarray]:
    """Returns a function that applies an action of ACTIONS to pixels, for a background thread."""

    def work() -> np.ndarray:
        values = np.asarray(pixels)
        progress(0.0)
        if action == "stabilise":
            return np.asarray(generalized_anscombe_image_filter(values, report))
        if action == "denoise":
            remove = _counted(_denoiser_of(denoiser, strength), len(values) if values.ndim == 3 else 1, progress)
            return np.asarray(denoise_with_noise_model(values, report, remove))
        return np.asarray(inverse_generalized_anscombe_image_filter(values, report))

    return work


def _denoiser_of(name: str, strength: float) -> Callable[[np.ndarray], Any]:
    return _non_local_means(strength) if name == "scikit-image" else named_denoiser(name, strength)


def _counted(remove: Callable[[np.ndarray], Any], frames: int, progress: Callable[[float], None]) -> Any:
    """Returns a denoiser that notes its progress after each frame."""
    done = 0

    def remove_and_count(frame: np.ndarray) -> Any:
        nonlocal done
        clean = remove(frame)
        done += 1
        progress(done / frames)
        return clean

    return remove_and_count


def _non_local_means(strength: float) -> Callable[[np.ndarray], Any]:
    """scikit-image's non-local means, for noise of variance 1."""
    from skimage.restoration import denoise_nl_means

    return lambda frame: denoise_nl_means(
        frame,
        patch_size=_PATCH,
        patch_distance=_DISTANCE,
        h=strength * _STRENGTH_H,
        sigma=1.0,
        fast_mode=True,
        preserve_range=True,
    )
