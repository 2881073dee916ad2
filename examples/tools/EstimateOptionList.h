// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef EstimateOptionList_h
#define EstimateOptionList_h

#include <CLI/CLI.hpp>
#include <string>

namespace sensornoise::tools
{

struct EstimateOptions;

/** Option values as text. They are parsed once all options are known. */
struct EstimateTexts
{
  std::string bitDepth{ "auto" };
  std::string clip;
  std::string step;
  std::string levelRange;
  std::string offset;
  std::string rollingShutter{ "auto" };
  std::string roi;
  std::string frames;
};

/** Adds the options of estimate-sensor-noise, with the groups and the texts of --help. */
void
AddEstimateOptions(CLI::App & app, EstimateOptions & options, EstimateTexts & texts);

} // namespace sensornoise::tools

#endif
