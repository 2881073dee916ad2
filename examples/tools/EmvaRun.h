// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef EmvaRun_h
#define EmvaRun_h

namespace sensornoise::tools
{

struct EstimateOptions;

/** Evaluates flat fields and dark frames by EMVA Standard 1288, and writes table, JSON and XML. The frames are a list
 * of exposures, or frames with --exposures. Returns whether a system gain was found. Throws std::exception for input
 * that cannot be used, and if an output cannot be written. */
bool
RunEmva1288(const EstimateOptions & options);

} // namespace sensornoise::tools

#endif
