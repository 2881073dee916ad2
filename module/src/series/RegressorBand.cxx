// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "series/RegressorBand.h"

#include "base/Simd.h"
#include "base/Stencils.h"
#include "series/Constants.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <type_traits>
#include <utility>

namespace sensornoise
{

namespace
{
constexpr std::size_t Columns = std::tuple_size_v<SingleColumns>;

/** Adds sums of single precision, sums[series][column], to the sums of a group. */
void
AddTo(GroupSums & sums, const float * ofBlock)
{
  for (std::size_t k = 0; k < FramesTogether; ++k)
  {
    for (std::size_t j = 0; j < Columns; ++j)
    {
      sums[k][j] += static_cast<double>(ofBlock[k * Columns + j]);
    }
  }
}

#if defined(SENSORNOISE_AVX2)
/** Does the same as MultiplyGroupAnywhere() with AVX2 vectors of eight: the products and sums are the same, in the same
 * order, and so are the bits. The target has no fused multiplication and addition, which would round differently. */
__attribute__((target("avx2"))) void
MultiplyGroupAvx2(const GroupFactors & of, GroupSums & sums)
{
  // The attributes stand behind the name: Clang drops the alignment where they stand behind the type.
  using Eight [[gnu::vector_size(32), gnu::aligned(4), gnu::may_alias]] = float;
  constexpr std::size_t parts = Columns / 8; // vectors of columns: their sums with four series stay in registers
  sums = {};
  for (std::size_t begin = of.begin; begin < of.end; begin += PixelsOfSingleSum)
  {
    const std::size_t end = std::min(of.end, begin + PixelsOfSingleSum);
    Eight             sum[FramesTogether][parts] = {};
    for (std::size_t i = begin; i < end; ++i)
    {
      const Eight * const columns = reinterpret_cast<const Eight *>(of.columns[i].data());
      const float * const values = of.series + of.order[i];
      for (std::size_t k = 0; k < FramesTogether; ++k)
      {
        for (std::size_t j = 0; j < parts; ++j)
        {
          sum[k][j] += columns[j] * values[k * of.pixels];
        }
      }
    }
    AddTo(sums, reinterpret_cast<const float *>(sum));
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

void
MultiplyGroupAnywhere(const GroupFactors & of, GroupSums & sums)
{
  sums = {};
  for (std::size_t begin = of.begin; begin < of.end; begin += PixelsOfSingleSum)
  {
    const std::size_t end = std::min(of.end, begin + PixelsOfSingleSum);
    float             sum[FramesTogether * Columns] = {};
    for (std::size_t i = begin; i < end; ++i)
    {
      const float * const columns = of.columns[i].data();
      const float * const values = of.series + of.order[i];
      for (std::size_t k = 0; k < FramesTogether; ++k)
      {
        for (std::size_t j = 0; j < Columns; ++j)
        {
          sum[k * Columns + j] += columns[j] * values[k * of.pixels];
        }
      }
    }
    AddTo(sums, sum);
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
/** Computes the derivatives of MotionStencils() at \a count pixels from \a mean on, times \a factor. Each fills a row
 * of \a rows; the rows are \a stride numbers apart. The derivatives are computed one after the other, so that each loop
 * is vectorized. */
template <std::size_t... VStencils>
void
FillDerivatives(const double * mean,
                std::size_t    width,
                std::size_t    count,
                double         factor,
                float *        rows,
                std::size_t    stride,
                std::index_sequence<VStencils...>)
{
  const auto fill = [&](auto stencil) {
    float * const row = rows + stencil * stride;
    for (std::size_t i = 0; i < count; ++i)
    {
      row[i] = static_cast<float>(factor * std::get<stencil>(ApplyStencils(mean, width, i)));
    }
  };
  (fill(std::integral_constant<std::size_t, VStencils>()), ...);
}

/** Returns the power of 2 near the standard deviation of the noise in the middle of the levels [DN]. */
double
UnitOf(const InitialNoiseModel & model)
{
  return std::exp2(std::floor(0.5 * std::log2(model.NoiseVariance(model.centreDn))));
}
} // namespace

RegressorBand::RegressorBand(const FrameRegressors & regressors, std::size_t cells)
  : m_Regressors(regressors)
  , m_Cells(cells)
  , m_UnitDn(UnitOf(regressors.GetModel()))
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
  m_Stride = m_Pixels + Gap;
  m_Rows.resize(NumberOfRows * m_Stride);
  m_Series.resize(Together * m_Stride);
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
  const double           inverse = 1.0 / m_UnitDn;
  std::fill_n(this->RowOf(0), m_Pixels, static_cast<float>(inverse));
  std::transform(mean, mean + m_Pixels, this->RowOf(1), [=](double level) {
    return static_cast<float>(inverse * (level - centreDn));
  });
  const std::size_t width = frame.geometry.width;
  const std::size_t border = StencilMargin * width;
  const std::size_t first = std::max(border, m_First);
  const std::size_t last = std::min(frame.mean.size() - std::min(frame.mean.size(), border), m_First + m_Pixels);
  if (first < last)
  {
    FillDerivatives(frame.mean.data() + first,
                    width,
                    last - first,
                    inverse,
                    this->RowOf(2) + (first - m_First),
                    m_Stride,
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
  const float * const      gx = this->RowOf(2 + StencilX);
  const float * const      gy = this->RowOf(2 + StencilY);
  float * const            ofPixel = this->RowOf(Weight);
  float * const            ofCell = this->RowOf(CellWeight);
  const double             inverse = 1.0 / (m_UnitDn * m_UnitDn);
  // Motion that the derivatives do not explain is noise in the local changes of the illumination.
  const auto motionX = static_cast<float>(InSeries.motionLeftInCells * model.vibrationXPixels2);
  const auto motionY = static_cast<float>(InSeries.motionLeftInCells * model.vibrationYPixels2);
  for (std::size_t i = 0; i < m_Pixels; ++i)
  {
    const auto noise = static_cast<float>(inverse * model.NoiseVariance(level[i]));
    ofPixel[i] = 1.0F / noise;
    ofCell[i] = 1.0F / (noise + motionX * gx[i] * gx[i] + motionY * gy[i] * gy[i]);
  }
  const auto weigh = [&, unit = m_UnitDn](const std::vector<float> & instrument, float * weighted) {
    const float * const own = instrument.data() + m_First;
    std::transform(
      own, own + m_Pixels, instruments.weight.data() + m_First, weighted, [unit](double value, double weight) {
        return static_cast<float>(unit * value * weight);
      });
  };
  weigh(instruments.x, this->RowOf(InstrumentX));
  weigh(instruments.y, this->RowOf(InstrumentY));
}

/** Stores the weighted columns of each pixel contiguously, group by group. */
void
RegressorBand::FillColumns()
{
  const std::size_t stride = m_Stride; // a copy: it cannot alias the columns
  for (std::size_t place = 0; place < m_Order.size(); ++place)
  {
    const float * const own = m_Rows.data() + m_Order[place];
    const float         weight = own[Weight * stride];
    const float         ofCell = own[CellWeight * stride];
    SingleColumns &     columns = m_Columns[place];
    for (std::size_t k = 0; k < FrameColumns; ++k)
    {
      columns[k] = weight * own[k * stride];
    }
    columns[FrameColumns] = own[InstrumentX * stride];
    columns[FrameColumns + 1] = own[InstrumentY * stride];
    columns[FrameColumns + FrameRegressors::Instruments] = ofCell * own[0];
    columns[FrameColumns + FrameRegressors::Instruments + 1] = ofCell * own[stride];
    columns[FrameRegressors::Columns] = 0.0F;
  }
}

const std::vector<RegressorBand::Sums> &
RegressorBand::MultiplyByValues(std::size_t first)
{
  for (std::size_t g = 0; g < m_Groups.size(); ++g)
  {
    for (std::size_t k = 0; k < Together; ++k)
    {
      CallWithAvx2([&, group = m_Groups[g], values = this->RowOf(first + k)] {
        FrameRegressors::WeightedColumns sum{};
        for (std::size_t i = group.begin; i < group.end; ++i)
        {
          const double value = values[m_Order[i]];
          for (std::size_t j = 0; j < Columns; ++j)
          {
            sum[j] += value * static_cast<double>(m_Columns[i][j]);
          }
        }
        m_Sums[g][k] = sum;
      });
    }
  }
  return m_Sums;
}

void
RegressorBand::MultiplyGroupBy(std::size_t group)
{
  const Group & pixels = m_Groups[group];
  MultiplyGroup({ m_Columns.data(), m_Order.data(), m_Series.data(), m_Stride, pixels.begin, pixels.end },
                m_Sums[group]);
}

} // namespace sensornoise
