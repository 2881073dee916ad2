// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef ComparedFiles_h
#define ComparedFiles_h

#include "page/Comparison.h"

#include <string>
#include <vector>

namespace sensornoise::tools
{

/** What stored reports say of camera, frames and noise: one a file, of a mosaic one a channel. They are called by the
 * names of their files, with as many folders as tell them apart. Throws std::runtime_error if a file cannot be read, is
 * no report, or lacks a quantity. */
std::vector<ComparedReport>
ReadComparedReports(const std::vector<std::string> & files);

} // namespace sensornoise::tools

#endif
