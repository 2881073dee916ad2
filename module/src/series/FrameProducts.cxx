// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "series/FrameProducts.h"

#include "base/BinaryStream.h"

#include <cstdint>
#include <stdexcept>
#include <utility>

namespace sensornoise
{

namespace
{
constexpr const char * StreamName = "FrameSums";
}

FrameProducts::FrameProducts(std::size_t pixels, std::size_t frames, std::size_t cells)
  : m_Pixels(pixels)
  , m_Frames(frames)
  , m_Cells(cells)
  , m_ClassSums(frames * GradientClasses, ColumnVector::Zero())
  , m_InstrumentSums(frames, { 0.0, 0.0 })
  , m_CellSums(frames * cells, { 0.0, 0.0 })
{}

void
FrameProducts::Merge(const FrameProducts & other)
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

void
FrameProducts::Forget()
{
  *this = FrameProducts(m_Pixels, m_Frames, m_Cells);
}

void
FrameProducts::Save(std::ostream & out) const
{
  WriteSumsHeader(out, StreamName, m_Pixels, m_Frames);
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

void
FrameProducts::Restore(std::istream & in)
{
  FrameProducts       read(m_Pixels, m_Frames, m_Cells);
  const std::uint64_t frames = ReadSumsHeader(in, StreamName, m_Pixels);
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

std::string
FrameProducts::Sizes() const
{
  return std::to_string(m_Pixels) + " pixels, " + std::to_string(m_Frames) + " frames and " + std::to_string(m_Cells) +
         " cells";
}

} // namespace sensornoise
