// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_exports_SensorExports_h
#define sensornoise_exports_SensorExports_h

#include "sensornoise/NoiseExport.h"

namespace sensornoise
{

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

} // namespace sensornoise

#endif
