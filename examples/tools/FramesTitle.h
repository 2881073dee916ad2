// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_tools_FramesTitle_h
#define sensornoise_tools_FramesTitle_h

#include "itkSensorNoiseFrameFiles.h"
#include "sensornoise/ReportPage.h"

namespace sensornoise::tools
{

/** Returns the title of the page of a burst: the name of the file, or of the first and the last file, without folders,
 * and the time at which the last file was modified, in UTC. The time is of the file and not of the clock, so that the
 * same files have the same page. It is "" if the file has none. */
PageTitle
TitleOf(const FrameList & list);

} // namespace sensornoise::tools

#endif
