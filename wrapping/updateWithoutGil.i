// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
// UpdateWithoutGil(process): Update() of a filter, while which other threads of Python run. ITK's wrapping keeps Python's
// global lock (GIL) during every call. Observers take the lock themselves (itk::PyCommand), the functions of
// itk::PyImageFilter do not: with such a filter in the pipeline the lock is kept.
%{
#include "ReleasedGil.h"
#include "itkDataObject.h"
#include "itkProcessObject.h"

#include <set>
#include <string>
#include <vector>

using itkProcessObject = itk::ProcessObject;

namespace
{
/** Returns whether the filter or a filter upstream of it calls functions of Python that expect the lock. */
bool
CallsPython(itk::ProcessObject * last)
{
  std::set<itk::ProcessObject *>          found{ last };
  std::vector<itk::ProcessObject::Pointer> open{ last };
  while (!open.empty())
  {
    const itk::ProcessObject::Pointer process = open.back();
    open.pop_back();
    if (std::string("PyImageFilter") == process->GetNameOfClass())
    {
      return true;
    }
    for (const auto & input : process->GetInputs())
    {
      const itk::ProcessObject::Pointer source = input ? input->GetSource() : nullptr;
      if (source && found.insert(source).second)
      {
        open.push_back(source);
      }
    }
  }
  return false;
}

void
UpdateWithoutGil(itkProcessObject * process)
{
  const ReleasedGil gil(!CallsPython(process));
  process->Update();
}
} // namespace
%}

void UpdateWithoutGil(itkProcessObject * process);
