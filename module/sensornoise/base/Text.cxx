// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/base/Text.h"

#include <sstream>

namespace sensornoise
{

std::string
Text(double number)
{
  std::ostringstream text;
  text.precision(6);
  text << number;
  return text.str();
}

} // namespace sensornoise
