// SPDX-License-Identifier: Apache-2.0
// aquarama-drawings: prints sheets that visitors colour, and reads photographs of them.
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include "common/base/files.h"
#include "common/cli/commands.h"
#include "common/cli/outputs.h"
#include "drawings/catalogue.h"
#include "drawings/confine.h"
#include "drawings/read.h"
#include "drawings/refusal.h"

namespace aquarama {
namespace {

// Options of `sheets`.
struct SheetOptions {
    std::vector<std::string> species;
    std::string folder;
    std::string paper = "a4";
    std::string language = "en";
};

void printSheets(const SheetOptions& options) {
    cli::requireFolder("--out", options.folder);
    drawings::Catalogue catalogue;
    const std::string line = drawings::lineIn(options.language);
    const glm::dvec2 paper = options.paper == "a4" ? drawings::kA4 : drawings::kLetter;
    for (const std::string& name : options.species) {
        const auto file = std::filesystem::path(options.folder) / (name + ".pdf");
        writeWhole(file, drawings::pdfOf(catalogue.sheetOf(name), paper, line));
        cli::say(file.string());
    }
}

void addSheets(cli::CommandLine& line) {
    const auto [command, options] = line.add<SheetOptions>(
        "sheets", "write sheets to colour, a PDF for each species", printSheets);
    command.add_option("--species", options.species, "such as clownfish,blue_tang")
        ->required()
        ->delimiter(',');
    command.add_option("--out", options.folder, "folder for SPECIES.pdf")->required();
    command.add_option("--paper", options.paper, "landscape: a4 or letter")
        ->check(CLI::IsMember({"a4", "letter"}))
        ->capture_default_str();
    command
        .add_option("--language", options.language, "of the line that says what to do: en or de")
        ->capture_default_str();
}

// Options of `read`.
struct ReadOptions {
    std::vector<std::string> photos;
    std::string folder;
};

// The skin of one, beside which its species is said.
void readOne(const std::string& path,
             const std::filesystem::path& folder,
             drawings::Catalogue& catalogue) {
    const std::vector<std::byte> bytes = readWhole(path, drawings::kMostPhotoBytes + 1);
    const drawings::Drawing drawing = drawings::readDrawing(
        drawings::decodePhoto(bytes), [&](int number) { return catalogue.sheetOf(number); });
    const auto file =
        folder / (std::filesystem::path(path).stem().string() + "-" + drawing.species + ".png");
    writeWhole(file, encodePng(drawing.skin, PngMeaning::Srgb));
    cli::say(fmt::format("{}: {}", drawing.species, file.string()));
}

// Returns the exit status: 1 where one is refused.
int readAll(const ReadOptions& options) {
    cli::requireFolder("--out", options.folder);
    drawings::Catalogue catalogue;
    int status = 0;
    for (const std::string& path : options.photos) {
        try {
            readOne(path, options.folder, catalogue);
        } catch (const drawings::Refusal& refusal) {
            cli::sayError("aquarama-drawings read", path + ": " + refusal.what());
            status = 1;
        }
    }
    return status;
}

void addRead(cli::CommandLine& line) {
    const auto [command, options] = line.add<ReadOptions>(
        "read", "read photographs of coloured sheets, a skin of a fish from each", readAll);
    command.add_option("PHOTO", options.photos, "JPEG, PNG or WebP; several are read in turn")
        ->required();
    command.add_option("--out", options.folder, "folder for PHOTO-SPECIES.png")->required();
}

// Standard input, up to one byte more than a picture may have.
std::vector<std::byte> picture() {
    std::vector<std::byte> bytes(drawings::kMostPhotoBytes + 1);
    std::size_t filled = 0;
    while (filled < bytes.size()) {
        const ssize_t count = read(STDIN_FILENO, bytes.data() + filled, bytes.size() - filled);
        if (count <= 0) break;
        filled += static_cast<std::size_t>(count);
    }
    bytes.resize(filled);
    return bytes;
}

// "drawing SPECIES BYTES" and the skin, or "refused WORD".
std::string answerTo(std::span<const std::byte> bytes, drawings::Catalogue& catalogue) {
    try {
        const drawings::Drawing drawing = drawings::readDrawing(
            drawings::decodePhoto(bytes), [&](int number) { return catalogue.sheetOf(number); });
        const std::vector<std::byte> png = encodePng(drawing.skin, PngMeaning::Srgb);
        return fmt::format("drawing {} {}\n", drawing.species, png.size())
            .append(reinterpret_cast<const char*>(png.data()), png.size());
    } catch (const drawings::Refusal& refusal) {
        return fmt::format("refused {}\n", drawings::wordOf(refusal.reason()));
    }
}

// Options of `decode`.
struct DecodeOptions {};

// Returns the exit status: 1 where nobody hears the answer.
int decode(const DecodeOptions& /*options*/) {
    drawings::Catalogue catalogue;
    drawings::confine();
    const std::string answer = answerTo(picture(), catalogue);
    for (std::size_t said = 0; said < answer.size();) {
        const ssize_t count = write(STDOUT_FILENO, answer.data() + said, answer.size() - said);
        if (count <= 0) return 1;
        said += static_cast<std::size_t>(count);
    }
    return 0;
}

// What other programs run (common/ask/drawing_reader.h).
void addDecode(cli::CommandLine& line) {
    line.add<DecodeOptions>(
        "decode",
        "read a photograph from standard input, as a process that may do no more",
        decode);
    line.hide("decode");
}

}  // namespace
}  // namespace aquarama

// NOLINTNEXTLINE(bugprone-exception-escape): outside runProgram() only a lack of memory throws
int main(int count, char** arguments) {
    using namespace aquarama;
    CLI::App app("Drawings that swim: sheets to colour, and photographs of them.",
                 "aquarama-drawings");
    app.require_subcommand(1);
    cli::CommandLine line(app);
    addSheets(line);
    addRead(line);
    addDecode(line);
    return cli::runProgram(app, count, arguments, [&] { return line.runChosen(); });
}
