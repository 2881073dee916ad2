# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""The same measurements on more than one process or machine, by Dask (`pip install itk-sensornoise[distributed]`).

Nothing here is loaded by `import itk`, and importing it does not need Dask: what does says so when it is called.
"""

__all__: list[str] = []
