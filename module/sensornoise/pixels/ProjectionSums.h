// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_ProjectionSums_h
#define sensornoise_pixels_ProjectionSums_h

#include "SensorNoiseExport.h"
#include "sensornoise/base/Eigen.h"
#include "sensornoise/base/Parallel.h"

#include <cstddef>
#include <istream>
#include <ostream>

namespace sensornoise
{

class TemporalBasis;

/** \class ProjectionSums
 * \brief The third pass: the sums over time of every pixel with each series of a TemporalBasis.
 *
 * With moments and these sums, the residual sum of squares of any pixel about any of the series follows without reading
 * the stack again (estimator.md, 6). For integer pixels they are exact integers, held in doubles: up to 2^16 frames,
 * frames may be added and parts merged in any order, with the same bits. Floating-point frames are added one by one in
 * time order.
 *
 * Memory: 8 bytes a pixel and series. */
class SensorNoise_EXPORT ProjectionSums
{
public:
  /** Pixels whose sums with one series lie side by side; those of a block stay in the first-level cache. */
  static constexpr std::size_t BlockPixels = 256;

  explicit ProjectionSums(std::size_t pixels = 0, std::size_t series = 0, const ParallelFor & parallelFor = SerialFor);

  /** Adds frames firstFrame ... firstFrame + count - 1, stored one after the other, for the pixels [begin, end).
   * Different ranges may be added at the same time. */
  template <typename TPixel>
  void
  AddFrames(const TemporalBasis & basis,
            const TPixel *        frames,
            std::size_t           firstFrame,
            std::size_t           count,
            std::size_t           begin,
            std::size_t           end);

  /** Adds the sums of other frames of the same pixels. */
  void
  Merge(const ProjectionSums & other);

  /** Writes the sums, see BinaryStream. */
  void
  Save(std::ostream & out) const;

  /** Replaces the sums by those of a stream. Throws std::runtime_error, and changes nothing, if it holds other sums, or
   * those of other numbers of pixels or series, or ends early. */
  void
  Restore(std::istream & in);

  std::size_t
  GetNumberOfSeries() const
  {
    return m_Series;
  }
  /** The sum of pixel \a p with series \a j. Those of the next pixels of its block follow. */
  double &
  At(std::size_t p, std::size_t j)
  {
    return m_Sums.data()[this->IndexOf(p, j)];
  }
  const double &
  At(std::size_t p, std::size_t j) const
  {
    return m_Sums.data()[this->IndexOf(p, j)];
  }

private:
  /** Adds integers of at most 32 frames, in whole numbers: in any order the same sums. */
  template <typename TPixel>
  void
  AddTogether(const TemporalBasis & basis,
              const TPixel *        frames,
              std::size_t           firstFrame,
              std::size_t           count,
              std::size_t           begin,
              std::size_t           end);
  template <typename TPixel>
  void
  AddOneByOne(const TemporalBasis & basis,
              const TPixel *        frames,
              std::size_t           firstFrame,
              std::size_t           count,
              std::size_t           begin,
              std::size_t           end);
  std::size_t
  IndexOf(std::size_t p, std::size_t j) const
  {
    return (p / BlockPixels * m_Series + j) * BlockPixels + p % BlockPixels;
  }

  std::size_t    m_Pixels;
  std::size_t    m_Series;
  Eigen::ArrayXd m_Sums; // unlike std::vector, not filled by one thread
};

extern template SensorNoise_EXPORT void
ProjectionSums::AddFrames(const TemporalBasis &,
                          const unsigned char *,
                          std::size_t,
                          std::size_t,
                          std::size_t,
                          std::size_t);
extern template SensorNoise_EXPORT void
ProjectionSums::AddFrames(const TemporalBasis &,
                          const unsigned short *,
                          std::size_t,
                          std::size_t,
                          std::size_t,
                          std::size_t);
extern template SensorNoise_EXPORT void
ProjectionSums::AddFrames(const TemporalBasis &, const short *, std::size_t, std::size_t, std::size_t, std::size_t);
extern template SensorNoise_EXPORT void
ProjectionSums::AddFrames(const TemporalBasis &, const float *, std::size_t, std::size_t, std::size_t, std::size_t);
extern template SensorNoise_EXPORT void
ProjectionSums::AddFrames(const TemporalBasis &, const double *, std::size_t, std::size_t, std::size_t, std::size_t);

} // namespace sensornoise

#endif
