# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Measurements on several processes or machines, by Dask (`pip install itk-sensornoise[distributed]`).

Nothing here is loaded by `import itk`, and importing it does not need Dask: what does says so when it is called.
"""

from ._many import estimate_many
from ._rounds import estimate_sensor_noise
from ._steps import Step, find_steps

__all__ = ["Step", "estimate_many", "estimate_sensor_noise", "find_steps"]
