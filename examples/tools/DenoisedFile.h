// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef DenoisedFile_h
#define DenoisedFile_h

#include "tools/Denoiser.h"
#include "tools/NoiseModelFile.h"

#include <string>

namespace sensornoise::tools
{

/** Denoises \a input, an image or a stack frame by frame, and writes \a output. Each frame passes the generalized
 * Anscombe transform with the model of \a report, \a denoise, and the exact unbiased inverse. The output pixels are
 * float, or have the type of the input and are rounded and clamped to its range.
 *
 * \a rawLayout is as for OpenFrames().
 *
 * The output gets its name when it is complete. The whole output and one frame of the input are held in memory. A
 * doubtful scale of the grey values is reported on standard error. Throws std::exception if a file cannot be read or
 * written, or if its scale differs from the scale of the report. The message is one sentence. */
void
WriteDenoised(const std::string &    input,
              const std::string &    output,
              const NoiseModelFile & report,
              const Denoiser &       denoise,
              bool                   asFloat,
              const std::string &    rawLayout = {});

} // namespace sensornoise::tools

#endif
