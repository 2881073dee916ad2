// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef ImageOnFile_h
#define ImageOnFile_h

#include "itkSensorNoiseFrameFiles.h"
#include "itkImage.h"

namespace sensornoise::tools
{

/** Reads the only frame of a list. Pixels of all types become double, which represents them exactly. Throws
 * FileError. */
itk::Image<double, 2>::Pointer
ReadImage(const FrameList & list);

} // namespace sensornoise::tools

#endif
