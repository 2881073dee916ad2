// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef DenoiseOptions_h
#define DenoiseOptions_h

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sensornoise::tools
{

/** The command line of denoise-with-noise-model. */
struct DenoiseOptions
{
  /** Input file and output file. Their names determine their formats. */
  using Job = std::pair<std::string, std::string>;

  std::string              report;
  std::vector<std::string> files;        ///< INPUT OUTPUT, or INPUT... with a folder
  std::string              outputFolder; ///< empty: none
  std::string              raw;          ///< layout of inputs without a header (--raw); empty: none
  std::string              denoiser;
  std::string              pixelType{ "input" }; ///< input or float
  double                   strength{ 1.0 };      ///< strength of the denoiser; 1: for noise of variance 1
  unsigned int             threads{ 0 };         ///< 0: all cores

  /** Reads the command line. \a denoisers are the permitted denoisers, the default first. Returns the exit code if
   * nothing is left to do (--help, --version). Throws std::exception on wrong use. */
  std::optional<int>
  Parse(int argc, char ** argv, const std::vector<std::string> & denoisers);

  /** Returns input and output of every file. Throws std::runtime_error if --output-folder is not given and there are
   * not two files, or if the format of an output cannot be written. */
  std::vector<Job>
  Jobs() const;
};

} // namespace sensornoise::tools

#endif
