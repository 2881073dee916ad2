// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_exports_ExportFormats_h
#define sensornoise_exports_ExportFormats_h

#include "SensorNoiseExport.h"
#include "sensornoise/NoiseExport.h"
#include "sensornoise/NoiseModel.h"

#include <string>
#include <utility>
#include <vector>

/** \file
 * The formats of the table in NoiseExport.cxx, each a function of the noise of a camera, and the numbers that they
 * take. */

namespace sensornoise
{

/** The variance on the scale where the black level is 0 and the white level is 1: scale x + offset. */
struct NormalisedLine
{
  double scale{ 0.0 };  ///< S = a / (W - B)
  double offset{ 0.0 }; ///< O = (b + a B) / (W - B)^2
};

/** The parameters of a sensor in the units of most records. */
struct SensorNumbers
{
  double offsetDn{ 0.0 };
  double electronsPerDn{ 0.0 };
  double readNoiseElectrons{ 0.0 };
};

/** The only channel. Throws ExportError, with the name of the \a format, if the report has several. */
const ChannelNoise &
OnlyChannel(const CameraNoise & noise, const std::string & format);

/** The noise model of a channel. Throws ExportError if it is not identified, or its slope is not above 0 and finite. */
NoiseModel
ModelOf(const CameraNoise & noise, const ChannelNoise & channel);

/** The line of a channel between the black and the white level. Throws ExportError if a level is missing, or the
 * variance at the black level is negative, or a number is not finite. */
NormalisedLine
NormalisedLineOf(const CameraNoise & noise, const ChannelNoise & channel);

/** The gain of a channel [DN/e-]. Throws ExportError if it is not identified, or not above 0 and finite. */
double
GainOf(const CameraNoise & noise, const ChannelNoise & channel);

/** The dark offset of a channel [DN]. Throws ExportError if it is not identified. */
double
OffsetOf(const CameraNoise & noise, const ChannelNoise & channel);

/** Offset, electrons per DN and read noise of a channel. Throws ExportError if one is not identified, or not finite, or
 * the read noise is negative. */
SensorNumbers
SensorNumbersOf(const CameraNoise & noise, const ChannelNoise & channel);

/** The black level, or the white level [DN]. Throws ExportError if it is missing. */
double
BlackLevelOf(const CameraNoise & noise);
double
WhiteLevelOf(const CameraNoise & noise);

/** Throws ExportError, with the name of the \a format, if a report has no ISO speed, or another number of channels than
 * the first one. */
void
RequireIsoSpeeds(const std::vector<CameraNoise> & settings, const std::string & format);

/** A file of this name with this text, alone. */
NoiseExport
OneFile(const std::string & name, const std::string & bytes, const std::string & note = {});

/** The tag NoiseProfile as text: the numbers of all pairs, scale and offset, as exiftool takes them. */
NoiseExport
ExportDng(const CameraNoise & noise);

/** The gains and noise offsets of all channels for ndsafir: gain x + offset. */
NoiseExport
ExportNdsafir(const CameraNoise & noise);

/** The arguments of the package anscombe-transform: the variance is conversion_gain (x - zero_level), and the zero
 * level is a whole number. */
NoiseExport
ExportAnscombeTransform(const CameraNoise & noise);

/** The arguments of deepinv's PoissonGaussianNoise for levels between 0 and 1: the variance is gain x + sigma^2. */
NoiseExport
ExportDeepinv(const CameraNoise & noise);

/** Returns the pairs (scale, offset) of the tag NoiseProfile in the first directory of a DNG file, else in the raw
 * directory of its SubIFDs. Throws ExportError unless \a file is a classic TIFF whose directories are whole, and one of
 * both has the tag, of pairs of doubles. */
std::vector<std::pair<double, double>>
NoiseProfileIn(const std::string & file);

/** An entry of PYME's camera noise properties, YAML: ADOffset [ADU], ElectronsPerCount, ReadNoise [e-],
 * SaturationThreshold [ADU]. */
NoiseExport
ExportPyme(const CameraNoise & noise);

/** A camera of picasso's config.yaml: Baseline [ADU], Sensitivity [e-/ADU]. */
NoiseExport
ExportPicasso(const CameraNoise & noise);

/** The camera parameters of SMAP, JSON: offset [ADU], conversion [e-/ADU], emgain. */
NoiseExport
ExportSmap(const CameraNoise & noise);

/** The section Camera of DECODE's parameters, YAML: baseline [ADU], e_per_adu, read_sigma [e-]; em_gain is empty. */
NoiseExport
ExportDecode(const CameraNoise & noise);

/** The command "Camera setup" of ThunderSTORM as a macro of ImageJ: offset [ADU], photons2adu, which is photoelectrons
 * per ADU. */
NoiseExport
ExportThunderstorm(const CameraNoise & noise);

/** Two header cards of FITS, 80 characters each: EGAIN [e-/ADU] and RDNOISE [e-]. GAIN is not written: some cameras
 * store their gain setting in it. */
NoiseExport
ExportFits(const CameraNoise & noise);

/** The arguments of ccdproc as JSON, each with its unit of astropy: gain, readnoise, and the offset to be subtracted.
 */
NoiseExport
ExportCcdproc(const CameraNoise & noise);

/** Gain and noise of each amplifier with their standard errors, JSON, with the names of LSST's
 * PhotonTransferCurveDataset. A channel is an amplifier. Errors that are not known are null. */
NoiseExport
ExportLsst(const CameraNoise & noise);

/** The results of the program emva1288 as XML: K, inverse_K and sigma_d of the section sensitivity. */
NoiseExport
ExportEmva1288(const CameraNoise & noise);

/** A GaussianMixtureNoiseModel of CAREamics with one Gaussian, between the darkest and the brightest level. Its
 * variance is exp(w0) + exp(w1) (x - min_signal) / (max_signal - min_signal), with w the second row of trained_weight.
 * Throws ExportError unless the variance at the darkest level is above 0 and the levels are known. */
NoiseExport
ExportCareamics(const CameraNoise & noise);

/** Maps of the pixels by the names and in the units of their programs, each row of the frames a row of the file. TIFF
 * files have 32-bit floating-point numbers.
 * - navigate: SERIAL_off.tiff [DN] and SERIAL_var.tiff, the square of the read noise [DN^2];
 * - PYME: dark_<ms>ms.tif [DN] and variance_<ms>ms.tif [e-^2], with the exposure, or without the number if it is not
 *   known;
 * - SMAP: smap_camera.mat with offsetmap [DN], varmap [DN^2] and gainmap [e-/DN], equal for all pixels.
 *
 * The files for PYME and SMAP need a gain, and a sensor without a mosaic. Throws ExportError if the report has no maps.
 */
NoiseExport
ExportMaps(const CameraNoise & noise);

/** Factor by which rpi-ctt 1.4.0 multiplies the slope that it stores [1]. */
constexpr double libcameraSlopeFactor = 1.4;

/** The numbers of rpi.noise, as a tuning file of libcamera has them. */
struct LibcameraNoise
{
  double constant{ 0.0 }; ///< reference_constant [DN of 16 bits]
  double slope{ 0.0 };    ///< reference_slope [root of DN of 16 bits]
};

/** Fits libcamera's model to a camera. Throws ExportError if the line, a level or the bit depth is missing. */
SensorNoise_EXPORT LibcameraNoise
FitLibcamera(const CameraNoise & noise);

/** Returns the variance of libcamera's model at a level [DN^2]: at the black level where the level is below. The camera
 * gives bit depth, analogue gain and black level. Throws ExportError if one is missing. */
double
LibcameraVariance(const LibcameraNoise & model, const CameraNoise & noise, double levelDn);

/** The section rpi.noise of a tuning file of libcamera, JSON. On a scale of 16 bits, at the analogue gain G, its
 * standard deviation is sqrt(G) (constant + slope sqrt(mean - black)). The constant and the slope are fitted between
 * the black and the white level at the gain of the burst, and stored as the tuning tool rpi-ctt 1.4.0 does:
 * int(constant) and round(1.4 slope, 3). Channels of a mosaic are averaged. The note has the largest error of the fit.
 */
NoiseExport
ExportLibcamera(const CameraNoise & noise);

/** The coefficients of Android's sensor noise model (CTS, dng_noise_model.py), JSON: for each channel S = A iso + B and
 * O = C iso^2 + D d^2 with d = max(1, iso / max_analog_iso), where S and O are the pair of NoiseProfile at this ISO
 * speed. The fits weight relative errors, and no coefficient of O is negative. The note has the largest error of the
 * variance. Throws ExportError unless two reports have different ISO speeds and all have the same channels. */
NoiseExport
ExportAndroid(const std::vector<CameraNoise> & settings);

} // namespace sensornoise

#endif
