// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/ProjectionSums.h"

#include "base/Simd.h"
#include "base/BinaryStream.h"
#include "base/Eigen.h"
#include "base/ParallelWork.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"
#include "pixels/ProjectedFrames.h"
#include "scene/ReferenceFrame.h"
#include "series/SceneSeries.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <ostream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sensornoise
{

namespace
{
/** Returns the name of the sums in a stream. */
const char *
NameOf(SumWidth width)
{
  return width == SumWidth::Wide ? "ProjectionSums" : "ProjectionSums modulo 2^32";
}
} // namespace

ProjectionSums::ProjectionSums(std::size_t         pixels,
                               std::size_t         series,
                               const ParallelFor & parallelFor,
                               std::size_t         firstSlab,
                               std::size_t         lastSlab,
                               SumWidth            width)
  : m_Pixels(pixels)
  , m_Series(series)
  , m_FirstSlab(firstSlab)
  , m_LastSlab(std::min(lastSlab, NumberOfSlabs(pixels)))
  , m_Width(width)
  , m_Wide(NumberOfSlabs(pixels))
  , m_Narrow(NumberOfSlabs(pixels))
{
  this->OnSlabs([&](auto & slabs) {
    for (std::size_t slab = m_FirstSlab; slab < m_LastSlab; ++slab)
    {
      slabs[slab].resize(SizeOfSlab(slab, pixels, series));
    }
  });
  this->Clear(parallelFor); // by all threads, because the first use of the memory is slow
}

void
ProjectionSums::Clear(const ParallelFor & parallelFor)
{
  this->OnSlabs([&](auto & slabs) {
    for (std::size_t slab = m_FirstSlab; slab < m_LastSlab; ++slab)
    {
      auto & sums = slabs[slab];
      ForBlocks(static_cast<std::size_t>(sums.size()), parallelFor, [&sums](std::size_t begin, std::size_t end) {
        std::fill(sums.data() + begin, sums.data() + end, 0);
      });
    }
  });
}

template <typename TPixel, typename TSum>
void
ProjectionSums::AddFramesTo(std::vector<Eigen::Array<TSum, Eigen::Dynamic, 1>> & slabs,
                            const ProjectedFrames<TPixel> &                      frames,
                            std::size_t                                          begin,
                            std::size_t                                          end)
{
  const auto at = [&](std::size_t p) { return slabs[p / SlabPixels].data() + this->IndexInSlab(p, 0); };
  for (std::size_t p = begin; p < end && m_Series > 0;)
  {
    const std::size_t  next = std::min(end, (p / BlockPixels + 1) * BlockPixels);
    const TSum * const ahead = next == end ? nullptr : at(next);
    frames.AddTo(at(p), p, next, std::min(end, next + BlockPixels), ahead);
    p = next;
  }
}

template <typename TPixel>
void
ProjectionSums::AddFrames(const ProjectedFrames<TPixel> & frames, std::size_t begin, std::size_t end)
{
  this->OnSlabs([&](auto & slabs) { this->AddFramesTo(slabs, frames, begin, end); });
}

#define SensorNoise_INSTANTIATE(TPixel) \
  template SensorNoise_EXPORT void ProjectionSums::AddFrames(const ProjectedFrames<TPixel> &, std::size_t, std::size_t)
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE

void
ProjectionSums::Merge(const ProjectionSums & other)
{
  if (other.m_Pixels != m_Pixels || other.m_Series != m_Series || other.m_FirstSlab != m_FirstSlab ||
      other.m_LastSlab != m_LastSlab || other.m_Width != m_Width)
  {
    throw std::invalid_argument("projections of " + std::to_string(other.m_Pixels) + " pixels on " +
                                std::to_string(other.m_Series) + " series cannot be merged into projections of " +
                                std::to_string(m_Pixels) + " pixels on " + std::to_string(m_Series));
  }
  for (std::size_t slab = m_FirstSlab; slab < m_LastSlab; ++slab)
  {
    m_Wide[slab] += other.m_Wide[slab]; // one of both is empty
    m_Narrow[slab] += other.m_Narrow[slab];
  }
}

void
ProjectionSums::Save(std::ostream & out) const
{
  WriteSumsHeader(out, NameOf(m_Width), m_Pixels, 0);
  WriteCount(out, m_Series);
  this->OnSlabs([&](const auto & slabs) {
    for (std::size_t slab = m_FirstSlab; slab < m_LastSlab; ++slab)
    {
      WriteNumbers(out, slabs[slab].data(), static_cast<std::size_t>(slabs[slab].size()));
    }
  });
}

void
ProjectionSums::Restore(std::istream & in)
{
  ProjectionSums read(m_Pixels, m_Series, SerialFor, m_FirstSlab, m_LastSlab, m_Width);
  ReadSumsHeader(in, NameOf(m_Width), m_Pixels);
  RequireCount("series", ReadCount(in), m_Series);
  read.OnSlabs([&](auto & slabs) {
    for (std::size_t slab = m_FirstSlab; slab < m_LastSlab; ++slab)
    {
      ReadNumbers(in, slabs[slab].data(), static_cast<std::size_t>(slabs[slab].size()));
    }
  });
  *this = std::move(read);
}

namespace
{
/** Returns the whole numbers of narrow sums. Their differences from \a total times the whole part of the mean are
 * within 2^31, so that 32 bits give them.
 * \param total sum of the integer series over time, at most half the number of frames */
void
CompleteSums(const std::uint32_t * narrow, double total, const double * means, std::size_t pixels, double * sums)
{
  CallWithAvx2([=] {
    const auto ofTotal = static_cast<std::uint32_t>(static_cast<std::int32_t>(total));
    for (std::size_t i = 0; i < pixels; ++i)
    {
      const auto level = static_cast<std::int32_t>(means[i]);
      const auto difference = static_cast<std::int32_t>(narrow[i] - ofTotal * static_cast<std::uint32_t>(level));
      sums[i] = static_cast<double>(difference) + total * static_cast<double>(level);
    }
  });
}
} // namespace

void
ProjectionSums::CopyBlock(std::size_t           first,
                          std::size_t           pixels,
                          const TemporalBasis & basis,
                          const double *        means,
                          double *              sums) const
{
  const std::size_t place = this->IndexInSlab(first, 0);
  if (m_Width == SumWidth::Wide && m_Series > 0)
  {
    std::copy_n(m_Wide[first / SlabPixels].data() + place, m_Series * BlockPixels, sums);
    return;
  }
  for (std::size_t j = 0; j < m_Series; ++j)
  {
    const std::uint32_t * const narrow = m_Narrow[first / SlabPixels].data() + place + j * BlockPixels;
    CompleteSums(narrow, basis.SumOfRounded(j), means, pixels, sums + j * BlockPixels);
  }
}

namespace detail
{
/** \class SquaresOfBlocks
 * \brief Computes the residual squares of the pixels of a block from its coordinates, which are adjacent for each
 * component. */
class SquaresOfBlocks
{
public:
  static constexpr std::size_t BlockPixels = ProjectionSums::BlockPixels;

  SquaresOfBlocks(const ReferenceFrame & frame, const TemporalBasis & basis, ResidualSquares & squares)
    : m_Variance(frame.variance)
    , m_Squares(squares)
    , m_Dof(static_cast<double>(frame.frames - 1))
  {
    const Eigen::MatrixXd & q = basis.GetBasis();
    const Eigen::VectorXd   skew = q.transpose() * q.cwiseAbs2().rowwise().sum();
    m_Factors.assign(skew.data(), skew.data() + skew.size());
  }

  void
  Fill(const double * coordinates, std::size_t first, std::size_t pixels) const
  {
    CallWithAvx2([&] {
      double squares[BlockPixels]; // a copy that no pointer can alias
      float  skews[BlockPixels] = {};
      m_Variance.CopyTo(squares, first, pixels);
      for (std::size_t i = 0; i < pixels; ++i)
      {
        squares[i] *= m_Dof;
      }
      for (std::size_t j = 0; j < m_Factors.size(); ++j)
      {
        const double * const own = coordinates + j * BlockPixels;
        const double         factor = m_Factors[j];
        for (std::size_t i = 0; i < pixels; ++i)
        {
          squares[i] -= own[i] * own[i];
          skews[i] += static_cast<float>(factor * own[i]);
        }
      }
      m_Squares.rss.SetBlock(first, pixels, squares);
      std::copy_n(skews, pixels, m_Squares.skew.data() + first);
    });
  }

private:
  const PixelMap &    m_Variance;
  ResidualSquares &   m_Squares;
  double              m_Dof;
  std::vector<double> m_Factors; // weights of the coordinates in the skew
};
} // namespace detail

namespace
{
/** Calls function(first, pixels, coordinates) for the blocks of the pixels whose \a sums are held, for several at the
 * same time. begin(first, last) is called before the blocks of a slab; its sums are released after them. */
template <typename TBegin, typename TFunction>
void
ForCoordinates(ProjectionSums &       sums,
               const TemporalBasis &  basis,
               const ReferenceFrame & frame,
               const ParallelFor &    parallelFor,
               TBegin                 begin,
               TFunction              function)
{
  constexpr std::size_t BlockPixels = ProjectionSums::BlockPixels;
  const std::size_t     end = sums.LastPixel();
  while (sums.FirstPixel() < end)
  {
    const std::size_t slab = sums.FirstPixel();
    const std::size_t last = std::min(end, slab + ProjectionSums::SlabPixels);
    begin(slab, last);
    ForBlocks(last - slab, parallelFor, [&](std::size_t from, std::size_t to) {
      std::vector<double> coordinates(basis.Size() * BlockPixels);
      double              buffer[BlockPixels];
      for (std::size_t first = slab + from; first < slab + to; first += BlockPixels)
      {
        const std::size_t    pixels = std::min(BlockPixels, slab + to - first);
        const double * const means = frame.MeansOf(first, pixels, buffer);
        sums.CopyBlock(first, pixels, basis, means, coordinates.data());
        basis.ToCoordinates(coordinates.data(), BlockPixels, means, pixels);
        function(first, pixels, coordinates.data());
      }
    });
    sums.ReleaseFirstSlab();
  }
}
} // namespace

void
AppendResidualSquares(const ReferenceFrame & frame,
                      const TemporalBasis &  basis,
                      ProjectionSums &       sums,
                      const ParallelFor &    parallelFor,
                      ResidualSquares &      squares,
                      PixelCoordinates &     coordinates)
{
  const detail::SquaresOfBlocks blocks(frame, basis, squares);
  squares.rss.Reserve(frame.variance.size());
  squares.skew.reserve(frame.variance.size());
  const auto begin = [&](std::size_t first, std::size_t last) {
    squares.rss.Grow(last, parallelFor);
    GrowMap(squares.skew, last, parallelFor);
    coordinates.AllocateSlabOf(first);
  };
  ForCoordinates(
    sums, basis, frame, parallelFor, begin, [&](std::size_t first, std::size_t pixels, const double * own) {
      blocks.Fill(own, first, pixels);
      coordinates.SetBlock(first, pixels, own);
    });
}

void
FillCoordinates(const ReferenceFrame & frame,
                const TemporalBasis &  basis,
                ProjectionSums &       sums,
                const ParallelFor &    parallelFor,
                PixelCoordinates &     coordinates)
{
  const auto begin = [&](std::size_t first, std::size_t) { coordinates.AllocateSlabOf(first); };
  ForCoordinates(
    sums, basis, frame, parallelFor, begin, [&](std::size_t first, std::size_t pixels, const double * own) {
      coordinates.SetBlock(first, pixels, own);
    });
}

template <typename TPixel>
void
FillResidualSquares(const ReferenceFrame &          frame,
                    const TemporalBasis &           basis,
                    const ProjectedFrames<TPixel> & frames,
                    std::size_t                     begin,
                    std::size_t                     end,
                    ResidualSquares &               squares,
                    PixelCoordinates &              coordinates)
{
  constexpr std::size_t         BlockPixels = ProjectionSums::BlockPixels;
  const detail::SquaresOfBlocks blocks(frame, basis, squares);
  std::vector<double>           sums(basis.Size() * BlockPixels);
  for (std::size_t first = begin; first < end; first += BlockPixels)
  {
    const std::size_t last = std::min(end, first + BlockPixels);
    std::fill(sums.begin(), sums.end(), 0.0);
    frames.AddTo(sums.data(), first, last, std::min(end, last + BlockPixels));
    basis.ToCoordinates(sums.data(), BlockPixels, frame.mean.data() + first, last - first);
    blocks.Fill(sums.data(), first, last - first);
    coordinates.SetBlock(first, last - first, sums.data());
  }
}

#define SensorNoise_INSTANTIATE(TPixel)                                                 \
  template SensorNoise_EXPORT void FillResidualSquares(const ReferenceFrame &,          \
                                                       const TemporalBasis &,           \
                                                       const ProjectedFrames<TPixel> &, \
                                                       std::size_t,                     \
                                                       std::size_t,                     \
                                                       ResidualSquares &,               \
                                                       PixelCoordinates &)
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE

} // namespace sensornoise
