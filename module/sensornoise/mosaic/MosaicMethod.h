// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_mosaic_MosaicMethod_h
#define sensornoise_mosaic_MosaicMethod_h

#include "sensornoise/base/Parallel.h"
#include "sensornoise/mosaic/MosaicGeometry.h"
#include "sensornoise/mosaic/PlaneFrames.h"
#include "sensornoise/report/Report.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <istream>
#include <memory>
#include <ostream>
#include <vector>

namespace sensornoise
{

/** \class MosaicMethod
 * \brief A method at work on the four planes of a mosaic at once: each pass reads the stack once for all of them.
 *
 * Usage as that of the method, RefinedMethod or PublishedMethod; what it finds of each plane has the bits that the
 * method alone finds of it. Frames are copied into their planes a few at a time, see PlaneFrames.
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
   * given is to spread its work. */
  MosaicMethod(const MosaicGeometry & geometry,
               const MakeMethod &     makeMethod,
               const ParallelFor &    parallelFor = SerialFor)
    : m_ParallelFor(parallelFor)
    , m_IsByPlane(std::make_shared<bool>(false))
    , m_Planes(geometry)
  {
    const ParallelFor withinPlane = [parallelFor, isByPlane = m_IsByPlane](std::size_t count, const auto & function) {
      // A single call: it is not spread, but whoever made parallelFor may stop the work there.
      *isByPlane ? parallelFor(1, [&](std::size_t) { SerialFor(count, function); }) : parallelFor(count, function);
    };
    for (const BayerPlane plane : BayerPlanes)
    {
      m_Methods.push_back(makeMethod(plane, withinPlane));
    }
  }

  /** Adds the next \a count frames of the current pass, mosaics, stored one after the other. */
  void
  AddFrames(const TPixel * frames, std::size_t count)
  {
    m_Planes.ForPlanes(frames, count, m_ParallelFor, [this](std::size_t k, const TPixel * plane, std::size_t now) {
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

  /** Ends the current pass, of all planes at once: much of what is left to do then are single sums and sorts. */
  void
  EndPass()
  {
    m_Planes.Release();
    std::array<std::exception_ptr, BayerPlanes.size()> errors;
    *m_IsByPlane = true;
    m_ParallelFor(m_Methods.size(), [&](std::size_t k) {
      try
      {
        if (!m_Methods[k].IsDone())
        {
          m_Methods[k].EndPass();
        }
      }
      catch (...)
      {
        errors[k] = std::current_exception();
      }
    });
    *m_IsByPlane = false;
    for (const std::exception_ptr & error : errors)
    {
      if (error)
      {
        std::rethrow_exception(error);
      }
    }
  }

  /** Whether all planes' reports are there. */
  bool
  IsDone() const
  {
    return std::all_of(m_Methods.begin(), m_Methods.end(), [](const TMethod & method) { return method.IsDone(); });
  }

  /** In the order of BayerPlanes. */
  std::array<Report, 4>
  GetReports() const
  {
    return {
      { m_Methods[0].GetReport(), m_Methods[1].GetReport(), m_Methods[2].GetReport(), m_Methods[3].GetReport() }
    };
  }

  /** Writes a map to \a frame, every pixel with the value of its plane: mapOf(method) is the method's GetMean(),
   * GetVariance(), GetCorrectedVariance() or GetPixelUse(), or what takes it. Where there is none, and in a last column
   * or row that is in no plane, \a missing. */
  template <typename T, typename TFunction>
  void
  WriteMap(TFunction mapOf, T missing, T * frame)
  {
    const MosaicGeometry & geometry = m_Planes.GetGeometry();
    std::fill_n(frame, geometry.frame.Pixels(), missing);
    for (std::size_t k = 0; k < m_Methods.size(); ++k)
    {
      geometry.Put(mapOf(m_Methods[k]), BayerPlanes[k], frame);
    }
  }

private:
  ParallelFor           m_ParallelFor;
  std::shared_ptr<bool> m_IsByPlane; // the planes are worked on at the same time, and each by one thread
  std::vector<TMethod>  m_Methods;
  PlaneFrames<TPixel>   m_Planes;
};

} // namespace sensornoise

#endif
