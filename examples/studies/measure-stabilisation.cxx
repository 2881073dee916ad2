// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
// Measures the effect of the generalized Anscombe transform and its inverses on the mean of a pixel. The
// Poisson-Gaussian distribution is integrated numerically. Printed are the variance after the transform, and the
// deviation of each inverse from the exact unbiased inverse.
//
//   measure-stabilisation

#include "sensornoise/NoiseModel.h"
#include "stabilise/NoiseModelCheck.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>

namespace
{
using sensornoise::AnscombeInverse;
using sensornoise::StabilisedMoments;

constexpr std::array<double, 9>  ReadNoises{ 0.0, 0.3, 0.5, 1.0, 2.0, 3.0, 5.0, 10.0, 30.0 };
constexpr std::array<double, 15> SignalsElectrons{ 0.0,  0.5,   1.0,   2.0,   3.0,    5.0,    10.0,   20.0,
                                                   50.0, 100.0, 300.0, 600.0, 1000.0, 3000.0, 10000.0 };

/** Returns the bias of an inverse: the inverse of the mean of stabilised values, minus the true signal [e-]. */
double
BiasOf(AnscombeInverse inverse, double electrons, double readNoise)
{
  // In units of electrons, with a = 1 and mu = 0, b is the variance of the read noise.
  const sensornoise::GeneralizedAnscombe transform({ 1.0, readNoise * readNoise });
  const double                           mean = sensornoise::MomentsOfStabilised(electrons, readNoise).mean;
  double                                 found = 0.0;
  transform.Invert(&mean, 1, &found, inverse);
  return found - electrons;
}

void
PrintTable(const char * title, const std::function<double(double electrons, double readNoise)> & valueOf)
{
  std::printf("%s\n%8s", title, "light");
  for (const double readNoise : ReadNoises)
  {
    std::printf(" %8g", readNoise);
  }
  std::printf("   read noise [e-]\n");
  for (const double electrons : SignalsElectrons)
  {
    std::printf("%8g", electrons);
    for (const double readNoise : ReadNoises)
    {
      std::printf(" %8.4f", valueOf(electrons, readNoise));
    }
    std::printf("\n");
  }
  std::printf("\n");
}

/** Prints the largest deviations for signals from \a low to \a high [e-] and read noises up to 30 e-, on a dense
 * grid. */
void
PrintWorst(double low, double high)
{
  double bias = 0.0;
  double excess = 0.0;
  for (double electrons = low; electrons <= high; electrons = std::max(electrons * 1.07, electrons + 0.05))
  {
    for (double readNoise = 0.0; readNoise <= 30.0; readNoise = std::max(readNoise * 1.1, readNoise + 0.05))
    {
      bias = std::max(bias, std::abs(BiasOf(AnscombeInverse::ExactUnbiased, electrons, readNoise)));
      excess = std::max(excess, std::abs(sensornoise::MomentsOfStabilised(electrons, readNoise).variance - 1.0));
    }
  }
  std::printf("%6g to %6g e-: closed form off by at most %.4f e-, variance by %.4f\n", low, high, bias, excess);
}
} // namespace

int
main()
{
  PrintTable("variance after the transform", [](double electrons, double readNoise) {
    return sensornoise::MomentsOfStabilised(electrons, readNoise).variance;
  });
  PrintTable("share of negative arguments", [](double electrons, double readNoise) {
    return sensornoise::MomentsOfStabilised(electrons, readNoise).negativeProbability;
  });
  for (const AnscombeInverse inverse :
       { AnscombeInverse::ExactUnbiased, AnscombeInverse::Algebraic, AnscombeInverse::Asymptotic })
  {
    PrintTable((std::string(sensornoise::NameOf(inverse)) + ": error of the signal from a mean [e-]").c_str(),
               [inverse](double electrons, double readNoise) { return BiasOf(inverse, electrons, readNoise); });
  }
  std::printf("read noise from 0 to 30 e-:\n");
  for (const std::array<double, 2> range : { std::array<double, 2>{ 0.0, 1.0 },
                                             { 1.0, 2.0 },
                                             { 2.0, 3.0 },
                                             { 3.0, 10.0 },
                                             { 10.0, 100.0 },
                                             { 100.0, 1000.0 },
                                             { 1000.0, 10000.0 } })
  {
    PrintWorst(range[0], range[1]);
  }
  return 0;
}
