// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_SimulatedSensor_h
#define sensornoise_simulation_SimulatedSensor_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/SensorFlaws.h"
#include "sensornoise/SimulationSettings.h"
#include "sensornoise/Simulator.h"
#include "simulation/FrameProcessing.h"

#include <cstddef>
#include <cstdint>
#include <vector>

/** \file
 * The simulated sensor: the charge that its pixels collect, its fixed-pattern noise, and its read-out.
 *
 * Fixed-pattern noise of all causes is in maps that differ from pixel to pixel and stay the same from frame to frame.
 * They depend on the seed, not on the frames or on the illumination; a map is empty where all pixels are equal. */

namespace sensornoise
{

/** \throws std::invalid_argument that names the first setting that cannot be used for a stack of `frames` frames. */
SensorNoise_EXPORT void
CheckSettings(const IlluminationSettings & illumination, std::size_t frames);

/** Returns the illumination factor of a frame [1]. A random factor depends on the seed and on the frame alone. */
SensorNoise_EXPORT double
IlluminationFactor(const IlluminationSettings & illumination,
                   std::size_t                  frame,
                   std::size_t                  frames,
                   std::uint64_t                seed);

/** \class ExpectedSignal
 * \brief Expected number of electrons of each pixel.
 *
 * The reference image is blurred by the optics, and scaled to [0, electrons] (a constant image: `electrons`
 * everywhere). It is then shifted and brightened as in the truth of the stack, and multiplied by the efficiency of the
 * pixel. The number is 0 where the shutter is closed. */
class SensorNoise_EXPORT ExpectedSignal
{
public:
  /** \throws std::invalid_argument if the size or a reference value cannot be used. */
  ExpectedSignal(const std::vector<double> & reference,
                 std::size_t                 width,
                 std::size_t                 height,
                 const SimulationSettings &  settings);

  /** Computes (1 + gamma) p(x + alpha, y + beta) for row \a y of frame \a frame, times the efficiency, at least 0;
   * linear between pixels, edge pixels replicated [e-]. */
  void
  ExpectedElectronsRow(const SimulationTruth & truth, std::size_t frame, std::size_t y, double * electrons) const;

  /** Returns the expected number of electrons of a pixel without a shift, for an illumination factor \a brightness
   * [e-]. */
  double
  ElectronsAtRest(std::size_t pixel, double brightness) const;

private:
  std::size_t         m_Width;
  std::size_t         m_Height;
  bool                m_IsDark;
  std::vector<double> m_Electrons;
  std::vector<double> m_Efficiency; ///< empty: 1 everywhere
};

/** \throws std::invalid_argument that names the first setting that cannot be used with \a electrons in the brightest
 * pixel [e-]. */
SensorNoise_EXPORT void
CheckSettings(const BrighterFatterSettings & settings, double electrons);

/** Returns the collected charges [e-]; \a charge are the charges without the effect [e-]. */
SensorNoise_EXPORT DoubleFrame
SpreadCharge(const DoubleFrame & charge, const BrighterFatterSettings & settings, const ParallelFor & parallelFor);

/** \throws std::invalid_argument that names the first setting that cannot be used. */
SensorNoise_EXPORT void
CheckSettings(const CouplingSettings & settings);

/** Returns the signals that are read for the charges \a charge [e-]. */
SensorNoise_EXPORT DoubleFrame
CoupleCharge(const DoubleFrame & charge, const CouplingSettings & settings, const ParallelFor & parallelFor);

/** \throws std::invalid_argument if a transmission is not from 0 to 1. */
inline void
CheckSettings(const ColourFilterSettings & settings)
{
  RequireFraction(settings.transmissionR, "transmission of the red filter");
  RequireFraction(settings.transmissionG, "transmission of the green filter");
  RequireFraction(settings.transmissionB, "transmission of the blue filter");
}

/** Multiplies each pixel of \a efficiency by the transmission of its filter. An empty map stands for 1 everywhere, and
 * stays empty where there are no filters. */
SensorNoise_EXPORT void
ApplyFilters(const ColourFilterSettings & settings,
             std::size_t                  width,
             std::size_t                  height,
             std::vector<double> &        efficiency);

/** \throws std::invalid_argument that names the first setting that cannot be used. */
SensorNoise_EXPORT void
CheckSettings(const PatternSettings & settings);

/** Returns the gain of every pixel in units of the camera's gain [1]: 1 + gainSd normal, times 1 + columnGainSd normal
 * for its column. The map is divided by its mean, so that its mean is 1. Empty if both settings are 0. */
SensorNoise_EXPORT std::vector<double>
DrawGainPattern(const PatternSettings & settings, std::uint64_t seed, std::size_t width, std::size_t height);

/** Returns the efficiency of every column in units of the mean efficiency [1]: 1 + columnEfficiencySd normal, divided
 * by the mean over the columns. Empty if the setting is 0. */
SensorNoise_EXPORT std::vector<double>
DrawColumnEfficiency(const PatternSettings & settings, std::uint64_t seed, std::size_t width);

/** Returns the offset of every column relative to the camera's offset [DN]. The offsets are normal numbers, whose mean
 * is 0 to within its error. Empty if the setting is 0. */
SensorNoise_EXPORT std::vector<double>
DrawColumnOffsetDn(const PatternSettings & settings, std::uint64_t seed, std::size_t width);

/** \throws std::invalid_argument that names the first setting that cannot be used. */
SensorNoise_EXPORT void
CheckSettings(const ReadNoiseSettings & settings);

/** Returns the read noise of every pixel in units of the median of the pixels that are not in the tail [1]. Empty if
 * all pixels are equal. */
SensorNoise_EXPORT std::vector<double>
DrawReadNoisePattern(const ReadNoiseSettings & settings, std::uint64_t seed, std::size_t pixels);

/** Returns the efficiency of every pixel in units of the camera's efficiency: prnuSd, columnEfficiencySd and the colour
 * filters [1]. */
SensorNoise_EXPORT std::vector<double>
DrawEfficiency(const SimulationSettings & settings, std::size_t width, std::size_t height);

/** Returns the offset of every pixel relative to the camera's offset: dsnuSdDn and columnOffsetSdDn [DN]. */
SensorNoise_EXPORT std::vector<double>
DrawOffsetDn(const SimulationSettings & settings, std::size_t width, std::size_t height);

/** Returns the read noise of every pixel before its relative gain and its response: hot pixels and ReadNoiseSettings
 * [DN]. */
SensorNoise_EXPORT std::vector<double>
DrawReadNoiseDn(const SimulationSettings & settings, std::size_t width, std::size_t height);

/** \throws std::invalid_argument that names the first setting that cannot be used. */
SensorNoise_EXPORT void
CheckSettings(const ResponseSettings & settings);

/** \class ResponseCurve
 * \brief Response R(u), with R(0) = 0: the mean digital number is offset + gain S R(signal / S).
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

  /** Returns R'(u) [1]. For Gamma the slope at u = 0 is 0, the slope from the left. */
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

  /** Adds the noise of row \a y of frame \a frame to its \a width digital numbers [DN]. */
  void
  AddTo(double * valuesDn, std::size_t width, std::size_t frame, std::size_t y) const;

private:
  LineNoiseSettings m_Settings;
  std::uint64_t     m_Seed;
  bool              m_IsDark;
};

/** \class ReadOut
 * \brief Conversion of charge to digital numbers, not yet rounded or clipped:
 *
 *   y = mu_p + g_p S R(s / S) + line noise   [DN],   s = electrons + sigma_p / g normal   [e-]
 *
 * with the offset mu_p, gain g_p and read noise sigma_p of the pixel, and the response R with its full scale S. A
 * linear response has R(u) = u. */
class SensorNoise_EXPORT ReadOut
{
public:
  /** \a settings must have been checked by CheckSettings(). */
  ReadOut(const SimulationSettings & settings, std::size_t width, std::size_t height);

  /** Computes the digital numbers of row \a y of frame \a frame [DN].
   * \param electrons charge of each pixel [e-]
   * \param normals one standard normal number for the read noise of each pixel; may be the same memory as \a valuesDn
   */
  void
  ReadRow(std::size_t frame, std::size_t y, const double * electrons, const double * normals, double * valuesDn) const;

  /** Returns dy / d(electron) of a pixel that holds \a electrons [DN/e-]. */
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
