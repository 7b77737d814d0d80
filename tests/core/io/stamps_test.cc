// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include "core/io/errors.h"
#include "core/io/scan_listing.h"
#include "core/io/scan_stamps.h"
#include "core/io/stamp_text.h"
#include "tests/core/io/io_testing.h"

namespace trajlo {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr std::int64_t kSecond = 1'000'000'000;

TEST(StampText, SecondsAreParsedToTheNanosecond) {
  EXPECT_EQ(ParseDecimalNs("1317042000.103499889", kSecond), 1317042000103499889);
  EXPECT_EQ(ParseDecimalNs("1584002666.184402227", kSecond), 1584002666184402227);
  EXPECT_EQ(ParseDecimalNs("0.1", kSecond), 100000000);
  EXPECT_EQ(ParseDecimalNs("-0.5", kSecond), -500000000);
  EXPECT_EQ(ParseDecimalNs("7", kSecond), 7 * kSecond);
  EXPECT_EQ(ParseDecimalNs("1317042000103499", 1000), 1317042000103499000);
}

TEST(StampText, ScientificNotationIsExactToo) {
  EXPECT_EQ(ParseDecimalNs("1.036224e-01", kSecond), 103622400);
  EXPECT_EQ(ParseDecimalNs("0.000000e+00", kSecond), 0);
  EXPECT_EQ(ParseDecimalNs("1.600000000123456789E9", kSecond), 1600000000123456789);
  EXPECT_EQ(ParseDecimalNs("4e-30", kSecond), 0);
}

TEST(StampText, DigitsBeyondTheNanosecondAreRounded) {
  EXPECT_EQ(ParseDecimalNs("0.0000000014", kSecond), 1);
  EXPECT_EQ(ParseDecimalNs("0.0000000015", kSecond), 2);
  EXPECT_EQ(ParseDecimalNs("1.999999999999", kSecond), 2 * kSecond);
}

TEST(StampText, TextThatIsNoNumberOrOutOfRangeIsRefused) {
  for (const char* text : {"", ".", "-", "1.2.3", "1e", "1x", "nan", "inf", "1 2", "0x10",
                           "99999999999", "1e300", "1e99999999999"}) {
    EXPECT_FALSE(ParseDecimalNs(text, kSecond).has_value()) << text;
  }
}

TEST(StampText, DatesOfKittiRawAreParsed) {
  EXPECT_EQ(ParseDateTimeNs("2011-09-26 13:02:25.594360375"), 1317042145594360375);
  EXPECT_EQ(ParseDateTimeNs("1970-01-01T00:00:00Z"), 0);
  EXPECT_EQ(ParseDateTimeNs("2000-02-29 23:59:59.5"), 951868799500000000);
  EXPECT_FALSE(ParseDateTimeNs("2011-09-26").has_value());
  EXPECT_FALSE(ParseDateTimeNs("2011-13-26 13:02:25.0").has_value());
}

TEST(StampText, DatesLieSoCloseThatTheirDifferencesAreNumbers) {
  const auto first = ParseDateTimeNs("1824-01-01 00:00:00.0");
  const auto last = ParseDateTimeNs("2115-12-31 23:59:59.9");
  ASSERT_TRUE(first && last);
  EXPECT_LT(*first, *last);
  EXPECT_NEAR(static_cast<double>(*last - *first), 1e9 * 292.0 * 365.2425 * 86400.0, 1e14);
  EXPECT_FALSE(ParseDateTimeNs("1711-09-26 13:02:25.6").has_value());  // found by fuzz_stamps
  EXPECT_FALSE(ParseDateTimeNs("2116-01-01 00:00:00.0").has_value());
}

TEST(StampText, PrintingAndParsingAreInverse) {
  for (const std::int64_t t : {std::int64_t{0}, std::int64_t{1}, std::int64_t{-1}, kSecond,
                               std::int64_t{1600000000123456789}, std::int64_t{-1500000000}}) {
    EXPECT_EQ(ParseDecimalNs(FormatSeconds(t), kSecond), t);
  }
  EXPECT_EQ(FormatSeconds(-1), "-0.000000001");
  EXPECT_EQ(FormatSeconds(std::numeric_limits<std::int64_t>::min()), "-9223372036.854775808");
}

TEST(StampsFile, ReadsSecondsNanosecondsMicrosecondsAndDates) {
  const TempFolder folder;
  const auto read = [&](const std::string& text) {
    return ReadStampsFile(folder.Write("timestamps.txt", text));
  };
  EXPECT_THAT(read("\xEF\xBB\xBF# stamps\r\n1.5\r\n\r\n  2.5  \r\n"),
              ElementsAre(1500000000, 2500000000));
  EXPECT_THAT(read("1600000000123456789\n"), ElementsAre(1600000000123456789));
  EXPECT_THAT(read("1600000000123456"), ElementsAre(1600000000123456000));
  EXPECT_THAT(read("1600000000\n"), ElementsAre(1600000000 * kSecond));
  EXPECT_THAT(read("0\n1\n"), ElementsAre(0, kSecond));
  EXPECT_THAT(read("2011-09-26 13:02:25.594360375\n"), ElementsAre(1317042145594360375));
}

TEST(StampsFile, ALineThatIsNoStampIsNamed) {
  const TempFolder folder;
  try {
    ReadStampsFile(folder.Write("timestamps.txt", "1.0\n\nyesterday\n"));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("line 3 is not a stamp: 'yesterday'"));
  }
}

class StampSearch : public ::testing::Test {
 protected:
  ScanStamps Find(const std::filesystem::path& stamps_file = {}) {
    listing_ = ListScans(folder_.path());
    return FindStamps(stamps_file, &listing_);
  }
  std::vector<std::string> Names() const {
    std::vector<std::string> names;
    for (const auto& file : listing_.files) names.push_back(file.filename().string());
    return names;
  }
  TempFolder folder_;
  ScanListing listing_;
};

TEST_F(StampSearch, AStampsFileBesideTheScansIsTaken) {
  folder_.Write("scans/0.bin", "");
  folder_.Write("scans/times.txt", "5.0\n");
  EXPECT_THAT(Find().t_ns, ElementsAre(5 * kSecond));
}

TEST_F(StampSearch, AStampsFileOneLevelUpIsTaken) {
  folder_.Write("velodyne/0.bin", "");
  folder_.Write("times.txt", "5.0\n");
  EXPECT_THAT(Find().t_ns, ElementsAre(5 * kSecond));
}

TEST_F(StampSearch, AnExplicitFileGoesFirst) {
  folder_.Write("0.bin", "");
  folder_.Write("times.txt", "5.0\n");
  EXPECT_THAT(Find(folder_.Write("other.csv", "6.0\n")).t_ns, ElementsAre(6 * kSecond));
}

TEST_F(StampSearch, FewerStampsThanScansIsAnErrorWithBothNumbers) {
  folder_.Write("0.bin", "");
  folder_.Write("1.bin", "");
  folder_.Write("times.txt", "5.0\n");
  try {
    Find();
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("has 1 stamp, and 2 scans were found in"));
  }
}

TEST_F(StampSearch, MoreStampsThanScansIsAWarning) {
  folder_.Write("a.bin", "");
  folder_.Write("times.txt", "5.0\n6.0\n");
  const ScanStamps stamps = Find();
  EXPECT_THAT(stamps.t_ns, ElementsAre(5 * kSecond));
  EXPECT_THAT(stamps.warnings,
              ElementsAre("times.txt has 2 stamps, and 1 scan was found; the first stamps are "
                          "taken, so the last scan, a.bin, has 5.000000000 s"));
}

TEST_F(StampSearch, WhenAScanIsMissingTheIndexInTheNamesPicksTheLine) {
  for (const char* name : {"0000000000.bin", "0000000001.bin", "0000000003.bin"}) {
    folder_.Write(name, "");
  }
  folder_.Write("timestamps.txt", "5.0\n6.0\n7.0\n8.0\n");
  const ScanStamps stamps = Find();
  EXPECT_THAT(stamps.t_ns, ElementsAre(5 * kSecond, 6 * kSecond, 8 * kSecond));
  EXPECT_THAT(stamps.warnings,
              ElementsAre(HasSubstr("the numbers in the names tell which is whose")));
}

TEST_F(StampSearch, NamesOfSeveralPatternsLeaveOpenWhichStampIsWhose) {
  for (const char* name : {"000000.pcd", "000002.pcd", "000003.pcd"}) folder_.Write(name, "");
  folder_.Write("timestamps.txt", "5.0\n6.0\n7.0\n8.0\n");
  for (const char* odd : {"copy of 000001.pcd", "000001 (1).pcd", "a.pcd"}) {
    const auto file = folder_.Write(odd, "");
    try {
      Find();
      FAIL() << odd;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(odd));
      EXPECT_THAT(error.what(), HasSubstr("000000.pcd"));
    }
    std::filesystem::remove(file);
  }
  folder_.Write("1.pcd", "");  // digits are compared as numbers
  EXPECT_THAT(Find().t_ns, ElementsAre(5 * kSecond, 6 * kSecond, 7 * kSecond, 8 * kSecond));
}

TEST_F(StampSearch, AScanThatIsMissingByItsNumberIsMissingByItsStamp) {
  const auto find = [&](const std::vector<const char*>& names, const char* stamps) {
    for (const auto& old : std::filesystem::directory_iterator(folder_.path())) {
      std::filesystem::remove(old.path());
    }
    for (const char* name : names) folder_.Write(name, "");
    folder_.Write("times.txt", stamps);
    return Find().t_ns.size();
  };
  // One was lost before the stamps were written, and every second one left out.
  EXPECT_EQ(find({"00.bin", "01.bin", "03.bin", "04.bin"}, "5.0\n5.1\n5.3\n5.4\n"), 4U);
  EXPECT_EQ(find({"00.bin", "02.bin", "04.bin", "06.bin"}, "5.0\n5.1\n5.2\n5.3\n"), 4U);
  // The names are times of day.
  EXPECT_EQ(find({"125959800.bin", "125959900.bin", "130000000.bin", "130000100.bin"},
                 "5.0\n5.1\n5.2\n5.3\n"),
            4U);
  try {
    find({"00.bin", "01.bin", "03.bin", "04.bin", "9902.bin"}, "5.0\n5.1\n5.2\n5.3\n5.4\n");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("between 01.bin and 03.bin"));
  }
  // A wrong stamp beside the gap is no time for the scan that is missing, nor does it take it away.
  const std::vector<const char*> names = {"00.bin", "01.bin", "03.bin",
                                          "04.bin", "05.bin", "06.bin"};
  EXPECT_THROW(find(names, "5.0\n5.1\n5.8\n5.3\n5.4\n5.5\n"), InputError);
  EXPECT_EQ(find(names, "5.0\n5.25\n5.3\n5.4\n5.5\n5.6\n"), 6U);
}

TEST_F(StampSearch, TimesOfRecordingAreFoundInTheSameWay) {
  for (const char* name : {"scans/0.pcd", "scans/2.pcd"}) folder_.Write(name, "");
  const ScanListing listing = ListScans(folder_.path());
  EXPECT_TRUE(FindRecordTimes(listing).empty());
  folder_.Write("record_times.txt", "5.5\n5.4\n7\n");
  EXPECT_THAT(FindRecordTimes(listing), ElementsAre(5'500'000'000, 7'000'000'000));
  folder_.Write("record_times.txt", "5.5\n");
  EXPECT_THROW(FindRecordTimes(listing), InputError);
}

TEST_F(StampSearch, StampsThatGoBackAreReported) {
  for (const char* name : {"0.bin", "1.bin", "2.bin"}) folder_.Write(name, "");
  folder_.Write("timestamps.txt", "5.0\n7.0\n6.5\n");
  EXPECT_THAT(Find().warnings, ElementsAre(HasSubstr("that of scan 2, 6.500000000 after 7.0")));
}

TEST_F(StampSearch, OneNameThatIsNoStampLeavesNone) {
  folder_.Write("10.250.pcd", "");
  folder_.Write("first.pcd", "");
  EXPECT_THAT(Find().t_ns, IsEmpty());
}

TEST_F(StampSearch, NamesInSecondsWithDecimalsAreStampsAndGiveTheOrder) {
  folder_.Write("10.250.pcd", "");
  folder_.Write("9.500.pcd", "");
  folder_.Write("10.2251.pcd", "");
  EXPECT_THAT(Find().t_ns, ElementsAre(9500000000, 10225100000, 10250000000));
  EXPECT_THAT(Names(), ElementsAre("9.500.pcd", "10.2251.pcd", "10.250.pcd"));
}

TEST(ScanListing, DigitsAreComparedAsNumbers) {
  EXPECT_TRUE(NaturalLess("scan9.pcd", "scan10.pcd"));
  EXPECT_FALSE(NaturalLess("scan10.pcd", "scan9.pcd"));
  EXPECT_TRUE(NaturalLess("a2b3", "a2b10"));
  EXPECT_TRUE(NaturalLess("a", "a1"));
  EXPECT_FALSE(NaturalLess("x", "x"));
  EXPECT_TRUE(NaturalLess("99999999999999999999998", "99999999999999999999999"));
}

TEST(ScanListing, TheOnlySubfolderWithScansIsTaken) {
  const TempFolder folder;
  folder.Write("images/a.png", "");
  folder.Write("my_sensor/2.ply", "");
  folder.Write("my_sensor/1.ply", "");
  const ScanListing listing = ListScans(folder.path());
  EXPECT_EQ(listing.folder.filename(), "my_sensor");
  EXPECT_EQ(listing.files.size(), 2U);
}

TEST(ScanListing, AKnownSubfolderGoesBeforeAStrayMapBesideIt) {
  const TempFolder folder;
  folder.Write("map.pcd", "");
  folder.Write("scans/1.pcd", "");
  const ScanListing listing = ListScans(folder.path());
  EXPECT_EQ(listing.folder.filename(), "scans");
  EXPECT_THAT(listing.notes, ElementsAre(HasSubstr("1 point file in")));
}

TEST(ScanListing, TheMostFrequentKindOfFileWins) {
  const TempFolder folder;
  folder.Write("map.ply", "");
  folder.Write("1.PCD", "");
  folder.Write("2.pcd", "");
  const ScanListing listing = ListScans(folder.path());
  EXPECT_EQ(listing.extension, ".pcd");
  EXPECT_EQ(listing.files.size(), 2U);
  EXPECT_THAT(listing.warnings, ElementsAre(HasSubstr("does not end in .pcd")));
  EXPECT_EQ(listing.left_out, 0U);
}

TEST(ScanListing, ScansOfAnotherKindThatNoFileHasAreLeftOut) {
  const TempFolder folder;
  for (const char* name : {"1.pcd", "2.pcd", "3.pcd", "2.ply", "3.ply"}) folder.Write(name, "");
  EXPECT_EQ(ListScans(folder.path()).left_out, 0U);
  for (const char* name : {"4.pcd", "5.pcd", "10.ply", "9.bin"}) folder.Write(name, "");
  const ScanListing listing = ListScans(folder.path());
  EXPECT_EQ(listing.files.size(), 5U);
  EXPECT_EQ(listing.left_out, 2U);
  EXPECT_THAT(listing.warnings,
              ElementsAre(HasSubstr("2 are scans that no other file has, the first 9.bin")));
}

TEST(ScanListing, MissingEmptyAndAmbiguousFoldersAreExplained) {
  const TempFolder folder;
  const auto message = [](const std::filesystem::path& path) -> std::string {
    try {
      ListScans(path);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_THAT(message(folder.path() / "nowhere"), HasSubstr("there is no such file or folder"));
  EXPECT_THAT(message(folder.path()), HasSubstr("0 subfolders and 0 files"));
  EXPECT_THAT(message(folder.Write("notes.txt", "")), HasSubstr("not a folder"));
  EXPECT_THAT(message(folder.path()), HasSubstr("1 file of another kind"));
  folder.Write("left/1.bin", "");
  folder.Write("right/1.bin", "");
  EXPECT_THAT(message(folder.path()), HasSubstr("several subfolders hold scans: left right"));
}

}  // namespace
}  // namespace trajlo
