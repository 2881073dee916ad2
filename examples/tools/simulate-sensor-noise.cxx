// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
// Simulates a burst of raw frames with known noise, and writes the true values for an estimator as a second file:
//   simulate-sensor-noise --output stack.mha --truth truth.json --reference target --camera B --condition 3

#include "base/FreeMemory.h"
#include "sensornoise/SimulationSettings.h"
#include "sensornoise/FrameFile.h"
#include "simulation/SimulatedSensor.h"
#include "tools/ErrorSentence.h"
#include "tools/FilesInUse.h"
#include "tools/ImageOnFile.h"
#include "tools/LowerCase.h"
#include "tools/PendingFile.h"
#include "tools/SimulateOptions.h"
#include "tools/WriterErrors.h"
#include "itkSensorNoiseChunks.h"
#include "itkSensorNoiseFrameFiles.h"
#include "itkSensorNoiseSceneSource.h"
#include "itkSensorNoiseStackSource.h"
#include "itkImageFileWriter.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{
namespace fs = std::filesystem;
using namespace sensornoise::tools;
using ReferenceType = itk::Image<double, 2>;
using StackType = itk::Image<unsigned short, 3>;
using SourceType = itk::SensorNoiseStackSource<StackType>;

/** Reads a scene from a file, which must hold one image. The pixels are checked as the pixels of frames are. */
ReferenceType::Pointer
ReadReference(const std::string & name)
{
  if (!fs::exists(name))
  {
    throw std::runtime_error("the reference " + name + " is neither target, bars, texture or flat nor a file");
  }
  try
  {
    const sensornoise::FrameList list = sensornoise::OpenFrames({ name });
    if (list.isStack)
    {
      throw sensornoise::FileError(name, "has " + std::to_string(list.frames) + " frames; expected one image");
    }
    return ReadImage(list);
  }
  catch (const sensornoise::FileError & error)
  {
    throw std::runtime_error(std::string("the reference ") + error.what());
  }
}

bool
IsScene(const std::string & reference)
{
  return reference == "target" || reference == "bars" || reference == "texture" || reference == "flat";
}

ReferenceType::Pointer
MakeReference(const SimulateOptions & options)
{
  if (!IsScene(options.reference))
  {
    if (!options.size.empty())
    {
      throw std::runtime_error(
        "--size is for the scenes target, bars, texture and flat; a reference file keeps its own size");
    }
    return ReadReference(options.reference);
  }
  const std::string size = options.size.empty() ? "512x512" : options.size;
  std::smatch       match;
  if (!std::regex_match(size, match, std::regex("([0-9]{1,5})x([0-9]{1,5})")))
  {
    throw std::runtime_error("the size is \"" + size + "\"; expected WIDTHxHEIGHT in pixels, for example 512x512");
  }
  auto scene = itk::SensorNoiseSceneSource<ReferenceType>::New();
  scene->SetScene(options.reference);
  scene->SetWidth(std::stoul(match[1]));
  scene->SetHeight(std::stoul(match[2]));
  scene->Update();
  return scene->GetOutput();
}

/** Reads the numbers of a text file, which are separated by white space or commas. */
std::vector<double>
ReadFactors(const std::string & name)
{
  std::ifstream file(name);
  if (!file)
  {
    throw std::runtime_error("the illumination \"" + name + "\" is no file that can be read, and no known shape; " +
                             "expected steady, pulses, ramp, decay, sine, uniform or exponential, or a text file with "
                             "one factor a frame");
  }
  std::string text{ std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>() };
  std::replace(text.begin(), text.end(), ',', ' ');
  std::istringstream  words(text);
  std::vector<double> factors;
  for (std::string word; words >> word;)
  {
    char * end = nullptr;
    factors.push_back(std::strtod(word.c_str(), &end));
    if (*end != '\0')
    {
      throw std::runtime_error("the illumination file " + name + " has \"" + word.substr(0, 40) + "\" as number " +
                               std::to_string(factors.size()) + "; expected one illumination factor a frame");
    }
  }
  return factors;
}

SourceType::Pointer
MakeSource(const SimulateOptions & options)
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
  source->SetOpticalBlur(options.opticalBlur);
  source->SetRollingShutterPeriod(options.rollingShutterPeriod);
  if (sensornoise::IsIlluminationName(options.illumination))
  {
    source->SetIllumination(options.illumination);
  }
  else
  {
    source->SetIlluminationFactors(ReadFactors(options.illumination));
  }
  source->SetNumberOfFrames(options.frames);
  source->SetBitDepth(options.bitDepth);
  source->SetSeed(options.seed);
  if (!options.clip.empty())
  {
    source->SetClipLow(options.clip[0]);
    source->SetClipHigh(options.clip[1]);
  }
  options.flaws.ApplyTo(*source);
  source->SetReference(MakeReference(options));
  return source;
}

/** Returns the truth as JSON, with the scene, camera and condition of the command line. Camera or condition is null
 * if one of its values was replaced. */
nlohmann::ordered_json
TruthAsJson(const SimulateOptions & options, const SourceType & source)
{
  auto       json = nlohmann::ordered_json::parse(source.GetTruthAsJson());
  const bool isPaperCamera = !options.gain && !options.offset && !options.readNoise && !options.electrons;
  const bool isPaperCondition = !options.flickerSd && options.vibrationSd.empty() && options.illumination == "steady";
  json["reference"] = options.reference;
  json["camera"] = isPaperCamera ? nlohmann::ordered_json(options.camera) : nullptr;
  json["condition"] = isPaperCondition ? nlohmann::ordered_json(options.condition) : nullptr;
  return json;
}

/** Throws if the stack does not fit on the disk. A stack that is not written in parts must fit in memory as well. */
void
RequireRoom(const SourceType & source, const PendingFile & file)
{
  const auto   size = source.GetOutput()->GetLargestPossibleRegion().GetSize();
  const double bytes = sizeof(StackType::PixelType) * static_cast<double>(size[0]) * static_cast<double>(size[1]) *
                       static_cast<double>(size[2]);
  file.RequireRoom(bytes);
  if (LowerCaseEnding(file.Target().name) != ".mha")
  {
    sensornoise::RequireMemory(bytes, "a stack that is not written in parts, as .mha is,");
  }
}

void
WriteStack(SourceType & source, const PendingFile & file)
{
  const auto pixels = source.GetOutput()->GetLargestPossibleRegion().GetNumberOfPixels();
  const auto writer = itk::ImageFileWriter<StackType>::New();
  writer->SetInput(source.GetOutput());
  writer->SetFileName(file.Temporary().string());
  writer->SetNumberOfStreamDivisions(
    static_cast<unsigned int>(1 + pixels * sizeof(StackType::PixelType) / itk::SensorNoiseChunkBytes));
  WriteNamed(file, [&] { writer->Update(); });
  file.RequireBytes(pixels * sizeof(StackType::PixelType)); // the formats are not compressed
}

/** Throws if an output is also an input or another output. It must be called before anything is read. */
void
RequireOutputsApart(const SimulateOptions & options)
{
  FilesInUse files;
  if (!IsScene(options.reference))
  {
    files.Read(options.reference, "the reference");
  }
  if (!sensornoise::IsIlluminationName(options.illumination))
  {
    files.Read(options.illumination, "--illumination");
  }
  files.Write(options.output, "--output");
  if (!options.truth.empty())
  {
    RequireReportName(options.truth, "--truth");
    files.Write(options.truth, "--truth");
  }
}

void
Run(const SimulateOptions & options)
{
  const std::string              extension = LowerCaseEnding(options.output);
  const std::vector<std::string> known{ ".mha", ".nrrd", ".tif", ".tiff" };
  if (std::find(known.begin(), known.end(), extension) == known.end())
  {
    throw std::runtime_error("the output is " + options.output +
                             "; expected a name that ends in .mha, .nrrd, .tif or .tiff");
  }
  RequireOutputsApart(options);
  PendingFile                stack(options.output);
  std::optional<PendingFile> truth;
  if (!options.truth.empty())
  {
    truth.emplace(options.truth);
  }
  const auto source = MakeSource(options);
  source->UpdateOutputInformation();
  RequireRoom(*source, stack);
  if (truth)
  {
    truth->Write(TruthAsJson(options, *source).dump(1) + '\n');
  }
  WriteStack(*source, stack);
  stack.Commit();
  if (truth)
  {
    truth->Commit();
  }
}
} // namespace

int
main(int argc, char * argv[])
{
  SimulateOptions options;
  try
  {
    if (options.Parse(argc, argv))
    {
      Run(options);
    }
    return 0;
  }
  catch (const std::exception & error)
  {
    std::cerr << "simulate-sensor-noise: " << SentenceOf(error) << '\n';
  }
  return 2;
}
