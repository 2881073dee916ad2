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
#ifndef sensornoise_series_FrameProducts_h
#define sensornoise_series_FrameProducts_h

#include "sensornoise/base/BinaryStream.h"
#include "sensornoise/base/Eigen.h"
#include "sensornoise/base/Stencils.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <ostream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sensornoise
{

/** The frames are regressed on these columns: 1, the mean, and its derivatives (MotionStencils). */
inline constexpr std::size_t FrameColumns = 2 + NumberOfStencils;

/** How rough the surroundings of a pixel are, in classes from flat to rough; the regressions admit classes in turn. */
inline constexpr std::size_t GradientClasses = 6;

/** \class FrameProducts
 * \brief The numbers of FrameSums that are made of frames: its inner products, frame by frame.
 *
 * Those of a frame that was not added are 0. So sums of other frames are merged by addition, which keeps every bit: 0
 * is added to each number (which is never -0, for it was added to 0 itself). */
class FrameProducts
{
public:
  using ColumnVector = Eigen::Matrix<double, FrameColumns, 1>;

  FrameProducts(std::size_t pixels, std::size_t frames, std::size_t cells)
    : m_Pixels(pixels)
    , m_Frames(frames)
    , m_Cells(cells)
    , m_ClassSums(frames * GradientClasses, ColumnVector::Zero())
    , m_InstrumentSums(frames, { 0.0, 0.0 })
    , m_CellSums(frames * cells, { 0.0, 0.0 })
  {}

  ColumnVector &
  OfClass(std::size_t t, std::size_t gradientClass)
  {
    return m_ClassSums[t * GradientClasses + gradientClass];
  }
  const ColumnVector &
  OfClass(std::size_t t, std::size_t gradientClass) const
  {
    return m_ClassSums[t * GradientClasses + gradientClass];
  }
  std::array<double, 2> &
  OfInstruments(std::size_t t)
  {
    return m_InstrumentSums[t];
  }
  const std::array<double, 2> &
  OfInstruments(std::size_t t) const
  {
    return m_InstrumentSums[t];
  }
  std::array<double, 2> &
  OfCell(std::size_t t, std::size_t c)
  {
    return m_CellSums[t * m_Cells + c];
  }
  const std::array<double, 2> &
  OfCell(std::size_t t, std::size_t c) const
  {
    return m_CellSums[t * m_Cells + c];
  }

  /** Adds the products of other frames of the same stack. */
  void
  Merge(const FrameProducts & other)
  {
    if (other.m_Pixels != m_Pixels || other.m_Frames != m_Frames || other.m_Cells != m_Cells)
    {
      throw std::invalid_argument("sums of " + other.Sizes() + " cannot be merged into those of " + this->Sizes());
    }
    for (std::size_t i = 0; i < m_ClassSums.size(); ++i)
    {
      m_ClassSums[i] += other.m_ClassSums[i];
    }
    for (std::size_t t = 0; t < m_InstrumentSums.size(); ++t)
    {
      m_InstrumentSums[t][0] += other.m_InstrumentSums[t][0];
      m_InstrumentSums[t][1] += other.m_InstrumentSums[t][1];
    }
    for (std::size_t i = 0; i < m_CellSums.size(); ++i)
    {
      m_CellSums[i][0] += other.m_CellSums[i][0];
      m_CellSums[i][1] += other.m_CellSums[i][1];
    }
  }

  /** Writes the products, see BinaryStream. */
  void
  Save(std::ostream & out) const
  {
    WriteSumsHeader(out, Name, m_Pixels, m_Frames);
    WriteCount(out, m_Cells);
    for (const ColumnVector & sums : m_ClassSums)
    {
      WriteNumbers(out, sums.data(), FrameColumns);
    }
    for (const auto * sums : { &m_InstrumentSums, &m_CellSums })
    {
      for (const std::array<double, 2> & pair : *sums)
      {
        WriteNumbers(out, pair.data(), pair.size());
      }
    }
  }
  /** Replaces the products by those of a stream. Throws std::runtime_error, and changes nothing, if it holds other sums
   * or ends early. */
  void
  Restore(std::istream & in)
  {
    FrameProducts       read(m_Pixels, m_Frames, m_Cells);
    const std::uint64_t frames = ReadSumsHeader(in, Name, m_Pixels);
    RequireCount("frames", frames, m_Frames);
    RequireCount("cells", ReadCount(in), m_Cells);
    for (ColumnVector & sums : read.m_ClassSums)
    {
      ReadNumbers(in, sums.data(), FrameColumns);
    }
    for (auto * sums : { &read.m_InstrumentSums, &read.m_CellSums })
    {
      for (std::array<double, 2> & pair : *sums)
      {
        ReadNumbers(in, pair.data(), pair.size());
      }
    }
    *this = std::move(read);
  }

private:
  static constexpr const char * Name = "FrameSums";

  std::string
  Sizes() const
  {
    return std::to_string(m_Pixels) + " pixels, " + std::to_string(m_Frames) + " frames and " +
           std::to_string(m_Cells) + " cells";
  }

  std::size_t                        m_Pixels;
  std::size_t                        m_Frames;
  std::size_t                        m_Cells;
  std::vector<ColumnVector>          m_ClassSums;
  std::vector<std::array<double, 2>> m_InstrumentSums;
  std::vector<std::array<double, 2>> m_CellSums;
};

} // namespace sensornoise

#endif
