// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_LogDeconvolution_h
#define sensornoise_moments_LogDeconvolution_h

#include "SensorNoiseExport.h"

#include <array>
#include <cstddef>
#include <vector>

/** \file
 * The distribution of the true variances of pixels, from that of variances measured over a few frames. */

namespace sensornoise
{

inline constexpr std::size_t NumberOfLogBins = 121;

/** A number for each bin of the logarithm of a variance. */
using LogBins = std::array<double, NumberOfLogBins>;

/** Equal bins of the logarithm, of which the middle one lies about the median. The last one holds what is above it,
 * too. */
struct LogBinning
{
  double      low;   ///< lower end of the first bin: logarithm of a variance in DN^2
  double      width; ///< of a bin, in the same logarithm
  std::size_t first; ///< the lowest bin in use; holds what is below it, too

  std::size_t
  BinOf(double variance) const;

  /** Adds a variance, spread evenly from \a begin to \a end, once to each of two counts. */
  void
  Add(double begin, double end, LogBins & one, LogBins & other) const;
};

/** \param variances above 0 for half of the pixels [DN^2]
 * \param cellDn2 half the distance of two variances of rounded frames [DN^2] */
SensorNoise_EXPORT LogBinning
MakeLogBinning(std::vector<double> variances, double cellDn2);

/** What a bin of the true variances gives to each one of the measured ones, true by true. */
SensorNoise_EXPORT std::vector<LogBins>
ChiSquareKernel(double freedom, const LogBinning & binning);

/** \class LogDeconvolution
 * \brief Richardson's and Lucy's iterations, which begin with the measured distribution.
 *
 * J. Opt. Soc. Am. 62, 1972, p. 55, DOI 10.1364/JOSA.62.000055; Astron. J. 79, 1974, p. 745, DOI 10.1086/111605. */
class SensorNoise_EXPORT LogDeconvolution
{
public:
  /** \param counts of the measured variances, with a sum above 0
   * \param kernel is referred to, and must live as long */
  LogDeconvolution(const LogBins & counts, const std::vector<LogBins> & kernel);

  void
  Iterate(int times);

  /** The median of the true variances' distribution, in bins from the low end of the first one. */
  double
  GetMedianBin() const;

private:
  const std::vector<LogBins> & m_Kernel;
  LogBins                      m_Measured{};
  LogBins                      m_True{};
};

} // namespace sensornoise

#endif
