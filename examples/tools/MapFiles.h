/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#ifndef MapFiles_h
#define MapFiles_h

#include "tools/PendingFile.h"

#include "itkImage.h"

#include <array>
#include <filesystem>

namespace sensornoise::tools
{

/** The maps of an estimator as files of a folder, opened before the work begins; all of them appear, or none. */
class MapFiles
{
public:
  using MapType = itk::Image<double, 2>;
  using PixelUseType = itk::Image<unsigned char, 2>;

  /** What every pixel's own dark frames tell. */
  struct IntervalMap
  {
    const MapType * value;
    const MapType * low;
    const MapType * high;
  };

  explicit MapFiles(const std::filesystem::path & folder);

  void
  Write(const MapType *      mean,
        const MapType *      variance,
        const MapType *      correctedVariance,
        const PixelUseType * pixelUse);

  /** The calibration of the pixels from dark frames [DN]. To be called before Write(), which gives the files their
   * names. */
  void
  WriteCalibration(const IntervalMap & offset, const IntervalMap & readNoise);

private:
  PendingFile                m_Mean;
  PendingFile                m_Variance;
  PendingFile                m_CorrectedVariance;
  PendingFile                m_PixelUse;
  std::array<PendingFile, 6> m_Calibration; // offset, its low and high end, read noise, its low and high end
  bool                       m_HasCalibration{ false };
};

} // namespace sensornoise::tools

#endif
