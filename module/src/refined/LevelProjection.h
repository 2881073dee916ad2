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

/** Returns whether pixels can be projected on the levels of the distinct frames, \a frameMeans [DN]: the levels are
 * finite and differ, and degrees of freedom remain. */
SensorNoise_EXPORT bool
AreLevelsSeries(const std::vector<double> & frameMeans);

/** \class LevelProjection
 * \brief One more reading of a stack under strong changes of the illumination: computes the variance of every pixel
 * without the component that is proportional to the levels of the frames.
 *
 * The raw variance of a pixel of signal s is V + sigma_gamma^2 s^2. Where the second term is 100 times the first, no
 * model of the raw variance determines V. The residual variance after the projection on the series of the frames' mean
 * levels is V, if the illumination is the same everywhere and nothing moves. It needs no offset. Estimator.md, 3.2.
 *
 * The sums are those of PixelProjections, 8 bytes for each pixel: identical for any chunks and any distribution over
 * processes. */
class SensorNoise_EXPORT LevelProjection
{
public:
  /** \a frameMeans are the mean levels of the distinct frames [DN], see AreLevelsSeries(). \a withoutMerging: no sums
   * are saved or merged. */
  LevelProjection(StackMaps                   maps,
                  const FrameGeometry &       geometry,
                  const PixelLayout &         layout,
                  const std::vector<double> & frameMeans,
                  bool                        withoutMerging,
                  const ParallelFor &         parallelFor);

  /** Returns the target to which frames are added; \a place is the index of the first frame among the distinct frames.
   */
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
  /** Returns the reference frame, with the raw variance [DN^2]. */
  const ReferenceFrame &
  GetFrame() const
  {
    return m_Frame;
  }

  /** Maps of the stack, with the residual variance instead of the raw variance. */
  struct Maps
  {
    StackMaps           ofScene;
    std::vector<double> rawVariance; ///< raw variance [DN^2]
  };
  /** Ends the reading and returns the maps. */
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
