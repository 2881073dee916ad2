// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef ComparedFiles_h
#define ComparedFiles_h

#include "page/Comparison.h"

#include <string>
#include <vector>

namespace sensornoise::tools
{

/** Reads stored reports: camera, frames and noise. Returns one entry per file, or one per channel of a mosaic. The
 * labels are the file names, with as many folders as needed to distinguish them. Throws std::runtime_error if a file
 * cannot be read, is not a report, or lacks a quantity. */
std::vector<ComparedReport>
ReadComparedReports(const std::vector<std::string> & files);

} // namespace sensornoise::tools

#endif
