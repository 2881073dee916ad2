# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""The plugin of the viewer napari: two widgets and simulated bursts, declared in napari.yaml.

Nothing here is imported before napari asks for it. The modules import napari and qtpy, which come with napari: the
package itk-sensornoise itself does not depend on them."""
