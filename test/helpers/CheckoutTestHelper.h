// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_test_CheckoutTestHelper_h
#define sensornoise_test_CheckoutTestHelper_h

#include <string>

/** Returns the folder of the command-line tools that the tests run. */
std::string
ToolFolder();

/** Returns the folder of the checkout, for documents and stored reports. */
std::string
SourceFolder();

#endif
