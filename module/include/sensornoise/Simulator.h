// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_Simulator_h
#define sensornoise_Simulator_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "simulation/DoubleFrame.h"
#include "simulation/FrameProcessing.h"
#include "simulation/ReadOut.h"
#include "simulation/SceneLight.h"
#include "sensornoise/SimulationSettings.h"
#include "simulation/SimulationTruth.h"
#include "simulation/TemporalFilter.h"

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace sensornoise
{

/** \class StackSimulator
 * A burst of frames of a static scene with known noise: equation (2.1) of Sur and Grediac 2015
 * (DOI 10.1137/140977035), as in their section 4.2,
 *
 *   u(x, y, t) = g Poisson((1 + gamma_t) p(x + alpha_t, y + beta_t)) + Normal(mu, sigma^2)   [DN]
 *
 * with p the reference image, blurred and then scaled to [0, electrons] (a constant image: `electrons` everywhere),
 * interpolated linearly with edge pixels replicated. A rate below 0 counts as 0. Flaws of a real sensor can be added:
 * rolling shutter, saturation and floor, PRNU, DSNU and hot pixels (SimulationSettings), and those of SensorFlaws.
 *
 * A row is a pure function of (settings, frame, row): rows may be drawn in any order and by any number of threads.
 * Where flaws mix the rows of a frame or the frames (NeedsWholeFrames()), the same holds for whole frames:
 * RenderFrame(). The simulator holds one frame of doubles, and one more for each kind of fixed pattern (efficiency,
 * gain, offset, read noise) and for the temporal filter, never the stack.
 *
   \code
   const StackSimulator simulator(MakeTargetScene(512, 512), 512, 512, SimulationSettings{});
   std::vector<unsigned short> row(512);
   simulator.RenderRow(0, 100, row.data()); // row 100 of frame 0
   \endcode
 */
class SensorNoise_EXPORT StackSimulator
{
public:
  /** \param reference image, row after row, any range
   * \param width columns
   * \param height rows
   * \throws std::invalid_argument if the settings, the size or a reference value cannot be used. */
  StackSimulator(const std::vector<double> & reference,
                 std::size_t                 width,
                 std::size_t                 height,
                 const SimulationSettings &  settings);

  std::size_t
  GetWidth() const
  {
    return m_Width;
  }

  std::size_t
  GetHeight() const
  {
    return m_Height;
  }

  const SimulationTruth &
  GetTruth() const
  {
    return m_Truth;
  }

  /** Expected electrons of row `y` of frame `frame`: (1 + gamma) p(x + alpha, y + beta), with PRNU, cut at 0; 0 in dark
   * frames. `electrons` has room for one row. */
  void
  ExpectedElectronsRow(std::size_t frame, std::size_t y, double * electrons) const;

  /** d(mean code) / d(electron) of a pixel at its mean light [DN/e-]: gain, times the pixel's part of it, times the
   * slope of the response where noise and flicker are centred. The gain that a pixel's variance shows, to first order.
   */
  double
  LocalGainAt(std::size_t pixel) const;

  /** Standard deviation of a pixel's code without light, before rounding [DN]. */
  double
  PixelReadNoiseDn(std::size_t pixel) const
  {
    return m_ReadOut.PixelReadNoiseDn(pixel);
  }

  /** Mean code of a pixel without light, before rounding and clipping [DN]. */
  double
  PixelOffsetDn(std::size_t pixel) const
  {
    return m_ReadOut.PixelOffsetDn(pixel);
  }

  /** Draws row `y` of frame `frame` into `out`, which has room for one row [DN].
   *
   * Integer pixels are rounded to the nearest code and clipped to [max(0, clipLowDn), min(2^bitDepth - 1, clipHighDn)]
   * (bit depth 0: to the range of the type). Floating-point pixels are neither rounded nor clipped, unless a clip level
   * is set.
   * \throws std::invalid_argument if the bit depth does not fit in the type, or if NeedsWholeFrames(). */
  template <typename TPixel>
  void
  RenderRow(std::size_t frame, std::size_t y, TPixel * out) const;

  /** Whether flaws mix the rows of a frame, or frames: then frames are drawn by RenderFrame() alone. */
  bool
  NeedsWholeFrames() const
  {
    return sensornoise::NeedsWholeFrames(m_Truth.settings.flaws);
  }

  /** Draws frame `frame` into `out`, which has room for one frame, row after row [DN]; always possible, and the same as
   * RenderRow() for each row where that is. Frames may be asked for in any order with the same result; with a temporal
   * filter each costs least one after the other.
   * \throws std::invalid_argument if the bit depth does not fit in the type. */
  template <typename TPixel>
  void
  RenderFrame(std::size_t frame, TPixel * out, const ParallelFor & parallelFor = SerialFor) const;

  /** Lowest and highest value [DN] that a pixel of type TPixel takes under these settings.
   * \throws std::invalid_argument if the bit depth does not fit in the type, or no code is left. */
  template <typename TPixel>
  static std::pair<double, double>
  CodeRange(const SimulationSettings & settings);

private:
  void
  RequireRow(std::size_t frame, std::size_t y) const;

  /** Collected electrons of row `y` of frame `frame`, and normal numbers for its read noise. */
  void
  ExposeRow(std::size_t frame, std::size_t y, double * electrons, double * normals) const;

  /** Codes of a row as the sensor gives them, between its clip levels but not rounded [DN]. */
  void
  ReadRow(std::size_t frame, std::size_t y, const double * electrons, const double * normals, double * codesDn) const;

  /** Codes of a frame as the sensor gives them. */
  DoubleFrame
  ReadFrame(std::size_t frame, const ParallelFor & parallelFor) const;

  /** Companding, rounding and clipping of one row. */
  template <typename TPixel>
  void
  WriteRow(double * codesDn, TPixel * out) const;

  std::size_t                     m_Width;
  std::size_t                     m_Height;
  SimulationTruth                 m_Truth;
  SceneLight                      m_Light;
  ReadOut                         m_ReadOut;
  double                          m_MeanBrightness; ///< mean of 1 + gamma over the frames
  std::shared_ptr<TemporalFilter> m_TemporalFilter; ///< its memory; copies of a simulator may share it
};

} // namespace sensornoise

#endif // sensornoise_Simulator_h
