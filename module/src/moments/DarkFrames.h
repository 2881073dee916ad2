// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_DarkFrames_h
#define sensornoise_moments_DarkFrames_h

#include "sensornoise/Parallel.h"
#include "SensorNoiseExport.h"
#include "sensornoise/Settings.h"
#include "moments/TemporalMoments.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

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

  /** Returns the variance over time of the common level of all pixels [DN^2]; 0 below two frames.
   * \param pixelVarianceDn2 variance of a typical pixel without the drift [DN^2]; its contribution to the variance of
   * the levels is subtracted */
  double
  GetVarianceDn2(double pixelVarianceDn2) const;

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
 * level, and the error by rounding to codes of a level with hardly any noise.
 *
 * Two frames or more also yield the temporal variance of every pixel. The mean variance is over all pixels that are
 * not defective. It includes noisy pixels, because their noise is in the bright frames as well. A pixel is defective
 * if its noise exceeds InMoments.defectiveNoiseFactor times the typical noise. It is also defective if it never
 * changed although a typical pixel does with a probability of at least 1 - 1e-6. The standard error of the mean is the
 * scatter of the pixels. The read noise of the median pixel, see MedianReadNoiseOf(), is returned with it.
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
                  const CodeSettings &              codes = {},
                  const std::vector<std::uint8_t> & mask = {},
                  const ParallelFor &               parallelFor = SerialFor,
                  const DarkDrift &                 drift = {});

} // namespace sensornoise

#endif
