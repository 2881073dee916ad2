// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_DoubleFrame_h
#define sensornoise_simulation_DoubleFrame_h

#include <cstddef>
#include <vector>

namespace sensornoise
{

/** One frame, row by row, of charges [e-] or of codes before they are rounded [DN]. */
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
