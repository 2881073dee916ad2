// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/StackMethod.h"

#include "moments/StackPasses.h"

#include <type_traits>
#include <utility>

namespace sensornoise
{

template <typename TPixel>
StackMethod<TPixel>::StackMethod(std::unique_ptr<StackPasses<TPixel>> passes)
  : m_Passes(std::move(passes))
{
  static_assert(std::is_same_v<FrameFingerprint, BytesFingerprint>, "a frame has the fingerprint of its bytes");
}

template <typename TPixel>
StackMethod<TPixel>::StackMethod(StackMethod && other) noexcept = default;

template <typename TPixel>
StackMethod<TPixel> &
StackMethod<TPixel>::operator=(StackMethod && other) noexcept = default;

template <typename TPixel>
StackMethod<TPixel>::~StackMethod() = default;

template <typename TPixel>
void
StackMethod<TPixel>::AddFrames(const TPixel * frames, std::size_t count)
{
  m_Passes->AddFrames(frames, count);
}

template <typename TPixel>
void
StackMethod<TPixel>::SkipFrames(std::size_t count)
{
  m_Passes->SkipFrames(count);
}

template <typename TPixel>
void
StackMethod<TPixel>::GoTo(std::size_t frame)
{
  m_Passes->GoTo(frame);
}

template <typename TPixel>
const std::vector<std::uint8_t> &
StackMethod<TPixel>::GetHas() const
{
  return m_Passes->GetHas();
}

template <typename TPixel>
auto
StackMethod<TPixel>::GetFingerprints() const -> const std::map<std::size_t, FrameFingerprint> &
{
  return m_Passes->GetFingerprints().GetAll();
}

template <typename TPixel>
void
StackMethod<TPixel>::SetCountedElsewhere(const std::vector<std::uint8_t> & areCountedElsewhere)
{
  m_Passes->SetCountedElsewhere(areCountedElsewhere);
}

template <typename TPixel>
void
StackMethod<TPixel>::ForgetSums()
{
  m_Passes->ForgetSums();
}

template <typename TPixel>
void
StackMethod<TPixel>::FoldSums()
{
  m_Passes->FoldSums();
}

template <typename TPixel>
void
StackMethod<TPixel>::SaveSums(std::ostream & out) const
{
  m_Passes->SaveSums(out);
}

template <typename TPixel>
void
StackMethod<TPixel>::MergeSums(std::istream & in)
{
  m_Passes->MergeSums(in);
}

template <typename TPixel>
void
StackMethod<TPixel>::EndPass()
{
  m_Passes->EndPass();
}

template <typename TPixel>
bool
StackMethod<TPixel>::IsDone() const
{
  return m_Passes->IsDone();
}

template <typename TPixel>
const Report &
StackMethod<TPixel>::GetReport() const
{
  return m_Passes->GetReport();
}

template <typename TPixel>
const std::vector<double> &
StackMethod<TPixel>::GetMean() const
{
  return m_Passes->GetMean();
}

template <typename TPixel>
const std::vector<double> &
StackMethod<TPixel>::GetVariance() const
{
  return m_Passes->GetVariance();
}

template <typename TPixel>
const std::vector<double> &
StackMethod<TPixel>::GetCorrectedVariance() const
{
  return m_Passes->GetCorrectedVariance();
}

template <typename TPixel>
const std::vector<std::uint8_t> &
StackMethod<TPixel>::GetPixelUse() const
{
  return m_Passes->GetPixelUse();
}

template <typename TPixel>
std::vector<double>
StackMethod<TPixel>::TakeMean()
{
  return m_Passes->TakeMean();
}

template <typename TPixel>
std::vector<double>
StackMethod<TPixel>::TakeVariance()
{
  return m_Passes->TakeVariance();
}

template <typename TPixel>
std::vector<double>
StackMethod<TPixel>::TakeCorrectedVariance()
{
  return m_Passes->TakeCorrectedVariance();
}

template <typename TPixel>
std::vector<std::uint8_t>
StackMethod<TPixel>::TakePixelUse()
{
  return m_Passes->TakePixelUse();
}

#define SensorNoise_INSTANTIATE(TPixel) template class StackMethod<TPixel>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE

} // namespace sensornoise
