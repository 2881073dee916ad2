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
 * What real sensors do beside the noise model, and what cameras do to the digital numbers: the settings of the
 * simulator, each of one effect. */

namespace sensornoise
{

/** A mosaic of colour filters in front of the pixels: of the light that a pixel would have without it, the electrons
 * of the scene, so much is left. The filters are the sensor's and do not move with the scene. */
struct ColourFilterSettings
{
  std::optional<BayerPattern> pattern;              ///< null: no filters
  double                      transmissionR{ 0.6 }; ///< [1], 0 to 1, under the light of the scene
  double                      transmissionG{ 1.0 }; ///< of both greens
  double                      transmissionB{ 0.5 };
};

/** What differs from pixel to pixel or from column to column and is no light: gains of the amplifiers in the pixels and
 * at the ends of the columns, fill factors, offsets. Beside the simulator's prnuSd (efficiency of each pixel) and
 * dsnuSdDn (offset of each pixel). EMVA Standard 1288, release 4.0, reports pixel, row and column parts alike. */
struct PatternSettings
{
  /** Relative standard deviation of the gain [DN/e-] from pixel to pixel [1], 0 or more, below 0.2; about 0.01 in sCMOS
   * sensors. It scales signal and read noise alike. */
  double gainSd{ 0.0 };
  /** The same from column to column. */
  double columnGainSd{ 0.0 };
  /** Relative standard deviation of the expected electrons from column to column [1], 0 or more, below 0.2. */
  double columnEfficiencySd{ 0.0 };
  /** Standard deviation of the offset from column to column [DN], 0 or more. */
  double columnOffsetSdDn{ 0.0 };
};

/** Brighter-fatter effect: the charge that a pixel holds pushes the border to a neighbour with less charge inwards, and
 * what arrives next falls to the neighbour. The flow over a border is the shift of the border, k (Q - Q'), times the
 * charge that arrives there, (Q + Q') / 2: the model of Guyonnet et al. 2015 (A&A 575, A41,
 * DOI 10.1051/0004-6361/201424897) with the nearest borders alone; Astier et al. 2019 (A&A 629, A36,
 * DOI 10.1051/0004-6361/201935508) has what it does to variance and covariance. On an even level Q it acts as a
 * coupling of the fraction k Q: to first order the variance Q loses 8 k Q^2 and each neighbour gains a covariance of
 * 2 k Q^2, both growing with the square of the level. */
struct BrighterFatterSettings
{
  /** k, shift of a border for each electron of difference [1/e-], 0 or more; k times the electrons of the brightest
   * pixel at most 0.1. Thick CCDs: about 4e-7. */
  double perElectron{ 0.0 };

  bool
  IsOn() const
  {
    return perElectron > 0.0;
  }
};

/** Interpixel capacitance: the voltage of a pixel shows part of its neighbours' charge. Linear and deterministic, after
 * the charge has been collected and before read noise, so that it also couples the shot noise (Moore, Ninkov and
 * Forrest 2004, Proc. SPIE 5167, DOI 10.1117/12.507330). */
struct CouplingSettings
{
  /** Fraction c of its signal that a pixel gives to each of its four neighbours [1], 0 to 0.2. CMOS and hybrid sensors:
   * up to about 0.02. The shot noise of an even area keeps (1 - 4 c)^2 + 4 c^2 of its variance. */
  double fraction{ 0.0 };

  bool
  IsOn() const
  {
    return fraction > 0.0;
  }
};

/** Read noise from pixel to pixel, as in sCMOS sensors: sigma_p = median exp(spread n), n normal, so that the logarithm
 * is normal; and a tail of pixels whose transistors trap charges (Huang et al. 2013, Nature Methods 10, 653,
 * DOI 10.1038/nmeth.2488, measure it pixel by pixel). Typical are a median of 1.4 e- and an rms of 1.6 to 2 e-. The
 * camera's read noise is the median of the pixels outside the tail. */
struct ReadNoiseSettings
{
  /** Standard deviation of ln sigma_p [1], 0 to 3. sCMOS: about 0.2. */
  double spread{ 0.0 };
  /** Fraction of the pixels in the tail, 0 to 1. sCMOS: about 0.03. */
  double tailFraction{ 0.0 };
  /** In the tail ln sigma_p is greater by |m| tailSpread, m normal [1], 0 to 3. */
  double tailSpread{ 1.0 };
};

/** Kinds of bend. In each, u is the analogue signal in units of the full scale, R(u) that of the code, and R'(u) the
 * local gain in units of the camera's. */
enum class ResponseShape
{
  Straight,  ///< R = u
  Quadratic, ///< R' = 1 + size (1 - 2 u): size is the departure in the dark, -size at full scale
  Wave,      ///< R' = 1 + size cos(2 pi u): too high at both ends, too low in the middle
  Shoulder,  ///< R' = 1 + size up to 60 % of the scale, from there on a half cosine down to 1 - size
  Gamma,     ///< R = u^(1/size), a tone curve; 0 below 0
  SCurve     ///< R = (1 - size) u + size (3 u^2 - 2 u^3): film-like contrast
};

/** The shape's name as options spell it: "straight", "quadratic", "wave", "shoulder", "gamma", "s-curve". */
SensorNoise_EXPORT const char *
NameOf(ResponseShape shape);

/** \throws std::invalid_argument if no shape has this name. */
SensorNoise_EXPORT ResponseShape
ResponseShapeOf(const std::string & name);

/** The line from electrons to codes, and how it is bent. Departures of 2 to 4 % are common for CMOS sensors (the
 * linearity error of EMVA Standard 1288 says how far a sensor is off). */
struct ResponseSettings
{
  ResponseShape shape{ ResponseShape::Straight };
  /** Strength. Quadratic, Wave, Shoulder: relative departure of the local gain [1], above -1 and below 1. Gamma: the
   * exponent, such as 2.2 [1], from 0.1 to 10. SCurve: weight of the smooth step [1], from 0 to 1. Straight: without
   * meaning. */
  double size{ 0.0 };
  /** S, the signal at u = 1 [e-]; 0: the electrons of the scene's brightest pixel. */
  double fullScaleElectrons{ 0.0 };
};

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

/** Correction of defective pixels on the fly, frame by frame, as cameras without a map of defects do: a pixel that
 * departs from the median of its eight neighbours by more than so many standard deviations of these neighbours (divisor
 * 7; fewer neighbours at the edge) becomes that median. Not linear: with a low threshold it takes away the tails of the
 * noise. */
struct DefectCorrectionSettings
{
  /** Threshold in units of the neighbours' standard deviation [1], above 0; 0: no correction. */
  double thresholdSd{ 0.0 };

  bool
  IsOn() const
  {
    return thresholdSd > 0.0;
  }
};

/** Temporal denoising in the camera, a recursive filter: out_t = (1 - a) in_t + a out_(t-1), out_0 = in_0. White noise
 * keeps (1 - a) / (1 + a) of its variance once a^(2 t) has died away, and frames d apart correlate by a^d. */
struct TemporalFilterSettings
{
  /** a, the weight of the last frame [1], 0 to 0.99; 0: no filter. */
  double weight{ 0.0 };

  bool
  IsOn() const
  {
    return weight > 0.0;
  }
};

/** Median filter in the camera, frame by frame: a pixel becomes the median of the square around it, edge pixels
 * replicated. Not linear: edges stay, noise loses more than the mean of as many pixels would leave. */
struct MedianSettings
{
  /** The square is 2 radius + 1 pixels wide [pixel], 0 to 10; 1: 3 x 3; 0: none. */
  unsigned int radiusPixels{ 0 };

  bool
  IsOn() const
  {
    return radiusPixels > 0;
  }
};

/** Smoothing in the camera: a Gaussian filter of the codes, the kernel of GaussianBlur(). White noise keeps (sum of
 * k^2)^2 of its variance, k the kernel of one axis: 0.25 at 0.6 pixels. */
struct SmoothingSettings
{
  /** Standard deviation of the kernel [pixel], 0 to 100; 0: none. */
  double sdPixels{ 0.0 };

  bool
  IsOn() const
  {
    return sdPixels > 0.0;
  }
};

/** How a camera takes a value between pixels. */
enum class Interpolation
{
  Nearest, ///< that of the nearest pixel
  Linear,  ///< of two pixels along each axis
  Cubic    ///< of four pixels along each axis, CubicShift
};

/** The name as options spell it: "nearest", "linear", "cubic". */
SensorNoise_EXPORT const char *
NameOf(Interpolation interpolation);

/** \throws std::invalid_argument for another name. */
SensorNoise_EXPORT Interpolation
InterpolationOf(const std::string & name);

/** Binning in the camera, and frames of the full size made of it again: the mean of each square of pixels, the squares
 * at the right and at the bottom cut by the edge, then interpolated at the old pixels between the squares' centres.
 * White noise keeps 1 / factor^2 of its variance by "nearest"; by "linear" a pixel has less. */
struct BinningSettings
{
  /** Side of the square [pixel], 1 to 64; 1: none. */
  unsigned int factor{ 1 };
  /** Nearest (the square's pixels are equal) or Linear. */
  Interpolation interpolation{ Interpolation::Nearest };

  bool
  IsOn() const
  {
    return factor > 1;
  }
};

/** Resampling in the camera, as digital stabilisation or lens correction does: the frame at (x + shiftX, y + shiftY),
 * interpolated, edge pixels replicated. A fraction f of a pixel leaves (1 - f)^2 + f^2 of the variance along its axis
 * by linear interpolation, by cubic one more: 0.641 instead of 0.5 at half a pixel. */
struct ResamplingSettings
{
  /** [pixel], -1000 to 1000. */
  double shiftXPixels{ 0.0 };
  /** [pixel], -1000 to 1000. */
  double shiftYPixels{ 0.0 };
  /** Linear or Cubic. */
  Interpolation interpolation{ Interpolation::Linear };

  bool
  IsOn() const
  {
    return shiftXPixels != 0.0 || shiftYPixels != 0.0;
  }
};

/** Lossy compression as JPEG does it to the luminance (Recommendation ITU-T T.81, 1992): blocks of 8 x 8 pixels from
 * the upper left corner, their orthonormal discrete cosine transform, coefficients rounded to multiples of a step that
 * grows with the frequency, and back. What JPEG does beside it is left out: the level shift, the rounding of the pixels
 * (the simulator does that last), colour. Not linear: coefficients below half a step vanish. */
struct BlockSettings
{
  /** Quality as libjpeg counts it, 1 to 100; 100 has a step of 1 code of 8 bits; 0: no compression. */
  unsigned int quality{ 0 };

  bool
  IsOn() const
  {
    return quality > 0;
  }
};

/** Square-root companding, as automotive sensors and compressed raw formats do to save bits: codes from 0 to the
 * converter's top are stored as round(sqrt(code / top) (2^bits - 1)) and expanded again. The step of the expanded codes
 * grows with the root of the level, as shot noise does: near level v it is 2 sqrt(v top) / (2^bits - 1). */
struct CompandingSettings
{
  /** Bits of the stored codes, 2 to 16; 0: no companding. */
  unsigned int bits{ 0 };

  bool
  IsOn() const
  {
    return bits > 0;
  }
};

/** Frames that are written more than once, as when a recorder runs faster than the camera: each exposure, or each so
 * manieth of them. */
struct RepetitionSettings
{
  /** How often such an exposure is written, 1 or more; 1: no frame is repeated. */
  std::size_t count{ 1 };
  /** Such is the last of so many exposures, 1 or more; 1: each, 3: each third one, 0 1 2 2 3 4 5 5 of a count of 2. */
  std::size_t period{ 1 };

  /** The exposure that frame \a frame of the stack shows. */
  std::size_t
  ExposureOf(std::size_t frame) const
  {
    const std::size_t inPeriod = std::min(frame % FramesOfPeriod(), period - 1);
    return frame / FramesOfPeriod() * period + inPeriod;
  }

  /** The first frame that shows it. */
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

/** What a real sensor does beside the model, and what its camera does to the codes, in the order in which it happens:
 * light, charge, analogue signal, code, processing. Each piece has a file of its own; all are off by default, and any
 * may be combined. The pieces of the processing work on real numbers; rounding and clipping to codes come last. */
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
