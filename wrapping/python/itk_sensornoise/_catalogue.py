# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""What a report may warn of, and what it holds: the tables of the C++ library, not copies of them."""

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
    """All that a report can warn of: `code`, `severity` ("note": every number stands, "warning": some number is missing
    or doubtful, "error": no gain) and `sentence`, what it means and what helps."""
    return [dict(kind) for kind in _catalogue()["warnings"]]


def quantity_list() -> list[dict[str, str]]:
    """All quantities of a report: `path` in the record ("vibration.sd_x"), `label` in its table, `unit`, `meaning`."""
    return [dict(entry) for entry in _catalogue()["quantities"]]
