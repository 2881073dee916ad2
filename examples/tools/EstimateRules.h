// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef EstimateRules_h
#define EstimateRules_h

#include "tools/EstimateOptions.h"

#include <string>

/** \file Rules of the options of estimate-sensor-noise that exclude or require each other. */

namespace CLI
{
class App;
}

namespace sensornoise::tools
{

/** Throws if there are no frames to be measured. With --compare it throws if an option for measurements is given, or
 * fewer than two reports; with --sweep if an option is given that a sweep has no use for. */
void
RequireWork(const CLI::App & app, const EstimateOptions & options);

/** Throws if an option is given that the method emva1288 does not have, or --xml with another method. */
void
RequireOptionsOfEmva(const CLI::App & app, const EstimateOptions & options);

/** Returns the options of a sweep that change numbers, as they were given. */
std::string
NumericOptions(const CLI::App & app);

} // namespace sensornoise::tools

#endif
