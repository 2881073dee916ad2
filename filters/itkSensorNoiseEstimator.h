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
#include "itkSensorNoiseStackSink.h"
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
   * \brief How the noise is estimated.
   * \ingroup SensorNoise
   */
  enum class Method : uint8_t
  {
    Published = 0, ///< Figure 2 of Sur & Gredi\'ac 2015, to the letter: even areas only, no errors
    Refined = 1    ///< all pixels of a still scene, with standard errors
  };
};

/** \class SensorNoiseEstimator
 * \brief Measures gain, offset and read noise of a camera, flicker and vibration, from a stack of a static scene.
 *
 * Inputs: 0 the stack, raw frames along the last axis, at least 5; "Mask", optional, of a frame's size: pixels of
 * value 0 are left out; "Dark", optional, for the method Refined: a stack of frames of the same size taken without
 * light. Outputs: 0 the report (decorated sensornoise::Report: value, status and unit of each quantity); of a frame's
 * size 1 mean [DN], 2 variance [DN^2], 3 corrected variance [DN^2] (NaN: not known), 4 pixel use
 * (sensornoise::PixelUse: 0 used, else why not); with two dark frames or more, of every pixel by itself, 5 offset, 6
 * and 7 the ends of its 95 % interval, 8 read noise, 9 and 10 the ends of its interval [DN] (NaN: not known, see
 * sensornoise::PixelCalibration), which have no pixels otherwise; of a Bayer mosaic 11 the channels' reports in place
 * of 0.
 *
 * The method Refined, the default, regresses every frame on the mean image and its derivatives, which gives flicker,
 * offset and motion, takes these out of every pixel, and fits the variance that is left with the weights of its own
 * noise: edges and texture take part, and what is measured of the sensor has a standard error and a 95 % interval.
 * Light that changes in some places in another way than in others is looked for and allowed for. Read noise and
 * intercept are the sensor's, without the noise of rounding to codes (total_intercept keeps that). See
 * sensornoise::RefinedMethod.
 *
 * The method Published gives the numbers of the chain TemporalStatistics - VibrationMask - FlickerCorrection -
 * TemporalStatistics - NoiseRegression to rounding, and no errors. See sensornoise::PublishedMethod.
 *
 * Both take three passes over the stack, in chunks (see SensorNoiseStackSink), and one over the dark frames. Threaded;
 * the same bits for any number of threads and chunks. Memory, beside one chunk: see MemoryLimit (Published: 40 bytes a
 * pixel).
 *
 * A stack that cannot be measured gives a report whose quantities are `failed` or `not-identifiable`, with a warning
 * that says why. Wrong use (fewer than 5 frames, frames under 3 x 3 pixels, a bit depth below the data, dark frames
 * whose black level is cut off) throws.
 *
 * F. Sur, M. Gredi\'ac, SIAM J. Imaging Sci. 8(1), 2015, https://doi.org/10.1137/140977035.
 *
 * \tparam TStack itk::Image of 3 dimensions (x, y, time) of unsigned char, unsigned short, short, float or double.
 * \ingroup SensorNoise
 */
template <typename TStack>
class ITK_TEMPLATE_EXPORT SensorNoiseEstimator : public SensorNoiseStackSink<TStack>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(SensorNoiseEstimator);

  using Self = SensorNoiseEstimator;
  using Superclass = SensorNoiseStackSink<TStack>;
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

  void
  SetNumberOfStreamDivisions(unsigned int number) override
  {
    Superclass::SetNumberOfStreamDivisions(number);
  }

  itkSetInputMacro(Mask, MaskImageType);
  itkGetInputMacro(Mask, MaskImageType);

  /** Frames without light, of the frames' size and at their exposure, gain and temperature (Refined only): they give
   * the offset and, from two frames on, the read noise. Read in chunks. Not together with Offset. */
  itkSetInputMacro(Dark, TStack);
  itkGetInputMacro(Dark, TStack);

  /** How the noise is estimated: Refined (default) or Published. */
  void
  SetMethod(MethodEnum method);
  /** The same by name: "refined" or "published". */
  void
  SetMethod(const std::string & name);
  MethodEnum
  GetMethod() const
  {
    return m_Method;
  }

  std::string
  GetMethodName() const
  {
    return m_Method == MethodEnum::Refined ? "refined" : "published";
  }

  /** The offset [DN], if it is known (Refined only): offset and read noise then need no flicker, and steady light is
   * told from the offset. NaN (default): not known, but for the level of masked pixels, where the input's metadata have
   * it with its error (sensornoise::MetaDataKeys) and there are no dark frames. */
  itkSetMacro(Offset, double);
  itkGetConstMacro(Offset, double);

  /** Standard error of Offset [DN], 0 or more. Default 0. */
  itkSetMacro(OffsetStandardError, double);
  itkGetConstMacro(OffsetStandardError, double);

  /** Level of the test that finds pixels moved by vibrations, a probability. Default 0.01. Refined does without. */
  itkSetMacro(Level, double);
  itkGetConstMacro(Level, double);

  /** Quantiles of the mean at which the bright and the dark set lie, 0 to 1. Defaults 0.99 and 0.01. Refined does
   * without. */
  itkSetMacro(BrightQuantile, double);
  itkGetConstMacro(BrightQuantile, double);
  itkSetMacro(DarkQuantile, double);
  itkGetConstMacro(DarkQuantile, double);

  /** Whether the flicker may differ from row to row: Off, Auto (default: found out, and sigma_y chosen by
   * cross-validation) or Fixed (with SigmaRows). Refined looks for any light that changes in some places in another way
   * than in others, unless Off; to it, Fixed is Auto. */
  void
  SetRollingShutter(RollingShutterEnum mode);
  /** The same by name: "off", "auto" or "fixed". */
  void
  SetRollingShutter(const std::string & name);
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

  /** sigma_y of (3.28) for RollingShutter Fixed [rows]. Default 50, the paper's. Refined does without. */
  itkSetMacro(SigmaRows, double);
  itkGetConstMacro(SigmaRows, double);

  /** Axis along which the shutter travels: 1 = y (default, row by row), 0 = x (column by column). Refined does without.
   */
  itkSetMacro(ShutterAxis, unsigned int);
  itkGetConstMacro(ShutterAxis, unsigned int);

  /** Bits of the sensor's codes, 1 to 16; 0 (default): found. Data beyond them are refused. What the input's metadata
   * say of the camera (sensornoise::MetaDataKeys) goes before what is found, here and for the highest level. */
  itkSetMacro(BitDepth, unsigned int);
  itkGetConstMacro(BitDepth, unsigned int);

  /** Lowest and highest level that the sensor attains [DN]; NaN (default): found. */
  itkSetMacro(ClipLow, double);
  itkGetConstMacro(ClipLow, double);
  itkSetMacro(ClipHigh, double);
  itkGetConstMacro(ClipHigh, double);

  /** Levels between which the variance is fitted [DN] (Refined only), for sensors whose response is straight in a part
   * of its range. The level of a pixel is the mean of its neighbours; those outside have the pixel use OutsideRange.
   * Defaults NumericTraits<double>::NonpositiveMin() and max(): all levels. */
  itkSetMacro(LevelRangeLow, double);
  itkGetConstMacro(LevelRangeLow, double);
  itkSetMacro(LevelRangeHigh, double);
  itkGetConstMacro(LevelRangeHigh, double);

  /** Exposure of each frame of the stack, in the order of the frames, in any unit (Refined only): exposure times, or
   * irradiations; 0: a dark frame. Finite, 0 or more, at least 3 different values. With them the report has the
   * linearity error of EMVA 1288, and offset and responsivity of a line through the levels. Empty (default): not given.
   * An ExceptionObject at Update() if there is not one exposure for each frame. */
  void
  SetExposures(const std::vector<double> & exposures);
  std::vector<double>
  GetExposures() const
  {
    return m_Exposures;
  }

  /** Excess noise factor F of the sensor, 1 or more [1]: the gain is the slope of the variance divided by F.
   * About 2 in an EMCCD; 1 (default): none. An ExceptionObject at Update() if it is
   * less. */
  itkSetMacro(ExcessNoiseFactor, double);
  itkGetConstMacro(ExcessNoiseFactor, double);

  /** Spacing of the codes [DN]; 0 (default): found. */
  itkSetMacro(QuantisationStep, double);
  itkGetConstMacro(QuantisationStep, double);

  /** Most memory that the estimate may take beside one chunk of a stack that is not in memory [bytes] (Refined only).
   * 0 (default): as much as it needs, 56 bytes a pixel of a frame and 8 more for each series of light and motion that
   * is found. With less the stack is read more often, with the same result, unless it is in memory and no mosaic, which
   * needs no more than that; less than 64 bytes a pixel, 20 kB a frame and 32 MiB is refused. */
  itkSetMacro(MemoryLimit, SizeValueType);
  itkGetConstMacro(MemoryLimit, SizeValueType);

  /** What was recorded may be more than the stack: the rectangle of each frame, and the frames from \a first up to but
   * not \a end, that the stack was cut out of. Noted in the report's settings, so that the measurement can be repeated;
   * nothing is cut here, and no number changes. By default nothing is noted. Throws for a rectangle, or a range, that
   * is not of the stack's size at Update(). */
  void
  SetSourceRegion(SizeValueType x, SizeValueType y, SizeValueType width, SizeValueType height);
  void
  SetSourceFrames(SizeValueType first, SizeValueType end);
  const sensornoise::StackSelection &
  GetSource() const
  {
    return m_Source;
  }

  /** SHA-256 of the frames, and of the dark ones, 64 hexadecimal digits, by which the report is known to be of them: of
   * \a files files with that many \a bytes, or, if these are 0, of the pixels (see sensornoise::InputFiles, which says
   * of what bytes). Noted as the report's input; whoever computes it sees to it that they are the bytes that are
   * measured. An empty text (default): nothing is noted. */
  void
  SetFramesHash(const std::string & sha256, SizeValueType files, SizeValueType bytes);
  void
  SetDarkHash(const std::string & sha256, SizeValueType files, SizeValueType bytes);

  /** Colour filters in front of the pixels. "none" (default): the frames are those of a monochrome sensor. "RGGB",
   * "GRBG", "GBRG" or "BGGR", the colours of the stack's upper left pixels: each of the four planes is measured by
   * itself, and there are channel reports in place of the report; each pass still reads the stack once, and the maps
   * stay those of the mosaic. "auto": as the input's MetaDataDictionary says (sensornoise::MetaDataKeys), else as the
   * levels of its first frame tell. Mask and Dark are mosaics, too. */
  void
  SetBayerPattern(const std::string & name);
  itkGetConstReferenceMacro(BayerPattern, std::string);

  /** Whether the stack was measured as a mosaic, of which there are the channels' reports and not one report. */
  bool
  HasChannelReports() const
  {
    return static_cast<const ChannelReportsObjectType *>(this->ProcessObject::GetOutput(ChannelReportsOutput))->Has();
  }
  /** The reports of a mosaic's channels, as a pipeline output and themselves; an ExceptionObject where there are none.
   */
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

  /** The report as a pipeline output, and itself. Before Update(), and after one that failed in its work, there is
   * none: an ExceptionObject, of all that asks for it. */
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

  /** The report as JSON, schema "itk-sensornoise-report/1"; of a mosaic those of all channels in one record. */
  std::string
  GetReportAsJson() const
  {
    return this->HasChannelReports() ? sensornoise::ToJson(this->GetChannelReports())
                                     : sensornoise::ToJson(this->GetReport());
  }
  /** The report of one channel of a mosaic, "R", "G1", "G2" or "B", as JSON and as a table. */
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
  /** The report as a table that a person can read, as `estimate-sensor-noise` prints it, and its warnings. */
  std::string
  GetReportAsText() const
  {
    return this->HasChannelReports() ? sensornoise::MakeText(this->GetChannelReports())
                                     : sensornoise::MakeText(this->GetReport());
  }

  /** The report as one HTML page with figures and maps, which needs no other file. \see sensornoise::ToHtml */
  std::string
  GetReportAsHtml() const;

  /** Variance against mean as an SVG file; of a mosaic that of the channel "G1". \see sensornoise::ToSvg */
  std::string
  GetReportAsSvg() const;

  /** The same of one channel of a mosaic; its page is without maps. */
  std::string
  GetChannelReportAsHtml(const std::string & channel) const;
  std::string
  GetChannelReportAsSvg(const std::string & channel) const;

  /** The numbers of the figures as JSON; of a mosaic an object for each channel. \see sensornoise::FigureAsJson */
  std::string
  GetFigureAsJson() const;

  /** All warnings and quantities that a report may have, as JSON. \see sensornoise::CatalogueAsJson */
  static std::string
  GetCatalogueAsJson()
  {
    return sensornoise::CatalogueAsJson();
  }

  /** Whether the stack has the noise of a model, level by level: its corrected variance against variance slope [DN/e-]
   * and total intercept [DN^2] of another stack's report, whose read noise [e-] and quantisation step [DN] help to say
   * it (NaN: not known). As JSON, schema "itk-sensornoise-check/1", and as a table for people. \see
   * sensornoise::NoiseModelCheck */
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

  /** What neighbours and frames share of their noise: kind, coefficients by lag, noise of rows and columns. Null where
   * it was not measured (method Published, few pixels or frames). Stands until the next Update(). \see
   * NoiseCorrelationEstimator */
  const sensornoise::NoiseCorrelationRecord *
  GetNoiseCorrelation() const
  {
    const auto & correlation = this->GetReport().noiseCorrelation;
    return correlation ? &*correlation : nullptr;
  }
  /** Its kind: "white", "filtered" ...; "not-measured". */
  std::string
  GetNoiseKind() const
  {
    const auto * correlation = this->GetNoiseCorrelation();
    return correlation != nullptr ? correlation->kind : "not-measured";
  }

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

  /** Offset of every pixel by itself, from the dark frames, and the ends of its 95 % interval [DN]. An image without
   * pixels where there are fewer than two dark frames. */
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

  /** Read noise of every pixel by itself, without that of rounding to codes, and the ends of its 95 % interval [DN]; as
   * the offset. */
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
  /** All: what is made anew of the pixels for each piece, and their sums, then need not be. */
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
  friend class SensorNoiseSums<TStack>; // goes through the passes itself

  /** \a withoutMerging: no sums are saved or merged. */
  void
  StartEstimation(bool withoutMerging);

  // The six maps of the dark frames stand after the others.
  static constexpr DataObjectPointerArraySizeType FirstPixelOutput = 5;
  static constexpr DataObjectPointerArraySizeType ChannelReportsOutput = FirstPixelOutput + 6;

  // The method at work.
  struct Estimation;

  const sensornoise::Report &
  GetChannelReport(const std::string & channel) const;
  std::optional<SensorNoiseMosaic>
  FindMosaic();
  /** Offset and read noise of the dark frames, or what was given of the offset; of each plane of a mosaic. */
  std::vector<std::optional<sensornoise::KnownOffset>>
  FindOffsets(const SensorNoiseStack & stack);
  /** The hashes that were given, of what there is. */
  std::optional<sensornoise::InputRecord>
  GetInputRecord() const;
  sensornoise::NoiseModelCheck
  CheckModel(double varianceSlope, double totalIntercept, double readNoiseElectrons, double quantisationStep) const;
  bool
  HasLevelRange() const;
  sensornoise::PublishedSettings
  MakePublishedSettings() const;
  /** What the input's metadata say, and what follows from it where nothing else was set. */
  sensornoise::CameraSettings
  GetCamera() const;
  sensornoise::CodeSettings
  MakeCodeSettings() const;
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
  unsigned int        m_BitDepth{ 0 };
  double              m_ClipLow{ std::numeric_limits<double>::quiet_NaN() };
  double              m_ClipHigh{ std::numeric_limits<double>::quiet_NaN() };
  double              m_LevelRangeLow{ NumericTraits<double>::NonpositiveMin() };
  double              m_LevelRangeHigh{ NumericTraits<double>::max() };
  double              m_QuantisationStep{ 0.0 };
  std::vector<double> m_Exposures;
  double              m_ExcessNoiseFactor{ 1.0 };
  SizeValueType       m_MemoryLimit{ 0 };
  std::string         m_BayerPattern{ "none" };

  sensornoise::BayerSource m_BayerSource{ sensornoise::BayerSource::Given }; // of a pattern that is not auto

  sensornoise::StackSelection m_Source;
  sensornoise::InputFiles     m_FramesHash;
  sensornoise::InputFiles     m_DarkHash;

  std::unique_ptr<Estimation> m_Estimation;
};

// Instantiated once, in the library.
#define SensorNoise_EXTERN(TPixel) extern template class SensorNoise_EXPORT SensorNoiseEstimator<Image<TPixel, 3>>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_EXTERN);
#undef SensorNoise_EXTERN

} // namespace itk

#endif
