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
#ifndef sensornoise_series_FrameRegressors_h
#define sensornoise_series_FrameRegressors_h

#include "sensornoise/base/Parallel.h"
#include "sensornoise/base/Quantiles.h"
#include "sensornoise/base/Stencils.h"
#include "sensornoise/scene/ProvisionalModel.h"
#include "sensornoise/scene/ReferenceFrame.h"
#include "sensornoise/series/FrameProducts.h"
#include "sensornoise/series/ShiftInstruments.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace sensornoise
{

/** \class FrameRegressors
 * \brief What the frames are multiplied with in the second pass: the columns of every pixel, times their weights.
 *
 * Column 0 is 1 and column 1 the mean minus a centre; then follow the derivatives of the mean, with the inverse of the
 * provisional noise as weight; two instruments for the shifts; and 1 and the mean again, with weights for the sums of
 * cells. Each pixel has a class, from flat to rough surroundings. Memory: 25 bytes a pixel. */
class FrameRegressors
{
public:
  static constexpr std::size_t  Instruments = 2;
  static constexpr std::size_t  CellColumns = 2;
  static constexpr std::size_t  Columns = FrameColumns + Instruments + CellColumns;
  static constexpr std::uint8_t Unused = 255;

  using Values = std::array<double, FrameColumns>;
  using Row = std::array<double, 16>; // Columns, padded for the vector units
  static_assert(Columns <= 16, "a row holds all columns");

  /** \a take has a nonzero value at the pixels that serve; they must be usable. The frame must outlive the object. */
  FrameRegressors(const ReferenceFrame &            frame,
                  const ProvisionalModel &          model,
                  const std::vector<std::uint8_t> & take,
                  ShiftInstruments                  instruments,
                  const ParallelFor &               parallelFor = SerialFor)
    : m_Frame(&frame)
    , m_Model(model)
    , m_ClassOf(frame.mean.size(), Unused)
    , m_Instruments(std::move(instruments))
  {
    this->ClassifyPixels(take, parallelFor);
  }

  const ReferenceFrame &
  GetFrame() const
  {
    return *m_Frame;
  }
  const ProvisionalModel &
  GetModel() const
  {
    return m_Model;
  }
  /** The level that is subtracted from the mean in column 1, for conditioning [DN]. */
  double
  GetCentreDn() const
  {
    return m_Model.averageDn;
  }
  /** Gradient class of pixel \a p; Unused if it does not serve. */
  std::uint8_t
  ClassOf(std::size_t p) const
  {
    return m_ClassOf[p];
  }
  double
  InstrumentX(std::size_t p) const
  {
    return m_Instruments.x[p] * m_Instruments.weight[p];
  }
  double
  InstrumentY(std::size_t p) const
  {
    return m_Instruments.y[p] * m_Instruments.weight[p];
  }
  double
  InstrumentWeight(std::size_t p) const
  {
    return m_Instruments.weight[p];
  }

  /** 1, the mean minus the centre, and its derivatives at pixel \a p. */
  Values
  ValuesOf(std::size_t p) const
  {
    Values     values{ 1.0, m_Frame->mean[p] - this->GetCentreDn() };
    const auto derivatives = ApplyStencils(m_Frame->mean.data(), m_Frame->geometry.width, p);
    std::copy(derivatives.begin(), derivatives.end(), values.begin() + 2);
    return values;
  }

  /** All columns of pixel \a p, whose values are \a values, times their weights. */
  Row
  RowOf(std::size_t p, const Values & values) const
  {
    const double noise = m_Model.NoiseVariance(m_Frame->neighbourMean[p]);
    const double w = 1.0 / noise;
    Row          row{};
    std::transform(values.begin(), values.end(), row.begin(), [w](double value) { return w * value; });
    row[FrameColumns] = this->InstrumentX(p);
    row[FrameColumns + 1] = this->InstrumentY(p);
    // Motion that the derivatives do not explain is noise to the light's local changes.
    const double motion = m_Model.MotionVariance(values[2 + StencilX], values[2 + StencilY]);
    row[FrameColumns + Instruments] = 1.0 / (noise + 0.2 * motion);
    row[FrameColumns + Instruments + 1] = row[FrameColumns + Instruments] * values[1];
    return row;
  }

private:
  void
  ClassifyPixels(const std::vector<std::uint8_t> & take, const ParallelFor & parallelFor)
  {
    const std::size_t width = m_Frame->geometry.width;
    const double *    mean = m_Frame->mean.data();
    const auto        roughness = [&](std::size_t p) {
      const auto d = ApplyStencils(mean, width, p);
      return StencilEnergy(d) / m_Model.NoiseVariance(m_Frame->neighbourMean[p]);
    };
    std::vector<double> values;
    for (const std::size_t p : SamplePixels(take))
    {
      values.push_back(roughness(p));
    }
    std::array<double, GradientClasses - 1> edges{ 0.4, 0.6, 0.75, 0.87, 0.95 };
    for (double & edge : edges)
    {
      edge = values.empty() ? 0.0 : Quantile(values, edge);
    }
    ForBlocks(take.size(), parallelFor, [&](std::size_t begin, std::size_t end) {
      for (std::size_t p = begin; p < end; ++p)
      {
        if (take[p] != 0)
        {
          m_ClassOf[p] =
            static_cast<std::uint8_t>(std::lower_bound(edges.begin(), edges.end(), roughness(p)) - edges.begin());
        }
      }
    });
  }

  const ReferenceFrame *    m_Frame;
  ProvisionalModel          m_Model;
  std::vector<std::uint8_t> m_ClassOf;
  ShiftInstruments          m_Instruments;
};

} // namespace sensornoise

#endif
