// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_scene_ReferenceFrame_h
#define sensornoise_scene_ReferenceFrame_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"
#include "base/PixelMap.h"
#include "base/Stencils.h"
#include "base/Simd.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

/** \class PackedMeans
 * \brief Means of the pixels of integer frames, as the sums that they are quotients of: 4 bytes for each pixel, and the
 * same bits. */
class SensorNoise_EXPORT PackedMeans
{
public:
  /** Moves \a means here if 32 bits hold each of them: it is a whole number over \a frames, plus \a centreDn. Otherwise
   * \a means stay as they are. */
  void
  Pack(std::vector<double> & means, std::size_t frames, double centreDn, const ParallelFor & parallelFor);

  bool
  IsEmpty() const
  {
    return m_Sums.empty();
  }
  /** Sets \a means to the means of \a pixels pixels from pixel \a first on [DN]. */
  void
  Fill(double * means, std::size_t first, std::size_t pixels) const
  {
    for (std::size_t i = 0; i < pixels; ++i)
    {
      means[i] = static_cast<double>(m_Sums[first + i]) / m_Frames + m_CentreDn;
    }
  }
  /** Moves the means to \a means. */
  void
  Unpack(std::vector<double> & means, const ParallelFor & parallelFor);

private:
  std::vector<std::int32_t> m_Sums; // sums over time of the values minus m_CentreDn
  double                    m_Frames{ 1.0 };
  double                    m_CentreDn{ 0.0 };
};

/** Reference frame from one pass over the stack, with which all frames are compared: mean and variance of every pixel.
 */
struct ReferenceFrame
{
  FrameGeometry       geometry;
  std::size_t         frames{ 0 };   ///< number of distinct frames T
  std::vector<double> mean;          ///< mean over time [DN]; a pixel without one has the mean of its neighbours
  std::vector<float>  neighbourMean; ///< mean of the 8 neighbours, without the pixel itself [DN]
  PixelMap            variance;      ///< unbiased variance over time, flicker and motion included [DN^2]; NaN: unknown
  /** 1: the pixel and its 8 neighbours are valid, it varies, and it is StencilMargin pixels from the border. */
  std::vector<std::uint8_t> usable;
  PackedMeans               packedMean; ///< `mean` while the third pass holds its sums, without `usable`; else empty

  /** Returns the means of \a pixels pixels from pixel \a first on [DN]: \a buffer, or a part of `mean`. */
  const double *
  MeansOf(std::size_t first, std::size_t pixels, double * buffer) const
  {
    if (packedMean.IsEmpty())
    {
      return mean.data() + first;
    }
    packedMean.Fill(buffer, first, pixels);
    return buffer;
  }
};

/** Makes the reference frame from maps of the mean and the unbiased variance, which are moved; NaN at pixels without
 * them.
 *
 * Weights are functions of the mean of the neighbours, never of the pixel itself. Weights that depend on the noise of
 * the pixel bias the variance by a fraction of order 1/T at the darkest pixels (estimator.md, 3.2). */
SensorNoise_EXPORT ReferenceFrame
MakeReferenceFrame(std::vector<double>               mean,
                   std::vector<double>               variance,
                   const std::vector<std::uint8_t> & valid,
                   const FrameGeometry &             geometry,
                   std::size_t                       frames,
                   const ParallelFor &               parallelFor = SerialFor);

/** Returns ReferenceFrame::neighbourMean, computed from the other maps of \a frame. A pixel without a mean is no
 * neighbour. */
SensorNoise_EXPORT std::vector<float>
ComputeNeighbourMean(const ReferenceFrame & frame, const ParallelFor & parallelFor = SerialFor);

/** Returns the means of \a frame [DN], with NaN where there is none, as in a map for display. */
SensorNoise_EXPORT std::vector<double>
KnownMeans(const ReferenceFrame & frame, const ParallelFor & parallelFor = SerialFor);

/** Calls function(begin, end) for blocks of the pixels of all rows except those next to the border, in any order and
 * possibly at the same time. Within these blocks a stencil reads nothing outside of the map, not even at the ends of
 * the rows, where its value has no meaning. Loops over whole blocks therefore need no test, and are compiled to SIMD
 * instructions (AVX2). */
template <typename TFunction>
void
ForInnerBlocks(const FrameGeometry & geometry, const ParallelFor & parallelFor, TFunction function)
{
  if (geometry.height > 2 * StencilMargin)
  {
    const std::size_t first = StencilMargin * geometry.width;
    ForBlocks(geometry.Pixels() - 2 * first, parallelFor, [&function, first](std::size_t begin, std::size_t end) {
      CallWithAvx2([&] { function(first + begin, first + end); });
    });
  }
}

/** Returns the largest absolute level of a \a mean [DN]. */
SensorNoise_EXPORT double
LargestMeanDn(const std::vector<double> & mean);

} // namespace sensornoise

#endif
