// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Report.h"
#include "sensornoise/SimulationSettings.h"
#include "helpers/RefinedTestHelper.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <random>
#include <string>

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
constexpr std::size_t Size = 128;
constexpr std::size_t Frames = 50;

/** Returns the report of frames whose odd rows, or columns, have a separate illumination factor with the standard
 * deviation \a sd. */
Report
ReportOfInterlaced(double sd, bool areColumns = false)
{
  SimulationSettings settings = FlickeringSettings(Frames);
  settings.seed = 3;
  auto                       stack = Simulate<unsigned short>(settings, Size, Size);
  std::mt19937               random(7);
  std::normal_distribution<> normal;
  for (std::size_t t = 0; t < Frames; ++t)
  {
    const double factor = 1.0 + sd * normal(random);
    for (std::size_t p = 0; p < Size * Size; ++p)
    {
      if ((areColumns ? p : p / Size) % 2 != 0 && sd > 0.0)
      {
        auto &       value = stack.pixels[t * Size * Size + p];
        const double level = settings.camera.offsetDn + factor * (value - settings.camera.offsetDn);
        value = static_cast<unsigned short>(std::lround(std::max(0.0, level)));
      }
    }
  }
  return Measure(stack).GetReport();
}

} // namespace

TEST(SensorNoiseLineIlluminationChange, InterlacedFramesAreMeasuredWithoutTheIlluminationOfLines)
{
  for (const bool areColumns : { false, true })
  {
    const Report report = ReportOfInterlaced(0.008, areColumns);
    ASSERT_TRUE(report.gain.value);
    EXPECT_NEAR(
      *report.gain.value, FlickeringSettings(Frames).camera.gainDnPerElectron, 4.0 * *report.gain.standardError);
    const auto note = std::find_if(report.warnings.begin(), report.warnings.end(), [](const Warning & warning) {
      return warning.code == WarningCode::LocalLight;
    });
    ASSERT_NE(note, report.warnings.end());
    const char * const expected = areColumns ? "from column to column" : "from row to row";
    EXPECT_NE(note->message.find(expected), std::string::npos) << note->message;
  }
}

TEST(SensorNoiseLineIlluminationChange, GlobalFlickerIsNoIlluminationOfRows)
{
  const Report report = ReportOfInterlaced(0.0);
  EXPECT_TRUE(report.gain.value);
  EXPECT_FALSE(HasWarning(report, WarningCode::LocalLight));
}
