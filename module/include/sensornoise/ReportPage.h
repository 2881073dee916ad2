// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_ReportPage_h
#define sensornoise_ReportPage_h

#include "SensorNoiseExport.h"
#include "sensornoise/ChannelReports.h"
#include "sensornoise/Report.h"

#include <cstddef>
#include <cstdint>
#include <string>

namespace sensornoise
{

/** The maps of a measurement, row by row; they belong to the caller. */
struct PageMaps
{
  std::size_t          width{ 0 };
  std::size_t          height{ 0 };
  const double *       mean{ nullptr };     ///< [DN]; null: none
  const std::uint8_t * pixelUse{ nullptr }; ///< as PixelUse; null: none

  bool
  IsEmpty() const
  {
    return width == 0 || height == 0 || (mean == nullptr && pixelUse == nullptr);
  }
};

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
