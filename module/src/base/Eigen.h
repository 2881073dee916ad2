// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_Eigen_h
#define sensornoise_base_Eigen_h

// ITK includes its own copy of Eigen; a program must not contain two. Without ITK, the Eigen of the system is used.
#if defined(__has_include) && __has_include("itk_eigen.h")
#  include "itk_eigen.h"
#  include ITK_EIGEN(Dense)
#else
#  include <Eigen/Dense>
#endif

#endif
