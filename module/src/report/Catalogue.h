// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_report_Catalogue_h
#define sensornoise_report_Catalogue_h

#include "SensorNoiseExport.h"

#include <string>

namespace sensornoise
{

/** WarningTable and QuantityList() as JSON, for other languages:
 * {"warnings": [{"code", "severity", "sentence"}, ...], "quantities": [{"path", "label", "unit", "meaning"}, ...]}. */
SensorNoise_EXPORT std::string
CatalogueAsJson();

} // namespace sensornoise

#endif
