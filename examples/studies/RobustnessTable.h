// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef RobustnessTable_h
#define RobustnessTable_h

#include "studies/RobustnessRun.h"

#include <cstddef>
#include <string>
#include <vector>

namespace sensornoise::tools
{

/** What the columns of PrintRun are. */
void
PrintRunHeader(const std::string & method, std::size_t size);

void
PrintRun(const Run & run);

/** One line a case and reference: over the seeds, mean error and rms z, and the verdict. */
void
PrintSummary(const std::vector<Run> & runs);

} // namespace sensornoise::tools

#endif
