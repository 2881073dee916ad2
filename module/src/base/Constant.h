// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_Constant_h
#define sensornoise_base_Constant_h

/** \def SENSORNOISE_CONSTANT
 * Precedes a struct of the numbers of the methods, which is a constant. With SENSORNOISE_VARY_CONSTANTS it is a
 * variable, which a program may change before a measurement, to study what a number does (measure-varied-cases). */
#ifdef SENSORNOISE_VARY_CONSTANTS
#  define SENSORNOISE_CONSTANT inline
#else
#  define SENSORNOISE_CONSTANT inline constexpr
#endif

#endif
