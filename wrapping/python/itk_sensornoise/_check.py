# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Checks a noise model on frames before it is used."""

import math
import re
import sys
from typing import Any

from . import _options
from ._errors import itk_errors
from ._estimators import mask_of_frames, set_parameters
from ._frames import frame_image, open_frames
from ._html import figure, paragraphs, table
from ._progress import at_work
from ._record import Record
from ._rounding import with_signs
from ._stabilise import noise_model, open_report
from ._update import update


class NoiseModelCheck(Record):
    """The result of check_noise_model(): the record "itk-sensornoise-check/1", with the names of its JSON members.

        found["verdict"]     "fits", "does-not-fit" or "not-told"
        found["sentence"]    the verdict in words, with the ranges of levels
        found["bands"]       dark to bright: low, high [DN], pixels; variance over the model's, its standard_error [1]
                             (None: the model has none there); transform_variance, what the transform makes of the right
                             model [1] (None: in the dark, where the read noise is not known); fits

    True where the model fits all levels. print() shows the table and the sentence, a notebook also the ratio of the
    variances by level. It is a dict that cannot be changed, as a report: json.dumps() writes it, it equals any dict
    with the same content, and it can be pickled.
    """

    def __init__(self, text: str, table: str = "") -> None:
        """`text`: the record as JSON, as C++ writes it. `table`: its table as text."""
        super().__init__(text)
        self._table = table

    def __bool__(self) -> bool:
        # json.dumps() with an indent asks "not record" for an empty one, and would write {} of a model that fails.
        if sys._getframe(1).f_globals.get("__name__") == "json.encoder":
            return True
        return bool(self["verdict"] == "fits")

    def __reduce__(self) -> tuple[Any, ...]:
        return NoiseModelCheck, (self._text, self._table)

    def __repr__(self) -> str:
        return f"<NoiseModelCheck: {with_signs(self['sentence'])}>"

    def __str__(self) -> str:
        return self._table.rstrip("\n")

    def _repr_html_(self) -> str:
        """Returns the table and the sentence, and the ratio of the variances by level."""
        from ._svg import Plot, Points

        lines = str(self).split("\n")
        cells = [re.split(r"\s{2,}", line.strip()) for line in lines]
        end = next((number for number, row in enumerate(cells) if len(row) != len(cells[0])), len(cells))
        bands = [band for band in self["bands"] if band["variance"] is not None]
        points = Points(
            [(band["low"] + band["high"]) / 2 for band in bands],
            [band["variance"] for band in bands],
            errors=[band["standard_error"] for band in bands],
        )
        plot = Plot("level [DN]", "variance / model", [points], level=1.0)
        drawn = plot.element("variance over the variance of the model, by level") if bands else ""
        return table(cells[0], cells[1:end]) + paragraphs(lines[end:]) + figure(drawn)


def check_noise_model(frames: Any, report: Any, *, mask: Any = None, **parameters: Any) -> NoiseModelCheck:
    """Checks whether frames have the noise of a report at every level, so that its model can be used in front of a
    denoiser.

    Flicker and motion of `frames` are found anew and taken out of every pixel; of the report, only variance_slope and
    total_intercept are held against the variance that is left. Their ratio is the variance after the generalized
    Anscombe transform, up to what that lacks itself in the dark.

    Parameters
    ----------
    frames : frames
        As `frames` of estimate_sensor_noise(), of the report's camera and setting: others than it was made from, or the
        same ones, which shows whether the line fits.
    report : Report, mapping, str or os.PathLike
        A report of estimate_sensor_noise(), a mapping like it, or the name of its JSON file.
    mask : array_like (y, x) or itk.Image, optional
        Only pixels where this is not 0: an array (y, x), or an image, of a frame's size.
    **parameters
        Parameters of itk.SensorNoiseEstimator in snake case, for example `bit_depth=12`, without the method: the frames
        are measured by the refined method, whatever the method of the report.

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

    See Also
    --------
    denoise_with_noise_model : Uses the model.

    Examples
    --------
    >>> if itk.check_noise_model(other_frames, report):
    ...     clean = itk.denoise_with_noise_model(image, report)
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
        update(estimator)
    model = (
        slope,
        intercept,
        _known((record.get("read_noise_electrons") or {}).get("value")),
        _known(record.get("quantisation_step")),
    )
    return NoiseModelCheck(estimator.GetNoiseModelCheckAsJson(*model), estimator.GetNoiseModelCheckAsText(*model))


def _known(value: Any) -> float:
    return math.nan if value is None else float(value)
