// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "limits/CramerRaoBound.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sensornoise
{

double
CramerRaoInput::TotalReadVarianceDn2() const
{
  const double readNoiseDn = truth->settings.camera.readNoiseDn;
  return readNoiseDn * readNoiseDn + quantisationStepDn * quantisationStepDn / 12.0;
}

double
CramerRaoInput::MeanFluxPerElectronDn() const
{
  double sum = 0.0;
  for (const double gamma : truth->series.gamma)
  {
    sum += 1.0 + gamma;
  }
  return truth->settings.camera.gainDnPerElectron * sum / static_cast<double>(truth->series.gamma.size());
}

namespace
{
// Columns of the parameters of a frame. The parameters that are common to all frames come before.
constexpr Eigen::Index OfFlicker = CramerRaoInformation::FirstSeries;
constexpr Eigen::Index OfShiftX = CramerRaoInformation::FirstSeries + 1;
constexpr Eigen::Index OfShiftY = CramerRaoInformation::FirstSeries + 2;
} // namespace

CramerRaoInformation::CramerRaoInformation(const CramerRaoInput & input, double meanFluxDn)
  : m_Input(input)
  , m_FluxPerElectronDn(input.MeanFluxPerElectronDn())
  , m_MeanFluxDn(meanFluxDn)
  , m_Frames(static_cast<Eigen::Index>(input.truth->settings.frames))
  , m_Schur(Eigen::MatrixXd::Zero(FirstSeries + 3 * m_Frames, FirstSeries + 3 * m_Frames))
  , m_Direct(Eigen::VectorXd::Zero(FirstSeries + 3 * m_Frames))
{}

Eigen::ArrayXd
CramerRaoInformation::GetUse(std::size_t y) const
{
  const auto     columns = static_cast<Eigen::Index>(m_Input.width);
  Eigen::ArrayXd isUsed = Eigen::ArrayXd::Ones(columns);
  for (Eigen::Index x = 0; x < columns && m_Input.mask != nullptr; ++x)
  {
    isUsed(x) = m_Input.mask[y * m_Input.width + static_cast<std::size_t>(x)] != 0 ? 1.0 : 0.0;
  }
  return isUsed;
}

CramerRaoInformation::Derivatives
CramerRaoInformation::GetDerivatives(std::size_t y, std::size_t frame) const
{
  const SimulationTruth & truth = *m_Input.truth;
  const double            g = truth.settings.camera.gainDnPerElectron;
  const auto              columns = static_cast<Eigen::Index>(m_Input.width);
  const double            f = 1.0 + truth.normalisedFlicker[frame];
  constexpr double        h = 1e-3; // [pixel]
  const auto              q = [&](double dx, double dy) {
    return this->ShiftedFlux(y, truth.series.alpha[frame] + dx, truth.series.beta[frame] + dy);
  };
  // The mean is mu + L and the variance is V = g (L - mean L) + c0, where L = (1 + gamma) q(alpha, beta).
  Derivatives derivatives{ SixColumns::Zero(columns, 6), {} };
  auto & [ofMean, ofVariance] = derivatives;
  ofMean.col(Offset) = 1.0;
  ofMean.col(OfFlicker) = q(0.0, 0.0);
  ofMean.col(OfShiftX) = f / (2.0 * h) * (q(h, 0.0) - q(-h, 0.0));
  ofMean.col(OfShiftY) = f / (2.0 * h) * (q(0.0, h) - q(0.0, -h));
  ofVariance = g * ofMean;
  ofVariance.col(Gain) = f * ofMean.col(OfFlicker) - m_MeanFluxDn;
  ofVariance.col(CentralVariance) = 1.0;
  return derivatives;
}

void
CramerRaoInformation::AddRow(std::size_t y)
{
  const SimulationTruth & truth = *m_Input.truth;
  const double            g = truth.settings.camera.gainDnPerElectron;
  const auto              columns = static_cast<Eigen::Index>(m_Input.width);
  const Eigen::ArrayXd    isUsed = this->GetUse(y);
  Eigen::MatrixXd         cross = Eigen::MatrixXd::Zero(columns, m_Schur.rows()); // c_x, one row per pixel
  Eigen::ArrayXd          ofFlux = Eigen::ArrayXd::Zero(columns);                 // I_xx
  for (Eigen::Index t = 0; t < m_Frames; ++t)
  {
    const auto   frame = static_cast<std::size_t>(t);
    const double f = 1.0 + truth.normalisedFlicker[frame];
    const auto [ofMean, ofVariance] = this->GetDerivatives(y, frame);

    // Information of a datum on a and b: m_a m_b / V + V_a V_b / (2 V^2).
    const Eigen::ArrayXd meanWeight = isUsed / (g * f * ofMean.col(OfFlicker) + m_Input.TotalReadVarianceDn2());
    const Eigen::ArrayXd varianceWeight = 0.5 * meanWeight.square();
    const SixColumns     mean = ofMean.colwise() * meanWeight;
    const SixColumns     variance = ofVariance.colwise() * varianceWeight;
    const Eigen::Matrix<double, 6, 6> information =
      ofMean.matrix().transpose() * mean.matrix() + ofVariance.matrix().transpose() * variance.matrix();
    const std::array<Eigen::Index, 6> parameters{
      Gain, CentralVariance, Offset, FirstSeries + t, FirstSeries + m_Frames + t, FirstSeries + 2 * m_Frames + t
    };
    for (std::size_t i = 0; i < 6; ++i)
    {
      const auto k = static_cast<Eigen::Index>(i);
      cross.col(parameters[i]).array() += f * (mean.col(k) + g * variance.col(k));
      m_Direct(parameters[i]) += information(k, k);
      for (std::size_t j = 0; j <= i; ++j)
      {
        m_Schur(parameters[i], parameters[j]) += information(k, static_cast<Eigen::Index>(j));
      }
    }
    ofFlux += f * f * (meanWeight + g * g * varianceWeight);
  }
  for (Eigen::Index x = 0; x < columns; ++x)
  {
    cross.row(x) *= ofFlux(x) > 0.0 ? 1.0 / std::sqrt(ofFlux(x)) : 0.0;
  }
  m_Schur.selfadjointView<Eigen::Lower>().rankUpdate(cross.transpose(), -1.0);
}

void
CramerRaoInformation::Add(const CramerRaoInformation & other)
{
  m_Schur += other.m_Schur;
  m_Direct += other.m_Direct;
}

Eigen::VectorXd
CramerRaoInformation::GetUnits() const
{
  return (m_Direct.array() > 0.0).select(m_Direct.array().sqrt().inverse(), 1.0);
}

Eigen::MatrixXd
CramerRaoInformation::GetCovariance() const
{
  Eigen::MatrixXd information = m_Schur.selfadjointView<Eigen::Lower>();
  for (Eigen::Index first = FirstSeries; first < information.rows(); first += m_Frames)
  {
    const Eigen::RowVectorXd meanRow = information.middleRows(first, m_Frames).colwise().mean();
    information.middleRows(first, m_Frames).rowwise() -= meanRow;
    const Eigen::VectorXd meanColumn = information.middleCols(first, m_Frames).rowwise().mean();
    information.middleCols(first, m_Frames).colwise() -= meanColumn;
    // Any information on the sum will do, because the functions of interest do not depend on the sum.
    information.block(first, first, m_Frames, m_Frames).array() +=
      m_Direct.segment(first, m_Frames).mean() / static_cast<double>(m_Frames);
  }
  constexpr double                                     rounding = 1e-11;
  const Eigen::VectorXd                                units = this->GetUnits();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(units.asDiagonal() * information * units.asDiagonal());
  const Eigen::ArrayXd                                 eigenvalues = solver.eigenvalues().array();
  const Eigen::VectorXd roots = (eigenvalues > rounding).select(eigenvalues.sqrt().inverse(), 1e10);
  const Eigen::MatrixXd factor = units.asDiagonal() * solver.eigenvectors() * roots.asDiagonal();
  return factor * factor.transpose();
}

Eigen::ArrayXd
CramerRaoInformation::ShiftedFlux(std::size_t y, double alpha, double beta) const
{
  const auto clamped = [](double position, std::size_t size) {
    return static_cast<std::size_t>(std::clamp(position, 0.0, static_cast<double>(size) - 1.0));
  };
  const double   row = static_cast<double>(y) + std::floor(beta);
  const double   down = beta - std::floor(beta);
  const double   right = alpha - std::floor(alpha);
  const double * above = m_Input.electrons + clamped(row, m_Input.height) * m_Input.width;
  const double * below = m_Input.electrons + clamped(row + 1.0, m_Input.height) * m_Input.width;
  Eigen::ArrayXd flux(static_cast<Eigen::Index>(m_Input.width));
  for (std::size_t x = 0; x < m_Input.width; ++x)
  {
    const double      column = static_cast<double>(x) + std::floor(alpha);
    const std::size_t a = clamped(column, m_Input.width);
    const std::size_t b = clamped(column + 1.0, m_Input.width);
    const double      first = above[a] + down * (below[a] - above[a]);
    const double      second = above[b] + down * (below[b] - above[b]);
    flux(static_cast<Eigen::Index>(x)) = m_FluxPerElectronDn * (first + right * (second - first));
  }
  return flux;
}

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
    throw std::invalid_argument("read noise and rounding are both 0; a pixel without signal needs some noise");
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
