// SPDX-License-Identifier: Apache-2.0
// Texts as people save them: what is read, and what is named by line, column and character.
#include <cstddef>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "common/base/characters.h"
#include "common/base/log.h"
#include "common/config/adjustments.h"
#include "common/config/hours.h"

namespace aquarama::config {
namespace {

// A projector's name is for people: any text is good.
std::string hoursWith(const std::string& name) {
    return "zone: \"Europe/Berlin\"\nprojectors { name: \"" + name +
           "\" address: \"192.168.7.21\" }\n";
}

// Of reading hours; empty where they are good.
std::string errorOf(const std::string& text) {
    try {
        (void)parseHours(text, "f");
        return "";
    } catch (const Error& error) {
        return error.what();
    }
}

struct Case {
    std::string text, error;
};

void expectErrors(const std::vector<Case>& cases) {
    for (const auto& [text, error] : cases) EXPECT_EQ(errorOf(text), error) << text;
}

TEST(PlainText, aByteOrderMarkIsSkippedAndColumnsStayRight) {
    EXPECT_EQ(errorOf("\xEF\xBB\xBF" + hoursWith("left")), "");
    const std::string wrong = "zones: \"x\"";
    EXPECT_EQ(errorOf("\xEF\xBB\xBF" + wrong), errorOf(wrong));
    EXPECT_TRUE(errorOf(wrong).starts_with("f:1:6: hours has no field")) << errorOf(wrong);
    expectErrors(
        {{"zone: \"Europe/Berlin\" \xEF\xBB\xBF", "f:1:23: U+FEFF (byte order mark): remove it"}});
}

TEST(PlainText, linesEndAsOnAnySystem) {
    for (const char* end : {"\n", "\r\n", "\r"}) {
        std::string text = "# hours" + std::string(end) + "zone: \"Europe/Berlin\"" + end;
        EXPECT_EQ(errorOf(text), "");
        EXPECT_TRUE(errorOf(text + "x: 1").starts_with("f:3:2: ")) << errorOf(text + "x: 1");
    }
}

TEST(PlainText, anotherEncodingIsNamed) {
    const std::string utf16 = "the file is saved as UTF-16: save it as UTF-8";
    expectErrors({
        {std::string("\xFF\xFEz\0o\0", 6), "f:1:1: " + utf16},
        {std::string("\xFE\xFF\0z\0o", 6), "f:1:1: " + utf16},
        {std::string("z\0o\0n\0e\0", 8), "f:1:1: " + utf16},
        {"zone: \"Europe/Berlin\"\n# Gr\xFC\xDF",
         "f:2:5: byte 0xFC (ü in Latin-1) is no UTF-8: save the file as UTF-8"},
        {hoursWith("Stra\xDF"
                   "e"),
         "f:2:25: byte 0xDF (ß in Latin-1) is no UTF-8: save the file as UTF-8"},
        {hoursWith("a\x93"
                   "b"),
         "f:2:22: byte 0x93 is no UTF-8: save the file as UTF-8"},
        {hoursWith("a\x1B[2Jb"),
         "f:2:22: U+001B (a control character): remove it; is this a text file?"},
        {hoursWith("cut\xE2\x80"),
         "f:2:24: byte 0xE2 (â in Latin-1) is no UTF-8: save the file as "
         "UTF-8"},
    });
}

TEST(PlainText, namesForPeopleAndCommentsMayHaveAnyCharacter) {
    for (const char* name : {"Grüße", "左", "Зал", "l’écran", "Nº 1 – “left”", "Ωmega", "ταβ"})
        EXPECT_EQ(errorOf("# “" + std::string(name) + "”\u00A0–\n" + hoursWith(name)), "") << name;
    EXPECT_EQ(parseHours(hoursWith("Grüße"), "f").projectors.at(0).name, "Grüße");
}

TEST(PlainText, whatStandsOutsideOfQuotesIsNamedWithWhatToTypeInstead) {
    expectErrors({
        {"zone: “Europe/Berlin”", "f:1:7: U+201C (left double quotation mark): type \""},
        {"zone: „Europe/Berlin“", "f:1:7: U+201E (double low-9 quotation mark): type \""},
        {"zone: ‘Europe/Berlin’", "f:1:7: U+2018 (left single quotation mark): type '"},
        {"zone: \"Europe/Berlin”",
         "f:1:21: U+201D (right double quotation mark) ends no text: "
         "type the quote that began it"},
        {"zone: \"Europe/Berlin\nopen {}",
         "f:1:7: the text that begins here has no end: type \" "
         "after it"},
        {"zone:\u00A0\"Europe/Berlin\"", "f:1:6: U+00A0 (no-break space): type a space"},
        {"zone: \u200B\"Europe/Berlin\"", "f:1:7: U+200B (zero width space): remove it"},
        {"zоne: \"Europe/Berlin\"", "f:1:2: U+043E (Cyrillic small letter o): type o"},
        {"zone： \"Europe/Berlin\"", "f:1:5: U+FF1A (full-width :): type :"},
        {"zöne: \"x\"",
         "f:1:2: U+00F6 (ö) stands outside of quotes: type ASCII here, or put a "
         "text in \" \""},
        {"# Grüße\nzone: \"Europe/Berlin\" open { days: [MОNDAY] }",
         "f:2:38: U+041E (Cyrillic capital letter o): type O"},
    });
}

TEST(PlainText, inQuotesNothingHidesAndNoLetterPassesForAnother) {
    expectErrors({
        {hoursWith("left\u200B"), "f:2:25: U+200B (zero width space) in a text: remove it"},
        {hoursWith("a\u00A0b"), "f:2:22: U+00A0 (no-break space) in a text: type a space"},
        {hoursWith("lеft"),
         "f:2:22: U+0435 (Cyrillic small letter ie) among Latin letters: type e"},
        {hoursWith("a\\tb"), "f:2:14: name has U+0009 (a control character): remove it"},
        {hoursWith("a\\033[2Jb"), "f:2:14: name has U+001B (a control character): remove it"},
    });
    EXPECT_NE(errorOf(hoursWith("a\\xFFb")), "");
}

// Columns are those of an editor, also behind characters of several bytes.
TEST(PlainText, columnsCountCharacters) {
    const std::string unknown = errorOf("zone: \"Größe\" x: 1");
    EXPECT_TRUE(unknown.starts_with("f:1:16: ")) << unknown;
    const std::string open = "zone: \"Europe/Berlin\" open { days: [MONDAY] scene: \"übermäßig\" ";
    const std::string noTime = errorOf(open + "from: \"x\" to: \"10:00\" }");
    EXPECT_TRUE(noTime.starts_with("f:1:64: from \"x\" is no time")) << noTime;
}

std::string errorOfNumber(const std::string& number) {
    try {
        (void)parseAdjustments("masks { soft_px: " + number + " }", "f", {});
        return "";
    } catch (const Error& error) {
        return error.what();
    }
}

TEST(PlainText, numbersAreNamedWithWhatToTypeInstead) {
    const std::string here = " is no number here: type ";
    for (const auto& [number, error] : std::vector<Case>{
             {"2,5", "f:1:18: \"2,5\"" + here + "2.5"},
             {"1.000,5", "f:1:18: \"1.000,5\"" + here + "1000.5"},
             {"1 000", "f:1:18: \"1 000\"" + here + "1000"},
             {"1'000", "f:1:18: \"1'000\"" + here + "1000"},
             {"1_000", "f:1:18: \"1_000\"" + here + "1000"},
             {"1\u00A0000",
              "f:1:18: \"1\u00A0000\"" + here +
                  "1000 (it has U+00A0 (no-break "
                  "space))"},
             {"３", "f:1:18: \"３\"" + here + "3 (it has U+FF13 (full-width digit 3))"},
             {"٣", "f:1:18: \"٣\"" + here + "3 (it has U+0663 (Arabic-Indic digit 3))"},
             {"−5", "f:1:18: U+2212 (minus sign): type -"},
             {"–5", "f:1:18: U+2013 (en dash): type -"},
             {"+5", "f:1:18: + before a number: leave it out"},
             {"12abc", "f:1:18: \"12abc\" is no number: type digits, with a point before decimals"},
             {"5px", "f:1:18: \"5px\" is no number: type digits, with a point before decimals"},
             {"012", "f:1:18: \"012\" begins with 0, and would be read as octal: type it without"},
             {"nan", "f:1:9: soft_px is nan: it must be from 0 to 4096"},
             {"inf", "f:1:9: soft_px is inf: it must be from 0 to 4096"},
             {"1e999", "f:1:9: soft_px is inf: it must be from 0 to 4096"},
             {"\"5\"",
              "f:1:18: Expected double, got: \"5\": write a number such as 2.5, without "
              "quotes"},
         })
        EXPECT_EQ(errorOfNumber(number), error) << number;
    for (const char* good : {"5", "0.5", ".5", "5.", "1e2", "1.5e+1", "1e-2", "5f", "0x10", "0"})
        EXPECT_EQ(errorOfNumber(good).find("no number"), std::string::npos) << errorOfNumber(good);
}

TEST(PlainText, listsOfNumbersKeepTheirCommas) {
    EXPECT_EQ(
        errorOf("zone: \"Europe/Berlin\" open { days: [1,2, 3] from: \"10:00\" to: \"18:00\" }"),
        "");
}

TEST(Characters, everyNumberThatIsMeantIsTold) {
    for (const auto& [text, plain] : std::vector<Case>{{"2,5", "2.5"},
                                                       {"−２,５", "-2.5"},
                                                       {" 5", "5"},
                                                       {"+5", "5"},
                                                       {"1.234.567", "1234567"},
                                                       {"1,234,567.5", "1234567.5"},
                                                       {"1\u202F000", "1000"},
                                                       {"1’000", "1000"},
                                                       {"5", ""},
                                                       {"abc", ""},
                                                       {"5 m", ""},
                                                       {"nan", ""},
                                                       {"1e999", ""},
                                                       {"\xFF", ""},
                                                       {"", ""}})
        EXPECT_EQ(plainNumber(text), plain) << text;
}

TEST(Characters, aLineOfALogHasNeitherControlsNorOtherEncodings) {
    EXPECT_EQ(legible("Gr\xC3\xBC\xC3\x9F"
                      "e"),
              "Grüße");
    EXPECT_EQ(legible("Gr\xFC\x1B[2J\xC2\x9B"), "Gr\\xFC\\x1B[2J\\x9B");
    EXPECT_EQ(legible(std::string("a\0\xED\xA0\x80", 5)), "a\\x00\\xED\\xA0\\x80");
}

TEST(Characters, aLineThatIsShortenedEndsWithAWholeCharacter) {
    EXPECT_EQ(legible("Gr\xC3\xBC", 4), "Gr\xC3\xBC");
    EXPECT_EQ(legible("Gr\xC3\xBC", 3), "Gr");
    EXPECT_EQ(legible("Gr\xFC", 5), "Gr");
    EXPECT_EQ(legible("Gr\xFC", 6), "Gr\\xFC");
    EXPECT_EQ(legible("a", 0), "");
}

// Every cut and every two bytes is told as something.
TEST(Characters, anyBytesAreReadToTheirEnd) {
    for (unsigned first = 0; first < 256; ++first)
        for (unsigned second = 0; second < 256; ++second) {
            const std::string text{static_cast<char>(first), static_cast<char>(second)};
            std::size_t at = 0;
            while (at < text.size()) at += codePointAt(text, at).bytes;
            ASSERT_EQ(at, text.size());
        }
}

}  // namespace
}  // namespace aquarama::config
