// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_LineNoise_h
#define sensornoise_simulation_LineNoise_h

#include "sensornoise/SensorFlaws.h"
#include "SensorNoiseExport.h"

#include <cstddef>
#include <cstdint>

namespace sensornoise
{

/** \throws std::invalid_argument naming the first setting that cannot be used. */
SensorNoise_EXPORT void
CheckSettings(const LineNoiseSettings & settings);

/** \class LineNoise
 * A pure function of settings, seed, frame and row; frames with the shutter closed have noise of their own. */
class SensorNoise_EXPORT LineNoise
{
public:
  explicit LineNoise(const LineNoiseSettings & settings = {}, std::uint64_t seed = 0, bool isDark = false);

  bool
  IsOn() const
  {
    return m_Settings.rowNoiseSdDn > 0.0 || m_Settings.columnNoiseSdDn > 0.0 || m_Settings.bandingAmplitudeDn > 0.0;
  }

  /** What all pixels of row \a y of frame \a frame share: row noise and banding [DN]. */
  double
  OfRow(std::size_t frame, std::size_t y) const;

  /** Adds the noise of row \a y of frame \a frame to its \a width codes [DN]. */
  void
  AddTo(double * codesDn, std::size_t width, std::size_t frame, std::size_t y) const;

private:
  LineNoiseSettings m_Settings;
  std::uint64_t     m_Seed;
  bool              m_IsDark;
};

} // namespace sensornoise

#endif
