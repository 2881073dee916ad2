# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tables of the warnings and quantities of reports, from the C++ library."""

import functools
import json


@functools.cache
def _catalogue() -> dict[str, list[dict[str, str]]]:
    import itk

    catalogue: dict[str, list[dict[str, str]]] = json.loads(
        itk.SensorNoiseEstimator[itk.Image[itk.US, 3]].GetCatalogueAsJson()
    )
    return catalogue


def warning_table() -> list[dict[str, str]]:
    """Lists all warnings that a report may have.

    Returns
    -------
    list of dict
        `code`, `severity` ("note": every number stands, "warning": some number is missing or doubtful, "error": no
        gain) and `sentence`, the meaning and the remedy.

    See Also
    --------
    quantity_list : The quantities of a report.

    Examples
    --------
    >>> {kind["code"]: kind["sentence"] for kind in itk_sensornoise.warning_table()}["few-frames"]
    """
    return [dict(kind) for kind in _catalogue()["warnings"]]


def quantity_list() -> list[dict[str, str]]:
    """Lists all quantities of a report.

    Returns
    -------
    list of dict
        `path` in the record ("vibration.sd_x"), `label` in its table, `unit` and `meaning`.

    See Also
    --------
    Report.quantity : One of them, of a report.
    warning_table : The warnings of a report.

    Examples
    --------
    >>> [entry["path"] for entry in itk_sensornoise.quantity_list()]
    """
    return [dict(entry) for entry in _catalogue()["quantities"]]
