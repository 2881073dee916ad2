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
 * \brief The whole series of some pixels, gathered in the third pass: what frames and neighbours share needs them.
 *
 * Integers are held as they are, in 2 bytes, and floating-point numbers above their pixel's mean, in 4; of these, what
 * is not finite is held as 0. Frames may be added in any order and parts merged in any order, with the same bits.
 * Memory: at most 16 MiB, or 32. */
class SensorNoise_EXPORT FrameSample
{
public:
  FrameSample() = default;

  /** The sample of a stack of \a frames frames of TPixel. */
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

  /** The pixels of the frames to come stand as \a layout says; without it, one frame after the other. */
  void
  SetLayout(const PixelLayout & layout)
  {
    m_Layout = layout;
  }

  /** Adds frames firstFrame ... firstFrame + count - 1, of the type that the sample is for; \a mean is that of every
   * pixel. */
  template <typename TPixel>
  void
  AddFrames(const TPixel *              frames,
            std::size_t                 firstFrame,
            std::size_t                 count,
            const std::vector<double> & mean,
            const ParallelFor &         parallelFor = SerialFor);

  /** Takes back all frames. */
  void
  Clear();

  /** Adds the sample of other frames of the same stack. */
  void
  Merge(const FrameSample & other);

  /** Writes the sample, see BinaryStream. */
  void
  Save(std::ostream & out) const;

  /** Replaces the sample by that of a stream. Throws std::runtime_error, and changes nothing, if it holds another one,
   * or ends early. */
  void
  Restore(std::istream & in);

  /** Part of the values at the pixels of \a mask that are those of the frame before, beyond what noise makes [1]; 0 of
   * floating-point numbers. Differences of noise are log-concave: as many are 0 as the square of those of one
   * \a stepDn, over those of two, at most. Estimator.md, 3.12. */
  double
  RepeatedShare(const std::vector<std::uint8_t> & mask, double stepDn) const;

  /** Gives the memory away for the values above \a mean, that of every pixel; the sample is empty after it. */
  NoiseSample
  TakeNoise(const std::vector<double> & mean, const ParallelFor & parallelFor = SerialFor);

  /** The same in two steps, for one who goes on with a tile while it is in the cache: memory for all values, and then
   * those of each tile \a i, which are written to \a noise. */
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

  SampleTiles                m_Tiles;
  std::size_t                m_Width{ 0 };
  std::size_t                m_FramePixels{ 0 };
  PixelLayout                m_Layout;
  double                     m_Lowest{ 0.0 }; // what code 0 stands for: a frame that is not here is 0 in a merge
  std::vector<std::uint16_t> m_Codes;         // of integers
  Eigen::ArrayXf             m_Values;        // of other numbers
};

} // namespace sensornoise

#endif
