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
  /** What is read and what is made of it; the files' formats are those of the names. */
  using Job = std::pair<std::string, std::string>;

  std::string              report;
  std::vector<std::string> files;        ///< INPUT OUTPUT, or INPUT... with a folder
  std::string              outputFolder; ///< empty: none
  std::string              raw;          ///< how frames lie in inputs without a header; empty: none
  std::string              denoiser;
  std::string              pixelType{ "input" }; ///< input or float
  double                   strength{ 1.0 };      ///< of the denoiser, relative to noise of variance 1
  unsigned int             threads{ 0 };         ///< 0: all

  /** Reads the command line, where the denoiser is one of \a denoisers, the default first; the exit code if there is
   * nothing left to do (--help, --version). Throws std::exception on wrong use. */
  std::optional<int>
  Parse(int argc, char ** argv, const std::vector<std::string> & denoisers);

  /** Input and output of every file. Throws std::runtime_error where there are not two files, or the name of an output
   * ends as no image that can be written. */
  std::vector<Job>
  Jobs() const;
};

} // namespace sensornoise::tools

#endif
