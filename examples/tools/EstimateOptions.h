// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef EstimateOptions_h
#define EstimateOptions_h

#include "sensornoise/Settings.h"
#include "sensornoise/FrameFile.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sensornoise::tools
{

/** What --plot is to be. */
enum class PlotKind
{
  None,
  Page,
  Svg,
  Png
};

/** The command line of estimate-sensor-noise. */
struct EstimateOptions
{
  std::vector<std::string>                 files;
  std::string                              raw;    ///< how frames lie in files without a header; empty: none
  FrameChoice                              choice; ///< of files with several channels or planes
  std::string                              bayer{ "auto" };
  std::string                              method{ "refined" };
  unsigned int                             bitDepth{ 0 }; ///< 0: found
  double                                   clipLow{ std::numeric_limits<double>::quiet_NaN() };
  double                                   clipHigh{ std::numeric_limits<double>::quiet_NaN() };
  double                                   step{ 0.0 };   ///< 0: found
  std::optional<std::pair<double, double>> levelRange;    ///< low, high [DN]; none: all levels
  std::string                              exposuresText; ///< list of numbers, or name of a file; empty: none
  std::vector<double>                exposures; ///< of the frames that are measured, see SelectExposures(); empty: none
  double                             excessNoiseFactor{ 1.0 }; ///< F: the gain is the variance's slope over F [1]
  double                             offset{ std::numeric_limits<double>::quiet_NaN() };
  double                             offsetStandardError{ 0.0 };
  std::vector<std::string>           dark;
  bool                               hasCheck{ false };
  std::vector<std::string>           check; ///< empty: the frames themselves
  RollingShutter                     rollingShutter{ RollingShutter::Auto };
  double                             sigmaRows{ 50.0 };
  std::optional<std::array<long, 4>> roi;                    ///< x, y, width, height
  std::optional<std::pair<std::size_t, std::size_t>> frames; ///< first, one past the last
  std::optional<std::pair<std::size_t, std::size_t>> cut;    ///< of these what is left to do, see SelectFiles()
  std::string                                        mask;
  std::uint64_t                                      memoryLimit{ 0 }; ///< [bytes]; 0: what it needs
  unsigned int                                       threads{ 0 };     ///< 0: all
  std::string                                        json;
  std::string                                        maps;
  std::string                                        plot;          ///< .html: the page; .svg, .png: its first figure
  bool                                               hash{ false }; ///< also without a page
  std::vector<std::string>                           compare;       ///< stored reports; else frames are measured
  bool                                               quiet{ false };

  /** Reads the command line; the exit code if there is nothing left to do (--help, --version). Throws std::exception on
   * wrong use.
   */
  std::optional<int>
  Parse(int argc, char ** argv);

  /** Applies --frames to a list of files; stacks are cut later. */
  void
  SelectFiles(bool areStacks);

  /** Applies --frames to the exposures. The files hold \a all frames. Throws std::invalid_argument unless there is one
   * exposure for each frame. */
  void
  SelectExposures(std::size_t all);

  /** Whether the report goes to a file, not to standard output or nowhere. */
  bool
  HasReportFile() const
  {
    return !json.empty() && json != "-";
  }

  PlotKind
  Plot() const;

  /** Whether the report has the hash of the frames' files. */
  bool
  WantsHash() const;

  /** What is to be cut out of the stack. */
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
    estimator.SetExposures(exposures);
    estimator.SetExcessNoiseFactor(excessNoiseFactor);
    estimator.SetMemoryLimit(memoryLimit);
    estimator.SetRollingShutter(rollingShutter);
    estimator.SetSigmaRows(sigmaRows);
    estimator.SetOffset(offset);
    estimator.SetOffsetStandardError(offsetStandardError);
    if (roi)
    {
      const auto number = [this](std::size_t i) { return static_cast<std::size_t>((*roi)[i]); };
      estimator.SetSourceRegion(number(0), number(1), number(2), number(3));
    }
    if (frames)
    {
      estimator.SetSourceFrames(frames->first, frames->second);
    }
  }
};

} // namespace sensornoise::tools

#endif
