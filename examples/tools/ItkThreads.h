// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef ItkThreads_h
#define ItkThreads_h

#include "itkMultiThreaderBase.h"

namespace sensornoise::tools
{

/** Sets the number of threads of ITK; 0: the default of ITK. */
inline void
SetItkThreads(unsigned int threads)
{
  if (threads > 0)
  {
    itk::MultiThreaderBase::SetGlobalMaximumNumberOfThreads(threads);
    itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(threads);
  }
}

} // namespace sensornoise::tools

#endif
