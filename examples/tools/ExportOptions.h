// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef ExportOptions_h
#define ExportOptions_h

#include "sensornoise/NoiseExport.h"

#include <optional>
#include <string>
#include <vector>

namespace sensornoise::tools
{

/** The command line of export-noise-model. */
struct ExportOptions
{
  std::vector<std::string> reports;
  std::string              format;
  std::string              output;  ///< file, or folder for several files; empty: standard output
  std::string              into;    ///< DNG file whose copy gets the tag NoiseProfile; empty: none
  std::string              maps;    ///< folder of the maps that --maps wrote; empty: none
  std::optional<double>    setting; ///< setting of a passport that is exported; none: all, or the only one
  ExportSettings           settings;

  /** Reads the command line. Returns the exit code if nothing is left to do (--help, --version, --list). Throws
   * std::exception on wrong use. */
  std::optional<int>
  Parse(int argc, char ** argv);
};

} // namespace sensornoise::tools

#endif
