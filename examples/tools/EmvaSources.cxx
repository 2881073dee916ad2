// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/EmvaSources.h"

#include "base/Text.h"
#include "itkSensorNoiseFrameFiles.h"

#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

namespace sensornoise::tools
{

EmvaSourceList
GroupByExposure(const std::vector<std::string> & files, const std::vector<double> & exposures)
{
  std::map<double, EmvaSource> groups;
  for (std::size_t t = 0; t < exposures.size(); ++t)
  {
    EmvaSource & source = groups[exposures[t]];
    source.exposure = exposures[t];
    source.isDark = exposures[t] == 0.0;
    source.files = files;
    source.frames.push_back(t);
  }
  EmvaSourceList list;
  for (auto & [exposure, source] : groups)
  {
    source.where = "the exposure " + std::to_string(exposure);
    list.sources.push_back(std::move(source));
  }
  return list;
}

EmvaSourceList
GroupByRecordedExposure(const std::vector<std::string> & flats, const std::vector<std::string> & darks)
{
  std::map<std::pair<double, bool>, EmvaSource> groups; // by exposure and whether it is dark
  for (const bool isDark : { false, true })
  {
    const std::vector<std::string> & names = isDark ? darks : flats;
    for (const FrameFile & file : names.empty() ? std::vector<FrameFile>() : OpenFrames(names).files)
    {
      const double exposure = file.camera.exposureSeconds;
      if (!std::isfinite(exposure))
      {
        throw std::invalid_argument("--method emva1288 needs the exposures of the frames, and " + file.name +
                                    " records none; expected a list of exposures in place of the frames (.csv, .txt), "
                                    "or --exposures LIST");
      }
      EmvaSource & source = groups[{ exposure, isDark }];
      source.exposure = exposure;
      source.isDark = isDark;
      source.photons = isDark ? std::optional<double>(0.0) : std::nullopt;
      source.files.push_back(file.name);
      source.where = "the exposure of " + Text(exposure) + " s of " + file.name;
    }
  }
  if (darks.empty())
  {
    throw std::invalid_argument("there are no dark frames; expected them by --dark, where the files record their "
                                "exposures, or a list of exposures");
  }
  EmvaSourceList list;
  list.exposureUnit = "s";
  for (auto & [key, source] : groups)
  {
    list.sources.push_back(std::move(source));
  }
  return list;
}

} // namespace sensornoise::tools
