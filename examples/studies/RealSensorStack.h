// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef RealSensorStack_h
#define RealSensorStack_h

#include "sensornoise/Simulator.h"
#include "studies/RealSensorSetting.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise::tools
{

/** \class RealSensorStack
 * Simulated burst of one setting, with square frames.
 *
 * The simulator scales a scene to [0, electrons]. A scene that does not fill this range gets more rows below the
 * frame. Copies of its last row come first, so that blur and vibration act as at an edge; a black and a white field
 * follow. These rows are simulated, but are not part of the frames.
 */
class RealSensorStack
{
public:
  /** Makes the simulator of a setting.
   * \param size width and height [pixel], at least 32
   * \param isDark the shutter of the same sensor is closed
   * \throws std::invalid_argument if the setting cannot be used */
  RealSensorStack(const RealSensorSetting & setting, std::size_t size, std::uint64_t seed, bool isDark = false);

  /** Returns the grey values of all frames, frame after frame [DN]. */
  std::vector<std::uint16_t>
  Render() const;

  /** Returns the simulator. Its first Pixels() pixels are the pixels of the frame. */
  const StackSimulator &
  GetSimulator() const
  {
    return m_Simulator;
  }
  std::size_t
  Pixels() const
  {
    return m_Size * m_Size;
  }

private:
  /** Renders a row that the block crosses, or that two light sources illuminate: the simulator has neither. */
  void
  RenderLitRow(std::size_t t, std::size_t y, std::uint16_t * out) const;

  void
  DrawBlock(std::size_t t, std::size_t y, std::vector<double> & electrons) const;

  RealSensorSetting   m_Setting;
  std::size_t         m_Size;
  StackSimulator      m_Simulator;
  std::vector<double> m_SourceFlicker; ///< flicker of the two light sources in each frame [1]; empty: one source
  std::vector<double> m_Block;         ///< texture of the block, as wide and high as it [1]; empty: no block
};

} // namespace sensornoise::tools

#endif
