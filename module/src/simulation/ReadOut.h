// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_ReadOut_h
#define sensornoise_simulation_ReadOut_h

#include "SensorNoiseExport.h"
#include "simulation/LineNoise.h"
#include "simulation/ResponseCurve.h"
#include "sensornoise/SimulationSettings.h"

#include <cstddef>
#include <vector>

namespace sensornoise
{

/** \class ReadOut
 * From charge to code, not yet rounded or clipped:
 *
 *   code = mu_p + g_p S R(s / S) + line noise   [DN],   s = electrons + sigma_p / g normal   [e-]
 *
 * with the pixel's offset mu_p, gain g_p and read noise sigma_p, and the response R with its full scale S; R(u) = u
 * unless the response is bent. */
class SensorNoise_EXPORT ReadOut
{
public:
  /** \a settings have been checked. */
  ReadOut(const SimulationSettings & settings, std::size_t width, std::size_t height);

  /** Codes of row \a y of frame \a frame [DN].
   * \param electrons charge of each pixel [e-]
   * \param normals one normal number for the read noise of each pixel; may be the same place as \a codesDn */
  void
  ReadRow(std::size_t frame, std::size_t y, const double * electrons, const double * normals, double * codesDn) const;

  /** d(code) / d(electron) of a pixel that holds \a electrons [DN/e-]. */
  double
  LocalGainAt(std::size_t pixel, double electrons) const;

  /** Standard deviation of a pixel's code without light, before rounding and without line noise [DN]: sigma_p, times
   * the pixel's gain, times the slope of the response in the dark. */
  double
  PixelReadNoiseDn(std::size_t pixel) const;

  /** Mean code of a pixel without light [DN]; under Gamma above mu_p, for that curve cuts noise below 0 off. */
  double
  PixelOffsetDn(std::size_t pixel) const;

  struct ReadNoise
  {
    double rmsDn;
    double medianDn;
  };

  /** Root mean square and median of PixelReadNoiseDn over all pixels [DN]. */
  ReadNoise
  SummariseReadNoise() const;

private:
  double
  RelativeGain(std::size_t pixel) const
  {
    return m_RelativeGain.empty() ? 1.0 : m_RelativeGain[pixel];
  }
  /** mu_p [DN]. */
  double
  OffsetDn(std::size_t pixel) const
  {
    return m_Camera.offsetDn + (m_OffsetDn.empty() ? 0.0 : m_OffsetDn[pixel]);
  }
  /** sigma_p [DN]. */
  double
  ReadNoiseDn(std::size_t pixel) const
  {
    return m_ReadNoiseDn.empty() ? m_Camera.readNoiseDn : m_ReadNoiseDn[pixel];
  }
  /** What the response makes of sigma_p alone, in units of the full scale. */
  ResponseCurve::Moments
  InTheDark(std::size_t pixel) const;

  CameraModel         m_Camera;
  std::size_t         m_Width;
  std::size_t         m_Height;
  ResponseCurve       m_Response;
  double              m_FullScaleElectrons;
  LineNoise           m_LineNoise;
  std::vector<double> m_RelativeGain;
  std::vector<double> m_OffsetDn;
  std::vector<double> m_ReadNoiseDn;
};

} // namespace sensornoise

#endif
