# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Dask, which is not installed with the package."""

from types import ModuleType


def require_distributed() -> ModuleType:
    """The module `distributed`. Raises ImportError, with what to install, where it is missing."""
    try:
        import distributed
    except ImportError as error:
        raise ImportError("Dask is not installed; expected it: pip install itk-sensornoise[distributed]") from error
    return distributed
