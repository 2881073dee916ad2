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
#ifndef sensornoise_base_Eigen_h
#define sensornoise_base_Eigen_h

// ITK carries its own copy of Eigen; a program must never see two. Without ITK, the system's Eigen serves.
#if defined(__has_include) && __has_include("itk_eigen.h")
#  include "itk_eigen.h"
#  include ITK_EIGEN(Dense)
#else
#  include <Eigen/Dense>
#endif

#endif
