// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_test_ReportTestHelper_h
#define sensornoise_test_ReportTestHelper_h

#include "sensornoise/Report.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <string>

/** \file
 * Queries of the warnings and values of a report. */

namespace sensornoise::test
{

inline double
ValueOf(const Quantity & quantity)
{
  EXPECT_EQ(quantity.status, EstimateStatus::Identified);
  return quantity.value.value_or(std::nan(""));
}

inline bool
HasWarning(const Report & report, WarningCode code)
{
  return std::any_of(report.warnings.begin(), report.warnings.end(), [&](const Warning & w) { return w.code == code; });
}

} // namespace sensornoise::test

#endif
