// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef ImageOnFile_h
#define ImageOnFile_h

#include "itkSensorNoiseFrameFiles.h"
#include "itkImage.h"

namespace sensornoise::tools
{

/** The pixels of a list that holds one frame, of any type: a double holds them all. Throws FileError. */
itk::Image<double, 2>::Pointer
ReadImage(const FrameList & list);

} // namespace sensornoise::tools

#endif
