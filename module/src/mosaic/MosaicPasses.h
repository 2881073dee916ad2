// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_mosaic_MosaicPasses_h
#define sensornoise_mosaic_MosaicPasses_h

#include "base/FreeMemory.h"
#include "correlation/ColourCovariance.h"
#include "sensornoise/Parallel.h"
#include "moments/FrameThumbnails.h"
#include "mosaic/MosaicGeometry.h"
#include "base/ParallelWork.h"
#include "refined/RefinedEstimate.h"
#include "sensornoise/Report.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <istream>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace sensornoise
{

/** \class MosaicPasses
 * \brief Passes of a method over the four planes of a mosaic together: each pass reads the stack once for all planes.
 *
 * Usage as RefinedPasses or PublishedPasses. The results of each plane equal the results of the method on that plane
 * alone, unless the noise of neighbours, which are in other planes, is correlated. The planes' pixels are read at their
 * positions in the mosaic, one part of the frame for all planes while it is in the cache.
 *
 * \tparam TPixel the type of the frames' pixels.
 * \tparam TMethod RefinedPasses<TPixel> or PublishedPasses<TPixel>. */
template <typename TPixel, typename TMethod>
class MosaicPasses
{
public:
  static constexpr unsigned int NumberOfPasses = TMethod::NumberOfPasses;

  using MakeMethod = std::function<TMethod(BayerPlane plane, const ParallelFor & parallelFor)>;

  /** \a makeMethod makes the method of each plane, of the size MosaicGeometry::Plane(), which has to distribute its
   * work by the ParallelFor that is passed. \a parallelFor uses \a threads threads. */
  MosaicPasses(const MosaicGeometry & geometry,
               const MakeMethod &     makeMethod,
               const ParallelFor &    parallelFor = SerialFor,
               std::size_t            threads = 1)
    : m_ParallelFor(parallelFor)
    , m_Work(parallelFor, threads)
    , m_Geometry(geometry)
  {
    for (const BayerPlane plane : BayerPlanes)
    {
      m_Methods.push_back(makeMethod(plane, m_Work.WithinPlane()));
      m_Methods.back().SetLayout(geometry.LayoutOf(plane));
      if constexpr (TMethod::HasSample)
      {
        m_Methods.back().KeepSample();
      }
    }
  }

  /** Adds the next \a count mosaics of the current pass, which are stored one after the other. */
  void
  AddFrames(const TPixel * frames, std::size_t count)
  {
    if (this->IsPassOfRedRows() && count == this->GetHas().size())
    {
      this->EndPlanes(RedRows, BayerPlanes.size()); // ends the second pass, so that no sums are needed
      m_Last = BayerPlanes.size();
    }
    std::vector<typename TMethod::Passes *> planes;
    for (std::size_t k = m_First; k < m_Last; ++k)
    {
      if (!m_Methods[k].IsDone()) // some planes may need more passes than others
      {
        planes.push_back(&m_Methods[k]);
      }
    }
    if (count > 0 && !planes.empty())
    {
      TMethod::AddFrames(planes, frames, count, m_ParallelFor);
    }
  }

  /** Sets frame \a t as the next frame of the current pass. */
  void
  GoTo(std::size_t t)
  {
    for (TMethod & method : m_Methods)
    {
      method.GoTo(t);
    }
  }

  /** Returns for every frame 1 if it was added, or merged, in the current pass, else 0. */
  const std::vector<std::uint8_t> &
  GetHas() const
  {
    return m_Methods.front().GetHas();
  }

  /** Returns the methods, in the order of BayerPlanes. */
  std::vector<TMethod> &
  GetMethods()
  {
    return m_Methods;
  }

  /** Save and merge the sums of the current pass of all planes, to exchange them between processes. */
  void
  SaveSums(std::ostream & out) const
  {
    for (const TMethod & method : m_Methods)
    {
      method.SaveSums(out);
    }
  }
  void
  MergeSums(std::istream & in)
  {
    for (TMethod & method : m_Methods)
    {
      method.MergeSums(in);
    }
  }

  /** Limits beyond which the third pass's sums are too many for all planes at once. */
  struct ManySums
  {
    std::size_t ofPixel = 64;                    ///< bytes for each pixel; a memory limit reduces every stack to them
    std::size_t bytes = std::size_t{ 32 } << 20; ///< bytes of the mosaic's sums; saving less is not worth a pass
  };

  /** Declares that no sums of RefinedPasses' third pass are saved or merged. If all frames are added together, there
   * are no sums. If the sums exceed \a many, the pass is for the planes of the red rows alone, and a further pass for
   * the planes of the blue rows, which halves the memory. Call this function before the first pass. */
  void
  DisableMerging(const std::optional<ManySums> & many)
  {
    m_ManySums = many;
    for (TMethod & method : m_Methods)
    {
      method.DisableMerging();
    }
  }

  /** Ends the current pass. */
  void
  EndPass()
  {
    this->EndPassOfPlanes();
    if constexpr (TMethod::HasSample)
    {
      if (this->IsDone())
      {
        this->AddNeighbours();
      }
    }
  }

  /** Returns whether the reports of all planes are available. */
  bool
  IsDone() const
  {
    return this->AreDone(BayerPlanes.size());
  }

  /** Returns the reports, in the order of BayerPlanes. */
  std::array<Report, 4>
  GetReports() const
  {
    return {
      { m_Methods[0].GetReport(), m_Methods[1].GetReport(), m_Methods[2].GetReport(), m_Methods[3].GetReport() }
    };
  }

  /** Returns a map of the frame from the maps of the planes. mapOf(method) returns a map of a method, by GetMean(),
   * GetVariance(), GetCorrectedVariance() or GetPixelUse(), or by the functions that take them. Pixels of planes
   * without a map, and of a last column or row that belongs to no plane, have the value \a missing. */
  template <typename T, typename TFunction>
  std::vector<T>
  JoinMaps(TFunction mapOf, T missing)
  {
    std::array<std::vector<T>, 4> ofPlanes;
    for (std::size_t k = 0; k < ofPlanes.size(); ++k)
    {
      ofPlanes[k] = mapOf(m_Methods[k]);
    }
    std::vector<T> map = m_Geometry.Join(ofPlanes, missing, m_ParallelFor);
    ofPlanes = {};
    ReleaseFreedMemory(); // memory of the maps that were taken
    return map;
  }

private:
  /** Number of planes of the red rows, R and G1, which precede the others. */
  static constexpr std::size_t RedRows = 2;

  bool
  AreDone(std::size_t planes) const
  {
    return std::all_of(
      m_Methods.begin(), m_Methods.begin() + planes, [](const TMethod & method) { return method.IsDone(); });
  }

  void
  EndPassOfPlanes()
  {
    if (m_Methods.front().IsFirstPass())
    {
      this->LeaveOutUnlike();
    }
    if constexpr (TMethod::HasManySums)
    {
      // If some planes need one reading more than others, their passes differ, and all rows are processed in one pass.
      const auto isReady = [](const TMethod & method) { return method.IsBeforeProjections(); };
      if (m_ManySums && std::all_of(m_Methods.begin(), m_Methods.end(), isReady))
      {
        this->EndPassBeforeLast();
        return;
      }
    }
    this->EndPlanes(m_First, m_Last);
    if (this->IsPassOfRedRows() && this->AreDone(RedRows))
    {
      m_First = RedRows;
      m_Last = BayerPlanes.size();
      this->EndPlanes(m_First, m_Last);
    }
  }

  /** Adds the covariances of neighbours, which have different colours, to the gains if they are significant in any
   * plane. */
  void
  AddNeighbours()
  {
    SampledPlanes planes{};
    for (std::size_t k = 0; k < m_Methods.size(); ++k)
    {
      planes.noise[k] = &m_Methods[k].GetSample();
      planes.corners[k] = CornerOf(m_Geometry.pattern, BayerPlanes[k]);
    }
    const auto covariances = MeasureNeighbourCovariance(planes, m_ParallelFor);
    bool       areCorrelated = false;
    for (std::size_t k = 0; k < m_Methods.size(); ++k)
    {
      areCorrelated = areCorrelated || HasCorrelatedNeighbours(m_Methods[k].GetReport(), covariances[k]);
      m_Methods[k].ReleaseSample();
    }
    for (std::size_t k = 0; areCorrelated && k < m_Methods.size(); ++k)
    {
      AddToGain(m_Methods[k].GetReport(), covariances[k]);
    }
  }

  /** Ends the first pass of all planes, and leaves out the frames that deviate from the others in any plane. */
  void
  LeaveOutUnlike()
  {
    std::vector<std::vector<LeftOutFrame>> ofPlanes;
    for (const TMethod & method : m_Methods)
    {
      ofPlanes.push_back(method.FindUnlike());
    }
    const std::vector<LeftOutFrame> all = JoinUnlikeFrames(ofPlanes, this->GetHas().size());
    for (TMethod & method : m_Methods)
    {
      method.LeaveOut(all);
    }
  }

  /** Returns whether the third pass is the pass of the red rows. */
  bool
  IsPassOfRedRows() const
  {
    return m_Last == RedRows;
  }

  /** Ends the second pass for the red rows. Ends it also for the blue rows, unless they have to wait for the third pass
   * of the red rows. */
  void
  EndPassBeforeLast()
  {
    this->EndPlanes(0, RedRows);
    const std::size_t sums = std::max(m_Methods[0].SumBytesPerPixel(), m_Methods[1].SumBytesPerPixel());
    const std::size_t bytes = sums * m_Geometry.frame.Pixels();
    if (sums <= m_ManySums->ofPixel || bytes <= m_ManySums->bytes)
    {
      this->EndPlanes(RedRows, m_Last);
      return;
    }
    m_Last = RedRows;
    for (std::size_t k = RedRows; k < m_Methods.size(); ++k)
    {
      m_Methods[k].ReleaseFrameSums();
    }
    ReleaseFreedMemory();
  }

  /** Ends the current pass for the planes first <= k < last at the same time: much of the remaining work is single sums
   * and sorts. */
  void
  EndPlanes(std::size_t first, std::size_t last)
  {
    m_Work.ForPlanes(first, last, [this](std::size_t k) {
      if (!m_Methods[k].IsDone())
      {
        m_Methods[k].EndPass();
      }
    });
    ReleaseFreedMemory(); // maps of planes are so small that the system's allocator keeps them when they are freed
  }

  ParallelFor             m_ParallelFor;
  PlaneWork               m_Work;
  std::vector<TMethod>    m_Methods;
  MosaicGeometry          m_Geometry;
  std::optional<ManySums> m_ManySums;   // none: all rows are processed in one pass
  std::size_t             m_First{ 0 }; // planes of the current pass
  std::size_t             m_Last{ BayerPlanes.size() };
};

/** Throws std::invalid_argument if the planes are too small for RequireStack(), whose sentence does not know the
 * mosaic. */
inline void
RequirePlanes(const MosaicGeometry & geometry)
{
  const auto sizeOf = [](const FrameGeometry & frame) {
    return std::to_string(frame.width) + " x " + std::to_string(frame.height);
  };
  const FrameGeometry plane = geometry.Plane();
  if (plane.width < SmallestSide || plane.height < SmallestSide)
  {
    throw std::invalid_argument("the frames of the mosaic have " + sizeOf(geometry.frame) +
                                " pixels, and each plane of it " + sizeOf(plane) +
                                "; expected planes of at least 3 x 3. Measure a part of at least 6 x 6 pixels");
  }
}

/** Makes the passes of a method on the four planes of mosaics, with the settings of each plane, in the order of
 * BayerPlanes. \a mask is the mask of the mosaic. \a parallelFor uses \a threads threads. */
template <typename TPixel, typename TPasses>
MosaicPasses<TPixel, TPasses>
MakeMosaicPasses(const std::array<typename TPasses::Settings, 4> & settings,
                 const MosaicGeometry &                            geometry,
                 std::size_t                                       frames,
                 const std::vector<std::uint8_t> &                 mask,
                 const ParallelFor &                               parallelFor,
                 std::size_t                                       threads)
{
  RequirePlanes(geometry);
  const auto makeOfPlane = [&](BayerPlane plane, const ParallelFor & spread) {
    const auto & ofPlane = settings.at(static_cast<std::size_t>(plane));
    return TPasses(ofPlane, geometry.Plane(), frames, geometry.Take(mask, plane), spread);
  };
  return MosaicPasses<TPixel, TPasses>(geometry, makeOfPlane, parallelFor, threads);
}

} // namespace sensornoise

#endif
