// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "series/RegressorBand.h"

#include "base/Simd.h"
#include "base/Stencils.h"
#include "series/Constants.h"
#include "base/Eigen.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <type_traits>
#include <utility>

namespace sensornoise
{

namespace
{
#if defined(SENSORNOISE_AVX2)
/** Does the same as MultiplyGroupAnywhere() with AVX2 vectors of four: the products and sums are the same, in the same
 * order, and so are the bits. The target has no fused multiplication and addition, which would round differently. */
__attribute__((target("avx2"))) void
MultiplyGroupAvx2(const GroupFactors & of, GroupSums & sums)
{
  // The attributes stand behind the name: Clang drops the alignment where they stand behind the type.
  using Four [[gnu::vector_size(32), gnu::aligned(8), gnu::may_alias]] = double;
  constexpr std::size_t part = 2; // vectors of columns: with four series their sums take half of the registers
  for (std::size_t first = 0; first < sums[0].size(); first += 4 * part)
  {
    Four sum[FramesTogether][part] = {};
    for (std::size_t i = of.begin; i < of.end; ++i)
    {
      const Four * const   columns = reinterpret_cast<const Four *>(of.columns[i].data() + first);
      const double * const values = of.series + of.order[i];
      for (std::size_t k = 0; k < FramesTogether; ++k)
      {
        for (std::size_t j = 0; j < part; ++j)
        {
          sum[k][j] += columns[j] * values[k * of.pixels];
        }
      }
    }
    for (std::size_t k = 0; k < FramesTogether; ++k)
    {
      // Not std::copy_n(): the arguments of a template have no such alignment.
      Four * const places = reinterpret_cast<Four *>(sums[k].data() + first);
      for (std::size_t j = 0; j < part; ++j)
      {
        places[j] = sum[k][j];
      }
    }
  }
}
#endif

/** Returns the fastest function for this processor. */
auto
FindMultiplyGroup()
{
#if defined(SENSORNOISE_AVX2)
  return HasAvx2() ? MultiplyGroupAvx2 : MultiplyGroupAnywhere;
#else
  return MultiplyGroupAnywhere;
#endif
}
} // namespace

/** The sums are computed for a few columns at a time, so that they stay in registers. */
void
MultiplyGroupAnywhere(const GroupFactors & of, GroupSums & sums)
{
  constexpr std::size_t part = 4;
  using Columns = Eigen::Matrix<double, part, 1>;
  for (std::size_t first = 0; first < sums[0].size(); first += part)
  {
    Eigen::Matrix<double, part, FramesTogether> sum;
    sum.setZero();
    for (std::size_t i = of.begin; i < of.end; ++i)
    {
      const double * const                           v = of.series + of.order[i];
      const Eigen::Matrix<double, 1, FramesTogether> values(v[0], v[of.pixels], v[2 * of.pixels], v[3 * of.pixels]);
      sum.noalias() += Eigen::Map<const Columns>(of.columns[i].data() + first) * values;
    }
    for (std::size_t k = 0; k < FramesTogether; ++k)
    {
      Eigen::Map<Columns>(sums[k].data() + first) = sum.col(static_cast<Eigen::Index>(k));
    }
  }
}

void
MultiplyGroup(const GroupFactors & of, GroupSums & sums)
{
  static const auto multiply = FindMultiplyGroup();
  multiply(of, sums);
}

namespace
{
/** Computes the derivatives of MotionStencils() at \a count pixels from \a mean on. Each fills a row of \a rows; the
 * rows are \a stride numbers apart. The derivatives are computed one after the other, so that each loop is vectorized.
 */
template <std::size_t... VStencils>
void
FillDerivatives(const double * mean,
                std::size_t    width,
                std::size_t    count,
                double *       rows,
                std::size_t    stride,
                std::index_sequence<VStencils...>)
{
  const auto fill = [&](auto stencil) {
    double * const row = rows + stencil * stride;
    for (std::size_t i = 0; i < count; ++i)
    {
      row[i] = std::get<stencil>(ApplyStencils(mean, width, i));
    }
  };
  (fill(std::integral_constant<std::size_t, VStencils>()), ...);
}
} // namespace

RegressorBand::RegressorBand(const FrameRegressors & regressors, std::size_t cells)
  : m_Regressors(regressors)
  , m_Cells(cells)
{}

/** Calls function(pixel of the band, group) for the used pixels, row by row. */
template <typename TFunction>
void
RegressorBand::ForUsed(TFunction function) const
{
  const std::size_t width = m_Regressors.GetFrame().geometry.width;
  for (std::size_t row = 0; row < m_Pixels; row += width)
  {
    for (std::size_t cell = 0; cell < m_Cells; ++cell)
    {
      const std::size_t end = width * (cell + 1) / m_Cells;
      for (std::size_t x = width * cell / m_Cells; x < end; ++x)
      {
        const std::uint8_t gradientClass = m_Regressors.ClassOf(m_First + row + x);
        if (gradientClass != FrameRegressors::Unused)
        {
          function(row + x, cell * GradientClasses + gradientClass);
        }
      }
    }
  }
}

void
RegressorBand::MoveTo(std::size_t firstRow, std::size_t rows)
{
  const std::size_t width = m_Regressors.GetFrame().geometry.width;
  m_First = firstRow * width;
  m_Pixels = rows * width;
  m_Rows.resize(NumberOfRows * m_Pixels);
  m_Series.resize(Together * m_Pixels);
  this->FindOrder();
  CallWithAvx2([this] {
    this->FillValues();
    this->FillWeights();
    this->FillColumns();
  });
}

/** Orders the used pixels by group. */
void
RegressorBand::FindOrder()
{
  m_Places.assign(m_Cells * GradientClasses + 1, 0);
  this->ForUsed([this](std::size_t, std::size_t group) { ++m_Places[group + 1]; });
  std::partial_sum(m_Places.begin(), m_Places.end(), m_Places.begin());
  m_Groups.clear();
  for (std::size_t group = 0; group + 1 < m_Places.size(); ++group)
  {
    if (m_Places[group + 1] > m_Places[group])
    {
      m_Groups.push_back({ group / GradientClasses, group % GradientClasses, m_Places[group], m_Places[group + 1] });
    }
  }
  m_Order.resize(m_Places.back());
  m_Columns.resize(m_Places.back());
  m_Sums.resize(m_Groups.size());
  this->ForUsed(
    [this](std::size_t i, std::size_t group) { m_Order[m_Places[group]++] = static_cast<std::uint32_t>(i); });
}

/** Computes the values of the columns: 1, the mean minus the centre, and its derivatives, which have no meaning at the
 * border. */
void
RegressorBand::FillValues()
{
  const ReferenceFrame & frame = m_Regressors.GetFrame();
  const double * const   mean = frame.mean.data() + m_First;
  const double           centreDn = m_Regressors.GetModel().centreDn;
  std::fill_n(this->RowOf(0), m_Pixels, 1.0);
  std::transform(mean, mean + m_Pixels, this->RowOf(1), [centreDn](double level) { return level - centreDn; });
  const std::size_t width = frame.geometry.width;
  const std::size_t border = StencilMargin * width;
  const std::size_t first = std::max(border, m_First);
  const std::size_t last = std::min(frame.mean.size() - std::min(frame.mean.size(), border), m_First + m_Pixels);
  if (first < last)
  {
    FillDerivatives(frame.mean.data() + first,
                    width,
                    last - first,
                    this->RowOf(2) + (first - m_First),
                    m_Pixels,
                    std::make_index_sequence<NumberOfStencils>());
  }
}

/** Computes the inverse noise of pixels and of cells, and the weighted instruments. */
void
RegressorBand::FillWeights()
{
  const InitialNoiseModel  model = m_Regressors.GetModel(); // a copy: it cannot alias the numbers written below
  const ShiftInstruments & instruments = m_Regressors.GetInstruments();
  const float * const      level = m_Regressors.GetFrame().neighbourMean.data() + m_First;
  const double * const     gx = this->RowOf(2 + StencilX);
  const double * const     gy = this->RowOf(2 + StencilY);
  const float * const      weight = instruments.weight.data() + m_First;
  double * const           ofPixel = this->RowOf(Weight);
  double * const           ofCell = this->RowOf(CellWeight);
  // Motion that the derivatives do not explain is noise in the local changes of the illumination.
  const double motionLeft = InSeries.motionLeftInCells;
  for (std::size_t i = 0; i < m_Pixels; ++i)
  {
    const double noise = model.NoiseVariance(level[i]);
    ofPixel[i] = 1.0 / noise;
    ofCell[i] = 1.0 / (noise + motionLeft * model.MotionVariance(gx[i], gy[i]));
  }
  const auto weigh = [&](const std::vector<float> & instrument, double * weighted) {
    const float * const own = instrument.data() + m_First;
    std::transform(own, own + m_Pixels, weight, weighted, std::multiplies<double>());
  };
  weigh(instruments.x, this->RowOf(InstrumentX));
  weigh(instruments.y, this->RowOf(InstrumentY));
}

/** Stores the weighted columns of each pixel contiguously, group by group. */
void
RegressorBand::FillColumns()
{
  const std::size_t pixels = m_Pixels;
  for (std::size_t place = 0; place < m_Order.size(); ++place)
  {
    const double * const               own = m_Rows.data() + m_Order[place];
    const double                       weight = own[Weight * pixels];
    const double                       ofCell = own[CellWeight * pixels];
    FrameRegressors::WeightedColumns & columns = m_Columns[place];
    for (std::size_t k = 0; k < FrameColumns; ++k)
    {
      columns[k] = weight * own[k * pixels];
    }
    columns[FrameColumns] = own[InstrumentX * pixels];
    columns[FrameColumns + 1] = own[InstrumentY * pixels];
    columns[FrameColumns + FrameRegressors::Instruments] = ofCell;
    columns[FrameColumns + FrameRegressors::Instruments + 1] = ofCell * own[pixels];
    columns[FrameRegressors::Columns] = 0.0;
  }
}

void
RegressorBand::MultiplyGroupBy(std::size_t group, const double * series)
{
  const Group & pixels = m_Groups[group];
  MultiplyGroup({ m_Columns.data(), m_Order.data(), series, m_Pixels, pixels.begin, pixels.end }, m_Sums[group]);
}

} // namespace sensornoise
