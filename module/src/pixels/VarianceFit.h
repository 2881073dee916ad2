// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_VarianceFit_h
#define sensornoise_pixels_VarianceFit_h

#include "SensorNoiseExport.h"
#include "base/Simd.h"
#include "base/Eigen.h"
#include "base/Quantiles.h"
#include "sensornoise/Parallel.h"
#include "pixels/Constants.h"
#include "pixels/VarianceCurve.h"
#include "pixels/VarianceLine.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace sensornoise
{

/** \class ChiSquareTrim
 * \brief Limits for two-sided trimming of sample variances, and the bias of the trimmed mean.
 *
 * Trimming chi-square variables of k degrees of freedom to the interval from a to b multiplies their mean by
 * (F_{k+2}(b) - F_{k+2}(a)) / (F_k(b) - F_k(a)). */
class SensorNoise_EXPORT ChiSquareTrim
{
public:
  /** Computes the limits for all whole degrees of freedom from \a lowest to \a highest, 1 or more. \a tail is the
   * probability of each trimmed tail [1]. */
  ChiSquareTrim(double lowest, double highest, double tail = InPixels.trimTail);

  struct Limits
  {
    double low;    ///< variances below it are trimmed, relative to the expected variance [1]
    double high;   ///< variances above it are trimmed, relative to the expected variance [1]
    double mean;   ///< mean of the variances that are kept, relative to the expected variance [1]
    double median; ///< median of all variances, relative to the expected variance [1]
  };
  /** Returns the limits for the degrees of freedom in the table that are nearest to \a dof. */
  const Limits &
  Of(double dof) const
  {
    const auto k = static_cast<std::size_t>(std::max(1.0, dof + 0.5));
    return m_Limits[std::min(m_Limits.size() - 1, k - std::min(k, m_First))];
  }

private:
  std::size_t         m_First;
  std::vector<Limits> m_Limits;
};

/** Rule by which a fit trims outliers. */
enum class TrimRule : std::uint8_t
{
  /** Trims pixels beyond the tails of chi-square at their own level. Outliers cannot change this line, and pixels are
   * tested against it. It rejects the noisier pixels of a sensor in the dark, but cannot detect them in bright
   * areas. The neighbours' means are the instrument of the slope, which fixed-pattern noise would flatten where most
   * pixels are dark. */
  Level,
  /** Trims pixels that are farther from the line than one distance, the same at all levels. The same part of the read
   * noise of single pixels is then kept at every level, and the line describes the mean variance. */
  Distance
};

/** \class VarianceFit
 * \brief Regression of the variance on the mean, by iteratively re-weighted least squares.
 *
 * The weights 1 / (2 V^2 / dof + S) use V at the neighbours' mean, which is independent of the pixel's own noise. S is
 * the dispersion of the noise variance from pixel to pixel, which is measured with TrimRule::Distance. Outliers on
 * either side are trimmed. With TrimRule::Level the bias of the mean by trimming is corrected exactly. Estimator.md,
 * 3.6. */
class SensorNoise_EXPORT VarianceFit
{
public:
  /** Starts from \a start, or from the medians of intensity bins if it is null. The data must outlive the object. The
   * line's value at \a blackDn [DN], if it is above 0, is the variance of the typical read noise, which
   * TrimRule::Distance compares defective pixels with. */
  VarianceFit(const VarianceData &                data,
              const ParallelFor &                 parallelFor,
              const std::optional<VarianceLine> & start,
              TrimRule                            rule = TrimRule::Level,
              double                              blackDn = 0.0);

  /** Starts from the line, the dispersion and the limits of a fit of a sample of the \a data. With TrimRule::Level the
   * sample must have the same degrees of freedom as the data. */
  VarianceFit(const VarianceData & data, const VarianceFit & ofSample);

  /** Fits the line, without its errors, in at most \a iterations iterations. The line is not determined with fewer than
   * 10 pixels or with one intensity. */
  void
  Iterate(int iterations);

  /** Computes the sandwich covariance, which is valid even if the weights are not optimal, and the curvature. */
  void
  FillErrors();

  /** Returns the largest excess over the line that is kept with TrimRule::Distance [DN^2]. */
  double
  GetReachDn2() const
  {
    return m_ReachDn2;
  }

  /** Returns a map that is 1 at the pixels of the mask that the fit trims: they have no weight in the line. */
  std::vector<std::uint8_t>
  FindTrimmed() const;

  /** Level by which the pixels of a curve are sorted. The neighbours' mean is independent of the pixel's own pattern
   * and noise. */
  enum class SortedBy : std::uint8_t
  {
    Neighbours,
    OwnLevel
  };

  /** Returns the excess of the variance over \a line as a function of the intensity, of the pixels that the fit
   * keeps. */
  VarianceCurve
  CurveAbout(const VarianceLine & line, SortedBy sortedBy = SortedBy::Neighbours) const;

  /** Weight and value of a pixel of the mask. */
  struct Weighed
  {
    double weight; ///< [1/DN^4]; 0: trimmed
    double value;  ///< the variance, corrected for the bias by trimming [DN^2]
  };

  /** Returns the sums over the pixels of the mask that function(pixel, weighed, sums) adds to. */
  template <std::size_t VSums, typename TFunction>
  std::array<double, VSums>
  SumWeighed(TFunction function) const
  {
    return SumBlocks<VSums>(m_Data.pixels, m_ParallelFor, [&](std::size_t begin, std::size_t end, auto & sums) {
      this->ForWeighed(begin, end, function, sums);
    });
  }
  /** Returns the same sums where their number is known only at run time. */
  template <typename TFunction>
  std::vector<double>
  SumWeighed(std::size_t size, TFunction function) const
  {
    return SumBlocks(m_Data.pixels, m_ParallelFor, size, [&](std::size_t begin, std::size_t end, double * sums) {
      this->ForWeighed(begin, end, function, sums);
    });
  }

  const VarianceLine &
  GetLine() const
  {
    return m_Line;
  }

private:
  /** Weights and values of a run of pixels, inside and outside the mask. */
  struct Run
  {
    RunValues weight;
    RunValues value;
  };

  /** Weights, means above the pivot, means of the neighbours above it, and values of a run of pixels; all 0 outside the
   * mask and at trimmed pixels. */
  struct KeptRun
  {
    RunValues weight;
    RunValues x;
    RunValues neighbours;
    RunValues value;
  };

  /** Sets the weights and values of \a pixels pixels from \a first on. */
  void
  WeighRun(std::size_t first, std::size_t pixels, Run & run) const;
  void
  WeighByDistance(std::size_t first, std::size_t pixels, Run & run) const;
  void
  WeighByLevel(std::size_t first, std::size_t pixels, Run & run) const;
  void
  KeepRun(std::size_t first, std::size_t pixels, Run & run, KeptRun & kept) const;

  /** Adds the sums of terms(runs[i]...) over a run, with SIMD instructions. */
  template <std::size_t VSums, typename TTerms, typename... TRuns>
  static void
  AddTerms(TTerms terms, std::array<double, VSums> & sums, const TRuns &... runs)
  {
    constexpr std::size_t lanes = 4; // independent sums, so that no addition waits for another
    CallWithAvx2([&sums, terms, &runs...] {
      double own[VSums][lanes] = {};
      for (std::size_t i = 0; i < PixelsPerRun; i += lanes)
      {
        for (std::size_t lane = 0; lane < lanes; ++lane)
        {
          const std::array<double, VSums> more = terms(runs[i + lane]...);
          for (std::size_t k = 0; k < VSums; ++k)
          {
            own[k][lane] += more[k];
          }
        }
      }
      for (std::size_t k = 0; k < VSums; ++k)
      {
        sums[k] += (own[k][0] + own[k][1]) + (own[k][2] + own[k][3]);
      }
    });
  }

  /** Calls function(first, pixels, kept) for the runs of the pixels [begin, end). */
  template <typename TFunction>
  void
  ForKept(std::size_t begin, std::size_t end, TFunction function) const
  {
    Run     run{};
    KeptRun kept{};
    ForRuns(begin, end, [&](std::size_t first, std::size_t pixels) {
      this->KeepRun(first, pixels, run, kept);
      function(first, pixels, kept);
    });
  }

  /** Adds the contributions of the pixels [begin, end) of the mask. */
  template <typename TFunction, typename TSums>
  void
  ForWeighed(std::size_t begin, std::size_t end, TFunction & function, TSums & sums) const
  {
    TSums own = sums; // in registers if they are few
    Run   run{};
    ForRuns(begin, end, [&](std::size_t first, std::size_t pixels) {
      this->WeighRun(first, pixels, run);
      for (std::size_t i = 0; i < pixels; ++i)
      {
        if (m_Data.mask[first + i] != 0)
        {
          function(first + i, Weighed{ run.weight[i], run.value[i] }, own);
        }
      }
    });
    sums = own;
  }

  /** Contributions of a run of pixels to the sums of SetNoiseDispersion(). */
  struct DispersionTerms
  {
    RunValues weight; // 0: trimmed, or outside the mask
    RunValues more;   // squared excess minus its sampling variance, times the weight
    RunValues chance; // sampling variance, times the weight
  };
  void
  EstimateNoiseDispersion(std::size_t first, std::size_t pixels, DispersionTerms & terms) const;

  ChiSquareTrim
  MakeTrim() const;

  /** Sums and solution of the normal equations of the line. */
  struct NormalTerms
  {
    double w{ 0.0 };           ///< sum of the weights
    double wx{ 0.0 };          ///< sum of the weights times the mean above the pivot
    double wxx{ 0.0 };         ///< sum of the weights times its square
    double determinant{ 0.0 }; ///< determinant of the normal equations
    double slope{ 0.0 };
    double atPivot{ 0.0 };          ///< value of the line at the pivot [DN^2]
    bool   isByNeighbours{ false }; ///< whether the neighbours' means are the instrument
  };
  NormalTerms
  SumNormalTerms() const;

  /** Computes the distances from the line at which pixels are trimmed with TrimRule::Distance. */
  void
  SetReach();
  /** Computes the dispersion of the noise variance from pixel to pixel about the present line. */
  void
  SetNoiseDispersion();

  VarianceData                 m_Data;
  ParallelFor                  m_ParallelFor;
  ValueRange                   m_Dofs; // number of the mask's pixels, and the range of their degrees of freedom
  VarianceLine                 m_Line;
  std::optional<ChiSquareTrim> m_Trim;
  TrimRule                     m_Rule;
  bool                         m_IsByNeighbours{ false }; // see NormalTerms
  double                       m_BlackDn;
  double                       m_DarkestDn{ 0.0 };     // quantile of the levels [DN]
  double                       m_BrightestDn{ 0.0 };   // quantile of the levels [DN]
  double                       m_BrightDof{ 1.0 };     // highest degrees of freedom of the brightest pixels
  double                       m_ReachDn2{ 0.0 };      // largest excess that is kept [DN^2]
  double                       m_ReachBelowDn2{ 0.0 }; // largest deficit that is kept [DN^2]
};

/** \class SampledVariance
 * \brief Copies of the maps of VarianceData at evenly spread pixels of the mask. A line that pixels are tested against,
 * and the start of a fit of all pixels, are fitted to them. The cost does not grow with the size of the frame. */
class SensorNoise_EXPORT SampledVariance
{
public:
  /** Copies all pixels of the mask. If it has twice \a most or more, copies evenly spread ones, between \a most and
   * twice as many. */
  SampledVariance(const VarianceData & data, std::size_t most, const ParallelFor & parallelFor);

  /** Returns the maps, all of whose pixels count. They are valid as long as the object. */
  VarianceData
  GetData() const;

private:
  std::vector<double>       m_Mean;
  std::vector<float>        m_NeighbourMean;
  std::vector<double>       m_Variance;
  std::vector<float>        m_Dof;
  std::vector<std::uint8_t> m_Mask;
};

} // namespace sensornoise

#endif
