# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Whether a noise model serves for frames: before one relies on it."""

import json
import math
from collections.abc import Iterator, Mapping
from typing import Any

from . import _options
from ._errors import itk_errors
from ._estimators import mask_of_frames, set_parameters
from ._frames import frame_image, open_frames
from ._progress import at_work
from ._stabilise import noise_model, open_report


class NoiseModelCheck(Mapping[str, Any]):
    """What check_noise_model() found: the record "itk-sensornoise-check/1", the names of its JSON.

        found["verdict"]     "fits", "does-not-fit" or "not-told"
        found["sentence"]    the same for people, with the ranges of levels
        found["bands"]       dark to bright: low, high [DN], pixels; variance over the model's, its standard_error [1]
                             (None: the model has none there); transform_variance, what the transform makes of the right
                             model [1] (None: in the dark, where the read noise is not known); fits

    True where the model fits all levels. print() shows the table and the sentence. Equal to any mapping with the same
    content; can be pickled.
    """

    def __init__(self, text: str, table: str = "") -> None:
        """`text`: the record as JSON, as C++ writes it. `table`: the same for people."""
        self._text = text
        self._table = table
        self._record: dict[str, Any] = json.loads(text)

    def __bool__(self) -> bool:
        return self["verdict"] == "fits"

    def __getitem__(self, name: str) -> Any:
        return self._record[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._record)

    def __len__(self) -> int:
        return len(self._record)

    __hash__ = None  # type: ignore[assignment]  # what it holds can be changed

    def __reduce__(self) -> tuple[Any, ...]:
        return NoiseModelCheck, (self._text, self._table)

    def __repr__(self) -> str:
        return f"<NoiseModelCheck: {self['sentence']}>"

    def __str__(self) -> str:
        return self._table.rstrip("\n")

    def to_json(self) -> str:
        """The record as C++ writes it."""
        return self._text


def check_noise_model(frames: Any, report: Any, *, mask: Any = None, **parameters: Any) -> NoiseModelCheck:
    """Whether frames have the noise that a report says, at every level: then its model can be used in front of a
    denoiser.

    Flicker and motion of `frames` are found anew and taken out of every pixel; of the report, only variance_slope and
    total_intercept are held against the variance that is left. Their ratio is the variance after the generalized
    Anscombe transform, up to what that lacks itself in the dark.

    Parameters
    ----------
    frames
        As `frames` of estimate_sensor_noise(), of the report's camera and setting: others than it was made from, or the
        same ones, which shows whether the line fits.
    report
        A report of estimate_sensor_noise(), a mapping like it, or the name of its JSON file.
    mask
        Only pixels where this is not 0: an array (y, x), or an image, of a frame's size.
    parameters
        Those of itk.SensorNoiseEstimator in snake case, for example `bit_depth=12`. Not the method: the frames are
        measured by the refined one, whatever method the report is of.

    Returns
    -------
    NoiseModelCheck
        A mapping with `verdict`, `sentence` and `bands`. A band fits where the ratio is within 0.02 of 1, or within
        four standard errors.

    Raises
    ------
    TypeError
        A wrong type, or an unknown parameter.
    ValueError
        A wrong value, and a report without the two numbers, or with a slope that is not above 0.
    """
    import itk

    record = open_report(report)
    slope, intercept = noise_model(record)
    opened = open_frames(frames)
    if parameters.get("method", "refined") != "refined":
        raise _options.refuse("method", parameters["method"], '"refined", which measures frames of any report')
    estimator = opened.estimator(itk.SensorNoiseEstimator)
    set_parameters(estimator, parameters, "check_noise_model")
    if mask is not None:
        mask_array = mask_of_frames(mask, opened)
        estimator.SetMask(frame_image(mask_array, opened.image))
    with at_work(estimator, False, opened), itk_errors():
        estimator.Update()
    model = (
        slope,
        intercept,
        _known((record.get("read_noise_electrons") or {}).get("value")),
        _known(record.get("quantisation_step")),
    )
    return NoiseModelCheck(estimator.GetNoiseModelCheckAsJson(*model), estimator.GetNoiseModelCheckAsText(*model))


def _known(value: Any) -> float:
    return math.nan if value is None else float(value)
