# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""ITK runs this file at `import itk`. All it does stands in the package itk_sensornoise, whose code can be pickled."""

from itk_sensornoise._install import install

install()
