/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#ifndef sensornoise_pixels_VarianceFit_h
#define sensornoise_pixels_VarianceFit_h

#include "SensorNoiseExport.h"
#include "sensornoise/base/Eigen.h"
#include "sensornoise/base/Parallel.h"
#include "sensornoise/pixels/ChiSquareTrim.h"
#include "sensornoise/pixels/VarianceLine.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace sensornoise
{

/** \class VarianceFit
 * \brief The regression of the variance on the mean, by re-weighted least squares.
 *
 * The weights freedom / (2 V^2) take V at the neighbours' mean, which is independent of the pixel's own noise; outliers
 * on either side are trimmed with the exact correction of the mean. Estimator.md, 3.6. */
class SensorNoise_EXPORT VarianceFit
{
public:
  /** Starts from \a start, or from the medians of bins of the intensity. The data must outlive the object. */
  VarianceFit(const VarianceData & data, const ParallelFor & parallelFor, const std::optional<VarianceLine> & start);

  /** Fits the line, without its errors. Not determined with fewer than 10 pixels or one intensity. */
  void
  Iterate(int iterations);

  /** Fills in the covariance, by the sandwich, which stands whether or not the weights are right, and the curvature. */
  void
  FillErrors();

  /** How much gain and intercept would move if 2 % of the pixels were trimmed on either side, as a covariance: 0 unless
   * that is more than chance. Pixels with a noise of their own, such as telegraph noise, too weak to be told one by
   * one, raise the variance; fewer of them are left by the closer trim (Hausman 1978). With the shift d and the test's
   * statistic S of two degrees of freedom, d d' (1 - 2 / S). */
  Eigen::Matrix2d
  TailDisagreement() const;

  /** 1 at the pixels of the mask that the line trims: they have no weight in it. */
  std::vector<std::uint8_t>
  FindTrimmed() const;

  const VarianceLine &
  GetLine() const
  {
    return m_Line;
  }

private:
  /** The degrees of freedom of the mask's pixels. */
  struct FreedomRange
  {
    double      lowest{ std::numeric_limits<double>::infinity() };
    double      highest{ 0.0 };
    std::size_t pixels{ 0 };
  };
  struct Weighed
  {
    double weight; // 0: trimmed
    double value;  // the variance, freed of the trimming's bias
  };

  static FreedomRange
  RangeOfFreedom(const VarianceData & data, const ParallelFor & parallelFor);
  ChiSquareTrim
  MakeTrim(double tail) const;
  Weighed
  Weigh(std::size_t p, const ChiSquareTrim & trim) const;

  VarianceData                 m_Data;
  ParallelFor                  m_ParallelFor;
  FreedomRange                 m_Freedoms;
  VarianceLine                 m_Line;
  std::optional<ChiSquareTrim> m_Trim;
};

/** The line that fits the data, with its errors. */
SensorNoise_EXPORT VarianceLine
FitVarianceLine(const VarianceData &                data,
                const ParallelFor &                 parallelFor,
                const std::optional<VarianceLine> & start = std::nullopt,
                int                                 iterations = 8);

} // namespace sensornoise

#endif
