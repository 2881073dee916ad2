// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef StoredReportFile_h
#define StoredReportFile_h

#include "sensornoise/NoiseExport.h"

#include <string>

namespace sensornoise::tools
{

/** Reads a report of estimate-sensor-noise for exports. Throws std::runtime_error if \a file cannot be read or is no
 * JSON, and UnfitReport if it has another schema. */
StoredReport
ReadStoredReport(const std::string & file);

} // namespace sensornoise::tools

#endif
