// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_tools_FramesTitle_h
#define sensornoise_tools_FramesTitle_h

#include "itkSensorNoiseFrameFiles.h"
#include "sensornoise/ReportPage.h"

namespace sensornoise::tools
{

/** Returns the title of the page of a burst: the name of the file, or of the first and the last file, without
 * folders. The time is the modification time of the last file, in UTC, so that the same files give the same page.
 * The time is empty if it cannot be read. */
PageTitle
TitleOf(const FrameList & list);

} // namespace sensornoise::tools

#endif
