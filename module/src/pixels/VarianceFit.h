// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_VarianceFit_h
#define sensornoise_pixels_VarianceFit_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "sensornoise/Parallel.h"
#include "base/PixelRuns.h"
#include "base/ValueRange.h"
#include "base/WideVectors.h"
#include "pixels/ChiSquareTrim.h"
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

/** Which pixels a fit takes for outliers and trims. */
enum class TrimRule : std::uint8_t
{
  /** Those beyond the tails of chi-square at their own level: a line that strangers cannot draw, to judge pixels by. In
   * the dark it takes the noisier pixels of a sensor for strangers, in the light it cannot see them. */
  Level,
  /** Those that are farther from the line than one distance, at whatever level: what is kept is the same everywhere,
   * the pixels' own read noise included, and the line is that of the mean. */
  Distance
};

/** \class VarianceFit
 * \brief The regression of the variance on the mean, by re-weighted least squares.
 *
 * The weights 1 / (2 V^2 / freedom + S) take V at the neighbours' mean, which is independent of the pixel's own noise;
 * S is the variance of the pixels' own noise, found with TrimRule::Distance. Outliers on either side are trimmed, with
 * the exact correction of the mean where chi-square's tails are cut. Estimator.md, 3.6. */
class SensorNoise_EXPORT VarianceFit
{
public:
  /** Starts from \a start, or from the medians of bins of the intensity. The data must outlive the object. The line's
   * value at \a blackDn, if it is above 0 there, is the typical read noise, by which TrimRule::Distance tells defects.
   */
  VarianceFit(const VarianceData &                data,
              const ParallelFor &                 parallelFor,
              const std::optional<VarianceLine> & start,
              TrimRule                            rule = TrimRule::Level,
              double                              blackDn = 0.0);

  /** Starts from the line, the spread and the limits that a sample of the \a data gave. With TrimRule::Level its pixels
   * must have degrees of freedom as the data's. */
  VarianceFit(const VarianceData & data, const VarianceFit & ofSample);

  /** Fits the line, without its errors. Not determined with fewer than 10 pixels or one intensity. */
  void
  Iterate(int iterations);

  /** Fills in the covariance, by the sandwich, which stands whether or not the weights are right, and the curvature. */
  void
  FillErrors();

  /** How far above the line a pixel may be, TrimRule::Distance [DN^2]. */
  double
  GetReachDn2() const
  {
    return m_ReachDn2;
  }

  /** 1 at the pixels of the mask that the line trims: they have no weight in it. */
  std::vector<std::uint8_t>
  FindTrimmed() const;

  /** What sorts the pixels of a curve: the mean of the neighbours, which is free of the pixel's own pattern and noise,
   * or the pixel's own mean. */
  enum class SortedBy : std::uint8_t
  {
    Neighbours,
    OwnLevel
  };

  /** The excess of the variance over \a line, along the intensity, of the pixels that the fit keeps. */
  VarianceCurve
  CurveAbout(const VarianceLine & line, SortedBy sortedBy = SortedBy::Neighbours) const;

  /** What a pixel of the mask counts for. */
  struct Weighed
  {
    double weight; ///< [1/DN^4]; 0: trimmed
    double value;  ///< the variance, freed of the trimming's bias [DN^2]
  };

  /** SumOverBlocks() of the pixels of the mask: function(pixel, what it counts for, sums). */
  template <std::size_t VSums, typename TFunction>
  std::array<double, VSums>
  SumWeighed(TFunction function) const
  {
    return SumBlocks<VSums>(m_Data.pixels, m_ParallelFor, [&](std::size_t begin, std::size_t end, auto & sums) {
      this->ForWeighed(begin, end, function, sums);
    });
  }
  /** The same of sums whose number is known at run time. */
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
  /** What pixels that lie one after the other count for, of the mask or not: weighed together, in vectors. */
  struct Run
  {
    OfRun weight;
    OfRun value;
  };

  /** The same of those of the mask that are not trimmed, with their means above the pivot; at the others all is 0. */
  struct KeptRun
  {
    OfRun weight;
    OfRun x;
    OfRun value;
  };

  /** Weighs the pixels from \a first on. */
  void
  WeighRun(std::size_t first, std::size_t pixels, Run & run) const;
  void
  WeighByDistance(std::size_t first, std::size_t pixels, Run & run) const;
  void
  WeighByLevel(std::size_t first, std::size_t pixels, Run & run) const;
  void
  KeepRun(std::size_t first, std::size_t pixels, Run & run, KeptRun & kept) const;

  /** Adds up terms(a[i], b[i], c[i]) of a run, in vectors. */
  template <std::size_t VSums, typename TTerms>
  static void
  AddTerms(const OfRun & a, const OfRun & b, const OfRun & c, TTerms terms, std::array<double, VSums> & sums)
  {
    constexpr std::size_t lanes = 4; // each with sums of its own, which wait for none of the others
    WithWideVectors([&a, &b, &c, &sums, terms] {
      double own[VSums][lanes] = {};
      for (std::size_t i = 0; i < PixelsPerRun; i += lanes)
      {
        for (std::size_t lane = 0; lane < lanes; ++lane)
        {
          const std::array<double, VSums> more = terms(a[i + lane], b[i + lane], c[i + lane]);
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

  /** Calls function(first, pixels, what is kept of them) for the runs of [begin, end). */
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

  /** The sums of terms(weight, mean above the pivot, variance) over the pixels of the mask. For those that are trimmed
   * all three are 0, and so have to be the terms. */
  template <std::size_t VSums, typename TTerms>
  std::array<double, VSums>
  SumTerms(TTerms terms) const
  {
    return SumBlocks<VSums>(m_Data.pixels, m_ParallelFor, [&](std::size_t begin, std::size_t end, auto & sums) {
      this->ForKept(begin, end, [&](std::size_t, std::size_t, const KeptRun & kept) {
        AddTerms(kept.weight, kept.x, kept.value, terms, sums);
      });
    });
  }

  /** Adds the shares of the pixels [begin, end) of the mask. */
  template <typename TFunction, typename TSums>
  void
  ForWeighed(std::size_t begin, std::size_t end, TFunction & function, TSums & sums) const
  {
    TSums own = sums; // in registers, if they are few
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

  /** What pixels that lie one after the other add to the sums of SetNoiseSpread(). */
  struct SpreadTerms
  {
    OfRun weight; // 0: trimmed, or not of the mask
    OfRun more;
    OfRun chance;
  };
  void
  FindSpread(std::size_t first, std::size_t pixels, SpreadTerms & terms) const;

  ChiSquareTrim
  MakeTrim() const;

  /** The neighbours' means of a sample of the pixels [DN]. */
  std::vector<double>
  SampleLevels() const;
  /** Finds how far from the line pixels may be, TrimRule::Distance. */
  void
  SetReach();
  /** Finds the pixels' own noise, about the line as it is. */
  void
  SetNoiseSpread();

  VarianceData                 m_Data;
  ParallelFor                  m_ParallelFor;
  ValueRange                   m_Freedoms; // degrees of freedom of the mask's pixels
  VarianceLine                 m_Line;
  std::optional<ChiSquareTrim> m_Trim;
  TrimRule                     m_Rule;
  double                       m_BlackDn;
  double                       m_DarkestDn{ 0.0 }; // quantiles of the levels
  double                       m_BrightestDn{ 0.0 };
  double                       m_BrightFreedom{ 1.0 }; // highest degrees of freedom of the brightest pixels
  double                       m_ReachDn2{ 0.0 };
  double                       m_ReachBelowDn2{ 0.0 };
};

} // namespace sensornoise

#endif
