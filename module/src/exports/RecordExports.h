// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_exports_RecordExports_h
#define sensornoise_exports_RecordExports_h

#include "sensornoise/NoiseExport.h"

namespace sensornoise
{

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
