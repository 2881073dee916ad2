// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef ItkThreads_h
#define ItkThreads_h

#include "itkMultiThreaderBase.h"

namespace sensornoise::tools
{

/** The threads that ITK uses; 0: as many as it chooses. */
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
