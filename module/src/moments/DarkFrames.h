// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_DarkFrames_h
#define sensornoise_moments_DarkFrames_h

#include "sensornoise/Parallel.h"
#include "SensorNoiseExport.h"
#include "sensornoise/Settings.h"
#include "base/ChiSquare.h"
#include "moments/Constants.h"
#include "moments/TemporalMoments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace sensornoise
{

/** Maps of every pixel from dark frames; the variance needs two or more frames. */
struct DarkMaps
{
  std::vector<double> offsetDn;            ///< mean over time [DN]; NaN: not finite, clipped or masked
  std::vector<double> varianceDn2;         ///< variance over time, without the common drift of the frames, with
                                           ///< quantization noise [DN^2]; NaN as above
  std::vector<std::uint8_t> usable;        ///< 0: not finite, clipped, masked or defective, see DefectiveVarianceDn2()
  std::size_t               frames{ 0 };   ///< number of frames; the degrees of freedom of a variance are one less
  double                    stepDn{ 0.0 }; ///< quantization step [DN]; 0: the data have no digital numbers
};

/** Returns the ratio of the median of the variances of pixels with the same noise to their expectation [1].
 * \param freedom degrees of freedom of a variance, above 0 */
inline double
MedianToMeanOfVariance(double dof)
{
  return ChiSquareQuantile(0.5, dof) / dof;
}

/** Returns the variance above which a pixel is defective [DN^2].
 *
 * The limit is the variance of InMoments.defectiveNoiseFactor times the typical noise, times 1 + 2 / \a freedom. By
 * chance, some pixels whose noise is near the limit stay below it, and some exceed it. The excluded pixels have the
 * larger variances. With this factor the gained and the lost variance are equal, exactly so where the density of the
 * true variances falls as their third power. For other tails they agree to some per cent of the variance near the
 * limit.
 * \param medianDn2 median of the variances of the pixels [DN^2]
 * \param freedom degrees of freedom of a variance, above 0 */
inline double
DefectiveVarianceDn2(double medianDn2, double dof)
{
  const double typicalDn2 = medianDn2 / MedianToMeanOfVariance(dof);
  return InMoments.defectiveNoiseFactor * InMoments.defectiveNoiseFactor * typicalDn2 * (1.0 + 2.0 / dof);
}

/** Returns the largest shift by rounding to digital numbers of the mean of values with the variance \a varianceDn2,
 * quantization noise included [DN]. It is step/pi exp(-2 pi^2 variance/step^2), the first harmonic, where the variance
 * is without quantization noise. The shift is negligible if the standard deviation is half a step or more. Without any
 * noise the shift is up to half a step, pi/2 times this value. */
inline double
RoundingErrorDn(double stepDn, double varianceDn2)
{
  if (stepDn == 0.0)
  {
    return 0.0;
  }
  constexpr double pi = 3.14159265358979323846;
  const double     hidden = std::max(0.0, varianceDn2 / (stepDn * stepDn) - 1.0 / 12.0);
  return stepDn / pi * std::exp(-2.0 * pi * pi * hidden);
}

/** A quantity of every pixel of the frame and the bounds of its 95 % interval; NaN: not known. */
struct IntervalMapDn
{
  std::vector<double> value; ///< values [DN]
  std::vector<double> low;   ///< lower bounds [DN]
  std::vector<double> high;  ///< upper bounds [DN]
};

/** Offset and read noise of each pixel: the camera calibration of single-molecule microscopy. */
struct PixelCalibration
{
  IntervalMapDn offset;
  IntervalMapDn readNoise; ///< without quantization noise
};

/** Computes the offset and the read noise of each pixel from dark frames.
 *
 * For a pixel with Gaussian noise each interval contains the true value with a probability of 95 %. Student's
 * distribution is used for the offset and the chi-square distribution for the read noise. (The mean plus and minus
 * 1.96 standard errors would cover 90 % of the offsets of 8 frames.) The error of the offset by rounding widens the
 * interval of a pixel with hardly any noise by up to half a step. Read noise that rounding may hide has an interval
 * from 0 to half a step or more. The common drift of the frames is in none of the intervals. Defective pixels have
 * values, too. Pixels that are not finite, clipped or masked have none.
 *
 * Throws std::invalid_argument if there are fewer than two frames, or not as many variances as offsets. */
SensorNoise_EXPORT PixelCalibration
MakePixelCalibration(const DarkMaps & dark, const ParallelFor & parallelFor = SerialFor);

/** \class DarkDrift
 * \brief Common level of the pixels of dark frames, frame by frame, and the variance that its drift adds to a pixel.
 *
 * A black level that drifts adds its variance to the variance of every pixel. To remove it, this class sums the
 * products of every pixel with the levels of the frames. The deviations of a pixel from these levels then have exactly
 * the distribution of noise alone. A subtracted variance could be negative.
 *
 * The level of a frame is the mean of its pixels within 6 standard deviations of their median, like the offset: a
 * pixel that blinks does not move it. Frames are added one by one in time order, so that the numbers of threads and of
 * frames per call do not change the result.
 *
 * Memory: 8 bytes per pixel. */
class SensorNoise_EXPORT DarkDrift
{
public:
  /** Constructs a drift that is not known; nothing is subtracted. */
  DarkDrift() = default;

  /** \param pixels number of pixels of a frame
   * \param mask nonzero at the pixels that define the level of a frame; empty: all pixels */
  explicit DarkDrift(std::size_t pixels, std::vector<std::uint8_t> mask = {});

  /** Adds the next \a count frames, stored one after the other. The pixel type is one of the five types of a stack. */
  template <typename TPixel>
  void
  AddFrames(const TPixel * frames, std::size_t count, const ParallelFor & parallelFor);

  /** Returns the sum of squared deviations of pixel \a p from its mean, without the drift [DN^2].
   * \param p number of the pixel
   * \param sumOfSquaresDn2 sum of squared deviations of the pixel with the drift [DN^2]
   * \param meanDn mean of the pixel over time [DN] */
  double
  SquaresWithoutDrift(std::size_t p, double sumOfSquaresDn2, double meanDn) const;

  /** Returns the difference of the highest and the lowest common level [DN]; 0 without frames. */
  double
  GetRangeDn() const;

  /** Returns the variance over time of the common level of all pixels [DN^2]; 0 below two frames.
   * \param pixelVarianceDn2 variance of a typical pixel without the drift [DN^2]; its contribution to the variance of
   * the levels is subtracted */
  double
  GetVarianceDn2(double pixelVarianceDn2) const;

  /** Returns the standard error that the drift adds to the mean level of the frames [DN]: the error of independent
   * levels, and half the difference of the halves of the burst beyond chance, as of a level that settles.
   * \param pixelVarianceDn2 as for GetVarianceDn2() */
  double
  GetMeanErrorDn(double pixelVarianceDn2) const;

private:
  template <typename TPixel>
  double
  MedianOf(const TPixel * frame) const;
  template <typename TPixel>
  double
  LevelOf(const TPixel * frame) const;
  template <typename TPixel>
  void
  Start(const TPixel * frame);
  double
  GetSumOfSquaresDn2() const;

  std::vector<std::uint8_t> m_Mask;                   // nonzero at the pixels that define the level
  std::vector<std::size_t>  m_Sample;                 // pixels from which the median is computed
  std::vector<double>       m_LevelsDn;               // levels of the frames
  std::vector<double>       m_ProductsDn2;            // sum over time of (u - first level) (level - first level)
  double                    m_SumDn{ 0.0 };           // sum of level - first level
  double                    m_SumOfSquaresDn2{ 0.0 }; // sum of its squares
  double                    m_ReachDn{ 0.0 };         // largest distance from the median
  double                    m_LevelPixels{ 0.0 };     // number of pixels that define the level of the first frame
};

/** A mean and its standard error, in the unit of the values. */
struct MeanOfPixels
{
  double value{ 0.0 };
  double standardError{ 0.0 };
};

/** Returns the mean of the values from \a low to \a high, both included. */
SensorNoise_EXPORT MeanOfPixels
MeanWithin(const std::vector<double> & values, double low, double high);

/** Measures the offset and the read noise from dark frames, at the exposure, gain and temperature of the others.
 *
 * The offset is the mean of the temporal means of the pixels within 6 standard deviations of their median. (Half the
 * distance between the quantiles 0.16 and 0.84 is taken as a standard deviation.) Hot and dead pixels are thus
 * excluded. The standard error of the offset contains temporal noise, fixed-pattern noise, the drift of the common
 * level, and the error by rounding to digital numbers of a level with hardly any noise.
 *
 * Two frames or more also yield the temporal variance of every pixel. The mean variance is over all pixels that are
 * not defective. It includes noisy pixels, because their noise is in the bright frames as well. A pixel is defective
 * if its noise exceeds InMoments.defectiveNoiseFactor times the typical noise. It is also defective if it never
 * changed although a typical pixel does with a probability of at least 1 - 1e-6. Pixels with one value beyond chance,
 * as by a cosmic ray, are left out of offset and variance, and are counted as defective. The standard error of the mean
 * is the scatter of the pixels. The read noise of the median pixel, see MedianReadNoiseOf(), is returned with it.
 *
 * The moments are consumed: their memory holds the maps.
 * \param drift drift of the same frames, which is removed from all variances; without it a level that drifts adds to
 * them
 * \param mask if not empty, nonzero at the pixels to be used
 *
 * Throws std::invalid_argument if fewer than 30 pixels are left, or if the frames are clipped. */
template <typename TPixel>
SensorNoise_EXPORT KnownOffset
MeasureDarkFrames(TemporalMoments<TPixel>           moments,
                  const DnSettings &                dnSettings = {},
                  const std::vector<std::uint8_t> & mask = {},
                  const ParallelFor &               parallelFor = SerialFor,
                  const DarkDrift &                 drift = {});

// Estimates the distribution of the true variances of pixels from the distribution of the variances measured over a
// few frames.

inline constexpr std::size_t NumberOfLogBins = 121;

/** A number for each bin of the logarithm of a variance. */
using LogBins = std::array<double, NumberOfLogBins>;

/** Equal bins of the logarithm. The middle bin lies about the median; the last bin also holds all larger values. */
struct LogBinning
{
  double      low;   ///< lower end of the first bin: logarithm of a variance in DN^2
  double      width; ///< width of a bin, in the same logarithm
  std::size_t first; ///< lowest bin in use; also holds all smaller values

  /** Returns the bin of a variance [DN^2]. */
  std::size_t
  BinOf(double variance) const;

  /** Adds a variance, uniformly distributed from \a begin to \a end, once to each of two histograms. */
  void
  Add(double begin, double end, LogBins & one, LogBins & other) const;
};

/** Returns the bins for \a variances.
 * \param variances above 0 for half of the pixels [DN^2]
 * \param cellDn2 half the distance of two variances of rounded frames [DN^2] */
SensorNoise_EXPORT LogBinning
MakeLogBinning(std::vector<double> variances, double cellDn2);

/** Returns the probability of each bin of the measured variances, for each bin of the true variances. The first index
 * is the true one. */
SensorNoise_EXPORT std::vector<LogBins>
ChiSquareKernel(double dof, const LogBinning & binning);

/** \class LogDeconvolution
 * \brief Iterations of Richardson and Lucy, which begin with the measured distribution.
 *
 * J. Opt. Soc. Am. 62, 1972, p. 55, DOI 10.1364/JOSA.62.000055; Astron. J. 79, 1974, p. 745, DOI 10.1086/111605. */
class SensorNoise_EXPORT LogDeconvolution
{
public:
  /** \param counts histogram of the measured variances, with a sum above 0
   * \param kernel see ChiSquareKernel(); it is kept by reference and must outlive this object */
  LogDeconvolution(const LogBins & counts, const std::vector<LogBins> & kernel);

  /** Performs \a times iterations. */
  void
  Iterate(int times);

  /** Returns the median of the distribution of the true variances, in bins from the lower end of the first bin. */
  double
  GetMedianBin() const;

private:
  const std::vector<LogBins> & m_Kernel;
  LogBins                      m_Measured{};
  LogBins                      m_True{};
};

/** Returns the median read noise of the pixels, estimated from their variances over a few frames.
 *
 * The median of the variances equals the median for noise alone only if all pixels have the same noise. The chi-square
 * distribution is skewed: its median lies below its mean. The fraction is another one if the true variances have a
 * wide distribution (by 2 % for 8 frames and log-normal noise of standard deviation 0.6). The distribution of the
 * logarithm of the true variances is therefore estimated first, for any shape, see LogDeconvolution, and its median is
 * taken.
 *
 * The standard error combines a jackknife over 20 groups of pixels, twice the change by further iterations, and the
 * error by rounding to digital numbers. It was tested with equal pixels and with log-normal noise of standard deviation
 * 0.3 to 0.6, also with tails. For 8 frames the error is below 0.4 % if the noise is one quantization step or more,
 * and 2.5 % for noise of 0.6 digital numbers.
 *
 * \param variancesDn2 variances of the pixels, quantization noise included [DN^2]
 * \param freedom degrees of freedom of a variance
 * \param stepDn quantization step [DN], whose noise step^2/12 is subtracted; 0: none
 * \return null: fewer than 5 degrees of freedom or 100 pixels, or a median so small that rounding hides it (below half
 * a step) */
SensorNoise_EXPORT std::optional<MedianReadNoise>
MedianReadNoiseOf(const std::vector<double> & variancesDn2, double dof, double stepDn);

} // namespace sensornoise

#endif
