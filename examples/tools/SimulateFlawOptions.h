// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef SimulateFlawOptions_h
#define SimulateFlawOptions_h

#include <string>
#include <utility>
#include <vector>

namespace CLI
{
class App;
}

namespace sensornoise::tools
{

/** Options of simulate-sensor-noise for the deviations of real sensors and cameras: SensorFlaws and fixed-pattern
 * noise. All are off by default. */
struct SimulateFlawOptions
{
  std::string                    bayer{ "none" };
  std::vector<double>            transmission;
  double                         prnu{ 0.0 };
  double                         dsnu{ 0.0 };
  std::vector<double>            hotPixels;
  double                         gainPattern{ 0.0 };
  double                         columnGainPattern{ 0.0 };
  double                         columnEfficiencyPattern{ 0.0 };
  double                         columnOffsetPattern{ 0.0 };
  double                         brighterFatter{ 0.0 };
  double                         coupling{ 0.0 };
  double                         readNoiseSpread{ 0.0 };
  std::vector<double>            readNoiseTail;
  std::pair<std::string, double> response{ "straight", 0.0 };
  double                         rowNoise{ 0.0 };
  double                         columnNoise{ 0.0 };
  std::vector<double>            banding;
  double                         defectCorrection{ 0.0 };
  double                         temporalFilter{ 0.0 };
  double                         smoothing{ 0.0 };
  unsigned int                   median{ 0 };
  unsigned int                   binning{ 1 };
  std::string                    binningInterpolation{ "nearest" };
  std::vector<double>            resampling;
  std::string                    resamplingInterpolation{ "linear" };
  unsigned int                   blockQuality{ 0 };
  unsigned int                   companding{ 0 };
  unsigned int                   repeat{ 1 };
  unsigned int                   repeatPeriod{ 1 };
  bool                           isDark{ false };

  /** Adds the options, in separate groups. */
  void
  AddTo(CLI::App & app);

  /** Adds the options of the processing in the camera. AddTo() calls it. */
  void
  AddProcessingTo(CLI::App & app);

  /** Sets the options of an itk::SensorNoiseStackSource. */
  template <typename TSource>
  void
  ApplyTo(TSource & source) const;
};

template <typename TSource>
void
SimulateFlawOptions::ApplyTo(TSource & source) const
{
  source.SetBayerPattern(bayer);
  if (!transmission.empty())
  {
    source.SetTransmissionR(transmission[0]);
    source.SetTransmissionG(transmission[1]);
    source.SetTransmissionB(transmission[2]);
  }
  source.SetPrnuSd(prnu);
  source.SetDsnuSd(dsnu);
  if (!hotPixels.empty())
  {
    source.SetHotPixelFraction(hotPixels[0]);
    source.SetHotPixelNoiseFactor(hotPixels[1]);
  }
  source.SetGainSd(gainPattern);
  source.SetColumnGainSd(columnGainPattern);
  source.SetColumnEfficiencySd(columnEfficiencyPattern);
  source.SetColumnOffsetSd(columnOffsetPattern);
  source.SetBrighterFatterPerElectron(brighterFatter);
  source.SetCouplingFraction(coupling);
  source.SetReadNoiseSpread(readNoiseSpread);
  if (!readNoiseTail.empty())
  {
    source.SetReadNoiseTailFraction(readNoiseTail[0]);
    source.SetReadNoiseTailSpread(readNoiseTail[1]);
  }
  source.SetResponseShape(response.first);
  source.SetResponseSize(response.second);
  source.SetRowNoiseSd(rowNoise);
  source.SetColumnNoiseSd(columnNoise);
  if (!banding.empty())
  {
    source.SetBandingAmplitude(banding[0]);
    source.SetBandingPeriod(banding[1]);
  }
  source.SetDefectThresholdSd(defectCorrection);
  source.SetTemporalFilterWeight(temporalFilter);
  source.SetMedianRadius(median);
  source.SetSmoothingSd(smoothing);
  source.SetBinningFactor(binning);
  source.SetBinningInterpolation(binningInterpolation);
  if (!resampling.empty())
  {
    source.SetResamplingShiftX(resampling[0]);
    source.SetResamplingShiftY(resampling[1]);
  }
  source.SetResamplingInterpolation(resamplingInterpolation);
  source.SetBlockQuality(blockQuality);
  source.SetCompandingBits(companding);
  source.SetRepeatCount(repeat);
  source.SetRepeatPeriod(repeatPeriod);
  source.SetDark(isDark);
}

} // namespace sensornoise::tools

#endif
