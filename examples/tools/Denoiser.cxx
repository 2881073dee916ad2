// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/Denoiser.h"

#include <stdexcept>

namespace sensornoise::tools
{

std::vector<std::string>
DenoiserNames()
{
#ifdef SENSORNOISE_OPENCV
  return { "nlm", "bm3d", "itk" };
#else
  return { "itk" };
#endif
}

Denoiser
MakeDenoiser(const std::string & name, double strength, [[maybe_unused]] unsigned int threads)
{
  if (name == "itk")
  {
    return MakeBilateral(strength);
  }
#ifdef SENSORNOISE_OPENCV
  if (name == "nlm")
  {
    return MakeNonLocalMeans(strength, threads);
  }
  if (name == "bm3d")
  {
    return MakeBlockMatching(strength, threads);
  }
#else
  if (name == "nlm" || name == "bm3d")
  {
    throw std::runtime_error("--denoiser " + name +
                             " is OpenCV's, and this program was built without OpenCV; expected --denoiser itk");
  }
#endif
  throw std::runtime_error("the denoiser is \"" + name + "\"; expected nlm, bm3d or itk");
}

#ifndef SENSORNOISE_OPENCV
std::string
OpenCVVersion()
{
  return "";
}
#endif

} // namespace sensornoise::tools
