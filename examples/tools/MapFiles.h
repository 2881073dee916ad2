// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef MapFiles_h
#define MapFiles_h

#include "tools/PendingFile.h"
#include "tools/SignalCleanup.h"

#include "itkImage.h"

#include <cstddef>
#include <deque>
#include <filesystem>
#include <string>
#include <vector>

namespace sensornoise::tools
{

/** Maps of an estimator as files of a folder. The files are opened before the work begins. They get their names when
 * all maps are written. */
class MapFiles
{
public:
  using MapType = itk::Image<double, 2>;
  using PixelUseType = itk::Image<unsigned char, 2>;

  /** Calibration of each pixel from its dark frames, with the bounds of its interval [DN]. */
  struct IntervalMap
  {
    const MapType * value;
    const MapType * low;
    const MapType * high;
  };

  /** Returns the names of the files. With \a hasDark they include the maps of the calibration, which are removed from
   * the folder where none are written. */
  static std::vector<std::string>
  NamesIn(const std::filesystem::path & folder, bool hasDark);

  /** Makes the folder, if there is none. The folder is removed again if nothing is written. */
  MapFiles(const std::filesystem::path & folder, bool hasDark);
  ~MapFiles();

  void
  Write(const MapType *      mean,
        const MapType *      variance,
        const MapType *      correctedVariance,
        const PixelUseType * pixelUse);

  /** Writes the calibration of the pixels from dark frames [DN]. It must be called before Write(), which gives the
   * files their names. */
  void
  WriteCalibration(const IntervalMap & offset, const IntervalMap & readNoise);

private:
  /** Removes the maps of the calibration of an earlier estimate, which are of other pixels. */
  void
  RemoveOldCalibration() const;

  std::filesystem::path              m_Folder;
  std::vector<std::filesystem::path> m_Made; // folders that were made, the outermost first
  std::deque<SignalCleanup>          m_AtSignal;
  std::deque<PendingFile>            m_Files; // files of the maps, in the order of NamesIn()
  std::size_t                        m_Written{ 0 };
};

} // namespace sensornoise::tools

#endif
