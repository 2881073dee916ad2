// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_ProjectionSums_h
#define sensornoise_pixels_ProjectionSums_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "sensornoise/Parallel.h"
#include "pixels/ProjectedFrames.h"

#include <algorithm>
#include <cstddef>
#include <istream>
#include <limits>
#include <ostream>
#include <vector>

namespace sensornoise
{

/** \class ProjectionSums
 * \brief The third pass: the sums over time of every pixel with each series of a TemporalBasis.
 *
 * With moments and these sums, the residual sum of squares of any pixel about any of the series follows without reading
 * the stack again (estimator.md, 6). For integer pixels they are exact, see ProjectedFrames, so frames may be added and
 * parts merged in any order, with the same bits. Floating-point frames are added one by one in time order.
 *
 * Memory: 8 bytes a pixel and series, in slabs that can be given back one by one. Of a large frame the sums of some
 * slabs can be made by themselves. */
class SensorNoise_EXPORT ProjectionSums
{
public:
  /** Pixels whose sums with one series lie side by side. */
  static constexpr std::size_t BlockPixels = ProjectedFrames<float>::BlockPixels;
  /** Pixels of a slab. Set by hand: with one series it has 4 MiB, which the system takes back at once. */
  static constexpr std::size_t SlabPixels = std::size_t{ 1 } << 19;

  /** The sums of the slabs [firstSlab, lastSlab) of frames of \a pixels pixels; those that the frame does not have are
   * left out. */
  explicit ProjectionSums(std::size_t         pixels = 0,
                          std::size_t         series = 0,
                          const ParallelFor & parallelFor = SerialFor,
                          std::size_t         firstSlab = 0,
                          std::size_t         lastSlab = std::numeric_limits<std::size_t>::max());

  /** The number of slabs of frames of \a pixels pixels. */
  static std::size_t
  NumberOfSlabs(std::size_t pixels)
  {
    return (pixels + SlabPixels - 1) / SlabPixels;
  }
  /** The pixels [first, last) whose sums are held, and were not given back. */
  std::size_t
  FirstPixel() const
  {
    return m_FirstSlab * SlabPixels;
  }
  std::size_t
  LastPixel() const
  {
    return std::min(m_Pixels, m_LastSlab * SlabPixels);
  }
  /** Makes all sums 0. */
  void
  Clear(const ParallelFor & parallelFor);

  /** Gives the memory of the first slab that is held back. */
  void
  ReleaseFirstSlab()
  {
    m_Slabs[m_FirstSlab++].resize(0);
  }

  /** Adds frames of the same size, projected on the same number of series, for the pixels [begin, end), which must be
   * held. Different ranges may be added at the same time. */
  template <typename TPixel>
  void
  AddFrames(const ProjectedFrames<TPixel> & frames, std::size_t begin, std::size_t end);

  /** Adds the sums of other frames of the same pixels. */
  void
  Merge(const ProjectionSums & other);

  /** Writes the sums, see BinaryStream. */
  void
  Save(std::ostream & out) const;

  /** Replaces the sums by those of a stream, which must be of the same slabs. Throws std::runtime_error, and changes
   * nothing, if it holds other sums, or those of other numbers of pixels or series, or ends early. */
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
    return m_Slabs[p / SlabPixels].data()[this->IndexInSlab(p % SlabPixels, j)];
  }
  const double &
  At(std::size_t p, std::size_t j) const
  {
    return m_Slabs[p / SlabPixels].data()[this->IndexInSlab(p % SlabPixels, j)];
  }

private:
  std::size_t
  IndexInSlab(std::size_t p, std::size_t j) const
  {
    return (p / BlockPixels * m_Series + j) * BlockPixels + p % BlockPixels;
  }

  std::size_t                 m_Pixels;
  std::size_t                 m_Series;
  std::size_t                 m_FirstSlab;
  std::size_t                 m_LastSlab;
  std::vector<Eigen::ArrayXd> m_Slabs; // unlike std::vector, not filled by one thread
};

} // namespace sensornoise

#endif
