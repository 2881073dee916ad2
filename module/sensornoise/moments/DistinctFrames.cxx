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
