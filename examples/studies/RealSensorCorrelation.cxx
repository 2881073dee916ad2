// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "studies/RealSensorCorrelation.h"

namespace sensornoise::tools
{

std::string
KindOf(const Report & report)
{
  return report.noiseCorrelation ? report.noiseCorrelation->kind : "";
}

Quantity
RowNoiseOf(const Report & report)
{
  return report.noiseCorrelation ? report.noiseCorrelation->rowNoise : Quantity();
}

Quantity
ColumnNoiseOf(const Report & report)
{
  return report.noiseCorrelation ? report.noiseCorrelation->columnNoise : Quantity();
}

} // namespace sensornoise::tools
