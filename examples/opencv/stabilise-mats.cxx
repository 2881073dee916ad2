// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
// Measures the noise of OpenCV's frames, writes a report, and stabilises a cv::Mat so that its noise has variance 1:
//   stabilise-mats report.json frame_*.png        stabilise-mats report.json --video camera.avi
// --video reads 100 frames of a video file, of a sequence of images or of a camera (its number). A sequence is given by
// the name of its first file, or by a pattern like frame_%03d.png whose numbers begin near 0.
//
// Images read as a sequence with the back end for images (CAP_IMAGES) gave the same report as the Mats, also with 16
// bits. This was tested with OpenCV 4.6 here, and with 4.14 and 5.0 in Python. The back end FFmpeg reads video files,
// and sequences if no back end is given. It does not suit raw frames. In OpenCV 4.6 it converts frames to 8-bit colour
// in spite of CAP_PROP_CONVERT_RGB, and this program rejects them. In 4.14 and 5.0 it reduces frames from 16 to 8 bits
// with only a warning. No camera was tested.

#include "opencv/MatImage.h"
#include "opencv/MatStackSource.h"
#include "sensornoise/Report.h"
#include "sensornoise/ReportText.h"
#include "sensornoise/NoiseModel.h"
#include "tools/ErrorSentence.h"
#include "tools/FilesInUse.h"
#include "tools/PendingFile.h"
#include "itkSensorNoiseEstimator.h"

#include <algorithm>
#include <cstddef>
#include <exception>
#include <iostream>
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <string>
#include <vector>
#ifdef SENSORNOISE_VIDEOIO
#  include <opencv2/videoio.hpp>
#endif

namespace
{
using namespace sensornoise::opencv;

std::vector<cv::Mat>
ReadImages(const std::vector<std::string> & names)
{
  std::vector<cv::Mat> frames;
  for (const std::string & name : names)
  {
    frames.push_back(cv::imread(name, cv::IMREAD_UNCHANGED)); // IMREAD_UNCHANGED keeps 16 bits
    RequireRaw(frames.back(), name);
  }
  return frames;
}

#ifdef SENSORNOISE_VIDEOIO
cv::VideoCapture
OpenVideo(const std::string & name)
{
  cv::VideoCapture video;
  const bool       isNumber = name.find_first_not_of("0123456789") == std::string::npos;
  const bool       isImages = name.find('%') != std::string::npos || cv::haveImageReader(name);
  // without a back end given, OpenCV also uses FFmpeg for images
  if (!(isNumber ? video.open(std::stoi(name)) : video.open(name, isImages ? cv::CAP_IMAGES : cv::CAP_ANY)))
  {
    throw std::runtime_error(name + " cannot be opened as a video; expected a file, the first image of a "
                                    "sequence, a pattern like frame_%03d.png, or the number of a camera");
  }
  return video;
}
#endif

std::vector<cv::Mat>
ReadVideo([[maybe_unused]] const std::string & name)
{
#ifdef SENSORNOISE_VIDEOIO
  constexpr std::size_t most = 100;
  cv::VideoCapture      video = OpenVideo(name);
  const bool            isLeftAsItIs = video.set(cv::CAP_PROP_CONVERT_RGB, 0.0);
  // Does not change the pixels.
  const bool           isImages = static_cast<int>(video.get(cv::CAP_PROP_BACKEND)) == cv::CAP_IMAGES;
  std::vector<cv::Mat> frames;
  for (cv::Mat frame; frames.size() < most && video.read(frame); frame = cv::Mat())
  {
    if (!isLeftAsItIs && !isImages && frame.channels() != 1)
    {
      throw std::runtime_error(
        name + " is made colour by OpenCV " CV_VERSION "'s " + video.getBackendName() +
        ", which has no CAP_PROP_CONVERT_RGB; expected raw frames, for example PNG or TIFF files by a "
        "pattern like frame_%03d.png");
    }
    RequireRaw(frame, name);
    frames.push_back(frame); // a new Mat for each frame: read() would overwrite the last frame
  }
  if (frames.empty())
  {
    throw std::runtime_error(name + " has no frame that can be read");
  }
  return frames;
#else
  throw std::runtime_error("--video needs OpenCV's module videoio, which this program was built without");
#endif
}

template <typename TPixel>
sensornoise::Report
Estimate(const std::vector<cv::Mat> & frames)
{
  const auto source = MatStackSource<TPixel>::New();
  source->SetFrames(frames);
  const auto estimator = itk::SensorNoiseEstimator<itk::Image<TPixel, 3>>::New();
  estimator->SetInput(source->GetOutput());
  estimator->Update();
  return estimator->GetReport();
}

sensornoise::Report
EstimateOf(const std::vector<cv::Mat> & frames)
{
  switch (frames.front().depth())
  {
    case CV_8U:
      return Estimate<unsigned char>(frames);
    case CV_16U:
      return Estimate<unsigned short>(frames);
    case CV_16S:
      return Estimate<short>(frames);
    case CV_32F:
      return Estimate<float>(frames);
    default:
      return Estimate<double>(frames);
  }
}

/** Stabilises a frame in the memory of the Mat, so that its noise has variance 1. */
void
StabiliseInPlace(cv::Mat & frame, const sensornoise::NoiseModel & model)
{
  const sensornoise::GeneralizedAnscombe transform(model);
  for (int y = 0; y < frame.rows; ++y)
  {
    transform.Stabilise(frame.ptr<float>(y), static_cast<std::size_t>(frame.cols), frame.ptr<float>(y));
  }
}

/** Returns the standard deviation of the noise of a stabilised frame [1]; it is 1 if the model is right. It is
 * estimated from the difference to the next frame, and how this differs between neighbouring pixels, so that flicker
 * cancels. The median excludes edges. */
double
StabilisedNoise(const std::vector<cv::Mat> & frames, const sensornoise::NoiseModel & model)
{
  cv::Mat one;
  cv::Mat two;
  frames[0].convertTo(one, CV_32F);
  frames[1].convertTo(two, CV_32F);
  StabiliseInPlace(one, model);
  StabiliseInPlace(two, model);
  const cv::Mat      difference = two - one;
  const cv::Mat      steps = cv::abs(difference.colRange(1, one.cols) - difference.colRange(0, one.cols - 1));
  std::vector<float> sizes(steps.begin<float>(), steps.end<float>());
  const auto         middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  constexpr double medianOfNormal = 0.6745; // median of the absolute value of a standard normal number
  return *middle / medianOfNormal / 2.0;    // the difference has the noise of four pixels
}

void
Run(const std::vector<std::string> & arguments)
{
  const bool isVideo = arguments.size() == 3 && arguments[1] == "--video";
  if (arguments.size() < 3)
  {
    throw std::runtime_error("expected REPORT.json FRAME FRAME..., or REPORT.json --video FILE|PATTERN|NUMBER");
  }
  sensornoise::tools::RequireReportName(arguments[0], "the report");
  sensornoise::tools::PendingFile file(arguments[0]);
  const std::vector<cv::Mat>      frames =
    isVideo ? ReadVideo(arguments[2]) : ReadImages({ arguments.begin() + 1, arguments.end() });
  const sensornoise::Report report = EstimateOf(frames);
  file.Write(sensornoise::ToJson(report));
  file.Commit();
  const sensornoise::NoiseModel model = sensornoise::NoiseModelOf(report);
  std::cout << "variance = " << model.varianceSlopeDn << " DN/e- x level + " << model.totalInterceptDn2 << " DN^2\n"
            << "noise of a stabilised frame: " << StabilisedNoise(frames, model) << '\n';
}
} // namespace

int
main(int argc, char * argv[])
{
  try
  {
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_ERROR); // a missing file is reported below
    Run({ argv + 1, argv + argc });
    return 0;
  }
  catch (const std::exception & error)
  {
    std::cerr << "error: " << sensornoise::tools::SentenceOf(error) << '\n';
  }
  return 2;
}
