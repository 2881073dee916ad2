// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "exports/ExportFormats.h"
#include "helpers/ExportTestHelper.h"

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

class CareamicsExport : public ExportTest
{
protected:
  /** Returns the numbers of an array of the archive, which stand behind the line of its header. */
  static std::vector<double>
  ArrayOf(const std::string & archive, const std::string & name, const std::string & shape, std::size_t count)
  {
    const std::size_t member = archive.find(name + ".npy\x93NUMPY");
    const std::size_t values = archive.find('\n', member) + 1;
    EXPECT_NE(member, std::string::npos) << name;
    EXPECT_NE(archive.substr(member, values - member).find("'shape': (" + shape + ")"), std::string::npos) << name;
    EXPECT_EQ((values - member - name.size() - 4) % 64, 0U) << name << ": NumPy aligns its values to 64 bytes";
    std::vector<double> numbers(count);
    std::memcpy(numbers.data(), archive.data() + values, count * sizeof(double)); // on a little-endian machine
    return numbers;
  }
};

TEST_F(CareamicsExport, GaussianIsTheLine)
{
  const std::string archive = TextOf("careamics");
  EXPECT_EQ(archive.substr(0, 4), "PK\x03\x04");
  const auto   weight = ArrayOf(archive, "trained_weight", "3, 2, ", 6);
  const double low = ArrayOf(archive, "min_signal", "1, ", 1)[0];
  const double high = ArrayOf(archive, "max_signal", "1, ", 1)[0];
  const double floor = ArrayOf(archive, "min_sigma", "", 1)[0];
  EXPECT_EQ(low, 100.0); // the darkest level that was measured
  EXPECT_EQ(high, white);
  // get_gaussian_parameters(): the mean is the signal, the variance a polynomial of exp(weight), at least min_sigma.
  IsTheLine([&](double level) {
    return std::max(floor, std::exp(weight[2]) + std::exp(weight[3]) * (level - low) / (high - low));
  });
  for (const std::size_t other : { 0U, 1U, 4U, 5U })
  {
    EXPECT_EQ(weight[other], 0.0);
  }
}

TEST_F(CareamicsExport, ADarkestLevelWithoutNoiseIsRefused)
{
  this->SetQuantity("/total_intercept", -slope * 101.0);
  IsRefused("careamics", { "variance of -0.5 DN\u00B2", "darkest level 100 DN", "above 0" });
  m_Report.numbers.erase("/scatter/mean/0");
  m_Report.numbers.erase("/scatter/mean/1");
  IsRefused("careamics", { "no measured levels" });
}
