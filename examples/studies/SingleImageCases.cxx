// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
// Measures the single-image method on one frame of the cameras of Sur and Grediac 2015: on scenes without texture, on
// the same target with a sensor that clips at both ends, on textures, and on one image composed of all frames of a
// burst.

#include "sensornoise/SimulationSettings.h"
#include "sensornoise/Simulator.h"
#include "sensornoise/SingleImageMethod.h"
#include "studies/MeasuredStack.h"
#include "studies/RenderedStack.h"
#include "studies/StudyCase.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace sensornoise::tools
{
namespace
{
constexpr std::size_t PaperSize = 512; // [pixels]
constexpr std::size_t PaperFrames = 100;
constexpr std::size_t SceneSize = 384; // [pixels], for the scenes that are not from the paper
// Levels of the sensor that clips, in fractions of the signal of the brightest pixel: about a third of the range is
// lost.
constexpr double ClipLow = 1.0 / 60.0;
constexpr double ClipHigh = 0.7;
constexpr double TextureBlurs[] = { 0.5, 1.0, 2.0, 4.0 }; // standard deviations of the optical blur [pixels]
constexpr double TwoPi = 6.283185307179586;
constexpr double WavePeriodX = 128.0; // [pixels]
constexpr double WavePeriodY = 192.0; // [pixels]

/** Scene, camera and clipping of the frames of a case. */
struct ImageCase
{
  std::string scene;
  char        camera{ 'B' };
  int         condition{ 3 };
  std::size_t size{ SceneSize }; ///< [pixels]
  double      blurPixels{ 0.5 }; ///< the paper has 0.5
  bool        isClipped{ false };
  bool        isComposite{ false };
};

/** Returns a scene without texture between 0 and 1: a ramp along x, or waves that are smooth in both directions. */
std::vector<double>
MakeSmoothScene(bool isRamp, std::size_t size)
{
  std::vector<double> scene(size * size);
  for (std::size_t p = 0; p < scene.size(); ++p)
  {
    const auto x = static_cast<double>(p % size);
    const auto y = static_cast<double>(p / size);
    scene[p] = isRamp ? x / static_cast<double>(size - 1)
                      : 0.5 + 0.25 * std::sin(TwoPi * x / WavePeriodX) + 0.25 * std::sin(TwoPi * y / WavePeriodY);
  }
  return scene;
}

std::vector<double>
MakeScene(const std::string & name, std::size_t size)
{
  return name == "target"    ? MakeTargetScene(size, size)
         : name == "texture" ? MakeTextureScene(size, size)
         : name == "bars"    ? MakeBarsScene(size, size)
                             : MakeSmoothScene(name == "ramp", size);
}

/** Returns one image in which the first side * side frames of a burst stand side by side, as Sur and Grediac composed
 * it for the program of Foi et al. (section 4 of their paper). */
std::vector<std::uint16_t>
Compose(const std::vector<std::uint16_t> & stack, std::size_t size, std::size_t side)
{
  std::vector<std::uint16_t> image(size * size * side * side);
  for (std::size_t row = 0; row < size * side * side; ++row)
  {
    const std::size_t t = row / size;
    const std::size_t y = t / side * size + row % size;
    std::copy_n(stack.data() + row * size, size, image.data() + (y * side + t % side) * size);
  }
  return image;
}

std::vector<nlohmann::ordered_json>
MeasureCase(const ImageCase & one, const StudyOptions & options, std::uint64_t seed)
{
  const std::size_t  size = options.size.value_or(one.size);
  const auto         root = std::sqrt(static_cast<double>(options.frames.value_or(PaperFrames)));
  const std::size_t  side = one.isComposite ? static_cast<std::size_t>(root) : 1;
  SimulationSettings settings;
  settings.camera = PaperCamera(one.camera);
  settings.conditions = PaperConditions(one.condition);
  settings.opticalBlurPixels = one.blurPixels;
  settings.frames = side * side;
  settings.seed = seed;
  const CameraModel & camera = settings.camera;
  const double        gain = camera.gainDnPerElectron;
  if (one.isClipped)
  {
    settings.clipLowDn = std::round(camera.offsetDn + ClipLow * gain * camera.electrons);
    settings.clipHighDn = std::round(camera.offsetDn + ClipHigh * gain * camera.electrons);
  }
  const StackSimulator simulator(MakeScene(one.scene, size), size, size, settings);
  const auto           image = Compose(RenderStack(simulator, size, size, settings.frames), size, side);

  SingleImageMethod<std::uint16_t> method({}, { size * side, size * side, 1 }, 1);
  method.AddFrames(image.data(), 1);
  const double intercept = camera.readNoiseDn * camera.readNoiseDn - gain * camera.offsetDn;
  return { { { "truth", { { "gain", gain }, { "intercept", intercept } } },
             { "report", MeasuredStack{ method.GetReports().front(), {} }.ReportRecord() } } };
}

void
Append(std::vector<StudyCase> & cases, const std::string & what, const std::string & place, const ImageCase & one)
{
  cases.push_back({ "single/" + place, what, [=](const StudyOptions & options, std::uint64_t seed) {
                     return MeasureCase(one, options, seed);
                   } });
}
} // namespace

void
AppendSingleImageCases(std::vector<StudyCase> & cases)
{
  for (const char camera : { 'A', 'B', 'C' })
  {
    for (const int condition : { 1, 2, 3 })
    {
      const std::string experiment = camera + std::to_string(condition);
      ImageCase         one{ "target", camera, condition, PaperSize };
      Append(cases, "one frame of the paper's simulation", experiment + "/target", one);
      one.isComposite = true;
      for (const char * scene : { "target", "texture" })
      {
        one.scene = scene;
        Append(cases, "all frames as one image, as in the paper", experiment + " composite/" + scene, one);
      }
    }
    for (const char * scene : { "target", "bars", "ramp", "waves" })
    {
      Append(cases, "scene without texture", std::string(1, camera) + "/" + scene, { scene, camera });
    }
    ImageCase clipped{ "target", camera };
    clipped.isClipped = true;
    Append(cases, "sensor that clips at both ends", std::string(1, camera) + " clipped/target", clipped);
    for (const double blur : TextureBlurs)
    {
      ImageCase textured{ "texture", camera };
      textured.blurPixels = blur;
      const std::string text = blur < 1.0 ? "0.5" : std::to_string(static_cast<int>(blur));
      Append(cases, "texture behind a blur", std::string(1, camera) + " blur " + text + "/texture", textured);
    }
  }
}

} // namespace sensornoise::tools
