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
 * Simulated bursts: scenes of any size, the true values of a stack, and the simulator. A scene is a vector of doubles,
 * row after row, with values in [0, 1]. Functions that make a scene throw std::invalid_argument if its size is below
 * the given minimum. */

namespace sensornoise
{

struct DoubleFrame;

/** Default seed of the scenes. It is independent of SimulationSettings::seed, so that another seed of the noise leaves
 * the scene unchanged. */
inline constexpr std::uint64_t DefaultSceneSeed = 3;

/** Returns the image after the linear map of its range onto [low, high]. A constant image becomes `high` everywhere. */
SensorNoise_EXPORT std::vector<double>
ScaleToRange(std::vector<double> image, double low, double high);

/** Returns the image after a Gaussian blur. The kernel is sampled, cut at 4 standard deviations and normalised; edge
 * pixels are replicated, as by SciPy's `gaussian_filter` with mode "nearest". `sdPixels` is the standard deviation of
 * the kernel [pixel]; 0 leaves the image unchanged. */
SensorNoise_EXPORT std::vector<double>
GaussianBlur(const std::vector<double> & image,
             std::size_t                 width,
             std::size_t                 height,
             double                      sdPixels,
             const ParallelFor &         parallelFor = SerialFor);

/** Returns a calibration target: 4 x 4 uniform grey fields on a surround of 0.12. Each field has a margin of 7 % of its
 * pitch, at least 2 pixels. The fields have the 16 levels 0, 1/15, ..., 1 in a random order. The large uniform areas
 * make it the easy case, like the image "Synthetic" of Sur and Grediac 2015, section 4.2. The size is at least 32 x 32
 * pixels. */
SensorNoise_EXPORT std::vector<double>
MakeTargetScene(std::size_t width, std::size_t height, std::uint64_t seed = DefaultSceneSeed);

/** Returns sixteen vertical bars of equal width with the levels 0, 1/15, ..., 1 in a fixed, shuffled order. Every row
 * contains every level, so that differences between rows (rolling-shutter flicker) are distinguished from the scene. If
 * the width is no multiple of 16, bars differ by one column. The width is at least 16 pixels. */
SensorNoise_EXPORT std::vector<double>
MakeBarsScene(std::size_t width, std::size_t height);

/** Returns a texture with the statistics of natural images. It consists of dead leaves: discs of random grey that hide
 * each other, where the number of radii in [r, r + dr] is proportional to r^-3 (Lee, Mumford and Huang, IJCV 41, 2001,
 * DOI 10.1023/A:1011109015675). Each leaf has 1/f value noise of random strength. Edges of all sizes and few uniform
 * areas make it the hard case, in which vibration affects most pixels. The size is at least 16 x 16 pixels. */
SensorNoise_EXPORT std::vector<double>
MakeTextureScene(std::size_t width, std::size_t height, std::uint64_t seed = DefaultSceneSeed);

/** Returns a uniform surface under uniform illumination: 1 everywhere. The size is at least 1 x 1 pixel. */
SensorNoise_EXPORT std::vector<double>
MakeFlatScene(std::size_t width, std::size_t height);

/** Temporal components of a simulated stack. Each vector has one value per frame. */
struct SimulatedSeries
{
  /** Illumination of the frames relative to the electrons of the settings, minus 1 [1]: the illumination factor times
   * the flicker; with a rolling shutter its mean over the rows. */
  std::vector<double> gamma;
  /** Illumination factors of the frames without flicker [1]. */
  std::vector<double> factor;
  /** Horizontal shift [pixel]: the frame shows p(x + alpha, y + beta). */
  std::vector<double> alpha;
  /** Vertical shift [pixel]. */
  std::vector<double> beta;
  /** Phase of the pulsed illumination at row 0 [rad], for the rolling shutter. */
  std::vector<double> phase;
};

/** True values of a simulated stack. Scale and position of the scene are free. Therefore only
 * (1 + gamma_t) / mean(1 + gamma) - 1 and the standard deviation of the shifts are identifiable. */
struct SimulationTruth
{
  SimulationSettings settings; ///< settings of the stack
  SimulatedSeries    series;   ///< temporal components of the stack
  /** Normalised flicker of each frame, (1 + gamma_t) / mean(1 + gamma) - 1 [1]. */
  std::vector<double> normalisedFlicker;
  /** Standard deviation of the normalised flicker of this stack (divisor T - 1) [1]; with a rolling shutter the root
   * mean square of the standard deviations of the rows. NaN for one frame. */
  double realisedFlickerSd{ 0.0 };
  /** Standard deviation of alpha in this stack (divisor T - 1) [pixel]; NaN for one frame. */
  double realisedVibrationSdXPixels{ 0.0 };
  /** Standard deviation of beta in this stack (divisor T - 1) [pixel]; NaN for one frame. */
  double realisedVibrationSdYPixels{ 0.0 };
  /** Root mean square of StackSimulator::PixelReadNoiseDn() over all pixels [DN]: with hot pixels and the tail of the
   * read noise, without quantization noise and line noise. NaN if the width of the frames was not given. */
  double realisedReadNoiseRmsDn{ std::numeric_limits<double>::quiet_NaN() };
  /** Median of StackSimulator::PixelReadNoiseDn() over all pixels [DN]; NaN if the width was not given. */
  double realisedReadNoiseMedianDn{ std::numeric_limits<double>::quiet_NaN() };
};

/** Returns gamma_t(y) of row `y` of frame `frame`: illumination factor times flicker, minus 1 [1]. */
SensorNoise_EXPORT double
FlickerOfRow(const SimulationSettings & settings, const SimulatedSeries & series, std::size_t frame, std::size_t y);

/** Draws the temporal components of a stack of frames with `height` rows, and returns its true values. The numbers of a
 * frame depend on the seed and on the number of the frame alone: a longer stack begins with the shorter stack. Throws
 * std::invalid_argument as CheckSettings(). */
SensorNoise_EXPORT SimulationTruth
DrawTruth(const SimulationSettings & settings, std::size_t height);

/** Draws the temporal components as above, and returns the true values with the realised read noise of the pixels. */
SensorNoise_EXPORT SimulationTruth
DrawTruth(const SimulationSettings & settings, std::size_t width, std::size_t height);

/** Returns the true values of a simulated stack as JSON, schema "itk-sensornoise-truth/1": every parameter by its name
 * in the report, and the temporal components. Numbers that do not exist, as a standard deviation of one frame, are
 * null. */
SensorNoise_EXPORT std::string
ToJson(const SimulationTruth & truth, std::size_t width, std::size_t height);

/** \class StackSimulator
 * Simulates a burst of frames of a static scene with known noise, by equation (2.1) of Sur and Grediac 2015
 * (DOI 10.1137/140977035) and as in their section 4.2:
 *
 *   u(x, y, t) = g Poisson((1 + gamma_t) p(x + alpha_t, y + beta_t)) + Normal(mu, sigma^2)   [DN]
 *
 * p is the reference image, blurred and then scaled to [0, electrons] (a constant image: `electrons` everywhere). It is
 * interpolated linearly, with edge pixels replicated. A rate below 0 counts as 0. SimulationSettings adds a rolling
 * shutter, clip levels, PRNU, DSNU and hot pixels; SensorFlaws adds further effects.
 *
 * A row is a pure function of settings, frame and row: rows may be drawn in any order and by any number of threads. If
 * effects mix the rows of a frame, or frames (NeedsWholeFrames()), only whole frames can be drawn (RenderFrame()), also
 * in any order. The simulator holds one frame of doubles, and one more for each fixed pattern (efficiency, gain,
 * offset, read noise) and for the temporal filter. It never holds the stack.
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
  /** Prepares the reference image and the fixed patterns, and draws the temporal components.
   * \param reference image of the scene, row after row, in any range
   * \param width number of columns
   * \param height number of rows
   * \param settings parameters of the stack
   * \throws std::invalid_argument if the settings, the size or a reference value cannot be used. */
  StackSimulator(const std::vector<double> & reference,
                 std::size_t                 width,
                 std::size_t                 height,
                 const SimulationSettings &  settings);

  /** Returns the number of columns of a frame. */
  std::size_t
  GetWidth() const
  {
    return m_Width;
  }

  /** Returns the number of rows of a frame. */
  std::size_t
  GetHeight() const
  {
    return m_Height;
  }

  /** Returns the true values of the stack. */
  const SimulationTruth &
  GetTruth() const
  {
    return m_Truth;
  }

  /** Computes the expected electrons of row `y` of frame `frame` [e-]: (1 + gamma) p(x + alpha, y + beta), with PRNU,
   * cut at 0; 0 in dark frames. `electrons` has room for one row. */
  void
  ExpectedElectronsRow(std::size_t frame, std::size_t y, double * electrons) const;

  /** Returns the local gain of a pixel at its mean signal, d(mean digital number) / d(electron) [DN/e-]: the gain of
   * the camera, times the relative gain of the pixel, times the slope of the response at the mean signal. To first
   * order it is the gain that the variance of the pixel shows. */
  double
  LocalGainAt(std::size_t pixel) const;

  /** Returns the standard deviation of the digital number of a pixel in the dark, before rounding and without line
   * noise [DN]. */
  double
  PixelReadNoiseDn(std::size_t pixel) const;

  /** Returns the mean digital number of a pixel in the dark, before rounding and clipping [DN]. */
  double
  PixelOffsetDn(std::size_t pixel) const;

  /** Draws row `y` of frame `frame` into `out`, which has room for one row [DN].
   *
   * Integer pixels are rounded to the nearest number and clipped to
   * [max(0, clipLowDn), min(2^bitDepth - 1, clipHighDn)] (bit depth 0: to the range of the type). Floating-point pixels
   * are not rounded, and are clipped only to clip levels that are set.
   * \throws std::invalid_argument if the bit depth does not fit in the type, or if NeedsWholeFrames(). */
  template <typename TPixel>
  void
  RenderRow(std::size_t frame, std::size_t y, TPixel * out) const;

  /** Returns whether effects mix the rows of a frame, or frames, so that only RenderFrame() can draw them. */
  bool
  NeedsWholeFrames() const;

  /** Draws frame `frame` into `out`, which has room for one frame, row after row [DN]. It is always possible. The
   * result equals RenderRow() for each row, if RenderRow() is possible, and does not depend on the order of the frames.
   * With a temporal filter ascending order is fastest.
   * \throws std::invalid_argument if the bit depth does not fit in the type. */
  template <typename TPixel>
  void
  RenderFrame(std::size_t frame, TPixel * out, const ParallelFor & parallelFor = SerialFor) const;

  /** Returns the lowest and the highest value of a pixel of type TPixel with these settings [DN].
   * \throws std::invalid_argument if the bit depth does not fit in the type, or if no value is left. */
  template <typename TPixel>
  static std::pair<double, double>
  PixelRangeDn(const SimulationSettings & settings);
  /** Deprecated: the name of PixelRangeDn() in earlier versions. */
  template <typename TPixel>
  [[deprecated("use PixelRangeDn()")]] static std::pair<double, double>
  CodeRange(const SimulationSettings & settings)
  {
    return PixelRangeDn<TPixel>(settings);
  }

private:
  void
  RequireRow(std::size_t frame, std::size_t y) const;

  /** Draws the collected electrons of row `y` of frame `frame`, and normal numbers for its read noise. */
  void
  ExposeRow(std::size_t frame, std::size_t y, double * electrons, double * normals) const;

  /** Computes the output of the sensor for a row, between its clip levels and not rounded [DN]. */
  void
  ReadRow(std::size_t frame, std::size_t y, const double * electrons, const double * normals, double * valuesDn) const;

  /** Returns the output of the sensor for a frame, between its clip levels and not rounded [DN]. */
  DoubleFrame
  ReadFrame(std::size_t frame, const ParallelFor & parallelFor) const;

  /** Compands, rounds and clips one row. */
  template <typename TPixel>
  void
  WriteRow(double * valuesDn, TPixel * out) const;

  struct Sensor;

  std::size_t                   m_Width;
  std::size_t                   m_Height;
  SimulationTruth               m_Truth;
  double                        m_MeanBrightness; ///< mean of 1 + gamma over the frames
  std::shared_ptr<const Sensor> m_Sensor;         ///< common to all copies of a simulator
};

} // namespace sensornoise

#endif
