# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""The version of the installed package."""

from importlib.metadata import PackageNotFoundError, version

try:
    __version__ = version("itk-sensornoise")
except PackageNotFoundError:  # the folder was copied and not installed
    __version__ = "unknown"
