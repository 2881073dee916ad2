// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Version.h"

namespace sensornoise
{
#ifndef SENSORNOISE_VERSION
#  error "SENSORNOISE_VERSION is not defined; expected the version in quotes, as CMakeLists.txt gives it"
#endif

const char *
GetModuleVersion()
{
  return SENSORNOISE_VERSION;
}

} // namespace sensornoise
