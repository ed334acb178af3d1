// SPDX-License-Identifier: Apache-2.0
#include "common/base/characters.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <spdlog/fmt/fmt.h>

namespace aquarama {

namespace {

// Common characters, sorted: code~what to type instead, if anything~name in Unicode. Full-width
// forms and digits of other scripts are recognised by their ranges.
constexpr std::string_view kTable =
    R"(
00A0~ ~no-break space|00AB~"~left-pointing double angle quotation mark|00AD~~soft hyphen|
00B0~~degree sign|00B2~~superscript two|00B3~~superscript three|00B4~'~acute accent|
00B5~~micro sign|00B7~.~middle dot|00BB~"~right-pointing double angle quotation mark|
00D7~x~multiplication sign|02BC~'~modifier letter apostrophe|037E~;~Greek question mark|
0391~A~Greek capital letter alpha|0392~B~Greek capital letter beta|
0395~E~Greek capital letter epsilon|0396~Z~Greek capital letter zeta|
0397~H~Greek capital letter eta|0399~I~Greek capital letter iota|
039A~K~Greek capital letter kappa|039C~M~Greek capital letter mu|039D~N~Greek capital letter nu|
039F~O~Greek capital letter omicron|03A1~P~Greek capital letter rho|
03A4~T~Greek capital letter tau|03A5~Y~Greek capital letter upsilon|
03A7~X~Greek capital letter chi|03BD~v~Greek small letter nu|03BF~o~Greek small letter omicron|
0405~S~Cyrillic capital letter dze|0406~I~Cyrillic capital letter byelorussian-ukrainian i|
0408~J~Cyrillic capital letter je|0410~A~Cyrillic capital letter a|
0412~B~Cyrillic capital letter ve|0415~E~Cyrillic capital letter ie|
041A~K~Cyrillic capital letter ka|041C~M~Cyrillic capital letter em|
041D~H~Cyrillic capital letter en|041E~O~Cyrillic capital letter o|
0420~P~Cyrillic capital letter er|0421~C~Cyrillic capital letter es|
0422~T~Cyrillic capital letter te|0423~Y~Cyrillic capital letter u|
0425~X~Cyrillic capital letter ha|0430~a~Cyrillic small letter a|0435~e~Cyrillic small letter ie|
043E~o~Cyrillic small letter o|0440~p~Cyrillic small letter er|0441~c~Cyrillic small letter es|
0443~y~Cyrillic small letter u|0445~x~Cyrillic small letter ha|0455~s~Cyrillic small letter dze|
0456~i~Cyrillic small letter byelorussian-ukrainian i|0458~j~Cyrillic small letter je|
04BB~h~Cyrillic small letter shha|0501~d~Cyrillic small letter komi de|
066B~,~Arabic decimal separator|2000~ ~en quad|2001~ ~em quad|2002~ ~en space|2003~ ~em space|
2004~ ~three-per-em space|2005~ ~four-per-em space|2006~ ~six-per-em space|2007~ ~figure space|
2008~ ~punctuation space|2009~ ~thin space|200A~ ~hair space|200B~~zero width space|
200C~~zero width non-joiner|200D~~zero width joiner|200E~~left-to-right mark|
200F~~right-to-left mark|2010~-~hyphen|2011~-~non-breaking hyphen|2012~-~figure dash|
2013~-~en dash|2014~-~em dash|2015~-~horizontal bar|2018~'~left single quotation mark|
2019~'~right single quotation mark|201A~'~single low-9 quotation mark|
201B~'~single high-reversed-9 quotation mark|201C~"~left double quotation mark|
201D~"~right double quotation mark|201E~"~double low-9 quotation mark|
201F~"~double high-reversed-9 quotation mark|2026~...~horizontal ellipsis|2028~~line separator|
2029~~paragraph separator|202A~~left-to-right embedding|202B~~right-to-left embedding|
202C~~pop directional formatting|202D~~left-to-right override|202E~~right-to-left override|
202F~ ~narrow no-break space|2032~'~prime|2033~"~double prime|
2039~'~single left-pointing angle quotation mark|
203A~'~single right-pointing angle quotation mark|2043~-~hyphen bullet|2044~/~fraction slash|
205F~ ~medium mathematical space|2060~~word joiner|2061~~function application|
2062~~invisible times|2063~~invisible separator|2064~~invisible plus|2066~~left-to-right isolate|
2067~~right-to-left isolate|2068~~first strong isolate|2069~~pop directional isolate|
20AC~~euro sign|2212~-~minus sign|2215~/~division slash|2236~:~ratio|3000~ ~ideographic space|
3001~,~ideographic comma|3002~.~ideographic full stop|3010~[~left black lenticular bracket|
3011~]~right black lenticular bracket|A789~:~modifier letter colon|FE63~-~small hyphen-minus|
FEFF~~byte order mark|FFFD~~replacement character|
)";

// An entry of the table. The texts are parts of it.
struct NamedCharacter {
    char32_t code = 0;
    std::string_view ascii, name;
};

// The parts of the table, without the ends of its lines.
std::vector<NamedCharacter> parsedTable() {
    std::vector<NamedCharacter> all;
    for (std::string_view rest = kTable; rest.find('|') != std::string_view::npos;) {
        if (rest.front() == '\n') rest.remove_prefix(1);
        const std::string_view entry = rest.substr(0, rest.find('|'));
        const std::size_t first = entry.find('~'), second = entry.find('~', first + 1);
        std::uint32_t code = 0;
        std::from_chars(entry.data(), entry.data() + first, code, 16);
        all.push_back(
            {code, entry.substr(first + 1, second - first - 1), entry.substr(second + 1)});
        rest.remove_prefix(entry.size() + 1);
    }
    return all;
}

// The entry of a character; null where the table has none.
const NamedCharacter* inTable(char32_t code) {
    static const std::vector<NamedCharacter> all = parsedTable();
    const auto found = std::ranges::lower_bound(all, code, {}, &NamedCharacter::code);
    return found != all.end() && found->code == code ? &*found : nullptr;
}

// The ASCII character of a full-width form, which is as wide as a Chinese character.
constexpr char32_t kFirstFullWidth = 0xFF01, kLastFullWidth = 0xFF5E, kFullWidthOffset = 0xFEE0;

// ASCII as East Asian keyboards type it.
bool isFullWidth(char32_t code) {
    return code >= kFirstFullWidth && code <= kLastFullWidth;
}

// The first of ten digits of a script.
struct DigitRange {
    char32_t zero;
    const char* script;
};
constexpr DigitRange kDigits[] = {{0x0660, "Arabic-Indic"},
                                  {0x06F0, "extended Arabic-Indic"},
                                  {0x0966, "Devanagari"},
                                  {0x09E6, "Bengali"},
                                  {0x0E50, "Thai"},
                                  {0xFF10, "full-width"}};

// The digit in ASCII; null where the character is not a digit of these scripts.
const DigitRange* digitsWith(char32_t code) {
    const auto* found = std::ranges::find_if(
        kDigits, [&](const DigitRange& range) { return code - range.zero < 10; });
    return found == std::end(kDigits) ? nullptr : found;
}

// The number of bytes that follow the first byte of a sequence, from its leading one bits; -1 where
// it cannot be a first byte.
int continuationBytes(unsigned char first) {
    const int ones = std::countl_one(first);
    if (ones == 0) return 0;
    return ones > 1 && ones < 5 ? ones - 1 : -1;
}

// Whether a code point is valid: encoded as short as possible, not half of a UTF-16 pair, within
// Unicode.
bool isScalar(char32_t code, int following) {
    constexpr char32_t kLeast[] = {0, 0x80, 0x800, 0x10000};
    return code >= kLeast[following] && code <= 0x10FFFF && (code < 0xD800 || code > 0xDFFF);
}

// Encodes a code point, which must be valid.
void appendUtf8(std::string& text, char32_t code) {
    const auto part = [&](unsigned shift) {
        text += static_cast<char>(0x80U | ((code >> shift) & 0x3FU));
    };
    if (code < 0x80) {
        text += static_cast<char>(code);
    } else if (code < 0x800) {
        text += static_cast<char>(0xC0U | (code >> 6U));
        part(0);
    } else {
        text += static_cast<char>(code < 0x10000 ? 0xE0U | (code >> 12U) : 0xF0U | (code >> 18U));
        if (code >= 0x10000) part(12);
        part(6);
        part(0);
    }
}

// The description of a character that cannot be shown; empty where it can be shown.
std::string wordsForUnseen(char32_t code) {
    if (isControl(code) || code < ' ') return "a control character";
    return isInvisible(code) ? "an invisible character" : "";
}

// The name from the table or the ranges; else the character itself, where it can be shown.
std::string wordsFor(char32_t code) {
    if (const NamedCharacter* known = inTable(code)) return std::string(known->name);
    if (const DigitRange* range = digitsWith(code))
        return fmt::format("{} digit {}", range->script, static_cast<int>(code - range->zero));
    if (isFullWidth(code))
        return fmt::format("full-width {}", static_cast<char>(code - kFullWidthOffset));
    std::string words = wordsForUnseen(code);
    if (words.empty()) appendUtf8(words, code);
    return words;
}

// Appends the bits of the following bytes to a code; empty where one is not a following byte.
std::optional<char32_t> joined(char32_t code, std::string_view following) {
    for (const char byte : following) {
        if ((static_cast<unsigned char>(byte) & 0xC0U) != 0x80) return std::nullopt;
        code = (code << 6U) | (static_cast<unsigned char>(byte) & 0x3FU);
    }
    return code;
}

// The ASCII characters for a character of a number; an empty text for an invisible one; no value
// where there are none.
std::optional<std::string> typedFor(const CodePoint& point) {
    if (!point.isUtf8) return std::nullopt;
    if (point.code < 0x80) return std::string(1, static_cast<char>(point.code));
    const std::string ascii = asciiFor(point.code);
    return ascii.empty() && !isInvisible(point.code) ? std::nullopt : std::optional(ascii);
}

// The text in ASCII, without spaces around it; empty where a character has no equivalent.
std::string inAscii(std::string_view text) {
    std::string ascii;
    for (std::size_t at = 0; at < text.size();) {
        const CodePoint point = codePointAt(text, at);
        const auto typed = typedFor(point);
        if (!typed) return "";
        ascii += *typed;
        at += point.bytes;
    }
    return std::string(trimmed(ascii));
}

bool isDigitAt(std::string_view text, std::size_t at) {
    return at < text.size() && text[at] >= '0' && text[at] <= '9';
}

// Whether the character separates thousands: a blank, apostrophe or underscore between digits.
bool isGapAt(std::string_view text, std::size_t at) {
    const bool isSeparator = std::string_view(" _'").find(text[at]) != std::string_view::npos;
    return isSeparator && at > 0 && isDigitAt(text, at - 1) && isDigitAt(text, at + 1);
}

std::string withoutGroups(const std::string& text) {
    std::string joined;
    for (std::size_t i = 0; i < text.size(); ++i)
        if (!isGapAt(text, i)) joined += text[i];
    return joined;
}

// The last comma or point is the decimal one, unless the same sign occurs more than once.
std::string withDecimalPoint(std::string text) {
    const std::size_t last = text.find_last_of(",.");
    if (last == std::string::npos) return text;
    const char decimal = text[last];
    const bool isOnce = std::ranges::count(text, decimal) == 1;
    if (isOnce) text[last] = '\n';
    std::erase_if(text, [](char c) { return c == ',' || c == '.'; });
    std::ranges::replace(text, '\n', '.');
    return text;
}

// Whether the text is a finite number with a digit: from_chars also accepts "nan" and "inf".
bool isDecimal(const std::string& text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && end == text.data() + text.size() &&
           text.find_first_of("0123456789") != std::string::npos;
}

// The remark about a character that is not ASCII.
std::string foreignWords(const CodePoint& point) {
    if (!point.isUtf8) return "it has " + nameOf(point) + ", which is not UTF-8";
    const std::string ascii = asciiFor(point.code);
    return "it has " + nameOf(point) + (ascii.empty() || ascii == " " ? "" : ": type " + ascii);
}

}  // namespace

CodePoint codePointAt(std::string_view text, std::size_t at) {
    const auto first = static_cast<unsigned char>(text[at]);
    const int following = continuationBytes(first);
    if (following == 0) return {first, 1, true};
    const CodePoint wrong{first, 1, false};
    const auto count = static_cast<std::size_t>(std::max(0, following));
    if (following < 0 || at + count >= text.size()) return wrong;
    const char32_t begun = first & (0x3FU >> static_cast<unsigned>(following));
    const auto code = joined(begun, text.substr(at + 1, count));
    return code && isScalar(*code, following) ? CodePoint{*code, count + 1} : wrong;
}

std::string nameOf(const CodePoint& point) {
    const auto code = static_cast<std::uint32_t>(point.code);
    if (point.isUtf8) return fmt::format("U+{:04X} ({})", code, wordsFor(point.code));
    std::string latin1;
    appendUtf8(latin1, point.code);
    return fmt::format("byte 0x{:02X}{}", code, code < 0xA0 ? "" : " (" + latin1 + " in Latin-1)");
}

std::string asciiFor(char32_t code) {
    if (const NamedCharacter* known = inTable(code)) return std::string(known->ascii);
    if (const DigitRange* range = digitsWith(code)) return std::to_string(code - range->zero);
    return isFullWidth(code) ? std::string(1, static_cast<char>(code - kFullWidthOffset)) : "";
}

bool isControl(char32_t code) {
    const bool isLayout = code == '\t' || code == '\n' || code == '\r';
    return (code < 0x20 && !isLayout) || (code >= 0x7F && code < 0xA0);
}

bool isInvisible(char32_t code) {
    constexpr std::pair<char32_t, char32_t> kRanges[] = {{0x00A0, 0x00A0},
                                                         {0x00AD, 0x00AD},
                                                         {0x034F, 0x034F},
                                                         {0x061C, 0x061C},
                                                         {0x115F, 0x1160},
                                                         {0x17B4, 0x17B5},
                                                         {0x180B, 0x180F},
                                                         {0x2000, 0x200F},
                                                         {0x2028, 0x202F},
                                                         {0x205F, 0x206F},
                                                         {0x3000, 0x3000},
                                                         {0x3164, 0x3164},
                                                         {0xFE00, 0xFE0E},
                                                         {0xFEFF, 0xFEFF},
                                                         {0xFFA0, 0xFFA0},
                                                         {0xFFF0, 0xFFFB},
                                                         {0xE0000, 0xE0FFF}};
    return std::ranges::any_of(
        kRanges, [&](const auto& range) { return code >= range.first && code <= range.second; });
}

bool isTypographicQuote(char32_t code) {
    const std::string ascii = code < 0x80 ? "" : asciiFor(code);
    return ascii == "\"" || ascii == "'";
}

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kBlank = " \t\r\n";
    const std::size_t first = text.find_first_not_of(kBlank);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kBlank) + 1 - first);
}

std::string plainNumber(std::string_view text) {
    constexpr std::size_t kMostBytes = 64;
    if (text.empty() || text.size() > kMostBytes) return "";
    std::string plain = withDecimalPoint(withoutGroups(inAscii(text)));
    if (plain.starts_with('+')) plain.erase(0, 1);
    return plain != text && isDecimal(plain) ? plain : "";
}

std::string foreignCharacterIn(std::string_view text) {
    const auto* const found =
        std::ranges::find_if(text, [](char c) { return static_cast<unsigned char>(c) >= 0x80; });
    if (found == text.end()) return "";
    return foreignWords(codePointAt(text, static_cast<std::size_t>(found - text.begin())));
}

std::string legible(std::string_view text, std::size_t mostBytes) {
    std::string line;
    for (std::size_t at = 0; at < text.size();) {
        const CodePoint point = codePointAt(text, at);
        const bool isShown = point.isUtf8 && !isControl(point.code);
        const std::string shown =
            isShown ? std::string(text.substr(at, point.bytes))
                    : fmt::format("\\x{:02X}", static_cast<std::uint32_t>(point.code));
        if (shown.size() > mostBytes - line.size()) break;
        line += shown;
        at += point.bytes;
    }
    return line;
}

}  // namespace aquarama
