/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
// Simulates a burst of raw frames with known noise, and writes what an estimator should find beside it:
//   simulate-sensor-noise --output stack.mha --truth truth.json --reference target --camera B --condition 3

#include "itkSensorNoiseStackSource.h"

#include "itkImageFileReader.h"
#include "itkImageFileWriter.h"
#include "itkImageIOFactory.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <optional>
#include <random>
#include <regex>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace
{
namespace fs = std::filesystem;
using ReferenceType = itk::Image<double, 2>;
using StackType = itk::Image<unsigned short, 3>;
using SourceType = itk::SensorNoiseStackSource<StackType>;

/** A file that appears under its own name only once it is complete: written under a temporary name in the same folder
 * (same extension, by which ITK knows the format), removed unless Commit() is called. */
class PendingFile
{
public:
  explicit PendingFile(fs::path target)
    : m_Target(std::move(target))
  {
    const fs::path folder = m_Target.has_parent_path() ? m_Target.parent_path() : fs::path(".");
    if (!fs::is_directory(folder))
    {
      throw std::runtime_error("cannot write " + m_Target.string() + ": there is no folder " + folder.string());
    }
    if (fs::is_directory(m_Target))
    {
      throw std::runtime_error("cannot write " + m_Target.string() + ": it is a folder");
    }
    const std::string unique = std::to_string(std::random_device{}());
    m_Temporary = folder / ("." + m_Target.stem().string() + "." + unique + m_Target.extension().string());
    if (!std::ofstream(m_Temporary))
    {
      throw std::runtime_error("cannot write " + m_Target.string() + ": no file can be made in folder " +
                               folder.string());
    }
  }
  PendingFile(const PendingFile &) = delete;
  PendingFile &
  operator=(const PendingFile &) = delete;
  ~PendingFile()
  {
    std::error_code ignored;
    fs::remove(m_Temporary, ignored);
  }
  const fs::path &
  Temporary() const
  {
    return m_Temporary;
  }
  void
  Commit()
  {
    fs::rename(m_Temporary, m_Target);
  }

private:
  fs::path m_Target;
  fs::path m_Temporary;
};

struct Options
{
  std::string           output;
  std::string           truth;
  std::string           reference{ "target" };
  std::string           size;
  std::string           camera{ "B" };
  int                   condition{ 3 };
  std::optional<double> gain;
  std::optional<double> offset;
  std::optional<double> readNoise;
  std::optional<double> electrons;
  std::optional<double> flickerSd;
  std::vector<double>   vibrationSd;
  std::vector<double>   clip;
  double                rollingShutterPeriod{ 0.0 };
  unsigned int          frames{ 100 };
  unsigned int          bitDepth{ 12 };
  std::uint64_t         seed{ 1 };
};

ReferenceType::Pointer
MakeImage(const std::vector<double> & values, std::size_t width, std::size_t height)
{
  auto                    image = ReferenceType::New();
  ReferenceType::SizeType size;
  size[0] = width;
  size[1] = height;
  image->SetRegions(ReferenceType::RegionType(size));
  image->Allocate();
  std::copy(values.begin(), values.end(), image->GetBufferPointer());
  return image;
}

/** ITK's readers turn colour into grey and take the first slice of a volume without a word; the header tells. */
ReferenceType::Pointer
ReadReference(const std::string & name)
{
  if (!fs::is_regular_file(name))
  {
    throw std::runtime_error("the reference " + name + " is neither target, bars or texture nor a file");
  }
  const auto io = itk::ImageIOFactory::CreateImageIO(name.c_str(), itk::ImageIOFactory::IOFileModeEnum::ReadMode);
  if (!io)
  {
    throw std::runtime_error("the reference " + name + " is not an image of a format that ITK reads");
  }
  io->SetFileName(name);
  io->ReadImageInformation();
  bool isFlat = true;
  for (unsigned int axis = 2; axis < io->GetNumberOfDimensions(); ++axis)
  {
    isFlat = isFlat && io->GetDimensions(axis) == 1;
  }
  if (io->GetNumberOfComponents() != 1 || !isFlat)
  {
    throw std::runtime_error("the reference " + name + " has " + std::to_string(io->GetNumberOfComponents()) +
                             " components and " + std::to_string(io->GetNumberOfDimensions()) +
                             " dimensions; expected one grey image");
  }
  const auto reader = itk::ImageFileReader<ReferenceType>::New();
  reader->SetFileName(name);
  reader->Update();
  return reader->GetOutput();
}

ReferenceType::Pointer
MakeReference(const Options & options)
{
  const bool isScene = options.reference == "target" || options.reference == "bars" || options.reference == "texture";
  if (!isScene)
  {
    if (!options.size.empty())
    {
      throw std::runtime_error(
        "--size is for the scenes target, bars and texture; a reference file keeps its own size");
    }
    return ReadReference(options.reference);
  }
  const std::string size = options.size.empty() ? "512x512" : options.size;
  std::smatch       match;
  if (!std::regex_match(size, match, std::regex("([0-9]{1,5})x([0-9]{1,5})")))
  {
    throw std::runtime_error("the size is \"" + size + "\"; expected WIDTHxHEIGHT in pixels, for example 512x512");
  }
  const std::size_t width = std::stoul(match[1]);
  const std::size_t height = std::stoul(match[2]);
  if (options.reference == "target")
  {
    return MakeImage(sensornoise::MakeTargetScene(width, height), width, height);
  }
  return MakeImage(options.reference == "bars" ? sensornoise::MakeBarsScene(width, height)
                                               : sensornoise::MakeTextureScene(width, height),
                   width,
                   height);
}

SourceType::Pointer
MakeSource(const Options & options)
{
  auto source = SourceType::New();
  if (options.camera.size() != 1)
  {
    throw std::runtime_error("camera \"" + options.camera + "\" is not known; expected A, B or C");
  }
  const sensornoise::CameraModel     camera = sensornoise::PaperCamera(options.camera[0]);
  const sensornoise::SceneConditions conditions = sensornoise::PaperConditions(options.condition);
  source->SetElectrons(options.electrons.value_or(camera.electrons));
  source->SetGain(options.gain.value_or(camera.gainDnPerElectron));
  source->SetOffset(options.offset.value_or(camera.offsetDn));
  source->SetReadNoise(options.readNoise.value_or(camera.readNoiseDn));
  source->SetFlickerSd(options.flickerSd.value_or(conditions.flickerSd));
  source->SetVibrationSdX(options.vibrationSd.empty() ? conditions.vibrationSdXPixels : options.vibrationSd[0]);
  source->SetVibrationSdY(options.vibrationSd.empty() ? conditions.vibrationSdYPixels : options.vibrationSd[1]);
  source->SetRollingShutterPeriod(options.rollingShutterPeriod);
  source->SetNumberOfFrames(options.frames);
  source->SetBitDepth(options.bitDepth);
  source->SetSeed(options.seed);
  if (!options.clip.empty())
  {
    source->SetClipLow(options.clip[0]);
    source->SetClipHigh(options.clip[1]);
  }
  source->SetReference(MakeReference(options));
  return source;
}

/** Numbers that do not exist (a standard deviation of one frame) are NaN here and null in the file. */
nlohmann::ordered_json
TruthAsJson(const Options & options, const SourceType & source)
{
  const sensornoise::SimulationTruth &    truth = source.GetTruth();
  const sensornoise::SimulationSettings & settings = truth.settings;
  const sensornoise::CameraModel &        camera = settings.camera;
  const auto                              size = source.GetOutput()->GetLargestPossibleRegion().GetSize();
  const double intercept = camera.readNoiseDn * camera.readNoiseDn - camera.gainDnPerElectron * camera.offsetDn;
  const bool   isPaperCamera = !options.gain && !options.offset && !options.readNoise && !options.electrons;
  const bool   isPaperCondition = !options.flickerSd && options.vibrationSd.empty();

  nlohmann::ordered_json json;
  json["schema"] = "itk-sensornoise-truth/1";
  json["reference"] = options.reference;
  json["camera"] = isPaperCamera ? nlohmann::ordered_json(options.camera) : nullptr;
  json["condition"] = isPaperCondition ? nlohmann::ordered_json(options.condition) : nullptr;
  json["frames"] = size[2];
  json["width"] = size[0];
  json["height"] = size[1];
  json["bit_depth"] = settings.bitDepth;
  json["seed"] = settings.seed;
  json["electrons"] = camera.electrons;
  json["gain"] = camera.gainDnPerElectron;
  json["offset"] = camera.offsetDn;
  json["read_noise"] = camera.readNoiseDn;
  json["intercept"] = intercept;
  json["total_intercept"] = intercept + 1.0 / 12.0; // rounding to whole codes
  json["clip_low"] = settings.clipLowDn ? nlohmann::ordered_json(*settings.clipLowDn) : nullptr;
  json["clip_high"] = settings.clipHighDn ? nlohmann::ordered_json(*settings.clipHighDn) : nullptr;
  json["optical_blur"] = settings.opticalBlurPixels;
  json["rolling_shutter_period"] = settings.rollingShutterPeriodRows;
  json["flicker_sd"] = settings.conditions.flickerSd;
  json["vibration_sd"] = { settings.conditions.vibrationSdXPixels, settings.conditions.vibrationSdYPixels };
  json["realised_flicker_sd"] = truth.realisedFlickerSd;
  json["realised_vibration_sd"] = { truth.realisedVibrationSdXPixels, truth.realisedVibrationSdYPixels };
  json["flicker"] = truth.normalisedFlicker;
  json["gamma"] = truth.series.gamma;
  json["alpha"] = truth.series.alpha;
  json["beta"] = truth.series.beta;
  json["phase"] = settings.rollingShutterPeriodRows > 0.0 ? nlohmann::ordered_json(truth.series.phase) : nullptr;
  return json;
}

void
WriteStack(SourceType & source, const fs::path & name, const std::string & target)
{
  constexpr std::uint64_t chunkBytes = 64 * 1024 * 1024;
  const auto              pixels = source.GetOutput()->GetLargestPossibleRegion().GetNumberOfPixels();
  const auto              writer = itk::ImageFileWriter<StackType>::New();
  writer->SetInput(source.GetOutput());
  writer->SetFileName(name.string());
  writer->SetNumberOfStreamDivisions(static_cast<unsigned int>(1 + pixels * sizeof(StackType::PixelType) / chunkBytes));
  writer->Update();
  // ITK's MetaImage writer does not look whether the disk was full; no format here compresses.
  if (fs::file_size(name) < pixels * sizeof(StackType::PixelType))
  {
    throw std::runtime_error("cannot write " + target + ": the disk may be full");
  }
}

void
Run(const Options & options)
{
  std::string extension = fs::path(options.output).extension().string();
  std::transform(
    extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return std::tolower(c); });
  const std::vector<std::string> known{ ".mha", ".nrrd", ".tif", ".tiff" };
  if (std::find(known.begin(), known.end(), extension) == known.end())
  {
    throw std::runtime_error("the output is " + options.output +
                             "; expected a name that ends in .mha, .nrrd, .tif or " + ".tiff");
  }
  if (!options.truth.empty() && fs::absolute(options.truth) == fs::absolute(options.output))
  {
    throw std::runtime_error("--output and --truth are the same file, " + options.output);
  }
  const auto source = MakeSource(options);
  source->UpdateOutputInformation();

  PendingFile                stack(options.output);
  std::optional<PendingFile> truth;
  if (!options.truth.empty())
  {
    truth.emplace(options.truth);
    std::ofstream file(truth->Temporary());
    file << TruthAsJson(options, *source).dump(1) << '\n';
    file.close();
    if (!file)
    {
      throw std::runtime_error("cannot write " + options.truth + ": the disk may be full");
    }
  }
  WriteStack(*source, stack.Temporary(), options.output);
  stack.Commit();
  if (truth)
  {
    truth->Commit();
  }
}

/** The words of an ITK error, without the class and the address in front and on one line. */
std::string
Sentence(const itk::ExceptionObject & error)
{
  std::string       text = error.GetDescription();
  const std::size_t prefix = text.find("): ");
  text.erase(0, prefix == std::string::npos ? 0 : prefix + 3);
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

} // namespace

int
main(int argc, char * argv[])
{
  Options  options;
  CLI::App app{ "Simulates a burst of raw frames of a camera whose noise is known, under flickering light and on a "
                "trembling floor (Sur and Grediac 2015, section 4.2)." };
  app.option_defaults()->always_capture_default();
  app.add_option("--output", options.output, "Stack to write: .mha (streamed, any length), .nrrd, .tif or .tiff")
    ->required();
  app.add_option("--truth", options.truth, "JSON file to write, with what an estimator should find");
  app.add_option("--reference", options.reference, "Scene: target, bars, texture, or a grey image file");
  app.add_option("--size", options.size, "Width x height of the scene, as 512x512 (the default)");
  app.add_option("--camera", options.camera, "Camera of the paper's Table 1: A, B or C");
  app.add_option("--gain", options.gain, "Gain instead of the camera's [DN/e-]");
  app.add_option("--offset", options.offset, "Offset instead of the camera's [DN]");
  app.add_option("--read-noise", options.readNoise, "Read noise instead of the camera's [DN]");
  app.add_option("--electrons", options.electrons, "Electrons of the brightest pixel instead of the camera's");
  app.add_option("--condition", options.condition, "Light and floor of the paper's Table 1: 1, 2 or 3");
  app.add_option("--flicker-sd", options.flickerSd, "Standard deviation of the flicker instead of the condition's");
  app
    .add_option(
      "--vibration-sd", options.vibrationSd, "Standard deviations X,Y of the shifts instead of the condition's [pixel]")
    ->delimiter(',')
    ->expected(2)
    ->default_str("");
  app.add_option("--rolling-shutter",
                 options.rollingShutterPeriod,
                 "Period of a pulsing lamp in rows of a rolling shutter; 0: the whole frame flickers");
  app.add_option("--frames", options.frames, "Number of frames");
  app.add_option("--bit-depth", options.bitDepth, "Bits of the converter, at most 16; 0: no clipping below 65535");
  app.add_option("--clip", options.clip, "Levels LOW,HIGH between which the sensor itself is limited [DN]")
    ->delimiter(',')
    ->expected(2)
    ->default_str("");
  app.add_option("--seed", options.seed, "Seed of the noise; the scene stays the same");
  try
  {
    app.parse(argc, argv);
    Run(options);
    return 0;
  }
  catch (const CLI::Success & request)
  {
    return app.exit(request); // --help
  }
  catch (const itk::ExceptionObject & error)
  {
    std::cerr << "simulate-sensor-noise: " << Sentence(error) << '\n';
  }
  catch (const std::exception & error)
  {
    std::cerr << "simulate-sensor-noise: " << error.what() << '\n';
  }
  return 2;
}
