// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_ReportPage_h
#define sensornoise_ReportPage_h

#include "SensorNoiseExport.h"
#include "page/MapPicture.h"
#include "sensornoise/ChannelReports.h"
#include "sensornoise/Report.h"

#include <string>

namespace sensornoise
{

/** The report as one HTML page that needs nothing else: no network, no script. It says what was found, in a sentence,
 * in a table and in figures, what the warnings mean and what would help, and EMVA 1288's symbols beside ours. \a maps:
 * of the pixels, reduced to at most 256 x 256 points; none: the page is without. */
SensorNoise_EXPORT std::string
ToHtml(const Report & report, const PageMaps & maps = {});

/** The same of a mosaic: a table of all channels, then each by itself. The maps are of the whole frame. */
SensorNoise_EXPORT std::string
ToHtml(const ChannelReports & reports, const PageMaps & maps = {});

/** Figure 1 of the page, variance against mean, as an SVG file of its own. */
SensorNoise_EXPORT std::string
ToSvg(const Report & report);

} // namespace sensornoise

#endif
