// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "exports/CareamicsExport.h"

#include "base/Text.h"
#include "exports/ExportInput.h"
#include "exports/NpzFile.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace sensornoise
{
namespace
{
/** CAREamics' floor of the variance, over the variance at the darkest level [1]: low enough never to matter. */
constexpr double floorOfVariance = 1e-6;
} // namespace

NoiseExport
ExportCareamics(const CameraNoise & noise)
{
  const ChannelNoise & channel = OnlyChannel(noise, "careamics");
  const NoiseModel     model = ModelOf(noise, channel);
  if (!channel.lowestDn)
  {
    throw ExportError("the report " + noise.name +
                      " has no measured levels (scatter), between which CAREamics' model is defined. Use the report as "
                      "it was written.");
  }
  const double low = std::max(0.0, *channel.lowestDn);
  const double high = noise.whiteLevelDn.value_or(channel.clipHighDn.value_or(*channel.highestDn));
  const double lowest = model.VarianceAt(low);
  if (!(lowest > 0.0) || !(high > low))
  {
    throw ExportError("the report " + noise.name + " has a variance of " + Text(lowest) +
                      " DN^2 at its darkest level " + Text(low) + " DN, and " + Text(high) +
                      " DN as its brightest level; expected a variance above 0 and a brighter level");
  }
  const double rise = model.varianceSlopeDn * (high - low);
  return OneFile("careamics_noise_model.npz",
                 NpzFile({ { "trained_weight", { 3, 2 }, { 0.0, 0.0, std::log(lowest), std::log(rise), 0.0, 0.0 } },
                           { "min_signal", { 1 }, { low } },
                           { "max_signal", { 1 }, { high } },
                           { "min_sigma", {}, { floorOfVariance * lowest } } }),
                 "The levels are DN as in the frames: CAREamics must not normalise the images.");
}

} // namespace sensornoise
