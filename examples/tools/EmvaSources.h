// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef EmvaSources_h
#define EmvaSources_h

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise::tools
{

/** Frames of one exposure, for the evaluation of EMVA 1288. */
struct EmvaSource
{
  double                   exposure{ 0.0 };
  std::optional<double>    photons; ///< mean photons of a pixel [photon]; null: not known
  bool                     isDark{ false };
  std::vector<std::string> files;
  std::vector<std::size_t> frames; ///< numbers of the frames in the files, from 0; empty: all
  std::string              where;  ///< place in the list, for messages: "line 3 of list.csv"
};

/** Frames of all exposures. */
struct EmvaSourceList
{
  std::vector<EmvaSource> sources;
  std::string             exposureUnit;  ///< "s", or "": not known
  unsigned int            bitDepth{ 0 }; ///< bit depth of the digital numbers [bit]; 0: not known
  std::size_t             width{ 0 };    ///< columns that the list says [pixel]; 0: it says none
  std::size_t             height{ 0 };   ///< rows that the list says [pixel]; 0: it says none
};

/** Groups the frames of \a files by their exposures. There is one exposure for each frame; frames of
 * exposure 0 are dark. The exposures are in the order of the frames. */
EmvaSourceList
GroupByExposure(const std::vector<std::string> & files, const std::vector<double> & exposures);

/** Groups flat fields and dark frames by the exposure times that their files record, in seconds. Throws
 * std::exception if a file records none, or cannot be read, and if there are no dark frames. */
EmvaSourceList
GroupByRecordedExposure(const std::vector<std::string> & flats, const std::vector<std::string> & darks);

} // namespace sensornoise::tools

#endif
