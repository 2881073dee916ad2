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
#include "itkSensorNoiseImageIOFactory.h"

#include "itkSensorNoiseImageIO.h"
#include "itkCreateObjectFunction.h"
#include "itkVersion.h"

#include <algorithm>

namespace itk
{

SensorNoiseImageIOFactory::SensorNoiseImageIOFactory()
{
  this->RegisterOverride("itkImageIOBase",
                         "itkSensorNoiseImageIO",
                         "Bursts of frames: raw files of cameras, SER, MRAW, multi-page TIFF",
                         true,
                         CreateObjectFunction<SensorNoiseImageIO>::New());
}

const char *
SensorNoiseImageIOFactory::GetITKSourceVersion() const
{
  return ITK_SOURCE_VERSION;
}

const char *
SensorNoiseImageIOFactory::GetDescription() const
{
  return "Reads bursts of frames: raw files of cameras, SER, MRAW, multi-page TIFF in parts";
}

void
SensorNoiseImageIOFactory::RegisterOneFactory()
{
  const auto factories = ObjectFactoryBase::GetRegisteredFactories();
  const bool isThere = std::any_of(factories.begin(), factories.end(), [](const ObjectFactoryBase * factory) {
    return dynamic_cast<const SensorNoiseImageIOFactory *>(factory) != nullptr;
  });
  if (!isThere)
  {
    ObjectFactoryBase::RegisterFactory(Self::New(), ObjectFactoryEnums::InsertionPosition::INSERT_AT_FRONT);
  }
}

// The registration of factories in ITK calls the function by this name (itk-module.cmake, FACTORY_NAMES).
void SensorNoise_EXPORT SensorNoiseImageIOFactoryRegister__Private(); // NOLINT(bugprone-reserved-identifier)

void
SensorNoiseImageIOFactoryRegister__Private() // NOLINT(bugprone-reserved-identifier)
{
  SensorNoiseImageIOFactory::RegisterOneFactory();
}

} // namespace itk
