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
#include "itkSensorNoiseSums.h"

#include "itkSensorNoiseErrors.h"
#include "itkSensorNoiseEstimation.h"
#include "base/BinaryStream.h"
#include "moments/StackMaps.h"
#include "sensornoise/Version.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <istream>
#include <ostream>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

namespace itk
{

/** Helpers that do not depend on the type of the stack. */
struct SensorNoiseBytes
{
  using Bytes = Image<unsigned char, 2>;

  static Bytes::Pointer
  Make(SizeValueType columns, SizeValueType rows)
  {
    auto                  bytes = Bytes::New();
    const Bytes::SizeType size{ { columns, rows } };
    bytes->SetRegions(size);
    bytes->Allocate();
    return bytes;
  }
  static std::size_t
  SizeOf(const Bytes * bytes)
  {
    return bytes->GetBufferedRegion().GetNumberOfPixels();
  }
  /** Returns the sums in the bytes of GetSums(). Throws std::runtime_error if they are not complete. */
  static sensornoise::UnsealedSums
  Unseal(const Bytes * bytes)
  {
    return sensornoise::UnsealSums(bytes->GetBufferPointer(), SizeOf(bytes), sensornoise::GetModuleVersion());
  }
};

template <typename TStack>
void
SensorNoiseSums<TStack>::Start(EstimatorType * estimator, const std::string & recognised)
{
  if (estimator == nullptr || estimator->GetInput() == nullptr)
  {
    itkExceptionMacro("there is no estimator with a stack; expected one, whose settings are taken");
  }
  if (estimator->GetMemoryLimit() > 0)
  {
    itkExceptionMacro("the estimator's memory limit is "
                      << estimator->GetMemoryLimit()
                      << " bytes; expected none: what several processes merge are the sums of all pixels");
  }
  m_Estimator = nullptr;
  m_Pass = 0;
  estimator->UpdateOutputInformation();
  if (estimator->m_BayerPattern == "auto" && estimator->GetCamera().bayerPattern.empty())
  {
    if (recognised.empty())
    {
      itkExceptionMacro("the Bayer pattern is \"auto\" and the stack's metadata do not have it; expected none, RGGB, "
                        "GRBG, GBRG or BGGR, or the pattern of the first frame");
    }
    estimator->SetBayerPattern(recognised);
    estimator->m_BayerSource = sensornoise::BayerSource::Levels;
  }
  WithItkErrors(this, [&] { estimator->StartEstimation(false); });
  m_Estimator = estimator;
  this->Modified();
}

template <typename TStack>
std::string
SensorNoiseSums<TStack>::RecogniseBayerPattern(const TStack * frames)
{
  const auto &      region = frames->GetBufferedRegion();
  const std::size_t width = region.GetSize(0);
  const std::size_t height = region.GetSize(1);
  if (region.GetNumberOfPixels() == 0 || !HasPixels(frames))
  {
    itkGenericExceptionMacro("the image has no pixels; expected a frame");
  }
  const auto pattern = sensornoise::RecogniseMosaic(frames->GetBufferPointer(), width, height, sensornoise::SerialFor);
  return pattern ? sensornoise::NameOf(*pattern) : "none";
}

template <typename TStack>
void
SensorNoiseSums<TStack>::RequirePass() const
{
  if (!m_Estimator)
  {
    itkExceptionMacro("no pass was started; expected Start()");
  }
  if (!m_Estimator->m_Estimation)
  {
    itkExceptionMacro("all passes have ended: no sums are left");
  }
}

template <typename TStack>
bool
SensorNoiseSums<TStack>::IsDone() const
{
  return m_Estimator && !m_Estimator->m_Estimation;
}

template <typename TStack>
unsigned int
SensorNoiseSums<TStack>::GetNumberOfPlanes() const
{
  this->RequirePass();
  return static_cast<unsigned int>(m_Estimator->m_Estimation->GetNumberOfParts());
}

template <typename TStack>
void
SensorNoiseSums<TStack>::AddFrames(const TStack * frames, SizeValueType first)
{
  this->RequirePass();
  const auto          region = frames->GetBufferedRegion();
  const auto          expected = m_Estimator->GetFrameRegion().GetSize();
  const SizeValueType count = region.GetSize(2);
  const SizeValueType all = m_Estimator->GetNumberOfFrames();
  if (region.GetSize(0) != expected[0] || region.GetSize(1) != expected[1])
  {
    itkExceptionMacro("the frames have " << region.GetSize(0) << " x " << region.GetSize(1) << " pixels; expected "
                                         << expected[0] << " x " << expected[1]);
  }
  if (count == 0)
  {
    return;
  }
  if (first >= all || count > all - first)
  {
    itkExceptionMacro("frames " << first << " to " << first + count - 1 << " were given; expected frames below "
                                << all);
  }
  WithItkErrors(this, [&] {
    RequirePixels(frames, "the image of frames");
    std::visit(
      [&](auto & method) {
        const std::vector<std::uint8_t> & has = method.GetHas();
        for (SizeValueType t = first; t < first + count; ++t)
        {
          if (has[t] != 0)
          {
            throw std::invalid_argument("frame " + std::to_string(t) + " was given twice");
          }
        }
        method.GoTo(first);
        method.AddFrames(frames->GetBufferPointer(), count);
      },
      m_Estimator->m_Estimation->method);
  });
}

template <typename TStack>
auto
SensorNoiseSums<TStack>::GetFrames() const -> BytesPointer
{
  this->RequirePass();
  const std::vector<std::uint8_t> & has = m_Estimator->m_Estimation->GetHas();
  const auto                        frames = SensorNoiseBytes::Make(has.size(), 1);
  std::copy(has.begin(), has.end(), frames->GetBufferPointer());
  return frames;
}

template <typename TStack>
auto
SensorNoiseSums<TStack>::GetFramesOf(const BytesType * sums) const -> BytesPointer
{
  this->RequirePass();
  const auto frames = SensorNoiseBytes::Make(m_Estimator->GetNumberOfFrames(), 1);
  WithItkErrors(this, [&] {
    const sensornoise::UnsealedSums unsealed = SensorNoiseBytes::Unseal(sums);
    sensornoise::ZeroRunReader      packed(unsealed.bytes, unsealed.size);
    std::istream                    in(&packed);
    sensornoise::RequireCount("as the pass", sensornoise::ReadCount(in), m_Pass + 1);
    sensornoise::RequireCount("frames", sensornoise::ReadCount(in), SensorNoiseBytes::SizeOf(frames));
    sensornoise::ReadNumbers(in, frames->GetBufferPointer(), SensorNoiseBytes::SizeOf(frames));
  });
  return frames;
}

template <typename TStack>
auto
SensorNoiseSums<TStack>::GetFingerprints() const -> BytesPointer
{
  this->RequirePass();
  const auto          parts = m_Estimator->m_Estimation->GetFingerprints();
  const SizeValueType columns = parts.size() * sizeof(sensornoise::BytesFingerprint);
  const SizeValueType rows = parts.front()->size();
  const auto          bytes = SensorNoiseBytes::Make(columns, rows);
  for (std::size_t k = 0; k < parts.size(); ++k)
  {
    unsigned char * to = bytes->GetBufferPointer() + k * sizeof(sensornoise::BytesFingerprint);
    for (const auto & [t, fingerprint] : *parts[k])
    {
      std::memcpy(to, fingerprint.data(), sizeof(fingerprint));
      to += columns;
    }
  }
  return bytes;
}

template <typename TStack>
void
SensorNoiseSums<TStack>::SetCountedElsewhere(const BytesType * flags)
{
  this->RequirePass();
  const auto          size = flags->GetBufferedRegion().GetSize();
  const SizeValueType all = m_Estimator->GetNumberOfFrames();
  const SizeValueType parts = this->GetNumberOfPlanes();
  if (size[0] != all || size[1] != parts)
  {
    itkExceptionMacro("there are " << size[0] << " x " << size[1] << " values; expected " << all << " frames and "
                                   << parts << " planes");
  }
  WithItkErrors(this, [&] { m_Estimator->m_Estimation->SetCountedElsewhere(flags->GetBufferPointer(), all); });
}

template <typename TStack>
auto
SensorNoiseSums<TStack>::GetSums() const -> BytesPointer
{
  this->RequirePass();
  return WithItkErrors(this, [&] {
    sensornoise::ZeroRunWriter        packed;
    std::ostream                      out(&packed);
    const std::vector<std::uint8_t> & has = m_Estimator->m_Estimation->GetHas();
    sensornoise::WriteCount(out, m_Pass + 1);
    sensornoise::WriteCount(out, has.size());
    sensornoise::WriteNumbers(out, has);
    std::visit([&out](const auto & method) { method.SaveSums(out); }, m_Estimator->m_Estimation->method);
    const std::vector<unsigned char> all = packed.Take();
    const std::vector<unsigned char> seal =
      sensornoise::SealSums(all.data(), all.size(), sensornoise::GetModuleVersion());
    const auto bytes = SensorNoiseBytes::Make(seal.size() + all.size(), 1);
    std::copy(all.begin(), all.end(), std::copy(seal.begin(), seal.end(), bytes->GetBufferPointer()));
    return bytes;
  });
}

template <typename TStack>
bool
SensorNoiseSums<TStack>::MergeSums(const BytesType * sums)
{
  const BytesPointer                frames = this->GetFramesOf(sums);
  const unsigned char * const       theirs = frames->GetBufferPointer();
  const std::vector<std::uint8_t> & has = m_Estimator->m_Estimation->GetHas();
  bool                              areAllHere = true;
  bool                              isAny = false;
  for (std::size_t t = 0; t < has.size(); ++t)
  {
    areAllHere = areAllHere && (theirs[t] == 0 || has[t] != 0);
    isAny = isAny || theirs[t] != 0;
  }
  if (isAny && areAllHere)
  {
    return false;
  }
  WithItkErrors(this, [&] {
    const sensornoise::UnsealedSums unsealed = SensorNoiseBytes::Unseal(sums);
    sensornoise::ZeroRunReader      packed(unsealed.bytes, unsealed.size);
    std::istream                    in(&packed);
    std::vector<std::uint8_t>       head(2 * sizeof(std::uint64_t) + has.size());
    sensornoise::ReadNumbers(in, head);
    m_Estimator->m_Estimation->MergeSums(in);
  });
  return true;
}

template <typename TStack>
void
SensorNoiseSums<TStack>::ForgetSums()
{
  this->RequirePass();
  m_Estimator->m_Estimation->ForEach([](auto & method) { method.ForgetSums(); });
}

template <typename TStack>
void
SensorNoiseSums<TStack>::EndPass()
{
  this->RequirePass();
  WithItkErrors(this, [&] { m_Estimator->EndPass(m_Pass); });
  ++m_Pass;
  if (!m_Estimator->m_Estimation)
  {
    // The outputs are marked as up to date: an update would compute them again from a stack without pixels.
    for (unsigned int i = 0; i < m_Estimator->GetNumberOfIndexedOutputs(); ++i)
    {
      m_Estimator->ProcessObject::GetOutput(i)->DataHasBeenGenerated();
    }
  }
  this->Modified();
}

template <typename TStack>
void
SensorNoiseSums<TStack>::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "Pass: " << m_Pass << std::endl;
  os << indent << "Estimator: " << m_Estimator.GetPointer() << std::endl;
}

#define SensorNoise_INSTANTIATE(TPixel) template class SensorNoiseSums<Image<TPixel, 3>>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE

} // namespace itk
