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
#ifndef sensornoise_simulation_DoubleFrame_h
#define sensornoise_simulation_DoubleFrame_h

#include <cstddef>
#include <vector>

namespace sensornoise
{

/** One frame, row after row, of charges [e-] or of codes before they are rounded [DN]. */
struct DoubleFrame
{
  std::size_t         width{ 0 };
  std::size_t         height{ 0 };
  std::vector<double> values;

  DoubleFrame() = default;
  DoubleFrame(std::size_t columns, std::size_t rows)
    : width(columns)
    , height(rows)
    , values(columns * rows)
  {}

  double *
  Row(std::size_t y)
  {
    return values.data() + y * width;
  }
  const double *
  Row(std::size_t y) const
  {
    return values.data() + y * width;
  }
};

} // namespace sensornoise

#endif
