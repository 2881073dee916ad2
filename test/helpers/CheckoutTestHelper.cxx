// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
// The only source that knows where the checkout is: all others compile to the same object in every checkout.
#include "helpers/CheckoutTestHelper.h"

std::string
ToolFolder()
{
  return SENSORNOISE_BIN;
}

std::string
SourceFolder()
{
  return SENSORNOISE_SOURCE;
}
