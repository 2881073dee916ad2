// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/EstimateToolTestHelper.h"

#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

namespace
{

/** Flat fields and dark frames of a simulated camera, evaluated by EMVA 1288. */
class EstimateEmvaTool : public EstimateToolTest
{
protected:
  using FrameType = itk::Image<unsigned short, 2>;
  static constexpr std::size_t DarkFrames = 4;

  /** Writes stack.mha and its frames; the exposures are 0 (4 frames), then 0.1 to 1.2 with two frames each. */
  void
  MakeSeries()
  {
    m_Exposures.assign(DarkFrames, 0.0);
    for (int i = 1; i <= 12; ++i)
    {
      m_Exposures.insert(m_Exposures.end(), 2, 0.1 * i);
    }
    std::string lines;
    for (const double exposure : m_Exposures)
    {
      lines += TextOf(exposure) + "\n";
    }
    WriteText("exposures.txt", lines);
    ASSERT_EQ(
      RunCommand("\"" + ToolFolder() +
                 "/simulate-sensor-noise\" --output stack.mha --reference flat --size 64x48 --electrons 3600 "
                 "--flicker-sd 0 --vibration-sd 0,0 --prnu 0.01 --dsnu 3 --illumination exposures.txt --frames " +
                 std::to_string(m_Exposures.size())),
      0)
      << m_Message;
    m_Names = WriteList<unsigned short>(Read<StackType>(Path("stack.mha")).GetPointer(), ".tif");
  }

  static std::string
  TextOf(double number)
  {
    std::ostringstream stream;
    stream.precision(17);
    stream << number;
    return stream.str();
  }

  /** Returns the names of the frames [first, end), with semicolons. */
  std::string
  Names(std::size_t first, std::size_t end) const
  {
    std::string text;
    for (std::size_t t = first; t < end; ++t)
    {
      text += (text.empty() ? "" : ";") + m_Names[t];
    }
    return text;
  }

  /** Writes a table of the series. */
  std::string
  WriteTable(const std::string & name, const std::string & header = "exposure,files") const
  {
    std::string text = "# a comment\n" + header + "\n0," + Names(0, DarkFrames) + "\n";
    for (std::size_t t = DarkFrames; t < m_Names.size(); t += 2)
    {
      text += TextOf(m_Exposures[t]) + "," + Names(t, t + 2) + "\n";
    }
    return WriteText(name, text);
  }

  /** Writes a descriptor; a unit of exposure is a second with 5000 photons. */
  std::string
  WriteDescriptor(const std::string & size = "12 64 48") const
  {
    std::string text = "# EMVA 1288\nn " + size + "\nv 4.0\nd 0\n";
    for (std::size_t t = 0; t < m_Names.size(); ++t)
    {
      if (t >= DarkFrames && t % 2 == 0)
      {
        text += "b " + TextOf(1e9 * m_Exposures[t]) + " " + TextOf(5000.0 * m_Exposures[t]) + "\n";
      }
      text += "i .\\" + m_Names[t] + "\n";
    }
    return WriteText("descriptor.txt", text);
  }

  /** Writes a frame of stack.mha as a FITS file that records an exposure time [s]. Returns its name. */
  std::string
  WriteFits(std::size_t t, double exposure) const
  {
    constexpr std::size_t block = 2880; // block of a file [byte]
    const auto            stack = Read<StackType>(Path("stack.mha"));
    std::string           text;
    const auto            add = [&text](std::string card) {
      card.resize(80, ' ');
      text += card;
    };
    add("SIMPLE  = T");
    add("BITPIX  = 16");
    add("NAXIS   = 2");
    add("NAXIS1  = 64");
    add("NAXIS2  = 48");
    add("EXPTIME = " + TextOf(exposure));
    add("END");
    text.resize(block, ' ');
    const unsigned short * const pixels = stack->GetBufferPointer() + t * 64 * 48;
    for (std::size_t p = 0; p < std::size_t{ 64 * 48 }; ++p)
    {
      text += static_cast<char>(pixels[p] >> 8U);
      text += static_cast<char>(pixels[p] & 0xFFU);
    }
    text.resize((text.size() + block - 1) / block * block, '\0');
    return WriteText("frame_" + std::to_string(100 + t) + ".fits", text);
  }

  /** Expects the exit code 2, and one sentence with these parts. */
  void
  Refuses(const std::string & arguments, const std::vector<std::string> & parts)
  {
    SCOPED_TRACE(arguments);
    EXPECT_EQ(Run(arguments), 2);
    SaysInOneSentence(parts);
  }

  std::vector<double>      m_Exposures;
  std::vector<std::string> m_Names;
};
} // namespace

TEST_F(EstimateEmvaTool, AStackATableAndADescriptorGiveTheSameCamera)
{
  MakeSeries();
  const auto stack = ReportOf("stack.mha --method emva1288 --exposures exposures.txt --bit-depth 12");
  const auto table = ReportOf(WriteTable("list.csv") + " --method emva1288 --bit-depth 12");
  const auto descriptor = ReportOf(WriteDescriptor() + " --method emva1288");
  EXPECT_EQ(stack["schema"], "itk-sensornoise-emva1288/1");
  EXPECT_EQ(table["sensitivity"], stack["sensitivity"]);
  EXPECT_EQ(table["spatial"], stack["spatial"]);
  EXPECT_EQ(table["linearity"], stack["linearity"]);
  EXPECT_EQ(descriptor["sensitivity"]["gain"], stack["sensitivity"]["gain"]);
  EXPECT_EQ(descriptor["settings"]["bit_depth"], 12);
  EXPECT_EQ(descriptor["settings"]["exposure_unit"], "s");
  // 3600 electrons of 5000 photons. The gain of pairs of 3072 pixels is known to 2 %.
  EXPECT_NEAR(descriptor["sensitivity"]["quantum_efficiency"]["value"].get<double>(), 72.0, 5.0);
  EXPECT_NEAR(stack["sensitivity"]["gain"]["value"].get<double>(), 1.0, 0.07);
}

TEST_F(EstimateEmvaTool, ATableHasPhotonsKindsUnitsAndStacks)
{
  MakeSeries();
  std::string text = "exposure_ms\tphotons\tkind\tfile\n";
  for (std::size_t t = DarkFrames; t < m_Names.size(); t += 2)
  {
    const auto pair =
      Cut<unsigned short>(Read<StackType>(Path("stack.mha")), { { 0, 0, static_cast<long>(t) } }, { { 64, 48, 2 } });
    const auto   name = "pair" + TextOf(static_cast<double>(t)) + ".mha";
    const double milliseconds = 10.0 * m_Exposures[t];
    text += TextOf(milliseconds) + "\t" + TextOf(5000.0 * m_Exposures[t]) + "\tflat\t" +
            Write(name, pair.GetPointer()) + "\n";
    text += TextOf(milliseconds) + "\t\tDARK\tframe_10[0-3].tif\n";
  }
  const auto report = ReportOf(WriteText("list.tsv", text) + " --method emva1288");
  EXPECT_EQ(report["settings"]["exposure_unit"], "s");
  EXPECT_DOUBLE_EQ(report["points"][0]["exposure"].get<double>(), 0.001);
  EXPECT_EQ(report["points"][0]["photons"], 500.0);
  EXPECT_EQ(report["dark_current"]["dark_current"]["unit"], "e-/s");
  EXPECT_NEAR(
    report["dark_current"]["dark_current"]["value"].get<double>(), 0.0, 1e-9); // the same dark frames at all exposures
}

TEST_F(EstimateEmvaTool, WritesTableAndXml)
{
  MakeSeries();
  ASSERT_EQ(Run(WriteDescriptor() + " --method emva1288 --xml results.xml --json report.json"), 0) << m_Message;
  EXPECT_NE(m_Output.find("system gain"), std::string::npos);
  EXPECT_NE(m_Output.find("Release 4.0"), std::string::npos);
  const std::string xml = ReadText(Path("results.xml"));
  const auto        report = nlohmann::json::parse(ReadText(Path("report.json")));
  const auto        valueOf = [&xml](const std::string & name) {
    const std::size_t element = xml.find("<" + name + ">");
    const std::size_t value = xml.find("<value>", element) + 7;
    return element == std::string::npos ? -1.0 : std::stod(xml.substr(value));
  };
  EXPECT_EQ(valueOf("K"), report["sensitivity"]["gain"]["value"].get<double>());
  EXPECT_EQ(valueOf("PRNU1288"), report["spatial"]["prnu"]["value"].get<double>());
  EXPECT_EQ(valueOf("LE_max"), report["linearity"]["highest_deviation"]["value"].get<double>());
  EXPECT_EQ(valueOf("s_2_y_dark"), report["series"][0]["highpass_spatial_variance"]["total"].get<double>());
}

TEST_F(EstimateEmvaTool, ARegionIsEvaluatedAsFramesOfItsSize)
{
  MakeSeries();
  const std::string method = " --method emva1288 --exposures exposures.txt";
  const auto        stack = Read<StackType>(Path("stack.mha"));
  const auto        frames = stack->GetLargestPossibleRegion().GetSize(2);
  Write("cut.mha", Cut<unsigned short>(stack.GetPointer(), { { 3, 5, 0 } }, { { 40, 30, frames } }).GetPointer());
  EXPECT_EQ(ReportOf("stack.mha --roi 3,5,40,30" + method), ReportOf("cut.mha" + method));
  Refuses("stack.mha --roi 30,5,40,30" + method, { "40 x 30 pixels from 30,5", "64 x 48" });
}

TEST_F(EstimateEmvaTool, PlanesOfAMosaicAreEvaluatedByThemselves)
{
  MakeSeries();
  const std::string method = " --method emva1288 --exposures exposures.txt";
  const auto        stack = Read<StackType>(Path("stack.mha"));
  const auto        frames = stack->GetLargestPossibleRegion().GetSize(2);
  const auto        planeAt = [&](long x, long y, std::size_t width, std::size_t height) {
    const auto plane = Make<StackType>({ { width, height, frames } }, 0);
    auto *     pixel = plane->GetBufferPointer();
    for (long t = 0; t < static_cast<long>(frames); ++t)
    {
      for (std::size_t row = 0; row < height; ++row)
      {
        for (std::size_t column = 0; column < width; ++column)
        {
          *pixel++ = stack->GetPixel({ { x + 2 * static_cast<long>(column), y + 2 * static_cast<long>(row), t } });
        }
      }
    }
    return Write("plane.mha", plane.GetPointer());
  };
  const auto mosaic = ReportOf("stack.mha --bayer GRBG" + method);
  EXPECT_EQ(mosaic["schema"], "itk-sensornoise-emva1288-mosaic/1");
  EXPECT_EQ(mosaic["bayer"], "GRBG");
  EXPECT_EQ(mosaic["planes"]["G1"], ReportOf(planeAt(0, 0, 32, 24) + method));
  EXPECT_EQ(mosaic["planes"]["R"], ReportOf(planeAt(1, 0, 32, 24) + method));
  EXPECT_EQ(mosaic["planes"]["B"], ReportOf(planeAt(0, 1, 32, 24) + method));
  // an odd corner begins with another colour, and an odd size leaves a row and a column out
  const auto part = ReportOf("stack.mha --bayer GRBG --roi 3,5,41,31" + method);
  EXPECT_EQ(part["bayer"], "GBRG");
  EXPECT_EQ(part["planes"]["G2"], ReportOf(planeAt(3, 5, 20, 15) + method));
}

TEST_F(EstimateEmvaTool, WritesThePageAndTheFigure)
{
  MakeSeries();
  const std::string method = " --method emva1288 --exposures exposures.txt";
  ASSERT_EQ(Run("stack.mha --plot page.html --quiet" + method), 0) << m_Message;
  EXPECT_NE(ReadText(Path("page.html")).find("<title>EMVA 1288: stack.mha</title>"), std::string::npos);
  ASSERT_EQ(Run("stack.mha --plot figure.svg --bayer RGGB --quiet" + method), 0) << m_Message;
  EXPECT_EQ(ReadText(Path("figure.svg")).rfind("<svg", 0), 0U);
  Refuses("stack.mha --plot stack.mha.html --json stack.mha.html" + method, { "stack.mha.html" });
}

TEST_F(EstimateEmvaTool, ExposuresAreTakenFromFilesThatRecordThem)
{
  MakeSeries();
  std::string text;
  std::string flats;
  std::string darks;
  for (std::size_t t = 0; t < m_Exposures.size(); ++t)
  {
    const bool        isDark = t < DarkFrames;
    const double      exposure = isDark ? 0.1 : m_Exposures[t];
    const std::string name = WriteFits(t, exposure);
    (isDark ? darks : flats) += " " + name;
    text +=
      (t % 2 == 0 && t != 2 ? (t == 0 ? "" : "\n") + TextOf(exposure) + (isDark ? ",dark," : ",flat,") : ";") + name;
  }
  const std::string method = " --method emva1288";
  const auto        expected = ReportOf(WriteText("list.csv", "exposure_s,kind,files\n" + text + "\n") + method);
  const auto        recorded = ReportOf(flats + " --dark" + darks + method);
  EXPECT_EQ(recorded["sensitivity"], expected["sensitivity"]);
  EXPECT_EQ(recorded["points"], expected["points"]);
  EXPECT_EQ(recorded["settings"]["exposure_unit"], "s");
  Refuses(flats + method, { "no dark frames", "--dark" });
  Refuses(flats + " --dark " + m_Names[0] + method, { m_Names[0] + " records none" });
  Refuses("list.csv --dark" + darks + method, { "--dark", "list.csv" });
  std::string bias; // frames of the shortest exposure, which FITS records as 0
  for (std::size_t t = 0; t < DarkFrames; ++t)
  {
    bias += " " + WriteFits(t, 0.0);
  }
  EXPECT_EQ(ReportOf(flats + " --dark" + bias + method)["sensitivity"]["gain"]["status"], "identified");
}

TEST_F(EstimateEmvaTool, RefusesListsThatAreNone)
{
  MakeSeries();
  const std::string method = " --method emva1288";
  Refuses(WriteText("list.csv", "") + method, { "list.csv is empty" });
  Refuses("missing.csv" + method, { "missing.csv cannot be read" });
  Refuses(WriteText("list.csv", "time,files\n1,a.tif\n") + method, { "line 1", "time", "exposure" });
  Refuses(WriteText("list.csv", "exposure,photons\n1,2\n") + method, { "line 1", "files" });
  Refuses(WriteText("list.csv", "exposure_ms,exposure_s,files\n1,2,a.tif\n") + method,
          { "line 1", "expected one column of exposures", "\"exposure_ms\" and \"exposure_s\"" });
  Refuses(WriteText("list.csv", "exposure,files\n1\n") + method, { "line 2", "2 columns", "there are 1" });
  Refuses(WriteText("list.csv", "exposure,files\n-1,a.tif\n") + method, { "line 2", "\"-1\"" });
  for (const std::string number : { "inf", "1e400", "nan" })
  {
    Refuses(WriteText("list.csv", "exposure,photons,files\n1," + number + ",a.tif\n") + method,
            { "line 2", "expected photons, a finite number", "\"" + number + "\"" });
    Refuses(WriteText("list.txt", "b 10 " + number + "\n") + method, { "line 1", "a finite number" });
  }
  Refuses(WriteText("list.csv", "exposure,files,kind\n1,a.tif,grey\n") + method, { "line 2", "flat or dark" });
  Refuses(WriteText("list.csv", "exposure,files\n1,none*.tif\n") + method, { "none*.tif" });
  Refuses(WriteText("list.csv", "exposure,files\n1," + m_Names[0] + "\n") + method, { "line 2", "one frame" });
  Refuses(WriteText("list.txt", "b 10 5\n") + method, { "line 1", "followed by no file" });
  Refuses(WriteText("list.txt", "n 12 64 48\nb 10\n") + method, { "line 2", "b 10" });
  Refuses(WriteDescriptor("12 64 64") + method, { "64 x 48", "64 x 64" });
  const std::string noDark = "exposure,files\n1," + Names(4, 6) + "\n2," + Names(6, 8) + "\n3," + Names(8, 10) + "\n";
  Refuses(WriteText("list.csv", noDark) + method, { "none of the 3 series is dark" });
}

TEST_F(EstimateEmvaTool, RefusesOptionsOfOtherMethods)
{
  MakeSeries();
  const std::string method = " --method emva1288";
  Refuses("stack.mha" + method, { "needs the exposures" });
  Refuses("stack.mha --exposures 0,1" + method, { "2 numbers", "28 frames" });
  Refuses("stack.mha --exposures exposures.txt --offset 3" + method, { "does not use --offset" });
  Refuses("stack.mha --exposures exposures.txt --mask mask.png" + method, { "does not use --mask", "--roi" });
  Refuses(WriteTable("list.csv"), { "list.csv is text", "--method emva1288" });
  Refuses("stack.mha --exposures exposures.txt --bit-depth 8" + method, { "but 8 bits", "end at 255 DN" });
  Refuses("stack.mha --xml results.xml", { "writes no XML" });
  Refuses(WriteTable("list.csv") + " --exposures exposures.txt" + method, { "both say exposures" });
  Refuses(WriteTable("list.csv") + " --json list.csv" + method, { "list.csv" });
}
