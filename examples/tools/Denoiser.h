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

/** A frame of real numbers, row by row. */
struct RealFrame
{
  std::size_t        width{ 0 };  ///< pixels
  std::size_t        height{ 0 }; ///< pixels
  std::vector<float> pixels;
};

/** Removes white Gaussian noise of variance 1 from a frame, in place. */
using Denoiser = std::function<void(RealFrame &)>;

/** The denoisers of this build, the default first: "nlm" and "bm3d" where there is OpenCV, and "itk". */
std::vector<std::string>
DenoiserNames();

/** A denoiser by name; \a strength multiplies the noise that it is told of, 1: as measured. \a threads are at most
 * those, 0: all. Throws std::runtime_error, one sentence, where this build has none of that name, or it does not work
 * here: "bm3d" is tried. */
Denoiser
MakeDenoiser(const std::string & name, double strength, unsigned int threads);

/** ITK's BilateralImageFilter. */
Denoiser
MakeBilateral(double strength);

/** The name and version of the OpenCV of this build, or nothing without it. */
std::string
OpenCVVersion();

/** The denoisers that OpenCV gives; defined where there is OpenCV. Non-local means: */
Denoiser
MakeNonLocalMeans(double strength, unsigned int threads);
/** BM3D of the contributed module xphoto. */
Denoiser
MakeBlockMatching(double strength, unsigned int threads);

} // namespace sensornoise::tools

#endif
