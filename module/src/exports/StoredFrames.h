// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_exports_StoredFrames_h
#define sensornoise_exports_StoredFrames_h

#include "exports/NoiseProfile.h"
#include "sensornoise/NoiseModel.h"

#include <optional>
#include <string>
#include <vector>

namespace sensornoise
{

/** The check of a profile on one channel of the frames: a result, or the reason why there is none. */
struct ChannelProfileCheck
{
  std::string                    channel; ///< "mono", "R", "G1", "G2" or "B"
  std::optional<NoiseModelCheck> check;
  std::string                    reason; ///< a sentence; "": there is a check
};

/** Compares the variance of frames with the variance that a profile of another program gives, channel by channel, by
 * CheckNoiseProfile().
 * \param profile noise profile
 * \param frames stored report of the refined method on the frames
 * \param noise the same report as exports use it, with the black and the white level and all of its channels
 * \throws ExportError if the report has no noise curve. */
SensorNoise_EXPORT std::vector<ChannelProfileCheck>
CheckStoredFrames(const NoiseProfile & profile, const StoredReport & frames, const CameraNoise & noise);

} // namespace sensornoise

#endif
