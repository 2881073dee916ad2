# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""The version of the installed package."""

import functools
from importlib.metadata import PackageNotFoundError, version


@functools.cache
def version_of_package() -> str:
    """Returns the version of the distribution; "unknown" if the folder was copied and not installed."""
    try:
        return version("itk-sensornoise")
    except PackageNotFoundError:
        return "unknown"
