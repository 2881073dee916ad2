// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_FrameTimes_h
#define sensornoise_correlation_FrameTimes_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "sensornoise/Parallel.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace sensornoise
{

class NoiseResiduals;

/** \class FrameTimes
 * \brief The times of the frames of a burst, in frames of the sensor.
 *
 * A frame that repeats an earlier one is not measured. A recorder that is faster than the sensor inserts copies: the
 * frames before and after a copy are neighbours in time. A recorder that lost a frame puts a copy in its place: these
 * frames are two frames apart. Default: all frames are neighbours in time. */
class SensorNoise_EXPORT FrameTimes
{
public:
  FrameTimes() = default;
  /** \param times time of each frame, ascending [frames] */
  explicit FrameTimes(std::vector<std::size_t> times);

  /** Returns whether no frame is missing between others. */
  bool
  AreConsecutive() const
  {
    return m_Times.empty();
  }
  /** Returns the number of frames from the first of \a frames frames to the last, with the missing ones. */
  std::size_t
  Duration(std::size_t frames) const
  {
    return m_Times.empty() ? frames : m_Times.back() - m_Times.front() + 1;
  }
  /** Returns the time of frame \a t after the first frame [frames]. */
  std::size_t
  TimeOf(std::size_t t) const
  {
    return m_Times.empty() ? t : m_Times[t] - m_Times.front();
  }
  /** Returns the pairs of frames, of \a frames, that are \a lag frames apart in time. */
  std::vector<std::pair<std::size_t, std::size_t>>
  PairsAt(std::size_t lag, std::size_t frames) const;
  /** Returns a matrix of one row for each time, from \a rows with one row for each frame: the rows of missing frames
   * are 0. */
  Eigen::MatrixXd
  Expand(const Eigen::MatrixXd & rows) const;

  /** Leaves out the first \a frames frames. */
  void
  DropFirst(std::size_t frames);

private:
  std::vector<std::size_t> m_Times; // empty: consecutive
};

/** Finds the times of the frames by the correlation of their noise. \a numbers are the numbers of the frames in the
 * burst as recorded, repeated frames included, ascending. Let c_A be the correlation of successive frames, c_B of
 * frames on both sides of a repeated frame, and c_2 of frames with a measured frame between them. The numbers are the
 * times if c_B differs significantly from c_A, and less from c_2. Otherwise all frames are neighbours in time.
 * Estimator.md, 3.12. */
SensorNoise_EXPORT FrameTimes
FindFrameTimes(const NoiseResiduals & residuals, std::vector<std::size_t> numbers, const ParallelFor & parallelFor);

} // namespace sensornoise

#endif
