// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_ReadOut_h
#define sensornoise_simulation_ReadOut_h

#include "sensornoise/SensorFlaws.h"
#include "SensorNoiseExport.h"
#include "sensornoise/SimulationSettings.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

/** \throws std::invalid_argument that names the first setting that cannot be used. */
SensorNoise_EXPORT void
CheckSettings(const ResponseSettings & settings);

/** \class ResponseCurve
 * \brief Response R(u), with R(0) = 0: the mean code is offset + gain S R(signal / S).
 *
 * Every shape but Gamma runs from 0 to 1. Below u = 0 and above u = 1 the curve continues linearly, with the slope at
 * its end; Gamma is 0 below 0. */
class SensorNoise_EXPORT ResponseCurve
{
public:
  explicit ResponseCurve(const ResponseSettings & settings = {});

  bool
  IsLinear() const
  {
    return m_Shape == ResponseShape::Straight;
  }

  /** Returns R(u) [1]. */
  double
  Value(double u) const;

  /** Returns R'(u) [1]. For Gamma it is 0 at u = 0, the slope from the left. */
  double
  Slope(double u) const;

  /** Mean and standard deviation of the value of a curve. */
  struct Moments
  {
    double mean;
    double sd;
  };

  /** Returns the mean and the standard deviation of R(noise), for normal noise about 0 with standard deviation \a sd
   * [1]: the effect of the response on read noise in the dark. The result is exact for a linear response. For Gamma,
   * which clips one half of the noise, it is exact for noise below the order of the full scale. For the others it is
   * of first order in \a sd. */
  Moments
  InTheDark(double sd) const;

private:
  double
  InnerValue(double u) const;
  double
  InnerSlope(double u) const;

  ResponseShape m_Shape;
  double        m_Size;
};

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

/** \class ReadOut
 * \brief Conversion of charge to codes, not yet rounded or clipped:
 *
 *   code = mu_p + g_p S R(s / S) + line noise   [DN],   s = electrons + sigma_p / g normal   [e-]
 *
 * with the offset mu_p, gain g_p and read noise sigma_p of the pixel, and the response R with its full scale S. A
 * linear response has R(u) = u. */
class SensorNoise_EXPORT ReadOut
{
public:
  /** \a settings must have been checked by CheckSettings(). */
  ReadOut(const SimulationSettings & settings, std::size_t width, std::size_t height);

  /** Computes the codes of row \a y of frame \a frame [DN].
   * \param electrons charge of each pixel [e-]
   * \param normals one standard normal number for the read noise of each pixel; may be the same memory as \a codesDn */
  void
  ReadRow(std::size_t frame, std::size_t y, const double * electrons, const double * normals, double * codesDn) const;

  /** Returns d(code) / d(electron) of a pixel that holds \a electrons [DN/e-]. */
  double
  LocalGainAt(std::size_t pixel, double electrons) const;

  /** Returns the standard deviation of the digital number of a dark pixel, before rounding and without line noise [DN].
   * It is sigma_p, times the relative gain of the pixel, times the slope of the response in the dark. */
  double
  PixelReadNoiseDn(std::size_t pixel) const;

  /** Returns the mean digital number of a dark pixel [DN]. Under Gamma it is above mu_p, because this curve clips noise
   * below 0. */
  double
  PixelOffsetDn(std::size_t pixel) const;

  struct ReadNoise
  {
    double rmsDn;
    double medianDn;
  };

  /** Returns the root mean square and the median of PixelReadNoiseDn() over all pixels [DN]. */
  ReadNoise
  SummariseReadNoise() const;

private:
  double
  RelativeGain(std::size_t pixel) const
  {
    return m_RelativeGain.empty() ? 1.0 : m_RelativeGain[pixel];
  }
  /** Returns mu_p [DN]. */
  double
  OffsetDn(std::size_t pixel) const
  {
    return m_Camera.offsetDn + (m_OffsetDn.empty() ? 0.0 : m_OffsetDn[pixel]);
  }
  /** Returns sigma_p [DN]. */
  double
  ReadNoiseDn(std::size_t pixel) const
  {
    return m_ReadNoiseDn.empty() ? m_Camera.readNoiseDn : m_ReadNoiseDn[pixel];
  }
  /** Returns the mean and the standard deviation of the response to sigma_p alone, in units of the full scale [1]. */
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
