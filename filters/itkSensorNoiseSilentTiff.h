/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#ifndef itkSensorNoiseSilentTiff_h
#define itkSensorNoiseSilentTiff_h

namespace sensornoise
{

/** As long as it lives, libtiff, ITK's or the system's, writes no lines to standard error, where the program can be
 * asked for it (POSIX). What matters there is found by InspectFrameFile(), and the other lines are of tags it does not
 * know. */
class SilentTiff
{
public:
  SilentTiff();
  ~SilentTiff();
  SilentTiff(const SilentTiff &) = delete;
  SilentTiff &
  operator=(const SilentTiff &) = delete;

private:
  using Handler = void (*)(); // libtiff's: what is done with it is only to hand it back
  Handler m_Warning{ nullptr };
  Handler m_Error{ nullptr };
};

} // namespace sensornoise

#endif
