// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "studies/InfluenceConstants.h"

#include "base/Constants.h"
#include "correlation/Constants.h"
#include "moments/Constants.h"
#include "pixels/Constants.h"
#include "refined/Constants.h"
#include "series/Constants.h"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <stdexcept>

namespace sensornoise::tools
{

namespace
{
struct VariedConstant
{
  std::string  name;
  double *     value;
  const char * unit;
  const char * what; ///< one-line description
};

const std::vector<VariedConstant> &
GetVariedConstants()
{
  static const std::vector<VariedConstant> constants{
    { "Significance.hint", &Significance.hint, "sd", "what widens an error" },
    { "Significance.oneTest", &Significance.oneTest, "sd", "what is tested once" },
    { "Significance.severalTests", &Significance.severalTests, "sd", "what is tested of lags, series and bins" },
    { "Significance.manyTests", &Significance.manyTests, "sd", "what is tested at many places" },
    { "Significance.everyPixel", &Significance.everyPixel, "sd", "what is tested of every pixel or frame" },
    { "InMoments.defectiveNoiseFactor", &InMoments.defectiveNoiseFactor, "1", "noise of a defective pixel" },
    { "InSeries.leastSignalFraction", &InSeries.leastSignalFraction, "1", "signal of a derivative of the motion" },
    { "InSeries.edgeOfNoise", &InSeries.edgeOfNoise, "1", "edge of the noise, above which cells show light" },
    { "InCorrelation.unseenErrors", &InCorrelation.unseenErrors, "1", "error by neighbours that are not summed" },
    { "InRefined.leastVarianceInflation",
      &InRefined.leastVarianceInflation,
      "1",
      "variance inflation for another test" },
    { "InRefined.errorOfNonlinearity", &InRefined.errorOfNonlinearity, "1", "error by non-linearity, over its size" },
    { "InRefined.largestNonlinearity", &InRefined.largestNonlinearity, "1", "non-linearity of failed estimates" },
  };
  return constants;
}
} // namespace

void
PrintVariedConstants()
{
  for (const VariedConstant & constant : GetVariedConstants())
  {
    std::printf("%-32s %-8.4g %-3s %s\n", constant.name.c_str(), *constant.value, constant.unit, constant.what);
  }
}

void
MultiplyConstants(const std::vector<std::string> & changes)
{
  for (const std::string & change : changes)
  {
    const std::size_t equals = change.find('=');
    const auto &      all = GetVariedConstants();
    const auto        found = std::find_if(all.begin(), all.end(), [&](const VariedConstant & constant) {
      return constant.name == change.substr(0, equals);
    });
    char              rest = 0;
    double            factor = 0.0;
    const bool        isFactor = equals != std::string::npos &&
                          std::sscanf(change.c_str() + equals + 1, "%lf%c", &factor, &rest) == 1 && factor > 0.0;
    if (found == all.end() || !isFactor)
    {
      throw std::invalid_argument("--constant is \"" + change +
                                  "\"; expected NAME=FACTOR with a name of --list-constants and a positive factor");
    }
    *found->value *= factor;
  }
}

} // namespace sensornoise::tools
