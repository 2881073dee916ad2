// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef EstimateOptions_h
#define EstimateOptions_h

#include "sensornoise/NoiseExport.h"
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

/** Kind of the file that --plot writes. */
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
  std::string                              raw;    ///< layout of files without a header; empty: none
  FrameChoice                              choice; ///< channels or planes that are read from files that hold several
  std::string                              bayer{ "auto" };
  std::string                              method{ "refined" };
  unsigned int                             bitDepth{ 0 }; ///< 0: estimated
  double                                   clipLow{ std::numeric_limits<double>::quiet_NaN() };
  double                                   clipHigh{ std::numeric_limits<double>::quiet_NaN() };
  double                                   step{ 0.0 };   ///< quantization step [DN]; 0: estimated
  std::optional<std::pair<double, double>> levelRange;    ///< low, high [DN]; none: all levels
  std::string                              exposuresText; ///< list of numbers, or file name; empty: none
  std::vector<double>                exposures; ///< exposure of each measured frame, see SelectExposures(); empty: none
  double                             excessNoiseFactor{ 1.0 }; ///< F [1]: the gain is the variance slope over F
  double                             offset{ std::numeric_limits<double>::quiet_NaN() };
  double                             offsetStandardError{ 0.0 };
  std::vector<std::string>           dark;
  bool                               hasCheck{ false };
  std::vector<std::string>           check; ///< frames that the model is compared with; empty: the measured frames
  std::string                        checkProfile;  ///< noise profile of another program; empty: none
  ExportSettings                     profileLevels; ///< black and white level of the frames, and analogue gain
  RollingShutter                     rollingShutter{ RollingShutter::Auto };
  double                             sigmaRows{ 50.0 };
  std::optional<std::array<long, 4>> roi;                    ///< x, y, width, height [pixel]
  std::optional<std::pair<std::size_t, std::size_t>> frames; ///< first frame, and one past the last; none: all frames
  std::optional<std::pair<std::size_t, std::size_t>> cut;    ///< frames to be cut out of the stack, see SelectFiles()
  std::string                                        mask;
  std::uint64_t                                      memoryLimit{ 0 }; ///< [bytes]; 0: no limit
  unsigned int                                       threads{ 0 };     ///< 0: all cores
  std::string                                        json;
  std::string                                        xml; ///< file of the method emva1288; empty: none
  std::string                                        maps;
  std::string                                        plot;          ///< .html: page; .svg, .png: its first figure
  bool                                               hash{ false }; ///< the report has the hash even without a page
  std::vector<std::string>                           compare;       ///< stored reports to be compared; empty: none
  bool                                               quiet{ false };
  std::vector<std::string> sweep;       ///< folders, files or a table of a camera's settings; empty: one burst
  std::string              optionsText; ///< the options that change numbers, as they were given, for --sweep

  /** Reads the command line. Returns the exit code if nothing is left to do (--help, --version). Throws
   * std::exception on wrong use. */
  std::optional<int>
  Parse(int argc, char ** argv);

  /** Applies --frames to a list of files. For stacks it sets \a cut instead, and the frames are cut out later. */
  void
  SelectFiles(bool areStacks);

  /** Applies --frames to the exposures. \a all is the number of frames in the files. Throws std::invalid_argument
   * unless there is one exposure for each frame. */
  void
  SelectExposures(std::size_t all);

  /** Returns whether the report goes to a file. If not, it goes to standard output or is not written. */
  bool
  HasReportFile() const
  {
    return !json.empty() && json != "-";
  }

  PlotKind
  Plot() const;

  /** Returns whether the report has the hash of the frame files: with --hash, or if --plot writes a page. */
  bool
  WantsHash() const;

  /** Returns a text about the region and the frames that are cut out of the stack. */
  std::string
  DescribeRegion() const;

  /** Sets what the filters of all methods have: digital numbers, excess noise, and where the stack was cut out. */
  template <typename TEstimator>
  void
  ApplyCommonTo(TEstimator & estimator) const
  {
    estimator.SetBitDepth(bitDepth);
    estimator.SetClipLow(clipLow);
    estimator.SetClipHigh(clipHigh);
    estimator.SetQuantisationStep(step);
    estimator.SetExcessNoiseFactor(excessNoiseFactor);
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

  /** Sets all parameters of a SensorNoiseEstimator. */
  template <typename TEstimator>
  void
  ApplyTo(TEstimator & estimator) const
  {
    this->ApplyCommonTo(estimator);
    estimator.SetMethod(method);
    if (levelRange)
    {
      estimator.SetLevelRangeLow(levelRange->first);
      estimator.SetLevelRangeHigh(levelRange->second);
    }
    estimator.SetExposures(exposures);
    estimator.SetMemoryLimit(memoryLimit);
    estimator.SetRollingShutter(rollingShutter);
    estimator.SetSigmaRows(sigmaRows);
    estimator.SetOffset(offset);
    estimator.SetOffsetStandardError(offsetStandardError);
  }
};

} // namespace sensornoise::tools

#endif
