// SPDX-License-Identifier: Apache-2.0
// Characters of UTF-8 that office programs, web pages and keyboards of other alphabets put into
// texts and command lines: their names, and what to type instead.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace aquarama {

// The code point at a place of a text. Where the bytes are not valid UTF-8: the first byte alone.
struct CodePoint {
    char32_t code = 0;
    std::size_t bytes = 1;
    bool isUtf8 = true;
};
[[nodiscard]] CodePoint codePointAt(std::string_view text, std::size_t at);

// "U+2019 (right single quotation mark)"; "byte 0xE9 (é in Latin-1)".
[[nodiscard]] std::string nameOf(const CodePoint& point);

// The ASCII characters to type instead of a character that looks like them or means the same: "-"
// for a minus sign, "3" for a full-width three, "a" for a Cyrillic а. Empty where there is none.
[[nodiscard]] std::string asciiFor(char32_t code);

// Whether it is a control character, C1 included, other than tab and line end.
[[nodiscard]] bool isControl(char32_t code);
// Whether it is invisible in a name: it has no width on a screen, or looks like a space.
[[nodiscard]] bool isInvisible(char32_t code);
// Whether it is a curly, angled or low quotation mark, typed in place of " or '.
[[nodiscard]] bool isTypographicQuote(char32_t code);

// Without spaces, tabs and line ends before and behind.
[[nodiscard]] std::string_view trimmed(std::string_view text);

// The number that a text means, in the form that our readers accept: "2.5" for "2,5", "-3" for
// "−３", "1000" for "1 000". Empty where the text is not such a number, or already has that form.
[[nodiscard]] std::string plainNumber(std::string_view text);

// An addition to a message that refuses `text`: names its first character that is not ASCII, and
// what to type instead. Empty where all are ASCII.
[[nodiscard]] std::string foreignCharacterIn(std::string_view text);

// A text for one line of a log, a terminal or a message: what is no UTF-8 and controls come as \xE9
// or \x1B. It ends before the first character that would make it longer than `mostBytes`.
[[nodiscard]] std::string legible(std::string_view text,
                                  std::size_t mostBytes = std::string_view::npos);

}  // namespace aquarama
