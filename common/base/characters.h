// SPDX-License-Identifier: Apache-2.0
// Characters of UTF-8 that office programs, web pages and keyboards of other alphabets put into
// texts and command lines: their names, and what to type instead.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace aquarama {

// The code point at a place of a text; where the bytes are no UTF-8, the first of them alone.
struct CodePoint {
    char32_t code = 0;
    std::size_t bytes = 1;
    bool isUtf8 = true;
};
[[nodiscard]] CodePoint codePointAt(std::string_view text, std::size_t at);

// "U+2019 (right single quotation mark)"; "byte 0xE9 (é in Latin-1)".
[[nodiscard]] std::string nameOf(const CodePoint& point);

// What an ASCII keyboard has for a character that looks or is meant like it: "-" for a minus sign,
// "3" for a full-width three, "a" for a Cyrillic а. Empty where there is none.
[[nodiscard]] std::string asciiFor(char32_t code);

// Controls other than tab and ends of lines; those of C1 too.
[[nodiscard]] bool isControl(char32_t code);
// Takes no place on a screen, or only the place of a space: nobody sees it in a name.
[[nodiscard]] bool isInvisible(char32_t code);
// Curly, angled and low quotation marks, for " or '.
[[nodiscard]] bool isTypographicQuote(char32_t code);

// A text that is meant as a number, as our readers take it: "2.5" for "2,5", "-3" for "−３", "1000"
// for "1 000". Empty where it is no such number, or is one already.
[[nodiscard]] std::string plainNumber(std::string_view text);

// What to add to a message that refuses `text`: its first character that is no ASCII, and what to
// type for it. Empty where there is none.
[[nodiscard]] std::string foreignCharacterIn(std::string_view text);

// A text for one line of a log or a terminal: what is no UTF-8 and controls come as \xE9 or \x1B.
[[nodiscard]] std::string legible(std::string_view text);

}  // namespace aquarama
