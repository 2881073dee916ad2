// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Settings.h"

#include <stdexcept>
#include <string>

namespace sensornoise
{

RollingShutter
RollingShutterOf(const std::string & name)
{
  if (name != "off" && name != "auto" && name != "fixed")
  {
    throw std::invalid_argument("the rolling shutter is \"" + name + "\"; expected off, auto or fixed");
  }
  return name == "off" ? RollingShutter::Off : name == "auto" ? RollingShutter::Auto : RollingShutter::Fixed;
}

const char *
NameOf(RollingShutter mode)
{
  return mode == RollingShutter::Off ? "off" : mode == RollingShutter::Auto ? "auto" : "fixed";
}

} // namespace sensornoise
