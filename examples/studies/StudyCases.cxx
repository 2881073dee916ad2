// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "studies/StudyCase.h"

namespace sensornoise::tools
{

std::vector<StudyCase>
GetStudyCases()
{
  std::vector<StudyCase> cases;
  AppendEfficiencyCases(cases);
  AppendRobustnessCases(cases);
  AppendSensorCases(cases);
  AppendCheckCases(cases);
  AppendSingleImageCases(cases);
  return cases;
}

} // namespace sensornoise::tools
