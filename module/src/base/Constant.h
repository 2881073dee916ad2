// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_Constant_h
#define sensornoise_base_Constant_h

/** \def SENSORNOISE_CONSTANT
 * Before a struct of the methods' numbers: it is known when the library is compiled. With SENSORNOISE_VARY_CONSTANTS it
 * is a variable, which a program may change before it measures, to study what a number does (measure-varied-cases). */
#ifdef SENSORNOISE_VARY_CONSTANTS
#  define SENSORNOISE_CONSTANT inline
#else
#  define SENSORNOISE_CONSTANT inline constexpr
#endif

#endif
