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
#ifndef itkSensorNoiseEstimation_h
#define itkSensorNoiseEstimation_h

#include "itkSensorNoiseEstimator.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/Settings.h"
#include "moments/DarkFrames.h"
#include "mosaic/MosaicPasses.h"
#include "published/PublishedPasses.h"
#include "refined/PixelProjections.h"
#include "refined/RefinedPasses.h"
#include "sensornoise/ChannelReports.h"
#include "report/StackReport.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace itk
{

/** Mosaic of a stack, with the source of its pattern. */
struct SensorNoiseMosaic
{
  sensornoise::MosaicGeometry geometry;
  sensornoise::BayerSource    source{ sensornoise::BayerSource::Given };
};

/** Description of the stack that SensorNoiseEstimator measures, with the known offsets. */
struct SensorNoiseStack
{
  sensornoise::FrameGeometry                           frame;
  std::size_t                                          frames{ 0 };
  std::vector<std::uint8_t>                            mask;    ///< nonzero: the pixel is used; empty: all pixels are
  std::optional<SensorNoiseMosaic>                     mosaic;  ///< null: not a mosaic
  std::vector<std::optional<sensornoise::KnownOffset>> offsets; ///< offset of each plane, or of the frame alone
};

/** Method that SensorNoiseEstimator runs, on frames or on the planes of mosaics, with one interface for both. A part is
 * the frame, or a plane of the mosaic. */
template <typename TPixel>
struct SensorNoiseEstimation
{
  using Refined = sensornoise::RefinedPasses<TPixel>;
  using Published = sensornoise::PublishedPasses<TPixel>;
  using MosaicRefined = sensornoise::MosaicPasses<TPixel, Refined>;
  using MosaicPublished = sensornoise::MosaicPasses<TPixel, Published>;
  using DarkMapsPointer = std::shared_ptr<const sensornoise::DarkMaps>;
  using Settings = std::variant<sensornoise::RefinedSettings, sensornoise::PublishedSettings>;
  template <typename T>
  static constexpr bool IsOfWholeFrame = std::is_same_v<T, const Refined &> || std::is_same_v<T, const Published &>;

  std::variant<Refined, Published, MosaicRefined, MosaicPublished> method;
  std::optional<SensorNoiseMosaic>                                 mosaic{};
  std::vector<DarkMapsPointer> dark{}; ///< maps of the dark frames of each part; null: fewer than two frames

  /** Returns the method with these \a settings before its first pass. A memory limit holds for all planes together.
   * \a threads is the number of threads of \a parallelFor. \a withoutMerging declares that no sums are saved or merged,
   * which needs less memory. */
  static SensorNoiseEstimation
  Start(const Settings &                 settings,
        const SensorNoiseStack &         stack,
        const sensornoise::ParallelFor & parallelFor,
        std::size_t                      threads,
        bool                             withoutMerging)
  {
    const auto start = [&](const auto & ofStack) -> decltype(method) {
      constexpr bool isRefined = std::is_same_v<decltype(ofStack), const sensornoise::RefinedSettings &>;
      using OfFrame = std::conditional_t<isRefined, Refined, Published>;
      const auto settingsOf = [&]([[maybe_unused]] std::size_t part) {
        auto ofPart = ofStack;
        if constexpr (isRefined)
        {
          ofPart.offset = stack.offsets[part];
          ofPart.memoryLimitBytes /= static_cast<double>(stack.offsets.size());
        }
        return ofPart;
      };
      if (!stack.mosaic)
      {
        OfFrame ofFrame(settingsOf(0), stack.frame, stack.frames, stack.mask, parallelFor);
        if constexpr (isRefined)
        {
          if (withoutMerging)
          {
            ofFrame.DisableMerging();
          }
        }
        return ofFrame;
      }
      const sensornoise::MosaicGeometry & planes = stack.mosaic->geometry;
      if constexpr (isRefined)
      {
        sensornoise::RequireMemoryLimit(ofStack.memoryLimitBytes, planes.Plane(), stack.frames, stack.offsets.size());
      }
      const std::array ofPlanes{ settingsOf(0), settingsOf(1), settingsOf(2), settingsOf(3) };
      auto             ofMosaic = sensornoise::MakeMosaicPasses<TPixel, OfFrame>(
        ofPlanes, planes, stack.frames, stack.mask, parallelFor, threads);
      if constexpr (isRefined)
      {
        if (withoutMerging)
        {
          using ManySums = typename MosaicRefined::ManySums;
          ofMosaic.DisableMerging(std::isinf(ofStack.memoryLimitBytes) ? std::optional(ManySums{}) : std::nullopt);
        }
      }
      return ofMosaic;
    };
    SensorNoiseEstimation started{ std::visit(start, settings), stack.mosaic };
    for (const auto & offset : stack.offsets)
    {
      started.dark.push_back(offset ? offset->maps : nullptr);
    }
    return started;
  }

  bool
  IsDone() const
  {
    return std::visit([](const auto & atWork) { return atWork.IsDone(); }, method);
  }

  /** Calls function(method) for the method of the frame, or for the methods of the four planes. */
  template <typename TFunction>
  void
  ForEach(TFunction function)
  {
    std::visit(
      [&](auto & atWork) {
        if constexpr (IsOfWholeFrame<const std::remove_reference_t<decltype(atWork)> &>)
        {
          function(atWork);
        }
        else
        {
          for (auto & ofPlane : atWork.GetMethods())
          {
            function(ofPlane);
          }
        }
      },
      method);
  }

  std::size_t
  GetNumberOfParts() const
  {
    return mosaic ? sensornoise::BayerPlanes.size() : 1;
  }

  /** Returns 1 for every frame that was added or merged in the current pass, else 0. */
  const std::vector<std::uint8_t> &
  GetHas() const
  {
    return std::visit([](const auto & atWork) -> const auto & { return atWork.GetHas(); }, method);
  }

  /** Returns the fingerprints of the frames that were added or merged in the first pass, for each part. */
  std::vector<const std::map<std::size_t, sensornoise::BytesFingerprint> *>
  GetFingerprints()
  {
    std::vector<const std::map<std::size_t, sensornoise::BytesFingerprint> *> all;
    this->ForEach([&all](const auto & part) { all.push_back(&part.GetFingerprints().GetAll()); });
    return all;
  }

  /** Sets which frames other processes count. \a flags has \a frames values for each part, one part after the other. */
  void
  SetCountedElsewhere(const unsigned char * flags, std::size_t frames)
  {
    this->ForEach([&](auto & part) {
      part.SetCountedElsewhere({ flags, flags + frames });
      flags += frames;
    });
  }

  void
  MergeSums(std::istream & in)
  {
    std::visit([&in](auto & atWork) { atWork.MergeSums(in); }, method);
    this->ForEach([](auto & part) { part.FoldSums(); });
  }

  /** Returns the report of the stack, or the reports of its channels, with \a selection and \a camera in each. */
  std::variant<sensornoise::Report, sensornoise::ChannelReports>
  GetReport(const sensornoise::StackSelection & selection, const sensornoise::CameraSettings & camera) const
  {
    using Result = std::variant<sensornoise::Report, sensornoise::ChannelReports>;
    return std::visit(
      [&](const auto & atWork) -> Result {
        if constexpr (IsOfWholeFrame<decltype(atWork)>)
        {
          sensornoise::Report report = atWork.GetReport();
          sensornoise::NoteSelection(report, selection);
          report.camera = camera;
          return report;
        }
        else
        {
          std::array<sensornoise::Report, 4> reports = atWork.GetReports();
          for (sensornoise::Report & report : reports)
          {
            sensornoise::NoteSelection(report, selection);
            report.camera = camera;
          }
          return sensornoise::MakeChannelReports(mosaic->geometry.pattern, mosaic->source, std::move(reports));
        }
      },
      method);
  }

  /** Moves a map of \a pixels pixels out of the method and returns it. mapOf(method) calls one of its Take...()
   * functions. Pixels without a value are \a missing. */
  template <typename T, typename TFunction>
  std::vector<T>
  TakeMap(TFunction mapOf, T missing, std::size_t pixels)
  {
    return std::visit(
      [&](auto & atWork) {
        if constexpr (IsOfWholeFrame<decltype(std::as_const(atWork))>)
        {
          std::vector<T> map = mapOf(atWork);
          map.resize(pixels, missing);
          return map;
        }
        else
        {
          return atWork.JoinMaps(mapOf, missing);
        }
      },
      method);
  }

  /** Returns offset and read noise of every pixel from its dark frames; null: there are fewer than two dark frames. */
  std::optional<sensornoise::PixelCalibration>
  MakeCalibration(const sensornoise::ParallelFor & parallelFor) const
  {
    if (dark.empty() || !dark.front())
    {
      return std::nullopt;
    }
    if (!mosaic)
    {
      return sensornoise::MakePixelCalibration(*dark.front(), parallelFor);
    }
    const sensornoise::MosaicGeometry & geometry = mosaic->geometry;
    const std::vector<double>           nothing(geometry.frame.Pixels(), std::numeric_limits<double>::quiet_NaN());
    sensornoise::PixelCalibration       joined{ { nothing, nothing, nothing }, { nothing, nothing, nothing } };
    for (std::size_t k = 0; k < dark.size(); ++k)
    {
      const auto plane = sensornoise::BayerPlanes[k];
      const auto pixels = sensornoise::MakePixelCalibration(*dark[k], parallelFor);
      geometry.Put(pixels.offset.value, plane, joined.offset.value.data());
      geometry.Put(pixels.offset.low, plane, joined.offset.low.data());
      geometry.Put(pixels.offset.high, plane, joined.offset.high.data());
      geometry.Put(pixels.readNoise.value, plane, joined.readNoise.value.data());
      geometry.Put(pixels.readNoise.low, plane, joined.readNoise.low.data());
      geometry.Put(pixels.readNoise.high, plane, joined.readNoise.high.data());
    }
    return joined;
  }
};

/** Method of the estimator. The header of the estimator only declares it, so that users need no header of a method. */
template <typename TStack>
struct SensorNoiseEstimator<TStack>::Estimation : SensorNoiseEstimation<typename TStack::PixelType>
{};

} // namespace itk

#endif
