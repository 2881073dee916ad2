// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_mosaic_MosaicMethod_h
#define sensornoise_mosaic_MosaicMethod_h

#include "sensornoise/base/Parallel.h"
#include "sensornoise/base/PixelUse.h"
#include "sensornoise/mosaic/MosaicGeometry.h"
#include "sensornoise/mosaic/PlaneFrames.h"
#include "sensornoise/report/Report.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <utility>
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

  /** \a makeMethod(plane) makes the method of each plane, of the size MosaicGeometry::Plane(). */
  MosaicMethod(const MosaicGeometry &                     geometry,
               const std::function<TMethod(BayerPlane)> & makeMethod,
               ParallelFor                                parallelFor = SerialFor)
    : m_ParallelFor(std::move(parallelFor))
    , m_Planes(geometry)
  {
    for (const BayerPlane plane : BayerPlanes)
    {
      m_Methods.push_back(makeMethod(plane));
    }
  }

  /** Adds the next \a count frames of the current pass, mosaics, stored one after the other. */
  void
  AddFrames(const TPixel * frames, std::size_t count)
  {
    m_Planes.ForPlanes(frames, count, m_ParallelFor, [this](std::size_t k, const TPixel * plane, std::size_t now) {
      m_Methods[k].AddFrames(plane, now);
    });
  }

  /** Ends the current pass, of one plane after the other. */
  void
  EndPass()
  {
    m_Planes.Release();
    for (TMethod & method : m_Methods)
    {
      method.EndPass();
    }
  }

  /** In the order of BayerPlanes. */
  std::array<Report, 4>
  GetReports() const
  {
    return {
      { m_Methods[0].GetReport(), m_Methods[1].GetReport(), m_Methods[2].GetReport(), m_Methods[3].GetReport() }
    };
  }

  /** Maps of the mosaic, every pixel with the value of its plane; NaN, and PixelUse::Border, in a last column or row
   * that is in no plane. */
  std::vector<double>
  GetMean() const
  {
    return this->Join(std::numeric_limits<double>::quiet_NaN(),
                      [](const TMethod & method) -> const auto & { return method.GetMean(); });
  }
  std::vector<double>
  GetVariance() const
  {
    return this->Join(std::numeric_limits<double>::quiet_NaN(),
                      [](const TMethod & method) -> const auto & { return method.GetVariance(); });
  }
  std::vector<double>
  GetCorrectedVariance() const
  {
    return this->Join(std::numeric_limits<double>::quiet_NaN(),
                      [](const TMethod & method) -> const auto & { return method.GetCorrectedVariance(); });
  }
  std::vector<std::uint8_t>
  GetPixelUse() const
  {
    return this->Join(static_cast<std::uint8_t>(PixelUse::Border),
                      [](const TMethod & method) -> const auto & { return method.GetPixelUse(); });
  }

private:
  template <typename T, typename TFunction>
  std::vector<T>
  Join(T missing, TFunction mapOf) const
  {
    std::vector<T> joined(m_Planes.GetGeometry().frame.Pixels(), missing);
    for (std::size_t k = 0; k < m_Methods.size(); ++k)
    {
      m_Planes.GetGeometry().Put(mapOf(m_Methods[k]), BayerPlanes[k], joined);
    }
    return joined;
  }

  ParallelFor          m_ParallelFor;
  std::vector<TMethod> m_Methods;
  PlaneFrames<TPixel>  m_Planes;
};

} // namespace sensornoise

#endif
