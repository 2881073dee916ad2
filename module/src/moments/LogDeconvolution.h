// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_LogDeconvolution_h
#define sensornoise_moments_LogDeconvolution_h

#include "SensorNoiseExport.h"

#include <array>
#include <cstddef>
#include <vector>

/** \file
 * Estimates the distribution of the true variances of pixels from the distribution of the variances measured over a
 * few frames. */

namespace sensornoise
{

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

} // namespace sensornoise

#endif
