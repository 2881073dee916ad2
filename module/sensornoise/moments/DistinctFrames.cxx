// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/moments/DistinctFrames.h"

#include <utility>

namespace sensornoise
{

DistinctFrames::DistinctFrames(std::vector<std::size_t> originals)
  : m_Originals(std::move(originals))
  , m_Places(m_Originals.size())
{
  for (std::size_t t = 0; t < m_Originals.size(); ++t)
  {
    m_Places[t] = m_Originals[t] == t ? m_Count++ : m_Places[m_Originals[t]];
  }
}

} // namespace sensornoise
