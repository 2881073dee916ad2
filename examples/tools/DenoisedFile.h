// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef DenoisedFile_h
#define DenoisedFile_h

#include "tools/Denoiser.h"
#include "tools/NoiseModelFile.h"

#include <string>

namespace sensornoise::tools
{

/** Makes \a output of \a input, an image or a stack frame by frame: generalized Anscombe transform with the model of \a
 * report, \a denoise, exact unbiased inverse. Pixels are of the input's type, rounded and kept in its range, or float.
 *
 * \a rawLayout as OpenFrames() takes it.
 *
 * The output takes its name when it is complete. All of it is held in memory, and of the input one frame. What is odd
 * about the scale of the levels is said on standard error. Throws std::exception, one sentence, for what cannot be read
 * or written, or is on another scale than the report. */
void
WriteDenoised(const std::string &    input,
              const std::string &    output,
              const NoiseModelFile & report,
              const Denoiser &       denoise,
              bool                   asFloat,
              const std::string &    rawLayout = {});

} // namespace sensornoise::tools

#endif
