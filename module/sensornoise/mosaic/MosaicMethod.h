// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_mosaic_MosaicMethod_h
#define sensornoise_mosaic_MosaicMethod_h

#include "sensornoise/base/FirstTouch.h"
#include "sensornoise/base/ForAll.h"
#include "sensornoise/base/FreeMemory.h"
#include "sensornoise/base/Parallel.h"
#include "sensornoise/mosaic/MosaicGeometry.h"
#include "sensornoise/mosaic/PlaneFrames.h"
#include "sensornoise/report/Report.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <istream>
#include <memory>
#include <optional>
#include <ostream>
#include <vector>

namespace sensornoise
{

/** \class MosaicMethod
 * \brief A method at work on the four planes of a mosaic at once: each pass reads the stack once for all of them.
 *
 * Usage as that of the method, RefinedMethod or PublishedMethod; what it finds of each plane has the bits that the
 * method alone finds of it. Frames are copied into their planes a few at a time, see PlaneFrames, unless the method can
 * read them where they stand.
 *
 * \tparam TPixel the type of the frames' pixels.
 * \tparam TMethod RefinedMethod or PublishedMethod of it. */
template <typename TPixel, typename TMethod>
class MosaicMethod
{
public:
  static constexpr unsigned int NumberOfPasses = TMethod::NumberOfPasses;

  using MakeMethod = std::function<TMethod(BayerPlane plane, const ParallelFor & parallelFor)>;

  /** \a makeMethod makes the method of each plane, of the size MosaicGeometry::Plane(); the ParallelFor that it is
   * given is to spread its work. \a parallelFor has \a threads threads. */
  MosaicMethod(const MosaicGeometry & geometry,
               const MakeMethod &     makeMethod,
               const ParallelFor &    parallelFor = SerialFor,
               std::size_t            threads = 1)
    : m_ParallelFor(parallelFor)
    , m_Threads(threads)
    , m_IsByPlane(std::make_shared<bool>(false))
    , m_Planes(geometry, TMethod::BytesTogether)
  {
    const ParallelFor withinPlane = [parallelFor, isByPlane = m_IsByPlane](std::size_t count, const auto & function) {
      // A single call: it is not spread, but whoever made parallelFor may stop the work there.
      *isByPlane ? parallelFor(1, [&](std::size_t) { SerialFor(count, function); }) : parallelFor(count, function);
    };
    for (const BayerPlane plane : BayerPlanes)
    {
      m_Methods.push_back(makeMethod(plane, withinPlane));
      if constexpr (TMethod::ReadsPlanesInPlace)
      {
        m_Methods.back().SetLayout(geometry.LayoutOf(plane));
      }
    }
  }

  /** Adds the next \a count frames of the current pass, mosaics, stored one after the other. */
  void
  AddFrames(const TPixel * frames, std::size_t count)
  {
    if constexpr (TMethod::ReadsPlanesInPlace)
    {
      if (m_Passes > 0)
      {
        this->AddInPlace(frames, count);
        return;
      }
    }
    m_Planes.ForPlanes(
      frames, count, m_First, m_Last, m_ParallelFor, [this](std::size_t k, const TPixel * plane, std::size_t now) {
        if (!m_Methods[k].IsDone()) // some planes may need more passes than others
        {
          m_Methods[k].AddFrames(plane, now);
        }
      });
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

  /** Where RefinedMethod's third pass has many sums, it is for the planes of the red rows alone, and one more for those
   * of the blue rows: half of their memory, and not more to copy. To be told before the first pass; not where sums are
   * saved or merged. */
  void
  LetRowsTakeTurns(const ManySums & many)
  {
    m_ManySums = many;
  }

  /** Ends the current pass. */
  void
  EndPass()
  {
    ++m_Passes;
    if (TMethod::ReadsPlanesInPlace || (m_Passes >= NumberOfPasses && m_Last == BayerPlanes.size())) // no more copies
    {
      m_Planes.Release();
      GiveBackFreedMemory();
    }
    if constexpr (TMethod::HasManySums)
    {
      if (m_ManySums && m_Passes + 1 == NumberOfPasses)
      {
        this->EndPassBeforeLast();
        return;
      }
    }
    this->EndPlanes(m_First, m_Last);
    if (m_Last == RedRows && this->AreDone(RedRows))
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
    const MosaicGeometry & geometry = m_Planes.GetGeometry();
    std::vector<T>         map = MakeMap<T>(geometry.frame.Pixels(), m_ParallelFor, missing);
    for (std::size_t k = 0; k < m_Methods.size(); ++k)
    {
      geometry.Put(mapOf(m_Methods[k]), BayerPlanes[k], map.data(), m_ParallelFor);
    }
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

  /** All planes of a part are read while it is near the processor. */
  void
  AddInPlace(const TPixel * frames, std::size_t count)
  {
    std::size_t first = 0;
    for (TMethod & method : m_Methods)
    {
      first = method.BeginParts(count);
    }
    m_ParallelFor(m_Methods.front().NumberOfParts(count), [&](std::size_t part) {
      for (TMethod & method : m_Methods)
      {
        method.AddPart(frames, first, count, part);
      }
    });
  }

  /** Ends it for the red rows, and for the blue ones unless these are to wait until those are done. */
  void
  EndPassBeforeLast()
  {
    this->EndPlanes(0, RedRows);
    const std::size_t sums = std::max(m_Methods[0].SumsPerPixel(), m_Methods[1].SumsPerPixel());
    const std::size_t bytes = sizeof(double) * sums * m_Planes.GetGeometry().frame.Pixels();
    if (sums <= m_ManySums->ofPixel || bytes <= m_ManySums->bytes)
    {
      this->EndPlanes(RedRows, m_Last);
      return;
    }
    m_Last = RedRows;
    m_Planes.Release(); // from now on there are two planes in it
    for (std::size_t k = RedRows; k < m_Methods.size(); ++k)
    {
      m_Methods[k].RestAfterFrameSums();
    }
    GiveBackFreedMemory();
  }

  /** Ends the current pass of the planes from \a first on and below \a last, all at once unless there are more threads:
   * much of what is left to do then are single sums and sorts. */
  void
  EndPlanes(std::size_t first, std::size_t last)
  {
    *m_IsByPlane = m_Threads <= last - first;
    try
    {
      ForAll(last - first, *m_IsByPlane ? m_ParallelFor : SerialFor, [&](std::size_t k) {
        if (!m_Methods[first + k].IsDone())
        {
          m_Methods[first + k].EndPass();
        }
      });
    }
    catch (...)
    {
      *m_IsByPlane = false;
      throw;
    }
    *m_IsByPlane = false;
    GiveBackFreedMemory(); // planes' maps are small enough to be kept by the system's library when they are freed
  }

  ParallelFor             m_ParallelFor;
  std::size_t             m_Threads;
  std::shared_ptr<bool>   m_IsByPlane; // the planes are worked on at the same time, and each by one thread
  std::vector<TMethod>    m_Methods;
  PlaneFrames<TPixel>     m_Planes;
  unsigned int            m_Passes{ 0 }; // that have ended
  std::optional<ManySums> m_ManySums;    // none: rows do not take turns
  std::size_t             m_First{ 0 };  // the planes whose turn it is
  std::size_t             m_Last{ BayerPlanes.size() };
};

} // namespace sensornoise

#endif
