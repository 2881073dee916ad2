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
#ifndef itkSensorNoiseImageIOFactory_h
#define itkSensorNoiseImageIOFactory_h

#include "SensorNoiseExport.h"
#include "itkObjectFactoryBase.h"

namespace itk
{

/** \class SensorNoiseImageIOFactory
 * \brief Registers SensorNoiseImageIO with ITK's readers, before other classes that read the same file as a whole.
 *
 * The sources of this library need no factory. An ImageFileReader needs it: call RegisterOneFactory() once, or link to
 * the module with ITK's registration of factories.
 * \ingroup SensorNoise
 */
class SensorNoise_EXPORT SensorNoiseImageIOFactory : public ObjectFactoryBase
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(SensorNoiseImageIOFactory);

  using Self = SensorNoiseImageIOFactory;
  using Superclass = ObjectFactoryBase;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkFactorylessNewMacro(Self);

  const char *
  GetNameOfClass() const override
  {
    return "SensorNoiseImageIOFactory";
  }
  const char *
  GetITKSourceVersion() const override;
  const char *
  GetDescription() const override;

  /** Registers the factory before all others. Repeated calls have no effect. */
  static void
  RegisterOneFactory();

protected:
  SensorNoiseImageIOFactory();
  ~SensorNoiseImageIOFactory() override = default;
};

} // namespace itk

#endif
