# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Dask, which is not installed with the package."""

from types import ModuleType


def require_distributed() -> ModuleType:
    """Imports the module `distributed`. Raises ImportError, which says what to install, if it is missing."""
    try:
        import distributed
    except ImportError as error:
        raise ImportError("Dask is not installed; expected it: pip install itk-sensornoise[distributed]") from error
    return distributed
