// SPDX-License-Identifier: Apache-2.0
// aquarama_draw_sheet OUT.png COLUMNS PICTURE.png...: lays pictures of one size side by side on
// white, for documents.
#include <algorithm>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "common/base/log.h"
#include "common/base/picture.h"

namespace aquarama::test {
namespace {

constexpr int kGap = 6;  // pixels between pictures, half of it at the sheet's rim

void paste(Picture& sheet, const Picture& picture, glm::ivec2 corner) {
    for (int y = 0; y < picture.sizePixels.y; ++y) {
        const auto row = picture.rgb.begin() + std::ptrdiff_t{3} * y * picture.sizePixels.x;
        std::copy_n(row,
                    std::ptrdiff_t{3} * picture.sizePixels.x,
                    sheet.rgb.begin() +
                        std::ptrdiff_t{3} * ((corner.y + y) * sheet.sizePixels.x + corner.x));
    }
}

Picture sheetOf(const std::vector<std::string>& paths, int columns) {
    const glm::ivec2 size = readPng(paths.front()).sizePixels;
    const int rows = (static_cast<int>(paths.size()) + columns - 1) / columns;
    Picture sheet;
    sheet.sizePixels = (size + kGap) * glm::ivec2{columns, rows};
    sheet.rgb.resize(std::size_t{3} * static_cast<std::size_t>(sheet.sizePixels.x) *
                         static_cast<std::size_t>(sheet.sizePixels.y),
                     255);
    for (int i = 0; i < static_cast<int>(paths.size()); ++i) {
        const std::string& path = paths[static_cast<std::size_t>(i)];
        const Picture picture = readPng(path);
        if (picture.sizePixels != size || picture.bits != 8)
            throw Error(path + " is not of the size and depth of " + paths.front() +
                        ": draw all alike");
        paste(sheet, picture, (size + kGap) * glm::ivec2{i % columns, i / columns} + kGap / 2);
    }
    return sheet;
}

}  // namespace
}  // namespace aquarama::test

int main(int count, char** arguments) {
    const std::vector<std::string> words(arguments + 1, arguments + count);
    if (words.size() < 3) {
        std::cerr << "usage: aquarama_draw_sheet OUT.png COLUMNS PICTURE.png...\n";
        return 2;
    }
    try {
        const int columns = std::max(std::stoi(words[1]), 1);
        aquarama::writePng(words[0],
                           aquarama::test::sheetOf({words.begin() + 2, words.end()}, columns));
        return 0;
    } catch (const std::exception& error) {
        std::cerr << "aquarama_draw_sheet: " << error.what() << '\n';
        return 1;
    }
}
