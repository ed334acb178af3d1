// SPDX-License-Identifier: Apache-2.0
// Our text files with other values in them, comments and all.
#pragma once

#include <regex>
#include <string>

#include <gtest/gtest.h>

#include "common/config/text_file.h"

namespace aquarama::test {

// The text with another value of the first field of this name that has one, no message.
inline std::string withField(const std::string& text,
                             const std::string& field,
                             const std::string& value) {
    const std::regex written("(^|[\\s{])" + field + R"(: *("[^"\n]*"|[^\s}]+))");
    EXPECT_TRUE(std::regex_search(text, written)) << field;
    return std::regex_replace(
        text, written, "$1" + field + ": " + value, std::regex_constants::format_first_only);
}

inline std::string quoted(const std::string& text) {
    return "\"" + text + "\"";
}

// config/NAME.txtpb, as it would stand in any folder.
inline std::string shippedRigText(const std::string& name) {
    const std::string path = AQUARAMA_SOURCE_DIR "/config/" + name + ".txtpb";
    return withField(config::readTextFile(path),
                     "scene",
                     quoted(AQUARAMA_SOURCE_DIR "/config/scenes/reef.txtpb"));
}

}  // namespace aquarama::test
