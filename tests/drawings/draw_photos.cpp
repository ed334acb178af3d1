// SPDX-License-Identifier: Apache-2.0
// Photographs of sheets that a program has coloured, as files: aquarama_draw_photos OUT COUNT
// SPECIES... writes OUT/1.jpg and so on, for documents and for tests of a whole show.
#include <exception>
#include <filesystem>
#include <iostream>
#include <string>

#include "common/base/files.h"
#include "drawings/catalogue.h"
#include "tests/drawings/painted_sheet.h"
#include "tests/drawings/sample_photos.h"
#include "tests/drawings/snapshot.h"

namespace {

using namespace aquarama;

constexpr int kQuality = 90;
constexpr double kMegapixels = 2;

void draw(drawings::Catalogue& catalogue,
          const std::string& species,
          std::uint32_t number,
          const std::filesystem::path& file) {
    const drawings::Sheet& sheet = catalogue.sheetOf(species);
    const auto paper = test::painted(sheet, test::printed(sheet, drawings::kA4), number);
    const auto how = test::circumstancesOf(number, kMegapixels);
    writeWhole(
        file,
        test::jpegOf(test::photographed(paper, how, test::Camera(how, drawings::kA4)), kQuality));
    std::cout << file.string() << '\n';
}

}  // namespace

int main(int count, char** arguments) try {
    if (count < 4) {
        std::cerr << "usage: aquarama_draw_photos OUT COUNT SPECIES...\n";
        return 2;
    }
    drawings::Catalogue catalogue;
    const std::filesystem::path folder = arguments[1];
    std::filesystem::create_directories(folder);
    for (std::uint32_t number = 1; number <= std::stoul(arguments[2]); ++number)
        draw(catalogue,
             arguments[3 + (number - 1) % static_cast<std::uint32_t>(count - 3)],
             number,
             folder / (std::to_string(number) + ".jpg"));
    return 0;
} catch (const std::exception& problem) {
    std::cerr << problem.what() << '\n';
    return 1;
}
