// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef EfficiencyTable_h
#define EfficiencyTable_h

#include "studies/EfficiencyStatistics.h"

#include <string>
#include <vector>

namespace sensornoise::tools
{

void
PrintEfficiencyHeader();

/** One line a parameter; none for no runs. Over several experiments, \a isPooled, the rms error is relative and there
 * is no one truth. */
void
PrintEfficiencyRows(const std::vector<const EfficiencyRun *> & runs, const std::string & label, bool isPooled);

/** Every single run, one line a parameter. Throws std::runtime_error if the file cannot be written. */
void
WriteEfficiencyCsv(const std::string & name, const std::vector<EfficiencyRun> & runs);

} // namespace sensornoise::tools

#endif
