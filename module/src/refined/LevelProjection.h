// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_LevelProjection_h
#define sensornoise_refined_LevelProjection_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"
#include "base/PixelLayout.h"
#include "moments/StackMaps.h"
#include "refined/PixelProjections.h"
#include "scene/ReferenceFrame.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

/** Returns whether the levels of the distinct frames, \a frameMeans [DN], are a series that pixels can be projected on:
 * all are finite, they differ, and degrees of freedom are left. */
SensorNoise_EXPORT bool
AreLevelsSeries(const std::vector<double> & frameMeans);

/** \class LevelProjection
 * \brief One more reading of a stack under strong changes of the illumination: the variance of every pixel without what
 * it has in common with the levels of the frames.
 *
 * The raw variance of a pixel of signal s is V + sigma_gamma^2 s^2. Where the second term is 100 times the first, no
 * model of the raw variance determines V. What is left of a pixel's time series after the projection on the one series
 * of the frames' mean levels is V, as far as the illumination is the same everywhere and nothing moves, and needs no
 * offset. Estimator.md, 3.2.
 *
 * Sums as those of PixelProjections, 8 bytes a pixel: the same bits in any chunks and any distribution over processes.
 */
class SensorNoise_EXPORT LevelProjection
{
public:
  /** \a frameMeans are those of the distinct frames [DN], see AreLevelsSeries(). \a withoutMerging: no sums are saved
   * or merged. */
  LevelProjection(StackMaps                   maps,
                  const FrameGeometry &       geometry,
                  const PixelLayout &         layout,
                  const std::vector<double> & frameMeans,
                  bool                        withoutMerging,
                  const ParallelFor &         parallelFor);

  /** What the frames are added to. */
  PixelProjections::Plane
  PlaneAt(std::size_t place)
  {
    return { &m_Projections, place, &m_Frame };
  }
  PixelProjections &
  GetProjections()
  {
    return m_Projections;
  }
  const PixelProjections &
  GetProjections() const
  {
    return m_Projections;
  }
  /** The frame with the raw variance [DN^2]. */
  const ReferenceFrame &
  GetFrame() const
  {
    return m_Frame;
  }

  /** The maps of the stack, given away, with the residual variance in the place of the raw one. */
  struct Maps
  {
    StackMaps           ofScene;
    std::vector<double> rawVariance; ///< [DN^2]
  };
  /** Ends the reading. */
  Maps
  TakeMaps(const ParallelFor & parallelFor);

private:
  StackSummary              m_Summary;
  std::vector<std::uint8_t> m_Valid;
  ReferenceFrame            m_Frame;
  PixelProjections          m_Projections;
};

} // namespace sensornoise

#endif
