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

#include "itkImageFileWriter.h"

#include <filesystem>
#include <stdexcept>

namespace sensornoise::tools
{

/** The maps of an estimator as files of a folder, opened before the work begins; all of them appear, or none. */
class MapFiles
{
public:
  explicit MapFiles(const std::filesystem::path & folder)
    : m_Mean(folder / "mean.mha")
    , m_Variance(folder / "variance.mha")
    , m_CorrectedVariance(folder / "corrected_variance.mha")
    , m_PixelUse(folder / "pixel_use.mha")
  {}

  template <typename TEstimator>
  void
  Write(TEstimator & estimator)
  {
    WriteMap(estimator.GetMean(), m_Mean);
    WriteMap(estimator.GetVariance(), m_Variance);
    WriteMap(estimator.GetCorrectedVariance(), m_CorrectedVariance);
    WriteMap(estimator.GetPixelUse(), m_PixelUse);
    for (PendingFile * file : { &m_Mean, &m_Variance, &m_CorrectedVariance, &m_PixelUse })
    {
      file->Commit();
    }
  }

private:
  template <typename TImage>
  static void
  WriteMap(TImage * image, const PendingFile & file)
  {
    auto writer = itk::ImageFileWriter<TImage>::New();
    writer->SetInput(image);
    writer->SetFileName(file.Temporary().string());
    writer->Update();
    // ITK's MetaImage writer does not look whether the disk was full.
    const auto pixels = image->GetLargestPossibleRegion().GetNumberOfPixels();
    if (std::filesystem::file_size(file.Temporary()) < pixels * sizeof(typename TImage::PixelType))
    {
      throw std::runtime_error("cannot write " + file.Target().string() + ": the disk may be full");
    }
  }

  PendingFile m_Mean;
  PendingFile m_Variance;
  PendingFile m_CorrectedVariance;
  PendingFile m_PixelUse;
};

} // namespace sensornoise::tools

#endif
