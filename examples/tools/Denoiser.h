// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef Denoiser_h
#define Denoiser_h

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace sensornoise::tools
{

/** Frame of floating-point pixels, row by row. */
struct RealFrame
{
  std::size_t        width{ 0 };  ///< [pixel]
  std::size_t        height{ 0 }; ///< [pixel]
  std::vector<float> pixels;
};

/** Function that removes white Gaussian noise of variance 1 from a frame, in place. */
using Denoiser = std::function<void(RealFrame &)>;

/** Returns the names of the denoisers of this build, the default first: "nlm" and "bm3d" with OpenCV, and always
 * "itk". */
std::vector<std::string>
DenoiserNames();

/** Returns a denoiser by name. \a strength multiplies the standard deviation of the noise that the denoiser assumes;
 * 1: the measured noise. \a threads is the largest number of threads; 0: all cores. Throws std::runtime_error, with
 * a message of one sentence, if this build has no denoiser of this name, or if the denoiser does not work. "bm3d" is
 * tested here on simulated noise. */
Denoiser
MakeDenoiser(const std::string & name, double strength, unsigned int threads);

/** Returns a denoiser that uses itk::BilateralImageFilter. */
Denoiser
MakeBilateral(double strength);

/** Returns the version of the OpenCV of this build; empty without OpenCV. */
std::string
OpenCVVersion();

/** Returns a denoiser that uses OpenCV's non-local means. It is defined only in a build with OpenCV. */
Denoiser
MakeNonLocalMeans(double strength, unsigned int threads);
/** Returns a denoiser that uses BM3D of OpenCV's contributed module xphoto. It is defined only in a build with
 * OpenCV. */
Denoiser
MakeBlockMatching(double strength, unsigned int threads);

} // namespace sensornoise::tools

#endif
