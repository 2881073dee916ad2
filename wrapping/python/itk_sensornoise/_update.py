# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Updates of filters that let other threads of Python run."""

from ._types import ItkObject


def update(process: ItkObject) -> None:
    """Updates a filter while other threads of Python run, as in a window that stays responsive.

    Frames that Python itself reads (lazy arrays, a list of arrays) need Python's global lock: then it is kept."""
    from itk.itkSensorNoiseStackSinkPython import UpdateWithoutGil

    UpdateWithoutGil(process)
