// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_Simulator_h
#define sensornoise_Simulator_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/SimulationSettings.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

/** \file
 * Simulated bursts: the scenes, made by program (nothing to download, any size), the truth, and the simulator. A scene
 * is a vector of doubles, row after row, with values in [0, 1]. Functions that make one throw std::invalid_argument for
 * a smaller size than they need. */

namespace sensornoise
{

struct DoubleFrame;

/** Seed of the scenes: the scene stays the same when only the noise is drawn anew. */
inline constexpr std::uint64_t DefaultSceneSeed = 3;

/** Linear map of the image's own range onto [low, high]. A constant image becomes `high` everywhere. */
SensorNoise_EXPORT std::vector<double>
ScaleToRange(std::vector<double> image, double low, double high);

/** Gaussian blur: sampled kernel of standard deviation `sdPixels`, cut at 4 standard deviations and normalised, edge
 * pixels replicated (as SciPy's `gaussian_filter` with mode "nearest"). 0 leaves the image as it is. */
SensorNoise_EXPORT std::vector<double>
GaussianBlur(const std::vector<double> & image,
             std::size_t                 width,
             std::size_t                 height,
             double                      sdPixels,
             const ParallelFor &         parallelFor = SerialFor);

/** Calibration target: 4 x 4 grey patches on a surround of 0.12, each patch with a margin of 7 % of its cell (at least
 * 2 pixels). The patches hold the 16 levels 0, 1/15, ..., 1 in an order drawn from the seed. Large flat areas: the
 * easy case, like the image "Synthetic" of Sur and Grediac 2015, section 4.2. At least 32 x 32 pixels. */
SensorNoise_EXPORT std::vector<double>
MakeTargetScene(std::size_t width, std::size_t height, std::uint64_t seed = DefaultSceneSeed);

/** Sixteen vertical bars of equal width with the levels 0, 1/15, ..., 1 in a fixed, shuffled order. Every row holds
 * every level, so what differs from row to row (rolling-shutter flicker) stands apart from the scene. At least 16
 * columns; a width that is no multiple of 16 makes bars that differ by one column. */
SensorNoise_EXPORT std::vector<double>
MakeBarsScene(std::size_t width, std::size_t height);

/** Natural-looking texture: dead leaves (discs that hide each other, number of radii in [r, r + dr] proportional to
 * r^-3, random grey: Lee, Mumford and Huang, IJCV 41, 2001, DOI 10.1023/A:1011109015675), each leaf with 1/f value
 * noise of its own strength. Edges of all sizes and few flat areas: the hard case, where vibration reaches most pixels.
 * At least 16 x 16 pixels. */
SensorNoise_EXPORT std::vector<double>
MakeTextureScene(std::size_t width, std::size_t height, std::uint64_t seed = DefaultSceneSeed);

/** An even surface under even light: 1 everywhere. At least 1 x 1 pixel. */
SensorNoise_EXPORT std::vector<double>
MakeFlatScene(std::size_t width, std::size_t height);

/** The random numbers that are common to a frame, one each per frame. */
struct SimulatedSeries
{
  /** Illumination of the frames relative to the settings' electrons, less 1 [1]: their illumination factor times their
   * flicker; with a rolling shutter its mean over the rows. */
  std::vector<double> gamma;
  /** Illumination factors of the frames without flicker [1]. */
  std::vector<double> factor;
  /** Horizontal shift [pixel]: the frame shows p(x + alpha, y + beta). */
  std::vector<double> alpha;
  /** Vertical shift [pixel]. */
  std::vector<double> beta;
  /** Phase of the lamp at row 0 [rad], for the rolling shutter. */
  std::vector<double> phase;
};

/** What an estimator of a simulated stack should find. The scale and the position of the scene are free, so only
 * (1 + gamma_t) / mean(1 + gamma) - 1 and the spread of the shifts can be found. */
struct SimulationTruth
{
  SimulationSettings settings;
  SimulatedSeries    series;
  /** (1 + gamma_t) / mean(1 + gamma) - 1, one per frame [1]. */
  std::vector<double> normalisedFlicker;
  /** Standard deviation of the normalised flicker of this stack (divisor T - 1) [1]; with a rolling shutter the root
   * mean square over the rows of that of each row. NaN for one frame, as are the two below. */
  double realisedFlickerSd{ 0.0 };
  /** Standard deviation of this stack's alpha (divisor T - 1) [pixel]. */
  double realisedVibrationSdXPixels{ 0.0 };
  /** Standard deviation of this stack's beta (divisor T - 1) [pixel]. */
  double realisedVibrationSdYPixels{ 0.0 };
  /** Root mean square over all pixels of the standard deviation of the code without light, hot pixels and the tail of
   * the read noise included, rounding and line noise not [DN]. NaN where the truth was drawn without a width. */
  double realisedReadNoiseRmsDn{ std::numeric_limits<double>::quiet_NaN() };
  /** Median of the same [DN]. */
  double realisedReadNoiseMedianDn{ std::numeric_limits<double>::quiet_NaN() };
};

/** Returns gamma_t(y) of row `y` of frame `frame`: illumination factor times flicker, less 1 [1]. */
SensorNoise_EXPORT double
FlickerOfRow(const SimulationSettings & settings, const SimulatedSeries & series, std::size_t frame, std::size_t y);

/** Draws the series of a stack of frames with `height` rows and works out what an estimator should find. The numbers of
 * a frame depend on the seed and on the frame alone: a longer stack begins with the shorter one.
 * \throws std::invalid_argument if a setting cannot be used. */
SensorNoise_EXPORT SimulationTruth
DrawTruth(const SimulationSettings & settings, std::size_t height);

/** The same, with what depends on the pixels: the realised read noise. */
SensorNoise_EXPORT SimulationTruth
DrawTruth(const SimulationSettings & settings, std::size_t width, std::size_t height);

/** The truth of a simulated stack as JSON, schema "itk-sensornoise-truth/1": every parameter by the names of the
 * report, and the random series. Numbers that do not exist (a standard deviation of one frame) are null. */
SensorNoise_EXPORT std::string
ToJson(const SimulationTruth & truth, std::size_t width, std::size_t height);

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
  PixelReadNoiseDn(std::size_t pixel) const;

  /** Mean code of a pixel without light, before rounding and clipping [DN]. */
  double
  PixelOffsetDn(std::size_t pixel) const;

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
  NeedsWholeFrames() const;

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

  struct Sensor;

  std::size_t                   m_Width;
  std::size_t                   m_Height;
  SimulationTruth               m_Truth;
  double                        m_MeanBrightness; ///< mean of 1 + gamma over the frames
  std::shared_ptr<const Sensor> m_Sensor;         ///< copies of a simulator share it
};

} // namespace sensornoise

#endif
