// SPDX-License-Identifier: Apache-2.0
#include "common/config/plain_text.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <string_view>
#include <system_error>

#include "common/base/characters.h"
#include "common/base/log.h"

namespace aquarama::config {

namespace {

constexpr int kTabWidth = 8;

bool isDigit(char c) {
    return c >= '0' && c <= '9';
}

bool isWord(char c) {
    return isDigit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

bool isLatinLetter(char32_t code) {
    return (code >= 'a' && code <= 'z') || (code >= 'A' && code <= 'Z');
}

// A character of another alphabet that looks like a Latin letter.
bool looksLatin(char32_t code) {
    const std::string ascii = code >= 0x0370 && code < 0x0530 ? asciiFor(code) : "";
    return !ascii.empty() && isLatinLetter(static_cast<unsigned char>(ascii[0]));
}

// Moves over a text, character by character, and knows where it is in the terms of an editor.
class TextCursor {
  public:
    TextCursor(std::string_view text, const std::string& source) : text_(text), source_(source) {}

    [[nodiscard]] bool isAtEnd() const { return at_ >= text_.size(); }
    // Of ASCII; 0 past the end.
    [[nodiscard]] char byte(std::size_t ahead = 0) const {
        return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
    }
    [[nodiscard]] CodePoint point() const { return codePointAt(text_, at_); }
    [[nodiscard]] std::string_view rest() const { return text_.substr(at_); }
    [[nodiscard]] SourcePlace place() const { return {line_, column_ + 1}; }

    void advance() {
        const CodePoint passed = point();
        at_ += passed.bytes;
        column_ += passed.code == '\t' ? kTabWidth - column_ % kTabWidth : 1;
        if (passed.code != '\n') return;
        ++line_;
        column_ = 0;
    }
    void advanceBytes(std::size_t bytes) {
        for (const std::size_t end = at_ + bytes; at_ < end;) advance();
    }
    [[noreturn]] void refuse(const std::string& why) const { refuseAt(place(), why); }
    [[noreturn]] void refuseAt(SourcePlace where, const std::string& why) const {
        throw Error(placed(source_, where, why));
    }

  private:
    std::string_view text_;
    const std::string& source_;
    std::size_t at_ = 0;
    int line_ = 1, column_ = 0;
};

// With a mark, or ASCII with a zero beside each character.
bool isUtf16(std::string_view text) {
    const auto zeros = [&](std::size_t from) {
        constexpr std::size_t kTelling = 64;
        std::size_t count = 0;
        for (std::size_t i = from; i < std::min(text.size(), kTelling); i += 2)
            count += text[i] == '\0' ? 1 : 0;
        return count;
    };
    if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) return true;
    return zeros(0) + zeros(1) > 0 && (zeros(0) == 0 || zeros(1) == 0);
}

void checkEncoding(std::string_view text, const std::string& source) {
    if (isUtf16(text))
        throw Error(placed(source, {1, 1}, "the file is saved as UTF-16: save it as UTF-8"));
    for (TextCursor cursor(text, source); !cursor.isAtEnd(); cursor.advance()) {
        const CodePoint point = cursor.point();
        if (!point.isUtf8) cursor.refuse(nameOf(point) + " is no UTF-8: save the file as UTF-8");
        if (isControl(point.code) && point.code != '\f' && point.code != '\v')
            cursor.refuse(nameOf(point) + ": remove it; is this a text file?");
    }
}

// Ends of lines of old Macs, which protobuf does not know.
void mendLineEnds(std::string& text) {
    for (std::size_t i = 0; i < text.size(); ++i)
        if (text[i] == '\r' && (i + 1 == text.size() || text[i + 1] != '\n')) text[i] = '\n';
}

// Reads a text as protobuf's tokenizer does, as far as characters matter.
class CharacterCheck {
  public:
    CharacterCheck(std::string_view text, const std::string& source) : cursor_(text, source) {}

    void run() {
        while (!cursor_.isAtEnd()) {
            const char c = cursor_.byte();
            if (c == '#')
                passComment();
            else if (c == '"' || c == '\'')
                checkQuoted(c);
            else if (beginsNumber())
                checkNumber();
            else if (isWord(c))
                passWord();
            else
                checkSign(c);
        }
    }

  private:
    void passComment() {
        while (!cursor_.isAtEnd() && cursor_.byte() != '\n') cursor_.advance();
    }

    // A name or a choice, which ends at a character of another alphabet.
    void passWord() {
        while (isWord(cursor_.byte())) cursor_.advance();
        const CodePoint next = cursor_.isAtEnd() ? CodePoint{} : cursor_.point();
        if (next.code >= 0x80) refuseForeign(next);
    }

    void checkSign(char c) {
        if (c == '[') ++lists_;
        if (c == ']' && lists_ > 0) --lists_;
        if (c == '+') cursor_.refuse("+ before a number: leave it out");
        const CodePoint point = cursor_.point();
        if (point.code >= 0x80) refuseForeign(point);
        cursor_.advance();
    }

    [[noreturn]] void refuseForeign(const CodePoint& point) const {
        const std::string ascii = asciiFor(point.code);
        const std::string what = nameOf(point);
        if (ascii == " ") cursor_.refuse(what + ": type a space");
        if (!ascii.empty()) cursor_.refuse(what + ": type " + ascii);
        if (isInvisible(point.code)) cursor_.refuse(what + ": remove it");
        cursor_.refuse(what + " stands outside of quotes: type ASCII here, or put a text in \" \"");
    }

    // The text between two quotes on one line.
    void checkQuoted(char quote) {
        const SourcePlace begin = cursor_.place();
        SourcePlace curlyAt;
        std::string curly;
        char32_t before = 0;
        for (cursor_.advance(); cursor_.byte() != quote; cursor_.advance()) {
            if (cursor_.isAtEnd() || cursor_.byte() == '\n') refuseOpen(begin, curlyAt, curly);
            if (cursor_.byte() == '\\' && cursor_.byte(1) != '\n') cursor_.advance();
            if (cursor_.isAtEnd()) refuseOpen(begin, curlyAt, curly);
            const CodePoint point = cursor_.point();
            checkInQuotes(point, before);
            before = point.code;
            if (!isTypographicQuote(point.code) || !curly.empty()) continue;
            curlyAt = cursor_.place();
            curly = nameOf(point);
        }
        cursor_.advance();
    }

    [[noreturn]] void refuseOpen(SourcePlace begin,
                                 SourcePlace curlyAt,
                                 const std::string& curly) const {
        if (!curly.empty())
            cursor_.refuseAt(curlyAt, curly + " ends no text: type the quote that began it");
        cursor_.refuseAt(begin, "the text that begins here has no end: type \" after it");
    }

    void checkInQuotes(const CodePoint& point, char32_t before) const {
        const std::string ascii = asciiFor(point.code);
        if (isInvisible(point.code))
            cursor_.refuse(nameOf(point) +
                           " in a text: " + (ascii == " " ? "type a space" : "remove it"));
        const auto next = cursor_.rest().substr(point.bytes);
        const char32_t after = next.empty() ? 0 : codePointAt(next, 0).code;
        if (looksLatin(point.code) && (isLatinLetter(before) || isLatinLetter(after)))
            cursor_.refuse(nameOf(point) + " among Latin letters: type " + ascii);
    }

    [[nodiscard]] bool beginsNumber() const {
        const char c = cursor_.byte();
        if (isDigit(c) || (c == '.' && isDigit(cursor_.byte(1)))) return true;
        const std::string ascii = cursor_.point().code < 0x80 ? "" : asciiFor(cursor_.point().code);
        return !ascii.empty() && isDigit(ascii[0]);
    }

    // What is written as one number, with all that may stand between its digits.
    [[nodiscard]] std::string_view numberAhead() const {
        const std::string_view rest = cursor_.rest();
        std::size_t end = 0;
        while (end < rest.size()) {
            const std::size_t next = end + codePointAt(rest, end).bytes;
            if (!isOfNumber(rest, end) && !isBetweenDigits(rest, end)) break;
            end = next;
        }
        return rest.substr(0, end);
    }

    // Digits, letters and points; the sign of an exponent; digits of other scripts.
    [[nodiscard]] static bool isOfNumber(std::string_view rest, std::size_t at) {
        const CodePoint point = codePointAt(rest, at);
        if (point.code >= 0x80) {
            const std::string ascii = asciiFor(point.code);
            return !ascii.empty() && isDigit(ascii[0]);
        }
        const char c = rest[at];
        const bool isExponent = at > 0 && (rest[at - 1] == 'e' || rest[at - 1] == 'E') &&
                                !rest.starts_with("0x") && !rest.starts_with("0X");
        return isWord(c) || c == '.' || (isExponent && (c == '+' || c == '-'));
    }

    // A comma parts the numbers of a list, and a blank does so nowhere.
    [[nodiscard]] bool isBetweenDigits(std::string_view rest, std::size_t at) const {
        const CodePoint point = codePointAt(rest, at);
        const std::string ascii =
            point.code < 0x80 ? std::string(1, rest[at]) : asciiFor(point.code);
        const std::size_t next = at + point.bytes;
        const bool isSeparator = ascii == "'" || ascii == " " || ascii == "," || ascii == ".";
        const bool isOfList = lists_ > 0 && (ascii == "," || ascii == " ");
        return isSeparator && !isOfList && at > 0 && isDigit(rest[at - 1]) && next < rest.size() &&
               isDigit(rest[next]);
    }

    void checkNumber() {
        const std::string_view word = numberAhead();
        if (!isNumber(word)) {
            const std::string shown = "\"" + legible(word) + "\"";
            const std::string plain = plainNumber(word);
            if (plain.empty())
                cursor_.refuse(shown + " is no number: type digits, with a point before decimals");
            cursor_.refuse(shown + " is no number here: type " + plain + whyNot(word));
        }
        if (isOctal(word))
            cursor_.refuse("\"" + std::string(word) +
                           "\" begins with 0, and would be read as octal: type it without");
        cursor_.advanceBytes(word.size());
    }

    // Which character is not of ASCII, where that is the fault.
    [[nodiscard]] static std::string whyNot(std::string_view word) {
        for (std::size_t at = 0; at < word.size(); at += codePointAt(word, at).bytes)
            if (codePointAt(word, at).code >= 0x80)
                return " (it has " + nameOf(codePointAt(word, at)) + ")";
        return "";
    }

    // As the text format has them: decimal, hexadecimal, with a fraction, an exponent or an f.
    [[nodiscard]] static bool isNumber(std::string_view word) {
        const bool isHex = word.starts_with("0x") || word.starts_with("0X");
        if (isHex)
            return word.size() > 2 &&
                   word.find_first_not_of("0123456789abcdefABCDEF", 2) == std::string_view::npos;
        if (word.ends_with('f') || word.ends_with('F')) word.remove_suffix(1);
        double value = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        return error != std::errc::invalid_argument && end == word.data() + word.size();
    }

    [[nodiscard]] static bool isOctal(std::string_view word) {
        return word.size() > 1 && word[0] == '0' &&
               word.find_first_not_of("0123456789") == std::string_view::npos;
    }

    TextCursor cursor_;
    int lists_ = 0;  // brackets that are open
};

}  // namespace

std::string plainText(std::string text, const std::string& source) {
    constexpr std::string_view kMark = "\xEF\xBB\xBF";
    if (text.starts_with(kMark)) text.erase(0, kMark.size());
    checkEncoding(text, source);
    mendLineEnds(text);
    return text;
}

void checkCharacters(const std::string& text, const std::string& source) {
    CharacterCheck(text, source).run();
}

std::string faultOfQuoted(const std::string& value) {
    for (std::size_t at = 0; at < value.size();) {
        const CodePoint point = codePointAt(value, at);
        if (!point.isUtf8) return "has " + nameOf(point) + ", which is no UTF-8: write it as UTF-8";
        const bool isControlled = isControl(point.code) || point.code < ' ';
        if (isControlled || isInvisible(point.code)) return "has " + nameOf(point) + ": remove it";
        at += point.bytes;
    }
    return "";
}

Columns::Columns(const std::string& text) {
    int line = 0, column = 0;
    for (const char c : text) {
        const bool isWithin = (static_cast<unsigned char>(c) & 0xC0U) == 0x80;
        if (isWithin) within_.emplace_back(line, column);
        column += c == '\t' ? kTabWidth - column % kTabWidth : 1;
        if (c != '\n') continue;
        ++line;
        column = 0;
    }
}

SourcePlace Columns::placeOf(int line, int column) const {
    const auto first = std::ranges::lower_bound(within_, std::pair{line, 0});
    const auto last = std::ranges::lower_bound(within_, std::pair{line, column});
    return {line + 1, column + 1 - static_cast<int>(last - first)};
}

}  // namespace aquarama::config
