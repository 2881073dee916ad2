# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""The maps of an estimator, as arrays or as files of a folder, with the names of `estimate-sensor-noise --maps`."""

import os
from pathlib import Path

import numpy as np

from . import _options
from ._errors import itk_errors
from ._types import FileName, ItkObject

_NAMES = (
    "mean",
    "variance",
    "corrected_variance",
    "pixel_use",
    "pixel_offset",
    "pixel_offset_low",
    "pixel_offset_high",
    "pixel_read_noise",
    "pixel_read_noise_low",
    "pixel_read_noise_high",
)


class Maps(dict[str, np.ndarray]):
    """Arrays (y, x) by name: mean, variance, corrected_variance, pixel_use, and the maps of the dark frames."""

    def __missing__(self, name: str) -> np.ndarray:
        found = ", ".join(self) or "none: estimate_sensor_noise(..., maps=True) keeps them"
        raise KeyError(f"{name!r} is not among the maps ({found})")


def maps_folder(folder: FileName) -> Path:
    """Returns the folder, after making it if there is none."""
    expected = "True or the name of a folder"
    if not isinstance(folder, (str, os.PathLike)):
        raise _options.refuse_type("maps", folder, expected)
    if not os.fspath(folder):
        raise _options.refuse("maps", folder, expected)
    path = Path(os.fsdecode(folder))
    try:
        path.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise ValueError(f"maps is {folder!r}; that folder cannot be made: {error}") from error
    return path


def require_apart(folder: Path, **read: object) -> None:
    """Raises ValueError if a map would be written over a file that is read: names, or lists of them, by their role."""
    targets = [folder / f"{name}.mha" for name in _NAMES]
    for role, given in read.items():
        for name in given if isinstance(given, (list, tuple)) else [given]:
            if not isinstance(name, (str, os.PathLike)) or not os.path.exists(name):
                continue
            for target in targets:
                if target.exists() and target.samefile(os.fsdecode(name)):
                    raise ValueError(
                        f"maps is {str(folder)!r}: {target} is the same file as {os.fsdecode(name)} of {role}, which "
                        "is read; expected another folder"
                    )


def _images(estimator: ItkObject) -> dict[str, ItkObject]:
    images = {
        "mean": estimator.GetMean(),
        "variance": estimator.GetVariance(),
        "corrected_variance": estimator.GetCorrectedVariance(),
        "pixel_use": estimator.GetPixelUse(),
    }
    if estimator.GetPixelOffset().GetLargestPossibleRegion().GetNumberOfPixels() > 0:
        images |= {
            "pixel_offset": estimator.GetPixelOffset(),
            "pixel_offset_low": estimator.GetPixelOffsetLow(),
            "pixel_offset_high": estimator.GetPixelOffsetHigh(),
            "pixel_read_noise": estimator.GetPixelReadNoise(),
            "pixel_read_noise_low": estimator.GetPixelReadNoiseLow(),
            "pixel_read_noise_high": estimator.GetPixelReadNoiseHigh(),
        }
    return images


def arrays_of(estimator: ItkObject) -> dict[str, np.ndarray]:
    """Returns the maps as arrays (y, x) that own their memory."""
    import itk

    return {name: itk.array_from_image(image) for name, image in _images(estimator).items()}


def write_maps(estimator: ItkObject, folder: Path) -> None:
    """Writes all maps, or none. Raises RuntimeError if one cannot be written."""
    import itk

    written: dict[Path, Path] = {}
    try:
        for name, image in _images(estimator).items():
            target = Path(os.path.realpath(folder / f"{name}.mha"))  # target of a link
            temporary = target.parent / f".{name}.{os.getpid()}.mha"
            written[temporary] = target
            with itk_errors(f"{target}: cannot be written; ", RuntimeError):
                itk.imwrite(image, str(temporary))
        for temporary, target in written.items():
            os.replace(temporary, target)
    finally:
        for temporary in written:
            temporary.unlink(missing_ok=True)
