// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/DistinctFrames.h"

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
  m_Repeated = m_Originals.size() - m_Count;
}

DistinctFrames
DistinctFrames::Without(const std::vector<std::size_t> & leftOut) const
{
  DistinctFrames others = *this;
  for (const std::size_t t : leftOut)
  {
    others.m_Places[m_Originals[t]] = None;
  }
  others.m_Count = 0;
  for (std::size_t t = 0; t < m_Originals.size(); ++t)
  {
    std::size_t & place = others.m_Places[t];
    place = m_Originals[t] != t ? others.m_Places[m_Originals[t]] : place != None ? others.m_Count++ : None;
  }
  return others;
}

} // namespace sensornoise
