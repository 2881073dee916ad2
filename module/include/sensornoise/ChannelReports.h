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

/** Source of the pattern of a mosaic. */
enum class BayerSource : std::uint8_t
{
  Given, ///< the user gave it
  File,  ///< the file of the frames records it
  Levels ///< it was found from the levels of the frames: red and blue may be exchanged
};

/** Returns the name of the source in the JSON record: "given", "file" or "levels". */
SensorNoise_EXPORT const char *
NameOf(BayerSource source);

/** Joint dark offset of the four channels of one sensor. */
struct JointOffset
{
  /** Mean of the offsets of the channels, weighted with their inverse squared standard errors [DN]. It has failed if
   * the channels differ so much more than their errors that the mean is not more precise than the best channel. */
  Quantity offset;
  /** Standard error of the most precise channel over the standard error of the mean [1], above 1; null: the offset has
   * failed. */
  std::optional<double> precisionGain;
  /** Sum of the squared deviations of the channels from their mean, in units of their standard errors, over the degrees
   * of freedom [1]. 1 is expected. */
  double reducedChi2{ 0.0 };
};

/** Joint motion of the four planes of a mosaic, in pixels of a plane.
 *
 * A plane samples an edge at every second pixel only. At an edge the square of the shift then appears as a shift, with
 * one sign in the even columns and with the opposite sign in the odd ones. R and B together sample every column and row
 * once, and so do G1 and G2. These errors cancel in the mean of each pair. */
struct JointMotion
{
  Quantity                           sdX;        ///< standard deviation of the motion along x [pixel]
  Quantity                           sdY;        ///< standard deviation of the motion along y [pixel]
  Quantity                           covariance; ///< covariance of the motions along x and along y [pixel^2]
  std::vector<std::array<double, 2>> series;     ///< (alpha_t, beta_t) of every frame, mean 0 [pixel]; NaN: left out
};

/** Reports of the four planes of a Bayer mosaic. Widths, heights and vibration are in pixels of the plane; a pixel of a
 * plane is 2 x 2 pixels of the mosaic. The errors of the vibration of a channel contain its deviation from the joint
 * vibration. */
struct SensorNoise_EXPORT ChannelReports
{
  BayerPattern               pattern{ BayerPattern::RGGB }; ///< pattern of the mosaic
  BayerSource                source{ BayerSource::Given };  ///< source of the pattern
  std::array<Report, 4>      channels;                      ///< the reports of the planes, in the order of BayerPlanes
  std::optional<JointOffset> joint;    ///< null: fewer than two channels measured an offset, without a given one
  std::optional<JointMotion> motion;   ///< null: not all channels measured a motion
  std::vector<Warning>       warnings; ///< warnings about all channels together; each report has its own, too
  std::optional<InputRecord> input;    ///< record of the frames read; null: not asked for; not in the channels

  /** Returns the report of a plane. */
  const Report &
  Of(BayerPlane plane) const
  {
    return channels.at(static_cast<std::size_t>(plane));
  }
  /** Returns whether the report of any channel is usable, see Report::IsUsable(). */
  bool
  IsUsable() const;
};

/** Joins the reports of the planes, which are in the order of BayerPlanes. Names the channels, gives all of them the
 * largest bit depth, and joins their offsets and their motion. Adds a warning if the gains of the two greens differ, if
 * the offsets differ, if the levels contradict the pattern, or if the pattern was found from the levels. */
SensorNoise_EXPORT ChannelReports
MakeChannelReports(BayerPattern pattern, BayerSource source, std::array<Report, 4> channels);

} // namespace sensornoise

#endif
