// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "limits/CramerRaoInformation.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sensornoise
{
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

} // namespace sensornoise
