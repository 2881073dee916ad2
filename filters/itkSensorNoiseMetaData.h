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
#ifndef itkSensorNoiseMetaData_h
#define itkSensorNoiseMetaData_h

#include "SensorNoiseExport.h"
#include "sensornoise/Settings.h"
#include "itkMetaDataDictionary.h"

namespace sensornoise
{

/** Keys of the CameraSettings in a MetaDataDictionary. A setting that is not known has no entry. */
namespace MetaDataKeys
{
constexpr const char * BayerPattern = "SensorNoise.BayerPattern";           ///< std::string
constexpr const char * BitDepth = "SensorNoise.BitDepth";                   ///< unsigned int [bit]
constexpr const char * BlackLevel = "SensorNoise.BlackLevel";               ///< double [DN]
constexpr const char * WhiteLevel = "SensorNoise.WhiteLevel";               ///< double [DN]
constexpr const char * IsoSpeed = "SensorNoise.IsoSpeed";                   ///< double [1]
constexpr const char * ExposureSeconds = "SensorNoise.ExposureSeconds";     ///< double [s]
constexpr const char * OpticalBlack = "SensorNoise.OpticalBlack";           ///< double [DN]
constexpr const char * OpticalBlackError = "SensorNoise.OpticalBlackError"; ///< double [DN]
constexpr const char * Camera = "SensorNoise.Camera";                       ///< std::string
} // namespace MetaDataKeys

/** Replaces the camera settings of \a dictionary by \a camera. The other entries of the dictionary are unchanged. */
SensorNoise_EXPORT void
SetCameraSettings(itk::MetaDataDictionary & dictionary, const CameraSettings & camera);

/** Returns the camera settings of a dictionary. Numbers may have any numeric type that Python or other programs write.
 * Entries of any other type are treated as missing. */
SensorNoise_EXPORT CameraSettings
CameraSettingsOf(const itk::MetaDataDictionary & dictionary);

} // namespace sensornoise

#endif
