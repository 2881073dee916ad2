// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_ProjectionSums_h
#define sensornoise_pixels_ProjectionSums_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "base/PixelMap.h"
#include "sensornoise/Parallel.h"
#include "pixels/ProjectedFrames.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <limits>
#include <ostream>
#include <vector>

namespace sensornoise
{

class TemporalBasis;
struct ReferenceFrame;

/** Storage of a sum of the third pass. */
enum class SumWidth : std::uint8_t
{
  Wide,  ///< as a double, 8 bytes
  Narrow ///< modulo 2^32, 4 bytes: for integer frames and series of UnitOfNarrowSums()
};

/** Returns the size of a sum [bytes]. */
constexpr std::size_t
BytesOf(SumWidth width)
{
  return width == SumWidth::Wide ? sizeof(double) : sizeof(std::uint32_t);
}

/** \class ProjectionSums
 * \brief Third pass: the sum over time of every pixel's values times each component of a TemporalBasis.
 *
 * Moments and these sums give the residual sum of squares of any pixel about any of the components without another pass
 * over the stack (estimator.md, 6). For integer pixels the sums are exact, see ProjectedFrames, so the order of frames
 * and of merged parts does not change a bit. Floating-point frames are added one by one in the order of time.
 *
 * Memory: 8 or 4 bytes per pixel and component, in slabs that can be released one by one. For a large frame, an object
 * can hold the sums of some slabs only. */
class SensorNoise_EXPORT ProjectionSums
{
public:
  /** Number of pixels whose sums with one component are adjacent. */
  static constexpr std::size_t BlockPixels = ProjectedFrames<float>::BlockPixels;
  /** Number of pixels of a slab. Chosen empirically: with one component a slab has 2 or 4 MiB, which the operating
   * system takes back at once. */
  static constexpr std::size_t SlabPixels = std::size_t{ 1 } << 19;

  /** Allocates the sums, all 0, of the slabs [firstSlab, lastSlab) of frames of \a pixels pixels. Slabs beyond the
   * frame are left out. \a series is the number of components. */
  explicit ProjectionSums(std::size_t         pixels = 0,
                          std::size_t         series = 0,
                          const ParallelFor & parallelFor = SerialFor,
                          std::size_t         firstSlab = 0,
                          std::size_t         lastSlab = std::numeric_limits<std::size_t>::max(),
                          SumWidth            width = SumWidth::Wide);

  /** Returns the number of values of slab \a slab, whole blocks, in frames of \a pixels pixels with \a series
   * components.
   */
  static Eigen::Index
  SizeOfSlab(std::size_t slab, std::size_t pixels, std::size_t series)
  {
    const std::size_t own = std::min(SlabPixels, pixels - slab * SlabPixels);
    return static_cast<Eigen::Index>((own + BlockPixels - 1) / BlockPixels * BlockPixels * series);
  }
  /** Returns the place in its slab of the value of pixel \a p in component \a j of \a series. */
  static std::size_t
  IndexInSlab(std::size_t p, std::size_t j, std::size_t series)
  {
    return (p % SlabPixels / BlockPixels * series + j) * BlockPixels + p % BlockPixels;
  }
  /** Returns the number of slabs of frames of \a pixels pixels. */
  static std::size_t
  NumberOfSlabs(std::size_t pixels)
  {
    return (pixels + SlabPixels - 1) / SlabPixels;
  }
  /** Returns the first pixel, and the end, of the range whose sums are held and not yet released. */
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
  /** Sets all sums to 0. */
  void
  Clear(const ParallelFor & parallelFor);

  /** Releases the memory of the first slab that is held. */
  void
  ReleaseFirstSlab()
  {
    m_Wide[m_FirstSlab].resize(0);
    m_Narrow[m_FirstSlab++].resize(0);
  }

  /** Adds \a frames of the same size and number of components for the pixels [begin, end), which must be held.
   * Different ranges may be added at the same time. Floating-point frames need wide sums. */
  template <typename TPixel>
  void
  AddFrames(const ProjectedFrames<TPixel> & frames, std::size_t begin, std::size_t end);

  /** Adds the sums of other frames. Throws std::invalid_argument if the numbers of pixels or components, the slabs, or
   * the widths differ. */
  void
  Merge(const ProjectionSums & other);

  /** Writes the sums, see BinaryStream. */
  void
  Save(std::ostream & out) const;

  /** Replaces the sums by the sums in a stream, which must have the same slabs. Throws std::runtime_error, and changes
   * nothing, if the stream holds other sums, has another number of pixels or components, or ends early. */
  void
  Restore(std::istream & in);

  std::size_t
  GetNumberOfSeries() const
  {
    return m_Series;
  }
  /** Returns the sum of pixel \a p with component \a j, which is wide. The sums of the next pixels of its block
   * follow. */
  double &
  At(std::size_t p, std::size_t j)
  {
    return m_Wide[p / SlabPixels].data()[this->IndexInSlab(p, j)];
  }
  const double &
  At(std::size_t p, std::size_t j) const
  {
    return m_Wide[p / SlabPixels].data()[this->IndexInSlab(p, j)];
  }

  /** Copies the sums of \a pixels pixels of a block, from its first pixel \a first on, to sums[j BlockPixels + i] for
   * component j. Narrow sums are completed: 2^32 is added or subtracted until the sum over time of series times value
   * minus mean is within 2^31. \a means are the means of the values of these pixels over time. */
  void
  CopyBlock(std::size_t first, std::size_t pixels, const TemporalBasis & basis, const double * means, double * sums)
    const;

private:
  using NarrowSlab = Eigen::Array<std::uint32_t, Eigen::Dynamic, 1>;

  std::size_t
  IndexInSlab(std::size_t p, std::size_t j) const
  {
    return IndexInSlab(p, j, m_Series);
  }
  /** Calls function(slabs), with the slabs of the width of this object. */
  template <typename TFunction>
  void
  OnSlabs(TFunction function)
  {
    m_Width == SumWidth::Wide ? function(m_Wide) : function(m_Narrow);
  }
  template <typename TFunction>
  void
  OnSlabs(TFunction function) const
  {
    m_Width == SumWidth::Wide ? function(m_Wide) : function(m_Narrow);
  }
  template <typename TPixel, typename TSum>
  void
  AddFramesTo(std::vector<Eigen::Array<TSum, Eigen::Dynamic, 1>> & slabs,
              const ProjectedFrames<TPixel> &                      frames,
              std::size_t                                          begin,
              std::size_t                                          end);

  std::size_t                 m_Pixels;
  std::size_t                 m_Series;
  std::size_t                 m_FirstSlab;
  std::size_t                 m_LastSlab;
  SumWidth                    m_Width;
  std::vector<Eigen::ArrayXd> m_Wide; // unlike std::vector, not filled by one thread when resized
  std::vector<NarrowSlab>     m_Narrow;
};

/** \class PixelCoordinates
 * \brief Coordinates S_j of every pixel's time series in the first components of a TemporalBasis: the pixel's response
 * to each component [DN].
 *
 * Memory: 4 bytes per pixel and component. */
class SensorNoise_EXPORT PixelCoordinates
{
public:
  /** Number of pixels whose coordinates of one component are adjacent. */
  static constexpr std::size_t BlockPixels = ProjectionSums::BlockPixels;

  /** Has room for the coordinates of \a pixels pixels in \a series components, which are not set; without components:
   * for none. */
  explicit PixelCoordinates(std::size_t pixels = 0, std::size_t series = 0)
    : m_Pixels(pixels)
    , m_Series(series)
    , m_Slabs(series > 0 ? ProjectionSums::NumberOfSlabs(pixels) : 0)
  {}

  std::size_t
  GetNumberOfSeries() const
  {
    return m_Series;
  }
  /** Allocates the memory of the slab (ProjectionSums) of pixel \a first. */
  void
  AllocateSlabOf(std::size_t first)
  {
    if (m_Series > 0)
    {
      const std::size_t slab = first / ProjectionSums::SlabPixels;
      m_Slabs[slab].resize(ProjectionSums::SizeOfSlab(slab, m_Pixels, m_Series));
    }
  }
  /** Sets the coordinates of \a pixels pixels of a block, from its first pixel \a first on, to
   * coordinates[j BlockPixels + i] for component j. */
  void
  SetBlock(std::size_t first, std::size_t pixels, const double * coordinates)
  {
    for (std::size_t j = 0; j < m_Series; ++j)
    {
      const double * const own = coordinates + j * BlockPixels;
      float * const        place = m_Slabs[first / ProjectionSums::SlabPixels].data() + this->IndexInSlab(first, j);
      std::transform(own, own + pixels, place, [](double s) { return static_cast<float>(s); });
    }
  }
  /** Returns the coordinate of pixel \a p in component \a j [DN]. */
  double
  At(std::size_t p, std::size_t j) const
  {
    return static_cast<double>(m_Slabs[p / ProjectionSums::SlabPixels].data()[this->IndexInSlab(p, j)]);
  }

private:
  std::size_t
  IndexInSlab(std::size_t p, std::size_t j) const
  {
    return ProjectionSums::IndexInSlab(p, j, m_Series);
  }

  std::size_t                 m_Pixels;
  std::size_t                 m_Series;
  std::vector<Eigen::ArrayXf> m_Slabs;
};

/** Squared deviations of every pixel without the components of a basis: all that ProjectedVariance needs of the
 * coordinates S_j. */
struct ResidualSquares
{
  PixelMap           rss;  ///< sum of squares about the mean minus sum_j S_j^2 [DN^2]
  std::vector<float> skew; ///< sum_i S_i sum_j K_ij, K_ij = sum_t Q_tj^2 Q_ti [DN]
};

/** Appends the squares of the pixels whose \a sums are held, which must follow the pixels that \a squares has already.
 * The sums are released slab by slab. \a coordinates is filled too, for as many of the first components as it has. */
SensorNoise_EXPORT void
AppendResidualSquares(const ReferenceFrame & frame,
                      const TemporalBasis &  basis,
                      ProjectionSums &       sums,
                      const ParallelFor &    parallelFor,
                      ResidualSquares &      squares,
                      PixelCoordinates &     coordinates);

/** Fills \a squares, which has a place for every pixel, for the pixels [begin, end). \a frames are all frames of a
 * stack; no sums are held, and the bits are the same. \a begin must be a multiple of ProjectionSums::BlockPixels.
 * \a coordinates is filled too, for as many of the first components as it has; its memory is allocated. Different
 * pixels may be filled at the same time. */
template <typename TPixel>
void
FillResidualSquares(const ReferenceFrame &          frame,
                    const TemporalBasis &           basis,
                    const ProjectedFrames<TPixel> & frames,
                    std::size_t                     begin,
                    std::size_t                     end,
                    ResidualSquares &               squares,
                    PixelCoordinates &              coordinates);

/** Fills \a coordinates, for as many of the first components as it has, of the \a sums of all pixels, which are
 * released slab by slab. \a frame has the means over time. */
SensorNoise_EXPORT void
FillCoordinates(const ReferenceFrame & frame,
                const TemporalBasis &  basis,
                ProjectionSums &       sums,
                const ParallelFor &    parallelFor,
                PixelCoordinates &     coordinates);

} // namespace sensornoise

#endif
