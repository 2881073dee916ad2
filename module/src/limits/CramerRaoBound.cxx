// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "limits/CramerRaoBound.h"

#include "base/Eigen.h"
#include "limits/CramerRaoInformation.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sensornoise
{
namespace
{
void
CheckCramerRaoInput(const CramerRaoInput & input)
{
  if (input.truth->settings.frames < 2)
  {
    throw std::invalid_argument("the stack has 1 frame; a variance in time needs at least 2");
  }
  if (input.truth->settings.rollingShutterPeriodRows > 0.0)
  {
    throw std::invalid_argument("the stack has a rolling shutter; the bound is for flicker that a frame has in common");
  }
  if (!(input.TotalReadVarianceDn2() > 0.0))
  {
    throw std::invalid_argument("read noise and rounding are both 0; a pixel without light needs some noise");
  }
}

/** Returns the information of all rows, summed in eight parts. */
CramerRaoInformation
SumInformation(const CramerRaoInput & input, double meanFluxDn, const ParallelFor & parallelFor)
{
  constexpr std::size_t             parts = 8;
  std::vector<CramerRaoInformation> information(parts, { input, meanFluxDn });
  parallelFor(parts, [&](std::size_t part) {
    for (std::size_t y = part * input.height / parts; y < (part + 1) * input.height / parts; ++y)
    {
      information[part].AddRow(y);
    }
  });
  std::for_each(information.begin() + 1, information.end(), [&](const auto & part) { information.front().Add(part); });
  return std::move(information.front());
}

/** Standard errors of functions of the parameters, to first order: sd^2 = gradient' covariance gradient. */
class ParameterErrors
{
public:
  ParameterErrors(const CramerRaoInformation & information, std::size_t frames)
    : m_Frames(static_cast<Eigen::Index>(frames))
    , m_Covariance(information.GetCovariance())
    , m_Units(information.GetUnits())
  {}

  Eigen::VectorXd
  Gradient(double gain, double centralVariance, double offset) const
  {
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(m_Covariance.rows());
    gradient(CramerRaoInformation::Gain) = gain;
    gradient(CramerRaoInformation::CentralVariance) = centralVariance;
    gradient(CramerRaoInformation::Offset) = offset;
    return gradient;
  }

  double
  Sd(const Eigen::VectorXd & gradient) const
  {
    return SdOfVariance(gradient.dot(m_Covariance * gradient), gradient.cwiseProduct(m_Units).squaredNorm());
  }

  /** Returns the root mean square over the frames of the standard error of a frame's number minus the mean over the
   * frames. \a series is 0 for gamma, 1 for alpha, 2 for beta. */
  double
  StandardErrorOfFrame(Eigen::Index series) const
  {
    const Eigen::Index first = CramerRaoInformation::FirstSeries + series * m_Frames;
    const auto         ofSeries = m_Covariance.block(first, first, m_Frames, m_Frames);
    const auto         count = static_cast<double>(m_Frames);
    return SdOfVariance(ofSeries.trace() / count - ofSeries.sum() / (count * count),
                        m_Units.segment(first, m_Frames).squaredNorm());
  }

  /** Returns the standard error of \a spread, the standard deviation of the \a values of a series. */
  double
  StandardErrorOfSd(Eigen::Index series, const std::vector<double> & values, double spread) const
  {
    const Eigen::Map<const Eigen::ArrayXd> v(values.data(), m_Frames);
    Eigen::VectorXd                        gradient = Eigen::VectorXd::Zero(m_Covariance.rows());
    gradient.segment(CramerRaoInformation::FirstSeries + series * m_Frames, m_Frames) =
      (v - v.mean()) / (static_cast<double>(m_Frames - 1) * spread);
    return this->Sd(gradient);
  }

  double
  CovarianceWithGain(const Eigen::VectorXd & gradient) const
  {
    return m_Covariance.row(CramerRaoInformation::Gain).dot(gradient);
  }

private:
  /** Returns the square root, or PrecisionLimit::None for the variance of a direction on which the stack has no
   * information. */
  static double
  SdOfVariance(double variance, double unitsSquared)
  {
    return variance < 1e15 * unitsSquared ? std::sqrt(variance) : PrecisionLimit::None;
  }

  Eigen::Index    m_Frames;
  Eigen::MatrixXd m_Covariance;
  Eigen::VectorXd m_Units;
};
} // namespace

PrecisionLimit
ComputeCramerRaoBound(const CramerRaoInput & input, const ParallelFor & parallelFor)
{
  CheckCramerRaoInput(input);
  const SimulationTruth &                truth = *input.truth;
  const CameraModel &                    camera = truth.settings.camera;
  const std::size_t                      pixels = input.width * input.height;
  const Eigen::Map<const Eigen::ArrayXd> electrons(input.electrons, static_cast<Eigen::Index>(pixels));
  const double                           meanFluxDn = input.MeanFluxPerElectronDn() * electrons.mean();

  const ParameterErrors errors(SumInformation(input, meanFluxDn, parallelFor), truth.settings.frames);
  // sigma^2 - g mu = c0 - g (mean level), sigma^2 = c0 - g (mean level - mu).
  const Eigen::VectorXd intercept = errors.Gradient(-(camera.offsetDn + meanFluxDn), 1.0, 0.0);
  const Eigen::VectorXd readVariance = errors.Gradient(-meanFluxDn, 1.0, camera.gainDnPerElectron);

  PrecisionLimit limit;
  limit.gain = errors.Sd(errors.Gradient(1.0, 0.0, 0.0));
  limit.intercept = errors.Sd(intercept);
  limit.gainInterceptCorrelation = errors.CovarianceWithGain(intercept) / (limit.gain * limit.intercept);
  limit.offset = errors.Sd(errors.Gradient(0.0, 0.0, 1.0));
  limit.readNoise =
    camera.readNoiseDn > 0.0 ? errors.Sd(readVariance) / (2.0 * camera.readNoiseDn) : PrecisionLimit::None;
  limit.flickerOfFrame = errors.StandardErrorOfFrame(0);
  limit.vibrationXOfFrame = errors.StandardErrorOfFrame(1);
  limit.vibrationYOfFrame = errors.StandardErrorOfFrame(2);
  limit.flickerSd = errors.StandardErrorOfSd(0, truth.normalisedFlicker, truth.realisedFlickerSd);
  limit.vibrationSdX = errors.StandardErrorOfSd(1, truth.series.alpha, truth.realisedVibrationSdXPixels);
  limit.vibrationSdY = errors.StandardErrorOfSd(2, truth.series.beta, truth.realisedVibrationSdYPixels);
  return limit;
}

} // namespace sensornoise
