# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Whether the noise profile of another program is true of frames."""

import json
import os
from collections.abc import Mapping
from typing import Any

from . import _options
from ._check import NoiseModelCheck
from ._errors import InvalidTypeError
from ._estimate import estimate_sensor_noise
from ._names import is_name
from ._read import record_of, text_of
from ._types import FileName, Frames, ItkObject
from ._values import in_python, python_errors, set_numbers, set_values

_EXPECTED = "the name of a DNG file, a JSON file or another profile"


def check_noise_profile(
    frames: Frames | Mapping[str, Any],
    profile: FileName,
    *,
    black: float | None = None,
    white: float | None = None,
    analogue_gain: float = 1.0,
    **options: Any,
) -> NoiseModelCheck | dict[str, NoiseModelCheck]:
    """Compares the noise of frames with the noise profile of another program, intensity band by intensity band.

    Parameters
    ----------
    frames : frames, Report, ChannelReports, or the name of a report's JSON file
        As `frames` of estimate_sensor_noise(), which are measured; or the report of the refined method on them.
    profile : str or os.PathLike
        A DNG file with the tag NoiseProfile, a tuning file of libcamera, presets of darktable, a record of PYME, of
        picasso or another format of export_formats(), or a report. "maps" is not read: it has no gain.
    black, white : float, optional
        Black and white level of the frames [DN]. Default: the camera settings in the report, else the levels of the DNG
        file with the profile.
    analogue_gain : float, default 1
        Analogue gain of the frames [1], above 0, for a profile of libcamera.
    **options
        Options of estimate_sensor_noise() for the frames, for example `dark="dark/*.tif"`. Only with frames, and
        without `method`: the refined method gives the variance of each level.

    Returns
    -------
    NoiseModelCheck, or a dict of them
        The result, or for a mosaic the result of each channel by its name. A band fits if the variance is within 5 % of
        the profile's, or within four standard errors. If a band does not fit, the sentence gives the factor, and the
        known mistakes with which the profile would fit at all levels.

    Raises
    ------
    TypeError
        A wrong type, or an unknown keyword.
    ValueError
        A wrong value; a profile that cannot be read, or is none; or a level or a channel that the profile needs is
        missing: the sentence says which.

    See Also
    --------
    check_noise_model : Compares frames with a report of this package.
    export_noise_model : Writes a profile that is true of the frames.

    Examples
    --------
    >>> print(itk_sensornoise.check_noise_profile("frames/*.dng", "camera.yaml", dark="dark/*.dng"))
    """
    import itk

    if not is_name(profile):
        raise _options.refuse_type("profile", profile, _EXPECTED)
    checker = itk.NoiseProfileChecker.New()
    _set_profile(checker, os.fsdecode(profile))
    set_numbers(checker, black=black, white=white, analogue_gain=analogue_gain)
    set_values(checker, _report_of(frames, options))
    checker.SetReport("of these frames")
    with python_errors():
        checker.Check()
    return _results(checker, os.fsdecode(profile))


def _set_profile(checker: ItkObject, name: str) -> None:
    """Gives the checker the values of a profile in JSON, or the name of any other file."""
    try:
        with open(name, "rb") as file:
            start = file.read(64).removeprefix(b"\xef\xbb\xbf").lstrip(b" \t\r\n")
            content = start + file.read() if start[:1] in (b"{", b"[") else None
    except OSError as error:
        raise ValueError(f"the profile {name} cannot be read ({error.strerror}); expected {_EXPECTED}") from None
    if content is None:
        checker.SetProfileFile(name)
        return
    try:
        record = json.loads(content, parse_constant=_refuse_constant)
        set_values(checker, record)
    except (ValueError, RecursionError, OverflowError):
        raise ValueError(f"the profile {name} begins like JSON, but is none; expected a whole file") from None
    checker.SetProfileValues(name)


def _refuse_constant(name: str) -> float:
    raise ValueError(f"{name} is no number of JSON")


def _report_of(frames: Any, options: dict[str, Any]) -> Mapping[str, Any]:
    """Returns the report that is given, or measures the frames."""
    is_file = is_name(frames) and os.fsdecode(frames).lower().endswith(".json")
    if not isinstance(frames, Mapping) and not is_file:
        if options.get("method", "refined") != "refined":
            raise _options.refuse("method", options["method"], '"refined", which gives the variance of each level')
        return estimate_sensor_noise(frames, **options)
    if options:
        raise InvalidTypeError(f"{', '.join(options)} was given with a report, which is not measured; expected frames")
    report: Mapping[str, Any] = record_of(*text_of(frames)) if is_file else frames
    return report


def _results(checker: ItkObject, name: str) -> NoiseModelCheck | dict[str, NoiseModelCheck]:
    checks = {}
    for index in range(checker.GetNumberOfChannels()):
        if checker.GetReason(index):
            raise ValueError(f"the profile {name} cannot be checked: {in_python(checker.GetReason(index))}")
        check = NoiseModelCheck(checker.GetCheckAsJson(index), checker.GetCheckAsText(index))
        checks[checker.GetChannel(index)] = check
    return checks["mono"] if list(checks) == ["mono"] else checks
