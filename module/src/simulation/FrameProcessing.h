// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_FrameProcessing_h
#define sensornoise_simulation_FrameProcessing_h

#include "SensorNoiseExport.h"
#include "base/Text.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/SensorFlaws.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

/** \file
 * The processing of whole frames: correction of defects, filters, resampling and lossy compression.
 *
 * The checks of the settings throw messages that contain the value that was found and the expected range. */

namespace sensornoise
{

/** One frame, row by row, of charges [e-] or of digital numbers before they are rounded [DN]. */
struct DoubleFrame
{
  std::size_t         width{ 0 };
  std::size_t         height{ 0 };
  std::vector<double> values;

  DoubleFrame() = default;
  DoubleFrame(std::size_t columns, std::size_t rows)
    : width(columns)
    , height(rows)
    , values(columns * rows)
  {}

  double *
  Row(std::size_t y)
  {
    return values.data() + y * width;
  }
  const double *
  Row(std::size_t y) const
  {
    return values.data() + y * width;
  }
};

/** \throws std::invalid_argument that names the first setting that cannot be used. */
SensorNoise_EXPORT void
CheckSettings(const DefectCorrectionSettings & settings);

/** Returns \a valuesDn with corrected defects [DN]; every decision uses the uncorrected frame. */
SensorNoise_EXPORT DoubleFrame
CorrectDefects(const DoubleFrame &              valuesDn,
               const DefectCorrectionSettings & settings,
               const ParallelFor &              parallelFor);

/** \throws std::invalid_argument that names the first setting that cannot be used. */
SensorNoise_EXPORT void
CheckSettings(const TemporalFilterSettings & settings);

/** \class TemporalFilter
 * \brief Recursive temporal filter, which outputs frames in any order with the same bits.
 *
 * The last output is kept, so that consecutive frames need one input each; an earlier frame starts again from frame 0.
 * Several threads may call it. */
class SensorNoise_EXPORT TemporalFilter
{
public:
  using InputFrame = std::function<DoubleFrame(std::size_t frame)>;

  explicit TemporalFilter(const TemporalFilterSettings & settings);

  /** Returns frame \a frame of the output. \a inputOf makes a frame of the input; it is called at most once for each.
   */
  DoubleFrame
  OutputFrame(std::size_t frame, const InputFrame & inputOf, const ParallelFor & parallelFor);

private:
  struct State
  {
    std::size_t frame{ 0 };
    DoubleFrame output;
  };

  double                       m_Weight;
  std::mutex                   m_Mutex; ///< protects the pointer below; never held while a frame is computed
  std::shared_ptr<const State> m_Last;
};

/** \throws std::invalid_argument that names the first setting that cannot be used. */
SensorNoise_EXPORT void
CheckSettings(const MedianSettings & settings);

/** Returns \a valuesDn filtered [DN]. */
SensorNoise_EXPORT DoubleFrame
FilterByMedian(const DoubleFrame & valuesDn, const MedianSettings & settings, const ParallelFor & parallelFor);

/** \throws std::invalid_argument that names the first setting that cannot be used. */
SensorNoise_EXPORT void
CheckSettings(const SmoothingSettings & settings);

/** Returns \a valuesDn smoothed [DN]. */
SensorNoise_EXPORT DoubleFrame
SmoothFrame(DoubleFrame valuesDn, const SmoothingSettings & settings, const ParallelFor & parallelFor);

/** Returns whether a row depends on other rows of its frame, or on other frames. */
inline bool
NeedsWholeFrames(const SensorFlaws & flaws)
{
  return flaws.brighterFatter.IsOn() || flaws.coupling.IsOn() || flaws.defectCorrection.IsOn() ||
         flaws.temporalFilter.IsOn() || flaws.median.IsOn() || flaws.smoothing.IsOn() || flaws.binning.IsOn() ||
         flaws.resampling.IsOn() || flaws.blocks.IsOn();
}

/** Redistributes the charges [e-] between collection and read-out: brighter-fatter effect, then coupling. */
SensorNoise_EXPORT DoubleFrame
MoveCharge(DoubleFrame charge, const SensorFlaws & flaws, const ParallelFor & parallelFor);

/** Processes the digital numbers [DN] before the temporal filter: correction of defects. */
SensorNoise_EXPORT DoubleFrame
ProcessBeforeTemporalFilter(DoubleFrame valuesDn, const SensorFlaws & flaws, const ParallelFor & parallelFor);

/** Processes the digital numbers [DN] after the temporal filter: median, smoothing, binning, resampling, and last the
 * compression in blocks, which needs the \a bitDepth of the converter. */
SensorNoise_EXPORT DoubleFrame
ProcessAfterTemporalFilter(DoubleFrame         valuesDn,
                           const SensorFlaws & flaws,
                           unsigned int        bitDepth,
                           const ParallelFor & parallelFor);

/** Linear interpolation at position + shift along one axis of \a size pixels, edge pixels replicated. */
class LinearShift
{
public:
  LinearShift(double shift, std::size_t size)
    : m_Last(static_cast<double>(size) - 1.0)
    , m_Whole(std::floor(shift))
    , m_Fraction(shift - m_Whole)
  {}
  std::size_t
  First(std::size_t position) const
  {
    return static_cast<std::size_t>(std::clamp(static_cast<double>(position) + m_Whole, 0.0, m_Last));
  }
  std::size_t
  Second(std::size_t position) const
  {
    return static_cast<std::size_t>(std::clamp(static_cast<double>(position) + m_Whole + 1.0, 0.0, m_Last));
  }
  double
  Blend(double first, double second) const
  {
    return first + m_Fraction * (second - first);
  }

private:
  double m_Last;
  double m_Whole;
  double m_Fraction;
};

/** Cubic interpolation at position + shift along one axis of \a size pixels, edge pixels replicated. The four weights
 * of Keys 1981 (IEEE Trans. ASSP 29, DOI 10.1109/TASSP.1981.1163711) with a = -1/2 are exact for polynomials up to
 * degree 2. They sum to 1; at half a pixel they are -1/16, 9/16, 9/16, -1/16. */
class CubicShift
{
public:
  static constexpr std::size_t NumberOfTaps = 4;

  CubicShift(double shift, std::size_t size)
    : m_Last(static_cast<double>(size) - 1.0)
    , m_Whole(std::floor(shift))
  {
    const double f = shift - m_Whole;
    const double back = 1.0 - f;
    m_Weights = { -0.5 * f * back * back,
                  1.0 - 2.5 * f * f + 1.5 * f * f * f,
                  1.0 - 2.5 * back * back + 1.5 * back * back * back,
                  -0.5 * back * f * f };
  }
  /** Returns the pixel that tap \a k, 0 to 3, reads. */
  std::size_t
  Tap(std::size_t position, std::size_t k) const
  {
    const double at = static_cast<double>(position) + m_Whole + static_cast<double>(k) - 1.0;
    return static_cast<std::size_t>(std::clamp(at, 0.0, m_Last));
  }
  double
  Weight(std::size_t k) const
  {
    return m_Weights[k];
  }

private:
  double                           m_Last;
  double                           m_Whole;
  std::array<double, NumberOfTaps> m_Weights{};
};

/** \throws std::invalid_argument that names the first setting that cannot be used. */
SensorNoise_EXPORT void
CheckSettings(const BinningSettings & settings);

/** Returns \a valuesDn binned, in the original size [DN]. Where whole squares fill the frame, its mean is kept. */
SensorNoise_EXPORT DoubleFrame
BinFrame(const DoubleFrame & valuesDn, const BinningSettings & settings, const ParallelFor & parallelFor);

/** \throws std::invalid_argument that names the first setting that cannot be used. */
SensorNoise_EXPORT void
CheckSettings(const ResamplingSettings & settings);

/** Returns \a valuesDn shifted [DN]. */
SensorNoise_EXPORT DoubleFrame
ResampleFrame(const DoubleFrame & valuesDn, const ResamplingSettings & settings, const ParallelFor & parallelFor);

/** Quantization step of each coefficient [DN], row by row: vertical frequency 0 to 7, within it horizontal frequency 0
 * to 7. */
using BlockStepsDn = std::array<double, 64>;

/** \throws std::invalid_argument if the setting cannot be used with a converter of \a bitDepth bits. */
SensorNoise_EXPORT void
CheckSettings(const BlockSettings & settings, unsigned int bitDepth);

/** Returns the luminance table of T.81, Table K.1, in units of (2^bitDepth - 1) / 255 [DN]. It is scaled by the quality
 * and rounded as libjpeg's jpeg_quality_scaling() and jpeg_add_quant_table() do for baseline JPEG. */
SensorNoise_EXPORT BlockStepsDn
StepsOfQuality(const BlockSettings & settings, unsigned int bitDepth);

/** Returns \a valuesDn with the coefficients of each block rounded to multiples of \a stepsDn, all above 0 [DN]. A
 * block that the edge of the frame cuts is filled with copies of its last column and row. */
SensorNoise_EXPORT DoubleFrame
QuantiseBlocks(const DoubleFrame & valuesDn, const BlockStepsDn & stepsDn, const ParallelFor & parallelFor);

/** \throws std::invalid_argument if the setting cannot be used with a converter of \a bitDepth bits. */
SensorNoise_EXPORT void
CheckSettings(const CompandingSettings & settings, unsigned int bitDepth);

/** Compands the digital numbers and expands them again, in place [DN].
 * \param valuesDn digital numbers, which are clamped to 0 and 2^bitDepth - 1 first */
SensorNoise_EXPORT void
Compand(double * valuesDn, std::size_t count, const CompandingSettings & settings, unsigned int bitDepth);

/** \throws std::invalid_argument "the <name> is <found>; expected <expected>" unless \a isGood. */
inline void
RequireSetting(bool isGood, const char * name, double found, const char * expected)
{
  if (!isGood)
  {
    throw std::invalid_argument(std::string("the ") + name + " is " + Text(found) + "; expected " + expected);
  }
}

/** \throws std::invalid_argument unless \a value is from 0 to 1e9: larger values have no meaning in any unit, and their
 * products might not be finite. */
inline void
RequireNotNegative(double value, const char * name)
{
  RequireSetting(value >= 0.0 && value <= 1e9, name, value, "0 to 1e9");
}

/** \throws std::invalid_argument unless \a value is from 0 to 1. */
inline void
RequireFraction(double value, const char * name)
{
  RequireSetting(value >= 0.0 && value <= 1.0, name, value, "0 to 1");
}

} // namespace sensornoise

#endif
