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
constexpr const char * Name = "ProjectionSums";
} // namespace

ProjectionSums::ProjectionSums(std::size_t         pixels,
                               std::size_t         series,
                               const ParallelFor & parallelFor,
                               std::size_t         firstSlab,
                               std::size_t         lastSlab)
  : m_Pixels(pixels)
  , m_Series(series)
  , m_FirstSlab(firstSlab)
  , m_LastSlab(std::min(lastSlab, NumberOfSlabs(pixels)))
  , m_Slabs(NumberOfSlabs(pixels))
{
  for (std::size_t slab = m_FirstSlab; slab < m_LastSlab; ++slab)
  {
    const std::size_t own = std::min(SlabPixels, pixels - slab * SlabPixels);
    Eigen::ArrayXd &  sums = m_Slabs[slab];
    sums.resize(static_cast<Eigen::Index>((own + BlockPixels - 1) / BlockPixels * BlockPixels * series));
  }
  this->Clear(parallelFor); // by all threads, because the first use of the memory is slow
}

void
ProjectionSums::Clear(const ParallelFor & parallelFor)
{
  for (std::size_t slab = m_FirstSlab; slab < m_LastSlab; ++slab)
  {
    Eigen::ArrayXd & sums = m_Slabs[slab];
    ForBlocks(static_cast<std::size_t>(sums.size()), parallelFor, [&sums](std::size_t begin, std::size_t end) {
      std::fill(sums.data() + begin, sums.data() + end, 0.0);
    });
  }
}

template <typename TPixel>
void
ProjectionSums::AddFrames(const ProjectedFrames<TPixel> & frames, std::size_t begin, std::size_t end)
{
  for (std::size_t p = begin; p < end && m_Series > 0;)
  {
    const std::size_t next = std::min(end, (p / BlockPixels + 1) * BlockPixels);
    const bool        isLast = next == end;
    frames.AddTo(&this->At(p, 0), p, next, std::min(end, next + BlockPixels), isLast ? nullptr : &this->At(next, 0));
    p = next;
  }
}

#define SensorNoise_INSTANTIATE(TPixel) \
  template SensorNoise_EXPORT void ProjectionSums::AddFrames(const ProjectedFrames<TPixel> &, std::size_t, std::size_t)
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE

void
ProjectionSums::Merge(const ProjectionSums & other)
{
  if (other.m_Pixels != m_Pixels || other.m_Series != m_Series || other.m_FirstSlab != m_FirstSlab ||
      other.m_LastSlab != m_LastSlab)
  {
    throw std::invalid_argument("projections of " + std::to_string(other.m_Pixels) + " pixels on " +
                                std::to_string(other.m_Series) + " series cannot be merged into those of " +
                                std::to_string(m_Pixels) + " pixels on " + std::to_string(m_Series));
  }
  for (std::size_t slab = m_FirstSlab; slab < m_LastSlab; ++slab)
  {
    m_Slabs[slab] += other.m_Slabs[slab];
  }
}

void
ProjectionSums::Save(std::ostream & out) const
{
  WriteSumsHeader(out, Name, m_Pixels, 0);
  WriteCount(out, m_Series);
  for (std::size_t slab = m_FirstSlab; slab < m_LastSlab; ++slab)
  {
    WriteNumbers(out, m_Slabs[slab].data(), static_cast<std::size_t>(m_Slabs[slab].size()));
  }
}

void
ProjectionSums::Restore(std::istream & in)
{
  ProjectionSums read(m_Pixels, m_Series, SerialFor, m_FirstSlab, m_LastSlab);
  ReadSumsHeader(in, Name, m_Pixels);
  RequireCount("series", ReadCount(in), m_Series);
  for (std::size_t slab = m_FirstSlab; slab < m_LastSlab; ++slab)
  {
    ReadNumbers(in, read.m_Slabs[slab].data(), static_cast<std::size_t>(read.m_Slabs[slab].size()));
  }
  *this = std::move(read);
}

PixelCoordinates::PixelCoordinates(ProjectionSums &&           sums,
                                   const TemporalBasis &       basis,
                                   const std::vector<double> & mean,
                                   const ParallelFor &         parallelFor)
  : m_Coordinates(std::move(sums))
{
  if (basis.Size() == 0 || mean.empty())
  {
    return;
  }
  const std::size_t offset = m_Coordinates.FirstPixel();
  ForBlocks(m_Coordinates.LastPixel() - offset, parallelFor, [&](std::size_t begin, std::size_t end) {
    end += offset;
    for (std::size_t p = begin + offset; p < end; p += BlockPixels)
    {
      basis.ToCoordinates(&m_Coordinates.At(p, 0), BlockPixels, mean.data() + p, std::min(BlockPixels, end - p));
    }
  });
}

PixelCoordinates::PixelCoordinates(ProjectionSums && coordinates)
  : m_Coordinates(std::move(coordinates))
{}

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
    : m_Variance(frame.variance.data())
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
      double               squares[BlockPixels]; // a copy that no pointer can alias
      float                skews[BlockPixels] = {};
      const double * const variance = m_Variance + first;
      for (std::size_t i = 0; i < pixels; ++i)
      {
        squares[i] = m_Dof * variance[i];
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
      std::copy_n(squares, pixels, m_Squares.rss.data() + first);
      std::copy_n(skews, pixels, m_Squares.skew.data() + first);
    });
  }

private:
  const double *      m_Variance;
  ResidualSquares &   m_Squares;
  double              m_Dof;
  std::vector<double> m_Factors; // weights of the coordinates in the skew
};
} // namespace detail

void
AppendResidualSquares(const ReferenceFrame & frame,
                      const TemporalBasis &  basis,
                      ProjectionSums &       sums,
                      bool                   keepCoordinates,
                      const ParallelFor &    parallelFor,
                      ResidualSquares &      squares)
{
  constexpr std::size_t         BlockPixels = ProjectionSums::BlockPixels;
  const detail::SquaresOfBlocks blocks(frame, basis, squares);
  squares.rss.reserve(frame.mean.size());
  squares.skew.reserve(frame.mean.size());
  const auto append = [&](std::size_t firstPixel, std::size_t lastPixel) {
    GrowMap(squares.rss, lastPixel, parallelFor);
    GrowMap(squares.skew, lastPixel, parallelFor);
    ForBlocks(lastPixel - firstPixel, parallelFor, [&](std::size_t begin, std::size_t end) {
      end += firstPixel;
      for (std::size_t first = begin + firstPixel; first < end; first += BlockPixels)
      {
        const std::size_t pixels = std::min(BlockPixels, end - first);
        double * const    own = basis.Size() > 0 ? &sums.At(first, 0) : nullptr;
        basis.ToCoordinates(own, BlockPixels, frame.mean.data() + first, pixels);
        blocks.Fill(own, first, pixels);
      }
    });
  };
  const std::size_t last = sums.LastPixel();
  for (std::size_t first = sums.FirstPixel(); first < last; first += ProjectionSums::SlabPixels)
  {
    append(first, std::min(last, first + ProjectionSums::SlabPixels));
    if (!keepCoordinates)
    {
      sums.ReleaseFirstSlab();
    }
  }
}

template <typename TPixel>
void
FillResidualSquares(const ReferenceFrame &          frame,
                    const TemporalBasis &           basis,
                    const ProjectedFrames<TPixel> & frames,
                    std::size_t                     begin,
                    std::size_t                     end,
                    ResidualSquares &               squares,
                    ProjectionSums &                coordinates)
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
    for (std::size_t j = 0; j < coordinates.GetNumberOfSeries(); ++j)
    {
      std::copy_n(sums.data() + j * BlockPixels, last - first, &coordinates.At(first, j));
    }
  }
}

#define SensorNoise_INSTANTIATE(TPixel)                                                 \
  template SensorNoise_EXPORT void FillResidualSquares(const ReferenceFrame &,          \
                                                       const TemporalBasis &,           \
                                                       const ProjectedFrames<TPixel> &, \
                                                       std::size_t,                     \
                                                       std::size_t,                     \
                                                       ResidualSquares &,               \
                                                       ProjectionSums &)
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE

} // namespace sensornoise
