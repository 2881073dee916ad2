// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef RealSensorFormat_h
#define RealSensorFormat_h

#include "studies/RealSensorStatistics.h"

#include <string>

namespace sensornoise::tools
{

/** \a number as printf's \a format has it, or "-" if it is not finite. */
std::string
FormatNumber(double number, const char * format);

/** "19/20", or "-" for none. */
std::string
FormatShare(const Share & share);

/** The share in per cent, or "-" for none. */
std::string
FormatPercent(const Share & share);

} // namespace sensornoise::tools

#endif
