// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_FrameSample_h
#define sensornoise_correlation_FrameSample_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"
#include "base/PixelLayout.h"
#include "correlation/NoiseSample.h"
#include "correlation/SampleTiles.h"

#include <cstddef>
#include <cstdint>
#include <istream>
#include <limits>
#include <ostream>
#include <type_traits>
#include <vector>

namespace sensornoise
{

/** \class FrameSample
 * \brief Complete time series of the sampled pixels, which the third pass gathers to measure the noise correlation.
 *
 * Integers are stored unchanged in 2 bytes. Floating-point numbers are stored above the mean of their pixel in 4
 * bytes; values that are not finite are stored as 0. Frames may be added in any order, and samples merged in any
 * order, with identical results. Memory: at most 16 MiB for integers, 32 MiB for floating-point numbers. */
class SensorNoise_EXPORT FrameSample
{
public:
  FrameSample() = default;

  /** Returns the empty sample of a stack of \a frames frames of TPixel. */
  template <typename TPixel>
  static FrameSample
  Of(const FrameGeometry & geometry, std::size_t frames, const ParallelFor & parallelFor = SerialFor)
  {
    constexpr bool isInteger = std::is_integral_v<TPixel>;
    static_assert(!isInteger || sizeof(TPixel) <= sizeof(std::uint16_t));
    return FrameSample(geometry,
                       frames,
                       isInteger,
                       isInteger ? static_cast<double>(std::numeric_limits<TPixel>::lowest()) : 0.0,
                       parallelFor);
  }

  /** Sets the memory layout of the pixels in the frames to come. Default: one frame after the other. */
  void
  SetLayout(const PixelLayout & layout)
  {
    m_Layout = layout;
  }

  /** Adds frames firstFrame ... firstFrame + count - 1, whose pixel type is the type of the sample. \a mean is the mean
   * of every pixel [DN]. */
  template <typename TPixel>
  void
  AddFrames(const TPixel *              frames,
            std::size_t                 firstFrame,
            std::size_t                 count,
            const std::vector<double> & mean,
            const ParallelFor &         parallelFor = SerialFor);

  /** Removes all frames. */
  void
  Clear();

  /** Adds the sample of other frames of the same stack. Throws std::invalid_argument if the stack is another one. */
  void
  Merge(const FrameSample & other);

  /** Writes the sample to a stream, see BinaryStream. */
  void
  Save(std::ostream & out) const;

  /** Replaces the sample by the sample in a stream. Throws std::runtime_error, and changes nothing, if the stream holds
   * a sample of another stack or ends early. */
  void
  Restore(std::istream & in);

  /** Returns the fraction of the pixels of \a mask that repeat their value in the frame before, beyond the number that
   * noise explains [1]; 0 for floating-point numbers. Differences of noise are log-concave: the expected number of
   * zeros is at most the squared number of differences of one \a stepDn [DN], over the number of differences of two.
   * Estimator.md, 3.12. */
  double
  RepeatedFraction(const std::vector<std::uint8_t> & mask, double stepDn) const;

  /** Returns the values above \a mean, the mean of every pixel [DN]. The sample hands over its memory and is empty
   * afterwards. */
  NoiseSample
  TakeNoise(const std::vector<double> & mean, const ParallelFor & parallelFor = SerialFor);

  /** Do the work of TakeNoise() in two steps, so that a tile can be processed while it is in the cache. StartNoise()
   * returns the memory of all values; FillNoise() writes the values of tile \a i to \a noise. */
  NoiseSample
  StartNoise();
  void
  FillNoise(std::size_t i, const std::vector<double> & mean, NoiseSample & noise) const;

private:
  FrameSample(const FrameGeometry & geometry,
              std::size_t           frames,
              bool                  isInteger,
              double                lowest,
              const ParallelFor &   parallelFor);

  SampleTiles m_Tiles;
  std::size_t m_Width{ 0 };
  std::size_t m_FramePixels{ 0 };
  PixelLayout m_Layout;
  double      m_Lowest{ 0.0 };         // value that the stored number 0 means [DN]: frames that are missing are 0 in a
                                       // merge
  std::vector<std::uint16_t> m_Codes;  // integers
  Eigen::ArrayXf             m_Values; // floating-point numbers
};

} // namespace sensornoise

#endif
