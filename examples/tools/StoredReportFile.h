// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef StoredReportFile_h
#define StoredReportFile_h

#include "sensornoise/NoiseExport.h"

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace sensornoise::tools
{

/** Reads a report of estimate-sensor-noise for exports. Throws std::runtime_error if \a file cannot be read or is
 * not JSON, and UnfitReport if it has another schema. */
StoredReport
ReadStoredReport(const std::string & file);

/** Returns the numbers and texts of a JSON record by their JSON Pointers. \a name is the name of the file, for
 * messages.
 */
StoredReport
ValuesOfJson(const std::string & name, const nlohmann::json & record);

/** Reads the maps pixel_offset.mha and pixel_read_noise.mha from a folder that estimate-sensor-noise --maps wrote.
 * Throws std::runtime_error if a map cannot be read, or if their sizes differ. */
NoiseMaps
ReadNoiseMaps(const std::string & folder);

} // namespace sensornoise::tools

#endif
