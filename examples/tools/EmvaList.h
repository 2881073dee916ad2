// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef EmvaList_h
#define EmvaList_h

#include "tools/EmvaSources.h"

#include <string>

namespace sensornoise::tools
{

/** Returns whether a file is a list of exposures and no image, by the ending of its name: .csv, .tsv or .txt. */
bool
IsEmvaList(const std::string & file);

/** Reads a list of exposures: a descriptor of the package emva1288, or a table.
 *
 * A descriptor has lines "n BITS WIDTH HEIGHT", "b EXPOSURE PHOTONS" and "d EXPOSURE", each of the latter two followed
 * by lines "i FILE". Exposures are in nanoseconds and become seconds. A table has a line of names and one line for each
 * series; columns are separated by commas or tabs. The columns are `exposure` (or `exposure_s`, `exposure_ms`,
 * `exposure_us`, `exposure_ns`: then it becomes seconds) and `files` (names, stacks or patterns, with semicolons), and
 * optionally `photons` and `kind` ("flat" or "dark"). Without a kind, a series is dark if its photons are 0, or,
 * without photons, if its exposure is 0. Names are relative to the folder of the list; backslashes in a descriptor are
 * slashes.
 *
 * Throws std::runtime_error, which names the line, for a list that is none, and for a pattern without files. */
EmvaSourceList
ReadEmvaList(const std::string & file, bool areRaw);

} // namespace sensornoise::tools

#endif
