// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_ChannelReports_h
#define sensornoise_ChannelReports_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Report.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise
{

/** How the pattern of a mosaic is known. */
enum class BayerSource : std::uint8_t
{
  Given, ///< by the user
  File,  ///< by what the frames' file says
  Levels ///< by the levels of the frames: red and blue may be exchanged
};

SensorNoise_EXPORT const char *
NameOf(BayerSource source);

/** The offset that the four channels of one sensor have together. */
struct JointOffset
{
  /** The mean, weighed by the channels' errors [DN]. Failed where they differ by so much more than their errors that
   * their mean is known no better than the best of them. */
  Quantity offset;
  /** Standard error of the channel that knows it best, over that of the mean [1]: above 1. */
  std::optional<double> precisionGain;
  /** Mean square difference of the channels from their mean, in units of their errors, over the degrees of freedom [1].
   */
  double reducedChi2{ 0.0 };
};

/** The motion of a sensor, of the four planes of its mosaic together. In pixels of a plane, as each plane's own.
 *
 * A plane sees edges through every second pixel, and what lies between is missing: where an edge stands, the square of
 * the shift is taken for a shift, with one sign by the even columns and with the other by the odd ones. Of R and B
 * together, and of G1 and G2, every column and row is seen once, and what they do not agree in is gone from their mean.
 */
struct JointMotion
{
  Quantity                           sdX;        ///< [pixel]
  Quantity                           sdY;        ///< [pixel]
  Quantity                           covariance; ///< [pixel^2]
  std::vector<std::array<double, 2>> series;     ///< (alpha_t, beta_t) of every frame, mean 0 [pixel]
};

/** What was measured of a stack behind a Bayer mosaic: a report for each of its four planes. Widths, heights and
 * vibration are in pixels of the plane, each of them 2 x 2 of the mosaic; the errors of a channel's vibration are wide
 * enough for what it differs by from that of all. */
struct ChannelReports
{
  BayerPattern               pattern{ BayerPattern::RGGB };
  BayerSource                source{ BayerSource::Given };
  std::array<Report, 4>      channels; ///< in the order of BayerPlanes
  std::optional<JointOffset> joint;    ///< null: fewer than two channels found an offset of their own
  std::optional<JointMotion> motion;   ///< null: not all channels found one
  std::vector<Warning>       warnings; ///< of all channels together; each has its own, too
  std::optional<InputRecord> input;    ///< null: not asked for; not in the channels

  const Report &
  Of(BayerPlane plane) const
  {
    return channels.at(static_cast<std::size_t>(plane));
  }
  /** Whether anything was estimated in any of them. */
  bool
  IsUsable() const;
};

/** Puts together the reports of the planes, in the order of BayerPlanes: names the channels, joins their offsets and
 * their motion, and warns where the two greens, which are alike, have different gains, or levels that contradict the
 * pattern. */
SensorNoise_EXPORT ChannelReports
MakeChannelReports(BayerPattern pattern, BayerSource source, std::array<Report, 4> channels);

} // namespace sensornoise

#endif
