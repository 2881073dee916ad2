// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "series/SceneSeries.h"

#include "base/Constants.h"
#include "base/NothingToMeasure.h"
#include "base/Simd.h"
#include "base/Stencils.h"
#include "scene/InitialNoiseModel.h"
#include "series/Constants.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

namespace sensornoise
{

Eigen::MatrixXd
MotionColumns(const MotionSeries & motion, const std::vector<double> & gamma)
{
  const auto                                                   frames = static_cast<Eigen::Index>(gamma.size());
  constexpr std::array<std::pair<std::size_t, std::size_t>, 4> products{
    { { StencilX, StencilY }, { StencilX, StencilYY }, { StencilXX, StencilY }, { StencilXX, StencilYY } }
  };
  std::vector<Eigen::VectorXd> columns;
  for (Eigen::Index k = 0; k < motion.coefficients.cols(); ++k)
  {
    columns.emplace_back(motion.coefficients.col(k));
  }
  const auto has = [&motion](std::size_t stencil) {
    return std::find(motion.stencils.begin(), motion.stencils.end(), stencil) != motion.stencils.end();
  };
  for (const auto & [a, b] : products)
  {
    if (has(a) && has(b))
    {
      Eigen::VectorXd product(frames);
      for (Eigen::Index t = 0; t < frames; ++t)
      {
        const auto   i = static_cast<std::size_t>(t);
        const double illumination = 1.0 + gamma[i];
        const double both = motion.Get(i, a) * motion.Get(i, b); // only noise in a dark frame
        product(t) = illumination < InSeries.leastIlluminationOfShift ? 0.0 : both / illumination;
      }
      columns.push_back(product);
    }
  }
  Eigen::MatrixXd result(frames, static_cast<Eigen::Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k)
  {
    result.col(static_cast<Eigen::Index>(k)) = columns[k];
  }
  return result;
}

namespace
{
Eigen::Index
MostSeries(Eigen::Index frames)
{
  return static_cast<Eigen::Index>(InSeries.mostSeriesOfFrames * static_cast<double>(frames - 2));
}
} // namespace

TemporalBasis::TemporalBasis(const std::vector<double> & gamma,
                             const Eigen::MatrixXd &     local,
                             const Eigen::MatrixXd &     motion)
{
  const auto      frames = static_cast<Eigen::Index>(gamma.size());
  Eigen::MatrixXd illumination(frames, 1 + local.cols());
  illumination.col(0) = Eigen::Map<const Eigen::VectorXd>(gamma.data(), frames);
  illumination.rightCols(local.cols()) = local;
  Eigen::MatrixXd all(frames, illumination.cols() + motion.cols());
  all << illumination, motion;
  const Eigen::MatrixXd basis = Orthonormalise(all, std::max(illumination.cols(), MostSeries(frames)));
  m_IlluminationFactors = static_cast<std::size_t>(std::min(basis.cols(), Orthonormalise(illumination, frames).cols()));
  this->Round(basis);
}

void
TemporalBasis::Round(const Eigen::MatrixXd & basis)
{
  m_Rounded = (basis * m_Unit).array().round();
  m_Sums = m_Rounded.colwise().sum();
  m_Series = m_Rounded / m_Unit;
  const Eigen::MatrixXd             centred = m_Series.rowwise() - m_Series.colwise().mean();
  const Eigen::LLT<Eigen::MatrixXd> factor(centred.transpose() * centred);
  m_Inverse = factor.matrixL().solve(Eigen::MatrixXd::Identity(centred.cols(), centred.cols()));
  m_Basis = centred * m_Inverse.transpose();
  m_Means = m_Series.colwise().mean();
}

TemporalBasis
TemporalBasis::WithUnit(double unit) const
{
  TemporalBasis basis = *this;
  basis.m_Unit = unit;
  if (unit != m_Unit)
  {
    basis.Round(m_Basis);
  }
  return basis;
}

TemporalBasis
TemporalBasis::OfIllumination() const
{
  const auto    illumination = static_cast<Eigen::Index>(m_IlluminationFactors);
  TemporalBasis basis;
  basis.m_IlluminationFactors = m_IlluminationFactors;
  basis.m_Unit = m_Unit;
  basis.m_Rounded = m_Rounded.leftCols(illumination);
  basis.m_Series = m_Series.leftCols(illumination);
  basis.m_Basis = m_Basis.leftCols(illumination);
  basis.m_Inverse = m_Inverse.topLeftCorner(illumination, illumination);
  basis.m_Sums = m_Sums.leftCols(illumination);
  basis.m_Means = m_Means.leftCols(illumination);
  return basis;
}

void
TemporalBasis::ToCoordinates(double * sums, std::size_t stride, const double * means, std::size_t pixels) const
{
  const auto frames = static_cast<double>(m_Basis.rows());
  CallWithAvx2([&] {
    for (std::size_t j = 0; j < this->Size(); ++j)
    {
      const double taken = m_Means(static_cast<Eigen::Index>(j)) * frames;
      for (std::size_t i = 0; i < pixels; ++i)
      {
        sums[j * stride + i] = sums[j * stride + i] / m_Unit - taken * means[i];
      }
    }
    for (std::size_t j = this->Size(); j-- > 0;)
    {
      const auto row = static_cast<Eigen::Index>(j);
      for (std::size_t i = 0; i < pixels; ++i)
      {
        sums[j * stride + i] *= m_Inverse(row, row);
      }
      for (std::size_t k = 0; k < j; ++k)
      {
        const double factor = m_Inverse(row, static_cast<Eigen::Index>(k));
        for (std::size_t i = 0; i < pixels; ++i)
        {
          sums[j * stride + i] += factor * sums[k * stride + i];
        }
      }
    }
  });
}

namespace
{
/** Returns the level of the darkest frame, minus the centre [DN]: the highest offset that the frames allow. */
double
LevelOfDarkestFrame(OffsetLine line, double offset)
{
  line.UseOffset(offset);
  const double darkest = *std::min_element(line.gamma.begin(), line.gamma.end());
  return -offset * darkest;
}

/** Returns the line of \a sums, whose \a equations are of all classes, without the squares of the shifts, if these
 * explain the flicker of \a line; they are filed in \a found. Else returns \a line. */
OffsetLine
WithoutSquaresOfShifts(const FrameSums &      sums,
                       const RegressorNoise & noise,
                       const FrameEquations & equations,
                       const OffsetLine &     line,
                       SceneSeries &          found)
{
  found.squaresOfShifts = SquaresThatExplain(line.gamma, SolveMotion(equations, line.gamma, line.offset));
  return found.squaresOfShifts.cols() > 0 ? FitOffsetLine(sums, noise, {}, found.squaresOfShifts).value_or(line) : line;
}

/** Returns whether the flicker of \a found is significant by the covariance of the products that the raw variances
 * give, too. The initial model may be wrong, most where few pixels have signal; without flicker, the raw variances are
 * right. True if \a rawNoise is empty. */
bool
IsSignificantByRawNoise(const FrameSums &                           sums,
                        RegressorNoise                              noise,
                        const std::vector<FrameSums::ClassMatrix> & rawNoise,
                        const SceneSeries &                         found)
{
  if (rawNoise.empty())
  {
    return true;
  }
  noise.ofProducts = rawNoise;
  FrameEquations          equations = MakeFrameEquations(sums, noise, found.line.lastClass);
  const Eigen::MatrixXd & squares = found.squaresOfShifts;
  if (squares.cols() > 0)
  {
    equations.response -= squares * (squares.transpose() * equations.response);
  }
  const std::optional<OffsetLine> line = FitOffsetLine(equations);
  return line && line->flickerZ > Significance.everyPixel;
}
} // namespace

Eigen::MatrixXd
SquaresThatExplain(const std::vector<double> & gamma, const MotionSeries & motion)
{
  const auto      frames = static_cast<Eigen::Index>(gamma.size());
  Eigen::MatrixXd squares(frames, 3);
  for (Eigen::Index t = 0; t < frames; ++t)
  {
    const double x = motion.Get(static_cast<std::size_t>(t), StencilX);
    const double y = motion.Get(static_cast<std::size_t>(t), StencilY);
    squares.row(t) << x * x, x * y, y * y;
  }
  squares.rowwise() -= squares.colwise().mean();
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factors(squares);
  const Eigen::Index                          rank = factors.rank();
  const Eigen::MatrixXd                       basis = factors.householderQ() * Eigen::MatrixXd::Identity(frames, rank);
  const Eigen::Map<const Eigen::VectorXd>     series(gamma.data(), frames);
  const double                                all = (series.array() - series.mean()).square().sum();
  const double                                left = all - (basis.transpose() * series).squaredNorm();
  const auto                                  count = static_cast<double>(frames);
  const double                                evidence =
    count * std::log(all / std::max(left, 1e-12 * all)) - static_cast<double>(rank) * std::log(count);
  return all > 0.0 && rank + 2 < frames && evidence > InCommon.strongEvidence ? basis : Eigen::MatrixXd(frames, 0);
}

RegressorNoise
NoiseOfModel(const FrameRegressors & regressors)
{
  RegressorNoise noise;
  for (std::size_t c = 0; c < GradientClasses; ++c)
  {
    noise.variance[c] = regressors.PixelsOfClass(c);
  }
  return noise;
}

SceneSeries
FindSceneSeries(const FrameSums &                           sums,
                RollingShutter                              rollingShutter,
                const std::optional<double> &               knownOffsetDn,
                double                                      blackDn,
                bool                                        changesStrongly,
                const std::vector<FrameSums::ClassMatrix> & rawNoise)
{
  const RegressorNoise            noise = NoiseOfModel(sums.GetRegressors());
  const std::optional<OffsetLine> line = FitOffsetLine(sums, noise);
  if (!line)
  {
    double pixels = 0.0;
    for (std::size_t c = 0; c < GradientClasses; ++c)
    {
      pixels += sums.GetRegressors().PixelsOfClass(c);
    }
    throw NothingToMeasure(
      pixels > 0.0
        ? "the usable pixels all have one intensity, which determines neither gain nor offset. Include "
          "dark and bright areas in the scene"
        : "no pixel is left: all are masked, clipped, next to a clip level, in moving areas, or of a "
          "variance that the levels around them do not explain, as where the filters of a colour mosaic pass "
          "very different signals. Record a static scene between the clip levels, correct --mask, --roi or "
          "--clip, or give each colour channel by itself");
  }
  SceneSeries    found;
  FrameEquations equations = MakeFrameEquations(sums, noise, GradientClasses - 1);
  found.line = changesStrongly ? *line : WithoutSquaresOfShifts(sums, noise, equations, *line, found);
  const InitialNoiseModel & model = sums.GetRegressors().GetModel();
  if (!changesStrongly) // the deviations of a non-linear response from the line are larger then
  {
    found.frameOffsets =
      FindFrameOffsets(found.line,
                       { std::min(blackDn, model.darkestDn) - model.centreDn, model.darkestDn - model.centreDn, 2 },
                       InSeries.leastOffsetStep * std::sqrt(model.NoiseVariance(model.darkestDn)));
  }
  // Fixed-pattern noise of a flat field has contrast, too.
  const bool isPrecise =
    found.line.standardError < InCommon.largestRelativeError * std::max(0.0, -found.line.offset) || !changesStrongly;
  found.isOffsetIdentifiable =
    found.line.DeterminesOffset() && isPrecise && IsSignificantByRawNoise(sums, noise, rawNoise, found);
  const bool   hasLevels = found.line.contrast > InSeries.leastContrast;
  const double fallbackDn = hasLevels ? model.darkestDn : std::min(blackDn, model.darkestDn);
  found.offset = found.isOffsetIdentifiable ? found.line.offset : knownOffsetDn.value_or(fallbackDn) - model.centreDn;
  if (!found.isOffsetIdentifiable && !knownOffsetDn && changesStrongly)
  {
    found.offset = LevelOfDarkestFrame(found.line, found.offset);
  }
  if (!found.isOffsetIdentifiable)
  {
    found.line.UseOffset(found.offset);
  }
  const bool isFlat = changesStrongly && !hasLevels;
  if (isFlat)
  {
    equations.active.resize(2); // derivatives of one level are noise, and so would be their series
  }
  found.motion = SolveMotion(equations, found.line.gamma, found.offset);
  const Eigen::MatrixXd motionColumns = MotionColumns(found.motion, found.line.gamma);
  const std::size_t     most =
    rollingShutter == RollingShutter::Off || isFlat
          ? 0
          : std::min<std::size_t>(InSeries.mostLocalSeries, (sums.GetFrame().frames - 1) / InSeries.framesPerLocalSeries);
  found.local = FindLocalIllumination(sums, found.motion, motionColumns, found.line.gamma, found.offset, most);
  found.basis = TemporalBasis(found.line.gamma, found.local.series, motionColumns);
  return found;
}

} // namespace sensornoise
