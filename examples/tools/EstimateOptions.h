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
#ifndef EstimateOptions_h
#define EstimateOptions_h

#include "sensornoise/base/RollingShutter.h"

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sensornoise::tools
{

/** The command line of estimate-sensor-noise. */
struct EstimateOptions
{
  std::vector<std::string>                           files;
  std::string                                        method{ "refined" };
  unsigned int                                       bitDepth{ 0 }; ///< 0: found
  double                                             clipLow{ std::numeric_limits<double>::quiet_NaN() };
  double                                             clipHigh{ std::numeric_limits<double>::quiet_NaN() };
  double                                             step{ 0.0 }; ///< 0: found
  std::optional<std::pair<double, double>>           levelRange;  ///< low, high [DN]; none: all levels
  double                                             offset{ std::numeric_limits<double>::quiet_NaN() };
  double                                             offsetStandardError{ 0.0 };
  std::vector<std::string>                           dark;
  RollingShutter                                     rollingShutter{ RollingShutter::Auto };
  double                                             sigmaRows{ 50.0 };
  std::optional<std::array<long, 4>>                 roi;    ///< x, y, width, height
  std::optional<std::pair<std::size_t, std::size_t>> frames; ///< first, one past the last
  std::string                                        mask;
  unsigned int                                       threads{ 0 }; ///< 0: all
  std::string                                        json;
  std::string                                        maps;
  bool                                               quiet{ false };

  /** Reads the command line; the exit code if there is nothing left to do (--help, --version). Throws std::exception on
   * wrong use.
   */
  std::optional<int>
  Parse(int argc, char ** argv);

  /** Applies --frames to a list of files; a stack is cut later. */
  void
  SelectFiles();

  /** Whether the report goes to a file, not to standard output or nowhere. */
  bool
  HasReportFile() const
  {
    return !json.empty() && json != "-";
  }

  /** What --roi and --frames ask for. */
  std::string
  DescribeRegion() const;

  template <typename TEstimator>
  void
  ApplyTo(TEstimator & estimator) const
  {
    estimator.SetMethod(method);
    estimator.SetBitDepth(bitDepth);
    estimator.SetClipLow(clipLow);
    estimator.SetClipHigh(clipHigh);
    estimator.SetQuantisationStep(step);
    if (levelRange)
    {
      estimator.SetLevelRangeLow(levelRange->first);
      estimator.SetLevelRangeHigh(levelRange->second);
    }
    estimator.SetRollingShutter(rollingShutter);
    estimator.SetSigmaRows(sigmaRows);
    estimator.SetOffset(offset);
    estimator.SetOffsetStandardError(offsetStandardError);
  }
};

} // namespace sensornoise::tools

#endif
