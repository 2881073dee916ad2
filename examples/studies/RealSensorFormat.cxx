// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "studies/RealSensorFormat.h"

#include <cmath>
#include <cstdio>

namespace sensornoise::tools
{

std::string
FormatNumber(double number, const char * format)
{
  char text[64] = "-";
  if (std::isfinite(number))
  {
    std::snprintf(text, sizeof(text), format, number);
  }
  return text;
}

std::string
FormatShare(const Share & share)
{
  return share.count == 0 ? "-" : std::to_string(share.met) + '/' + std::to_string(share.count);
}

std::string
FormatPercent(const Share & share)
{
  return FormatNumber(100.0 * share.Get(), "%.1f");
}

} // namespace sensornoise::tools
