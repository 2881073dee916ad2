// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/Denoiser.h"

#include <opencv2/core.hpp>
#include <opencv2/photo.hpp>
#if __has_include(<opencv2/xphoto/bm3d_image_denoising.hpp>) && defined(SENSORNOISE_XPHOTO)
#  include <opencv2/xphoto/bm3d_image_denoising.hpp>
#endif

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

namespace sensornoise::tools
{
namespace
{
/** Grey values per standard deviation of the noise, for the 16-bit filters of OpenCV. There are fewer if the range
 * of the frame exceeds 16 bits. At 256, rounding adds less than a thousandth to the variance of the noise. */
constexpr double GreyValuesPerSigma = 256.0;

/** Filter strength h of cv::fastNlMeansDenoising with NORM_L1 for noise of variance 1. The weights are
 * exp(-(d/h)^2), where d is the mean absolute difference of two patches. Noise alone gives d = 2 / sqrt(pi) = 1.13.
 * On frames of the simulated cameras A, B and C, the PSNR is best at 1.6 for the scene target and at 1.1 for
 * texture. At 1.3 it is within 0.8 dB and 0.2 dB of these maxima. There, patches of 3 x 3 pixels are 1 to 2 dB
 * better than OpenCV's default of 7 x 7. */
constexpr double NonLocalMeansStrength = 1.3;
constexpr int    PatchPixels = 3;
constexpr int    SearchPixels = 21; // OpenCV's default

/** Frame as 16-bit grey values, with the conversion back. */
class GreyValueFrame
{
public:
  explicit GreyValueFrame(const RealFrame & frame)
    : m_GreyValues(static_cast<int>(frame.height), static_cast<int>(frame.width), CV_16UC1)
  {
    const auto ends = std::minmax_element(frame.pixels.begin(), frame.pixels.end());
    m_Lowest = *ends.first;
    const double     range = static_cast<double>(*ends.second) - m_Lowest;
    constexpr double most = std::numeric_limits<std::uint16_t>::max();
    m_GreyValuesPerSigma = range * GreyValuesPerSigma > most ? most / range : GreyValuesPerSigma;
    std::transform(frame.pixels.begin(), frame.pixels.end(), m_GreyValues.begin<std::uint16_t>(), [this](float value) {
      return static_cast<std::uint16_t>(std::lround((static_cast<double>(value) - m_Lowest) * m_GreyValuesPerSigma));
    });
  }

  double
  GetGreyValuesPerSigma() const
  {
    return m_GreyValuesPerSigma;
  }
  const cv::Mat &
  GetGreyValues() const
  {
    return m_GreyValues;
  }
  void
  Decode(const cv::Mat & greyValues, RealFrame & frame) const
  {
    std::transform(greyValues.begin<std::uint16_t>(),
                   greyValues.end<std::uint16_t>(),
                   frame.pixels.begin(),
                   [this](auto greyValue) { return static_cast<float>(m_Lowest + greyValue / m_GreyValuesPerSigma); });
  }

private:
  cv::Mat m_GreyValues;
  double  m_Lowest{ 0.0 };
  double  m_GreyValuesPerSigma{ GreyValuesPerSigma };
};

void
SetThreads(unsigned int threads)
{
  if (threads > 0)
  {
    cv::setNumThreads(static_cast<int>(threads));
  }
}

#ifdef SENSORNOISE_XPHOTO
void
BlockMatching(RealFrame & frame, double strength)
{
  const GreyValueFrame greyFrame(frame);
  const auto           sigma = static_cast<float>(strength * greyFrame.GetGreyValuesPerSigma());
  cv::Mat              clean;
  cv::xphoto::bm3dDenoising(greyFrame.GetGreyValues(), clean, sigma, 4, 16, 2500, 400, 8, 1, 2.0F, cv::NORM_L1);
  greyFrame.Decode(clean, frame);
}

/** Applies a denoiser to a uniform frame with noise of variance 1. Returns the variance of the result. */
double
VarianceLeftOf(const Denoiser & denoise)
{
  constexpr std::size_t size = 64;
  RealFrame             frame{ size, size, std::vector<float>(size * size) };
  cv::RNG               random(1);
  for (float & pixel : frame.pixels)
  {
    pixel = static_cast<float>(100.0 + random.gaussian(1.0));
  }
  denoise(frame);
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(cv::Mat(frame.pixels), mean, deviation);
  return deviation[0] * deviation[0];
}
#endif
} // namespace

std::string
OpenCVVersion()
{
  return CV_VERSION;
}

Denoiser
MakeNonLocalMeans(double strength, unsigned int threads)
{
  SetThreads(threads);
  return [strength](RealFrame & frame) {
    const GreyValueFrame greyFrame(frame);
    const auto           h = static_cast<float>(strength * NonLocalMeansStrength * greyFrame.GetGreyValuesPerSigma());
    cv::Mat              clean;
    cv::fastNlMeansDenoising(
      greyFrame.GetGreyValues(), clean, std::vector<float>{ h }, PatchPixels, SearchPixels, cv::NORM_L1);
    greyFrame.Decode(clean, frame);
  };
}

Denoiser
MakeBlockMatching([[maybe_unused]] double strength, [[maybe_unused]] unsigned int threads)
{
  const std::string why = std::string("--denoiser bm3d does not work with this build's OpenCV ") + CV_VERSION;
#ifdef SENSORNOISE_XPHOTO
  SetThreads(threads);
  const Denoiser denoise = [strength](RealFrame & frame) { BlockMatching(frame, strength); };
  double         left = 1.0;
  try
  {
    left = VarianceLeftOf(denoise);
  }
  catch (const cv::Exception & error)
  {
    throw std::runtime_error(why + " (" + error.err + "); expected --denoiser nlm or itk");
  }
  if (!(left < 0.5))
  {
    throw std::runtime_error(why + " (it leaves " + std::to_string(left) +
                             " of the variance of noise); expected --denoiser nlm or itk");
  }
  return denoise;
#else
  throw std::runtime_error(why + " (its module xphoto is not there); expected --denoiser nlm or itk");
#endif
}

} // namespace sensornoise::tools
