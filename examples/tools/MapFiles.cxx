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
#include "tools/MapFiles.h"

#include "itkImageFileWriter.h"

#include <array>
#include <cstddef>
#include <filesystem>

namespace sensornoise::tools
{
namespace
{
template <typename TImage>
void
WriteMap(const TImage * image, const PendingFile & file)
{
  auto writer = itk::ImageFileWriter<TImage>::New();
  writer->SetInput(image);
  writer->SetFileName(file.Temporary().string());
  writer->Update();
  file.RequireBytes(image->GetLargestPossibleRegion().GetNumberOfPixels() * sizeof(typename TImage::PixelType));
}
} // namespace

MapFiles::MapFiles(const std::filesystem::path & folder)
  : m_Mean(folder / "mean.mha")
  , m_Variance(folder / "variance.mha")
  , m_CorrectedVariance(folder / "corrected_variance.mha")
  , m_PixelUse(folder / "pixel_use.mha")
  , m_Calibration{ PendingFile(folder / "pixel_offset.mha"),         PendingFile(folder / "pixel_offset_low.mha"),
                   PendingFile(folder / "pixel_offset_high.mha"),    PendingFile(folder / "pixel_read_noise.mha"),
                   PendingFile(folder / "pixel_read_noise_low.mha"), PendingFile(folder / "pixel_read_noise_high.mha") }
{}

void
MapFiles::WriteCalibration(const IntervalMap & offset, const IntervalMap & readNoise)
{
  const std::array<const MapType *, 6> maps{ offset.value,    offset.low,    offset.high,
                                             readNoise.value, readNoise.low, readNoise.high };
  for (std::size_t i = 0; i < maps.size(); ++i)
  {
    WriteMap(maps[i], m_Calibration[i]);
  }
  m_HasCalibration = true;
}

void
MapFiles::Write(const MapType *      mean,
                const MapType *      variance,
                const MapType *      correctedVariance,
                const PixelUseType * pixelUse)
{
  WriteMap(mean, m_Mean);
  WriteMap(variance, m_Variance);
  WriteMap(correctedVariance, m_CorrectedVariance);
  WriteMap(pixelUse, m_PixelUse);
  for (PendingFile * file : { &m_Mean, &m_Variance, &m_CorrectedVariance, &m_PixelUse })
  {
    file->Commit();
  }
  if (m_HasCalibration)
  {
    for (PendingFile & file : m_Calibration)
    {
      file.Commit();
    }
  }
}

} // namespace sensornoise::tools
