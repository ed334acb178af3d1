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

// Of ASCII, whatever the locale.
bool isDigit(char c) {
    return c >= '0' && c <= '9';
}

bool beginsWithDigit(std::string_view text) {
    return !text.empty() && isDigit(text[0]);
}

// Of a name in the text format.
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

// A character as an ASCII keyboard has it.
std::string asTyped(const CodePoint& point) {
    return point.code < 0x80 ? std::string(1, static_cast<char>(point.code)) : asciiFor(point.code);
}

// Of any script.
bool isAnyDigit(const CodePoint& point) {
    const std::string ascii = asTyped(point);
    return ascii.size() == 1 && isDigit(ascii[0]);
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

    // Past one character; the end of a line begins the next.
    void advance() {
        const CodePoint passed = point();
        at_ += passed.bytes;
        column_ += passed.code == '\t' ? kTabWidth - column_ % kTabWidth : 1;
        if (passed.code != '\n') return;
        ++line_;
        column_ = 0;
    }
    // They must end where a character does.
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

// How many of every second byte at a text's beginning are zero.
std::size_t zerosFrom(std::string_view text, std::size_t first) {
    constexpr std::size_t kTelling = 64;
    std::size_t count = 0;
    for (std::size_t i = first; i < std::min(text.size(), kTelling); i += 2)
        if (text[i] == '\0') ++count;
    return count;
}

// With a mark, or ASCII with a zero beside each character.
bool isUtf16(std::string_view text) {
    if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) return true;
    return (zerosFrom(text, 0) == 0) != (zerosFrom(text, 1) == 0);
}

// What is wrong with a character wherever it stands; empty: nothing.
std::string faultOf(const CodePoint& point) {
    if (!point.isUtf8) return nameOf(point) + " is no UTF-8: save the file as UTF-8";
    const bool isBlank = point.code == '\f' || point.code == '\v';
    if (isBlank || !isControl(point.code)) return "";
    return nameOf(point) + ": remove it; is this a text file?";
}

void checkEncoding(std::string_view text, const std::string& source) {
    if (isUtf16(text))
        throw Error(placed(source, {1, 1}, "the file is saved as UTF-16: save it as UTF-8"));
    for (TextCursor cursor(text, source); !cursor.isAtEnd(); cursor.advance())
        if (const std::string fault = faultOf(cursor.point()); !fault.empty()) cursor.refuse(fault);
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
            else
                checkToken(c);
        }
    }

  private:
    // Up to the end of its line, which ends it.
    void passComment() {
        while (!cursor_.isAtEnd() && cursor_.byte() != '\n') cursor_.advance();
    }

    // What is neither a comment nor between quotes.
    void checkToken(char c) {
        if (beginsNumber())
            checkNumber();
        else if (isWord(c))
            passWord();
        else
            checkSign(c);
    }

    // A name or a choice, which ends at a character of another alphabet.
    void passWord() {
        while (isWord(cursor_.byte())) cursor_.advance();
        const CodePoint next = cursor_.isAtEnd() ? CodePoint{} : cursor_.point();
        if (next.code >= 0x80) refuseForeign(next);
    }

    // Brackets, colons and the like; counts the lists that are open.
    void checkSign(char c) {
        if (c == '[') ++lists_;
        if (c == ']' && lists_ > 0) --lists_;
        if (c == '+') cursor_.refuse("+ before a number: leave it out");
        const CodePoint point = cursor_.point();
        if (point.code >= 0x80) refuseForeign(point);
        cursor_.advance();
    }

    // With what to type instead, where there is such a thing.
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
        before_ = 0;
        curly_.clear();
        cursor_.advance();
        while (cursor_.byte() != quote) {
            if (cursor_.byte() == '\\') cursor_.advance();
            if (cursor_.isAtEnd() || cursor_.byte() == '\n') refuseOpen(begin);
            checkInQuotes(cursor_.point());
            cursor_.advance();
        }
        cursor_.advance();
    }

    // At the curly quote that was meant as its end, where there is one.
    [[noreturn]] void refuseOpen(SourcePlace begin) const {
        if (!curly_.empty())
            cursor_.refuseAt(curlyAt_, curly_ + " ends no text: type the quote that began it");
        cursor_.refuseAt(begin, "the text that begins here has no end: type \" after it");
    }

    // Any language is good; what misleads is refused.
    void checkInQuotes(const CodePoint& point) {
        if (isInvisible(point.code)) refuseInvisible(point);
        if (looksLatin(point.code) && isBesideLatin(point))
            cursor_.refuse(nameOf(point) + " among Latin letters: type " + asciiFor(point.code));
        before_ = point.code;
        if (!curly_.empty() || !isTypographicQuote(point.code)) return;
        curlyAt_ = cursor_.place();
        curly_ = nameOf(point);
    }

    [[noreturn]] void refuseInvisible(const CodePoint& point) const {
        const bool isSpace = asciiFor(point.code) == " ";
        cursor_.refuse(nameOf(point) + " in a text: " + (isSpace ? "type a space" : "remove it"));
    }

    // The character stands where the cursor is.
    [[nodiscard]] bool isBesideLatin(const CodePoint& point) const {
        const std::string_view next = cursor_.rest().substr(point.bytes);
        return isLatinLetter(before_) ||
               (!next.empty() && isLatinLetter(codePointAt(next, 0).code));
    }

    [[nodiscard]] bool beginsNumber() const {
        const bool isFraction = cursor_.byte() == '.' && isDigit(cursor_.byte(1));
        return isFraction || isAnyDigit(cursor_.point());
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
        if (point.code >= 0x80) return isAnyDigit(point);
        if (rest[at] == '+' || rest[at] == '-') return isExponentAt(rest, at);
        return isWord(rest[at]) || rest[at] == '.';
    }

    // Whether a sign is that of an exponent: 1e-3.
    [[nodiscard]] static bool isExponentAt(std::string_view number, std::size_t sign) {
        return sign > 0 && !isHex(number) &&
               std::string_view("eE").find(number[sign - 1]) != std::string_view::npos;
    }

    // A comma parts the numbers of a list; elsewhere, as a blank, it parts digits of one number.
    [[nodiscard]] bool isBetweenDigits(std::string_view rest, std::size_t at) const {
        const CodePoint point = codePointAt(rest, at);
        const std::string ascii = asTyped(point);
        const std::string_view separators = lists_ > 0 ? "'." : "'., ";
        if (ascii.size() != 1 || separators.find(ascii) == std::string_view::npos) return false;
        return at > 0 && isDigit(rest[at - 1]) && beginsWithDigit(rest.substr(at + point.bytes));
    }

    // The number as a whole, so that the message can quote it.
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

    [[nodiscard]] static bool isHex(std::string_view word) {
        return word.starts_with("0x") || word.starts_with("0X");
    }

    // As the text format has them: decimal, hexadecimal, with a fraction, an exponent or an f.
    [[nodiscard]] static bool isNumber(std::string_view word) {
        if (isHex(word))
            return word.size() > 2 &&
                   word.find_first_not_of("0123456789abcdefABCDEF", 2) == std::string_view::npos;
        if (word.ends_with('f') || word.ends_with('F')) word.remove_suffix(1);
        double value = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        return error != std::errc::invalid_argument && end == word.data() + word.size();
    }

    // A zero before other digits.
    [[nodiscard]] static bool isOctal(std::string_view word) {
        return word.size() > 1 && word[0] == '0' &&
               word.find_first_not_of("0123456789") == std::string_view::npos;
    }

    TextCursor cursor_;
    int lists_ = 0;  // brackets that are open
    // Of the text between quotes: the character before, and the first curly quote in it.
    char32_t before_ = 0;
    SourcePlace curlyAt_;
    std::string curly_;
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
