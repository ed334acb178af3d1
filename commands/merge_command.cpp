// SPDX-License-Identifier: Apache-2.0
// `aquarama merge`: makes the whole of a work that was done in parts (--part).
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "commands/commands.h"
#include "commands/work_parts.h"
#include "common/base/files.h"
#include "common/base/log.h"

namespace aquarama {

namespace {

struct MergeOptions {
    std::string out;
    std::vector<std::string> parts;
};

void merge(const MergeOptions& options) {
    const WorkInParts work = parts::readWork(options.parts, cli::buildText());
    switch (work.front().work.kind) {
        case parts::WorkKind::Capture:
            return mergeCapture(options.out, work);
        case parts::WorkKind::Study:
            return mergeStudy(options.out, work);
        case parts::WorkKind::Search:
            return mergeSearch(options.out, work);
        case parts::WorkKind::Clip:
            return mergeClip(options.out, work);
    }
}

}  // namespace

void describePart(CLI::App& command, std::optional<parts::Part>& part) {
    command
        .add_option_function<std::string>(
            "--part",
            [&part](const std::string& text) {
                try {
                    part = parts::parsePart(text);
                } catch (const Error& error) {
                    throw CLI::ValidationError("--part", error.what());
                }
            },
            "do only the K-th of N parts, K/N, for aquarama merge")
        ->type_name("K/N");
}

void writePart(const std::string& out,
               parts::Part part,
               parts::WorkKind kind,
               const Digest& inputs,
               std::vector<std::byte> content) {
    const std::string path = parts::partPath(out, part);
    writeWhole(path,
               parts::encodePart({.work = {.kind = kind,
                                           .build = cli::buildText(),
                                           .inputs = inputs,
                                           .arithmetic = parts::arithmeticOfThisMachine(),
                                           .of = part.of},
                                  .number = part.number,
                                  .content = std::move(content)}));
    std::cout << path << '\n';
}

void requireWhole(bool isWhole, const parts::FinishedPart& part) {
    if (!isWhole)
        throw Error(part.path + ": has another content than a " + nameOf(part.work.kind) +
                    " of this build; make it again");
}

void addMerge(CommandLine& line) {
    const auto [command, options] = line.add<MergeOptions>(
        "merge", "make the whole of parts that machines made: aquarama merge OUT PART...", merge);
    command.add_option("OUT", options.out, "what the command would have written without --part")
        ->required();
    command.add_option("PART", options.parts, "the files of all parts (.aqpart), in any order")
        ->required();
}

}  // namespace aquarama
