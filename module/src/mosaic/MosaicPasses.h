// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_mosaic_MosaicPasses_h
#define sensornoise_mosaic_MosaicPasses_h

#include "base/FreeMemory.h"
#include "sensornoise/Parallel.h"
#include "mosaic/MosaicGeometry.h"
#include "moments/UnlikeFrames.h"
#include "mosaic/PlaneWork.h"
#include "sensornoise/Report.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <istream>
#include <optional>
#include <ostream>
#include <vector>

namespace sensornoise
{

/** \class MosaicPasses
 * \brief A method at work on the four planes of a mosaic at once: each pass reads the stack once for all of them.
 *
 * Usage as that of the method, RefinedPasses or PublishedPasses; what it finds of each plane has the bits that the
 * method alone finds of it. The planes' pixels are read where they stand, those of a part of the frame for all planes
 * while they are near.
 *
 * \tparam TPixel the type of the frames' pixels.
 * \tparam TMethod RefinedPasses or PublishedPasses of it. */
template <typename TPixel, typename TMethod>
class MosaicPasses
{
public:
  static constexpr unsigned int NumberOfPasses = TMethod::NumberOfPasses;

  using MakeMethod = std::function<TMethod(BayerPlane plane, const ParallelFor & parallelFor)>;

  /** \a makeMethod makes the method of each plane, of the size MosaicGeometry::Plane(); the ParallelFor that it is
   * given is to spread its work. \a parallelFor has \a threads threads. */
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
    }
  }

  /** Adds the next \a count frames of the current pass, mosaics, stored one after the other. */
  void
  AddFrames(const TPixel * frames, std::size_t count)
  {
    if (this->AreBlueRowsPending() && count == this->GetHas().size())
    {
      this->EndPlanes(RedRows, BayerPlanes.size()); // the pass before: there will be no sums
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

  /** Frame \a t is the next one of the current pass. */
  void
  GoTo(std::size_t t)
  {
    for (TMethod & method : m_Methods)
    {
      method.GoTo(t);
    }
  }

  /** Frames that are here, as the method has them. */
  const std::vector<std::uint8_t> &
  GetHas() const
  {
    return m_Methods.front().GetHas();
  }

  /** The methods, in the order of BayerPlanes: what is told to each of them, or asked of it. */
  std::vector<TMethod> &
  GetMethods()
  {
    return m_Methods;
  }

  /** Sums of the current pass on their way to another process, and from there. */
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

  /** Sums of 8 bytes that the third pass has of the planes' pixels, and that are too many for all planes at once. */
  struct ManySums
  {
    std::size_t ofPixel = 8;                     ///< more: 64 bytes, to which a memory limit brings every stack
    std::size_t bytes = std::size_t{ 32 } << 20; ///< and more: less than a chunk of the stack is not worth a pass
  };

  /** No sums of RefinedPasses' third pass are saved or merged. Where all frames are added to it together there are
   * none; where there are \a many, the pass is for the planes of the red rows alone, and one more for those of the blue
   * rows: half of their memory. To be told before the first pass. */
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
    if (m_Methods.front().IsFirstPass())
    {
      this->LeaveOutUnlike();
    }
    if constexpr (TMethod::HasManySums)
    {
      // Planes that need a reading more than others are not in step, and do not take turns.
      const auto isReady = [](const TMethod & method) { return method.IsBeforeProjections(); };
      if (m_ManySums && std::all_of(m_Methods.begin(), m_Methods.end(), isReady))
      {
        this->EndPassBeforeLast();
        return;
      }
    }
    this->EndPlanes(m_First, m_Last);
    if (this->AreBlueRowsPending() && this->AreDone(RedRows))
    {
      m_First = RedRows;
      m_Last = BayerPlanes.size();
      this->EndPlanes(m_First, m_Last);
    }
  }

  /** Whether all planes' reports are there. */
  bool
  IsDone() const
  {
    return this->AreDone(BayerPlanes.size());
  }

  /** In the order of BayerPlanes. */
  std::array<Report, 4>
  GetReports() const
  {
    return {
      { m_Methods[0].GetReport(), m_Methods[1].GetReport(), m_Methods[2].GetReport(), m_Methods[3].GetReport() }
    };
  }

  /** A map of the frame, every pixel with the value of its plane: mapOf(method) is the method's GetMean(),
   * GetVariance(), GetCorrectedVariance() or GetPixelUse(), or what takes it. Where there is none, and in a last column
   * or row that is in no plane, \a missing. */
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
    GiveBackFreedMemory(); // of maps that were taken
    return map;
  }

private:
  /** The planes before this one, R and G1, are those of the red rows. */
  static constexpr std::size_t RedRows = 2;

  bool
  AreDone(std::size_t planes) const
  {
    return std::all_of(
      m_Methods.begin(), m_Methods.begin() + planes, [](const TMethod & method) { return method.IsDone(); });
  }

  /** Ends the first pass of all planes by leaving out the frames that are unlike the others in one of them. */
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

  /** The third pass is that of the red rows. */
  bool
  AreBlueRowsPending() const
  {
    return m_Last == RedRows;
  }

  /** Ends it for the red rows, and for the blue ones unless these are to wait until those are done. */
  void
  EndPassBeforeLast()
  {
    this->EndPlanes(0, RedRows);
    const std::size_t sums = std::max(m_Methods[0].SumsPerPixel(), m_Methods[1].SumsPerPixel());
    const std::size_t bytes = sizeof(double) * sums * m_Geometry.frame.Pixels();
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
    GiveBackFreedMemory();
  }

  /** Ends the current pass of the planes from \a first on and below \a last, at the same time: much of what is left to
   * do then are single sums and sorts. */
  void
  EndPlanes(std::size_t first, std::size_t last)
  {
    m_Work.ForPlanes(first, last, [this](std::size_t k) {
      if (!m_Methods[k].IsDone())
      {
        m_Methods[k].EndPass();
      }
    });
    GiveBackFreedMemory(); // planes' maps are small enough to be kept by the system's library when they are freed
  }

  ParallelFor             m_ParallelFor;
  PlaneWork               m_Work;
  std::vector<TMethod>    m_Methods;
  MosaicGeometry          m_Geometry;
  std::optional<ManySums> m_ManySums;   // none: rows do not take turns
  std::size_t             m_First{ 0 }; // the planes whose turn it is
  std::size_t             m_Last{ BayerPlanes.size() };
};

/** Makes the passes of a method on the four planes of mosaics, with the settings of each plane, in the order of
 * BayerPlanes. \a mask is that of the mosaic. \a parallelFor has \a threads threads. */
template <typename TPixel, typename TPasses>
MosaicPasses<TPixel, TPasses>
MakeMosaicPasses(const std::array<typename TPasses::Settings, 4> & settings,
                 const MosaicGeometry &                            geometry,
                 std::size_t                                       frames,
                 const std::vector<std::uint8_t> &                 mask,
                 const ParallelFor &                               parallelFor,
                 std::size_t                                       threads)
{
  const auto makeOfPlane = [&](BayerPlane plane, const ParallelFor & spread) {
    const auto & ofPlane = settings.at(static_cast<std::size_t>(plane));
    return TPasses(ofPlane, geometry.Plane(), frames, geometry.Take(mask, plane), spread);
  };
  return MosaicPasses<TPixel, TPasses>(geometry, makeOfPlane, parallelFor, threads);
}

} // namespace sensornoise

#endif
