// SPDX-License-Identifier: Apache-2.0
// Text files as people save them, before protobuf's parser sees them: their encoding, and what
// editors and other alphabets put where the text format has none of it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "common/config/text_file.h"

namespace aquarama::config {

// The text without a byte order mark, its lines ended by '\n'. Throws Error "file:line:column: ..."
// where it is no UTF-8, or has controls.
[[nodiscard]] std::string plainText(std::string text, const std::string& source);

// Holds a plain text to what the text format allows outside of quotes and comments: ASCII, and
// numbers with a decimal point and nothing between their digits. In quotes and comments any
// characters are good, but in quotes none that nobody sees, and no Cyrillic or Greek letter that
// looks like a Latin one beside Latin ones. Throws Error, which says what to type instead.
void checkCharacters(const std::string& text, const std::string& source);
// What is wrong with the value of a quoted text, whose escapes may be anything; empty: nothing.
[[nodiscard]] std::string faultOfQuoted(const std::string& value);

// Protobuf counts bytes from 0, tabs to multiples of eight; editors count characters from 1.
class Columns {
  public:
    explicit Columns(const std::string& text);
    // A place of the text, of lines and columns that protobuf counts from 0.
    [[nodiscard]] SourcePlace placeOf(int line, int column) const;

  private:
    // Line and column of each byte that does not begin a character.
    std::vector<std::pair<int, int>> within_;
};

}  // namespace aquarama::config
