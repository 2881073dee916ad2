// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/MosaicMethod.h"

#include "sensornoise/Report.h"
#include "mosaic/MosaicGeometry.h"
#include "mosaic/MosaicPasses.h"
#include "published/PublishedPasses.h"
#include "refined/PixelProjections.h"
#include "refined/RefinedPasses.h"

#include <limits>
#include <type_traits>

namespace sensornoise
{

namespace
{
template <typename TMethod>
struct PassesOfMethod;
template <typename TPixel>
struct PassesOfMethod<RefinedMethod<TPixel>>
{
  using Type = RefinedPasses<TPixel>;
};
template <typename TPixel>
struct PassesOfMethod<PublishedMethod<TPixel>>
{
  using Type = PublishedPasses<TPixel>;
};

/** Returns the settings of each plane; a memory limit is divided among the planes. Throws std::invalid_argument if it
 * is too small, see RequireMemoryLimit(). */
template <typename TSettings>
std::array<TSettings, 4>
SettingsOfPlanes(TSettings settings, const FrameGeometry & geometry, std::size_t frames)
{
  if constexpr (std::is_same_v<TSettings, RefinedSettings>)
  {
    const MosaicGeometry planes{ geometry };
    RequireMemoryLimit(settings.memoryLimitBytes, planes.Plane(), frames, BayerPlanes.size());
    settings.memoryLimitBytes /= static_cast<double>(BayerPlanes.size());
  }
  return { { settings, settings, settings, settings } };
}
} // namespace

template <typename TPixel, typename TMethod>
struct MosaicMethod<TPixel, TMethod>::Planes
{
  MosaicPasses<TPixel, typename PassesOfMethod<TMethod>::Type> passes;
};

template <typename TPixel, typename TMethod>
MosaicMethod<TPixel, TMethod>::MosaicMethod(const Settings &                  settings,
                                            const FrameGeometry &             geometry,
                                            BayerPattern                      pattern,
                                            std::size_t                       frames,
                                            const std::vector<std::uint8_t> & mask,
                                            const ParallelFor &               parallelFor,
                                            std::size_t                       threads)
  : MosaicMethod(SettingsOfPlanes(settings, geometry, frames), geometry, pattern, frames, mask, parallelFor, threads)
{}

template <typename TPixel, typename TMethod>
MosaicMethod<TPixel, TMethod>::MosaicMethod(const std::array<Settings, 4> &   settings,
                                            const FrameGeometry &             geometry,
                                            BayerPattern                      pattern,
                                            std::size_t                       frames,
                                            const std::vector<std::uint8_t> & mask,
                                            const ParallelFor &               parallelFor,
                                            std::size_t                       threads)
  : m_Planes(std::make_unique<Planes>(
      Planes{ MakeMosaicPasses<TPixel, typename PassesOfMethod<TMethod>::Type>(settings,
                                                                               { geometry, pattern },
                                                                               frames,
                                                                               mask,
                                                                               parallelFor,
                                                                               threads) }))
{}

template <typename TPixel, typename TMethod>
MosaicMethod<TPixel, TMethod>::MosaicMethod(MosaicMethod && other) noexcept = default;

template <typename TPixel, typename TMethod>
MosaicMethod<TPixel, TMethod> &
MosaicMethod<TPixel, TMethod>::operator=(MosaicMethod && other) noexcept = default;

template <typename TPixel, typename TMethod>
MosaicMethod<TPixel, TMethod>::~MosaicMethod() = default;

template <typename TPixel, typename TMethod>
void
MosaicMethod<TPixel, TMethod>::AddFrames(const TPixel * frames, std::size_t count)
{
  m_Planes->passes.AddFrames(frames, count);
}

template <typename TPixel, typename TMethod>
void
MosaicMethod<TPixel, TMethod>::GoTo(std::size_t frame)
{
  m_Planes->passes.GoTo(frame);
}

template <typename TPixel, typename TMethod>
const std::vector<std::uint8_t> &
MosaicMethod<TPixel, TMethod>::GetHas() const
{
  return m_Planes->passes.GetHas();
}

template <typename TPixel, typename TMethod>
void
MosaicMethod<TPixel, TMethod>::ForgetSums()
{
  for (auto & ofPlane : m_Planes->passes.GetMethods())
  {
    ofPlane.ForgetSums();
  }
}

template <typename TPixel, typename TMethod>
void
MosaicMethod<TPixel, TMethod>::SaveSums(std::ostream & out) const
{
  m_Planes->passes.SaveSums(out);
}

template <typename TPixel, typename TMethod>
void
MosaicMethod<TPixel, TMethod>::MergeSums(std::istream & in)
{
  m_Planes->passes.MergeSums(in);
}

template <typename TPixel, typename TMethod>
void
MosaicMethod<TPixel, TMethod>::EndPass()
{
  m_Planes->passes.EndPass();
}

template <typename TPixel, typename TMethod>
bool
MosaicMethod<TPixel, TMethod>::IsDone() const
{
  return m_Planes->passes.IsDone();
}

template <typename TPixel, typename TMethod>
std::array<Report, 4>
MosaicMethod<TPixel, TMethod>::GetReports() const
{
  return m_Planes->passes.GetReports();
}

template <typename TPixel, typename TMethod>
std::vector<double>
MosaicMethod<TPixel, TMethod>::TakeMean()
{
  constexpr double missing = std::numeric_limits<double>::quiet_NaN();
  return m_Planes->passes.JoinMaps([](auto & ofPlane) { return ofPlane.TakeMean(); }, missing);
}

template <typename TPixel, typename TMethod>
std::vector<double>
MosaicMethod<TPixel, TMethod>::TakeVariance()
{
  constexpr double missing = std::numeric_limits<double>::quiet_NaN();
  return m_Planes->passes.JoinMaps([](auto & ofPlane) { return ofPlane.TakeVariance(); }, missing);
}

template <typename TPixel, typename TMethod>
std::vector<double>
MosaicMethod<TPixel, TMethod>::TakeCorrectedVariance()
{
  constexpr double missing = std::numeric_limits<double>::quiet_NaN();
  return m_Planes->passes.JoinMaps([](auto & ofPlane) { return ofPlane.TakeCorrectedVariance(); }, missing);
}

template <typename TPixel, typename TMethod>
std::vector<std::uint8_t>
MosaicMethod<TPixel, TMethod>::TakePixelUse()
{
  constexpr auto missing = static_cast<std::uint8_t>(PixelUse::Border);
  return m_Planes->passes.JoinMaps([](auto & ofPlane) { return ofPlane.TakePixelUse(); }, missing);
}

// A type between angle brackets takes no parentheses. NOLINTBEGIN(bugprone-macro-parentheses)
#define SensorNoise_INSTANTIATE(TPixel)                       \
  template class MosaicMethod<TPixel, RefinedMethod<TPixel>>; \
  template class MosaicMethod<TPixel, PublishedMethod<TPixel>>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

} // namespace sensornoise
