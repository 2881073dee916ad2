// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_exports_ExportFormats_h
#define sensornoise_exports_ExportFormats_h

#include "sensornoise/NoiseExport.h"

#include <string>
#include <utility>
#include <vector>

namespace sensornoise
{

// The formats of the table in NoiseExport.cxx, each a function of the noise of a camera.

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

/** Returns the pairs (scale, offset) of the tag NoiseProfile in the first directory of a DNG file. Throws ExportError
 * unless \a file is a classic TIFF whose first directory is whole and has the tag, of pairs of doubles. */
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

/** Maps of the pixels as TIFF files of 32-bit floating-point numbers, a row of the file for a row of the sensor:
 * offset.tif [DN] and variance.tif, the square of the read noise [DN^2]. Of a sensor without a mosaic with a gain, also
 * variance_electrons.tif [e-^2]. Throws ExportError if the report has no maps. */
NoiseExport
ExportMaps(const CameraNoise & noise);

} // namespace sensornoise

#endif
