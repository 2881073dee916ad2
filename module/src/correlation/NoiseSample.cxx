// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/NoiseSample.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace sensornoise
{

void
NoiseSample::DropFirst(std::size_t frames)
{
  std::vector<std::size_t> left(m_Tiles.frames - frames);
  std::iota(left.begin(), left.end(), frames);
  this->KeepFrames(left);
}

void
NoiseSample::KeepFrames(const std::vector<std::size_t> & frames)
{
  if (frames.size() == m_Tiles.frames)
  {
    return;
  }
  const std::size_t size = m_Tiles.Pixels();
  float *           to = m_Values.data();
  for (std::size_t i = 0; i < m_Tiles.origins.size(); ++i)
  {
    for (const std::size_t t : frames)
    {
      to = std::copy_n(m_Values.data() + m_Tiles.PlaceOf(i, t), size, to);
    }
  }
  m_Tiles.frames = frames.size();
  m_Values.conservativeResize(static_cast<Eigen::Index>(m_Tiles.Values()));
}

} // namespace sensornoise
