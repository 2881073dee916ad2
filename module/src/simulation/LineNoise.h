// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_LineNoise_h
#define sensornoise_simulation_LineNoise_h

#include "SensorNoiseExport.h"

#include <cstddef>
#include <cstdint>

namespace sensornoise
{

/** Noise that the pixels of a row or of a column share, added to the code: it comes from the converters and references
 * at the ends of rows and columns and does not grow with the light (EMVA Standard 1288, release 4.0, reports
 * it beside the pixels' own). */
struct LineNoiseSettings
{
  /** Standard deviation of one normal number for each row of each frame [DN], 0 or more. */
  double rowNoiseSdDn{ 0.0 };
  /** Standard deviation of one normal number for each column of each frame [DN], 0 or more. */
  double columnNoiseSdDn{ 0.0 };
  /** Amplitude of a sine along y whose phase is drawn anew for each frame [DN], 0 or more: interference of the power
   * supply. Its standard deviation over frames is amplitude / sqrt(2). */
  double bandingAmplitudeDn{ 0.0 };
  /** Its period [row], above 0. */
  double bandingPeriodRows{ 64.0 };
};

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
