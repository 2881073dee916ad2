// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "studies/RealSensorStack.h"

#include "simulation/Random.h"
#include "sensornoise/Simulator.h"

#include <algorithm>
#include <cmath>

namespace sensornoise::tools
{
namespace
{
constexpr std::uint64_t LitPixelStream = 120;
constexpr std::uint64_t SourceStream = 121;
constexpr std::size_t   EdgeRows = 16;  ///< height of the copied edge [pixel], beyond blur and vibration
constexpr std::size_t   FieldRows = 16; ///< height of the black and the white field [pixel]

/** Width of the block that crosses the frame [pixel], from the size of the frame. */
std::size_t
BlockWidth(std::size_t size)
{
  return size / 3;
}
std::size_t
BlockHeight(std::size_t size)
{
  return 2 * size / 3;
}

/** Returns a flat field with the shading of a lens [1]. It is a parabola of the distance from the centre, with 1 in
 * the centre and 1 - shading in the corners. */
std::vector<double>
MakeShadedField(std::size_t size, double shading)
{
  const double        middle = 0.5 * static_cast<double>(size - 1);
  std::vector<double> field;
  for (std::size_t p = 0; p < size * size; ++p)
  {
    const double dx = (static_cast<double>(p % size) - middle) / middle;
    const double dy = (static_cast<double>(p / size) - middle) / middle;
    field.push_back(1.0 - shading * 0.5 * (dx * dx + dy * dy));
  }
  return field;
}

bool
FillsRange(const RealSensorSetting & setting)
{
  return setting.scene != RealSensorScene::Flat && setting.darkestSignal == 0.0 && setting.brightestSignal == 1.0;
}

/** Returns the scene in units of camera.electrons. If the scene does not fill the range, the rows below the frame
 * are included. */
std::vector<double>
MakeReference(const RealSensorSetting & setting, std::size_t size)
{
  const double        darkest = setting.scene == RealSensorScene::Flat ? 0.0 : setting.darkestSignal;
  const double        range = setting.brightestSignal - darkest;
  std::vector<double> scene = setting.scene == RealSensorScene::Flat     ? MakeShadedField(size, setting.shading)
                              : setting.scene == RealSensorScene::Target ? MakeTargetScene(size, size)
                                                                         : MakeTextureScene(size, size);
  std::transform(scene.begin(), scene.end(), scene.begin(), [&](double v) { return darkest + range * v; });
  if (!FillsRange(setting))
  {
    const std::vector<double> edge(scene.end() - static_cast<std::ptrdiff_t>(size), scene.end());
    for (std::size_t y = 0; y < EdgeRows; ++y)
    {
      scene.insert(scene.end(), edge.begin(), edge.end());
    }
    for (std::size_t p = 0; p < FieldRows * size; ++p)
    {
      scene.push_back(p % size < size / 2 ? 0.0 : 1.0);
    }
  }
  return scene;
}

/** Returns the flicker of the two light sources in each frame: independent normal random numbers. */
std::vector<double>
DrawSourceFlicker(const SimulationSettings & settings, std::uint64_t seed)
{
  std::vector<double> flicker;
  for (std::size_t t = 0; t < settings.frames; ++t)
  {
    CounterSeededRandom random(seed, SourceStream, t);
    flicker.push_back(settings.conditions.flickerSd * random.Normal());
    flicker.push_back(settings.conditions.flickerSd * random.Normal());
  }
  return flicker;
}

/** Applies the flicker of two light sources to a row of electrons. The fraction of the second source rises from 0 to 1
 * along the diagonal of the frame. */
void
ApplyTwoSources(double first, double second, std::size_t y, std::vector<double> & electrons)
{
  const double pi = 3.14159265358979323846;
  for (std::size_t x = 0; x < electrons.size(); ++x)
  {
    const double along = static_cast<double>(x + y) / (2.0 * static_cast<double>(electrons.size()) - 2.0);
    const double fraction = 0.5 - 0.5 * std::cos(pi * along);
    electrons[x] *= std::max(0.0, 1.0 + (1.0 - fraction) * first + fraction * second);
  }
}

StackSimulator
MakeSimulator(const RealSensorSetting & setting, std::size_t size, std::uint64_t seed, bool isDark)
{
  SimulationSettings settings = setting.settings;
  settings.seed = seed;
  settings.isDark = isDark;
  if (setting.hasTwoSources)
  {
    settings.conditions.flickerSd = 0.0; // each source has its own flicker
  }
  return { MakeReference(setting, size), size, FillsRange(setting) ? size : size + EdgeRows + FieldRows, settings };
}
} // namespace

RealSensorStack::RealSensorStack(const RealSensorSetting & setting, std::size_t size, std::uint64_t seed, bool isDark)
  : m_Setting(setting)
  , m_Size(size)
  , m_Simulator(MakeSimulator(setting, size, seed, isDark))
{
  if (setting.isCrossed && !isDark)
  {
    // The texture differs from the texture of the scene.
    m_Block = MakeTextureScene(BlockWidth(size), BlockHeight(size), DefaultSceneSeed + 1);
  }
  if (setting.hasTwoSources && !isDark)
  {
    m_SourceFlicker = DrawSourceFlicker(setting.settings, seed);
  }
}

std::vector<std::uint16_t>
RealSensorStack::Render() const
{
  const std::size_t          frames = m_Setting.settings.frames;
  std::vector<std::uint16_t> greyValues(Pixels() * frames);
  std::vector<std::uint16_t> frame(m_Simulator.GetWidth() * m_Simulator.GetHeight());
  for (std::size_t t = 0; t < frames && m_Simulator.NeedsWholeFrames(); ++t)
  {
    m_Simulator.RenderFrame(t, frame.data());
    std::copy_n(frame.begin(), Pixels(), greyValues.begin() + static_cast<std::ptrdiff_t>(t * Pixels()));
  }
  for (std::size_t row = 0; row < m_Size * frames && !m_Simulator.NeedsWholeFrames(); ++row)
  {
    std::uint16_t * const out = greyValues.data() + row * m_Size;
    const std::size_t     t = row / m_Size;
    const std::size_t     y = row % m_Size;
    // The block crosses only the lower two thirds of the frame; the upper third stays static.
    const bool isBeside = m_Block.empty() || y < m_Size - BlockHeight(m_Size);
    if (isBeside && m_SourceFlicker.empty())
    {
      m_Simulator.RenderRow(t, y, out);
    }
    else
    {
      RenderLitRow(t, y, out);
    }
  }
  return greyValues;
}

/** Draws the block into a row of electrons. The block enters on the left, hides the scene behind it, and has left on
 * the right at the end of the burst. It has the illumination of the scene, and 20 to 80 % of the full signal. */
void
RealSensorStack::DrawBlock(std::size_t t, std::size_t y, std::vector<double> & electrons) const
{
  const SimulationTruth &    truth = m_Simulator.GetTruth();
  const SimulationSettings & settings = truth.settings;
  const std::size_t          width = BlockWidth(m_Size);
  const double *             block = m_Block.data() + (y - (m_Size - BlockHeight(m_Size))) * width;
  const double               way = static_cast<double>(m_Size + width);
  const double               last = static_cast<double>(std::max<std::size_t>(2, settings.frames) - 1);
  const double               left = way * static_cast<double>(t) / last - static_cast<double>(width);
  const double               full = settings.camera.electrons * (1.0 + FlickerOfRow(settings, truth.series, t, y));
  for (std::size_t x = 0; x < m_Size; ++x)
  {
    const double inBlock = static_cast<double>(x) - left;
    if (inBlock >= 0.0 && inBlock < static_cast<double>(width - 1))
    {
      const auto   first = static_cast<std::size_t>(inBlock);
      const double fraction = inBlock - static_cast<double>(first);
      const double grey = block[first] + fraction * (block[first + 1] - block[first]);
      electrons[x] = std::max(0.0, full * (0.2 + 0.6 * grey));
    }
  }
}

/** Renders a row as StackSimulator::RenderRow() does for a sensor without flaws. */
void
RealSensorStack::RenderLitRow(std::size_t t, std::size_t y, std::uint16_t * out) const
{
  const SimulationSettings & settings = m_Simulator.GetTruth().settings;
  const CameraModel &        camera = settings.camera;
  std::vector<double>        electrons(m_Size);
  m_Simulator.ExpectedElectronsRow(t, y, electrons.data());
  if (!m_Block.empty())
  {
    DrawBlock(t, y, electrons);
  }
  if (!m_SourceFlicker.empty())
  {
    ApplyTwoSources(m_SourceFlicker[2 * t], m_SourceFlicker[2 * t + 1], y, electrons);
  }
  CounterSeededRandom random(settings.seed, LitPixelStream, t, y);
  const auto          range = StackSimulator::PixelRangeDn<std::uint16_t>(settings);
  for (std::size_t x = 0; x < m_Size; ++x)
  {
    const double signal = camera.gainDnPerElectron * static_cast<double>(random.Poisson(electrons[x]));
    const double value = signal + camera.offsetDn + camera.readNoiseDn * random.Normal();
    out[x] = static_cast<std::uint16_t>(std::clamp(std::floor(value + 0.5), range.first, range.second));
  }
}

} // namespace sensornoise::tools
