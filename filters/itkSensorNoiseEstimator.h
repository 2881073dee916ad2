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
#ifndef itkSensorNoiseEstimator_h
#define itkSensorNoiseEstimator_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Settings.h"
#include "sensornoise/ReportText.h"
#include "sensornoise/Report.h"
#include "sensornoise/NoiseModel.h"
#include "itkNumericTraits.h"
#include "itkSensorNoiseReportSink.h"
#include "itkSensorNoiseResult.h"

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace itk
{

struct SensorNoiseMosaic;
struct SensorNoiseStack;
template <typename TStack>
class SensorNoiseSums;

/** \class SensorNoiseEstimatorEnums
 * \brief Enumerations of SensorNoiseEstimator.
 * \ingroup SensorNoise
 */
class SensorNoiseEstimatorEnums
{
public:
  /** \class Method
   * \brief Method by which the noise is estimated.
   * \ingroup SensorNoise
   */
  enum class Method : uint8_t
  {
    Published = 0, ///< Figure 2 of Sur & Gredi\'ac 2015, unchanged: uniform areas only, no errors
    Refined = 1    ///< all pixels of a static scene, with standard errors
  };
};

/** \class SensorNoiseEstimator
 * \brief Measures gain, offset and read noise of a camera, flicker and vibration, from a stack of a static scene.
 *
 * Inputs:
 *
 * - 0: the stack, raw frames along the last axis, at least 5.
 * - "Mask", optional, of the size of a frame: pixels of value 0 are left out.
 * - "Dark", optional, for the method Refined: a stack of dark frames of the same size.
 *
 * Outputs; the maps have the size of a frame:
 *
 * - 0: the report (decorated sensornoise::Report: value, status and unit of each quantity).
 * - 1: mean [DN].
 * - 2: variance [DN^2].
 * - 3: corrected variance [DN^2] (NaN: not known).
 * - 4: pixel use (sensornoise::PixelUse: 0 if the pixel is used, else the reason why it is not).
 * - 5 to 7: offset of each pixel, and the lower and upper end of its 95 % interval [DN].
 * - 8 to 10: read noise of each pixel, and the lower and upper end of its 95 % interval [DN].
 * - 11: the reports of the channels of a Bayer mosaic; output 0 then has no report.
 *
 * Outputs 5 to 10 need two or more dark frames; otherwise they have no pixels. NaN means not known, see
 * sensornoise::PixelCalibration.
 *
 * The method Refined is the default. It regresses every frame on the mean image and its derivatives, which gives
 * flicker, offset and motion. It removes these from every pixel, and fits the remaining variance with weights from its
 * own noise. Edges and texture are therefore used, too. The measured quantities of the sensor have a standard error and
 * a 95 % interval. The method detects illumination that changes differently in different places, and allows for it.
 * Read noise and intercept belong to the sensor and exclude the quantization noise (total_intercept includes it). See
 * sensornoise::RefinedMethod.
 *
 * The method Published gives the numbers of the chain TemporalStatistics - VibrationMask - FlickerCorrection -
 * TemporalStatistics - NoiseRegression to rounding, and no errors. See sensornoise::PublishedMethod.
 *
 * The camera settings in the metadata of the input (sensornoise::MetaDataKeys) take precedence over a bit depth and a
 * highest level that are found from the data. Data that exceed the bit depth are an error.
 *
 * Both methods make three passes over the stack, in chunks (see SensorNoiseStackSink), and one over the dark frames.
 * The filter is threaded. The result has the same bits for any number of threads and chunks. SetMemoryLimit() describes
 * the memory in addition to one chunk (Published: 40 bytes for each pixel).
 *
 * A stack that cannot be measured gives a report whose quantities are `failed` or `not-identifiable`, with a warning
 * that gives the reason. Wrong use throws: fewer than 5 frames, frames smaller than 3 x 3 pixels, a bit depth that the
 * data exceed, or dark frames whose black level is cut off.
 *
 * F. Sur, M. Gredi\'ac, SIAM J. Imaging Sci. 8(1), 2015, https://doi.org/10.1137/140977035.
 *
 * \tparam TStack itk::Image of 3 dimensions (x, y, time) of unsigned char, unsigned short, short, float or double.
 * \ingroup SensorNoise
 */
template <typename TStack>
class ITK_TEMPLATE_EXPORT SensorNoiseEstimator : public SensorNoiseReportSink<TStack>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(SensorNoiseEstimator);

  using Self = SensorNoiseEstimator;
  using Superclass = SensorNoiseReportSink<TStack>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  using typename Superclass::FrameImageType;
  using typename Superclass::MaskImageType;
  using typename Superclass::PixelType;
  using MethodEnum = SensorNoiseEstimatorEnums::Method;
  using RollingShutterEnum = sensornoise::RollingShutter;
  using ReportObjectType = SensorNoiseResult<sensornoise::Report>;
  using ChannelReportsObjectType = SensorNoiseResult<sensornoise::ChannelReports>;
  using DataObjectPointer = DataObject::Pointer;
  using DataObjectPointerArraySizeType = ProcessObject::DataObjectPointerArraySizeType;

  itkNewMacro(Self);

  const char *
  GetNameOfClass() const override
  {
    return "SensorNoiseEstimator";
  }

  /** Stack of dark frames, with the size, exposure, gain and temperature of the frames (Refined only). They give the
   * offset and, if there are two or more, the read noise. They are read in chunks. Dark frames and Offset exclude each
   * other. */
  itkSetInputMacro(Dark, TStack);
  itkGetInputMacro(Dark, TStack);

  /** Method by which the noise is estimated: Refined (default) or Published. */
  void
  SetMethod(MethodEnum method);
  /** Name of the method: "refined" or "published". */
  void
  SetMethod(const std::string & name);
  /** Returns the method by which the noise is estimated. */
  MethodEnum
  GetMethod() const
  {
    return m_Method;
  }

  /** Returns the name of the method: "refined" or "published". */
  std::string
  GetMethodName() const
  {
    return m_Method == MethodEnum::Refined ? "refined" : "published";
  }

  /** Dark offset [DN], if it is known (Refined only). Offset and read noise then need no flicker, and steady
   * illumination is distinguished from the offset. Default NaN: not known. Without dark frames the level of the
   * optically masked pixels is then used, if the metadata of the input have it with its error
   * (sensornoise::MetaDataKeys). */
  itkSetMacro(Offset, double);
  itkGetConstMacro(Offset, double);

  /** Standard error of Offset [DN], 0 or more. Default 0. */
  itkSetMacro(OffsetStandardError, double);
  itkGetConstMacro(OffsetStandardError, double);

  /** Level of the test that finds pixels moved by vibrations, a probability. Default 0.01. The method Refined does not
   * use this level. */
  itkSetMacro(Level, double);
  itkGetConstMacro(Level, double);

  /** Quantiles of the mean at which the bright and the dark set lie, 0 to 1. Defaults 0.99 and 0.01. The method Refined
   * does not use these quantiles. */
  itkSetMacro(BrightQuantile, double);
  itkGetConstMacro(BrightQuantile, double);
  itkSetMacro(DarkQuantile, double);
  itkGetConstMacro(DarkQuantile, double);

  /** Mode of the flicker estimate: Off, Auto or Fixed. Off estimates one flicker value for each frame. Auto, the
   * default, finds out whether the flicker differs from row to row, and chooses sigma_y by cross-validation. Fixed uses
   * SigmaRows. Unless the mode is Off, Refined detects any illumination that changes differently in different places;
   * it treats Fixed as Auto. */
  void
  SetRollingShutter(RollingShutterEnum mode);
  /** Name of the mode: "off", "auto" or "fixed". */
  void
  SetRollingShutter(const std::string & name);
  /** Returns the mode, by its name or as a value. */
  std::string
  GetRollingShutterName() const
  {
    return sensornoise::NameOf(m_RollingShutter);
  }
  RollingShutterEnum
  GetRollingShutter() const
  {
    return m_RollingShutter;
  }

  /** Standard deviation sigma_y of (3.28) for the RollingShutter mode Fixed [rows]. Default 50, as in the paper. The
   * method Refined does not use this number. */
  itkSetMacro(SigmaRows, double);
  itkGetConstMacro(SigmaRows, double);

  /** Axis along which the shutter travels: 1 = y (default, row by row), or 0 = x (column by column). The method Refined
   * does not use this axis. */
  itkSetMacro(ShutterAxis, unsigned int);
  itkGetConstMacro(ShutterAxis, unsigned int);

  /** Lowest and highest level of the range in which the variance is fitted [DN] (Refined only). Use it for sensors
   * whose response is linear in a part of the range. The level of a pixel is the mean of its neighbours. Pixels outside
   * the range have the pixel use OutsideRange. Defaults NumericTraits<double>::NonpositiveMin() and max(): all levels.
   */
  itkSetMacro(LevelRangeLow, double);
  itkGetConstMacro(LevelRangeLow, double);
  itkSetMacro(LevelRangeHigh, double);
  itkGetConstMacro(LevelRangeHigh, double);

  /** Exposure of each frame of the stack, in the order of the frames, in any unit (Refined only): exposure times, or
   * irradiations. An exposure of 0 is a dark frame. The values are finite and 0 or more, and at least 3 of them differ.
   * The report then has the linearity error of EMVA 1288, and the offset and responsivity of a line through the levels.
   * Default: empty, not given. Update() throws an ExceptionObject if the number of exposures differs from the number of
   * frames. */
  void
  SetExposures(const std::vector<double> & exposures);
  std::vector<double>
  GetExposures() const
  {
    return m_Exposures;
  }

  /** Largest memory of the estimate in addition to one chunk of a stack that is not in memory [bytes] (Refined only).
   * Default 0: as much as needed, which is 48 bytes for each pixel of a frame, or 10, and 4 more for each temporal
   * component of illumination and motion that is found, if these are more. Large changes of the illumination at 16 bits
   * need 8 for each component. Floating-point pixels need 52, or 20 and 8 for each component. With a smaller limit the
   * stack is read more often, with the same result. This does not apply to a stack that is in memory and is not a
   * mosaic, which needs no more memory than stated above. A limit below the minimum is an error. The minimum is the sum
   * of 64 bytes for each pixel, 20 kB for each frame, and 32 MiB. */
  itkSetMacro(MemoryLimit, SizeValueType);
  itkGetConstMacro(MemoryLimit, SizeValueType);

  /** SHA-256 hash of the dark frames, as SetFramesHash() records the hash of the frames. */
  void
  SetDarkHash(const std::string & sha256, SizeValueType files, SizeValueType bytes);

  /** Pattern of the colour filters in front of the pixels: "none" (default), "RGGB", "GRBG", "GBRG", "BGGR" or "auto".
   * With "none" the sensor is monochrome. The four patterns give the colours of the upper left pixels of the stack.
   * Each of the four planes is then measured separately, and channel reports replace the report. Each pass still reads
   * the stack once, and the maps have the pixels of the mosaic. With "auto" the input's MetaDataDictionary gives the
   * pattern (sensornoise::MetaDataKeys), else the levels of the first frame do. Mask and Dark are mosaics, too. */
  void
  SetBayerPattern(const std::string & name);
  itkGetConstReferenceMacro(BayerPattern, std::string);

  /** Returns whether the stack was measured as a mosaic. There are then reports of the channels and no single report.
   */
  bool
  HasChannelReports() const
  {
    return static_cast<const ChannelReportsObjectType *>(this->ProcessObject::GetOutput(ChannelReportsOutput))->Has();
  }
  /** Returns the reports of the channels of a mosaic, as a pipeline output or as a struct. Throws an ExceptionObject if
   * there are no channel reports. */
  ChannelReportsObjectType *
  GetChannelReportsOutput()
  {
    return static_cast<ChannelReportsObjectType *>(this->ProcessObject::GetOutput(ChannelReportsOutput));
  }
  const sensornoise::ChannelReports &
  GetChannelReports() const
  {
    return static_cast<const ChannelReportsObjectType *>(this->ProcessObject::GetOutput(ChannelReportsOutput))->Get();
  }

  /** Returns the report, as a pipeline output or as a struct. There is no report before Update(), nor after an Update()
   * that failed during the computation. All methods that need the report then throw an ExceptionObject. */
  ReportObjectType *
  GetReportOutput()
  {
    return static_cast<ReportObjectType *>(this->ProcessObject::GetOutput(0));
  }
  const sensornoise::Report &
  GetReport() const
  {
    if (this->HasChannelReports())
    {
      itkExceptionMacro("the stack was measured as a Bayer mosaic and has a report for each of its channels; expected "
                        "GetChannelReports() to be asked");
    }
    return static_cast<const ReportObjectType *>(this->ProcessObject::GetOutput(0))->Get();
  }

  /** Returns the report as JSON, schema "itk-sensornoise-report/1". For a mosaic, one record has the reports of all
   * channels. */
  std::string
  GetReportAsJson() const
  {
    return this->HasChannelReports() ? sensornoise::ToJson(this->GetChannelReports())
                                     : sensornoise::ToJson(this->GetReport());
  }
  /** Returns the report of one channel of a mosaic, "R", "G1", "G2" or "B", as JSON or as a table. */
  std::string
  GetChannelReportAsJson(const std::string & channel) const
  {
    return sensornoise::ToJson(this->GetChannelReport(channel));
  }
  std::string
  GetChannelReportAsText(const std::string & channel) const
  {
    return sensornoise::MakeText(this->GetChannelReport(channel));
  }
  /** Returns the report as a readable table with its warnings, as `estimate-sensor-noise` prints it. */
  std::string
  GetReportAsText() const
  {
    return this->HasChannelReports() ? sensornoise::MakeText(this->GetChannelReports())
                                     : sensornoise::MakeText(this->GetReport());
  }

  /** Returns the report as one HTML page with figures and maps, which needs no other file. \see sensornoise::ToHtml */
  std::string
  GetReportAsHtml() const;

  /** Returns the graph of variance against mean as an SVG file. For a mosaic it shows the channel "G1".
   * \see sensornoise::ToSvg */
  std::string
  GetReportAsSvg() const;

  /** Returns the report of one channel of a mosaic as an HTML page without maps, or its graph as an SVG file. */
  std::string
  GetChannelReportAsHtml(const std::string & channel) const;
  std::string
  GetChannelReportAsSvg(const std::string & channel) const;

  /** Returns the numbers of the figures as JSON. For a mosaic there is an object for each channel.
   * \see sensornoise::FigureAsJson */
  std::string
  GetFigureAsJson() const;

  /** Returns all warnings and quantities that a report may have, as JSON. \see sensornoise::CatalogueAsJson */
  static std::string
  GetCatalogueAsJson()
  {
    return sensornoise::CatalogueAsJson();
  }

  /** Returns why a method cannot use a setting, as the end of "the method published ...": "fits all levels"; "" if it
   * can. \a method is "refined", "published" or "single-image", \a setting "offset", "dark", "level_range", "exposures"
   * or "maps"; another setting throws. */
  static std::string
  ReasonUnused(const std::string & method, const std::string & setting);

  /** Compares the noise of the stack with a noise model at each level, as JSON, schema "itk-sensornoise-check/1", or as
   * a readable table. The corrected variance of the stack is compared with the variance slope [DN/e-] and the total
   * intercept [DN^2] of another report. The read noise [e-] and the quantization step [DN] of that report help to
   * describe a difference (NaN: not known). \see sensornoise::NoiseModelCheck */
  std::string
  GetNoiseModelCheckAsJson(double varianceSlope,
                           double totalIntercept,
                           double readNoiseElectrons = std::numeric_limits<double>::quiet_NaN(),
                           double quantisationStep = std::numeric_limits<double>::quiet_NaN()) const;
  std::string
  GetNoiseModelCheckAsText(double varianceSlope,
                           double totalIntercept,
                           double readNoiseElectrons = std::numeric_limits<double>::quiet_NaN(),
                           double quantisationStep = std::numeric_limits<double>::quiet_NaN()) const;

  /** Returns the spatial and temporal noise correlation: noise class, coefficients by lag, noise of rows and columns.
   * Returns null if it was not measured (method Published, few pixels or frames). The record is valid until the next
   * Update().
   * \see NoiseCorrelationEstimator */
  const sensornoise::NoiseCorrelationRecord *
  GetNoiseCorrelation() const
  {
    const auto & correlation = this->GetReport().noiseCorrelation;
    return correlation ? &*correlation : nullptr;
  }
  /** Returns the noise class: "white", "filtered" ..., or "not-measured". */
  std::string
  GetNoiseKind() const
  {
    const auto * correlation = this->GetNoiseCorrelation();
    return correlation != nullptr ? correlation->kind : "not-measured";
  }

  /** Returns a map of the size of a frame: mean [DN], variance [DN^2], corrected variance [DN^2] (NaN: not known), or
   * pixel use (sensornoise::PixelUse). */
  FrameImageType *
  GetMean()
  {
    return static_cast<FrameImageType *>(this->ProcessObject::GetOutput(1));
  }
  FrameImageType *
  GetVariance()
  {
    return static_cast<FrameImageType *>(this->ProcessObject::GetOutput(2));
  }
  FrameImageType *
  GetCorrectedVariance()
  {
    return static_cast<FrameImageType *>(this->ProcessObject::GetOutput(3));
  }
  MaskImageType *
  GetPixelUse()
  {
    return static_cast<MaskImageType *>(this->ProcessObject::GetOutput(4));
  }

  /** Returns the offset of each pixel, from the dark frames, or the lower or upper end of its 95 % interval [DN]. The
   * image has no pixels if there are fewer than two dark frames. */
  FrameImageType *
  GetPixelOffset()
  {
    return static_cast<FrameImageType *>(this->ProcessObject::GetOutput(FirstPixelOutput));
  }
  FrameImageType *
  GetPixelOffsetLow()
  {
    return static_cast<FrameImageType *>(this->ProcessObject::GetOutput(FirstPixelOutput + 1));
  }
  FrameImageType *
  GetPixelOffsetHigh()
  {
    return static_cast<FrameImageType *>(this->ProcessObject::GetOutput(FirstPixelOutput + 2));
  }

  /** Returns the read noise of each pixel, from the dark frames, without quantization noise, or the lower or upper end
   * of its 95 % interval [DN]. The image has no pixels if there are fewer than two dark frames. */
  FrameImageType *
  GetPixelReadNoise()
  {
    return static_cast<FrameImageType *>(this->ProcessObject::GetOutput(FirstPixelOutput + 3));
  }
  FrameImageType *
  GetPixelReadNoiseLow()
  {
    return static_cast<FrameImageType *>(this->ProcessObject::GetOutput(FirstPixelOutput + 4));
  }
  FrameImageType *
  GetPixelReadNoiseHigh()
  {
    return static_cast<FrameImageType *>(this->ProcessObject::GetOutput(FirstPixelOutput + 5));
  }

  DataObject *
  GetOutput(unsigned int index)
  {
    return this->ProcessObject::GetOutput(index);
  }

protected:
  SensorNoiseEstimator();
  ~SensorNoiseEstimator() override;

  using Superclass::MakeOutput;
  DataObjectPointer
  MakeOutput(DataObjectPointerArraySizeType index) override;
  void
  VerifyInputInformation() const override;
  void
  GenerateOutputInformation() override;
  void
  EnlargeOutputRequestedRegion(DataObject * output) override;

  unsigned int
  NumberOfPasses() const override;
  bool
  RepeatsPass(unsigned int pass) const override;
  void
  GenerateNthInputRequestedRegion(unsigned int number) override;
  void
  StartPasses() override;
  SizeValueType
  ChunkBytes(unsigned int pass) const override;
  /** Returns the largest number: the pixels of the whole stack are processed at once. Otherwise intermediate arrays
   * would be computed again for each piece, and sums would be needed. */
  SizeValueType
  BytesAtOnce() const override
  {
    return NumericTraits<SizeValueType>::max();
  }
  void
  ProcessFrames(unsigned int pass, const PixelType * frames, SizeValueType first, SizeValueType count) override;
  void
  EndPass(unsigned int pass) override;
  void
  DropPasses() override;
  void
  PrintSelf(std::ostream & os, Indent indent) const override;

private:
  friend class SensorNoiseSums<TStack>; // runs the passes itself

  /** Starts the estimation. \a withoutMerging means that no sums are saved or merged. */
  void
  StartEstimation(bool withoutMerging);

  // The six maps of the dark frames follow the other maps.
  static constexpr DataObjectPointerArraySizeType FirstPixelOutput = 5;
  static constexpr DataObjectPointerArraySizeType ChannelReportsOutput = FirstPixelOutput + 6;

  // The method that is running.
  struct Estimation;

  const sensornoise::Report &
  GetChannelReport(const std::string & channel) const;
  std::optional<SensorNoiseMosaic>
  FindMosaic();
  /** Returns the offset and read noise of the dark frames, or the offset that was given. For a mosaic there is one
   * result for each plane. */
  std::vector<std::optional<sensornoise::KnownOffset>>
  FindOffsets(const SensorNoiseStack & stack);
  /** Returns the hashes that were given, for the inputs that are present. */
  std::optional<sensornoise::InputRecord>
  GetInputRecord() const override;
  sensornoise::NoiseModelCheck
  CheckModel(double varianceSlope, double totalIntercept, double readNoiseElectrons, double quantisationStep) const;
  /** Throws std::invalid_argument if a setting or an input was given that the method cannot use. */
  void
  RequireUsedSettings() const;
  bool
  HasLevelRange() const;
  sensornoise::PublishedSettings
  MakePublishedSettings() const;
  /** Returns the camera settings in the metadata of the input, and their consequences for settings that were not set
   * otherwise. */
  sensornoise::CameraSettings
  GetCamera() const;
  sensornoise::DnSettings
  MakeDnSettings() const;
  sensornoise::RefinedSettings
  MakeRefinedSettings() const;
  void
  FillOutputs();

  MethodEnum          m_Method{ MethodEnum::Refined };
  double              m_Offset{ std::numeric_limits<double>::quiet_NaN() };
  double              m_OffsetStandardError{ 0.0 };
  double              m_Level{ 0.01 };
  double              m_BrightQuantile{ 0.99 };
  double              m_DarkQuantile{ 0.01 };
  RollingShutterEnum  m_RollingShutter{ RollingShutterEnum::Auto };
  double              m_SigmaRows{ 50.0 };
  unsigned int        m_ShutterAxis{ 1 };
  double              m_LevelRangeLow{ NumericTraits<double>::NonpositiveMin() };
  double              m_LevelRangeHigh{ NumericTraits<double>::max() };
  std::vector<double> m_Exposures;
  SizeValueType       m_MemoryLimit{ 0 };
  std::string         m_BayerPattern{ "none" };

  sensornoise::BayerSource m_BayerSource{ sensornoise::BayerSource::Given }; // source of a pattern that is not auto

  sensornoise::InputFiles m_DarkHash;

  std::unique_ptr<Estimation> m_Estimation;
};

// The library instantiates these classes once.
#define SensorNoise_EXTERN(TPixel) extern template class SensorNoise_EXPORT SensorNoiseEstimator<Image<TPixel, 3>>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_EXTERN);
#undef SensorNoise_EXTERN

} // namespace itk

#endif
