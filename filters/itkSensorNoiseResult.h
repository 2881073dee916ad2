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
#ifndef itkSensorNoiseResult_h
#define itkSensorNoiseResult_h

#include "itkDataObject.h"
#include "itkMacro.h"
#include "itkObjectFactory.h"

#include <optional>
#include <utility>

namespace itk
{

/** \class SensorNoiseResult
 * \brief Carries the result of an estimator, a plain struct, through a pipeline.
 *
 * The class resembles SimpleDataObjectDecorator, but does not need a comparable component: each call of Set() counts as
 * a new result. There is no result before the Update() of the estimator, nor after an Update() that failed during the
 * computation.
 *
 * \tparam TResult a copyable type.
 * \ingroup SensorNoise
 */
template <typename TResult>
class ITK_TEMPLATE_EXPORT SensorNoiseResult : public DataObject
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(SensorNoiseResult);

  using Self = SensorNoiseResult;
  using Superclass = DataObject;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkNewMacro(Self);

  const char *
  GetNameOfClass() const override
  {
    return "SensorNoiseResult";
  }

  /** Sets the result. */
  void
  Set(TResult result)
  {
    m_Result = std::move(result);
    this->Modified();
  }
  /** Returns whether there is a result. */
  bool
  Has() const
  {
    return m_Result.has_value();
  }
  /** Returns the result. Throws an ExceptionObject if there is no result. */
  const TResult &
  Get() const
  {
    if (!m_Result)
    {
      itkExceptionMacro("there is no result: Update() of the estimator comes first, and must succeed");
    }
    return *m_Result;
  }

  /** Removes the result. ITK calls this before the estimator computes, because the computation may fail. */
  void
  Initialize() override
  {
    DataObject::Initialize();
    m_Result.reset();
  }

protected:
  SensorNoiseResult() = default;
  ~SensorNoiseResult() override = default;

private:
  std::optional<TResult> m_Result;
};

} // namespace itk

#endif
