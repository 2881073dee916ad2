// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_SensorFlaws_h
#define sensornoise_SensorFlaws_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameGeometry.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>

/** \file
 * Settings of the simulator for effects of real sensors that the noise model does not contain, and for the processing
 * of the digital numbers in cameras. Each structure sets one effect. */

namespace sensornoise
{

/** Mosaic of colour filters in front of the pixels. Each filter transmits a fraction of the electrons that its pixel
 * would collect without it. The filters belong to the sensor and do not move with the scene. */
struct ColourFilterSettings
{
  std::optional<BayerPattern> pattern; ///< null: no filters
  double transmissionR{ 0.6 };         ///< transmission of red at the illumination of the scene [1], 0 to 1
  double transmissionG{ 1.0 };         ///< transmission of both greens [1], 0 to 1
  double transmissionB{ 0.5 };         ///< transmission of blue [1], 0 to 1
};

/** Fixed-pattern noise of pixels and columns: gains of the amplifiers in the pixels and at the ends of the columns,
 * fill factors, offsets. It is added to SimulationSettings::prnuSd (efficiency of each pixel) and dsnuSdDn (offset of
 * each pixel). EMVA Standard 1288, release 4.0, reports pixel, row and column components likewise. */
struct PatternSettings
{
  /** Relative standard deviation of the gain [DN/e-] from pixel to pixel [1], 0 or more, below 0.2. It is about 0.01 in
   * sCMOS sensors. The gain of a pixel scales both signal and read noise. */
  double gainSd{ 0.0 };
  /** Relative standard deviation of the gain [DN/e-] from column to column [1], 0 or more, below 0.2. */
  double columnGainSd{ 0.0 };
  /** Relative standard deviation of the expected electrons from column to column [1], 0 or more, below 0.2. */
  double columnEfficiencySd{ 0.0 };
  /** Standard deviation of the offset from column to column [DN], 0 to 1e9. */
  double columnOffsetSdDn{ 0.0 };
};

/** Brighter-fatter effect: the charge in a pixel moves the border to a neighbour with less charge inwards, and later
 * charge flows to the neighbour. The flow over a border is the shift of the border, k (Q - Q'), times the charge that
 * arrives there, (Q + Q') / 2. This is the model of Guyonnet et al. 2015 (A&A 575, A41,
 * DOI 10.1051/0004-6361/201424897) for the nearest borders alone. Astier et al. 2019 (A&A 629, A36,
 * DOI 10.1051/0004-6361/201935508) derive its effect on variance and covariance. At a uniform level Q it acts as a
 * coupling of the fraction k Q: to first order the variance Q decreases by 8 k Q^2, and the covariance with each
 * neighbour increases by 2 k Q^2. */
struct BrighterFatterSettings
{
  /** k, shift of a border per electron of difference [1/e-], 0 or more; k times the electrons of the brightest pixel is
   * at most 0.1. Thick CCDs have about 4e-7. */
  double perElectron{ 0.0 };

  bool
  IsOn() const
  {
    return perElectron > 0.0;
  }
};

/** Interpixel capacitance: the voltage of a pixel contains a fraction of the charge of its neighbours. The coupling is
 * linear and deterministic. It acts after the charge is collected and before read noise is added, so that it couples
 * the shot noise, too (Moore, Ninkov and Forrest 2004, Proc. SPIE 5167, DOI 10.1117/12.507330). */
struct CouplingSettings
{
  /** Fraction c of its signal that a pixel gives to each of its four neighbours [1], 0 to 0.2. CMOS and hybrid sensors
   * have up to about 0.02. The shot noise of a uniform area keeps (1 - 4 c)^2 + 4 c^2 of its variance. */
  double fraction{ 0.0 };

  bool
  IsOn() const
  {
    return fraction > 0.0;
  }
};

/** Read noise that differs between pixels, as in sCMOS sensors: sigma_p = median exp(spread n), with n normal, so that
 * sigma_p is log-normal. A fraction of the pixels forms a tail, as their transistors trap charges (measured pixel by
 * pixel by Huang et al. 2013, Nature Methods 10, 653, DOI 10.1038/nmeth.2488). A median of 1.4 e- and an rms of 1.6 to
 * 2 e- are typical. CameraModel::readNoiseDn is the median of the pixels outside the tail. */
struct ReadNoiseSettings
{
  /** Standard deviation of ln sigma_p [1], 0 to 3. sCMOS sensors have about 0.2. */
  double spread{ 0.0 };
  /** Fraction of the pixels in the tail [1], 0 to 1. sCMOS sensors have about 0.03. */
  double tailFraction{ 0.0 };
  /** Scale of the tail [1], 0 to 3: there ln sigma_p is larger by |m| tailSpread, with m normal. */
  double tailSpread{ 1.0 };
};

/** Shapes of a non-linear response. u is the analogue signal, in units of the full scale. R(u) is the digital number in
 * these units, and R'(u) is the local gain in units of the gain of the camera. */
enum class ResponseShape
{
  Straight,  ///< R = u
  Quadratic, ///< R' = 1 + size (1 - 2 u): the deviation is size in the dark and -size at full scale
  Wave,      ///< R' = 1 + size cos(2 pi u): too high at both ends, too low in the middle
  Shoulder,  ///< R' = 1 + size up to 60 % of the scale, from there on a half cosine down to 1 - size
  Gamma,     ///< R = u^(1/size), a tone curve; 0 below 0
  SCurve     ///< R = (1 - size) u + size (3 u^2 - 2 u^3): film-like contrast
};

/** Returns the name of the shape: "straight", "quadratic", "wave", "shoulder", "gamma" or "s-curve". */
SensorNoise_EXPORT const char *
NameOf(ResponseShape shape);

/** Returns the shape with this name. Throws std::invalid_argument for any other name. */
SensorNoise_EXPORT ResponseShape
ResponseShapeOf(const std::string & name);

/** Response: the digital number as a function of the electrons. Deviations from a line of 2 to 4 % are common for CMOS
 * sensors (EMVA Standard 1288 measures them as the linearity error). */
struct ResponseSettings
{
  /** Shape of the response; Straight (default): linear. */
  ResponseShape shape{ ResponseShape::Straight };
  /** Strength of the non-linearity [1]. For Quadratic, Wave and Shoulder it is the relative deviation of the local
   * gain, above -1 and below 1. For Gamma it is the exponent, for example 2.2, from 0.1 to 10. For SCurve it is the
   * weight of the smooth step, from 0 to 1. Straight does not use it. */
  double size{ 0.0 };
  /** S, signal at u = 1 [e-], 0 to 1e9; 0: the electrons of the brightest pixel of the scene. */
  double fullScaleElectrons{ 0.0 };
};

/** Noise that is common to the pixels of a row or of a column, added to the digital numbers. It comes from the
 * converters and references at the ends of rows and columns, and does not depend on the signal. EMVA Standard 1288,
 * release 4.0, reports it separately from the noise of single pixels. */
struct LineNoiseSettings
{
  /** Standard deviation of one normal number for each row of each frame [DN], 0 to 1e9. */
  double rowNoiseSdDn{ 0.0 };
  /** Standard deviation of one normal number for each column of each frame [DN], 0 to 1e9. */
  double columnNoiseSdDn{ 0.0 };
  /** Amplitude of a sine along y with a random phase for each frame [DN], 0 to 1e9: interference of the power supply.
   * Its standard deviation over frames is amplitude / sqrt(2). */
  double bandingAmplitudeDn{ 0.0 };
  /** Period of the sine [row], above 0. */
  double bandingPeriodRows{ 64.0 };
};

/** Correction of defective pixels, frame by frame, as in cameras without a map of defects. A pixel is replaced by the
 * median of its eight neighbours if it deviates from it by more than thresholdSd times the standard deviation of these
 * neighbours (divisor 7; fewer neighbours at the edge). The correction is not linear: a low threshold removes the tails
 * of the noise. */
struct DefectCorrectionSettings
{
  /** Threshold in units of the standard deviation of the neighbours [1], above 0; 0: no correction. */
  double thresholdSd{ 0.0 };

  bool
  IsOn() const
  {
    return thresholdSd > 0.0;
  }
};

/** Temporal denoising in the camera by a recursive filter: out_t = (1 - a) in_t + a out_(t-1), out_0 = in_0. White
 * noise keeps (1 - a) / (1 + a) of its variance when a^(2 t) is negligible. The correlation of frames d apart is a^d.
 */
struct TemporalFilterSettings
{
  /** a, weight of the previous filtered frame [1], 0 to 0.99; 0: no filter. */
  double weight{ 0.0 };

  bool
  IsOn() const
  {
    return weight > 0.0;
  }
};

/** Median filter in the camera, frame by frame: a pixel is replaced by the median of the square window around it, with
 * edge pixels replicated. The filter is not linear: it preserves edges. */
struct MedianSettings
{
  /** Radius of the window, which is 2 radius + 1 pixels wide [pixel], 0 to 10; 1: 3 x 3; 0: no filter. */
  unsigned int radiusPixels{ 0 };

  bool
  IsOn() const
  {
    return radiusPixels > 0;
  }
};

/** Smoothing in the camera: a Gaussian filter of the digital numbers with the kernel of GaussianBlur(). White noise
 * keeps (sum of k^2)^2 of its variance, with k the kernel of one axis: 0.25 at 0.6 pixels. */
struct SmoothingSettings
{
  /** Standard deviation of the kernel [pixel], 0 to 100; 0: no filter. */
  double sdPixels{ 0.0 };

  bool
  IsOn() const
  {
    return sdPixels > 0.0;
  }
};

/** Interpolation of values between pixels in a camera. */
enum class Interpolation
{
  Nearest, ///< value of the nearest pixel
  Linear,  ///< linear interpolation of two pixels along each axis
  Cubic    ///< cubic interpolation of four pixels along each axis, CubicShift
};

/** Returns the name of the interpolation: "nearest", "linear" or "cubic". */
SensorNoise_EXPORT const char *
NameOf(Interpolation interpolation);

/** Returns the interpolation with this name. Throws std::invalid_argument for any other name. */
SensorNoise_EXPORT Interpolation
InterpolationOf(const std::string & name);

/** Binning in the camera, followed by interpolation to the full size. Each square tile of pixels is averaged; the tiles
 * at the right and at the bottom are cut by the edge. The full frame is interpolated between the centres of the tiles.
 * White noise keeps 1 / factor^2 of its variance with Nearest, and less with Linear. */
struct BinningSettings
{
  /** Side of a tile [pixel], 1 to 64; 1: no binning. */
  unsigned int factor{ 1 };
  /** Nearest (all pixels of a tile are equal) or Linear. */
  Interpolation interpolation{ Interpolation::Nearest };

  bool
  IsOn() const
  {
    return factor > 1;
  }
};

/** Resampling in the camera, as for digital stabilisation or lens correction: the frame is interpolated at
 * (x + shiftX, y + shiftY), with edge pixels replicated. With linear interpolation a shift by a fraction f of a pixel
 * leaves (1 - f)^2 + f^2 of the variance along its axis. Cubic interpolation leaves more: 0.641 instead of 0.5 at half
 * a pixel. */
struct ResamplingSettings
{
  /** Shift along x [pixel], -1000 to 1000. */
  double shiftXPixels{ 0.0 };
  /** Shift along y [pixel], -1000 to 1000. */
  double shiftYPixels{ 0.0 };
  /** Linear or Cubic. */
  Interpolation interpolation{ Interpolation::Linear };

  bool
  IsOn() const
  {
    return shiftXPixels != 0.0 || shiftYPixels != 0.0;
  }
};

/** Lossy compression of the luminance as in JPEG (Recommendation ITU-T T.81, 1992). Blocks of 8 x 8 pixels, from the
 * upper left corner on, undergo the orthonormal discrete cosine transform. The coefficients are rounded to multiples of
 * a step that increases with the frequency, and transformed back. The level shift and the colour of JPEG are left out;
 * the simulator rounds the pixels last. The compression is not linear: coefficients below half a step vanish. */
struct BlockSettings
{
  /** Quality on the scale of libjpeg, 1 to 100; the step at 100 is 1 DN of 8 bits; 0: no compression. The bit depth of
   * the simulation must not be 0. */
  unsigned int quality{ 0 };

  bool
  IsOn() const
  {
    return quality > 0;
  }
};

/** Square-root companding, as in automotive sensors and compressed raw formats. Digital numbers from 0 to the largest
 * number of the converter, top, are stored as round(sqrt(DN / top) (2^bits - 1)) and expanded again. The quantization
 * step after the expansion is proportional to the root of the level, as shot noise is: 2 sqrt(v top) / (2^bits - 1) at
 * level v. */
struct CompandingSettings
{
  /** Bits of the stored numbers [bit], 2 to 16; 0: no companding. The bit depth of the simulation must not be 0. */
  unsigned int bits{ 0 };

  bool
  IsOn() const
  {
    return bits > 0;
  }
};

/** Repetition of frames, as by a recorder that is faster than the camera. The last exposure of each period is written
 * several times. */
struct RepetitionSettings
{
  /** Number of times that the last exposure of a period is written, 1 or more; 1: no frame is repeated. */
  std::size_t count{ 1 };
  /** Number of exposures of a period, 1 or more; 1: each exposure is repeated. With a period of 3 and a count of 2 the
   * frames show the exposures 0 1 2 2 3 4 5 5. */
  std::size_t period{ 1 };

  /** Returns the exposure that frame \a frame of the stack shows. Both are counted from 0. */
  std::size_t
  ExposureOf(std::size_t frame) const
  {
    const std::size_t inPeriod = std::min(frame % FramesOfPeriod(), period - 1);
    return frame / FramesOfPeriod() * period + inPeriod;
  }

  /** Returns the first frame that shows exposure \a exposure. */
  std::size_t
  FirstFrameOf(std::size_t exposure) const
  {
    return exposure / period * FramesOfPeriod() + exposure % period;
  }

private:
  std::size_t
  FramesOfPeriod() const
  {
    return period - 1 + count;
  }
};

/** Effects of a real sensor beside the noise model, and processing in its camera, in physical order: photons, charge,
 * analogue signal, digital number, processing. All are off by default, and any may be combined. The processing works on
 * real numbers; rounding and clipping to digital numbers come last. */
struct SensorFlaws
{
  ColourFilterSettings     filters{};
  PatternSettings          pattern{};
  BrighterFatterSettings   brighterFatter{};
  CouplingSettings         coupling{};
  ReadNoiseSettings        readNoise{};
  ResponseSettings         response{};
  LineNoiseSettings        lineNoise{};
  DefectCorrectionSettings defectCorrection{};
  TemporalFilterSettings   temporalFilter{};
  MedianSettings           median{};
  SmoothingSettings        smoothing{};
  BinningSettings          binning{};
  ResamplingSettings       resampling{};
  BlockSettings            blocks{};
  CompandingSettings       companding{};
  RepetitionSettings       repetition{};
};

} // namespace sensornoise

#endif
