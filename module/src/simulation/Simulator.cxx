// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Simulator.h"

#include "sensornoise/FrameGeometry.h"
#include "base/Text.h"
#include "simulation/SimulatedSensor.h"
#include "simulation/FrameProcessing.h"
#include "simulation/Random.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace sensornoise
{

/** The scene on the sensor, the read-out, and the state of the temporal filter. */
struct StackSimulator::Sensor
{
  ExpectedSignal                  scene;
  ReadOut                         readOut;
  std::shared_ptr<TemporalFilter> temporalFilter;
};

StackSimulator::StackSimulator(const std::vector<double> & reference,
                               std::size_t                 width,
                               std::size_t                 height,
                               const SimulationSettings &  settings)
  : m_Width(width)
  , m_Height(height)
  , m_Truth(DrawTruth(settings, height))
  , m_Sensor(std::make_shared<const Sensor>(Sensor{ ExpectedSignal(reference, width, height, settings),
                                                    ReadOut(settings, width, height),
                                                    std::make_shared<TemporalFilter>(settings.flaws.temporalFilter) }))
{
  const std::vector<double> & gamma = m_Truth.series.gamma;
  m_MeanBrightness = 1.0 + std::accumulate(gamma.begin(), gamma.end(), 0.0) / static_cast<double>(gamma.size());
  const auto readNoise = m_Sensor->readOut.SummariseReadNoise();
  m_Truth.realisedReadNoiseRmsDn = readNoise.rmsDn;
  m_Truth.realisedReadNoiseMedianDn = readNoise.medianDn;
}

void
StackSimulator::RequireRow(std::size_t frame, std::size_t y) const
{
  if (frame >= m_Truth.settings.frames || y >= m_Height)
  {
    throw std::invalid_argument("row " + std::to_string(y) + " of frame " + std::to_string(frame) +
                                " was asked for; expected a row below " + std::to_string(m_Height) +
                                " and a frame below " + std::to_string(m_Truth.settings.frames));
  }
}

void
StackSimulator::ExpectedElectronsRow(std::size_t frame, std::size_t y, double * electrons) const
{
  RequireRow(frame, y);
  m_Sensor->scene.ExpectedElectronsRow(m_Truth, frame, y, electrons);
}

double
StackSimulator::LocalGainAt(std::size_t pixel) const
{
  return m_Sensor->readOut.LocalGainAt(pixel, m_Sensor->scene.ElectronsAtRest(pixel, m_MeanBrightness));
}

double
StackSimulator::PixelReadNoiseDn(std::size_t pixel) const
{
  return m_Sensor->readOut.PixelReadNoiseDn(pixel);
}

double
StackSimulator::PixelOffsetDn(std::size_t pixel) const
{
  return m_Sensor->readOut.PixelOffsetDn(pixel);
}

bool
StackSimulator::NeedsWholeFrames() const
{
  return sensornoise::NeedsWholeFrames(m_Truth.settings.flaws);
}

template <typename TPixel>
std::pair<double, double>
StackSimulator::PixelRangeDn(const SimulationSettings & settings)
{
  static_assert(std::is_arithmetic_v<TPixel>, "a frame holds integer or floating-point numbers");
  using Limits = std::numeric_limits<TPixel>;
  double low = settings.clipLowDn.value_or(-std::numeric_limits<double>::infinity());
  double high = settings.clipHighDn.value_or(std::numeric_limits<double>::infinity());
  if constexpr (std::is_integral_v<TPixel>)
  {
    static_assert(Limits::digits <= 32, "digital numbers of more than 32 bits are not represented exactly");
    const auto bits = static_cast<int>(settings.bitDepth);
    if (bits > Limits::digits)
    {
      throw std::invalid_argument("the bit depth is " + std::to_string(bits) + "; the pixel type holds at most " +
                                  std::to_string(Limits::digits) + " bits");
    }
    low = std::max(std::ceil(low), bits == 0 ? static_cast<double>(Limits::lowest()) : 0.0);
    high = std::min(std::floor(high), bits == 0 ? static_cast<double>(Limits::max()) : std::ldexp(1.0, bits) - 1.0);
    if (!(low < high))
    {
      throw std::invalid_argument("the clip levels leave the digital numbers from " + Text(low) + " to " + Text(high) +
                                  "; expected at least two digital numbers");
    }
  }
  return { low, high };
}

void
StackSimulator::ExposeRow(std::size_t frame, std::size_t y, double * electrons, double * normals) const
{
  const SimulationSettings & settings = m_Truth.settings;
  const std::size_t          exposure = settings.flaws.repetition.ExposureOf(frame);
  CounterSeededRandom        random(settings.seed, StreamNumber(RandomStream::Pixels, settings.isDark), exposure, y);
  ExpectedElectronsRow(frame, y, electrons);
  for (std::size_t x = 0; x < m_Width; ++x)
  {
    electrons[x] = static_cast<double>(random.Poisson(electrons[x]));
    normals[x] = random.Normal();
  }
}

void
StackSimulator::ReadRow(std::size_t    frame,
                        std::size_t    y,
                        const double * electrons,
                        const double * normals,
                        double *       valuesDn) const
{
  constexpr double           infinity = std::numeric_limits<double>::infinity();
  const SimulationSettings & settings = m_Truth.settings;
  const double               low = settings.clipLowDn.value_or(-infinity);
  const double               high = settings.clipHighDn.value_or(infinity);
  m_Sensor->readOut.ReadRow(settings.flaws.repetition.ExposureOf(frame), y, electrons, normals, valuesDn);
  std::transform(
    valuesDn, valuesDn + m_Width, valuesDn, [=](double valueDn) { return std::clamp(valueDn, low, high); });
}

DoubleFrame
StackSimulator::ReadFrame(std::size_t frame, const ParallelFor & parallelFor) const
{
  DoubleFrame charge(m_Width, m_Height);
  DoubleFrame valuesDn(m_Width, m_Height);
  parallelFor(m_Height, [&](std::size_t y) { ExposeRow(frame, y, charge.Row(y), valuesDn.Row(y)); });
  charge = MoveCharge(std::move(charge), m_Truth.settings.flaws, parallelFor);
  parallelFor(m_Height, [&](std::size_t y) { ReadRow(frame, y, charge.Row(y), valuesDn.Row(y), valuesDn.Row(y)); });
  return valuesDn;
}

template <typename TPixel>
void
StackSimulator::WriteRow(double * valuesDn, TPixel * out) const
{
  const SimulationSettings & settings = m_Truth.settings;
  const auto                 range = PixelRangeDn<TPixel>(settings);
  if (settings.flaws.companding.IsOn())
  {
    Compand(valuesDn, m_Width, settings.flaws.companding, settings.bitDepth);
  }
  for (std::size_t x = 0; x < m_Width; ++x)
  {
    if constexpr (std::is_integral_v<TPixel>)
    {
      out[x] = static_cast<TPixel>(std::clamp(std::floor(valuesDn[x] + 0.5), range.first, range.second));
    }
    else
    {
      out[x] = static_cast<TPixel>(std::clamp(valuesDn[x], range.first, range.second));
    }
  }
}

template <typename TPixel>
void
StackSimulator::RenderRow(std::size_t frame, std::size_t y, TPixel * out) const
{
  if (NeedsWholeFrames())
  {
    throw std::invalid_argument(
      "one row of a frame was asked for, with flaws that mix the rows or the frames; expected "
      "RenderFrame to be used");
  }
  std::vector<double> electrons(m_Width);
  std::vector<double> valuesDn(m_Width);
  ExposeRow(frame, y, electrons.data(), valuesDn.data());
  ReadRow(frame, y, electrons.data(), valuesDn.data(), valuesDn.data());
  WriteRow(valuesDn.data(), out);
}

template <typename TPixel>
void
StackSimulator::RenderFrame(std::size_t frame, TPixel * out, const ParallelFor & parallelFor) const
{
  if (!NeedsWholeFrames())
  {
    parallelFor(m_Height, [&](std::size_t y) { RenderRow(frame, y, out + y * m_Width); });
    return;
  }
  RequireRow(frame, 0);
  const SensorFlaws & flaws = m_Truth.settings.flaws;
  const auto          outputOf = [&](std::size_t exposure) {
    const std::size_t firstFrame = flaws.repetition.FirstFrameOf(exposure);
    return ProcessBeforeTemporalFilter(ReadFrame(firstFrame, parallelFor), flaws, parallelFor);
  };
  const std::size_t exposure = flaws.repetition.ExposureOf(frame);
  DoubleFrame       valuesDn = flaws.temporalFilter.IsOn()
                                 ? m_Sensor->temporalFilter->OutputFrame(exposure, outputOf, parallelFor)
                                 : outputOf(exposure);
  valuesDn = ProcessAfterTemporalFilter(std::move(valuesDn), flaws, m_Truth.settings.bitDepth, parallelFor);
  parallelFor(m_Height, [&](std::size_t y) { WriteRow(valuesDn.Row(y), out + y * m_Width); });
}

#define SensorNoise_INSTANTIATE(TPixel)                               \
  template SensorNoise_EXPORT void StackSimulator::RenderRow<TPixel>( \
    std::size_t, std::size_t, std::add_pointer_t<TPixel>) const
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE
#define SensorNoise_INSTANTIATE(TPixel)                                 \
  template SensorNoise_EXPORT void StackSimulator::RenderFrame<TPixel>( \
    std::size_t, std::add_pointer_t<TPixel>, const ParallelFor &) const
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE

template SensorNoise_EXPORT std::pair<double, double>
StackSimulator::PixelRangeDn<unsigned char>(const SimulationSettings &);
template SensorNoise_EXPORT std::pair<double, double>
StackSimulator::PixelRangeDn<unsigned short>(const SimulationSettings &);
template SensorNoise_EXPORT std::pair<double, double>
StackSimulator::PixelRangeDn<short>(const SimulationSettings &);
template SensorNoise_EXPORT std::pair<double, double>
StackSimulator::PixelRangeDn<float>(const SimulationSettings &);
template SensorNoise_EXPORT std::pair<double, double>
StackSimulator::PixelRangeDn<double>(const SimulationSettings &);

} // namespace sensornoise
