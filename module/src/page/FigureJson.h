// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_page_FigureJson_h
#define sensornoise_page_FigureJson_h

#include "SensorNoiseExport.h"
#include "sensornoise/ChannelReports.h"
#include "sensornoise/Report.h"

#include <string>

namespace sensornoise
{

/** The numbers of the report's figures, its FigureData, as JSON, for who draws them in another language: one object, an
 * array a member; null for what is not known. `mean`, `variance`, `corrected_variance`; `residual_mean`, `residual`,
 * `residual_spread`; `line_mean`, `line_variance`, `band_low`, `band_high`, `is_indicative`; `flicker`, `motion_x`,
 * `motion_y`; and `lags`, each as in the report. */
SensorNoise_EXPORT std::string
FigureAsJson(const Report & report);

/** The same of every channel: an object each, by the channel's name. */
SensorNoise_EXPORT std::string
FigureAsJson(const ChannelReports & reports);

} // namespace sensornoise

#endif
