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

/** Maps of a measurement, stored row by row. The caller owns them. */
struct PageMaps
{
  std::size_t          width{ 0 };          ///< columns of the maps [pixel]
  std::size_t          height{ 0 };         ///< rows of the maps [pixel]
  const double *       mean{ nullptr };     ///< temporal mean [DN]; null: none
  const std::uint8_t * pixelUse{ nullptr }; ///< values of PixelUse; null: none

  /** Returns whether there is no map. */
  bool
  IsEmpty() const
  {
    return width == 0 || height == 0 || (mean == nullptr && pixelUse == nullptr);
  }
};

/** Name and date for the title of a page, as plain text. */
struct PageTitle
{
  std::string name; ///< name of what was measured, for example a file; "": the camera, if its files name it
  std::string date; ///< date of the files, for example "2026-11-24 23:30 UTC"; "": not known
};

/** Returns the report as one HTML page, which needs no network and has no scripts. The first screen has the verdict in
 * one sentence, gain, read noise and offset with their errors, the noise curve, and each warning with its action. Below
 * are all quantities, the other figures, the symbols of EMVA 1288, and the settings. The page shows \a maps with at
 * most 256 x 256 points, or no maps if they are empty. */
SensorNoise_EXPORT std::string
ToHtml(const Report & report, const PageMaps & maps = {}, const PageTitle & title = {});

/** Returns the reports of a mosaic as one HTML page: a table of all channels and their noise curves, followed by the
 * report of each channel. \a maps has the size of the whole frame. */
SensorNoise_EXPORT std::string
ToHtml(const ChannelReports & reports, const PageMaps & maps = {}, const PageTitle & title = {});

/** Returns figure 1 of the page, variance against mean, as an SVG file. */
SensorNoise_EXPORT std::string
ToSvg(const Report & report);

/** Returns the numbers of the figures (FigureData) as a JSON object, for plots in other languages. Its members are
 * arrays, with null for unknown values: `mean`, `variance` and `corrected_variance`; `residual_mean` and `residual`;
 * `line_mean`, `line_variance`, `band_low` and `band_high`; `flicker`, `motion_x` and `motion_y`; and `lags`, each as
 * in the report. `residual_spread` is the largest factor by which noise correlation between neighbours enlarges
 * the scatter of the residuals [1]. `is_indicative` is true or false. */
SensorNoise_EXPORT std::string
FigureAsJson(const Report & report);

/** Returns the numbers of the figures of every channel: one object per channel, under the name of the channel. */
SensorNoise_EXPORT std::string
FigureAsJson(const ChannelReports & reports);

} // namespace sensornoise

#endif
