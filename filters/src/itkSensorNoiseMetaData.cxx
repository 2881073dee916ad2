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
#include "itkSensorNoiseMetaData.h"

#include "itkMetaDataObject.h"

#include <cmath>
#include <limits>
#include <string>

namespace sensornoise
{
namespace
{
template <typename T>
void
SetEntry(itk::MetaDataDictionary & dictionary, const char * key, const T & value, bool isKnown)
{
  if (isKnown)
  {
    itk::EncapsulateMetaData<T>(dictionary, key, value);
  }
  else
  {
    dictionary.Erase(key);
  }
}

void
SetNumber(itk::MetaDataDictionary & dictionary, const char * key, double value)
{
  SetEntry(dictionary, key, value, !std::isnan(value));
}

template <typename TNumber>
bool
FindNumber(const itk::MetaDataDictionary & dictionary, const char * key, double & value)
{
  TNumber number{};
  if (itk::ExposeMetaData(dictionary, key, number))
  {
    value = static_cast<double>(number);
    return true;
  }
  return false;
}

/** Returns the number of a key, of any type that programs or Python write; NaN: there is none. */
double
NumberIn(const itk::MetaDataDictionary & dictionary, const char * key)
{
  double value = std::numeric_limits<double>::quiet_NaN();
  FindNumber<double>(dictionary, key, value) || FindNumber<float>(dictionary, key, value) ||
    FindNumber<int>(dictionary, key, value) || FindNumber<unsigned int>(dictionary, key, value);
  return value;
}
} // namespace

void
SetCameraSettings(itk::MetaDataDictionary & dictionary, const CameraSettings & camera)
{
  SetEntry(dictionary, MetaDataKeys::BayerPattern, camera.bayerPattern, !camera.bayerPattern.empty());
  SetEntry(dictionary, MetaDataKeys::BitDepth, camera.bitDepth, camera.bitDepth != 0);
  SetNumber(dictionary, MetaDataKeys::BlackLevel, camera.blackLevelDn);
  SetNumber(dictionary, MetaDataKeys::WhiteLevel, camera.whiteLevelDn);
  SetNumber(dictionary, MetaDataKeys::IsoSpeed, camera.isoSpeed);
  SetNumber(dictionary, MetaDataKeys::ExposureSeconds, camera.exposureSeconds);
  SetNumber(dictionary, MetaDataKeys::OpticalBlack, camera.opticalBlackDn);
  SetNumber(dictionary, MetaDataKeys::OpticalBlackError, camera.opticalBlackErrorDn);
  SetEntry(dictionary, MetaDataKeys::Camera, camera.camera, !camera.camera.empty());
}

CameraSettings
CameraSettingsOf(const itk::MetaDataDictionary & dictionary)
{
  CameraSettings camera;
  itk::ExposeMetaData(dictionary, MetaDataKeys::BayerPattern, camera.bayerPattern);
  const double bits = NumberIn(dictionary, MetaDataKeys::BitDepth);
  camera.bitDepth = bits >= 1.0 && bits <= 64.0 ? static_cast<unsigned int>(bits) : 0;
  camera.blackLevelDn = NumberIn(dictionary, MetaDataKeys::BlackLevel);
  camera.whiteLevelDn = NumberIn(dictionary, MetaDataKeys::WhiteLevel);
  camera.isoSpeed = NumberIn(dictionary, MetaDataKeys::IsoSpeed);
  camera.exposureSeconds = NumberIn(dictionary, MetaDataKeys::ExposureSeconds);
  camera.opticalBlackDn = NumberIn(dictionary, MetaDataKeys::OpticalBlack);
  camera.opticalBlackErrorDn = NumberIn(dictionary, MetaDataKeys::OpticalBlackError);
  itk::ExposeMetaData(dictionary, MetaDataKeys::Camera, camera.camera);
  return camera;
}

} // namespace sensornoise
