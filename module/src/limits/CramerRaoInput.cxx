// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "limits/CramerRaoInput.h"

namespace sensornoise
{
double
CramerRaoInput::TotalReadVarianceDn2() const
{
  const double readNoiseDn = truth->settings.camera.readNoiseDn;
  return readNoiseDn * readNoiseDn + quantisationStepDn * quantisationStepDn / 12.0;
}

double
CramerRaoInput::MeanFluxPerElectronDn() const
{
  double sum = 0.0;
  for (const double gamma : truth->series.gamma)
  {
    sum += 1.0 + gamma;
  }
  return truth->settings.camera.gainDnPerElectron * sum / static_cast<double>(truth->series.gamma.size());
}

} // namespace sensornoise
