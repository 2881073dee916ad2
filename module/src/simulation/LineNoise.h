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

/** \throws std::invalid_argument that names the first setting that cannot be used. */
SensorNoise_EXPORT void
CheckSettings(const LineNoiseSettings & settings);

/** \class LineNoise
 * \brief Noise of rows and columns: a pure function of settings, seed, frame and row. Frames with the shutter closed
 * have independent noise. */
class SensorNoise_EXPORT LineNoise
{
public:
  explicit LineNoise(const LineNoiseSettings & settings = {}, std::uint64_t seed = 0, bool isDark = false);

  bool
  IsOn() const
  {
    return m_Settings.rowNoiseSdDn > 0.0 || m_Settings.columnNoiseSdDn > 0.0 || m_Settings.bandingAmplitudeDn > 0.0;
  }

  /** Returns the noise that all pixels of row \a y of frame \a frame have in common: row noise and banding [DN]. */
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
