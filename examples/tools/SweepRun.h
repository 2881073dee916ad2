// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef SweepRun_h
#define SweepRun_h

namespace sensornoise::tools
{
struct EstimateOptions;

/** Result of a sweep: all, some or none of its settings were measured. */
enum class SweepOutcome
{
  All,
  Some,
  None
};

/** Measures a camera at all settings of --sweep, with the other options for each of them. Prints the table, and writes
 * the passport (--json) after each setting and the page (--plot) at the end.
 *
 * A setting that an existing passport holds is not measured again if its version of this program, its options, its
 * setting and the hash of its files are the same; with a mask, or without OpenSSL, all are measured. A burst that fails
 * is a row with the sentence of its error. Throws std::exception if the bursts cannot be found, or an output cannot be
 * written. */
SweepOutcome
RunSweep(const EstimateOptions & options);

} // namespace sensornoise::tools

#endif
