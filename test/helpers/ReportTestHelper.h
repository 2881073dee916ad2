/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#ifndef sensornoise_test_ReportTestHelper_h
#define sensornoise_test_ReportTestHelper_h

#include "sensornoise/report/Report.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <string>

/** \file
 * What a report says. */

namespace sensornoise::test
{

inline double
ValueOf(const Quantity & quantity)
{
  EXPECT_EQ(quantity.status, EstimateStatus::Identified) << quantity.unit;
  return quantity.value.value_or(std::nan(""));
}

inline bool
HasWarning(const Report & report, const std::string & code)
{
  return std::any_of(report.warnings.begin(), report.warnings.end(), [&](const Warning & w) { return w.code == code; });
}

} // namespace sensornoise::test

#endif
